// Initial range of the colours: the input's qualities, by counting.

#include "core/view/input_spread.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/quality/quality.h"
#include "core/view/judging.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using Pair = std::pair<double, double>;

TEST(InputSpread, IsOfTheSoundElements) {
  Mesh mesh = testing::lattice(12, 0.45, 5);
  mesh.positions[80] = mesh.positions[0];  // far over other elements
  const auto input = testing::input(std::move(mesh));
  for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle}) {
    const QualityContext context = input->quality_context();
    std::vector<double> sound;
    std::size_t inverted = 0;
    for (Index e = 0; e < input->mesh.elements.size(); ++e) {
      if (smallest_jacobian(context, input->mesh.positions, e) <= 0.0) {
        ++inverted;
      } else {
        sound.push_back(element_quality(context, input->mesh.positions, metric, e));
      }
    }
    ASSERT_GT(inverted, 0U);
    std::ranges::sort(sound);
    const InputSpread spread = spread_of(*input, metric, nullptr);
    EXPECT_EQ(spread.count, sound.size());
    EXPECT_EQ(spread.range(), (Pair{sound.front(), sound.back()}));
    const Pair middle = *spread.percentiles(10.0, 90.0);
    const auto rank = [&](double percent) {
      return sound[static_cast<std::size_t>(std::ceil(percent / 100.0 * static_cast<double>(sound.size()))) - 1];
    };
    EXPECT_NEAR(middle.first, rank(10.0), 1.0 / InputSpread::kBins);
    EXPECT_LE(middle.first, rank(10.0));
    EXPECT_NEAR(middle.second, rank(90.0), 1.0 / InputSpread::kBins);
    EXPECT_GE(middle.second, rank(90.0));
    EXPECT_EQ(spread.percentiles(0.0, 100.0)->second, sound.back());
  }
  EXPECT_FALSE(InputSpread{}.range().has_value());
  EXPECT_FALSE(InputSpread{}.percentiles(2, 98).has_value());
}

TEST(InputSpread, FewGoodElementsTakeNoColoursFromAllOthers) {
  InputSpread poor;
  for (int k = 1; k <= 96; ++k) poor.add(0.004 * k);
  for (int k = 0; k < 4; ++k) poor.add(0.7 + 0.1 * k);
  EXPECT_EQ(*poor.range(), (Pair{0.004, 1.0}));
  EXPECT_EQ(poor.range_without_tail()->first, 0.004) << "the worst always has a colour of its own";
  EXPECT_NEAR(poor.range_without_tail()->second, 0.38, 0.0015) << "the upper edge of its bin";
  for (int k = 0; k < 3; ++k) poor.add(0.7);  // more than 5 % are good now
  EXPECT_EQ(poor.range_without_tail(), poor.range());
  EXPECT_FALSE(InputSpread{}.range_without_tail().has_value());
}

TEST(TidyRange, IsRoundedOutwards) {
  EXPECT_EQ(tidy_range({0.65283, 0.99998}), (Pair{0.65, 1.0}));
  EXPECT_EQ(tidy_range({0.0036, 0.9999}), (Pair{0.0, 1.0}));
  EXPECT_EQ(tidy_range({0.2680, 0.99}), (Pair{0.2, 1.0}));
  EXPECT_EQ(tidy_range({0.9412, 0.9999}), (Pair{0.94, 1.0}));
  EXPECT_EQ(tidy_range({static_cast<double>(0.7F), 1.0}), (Pair{0.7, 1.0})) << "in float 0.7 is a hair less";
}

TEST(TidyRange, OfNextToNothingIsWidened) {
  for (const Pair& narrow : {Pair{1.0, 1.0}, {0.5, 0.5}, {0.0, 0.0}, {0.99999, 1.0}, {0.0, 1e-9}}) {
    const auto [low, high] = tidy_range(narrow);
    EXPECT_LE(low, narrow.first);
    EXPECT_GE(high, narrow.second - 1e-6);
    EXPECT_GE(high - low, 0.0199);
    EXPECT_LE(high - low, 0.031);
    EXPECT_GE(low, 0.0);
  }
  EXPECT_EQ(tidy_range({1.0, 1.0}), (Pair{0.98, 1.0})) << "an ideal mesh has the colours of good elements";
}

TEST(TidyRange, HoldsWhatItIsOf) {
  testing::Random random(11);
  for (int k = 0; k < 2000; ++k) {
    const double a = random(0.0, 1.0), b = random(0.0, 1.0);
    const Pair range{std::min(a, b), std::max(a, b)};
    const auto [low, high] = tidy_range(range);
    EXPECT_LE(low, range.first + 2e-7);
    EXPECT_GE(high, range.second - 2e-7);
    EXPECT_LE(high - low, std::max(0.03, 1.6 * (range.second - range.first)));
  }
}

}  // namespace
}  // namespace dmoscope
