#pragma once
// Ways of the vertices of a joint move that may only slide.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Directions of those of a problem's free vertices that may only slide. Before each Newton step the search asks for the directions in
/// which they may go, and after it puts them back onto what they slide on: trials are judged there, so no step leaves it. Displacements are
/// those of a JointProblem.
template <int D>
class JointWays {
 public:
  using Place = std::array<double, static_cast<std::size_t>(D)>;
  using Way = std::array<double, static_cast<std::size_t>(D) * D>;  // a symmetric projection, row by row

  JointWays() = default;
  JointWays(const JointWays&) = delete;
  JointWays& operator=(const JointWays&) = delete;
  virtual ~JointWays() = default;

  /// Projections by free vertex, of a displacement onto the directions in which the vertex may go.
  [[nodiscard]] virtual std::span<const Way> ways() const noexcept = 0;
  /// By free vertex: non-zero where it may only slide.
  [[nodiscard]] virtual std::span<const std::uint8_t> bound() const noexcept = 0;

  /// Settles the ways for a step from the present places. `forces`: D numbers a free vertex, the way in which the minimised function falls
  /// fastest; read for bound vertices alone.
  virtual void choose(std::span<const double> forces) = 0;
  /// Puts the bound vertices of a trial back. `from`: displacements before it, of all. False: the trial is impossible.
  [[nodiscard]] virtual bool put_back(const std::vector<Place>& from, std::vector<Place>& trial) = 0;
  /// Accepts the last trial as the present places.
  virtual void take() = 0;
  /// Keeps the present places as the best so far.
  virtual void keep_best() = 0;
};

}  // namespace dmoscope
