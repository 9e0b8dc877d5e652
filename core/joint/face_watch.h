#pragma once
// Watch that keeps the faces of a surface near the input while many of their vertices move at once.

#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/reference/deviation_bound.h"

namespace dmoscope {

/// Checks faces of sliding vertices at the positions that it was given. Domain and bound must outlive it.
class FaceWatch {
 public:
  /// Begins with `positions`.
  FaceWatch(const Domain& domain, const DeviationBound& limit, std::span<const Vec3> positions);
  /// Adds a vertex that may move. `beneath`: its place on a surface; none on a curve.
  void add(Index vertex, const std::optional<FacetPlace>& beneath);
  void put(Index vertex, Vec3 position) { at_[vertex] = position; }
  /// Returns whether the faces at a vertex keep near the input with it there. `beneath`: its place on a surface; null on a curve.
  [[nodiscard]] bool allows(Index vertex, Vec3 there, const FacetPlace* beneath);
  /// Corners of the faces at a vertex, itself among them.
  [[nodiscard]] std::vector<Index> around(Index vertex) const;

 private:
  struct Begin {
    Vec3 position;
    std::optional<FacetPlace> beneath;
    std::optional<Fit> fit;  // none while not known
  };
  const Domain& domain_;
  const DeviationBound& limit_;
  std::vector<Vec3> begins_, at_;  // positions of all vertices
  std::unordered_map<Index, Begin> of_;
  OverlayRoom room_;
};

}  // namespace dmoscope
