#pragma once
// Short names of files in a list.

#include <span>
#include <string>
#include <vector>

namespace dmoscope::ui {

/// Of each path its last part; where several have the same, as many folders as tell them apart, behind it: "east.14   results/a".
[[nodiscard]] std::vector<std::string> short_names(std::span<const std::string> files);

}  // namespace dmoscope::ui
