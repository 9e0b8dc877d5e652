#pragma once
// The vertices inside a mesh that keep their place because the file gives them a meaning: those between materials, on lines, faces and
// strings that it names, and points that it names.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

class Topology;

/// What becomes of a mesh's interfaces when it is smoothed.
/// Slide: those between materials move, but only along themselves.
enum class InterfaceRule : std::uint8_t { Fixed, Free, Slide };
[[nodiscard]] std::string_view name(InterfaceRule rule) noexcept;  // "fixed"
/// Throws UsageError for an unknown word.
[[nodiscard]] InterfaceRule parse_interface_rule(std::string_view word);

/// Why a vertex is held; where several reasons are, the first of these.
enum class HeldBy : std::uint8_t { Groups, Values, Faces, Lines, Strings, Points };
inline constexpr std::size_t kHeldByCount = 6;

/// Held is a vertex off the boundary
/// - whose elements do not all belong to the same groups of elements (Groups);
/// - whose elements carry different numbers of a field that names materials, see materials.h (Values);
/// - of a face in a volume, or of a line, that the file names: Gmsh's, MEDIT's and VTK's cells of fewer dimensions, SU2's markers, ridges,
///   and of elements that MEDIT calls required (Faces, Lines). Faces or lines that are named together with all around them do not count:
///   such a list merely enumerates everything, see named_lists.h;
/// - of a boundary string of a fort.14, baffles and weirs among them (Strings);
/// - that the file names as a point: required vertices, corners (Points). Likewise not inside sets of points that fill an area or volume,
///   unless the file says that they are required.
class Interfaces {
 public:
  /// None.
  Interfaces() = default;
  Interfaces(const Mesh& mesh, const Topology& topology);

  [[nodiscard]] bool any() const noexcept { return !reason_.empty(); }
  [[nodiscard]] bool holds(Index vertex) const noexcept { return any() && reason_[vertex] != kNoIndex; }
  /// "it lies on the interface between "steel" and "air", which stays"; empty for a vertex that is not held.
  [[nodiscard]] std::string why(Index vertex) const { return holds(vertex) ? reasons_[reason_[vertex]] : std::string(); }
  /// Does an interface between materials end at this vertex of the boundary?
  [[nodiscard]] bool meets_boundary_at(Index vertex) const noexcept { return !meets_.empty() && meets_[vertex] != 0; }
  /// Does an interface between materials lie between two elements?
  [[nodiscard]] bool between(Index element, Index other) const noexcept {
    return !material_.empty() && material_[element] != material_[other];
  }
  /// Held vertices, each counted once.
  [[nodiscard]] Index count(HeldBy by) const noexcept { return counts_[static_cast<std::size_t>(by)]; }
  [[nodiscard]] Index count() const noexcept;
  /// "1,024 vertices on 2 interfaces between groups and 12 on lines stay (--interfaces free moves them)"; empty where nothing is held or
  /// passed over. `way_out`: what the person here can say, "--interfaces free".
  [[nodiscard]] std::string sentence(std::string_view way_out) const;
  /// A sentence for each of the cell data that may mean materials and hold nothing by their name: "cell data "X" has 3 values: --materials
  /// X keeps their interfaces"; and of those that a person named to no effect. `way_in`: what the person here says before the name.
  [[nodiscard]] std::vector<std::string> offers(std::string_view way_in) const;

 private:
  class Finder;

  std::vector<Index> reason_;  // of every vertex, into reasons_; kNoIndex: not held. Empty where none is held
  std::vector<std::string> reasons_;
  std::vector<Index> material_;      // of every element, numbered; empty where nothing tells them apart
  std::vector<std::uint8_t> meets_;  // of every vertex; empty where no interface ends at the boundary
  std::array<Index, kHeldByCount> counts_{};
  Index between_groups_ = 0, between_values_ = 0;  // how many pairs of materials meet
  std::string value_names_;                        // "mat_id", "mat_id and region"
  struct Offer {
    std::string field;
    std::size_t values;  // 1: of a field that a person named
  };
  std::vector<Offer> offers_;
  Index listed_ = 0;  // vertices named in lists alone, which are not held
  bool all_ = false;  // no vertex is left to move
};

}  // namespace dmoscope
