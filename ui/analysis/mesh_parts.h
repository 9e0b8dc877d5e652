#pragma once
// Parts of a mesh in the form that the window lists them: groups and boundary loops.

#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/group_facts.h"
#include "core/mesh/outline.h"
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

class OutlineSource {
 public:
  /// Outline of a mesh; null while it is being found.
  [[nodiscard]] const Outline* of(const std::shared_ptr<const InputMesh>& input);
  /// Whether nothing is being found.
  [[nodiscard]] bool settled() const noexcept { return !pending_.valid(); }

 private:
  std::shared_ptr<const InputMesh> input_;  // mesh that they belong to
  std::shared_ptr<const Outline> outline_;
  std::future<std::shared_ptr<const Outline>> pending_;
};

}  // namespace dmoscope::ui
