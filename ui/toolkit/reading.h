#pragma once
// Names what is being read or made, for the place where its mesh will be seen.

#include <optional>
#include <string>
#include <string_view>

namespace dmoscope::ui {

struct BeingRead {
  std::string name;   // "east.14"; "sample coast"
  std::string where;  // "184.2 MB in /home/me/meshes"; empty if there is no file
};

/// Mesh that a command of the session brings; none: it opens nothing. Reads the file's size.
[[nodiscard]] std::optional<BeingRead> being_read(std::string_view command);

}  // namespace dmoscope::ui
