#pragma once
// Test whether the device that smooths can write OpenGL's buffers.

#include <memory>
#include <string>

#include "core/smooth/execution/accelerator.h"
#include "render/context.h"

namespace dmoscope::app {

/// Returns why an accelerator cannot write the buffers of this context, which is current; empty if it can, or if there is none.
[[nodiscard]] std::string no_interop(const Acceleration& acceleration, const render::Context& context);

/// Makes a context without a window, on the device that smooths if there is one.
[[nodiscard]] std::unique_ptr<render::Context> headless_context_for(const Acceleration& acceleration);

}  // namespace dmoscope::app
