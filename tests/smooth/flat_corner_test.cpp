// Quadrilaterals with corners that are flat up to rounding: differences between float and double there must not break promise 1.

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/run/run.h"
#include "core/smooth/methods/dmo.h"
#include "tests/smooth/zoo.h"

namespace dmoscope {
namespace {

/// Stars of four quadrilaterals; in each one a corner, either across from the hub or beside it, is bent by about `bend`.
Mesh nearly_flat(double bend, std::uint64_t seed) {
  Mesh mesh = testing::stars(std::vector<std::vector<int>>(200, std::vector<int>(4, 4)), seed);
  testing::Random random(seed + 1);
  for (Index i = 0; i < 200; ++i) {
    Vec3* const p = mesh.positions.data() + static_cast<std::size_t>(i) * 9;  // hub, ring, outer corners
    const Vec3 hub = p[0], b = p[1], d = p[2];
    const double by = random(-bend, bend);
    const Vec3 along = i % 2 == 0 ? d - b : b - hub, across{-along.y, along.x, 0};
    p[5] = i % 2 == 0 ? b + random(0.3, 0.7) * along + by * across : b + random(0.4, 0.9) * along + by * across;
  }
  return mesh;
}

TEST(FlatCorners, AreJudgedInDoubleAlone) {
  Progress progress;
  for (const Metric metric : {Metric::MeanRatio, Metric::MeanRatioArea, Metric::ScaledJacobian})
    for (const double bend : {0.0, 1e-16, 1e-12, 1e-9, 1e-7, 1e-5})
      for (std::uint64_t seed = 90; seed < 94; ++seed) {
        const auto mesh = testing::input(nearly_flat(bend, seed));
        RunParameters parameters;
        parameters.metric = metric;
        dmoscope::Run run(mesh, parameters, std::make_shared<ThreadPool>(1), std::size_t{1} << 28U);
        for (int iteration = 0; iteration < 4; ++iteration) {
          const std::vector<Vec3> old(run.positions().begin(), run.positions().end());
          const Untangling rule = run.sweep().untangling;
          const std::uint64_t moved = run.step(StepUnit::Iteration, progress);
          std::uint64_t changed = 0;
          for (const Index v : run.colouring().order) {  // no two hubs share an element
            if (old[v] == run.positions()[v]) continue;
            ++changed;
            const StarState before = star_state(*mesh, old, metric, v), after = star_state(*mesh, run.positions(), metric, v);
            EXPECT_TRUE(after.better_than(before, rule))
                << info(metric).name << ", " << bend << ": vertex " << v << " from " << before.jacobian << ' ' << before.quality << " to "
                << after.jacobian << ' ' << after.quality;
          }
          EXPECT_EQ(moved, changed) << info(metric).name << ", " << bend;
        }
      }
}

}  // namespace
}  // namespace dmoscope
