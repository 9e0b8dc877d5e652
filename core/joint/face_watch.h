#pragma once
// Keeps the faces of a surface near the input while many of their vertices move at once.

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/reference/deviation_bound.h"

namespace dmoscope {

/// Looks at faces of vertices that slide, where it was told that all of them stand. Domain and bound must outlive it.
class FaceWatch {
 public:
  /// `positions`: where they begin.
  FaceWatch(const Domain& domain, const DeviationBound& limit, std::span<const Vec3> positions);
  /// A vertex that may move. `beneath`: of one on a surface.
  void add(Index vertex, const std::optional<FacetPlace>& beneath);
  void put(Index vertex, Vec3 position) { at_[vertex] = position; }
  /// Do the faces at a vertex keep near the input with it there? `beneath`: of one on a surface.
  [[nodiscard]] bool allows(Index vertex, Vec3 there, const FacetPlace* beneath);
  /// The corners of the faces at a vertex, itself among them.
  [[nodiscard]] std::vector<Index> around(Index vertex) const;

 private:
  struct Begin {
    Vec3 position;
    std::optional<FacetPlace> beneath;
    std::optional<Fit> fit;  // once it is known
  };
  const Domain& domain_;
  const DeviationBound& limit_;
  std::vector<Vec3> begins_, at_;  // of all vertices
  std::unordered_map<Index, Begin> of_;
  OverlayRoom room_;
};

}  // namespace dmoscope
