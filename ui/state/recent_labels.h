#pragma once
// Short names of files in a list.

#include <span>
#include <string>
#include <vector>

namespace dmoscope::ui {

/// Last part of each path; if several share it, it is followed by as many folders as tell them apart: "east.14   results/a".
[[nodiscard]] std::vector<std::string> short_names(std::span<const std::string> files);

}  // namespace dmoscope::ui
