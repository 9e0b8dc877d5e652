#pragma once
// Where the vertices of a joint move may go that are not free to go anywhere.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/base/vec.h"

namespace dmoscope {

/// Of a problem's free vertices some may only slide. Before each Newton step the search asks for the directions in which they may go from
/// where they stand, and after it puts them back onto what they slide on: trials are judged there, so no step leaves it. Displacements are
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

  /// By free vertex: takes a displacement into the directions in which it may go.
  [[nodiscard]] virtual std::span<const Way> ways() const noexcept = 0;
  /// By free vertex: non-zero where it is not free to go anywhere.
  [[nodiscard]] virtual std::span<const std::uint8_t> bound() const noexcept = 0;

  /// Settles the ways for a step from where the vertices stand. `forces`: D numbers a free vertex, the way in which what is minimised falls
  /// fastest; read for bound vertices alone.
  virtual void choose(std::span<const double> forces) = 0;
  /// Puts the bound vertices of a trial back. `from`: where all stand. False: the trial cannot be.
  [[nodiscard]] virtual bool put_back(const std::vector<Place>& from, std::vector<Place>& trial) = 0;
  /// The vertices now stand where the last trial put them.
  virtual void take() = 0;
  /// Where they stand is the best place so far.
  virtual void keep_best() = 0;
};

}  // namespace dmoscope
