// No verb: the window.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/verbs/verbs.h"
#include "core/base/error.h"

#ifdef DMOSCOPE_HAVE_GUI
#include <cstdlib>

#include "app/window/window.h"
#endif

namespace dmoscope::app {
namespace {

std::string hint(const std::vector<std::string>& verbs) {
  return fmt::format("verbs that need no screen: {} (dmoscope --help)", fmt::join(verbs, ", "));
}

#ifdef DMOSCOPE_HAVE_GUI
bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}
#endif

/// A mistyped verb must not open an empty window.
void require_files(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& verbs) {
  for (const auto& file : files) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
      throw InputError(file.string(), 0, fmt::format("there is no such file and no such verb; {}", hint(verbs)));
    }
  }
}

}  // namespace

int open_window(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& verbs) {
  require_files(files, verbs);
#ifdef DMOSCOPE_HAVE_GUI
  if (!has_display()) {
    throw UsageError(
        fmt::format("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set), so no window can open; {}", hint(verbs)));
  }
  WindowOptions options;
  options.files = files;
  return run_window(options);
#else
  throw UsageError(fmt::format("this program was built without the window; {}", hint(verbs)));
#endif
}

}  // namespace dmoscope::app
