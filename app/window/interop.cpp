#include "app/window/interop.h"

#include "gpu/gl_interop.h"

namespace dmoscope::app {

std::string no_interop(const Acceleration& acceleration, const render::Context& context) {
  if (!acceleration.accelerator) return {};
  // The driver is not asked: it does not know a context of software.
  if (context.is_software()) return "the processor draws: " + context.description();
  return gpu::gl_obstacle(acceleration.accelerator->number());
}

std::unique_ptr<render::Context> headless_context_for(const Acceleration& acceleration) {
  if (!acceleration.accelerator) return render::create_headless_context();
  return render::create_headless_context(acceleration.accelerator->number());
}

}  // namespace dmoscope::app
