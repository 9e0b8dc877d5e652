#pragma once
// What a person should look at where elements stay inverted.

#include <optional>
#include <string>
#include <string_view>

#include "core/run/run.h"

namespace dmoscope {

struct LeftInverted {
  InvertedCount all{};
  Index element = kNoIndex;      // the most inverted one: of least corner Jacobian over its reference measure
  std::optional<Vec3> inside{};  // where, if its corners do not tell
  Index vertex = kNoIndex;       // the vertex of the most inverted elements; a fixed one before a free one, then the lowest
  Index around = 0;              // of how many
  Vec3 place{};                  // where it stands
  std::string why_fixed{};       // see Run::why_fixed
  /// "3 elements stay inverted. Look at element 17 and at vertex 4 at (1.5, 2), which is in 3 of them; it lies on the boundary, which
  /// stays."
  [[nodiscard]] std::string sentence() const;
};

/// None where no element is inverted. Brings the positions; costs a look at each element.
[[nodiscard]] std::optional<LeftInverted> find_left_inverted(const Run& run);

/// The best iteration that a run passed through: see BestState.
[[nodiscard]] std::uint64_t best_iteration(const Run& run);

/// What is said of the methods that do not optimise, wherever they are chosen or told of.
inline constexpr std::string_view kMayMakeWorse = "may make elements worse";

/// "the input itself" of 0, else "iteration 12"
[[nodiscard]] std::string iteration_name(std::uint64_t iteration);

/// "laplace may make elements worse: the best it passed through is iteration 2, not iteration 202"; empty of a method that optimises, and
/// where the best is the last.
[[nodiscard]] std::string worse_than_best(const RunParameters& parameters, std::uint64_t best, std::uint64_t last);

}  // namespace dmoscope
