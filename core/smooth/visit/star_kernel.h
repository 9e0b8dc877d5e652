#pragma once
// Search for the best candidate of a free vertex that evaluates many at once. Where it cannot, the visit's plain search does it.

#include <optional>
#include <span>

#include "core/mesh/position_view.h"
#include "core/smooth/composite_objective.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

/// Fast search for free vertices. Immutable; for any number of threads at once. Frame: Plane or Space.
template <class Frame>
class StarKernel {
 public:
  using Offset = OffsetIn<Frame, double>;
  struct Found {
    bool ready = false;                 // false: the plain search must take the star
    Offset offset{};                    // offset of the winner; 0: the vertex is at its best place
    double scale = 1.0;                 // unit of the offset, in mesh units
    Offset box{};                       // box of the star's other vertices, in units of `scale`
    bool single = false;                // whether candidates are rounded to float
    std::optional<StarState> before{};  // star at the vertex's present place, where known
  };
  StarKernel() = default;
  StarKernel(const StarKernel&) = delete;
  StarKernel& operator=(const StarKernel&) = delete;
  virtual ~StarKernel() = default;

  /// Finds the winner of the first `levels` levels: a search of fewer levels begins like one of more.
  [[nodiscard]] virtual Found find(PositionView positions, Index vertex, const Untangling& untangling, int levels) const = 0;
  /// Returns whether the vertex gains at `target` for which the same thread has just found a winner, where rounding does not decide. None:
  /// the statistics' formulas have to.
  [[nodiscard]] virtual std::optional<bool> gains(PositionView /*positions*/, Index /*vertex*/, Vec3 /*target*/) const {
    return std::nullopt;
  }
  /// Returns whether the star's elements are certain to be valid inside at `target`.
  [[nodiscard]] virtual bool valid_at(Index /*vertex*/, Vec3 /*target*/) const { return false; }
  /// Returns whether the star is certain to keep a guard with its vertex at `target`, for which the same thread has just found a winner.
  [[nodiscard]] virtual bool keeps(const Guard& /*guard*/, Index /*vertex*/, Vec3 /*target*/) const { return false; }
  /// Other vertices of its star; none where they are not noted.
  [[nodiscard]] virtual std::span<const Index> others(Index /*vertex*/) const { return {}; }
};

}  // namespace dmoscope
