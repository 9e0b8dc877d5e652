// Ranks of the fast search order elements as their metrics do.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/quality/formulas.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using V = Vec2<double>;

/// A corner on a lattice of 128 per unit: floats hold it and all products exactly, so that float and double see the same signs.
V random_point(testing::Random& random, double reach) {
  return {std::round(random(-reach, reach) * 128) / 128, std::round(random(-reach, reach) * 128) / 128};
}

struct Judged {
  double metric, rank;
  float rank_in_float;
};

template <Metric M>
std::vector<Judged> judged_elements() {
  testing::Random random(81);
  std::vector<Judged> all;
  const auto cast = [](V p) { return Vec2<float>{static_cast<float>(p.x), static_cast<float>(p.y)}; };
  for (int trial = 0; trial < 20000; ++trial) {
    const double reach = trial % 2 == 0 ? 1.0 : 0.1;  // the smaller reach often degenerates
    const V a = random_point(random, 1), b = a + random_point(random, reach), c = a + random_point(random, reach),
            d = random_point(random, 1);
    const formulas::Triangle<V> t(a, b, c);
    all.push_back({formulas::Formula<M>::triangle(t), formulas::rank<M>(t),
                   formulas::rank<M>(formulas::Triangle<Vec2<float>>(cast(a), cast(b), cast(c)))});
    if constexpr (formulas::kDefinedForQuadrilaterals<M, V>) {
      const formulas::Quadrilateral<V> q(a, b, c, d);
      all.push_back({formulas::Formula<M>::quadrilateral(q), formulas::rank<M>(q),
                     formulas::rank<M>(formulas::Quadrilateral<Vec2<float>>(cast(a), cast(b), cast(c), cast(d)))});
    }
  }
  return all;
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

TEST(Rank, RisesWithTheMetricAndHasItsSign) {
  for (const MetricInfo& entry : metric_table())
    formulas::with_planar_metric(entry.metric, [&]<Metric M>() {
      SCOPED_TRACE(entry.name);
      auto all = judged_elements<M>();
      std::ranges::sort(all, {}, &Judged::metric);
      EXPECT_LT(all.front().metric, -0.9);
      EXPECT_GT(all.back().metric, 0.9);
      double highest = all.front().rank;
      for (const Judged& element : all) {
        EXPECT_EQ(sign(element.rank), sign(element.metric)) << element.metric;
        EXPECT_EQ(sign(element.rank_in_float), sign(element.metric)) << element.metric;
        // Both numbers may err, in the metric's last digits too.
        EXPECT_GE(element.rank, highest - 2 * formulas::rank_doubt<M>(std::fabs(element.rank))) << element.metric;
        EXPECT_NEAR(element.rank_in_float, element.rank, 1e-7 + 2e-6 * std::fabs(element.rank)) << element.metric;
        highest = std::max(highest, element.rank);
      }
    });
}

TEST(RightAngles, AreTheArcTangent) {
  testing::Random random(82);
  const auto expect_close = [](double y, double x) {
    const double expected = std::atan2(y, x) / (M_PI / 2);
    EXPECT_NEAR(formulas::right_angles(y, x), expected, 3e-8) << y << ' ' << x;
    const float fy = static_cast<float>(y), fx = static_cast<float>(x);
    EXPECT_NEAR(formulas::right_angles(fy, fx), std::atan2(double{fy}, double{fx}) / (M_PI / 2), 3e-8 + 2e-7) << y << ' ' << x;
  };
  for (int i = 0; i <= 100000; ++i) {
    expect_close(i * 1e-5, 1);
    expect_close(1, i * 1e-5);
  }
  for (int trial = 0; trial < 10000; ++trial) expect_close(std::exp(random(-20, 20)), std::exp(random(-20, 20)));
  EXPECT_EQ(formulas::right_angles(0.0, 1.0), 0.0);
  EXPECT_EQ(formulas::right_angles(1.0, 0.0), 1.0);
}

}  // namespace
}  // namespace dmoscope
