#include "core/drawing/ticks.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace dmoscope {
namespace {

TEST(Ticks, LinearStepsAreOneTwoOrFiveTimesAPowerOfTen) {
  for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-3.7, 12.1}, {0.6528, 0.8123}, {1e-7, 3e-7}, {1e6, 1e6 + 7}}) {
    for (const int most : {2, 5, 9}) {
      const auto ticks = linear_ticks(low, high, most);
      ASSERT_FALSE(ticks.empty()) << low << " " << high << " " << most;
      EXPECT_LE(ticks.size(), static_cast<std::size_t>(most) + 1);
      for (const Tick& tick : ticks) {
        EXPECT_GE(tick.value, low - 1e-9 * (high - low));
        EXPECT_LE(tick.value, high + 1e-9 * (high - low));
      }
      if (ticks.size() < 2) continue;
      const double step = ticks[1].value - ticks[0].value;
      const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-3 || std::abs(mantissa - 2) < 1e-3 || std::abs(mantissa - 5) < 1e-3) << step;
    }
  }
}

TEST(Ticks, LabelsAreDistinctAndEquallyLong) {
  const auto ticks = linear_ticks(0.6528, 0.8123, 8);
  ASSERT_GE(ticks.size(), 3U);
  for (std::size_t k = 1; k < ticks.size(); ++k) {
    EXPECT_NE(ticks[k].label, ticks[k - 1].label);
    EXPECT_EQ(ticks[k].label.size(), ticks[0].label.size());
  }
  EXPECT_EQ(linear_ticks(0, 1, 5)[1].label, "0.2");
}

TEST(Ticks, ALogarithmFromZeroHasZeroAndIsThinnedByRoom) {
  const auto values = [](double low, double high, double pivot, int most) {
    std::vector<double> all;
    for (const Tick& tick : log_ticks_from_zero(low, high, pivot, most)) all.push_back(tick.value);
    return all;
  };
  EXPECT_EQ(values(0, 220, 1, 14), (std::vector<double>{0, 1, 2, 5, 10, 20, 50, 100, 200}));
  const auto few = values(0, 10'000, 1, 5);
  EXPECT_LE(few.size(), 7U);
  EXPECT_EQ(few.front(), 0.0);
  EXPECT_TRUE(std::ranges::find(few, 1000.0) != few.end()) << "powers of ten before others";
  EXPECT_TRUE(values(0, 1.2, 1, 12).empty()) << "too short: evenly, then";
  EXPECT_TRUE(values(0, 10, 0, 12).empty());
  for (const double value : values(0.0, 3.0, 0.01, 9)) EXPECT_TRUE(value == 0.0 || value >= 0.01);
}

TEST(Ticks, NothingForAnEmptyOrInfiniteRange) {
  EXPECT_TRUE(linear_ticks(1, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(2, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(NAN, 1, 5).empty());
  EXPECT_TRUE(linear_ticks(0, INFINITY, 5).empty());
  EXPECT_TRUE(log_ticks(0, 1, 5).empty());
  EXPECT_TRUE(log_ticks(-1, 1, 5).empty());
}

TEST(Ticks, IterationsAreWholeNumbers) {
  for (const double high : {1.0, 3.0, 12.0, 1000.0}) {
    for (const Tick& tick : integer_ticks(0, high, 10)) EXPECT_EQ(tick.value, std::round(tick.value));
  }
}

TEST(Ticks, LogarithmicOnesStandAtPowersOfTen) {
  const auto ticks = log_ticks(1e-6, 1.0, 10);
  std::size_t labelled = 0;
  for (const Tick& tick : ticks) {
    if (tick.label.empty()) continue;
    ++labelled;
    EXPECT_NEAR(std::log10(tick.value), std::round(std::log10(tick.value)), 1e-9);
  }
  EXPECT_EQ(labelled, 7U);
  EXPECT_LE(log_ticks(1e-200, 1.0, 8).size(), 10U);
}

TEST(Ticks, AShortLogarithmicStretchHasTwoLabelsAtLeast) {
  for (const auto& [low, high] : {std::pair{0.62, 1.6}, {0.95, 1.05}, {3.1, 4.9}, {1100.0, 1900.0}, {0.04, 25.0}}) {
    std::size_t labelled = 0;
    for (const Tick& tick : log_ticks(low, high, 2)) {
      EXPECT_GE(tick.value, low);
      EXPECT_LE(tick.value, high);
      labelled += tick.label.empty() ? 0 : 1;
    }
    EXPECT_GE(labelled, 2U) << low << " to " << high;
  }
}

std::vector<double> ramp(std::size_t size) {
  std::vector<double> x(size);
  for (std::size_t k = 0; k < size; ++k) x[k] = static_cast<double>(k);
  return x;
}

TEST(Decimation, KeepsEveryPeakAndFewPoints) {
  constexpr std::size_t kSize = 200000, kColumns = 500;
  const std::vector<double> x = ramp(kSize);
  std::vector<double> y(kSize);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-1, 1);
  for (double& value : y) value = noise(random);
  y[123456] = 50;  // a peak and a pit that sampling must not lose
  y[98765] = -60;
  const auto strokes = decimate(x, y, 0, kSize - 1.0, kColumns);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_LE(strokes[0].size(), 4 * (kColumns + 1));
  double low = 0, high = 0;
  for (std::size_t k = 0; k < strokes[0].size(); ++k) {
    low = std::min(low, strokes[0][k].y);
    high = std::max(high, strokes[0][k].y);
    if (k > 0) {
      EXPECT_LT(strokes[0][k - 1].x, strokes[0][k].x);
    }
  }
  EXPECT_EQ(high, 50);
  EXPECT_EQ(low, -60);
}

TEST(Decimation, ShortSeriesComeBackWhole) {
  const std::vector<double> x = ramp(10), y{5, 3, 8, 1, 9, 2, 7, 3, 6, 4};
  const auto strokes = decimate(x, y, 0, 9, 1000);
  ASSERT_EQ(strokes.size(), 1U);
  ASSERT_EQ(strokes[0].size(), 10U);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_EQ(strokes[0][k].y, y[k]);
}

TEST(Decimation, NotANumberIsAGap) {
  const std::vector<double> x = ramp(7), y{1, 2, NAN, 4, 5, INFINITY, 7};
  const auto strokes = decimate(x, y, 0, 6, 100);
  ASSERT_EQ(strokes.size(), 3U);
  EXPECT_EQ(strokes[0].size(), 2U);
  EXPECT_EQ(strokes[1].size(), 2U);
  EXPECT_EQ(strokes[2].size(), 1U);
}

TEST(Decimation, KeepsOneNeighbourBeyondEitherEnd) {
  const std::vector<double> x = ramp(100), y(100, 1.0);
  const auto strokes = decimate(x, y, 40.5, 60.5, 50);
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes[0].front().x, 40);
  EXPECT_EQ(strokes[0].back().x, 61);
  EXPECT_TRUE(decimate({}, {}, 0, 1, 10).empty());
}

}  // namespace
}  // namespace dmoscope
