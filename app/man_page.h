#pragma once
// The man page, made from the program's own tables and options.

#include <string>

namespace CLI {
class App;
}

namespace dmoscope::app {

/// The man page dmoscope(1) in roff.
[[nodiscard]] std::string man_page(const CLI::App& app);

}  // namespace dmoscope::app
