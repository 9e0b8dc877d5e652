#include "core/numeric/arc_tangent.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

/// Error in units in the last place of the result.
double error(double y, double x) {
  const long double exact = std::atan2(static_cast<long double>(y), static_cast<long double>(x));
  const double near = std::fabs(static_cast<double>(exact));
  const double unit = std::nextafter(near, HUGE_VAL) - near;
  return static_cast<double>(std::fabs(static_cast<long double>(scalar::arc_tangent(y, x)) - exact)) / unit;
}

TEST(ArcTangent, IsNearTheExactAngle) {
  testing::Random random(91);
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double y = random(-1.0, 1.0) * std::exp2(random(-40.0, 40.0)), x = random(-1.0, 1.0) * std::exp2(random(-40.0, 40.0));
    worst = std::max({worst, error(y, x), error(random(-1.0, 1.0), random(-1.0, 1.0))});
  }
  EXPECT_LE(worst, 3.0);
  for (int i = -64; i <= 64; ++i) EXPECT_LE(error(i / 64.0, 1.0), 3.0) << i;  // the known angles and the middles between them
}

TEST(ArcTangent, OnTheAxesAndBeyond) {
  EXPECT_EQ(scalar::arc_tangent(0.0, 0.0), 0.0);
  EXPECT_EQ(scalar::arc_tangent(0.0, 5.0), 0.0);
  EXPECT_EQ(scalar::arc_tangent(0.0, -5.0), std::atan2(0.0, -5.0));
  EXPECT_EQ(scalar::arc_tangent(5.0, 0.0), std::atan2(5.0, 0.0));
  EXPECT_EQ(scalar::arc_tangent(-5.0, 0.0), std::atan2(-5.0, 0.0));
  EXPECT_EQ(scalar::arc_tangent(2.0, 2.0), std::atan2(2.0, 2.0));
  EXPECT_TRUE(std::isnan(scalar::arc_tangent(std::nan(""), 1.0)));
  EXPECT_TRUE(std::isnan(scalar::arc_tangent(1.0, std::nan(""))));
}

}  // namespace
}  // namespace dmoscope
