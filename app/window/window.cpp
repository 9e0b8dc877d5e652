#include "app/window/window.h"

#include "app/common/console.h"
#include "app/window/desktop.h"

namespace dmoscope::app {

int run_window(const WindowOptions& options) {
  require_display();
  block_interrupts();  // before there is another thread
  Desktop window(options);
  const Watch watch([&window] { window.end_soon(); });  // a second signal ends it at once
  window.run_until_closed();
  return 0;
}

}  // namespace dmoscope::app
