// Contours against shapes with known places.
#include "ui/analysis/contours.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace dmoscope::ui {
namespace {

constexpr int kSide = 64;

template <class F>
std::vector<float> field(F f) {
  std::vector<float> values;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) values.push_back(static_cast<float>(f(column, row)));
  }
  return values;
}

double length_of(const std::vector<ContourPiece>& pieces) {
  double sum = 0.0;
  for (const ContourPiece& piece : pieces) sum += std::hypot(piece.to.x - piece.from.x, piece.to.y - piece.from.y);
  return sum;
}

TEST(Contours, OfACircleLieOnItAndGoOnceAround) {
  const auto cone = field([](double x, double y) { return std::hypot(x - 31.3, y - 30.8); });
  const auto pieces = contour(cone, kSide, kSide, 20.0);
  ASSERT_FALSE(pieces.empty());
  for (const ContourPiece& piece : pieces) {
    for (const Vec2<double> end : {piece.from, piece.to}) EXPECT_NEAR(std::hypot(end.x - 31.3, end.y - 30.8), 20.0, 0.01);
  }
  EXPECT_NEAR(length_of(pieces), 2 * std::numbers::pi * 20.0, 0.1);
}

TEST(Contours, OfASlopeAreAStraightLineWhereTheValueIs) {
  const auto slope = field([](double x, double) { return 3.0 * x; });
  const auto pieces = contour(slope, kSide, kSide, 61.0);
  EXPECT_EQ(pieces.size(), std::size_t{kSide - 1});
  for (const ContourPiece& piece : pieces) {
    EXPECT_NEAR(piece.from.x, 61.0 / 3.0, 1e-5);
    EXPECT_NEAR(piece.to.x, 61.0 / 3.0, 1e-5);
  }
}

TEST(Contours, CellsWithAnUndefinedCornerAreLeftOut) {
  auto slope = field([](double x, double) { return x; });
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int column = 0; column < kSide; ++column) slope[static_cast<std::size_t>(10 * kSide + column)] = nan;
  const auto pieces = contour(slope, kSide, kSide, 5.5);
  EXPECT_EQ(pieces.size(), std::size_t{kSide - 1 - 2});
  for (const ContourPiece& piece : pieces)
    EXPECT_TRUE(std::max(piece.from.y, piece.to.y) <= 9.0 || std::min(piece.from.y, piece.to.y) >= 11.0);
}

TEST(Contours, ASaddleIsCutAsItsMiddleSays) {
  // Corners are high at the lower left and the upper right; the middle, the mean of the four, is high in the first and low in the second.
  const std::vector<float> joined{1.0F, -0.2F, -0.2F, 1.0F}, parted{0.2F, -1.0F, -1.0F, 0.2F};
  for (const bool high_middle : {true, false}) {
    const auto pieces = contour(high_middle ? joined : parted, 2, 2, 0.0);
    ASSERT_EQ(pieces.size(), 2U);
    for (const ContourPiece& piece : pieces) {
      // Pieces run around a low corner if the high ones are joined, else around a high one: corners (1, 0) and (0, 1) are low.
      const double x = (piece.from.x + piece.to.x) / 2, y = (piece.from.y + piece.to.y) / 2;
      EXPECT_EQ((x > 0.5) != (y > 0.5), high_middle) << x << " " << y;
    }
  }
}

TEST(Contours, NothingOutsideTheRange) {
  const auto slope = field([](double x, double y) { return x + y; });
  EXPECT_TRUE(contour(slope, kSide, kSide, -1.0).empty());
  EXPECT_TRUE(contour(slope, kSide, kSide, 1000.0).empty());
}

}  // namespace
}  // namespace dmoscope::ui
