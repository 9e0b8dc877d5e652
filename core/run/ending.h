#pragma once
// Facts that a person should know of a run that has come to its end: elements that stay inverted, a better iteration before, the fall of
// the mean, and phases that never began.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

struct LeftInverted {
  InvertedCount all{};
  Index element = kNoIndex;      // the most inverted element: that of least corner Jacobian over its reference measure
  std::optional<Vec3> inside{};  // the place inside it where it is inverted, if its corners are not
  Index vertex = kNoIndex;       // the vertex of the most inverted elements; a fixed one before a free one, then the lowest
  Index around = 0;              // number of inverted elements around that vertex
  Vec3 place{};                  // position of that vertex
  std::string why_fixed{};       // see Run::why_fixed
  /// Sentence for a person: "3 elements stay inverted. Look at element 17 and at vertex 4 at (1.5, 2), which is in 3 of them; it lies on
  /// the boundary, which stays."
  [[nodiscard]] std::string sentence() const;
};

/// Returns none where no element is inverted. Brings the positions to the host; costs a look at each element.
[[nodiscard]] std::optional<LeftInverted> find_left_inverted(const Run& run);

/// The best iteration that a run passed through: see BestState.
[[nodiscard]] std::uint64_t best_iteration(const Run& run);

/// Warning that goes with methods that do not optimise, wherever they are chosen or described.
inline constexpr std::string_view kMayMakeWorse = "may make elements worse";

/// Name of an iteration: "the start" for 0, else "iteration 12".
[[nodiscard]] std::string iteration_name(std::uint64_t iteration);

/// Warning: "laplace may make elements worse: the best it passed through is iteration 2, not iteration 202"; empty for a method that
/// optimises, and where the best is the last.
[[nodiscard]] std::string worse_than_best(const RunParameters& parameters, std::uint64_t best, std::uint64_t last);

/// Minimum and mean at the end of an iteration, against the input: "minimum 0.301 -> 0.428, mean 0.781 -> 0.654".
[[nodiscard]] std::string course_text(std::span<const IterationRecord> records, std::uint64_t iteration);

/// Sentence on the mean: "the mean fell from 0.957 (iteration 2) to 0.844 for the sake of the worst element; a second phase raises it and
/// keeps the minimum". Empty where the mean has not fallen by more than 0.005 since no element has been inverted, and for a run that raises
/// the mean, has two aims, or does not optimise. `iteration`: the one at whose end the run stands.
[[nodiscard]] std::string mean_given_up(const RunParameters& parameters, std::span<const IterationRecord> records, std::uint64_t iteration);

/// Says what a method that does not optimise made worse: "laplace made elements worse: the minimum fell from 0.653 to 0.573". Empty where
/// neither the minimum has fallen nor more elements are inverted than at the input.
[[nodiscard]] std::string made_worse(const RunParameters& parameters, std::span<const IterationRecord> records, std::uint64_t iteration);

/// Sentences for the phases that were asked for and never began, with a remedy each, as the command line names it; usually none.
[[nodiscard]] std::vector<std::string> missing_phases(const Run& run);

}  // namespace dmoscope
