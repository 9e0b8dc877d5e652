#include "app/window/window.h"

#include "app/common/console.h"
#include "app/window/desktop.h"

namespace dmoscope::app {

int run_window(const WindowOptions& options) {
  require_display();
  block_interrupts();  // before other threads start
  Desktop window(options);
  const Watch watch([&window] { window.end_soon(); });  // a second signal ends the process at once
  window.run_until_closed();
  return 0;
}

}  // namespace dmoscope::app
