#pragma once
// What is on its way into the window, in words: for the place where its mesh will be seen.

#include <optional>
#include <string>
#include <string_view>

namespace dmoscope::ui {

struct BeingRead {
  std::string name;   // "east.14"; "sample coast"
  std::string where;  // "184.2 MB in /home/me/meshes"; empty where there is no file
};

/// What a command of the session brings; none: it opens nothing. Looks at the file's size.
[[nodiscard]] std::optional<BeingRead> being_read(std::string_view command);

}  // namespace dmoscope::ui
