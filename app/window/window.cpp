#include "app/window/window.h"

#include "app/window/desktop.h"

namespace dmoscope::app {

int run_window(const WindowOptions& options) {
  require_display();
  Desktop(options).run_until_closed();
  return 0;
}

}  // namespace dmoscope::app
