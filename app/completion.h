#pragma once
// Shell completion, from the same options as --help.

#include <string>
#include <string_view>

namespace CLI {
class App;
}

namespace dmoscope::app {

/// Makes a completion script for `shell`: bash or zsh. Throws UsageError for any other.
[[nodiscard]] std::string completion_script(const CLI::App& app, std::string_view shell);

}  // namespace dmoscope::app
