// The command line without a subcommand: opens the window.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/comparison/of_session.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/base/unknown_value.h"

#ifdef DMOSCOPE_HAVE_GUI
#include <cstdlib>

#include "app/window/window.h"
#endif

namespace dmoscope::app {
namespace {

std::string hint(const std::vector<std::string>& subcommands) {
  return fmt::format("subcommands that need no screen: {} (dmoscope --help)", fmt::join(subcommands, ", "));
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

/// Throws UsageError unless all files exist, so that a mistyped subcommand does not open an empty window.
void require_files(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& subcommands) {
  for (const auto& file : files) {
    std::error_code error;
    if (std::filesystem::exists(file, error)) continue;
    const std::string name = file.string();
    const auto guess = closest_word(name, std::vector<std::string_view>(subcommands.begin(), subcommands.end()));
    throw InputError(name, 0,
                     fmt::format("there is no such file and no such subcommand; {}{}",
                                 guess ? fmt::format("did you mean {}? ", *guess) : std::string(), hint(subcommands)));
  }
}

}  // namespace

int open_window(const std::vector<std::filesystem::path>& files, const std::vector<std::string>& subcommands) {
  require_files(files, subcommands);
#ifdef DMOSCOPE_HAVE_GUI
  if (!has_display()) {
    throw UsageError(
        fmt::format("there is no display (neither DISPLAY nor WAYLAND_DISPLAY is set), so no window can open; {}", hint(subcommands)));
  }
  WindowOptions options;
  options.files = files;
  options.report = write_report_of_session;
  return run_window(options);
#else
  throw UsageError(fmt::format("this program was built without the window; {}", hint(subcommands)));
#endif
}

}  // namespace dmoscope::app
