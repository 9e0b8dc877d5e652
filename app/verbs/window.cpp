// No verb: the window.

#include <fmt/format.h>

#include "app/verbs/verbs.h"
#include "core/base/error.h"

#ifdef DMOSCOPE_HAVE_GUI
#include <cstdlib>

#include "app/window/window.h"
#endif

namespace dmoscope::app {
namespace {

constexpr std::string_view kVerbs =
    "verbs that need no screen: smooth, quality, render, convert, generate, script, bench, info (dmoscope --help)";

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
void require_files(const std::vector<std::filesystem::path>& files) {
  for (const auto& file : files) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) {
      throw InputError(file.string(), 0, fmt::format("there is no such file and no such verb; {}", kVerbs));
    }
  }
}

}  // namespace

int open_window(const std::vector<std::filesystem::path>& files) {
  require_files(files);
#ifdef DMOSCOPE_HAVE_GUI
  if (!has_display()) {
    throw UsageError(fmt::format("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set), so no window can open; {}", kVerbs));
  }
  WindowOptions options;
  options.files = files;
  return run_window(options);
#else
  throw UsageError(fmt::format("this program was built without the window; {}", kVerbs));
#endif
}

}  // namespace dmoscope::app
