#pragma once
// Whether the device that smooths can write what OpenGL draws.

#include <memory>
#include <string>

#include "core/smooth/execution/accelerator.h"
#include "render/context.h"

namespace dmoscope::app {

/// Why an accelerator cannot write the buffers of this context, which is current; empty where it can, and where there is none.
[[nodiscard]] std::string no_interop(const Acceleration& acceleration, const render::Context& context);

/// A context without a window, of the device that smooths where there is one.
[[nodiscard]] std::unique_ptr<render::Context> headless_context_for(const Acceleration& acceleration);

}  // namespace dmoscope::app
