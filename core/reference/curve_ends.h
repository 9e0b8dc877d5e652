#pragma once
// Vertices that slide along edges of the input, and their neighbours there.

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Reason why a vertex that could slide is held.
enum class HeldOn : std::uint8_t {
  Nothing,    // the vertex slides, or is on nothing that slides
  Corner,     // the boundary, or the feature edge, turns at the vertex
  Junction,   // more than two feature edges, or parts of the boundary, meet at the vertex
  End,        // a feature edge ends at the vertex
  Touching,   // parts of the surface touch at the vertex, or cannot be wound alike
  Named,      // the file gives the vertex a meaning
  Rule,       // boundary or interfaces are fixed by rule
  Unmatched,  // the other mesh's surface to slide on is too far away, or has no feature edge there
  Hand,       // the user made the vertex a corner
  Tied        // the vertex belongs to another one: see core/mesh/ties.h
};

/// Neighbours of vertices along curves. A vertex slides between two neighbours once exactly two edges of curves have met at it, unless it
/// is held.
class CurveEnds {
 public:
  explicit CurveEnds(Index vertices) : ends_(vertices, kNone) {}
  using Ends = std::array<Index, 2>;

  [[nodiscard]] Index size() const noexcept { return static_cast<Index>(ends_.size()); }
  [[nodiscard]] bool slides(Index v) const noexcept { return ends_[v][0] != kNoIndex && ends_[v][1] != kNoIndex; }
  [[nodiscard]] bool held(Index v) const noexcept { return ends_[v][0] == kNoIndex && ends_[v][1] != kNoIndex; }
  /// Whether no edge of a curve meets at the vertex, and nothing holds it.
  [[nodiscard]] bool off(Index v) const noexcept { return ends_[v] == kNone; }
  /// Neighbours along the curve of a vertex that slides.
  [[nodiscard]] const Ends& of(Index v) const noexcept { return ends_[v]; }

  /// Holds a vertex; the first reason counts.
  void hold(Index v, HeldOn why) noexcept {
    if (!held(v)) ends_[v] = {kNoIndex, static_cast<Index>(why)};
  }
  [[nodiscard]] HeldOn why(Index v) const noexcept {
    if (held(v)) return static_cast<HeldOn>(ends_[v][1]);
    return slides(v) || off(v) ? HeldOn::Nothing : HeldOn::End;
  }
  /// Adds an edge of a curve. A vertex where a third one meets is held.
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

  std::vector<Ends> ends_;  // neighbours, kNoIndex: none; of a held vertex the second is the reason
};

}  // namespace dmoscope
