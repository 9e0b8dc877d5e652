#pragma once
// Which vertices slide along edges of the input, and between which neighbours.

#include <array>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// A vertex slides between two neighbours once exactly two edges of curves have met at it, unless it is held.
class CurveEnds {
 public:
  explicit CurveEnds(Index vertices) : ends_(vertices, kNone) {}
  using Ends = std::array<Index, 2>;

  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(ends_.size()); }
  [[nodiscard]] bool slides(Index v) const noexcept { return ends_[v][0] != kNoIndex && ends_[v][1] != kNoIndex; }
  [[nodiscard]] bool held(Index v) const noexcept { return ends_[v] == kHeld; }
  /// Does no edge of a curve meet there, and does nothing hold it?
  [[nodiscard]] bool off(Index v) const noexcept { return ends_[v] == kNone; }
  /// Of a vertex that slides: its neighbours along the curve.
  [[nodiscard]] const Ends& of(Index v) const noexcept { return ends_[v]; }

  void hold(Index v) noexcept { ends_[v] = kHeld; }
  /// An edge of a curve. Where a third one meets, the vertex is held.
  void join(Index a, Index b) noexcept {
    join_one(a, b);
    join_one(b, a);
  }

 private:
  static constexpr Ends kNone{kNoIndex, kNoIndex}, kHeld{kNoIndex, 0};

  void join_one(Index v, Index other) noexcept {
    Ends& ends = ends_[v];
    if (ends == kNone)
      ends[0] = other;
    else if (ends[0] != kNoIndex && ends[1] == kNoIndex)
      ends[1] = other;
    else
      hold(v);
  }

  std::vector<Ends> ends_;  // kNoIndex: none
};

}  // namespace dmoscope
