#pragma once
// Groups of a mesh in the form that the window lists them.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh/group_facts.h"
#include "render/colour_map.h"

namespace dmoscope::ui {

/// Greatest number of groups with categories of their own; with more, those of one role and code share a category of colours (hundreds of
/// islands).
inline constexpr std::size_t kMostGroupCategories = 8;
/// The category that a group belongs to; `many`: there are more than kMostGroupCategories groups.
[[nodiscard]] std::string category_of(const Group& group, bool many);

struct GroupLine {
  GroupFacts facts;
  std::string word;                   // name that `fix` takes, "elements:steel"
  std::optional<render::Rgb> colour;  // colour in the mesh coloured by group; none: it is not coloured
};
/// One line for each of the mesh's groups, in their order.
[[nodiscard]] std::vector<GroupLine> group_lines(const Mesh& mesh);

}  // namespace dmoscope::ui
