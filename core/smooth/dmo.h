#pragma once
// DMO on the CPU (paper, Algorithm 1): the grid search for each vertex, confirmed in double before the vertex moves.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// How good a star is, judged in double by the very functions of the statistics. While one of its elements is inverted its smallest
/// normalised Jacobian counts, afterwards its least metric.
struct StarState {
  double jacobian = 0.0;  // least of smallest corner Jacobian / reference measure
  double quality = 0.0;   // least metric (paper eq. 1)
  /// Strictly better: what a move must be (promise 1).
  [[nodiscard]] bool better_than(const StarState& other) const noexcept {
    if (other.jacobian <= 0.0) return jacobian > other.jacobian;
    return jacobian > 0.0 && quality > other.quality;
  }
};
[[nodiscard]] StarState star_state(const InputMesh& input, PositionView positions, Metric metric, Index vertex);

/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_dmo_smoother(std::shared_ptr<const InputMesh> input,
                                                          std::shared_ptr<const Colouring> colouring, Metric metric,
                                                          const SearchParameters& parameters, ThreadPool* pool);

}  // namespace dmoscope
