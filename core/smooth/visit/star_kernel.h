#pragma once
// A search for the best candidate of a free vertex that does many at once. Where it cannot, the visit's plain search does it.

#include <optional>
#include <span>

#include "core/mesh/position_view.h"
#include "core/smooth/reference_visit.h"

namespace dmoscope {

/// Immutable; by any number of threads at once. Frame: Plane or Space.
template <class Frame>
class StarKernel {
 public:
  using Offset = OffsetIn<Frame, double>;
  struct Found {
    bool ready = false;                 // false: the star is the plain search's
    Offset way{};                       // to the winner, in mesh units; 0: the vertex is where it is best
    std::optional<StarState> before{};  // its star, where that is known
  };
  StarKernel() = default;
  StarKernel(const StarKernel&) = delete;
  StarKernel& operator=(const StarKernel&) = delete;
  virtual ~StarKernel() = default;

  [[nodiscard]] virtual Found find(PositionView positions, Index vertex, const Untangling& untangling) const = 0;
  /// Does the vertex that the same thread has just found a winner for gain at `target`, where rounding does not decide? None: the
  /// statistics' formulas have to say.
  [[nodiscard]] virtual std::optional<bool> gains(PositionView /*positions*/, Index /*vertex*/, Vec3 /*target*/) const {
    return std::nullopt;
  }
  /// Are its star's elements certain to be valid inside there?
  [[nodiscard]] virtual bool valid_at(Index /*vertex*/, Vec3 /*target*/) const { return false; }
  /// The other vertices of its star; none where nobody has noted them.
  [[nodiscard]] virtual std::span<const Index> others(Index /*vertex*/) const { return {}; }
};

}  // namespace dmoscope
