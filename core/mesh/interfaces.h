#pragma once
// Vertices inside a mesh that keep their place because the file gives them a meaning: those between materials, on lines, faces and strings
// that it names, and points that it names.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

class Topology;

/// Treatment of a mesh's interfaces when it is smoothed. Slide: vertices between materials move, but only along the interface.
enum class InterfaceRule : std::uint8_t { Fixed, Free, Slide };
[[nodiscard]] std::string_view name(InterfaceRule rule) noexcept;  // word of a rule, such as "fixed"
/// Parses the word of a rule. Throws UsageError for an unknown one.
[[nodiscard]] InterfaceRule parse_interface_rule(std::string_view word);

/// Reason why a vertex is held; of several reasons the first in this order.
enum class HeldBy : std::uint8_t { Groups, Values, Faces, Lines, Strings, Points };
inline constexpr std::size_t kHeldByCount = 6;

/// Vertices off the boundary that are held. A vertex is held
/// - if its elements do not all belong to the same groups of elements (Groups);
/// - if its elements carry different numbers of a field that names materials, see materials.h (Values);
/// - if it belongs to a face in a volume, or to a line, that the file names: Gmsh's, MEDIT's and VTK's cells of fewer dimensions, SU2's
///   markers, ridges, or to elements that MEDIT calls required (Faces, Lines). Faces or lines that are named together with all around
///   them do not count: such a list merely enumerates everything, see named_lists.h;
/// - if it belongs to a boundary string of a fort.14, baffles and weirs among them (Strings);
/// - if the file names it as a point: required vertices, corners (Points). Sets of points that fill an area or volume do not count, unless
///   the file says that they are required.
class Interfaces {
 public:
  /// Constructs an empty set, which holds no vertex.
  Interfaces() = default;
  Interfaces(const Mesh& mesh, const Topology& topology);

  [[nodiscard]] bool any() const noexcept { return !reason_.empty(); }
  [[nodiscard]] bool holds(Index vertex) const noexcept { return any() && reason_[vertex] != kNoIndex; }
  /// Sentence on a held vertex: "it lies on the interface between "steel" and "air", which stays"; empty for one that is not held.
  [[nodiscard]] std::string why(Index vertex) const { return holds(vertex) ? reasons_[reason_[vertex]] : std::string(); }
  /// Whether an interface between materials ends at this vertex of the boundary.
  [[nodiscard]] bool meets_boundary_at(Index vertex) const noexcept { return !meets_.empty() && meets_[vertex] != 0; }
  /// Whether an interface between materials lies between two elements.
  [[nodiscard]] bool between(Index element, Index other) const noexcept {
    return !material_.empty() && material_[element] != material_[other];
  }
  /// Number of held vertices, each counted once.
  [[nodiscard]] Index count(HeldBy by) const noexcept { return counts_[static_cast<std::size_t>(by)]; }
  [[nodiscard]] Index count() const noexcept;
  /// Sentence on all held vertices: "1,024 vertices on 2 interfaces between groups and 12 on lines stay (--interfaces free moves them)";
  /// empty if none is held or ignored. `way_out`: the option or command that frees them, "--interfaces free".
  [[nodiscard]] std::string sentence(std::string_view way_out) const;
  /// A sentence for each cell data that may mean materials but hold nothing by their name: "cell data "X" has 3 values: --materials X keeps
  /// their interfaces"; and for those that the user named to no effect. `way_in`: the option or command before the name.
  [[nodiscard]] std::vector<std::string> offers(std::string_view way_in) const;

 private:
  class Finder;

  std::vector<Index> reason_;  // by vertex, index into reasons_; kNoIndex: not held. Empty if none is held
  std::vector<std::string> reasons_;
  std::vector<Index> material_;      // by element, number of its material; empty if nothing tells elements apart
  std::vector<std::uint8_t> meets_;  // by vertex, whether an interface ends there at the boundary; empty if none does
  std::array<Index, kHeldByCount> counts_{};
  Index between_groups_ = 0, between_values_ = 0;  // numbers of pairs of materials that meet
  std::string value_names_;                        // names of the fields: "mat_id", "mat_id and region"
  struct Offer {
    std::string field;
    std::size_t values;  // number of different values; 1: of a field that the user named
  };
  std::vector<Offer> offers_;
  Index listed_ = 0;  // vertices named only in lists that enumerate everything, which are not held
  bool all_ = false;  // no vertex is left to move
};

}  // namespace dmoscope
