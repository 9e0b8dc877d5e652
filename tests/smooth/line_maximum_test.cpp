// The best place on a line against places tried one by one, for fractions of every kind.

#include "core/smooth/line_maximum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

double least_of(const std::vector<LineFraction>& fractions, double t) {
  double least = std::numeric_limits<double>::infinity();
  for (const LineFraction& q : fractions) least = std::min(least, q.value(t));
  return least;
}

/// Positive at 0, with a denominator that nowhere is 0; its highest place anywhere, left or right.
LineFraction random_fraction(testing::Random& random) {
  const double middle = random(-1.5, 1.5), c = random(0.2, 3), depth = random(0.05, 3);
  return {random(-1, 1), random(0.1, 1), c, -2 * c * middle, c * middle * middle + depth};
}

TEST(LineMaximum, IsTheBestOfManyPlaces) {
  testing::Random random(71);
  int alone = 0, inside = 0;
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<LineFraction> fractions;
    double low = -4, high = 4;  // an interval where all are positive
    for (int k = 0; k <= trial % 8; ++k) {
      const LineFraction q = random_fraction(random);
      if (q.a < 0) high = std::min(high, -q.b / q.a);
      if (q.a > 0) low = std::max(low, -q.b / q.a);
      fractions.push_back(q);
    }
    if (trial % 3 == 0) fractions.push_back({0, random(0.2, 1), 0, 0, 1});  // a constant
    if (trial % 5 == 0) fractions.push_back(fractions.front());             // one of them twice
    const double t = maximise_least(fractions, low, high), found = least_of(fractions, t);
    ASSERT_TRUE(t >= low && t <= high);
    double best = 0, at = 0;
    constexpr int kSamples = 20000;
    for (int i = 0; i <= kSamples; ++i) {
      const double place = low + (high - low) * i / kSamples, value = least_of(fractions, place);
      if (value > best) best = value, at = place;
    }
    EXPECT_GE(found, best - 1e-12) << trial << ": " << t << " instead of " << at;
    // Bounds at the maximum: one alone at its own top, or two that cross.
    const auto bounding = std::ranges::count_if(fractions, [&](const LineFraction& q) { return q.value(t) < found + 1e-9; });
    (bounding == 1 ? alone : inside) += 1;
  }
  EXPECT_GT(alone, 40);
  EXPECT_GT(inside, 40);
}

TEST(LineMaximum, OfLinesIsWhereTheyCross) {
  const std::vector<LineFraction> lines{{1, -2, 0, 0, 1}, {-3, 4, 0, 0, 1}, {0.5, 3, 0, 0, 1}};
  EXPECT_NEAR(maximise_least(lines, -4, 4), 1.5, 1e-15);
  EXPECT_NEAR(maximise_least(std::vector<LineFraction>{lines[0]}, -4, 4), 4, 0) << "as far as it may";
  EXPECT_EQ(maximise_least(std::vector<LineFraction>{{0, 1, 0, 0, 1}}, -4, 4), 0) << "no reason to go anywhere";
}

}  // namespace
}  // namespace dmoscope
