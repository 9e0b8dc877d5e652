#pragma once
// Which vertices slide along edges of the input, and between which neighbours.

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// What holds a vertex that could slide.
enum class HeldOn : std::uint8_t {
  Nothing,    // it slides, or is not of what slides
  Corner,     // the boundary, or the feature edge, turns there
  Junction,   // more than two feature edges meet there, or parts of the boundary
  End,        // a feature edge ends there
  Touching,   // parts of the surface touch there, or it cannot be wound alike
  Named,      // the file gives it a meaning
  Rule,       // boundary or interfaces stay
  Unmatched,  // the surface of another mesh that it should slide on is too far away, or has no feature edge there
  Hand,       // a person made it a corner
  Tied        // it belongs to another vertex: see core/mesh/ties.h
};

/// A vertex slides between two neighbours once exactly two edges of curves have met at it, unless it is held.
class CurveEnds {
 public:
  explicit CurveEnds(Index vertices) : ends_(vertices, kNone) {}
  using Ends = std::array<Index, 2>;

  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(ends_.size()); }
  [[nodiscard]] bool slides(Index v) const noexcept { return ends_[v][0] != kNoIndex && ends_[v][1] != kNoIndex; }
  [[nodiscard]] bool held(Index v) const noexcept { return ends_[v][0] == kNoIndex && ends_[v][1] != kNoIndex; }
  /// Does no edge of a curve meet there, and does nothing hold it?
  [[nodiscard]] bool off(Index v) const noexcept { return ends_[v] == kNone; }
  /// Of a vertex that slides: its neighbours along the curve.
  [[nodiscard]] const Ends& of(Index v) const noexcept { return ends_[v]; }

  /// The first reason counts.
  void hold(Index v, HeldOn why) noexcept {
    if (!held(v)) ends_[v] = {kNoIndex, static_cast<Index>(why)};
  }
  [[nodiscard]] HeldOn why(Index v) const noexcept {
    if (held(v)) return static_cast<HeldOn>(ends_[v][1]);
    return slides(v) || off(v) ? HeldOn::Nothing : HeldOn::End;
  }
  /// An edge of a curve. Where a third one meets, the vertex is held.
  void join(Index a, Index b) noexcept {
    join_one(a, b);
    join_one(b, a);
  }

 private:
  static constexpr Ends kNone{kNoIndex, kNoIndex};

  void join_one(Index v, Index other) noexcept {
    Ends& ends = ends_[v];
    if (ends == kNone)
      ends[0] = other;
    else if (ends[0] != kNoIndex && ends[1] == kNoIndex)
      ends[1] = other;
    else
      hold(v, HeldOn::Junction);
  }

  std::vector<Ends> ends_;  // kNoIndex: none; of one that is held the second is why
};

}  // namespace dmoscope
