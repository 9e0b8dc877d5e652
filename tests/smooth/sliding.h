#pragma once
// Runs in which vertices slide, and properties of places along curves.

#include "core/reference/domain.h"
#include "tests/smooth/promises.h"

namespace dmoscope::testing {

inline RunParameters sliding_by(double max_deviation = 1e-3) {
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  parameters.max_deviation = max_deviation;
  return parameters;
}

/// Expects places along every curve to rise strictly from one corner to the next, and around a closed one by its length.
inline void expect_in_order(const Specimen& specimen, const dmoscope::Run& run) {
  const Curves& curves = run.domain()->curves();
  for (Index v = 0; v < run.positions().size(); ++v) {
    if (!curves.slides(v)) continue;
    const auto place = curves.place(v, run.positions()[v]);
    ASSERT_TRUE(place) << specimen.name << ": vertex " << v;
    const auto beside = curves.neighbours(v, *place, run.positions());
    ASSERT_TRUE(beside) << specimen.name << ": vertex " << v;
    ASSERT_LT(beside->place_before, *place) << specimen.name << ": vertex " << v;
    ASSERT_LT(*place, beside->place_after) << specimen.name << ": vertex " << v;
  }
}

/// Number of sliding vertices that have left their places in the input.
inline std::size_t slid(const dmoscope::Run& run) {
  std::size_t moved = 0;
  const std::span<const Vec3> before = run.input().mesh.positions;
  for (Index v = 0; v < before.size(); ++v)
    moved += run.domain()->slides(v) && !same_bits(run.positions().subspan(v, 1), before.subspan(v, 1)) ? 1 : 0;
  return moved;
}

}  // namespace dmoscope::testing
