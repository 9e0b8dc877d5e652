#include "app/verbs/backend.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "gpu/device.h"

namespace dmoscope::app {

std::string choose_backend(std::string_view wanted) {
  if (wanted == "auto" || wanted == "cpu") return "cpu";
  if (wanted != "cuda") throw UsageError(fmt::format("unknown backend '{}' (known: auto, cpu, cuda)", wanted));
  throw UsageError(fmt::format("the cuda backend cannot be used: {}", gpu::availability().reason));
}

}  // namespace dmoscope::app
