// The search's formulas decide about a move only if rounding cannot.

#include <gtest/gtest.h>

#include "core/smooth/methods/composite_star_kernel.h"

namespace dmoscope {
namespace {

TEST(CompositeComparison, IsUnsureWhereRoundingMayDecide) {
  for (const double value : {1e-3, 0.5, 1.0}) {
    EXPECT_EQ(compare(value, value), Certainty::Unsure);
    EXPECT_EQ(compare(value * (1.0 + 1e-12), value), Certainty::Unsure);
    EXPECT_EQ(compare(value * (1.0 - 1e-12), value), Certainty::Unsure);
    EXPECT_EQ(compare(value * (1.0 + 1e-6), value), Certainty::Greater);
    EXPECT_EQ(compare(value * (1.0 - 1e-6), value), Certainty::Less);
  }
}

TEST(CompositeComparison, GoesOnToTheSecondAimBeyondTheThresholdAlone) {
  const BeforeAndAfter up{0.4, 0.6}, down{0.6, 0.4}, same{0.5, 0.5}, flat{1e-9, 0.5};
  const auto gains = [](BeforeAndAfter first, BeforeAndAfter second) { return gains_for_certain(0.3, first, [&] { return second; }); };
  const auto below = [](BeforeAndAfter first, BeforeAndAfter second) { return gains_for_certain(0.9, first, [&] { return second; }); };
  EXPECT_EQ(below(up, down), std::optional(true));
  EXPECT_EQ(below(down, up), std::optional(false));
  EXPECT_EQ(below(same, up), std::nullopt);
  EXPECT_EQ(gains(down, up), std::optional(true)) << "beyond the threshold the first aim may fall";
  EXPECT_EQ(gains(up, down), std::optional(false));
  EXPECT_EQ(gains(up, same), std::nullopt);
  EXPECT_EQ(gains({0.5, 0.2}, up), std::optional(false)) << "but not to below it";
  EXPECT_EQ(gains({0.5, 0.3}, up), std::nullopt);
  EXPECT_EQ(gains({0.3, 0.5}, up), std::nullopt);
  EXPECT_EQ(gains(flat, up), std::nullopt);
  EXPECT_EQ(gains(up, flat), std::nullopt);
}

}  // namespace
}  // namespace dmoscope
