// Range of qualities that the colours span: at the start, through a run, by the menu on the bar, and after a restart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/commands/settings.h"
#include "ui/commands/view_json.h"

namespace dmoscope::ui {
namespace {

using Pair = std::pair<double, double>;

class RangeWindow : public app::HeadlessTest {
 protected:
  [[nodiscard]] Pair range() { return window_->app().colour_range(); }
};

TEST_F(RangeWindow, StartsFromTheInputAndStaysThroughARun) {
  good("generate annulus 400");
  EXPECT_EQ(state().range_mode, RangeMode::Input);
  EXPECT_EQ(state().colour_map, render::ColourMap::Beacon);
  const auto input = session()->frame->input_spread;
  ASSERT_TRUE(input);
  const Pair whole = *input->range(), first = range();
  EXPECT_EQ(first, tidy_range(whole));
  EXPECT_LE(first.first, whole.first);
  EXPECT_GE(first.second + 1e-6, whole.second);
  good("run 5");
  EXPECT_GT(session()->frame->shown_statistics.minimum, whole.first);
  EXPECT_EQ(range(), first) << "colours of before and after can be compared";
  good("viewports 2");
  EXPECT_EQ(range(), first);
  good("show min-angle");
  EXPECT_EQ(range(), tidy_range(*session()->frame->input_spread->range())) << "of the metric that is shown";
  good("show mean-ratio");
  EXPECT_EQ(range(), first);
}

TEST_F(RangeWindow, SpendsNoColoursOnWhatThereIsNot) {
  good("generate globe");
  ASSERT_NEAR(session()->frame->shown_statistics.minimum, 0.3242, 1e-4);
  EXPECT_EQ(range(), (Pair{0.3, 1.0}));
}

TEST_F(RangeWindow, InvertedElementsAreApart) {
  good("generate tangled 400 3");
  ASSERT_GT(session()->frame->shown_statistics.inverted, 0U);
  ASSERT_LT(session()->frame->shown_statistics.minimum, 0.0);
  EXPECT_EQ(range(), tidy_range(*session()->frame->input_spread->range()));
}

TEST_F(RangeWindow, TheMenuOfTheBarOffersAllOthers) {
  good("generate annulus 400");
  const Pair own = *own_range(*session()->frame);
  for (const RangeModeInfo& one : kRangeModes) {
    if (one.mode == RangeMode::Given) continue;
    good("click range:mode");
    good(fmt::format("click range-menu:{}", one.name));
    EXPECT_EQ(state().range_mode, one.mode) << one.name;
    if (one.mode == RangeMode::Fixed) {
      EXPECT_EQ(range(), (Pair{0.0, 1.0}));
    }
    if (one.mode == RangeMode::Auto || one.mode == RangeMode::Expanding) {
      EXPECT_EQ(range(), own);
    }
    if (one.mode == RangeMode::Percentile) {
      EXPECT_EQ(range(), tidy_range(*session()->frame->input_spread->percentiles(2, 98)));
    }
  }
  good("range percentile 10 60");
  EXPECT_EQ(range(), tidy_range(*session()->frame->input_spread->percentiles(10, 60)));
  EXPECT_LT(range().second, tidy_range(own).second);
  for (const char* wrong : {"range", "range some", "range percentile 5", "range percentile 60 10", "range percentile -1 10", "range 1 0"}) {
    EXPECT_TRUE(window_->run(wrong).has_value()) << wrong;
    good("dialog none");
  }
}

/// With another metric the input's spread comes a little later than the colours.
TEST(Range, OfWhatIsSeenStandsInForAnInputsThatIsNotKnownYet) {
  ViewState state;
  const Pair own{0.3127, 0.9483};
  for (const RangeMode mode : {RangeMode::Input, RangeMode::Percentile}) {
    state.range_mode = mode;
    EXPECT_EQ(colour_range(state, own), tidy_range(own));
    EXPECT_EQ(colour_range(state, std::nullopt), (Pair{0.0, 1.0})) << "no element has a quality";
    InputSpread input;
    for (const double quality : {0.5, 0.6}) input.add(quality);
    EXPECT_EQ(colour_range(state, own, {}, &input), (Pair{0.5, 0.6})) << "what is known goes first";
  }
}

TEST(Range, IsRememberedAndRepeated) {
  for (const RangeModeInfo& one : kRangeModes) {
    ViewState state;
    state.range_mode = one.mode;
    state.range_low = 0.25;
    state.range_high = 0.75;
    state.range_low_percent = 5;
    state.range_high_percent = 90;
    state.shading = true;
    state.occlusion = false;
    const auto same = [&](const ViewState& other) {
      return other.range_mode == state.range_mode && other.range_low == 0.25 && other.range_high == 0.75 && other.range_low_percent == 5 &&
             other.range_high_percent == 90 && other.shading && !other.occlusion;
    };
    ViewState by_settings, by_session;
    ASSERT_TRUE(apply_settings(settings_text(state), by_settings));
    EXPECT_TRUE(same(by_settings)) << one.name;
    apply_view_json(view_json(state), by_session, nullptr);
    EXPECT_TRUE(same(by_session)) << one.name;
    const std::string line = one.mode == RangeMode::Given        ? "range 0.25 0.75"
                             : one.mode == RangeMode::Percentile ? "range percentile 5 90"
                                                                 : fmt::format("range {}", one.name);
    const auto lines = view_lines(state, false);
    EXPECT_NE(std::ranges::find(lines, line), lines.end()) << line;
  }
  // Settings and sessions of older versions lack some of this.
  ViewState old;
  ASSERT_TRUE(apply_settings(R"({"colormap": "viridis"})", old));
  EXPECT_EQ(old.range_mode, RangeMode::Input);
  apply_view_json(R"({"colours": {"range_mode": "fixed", "range_low": 0.0, "range_high": 1.0}})", old, nullptr);
  EXPECT_EQ(old.range_mode, RangeMode::Fixed) << "a session of before keeps its range";
  ASSERT_TRUE(apply_settings(R"({"range": {"mode": "rainbow", "low": 3, "high": 2}})", old));
  EXPECT_EQ(old.range_mode, RangeMode::Fixed);
  EXPECT_EQ(old.range_low, 0.0);
}

class ResetColours : public app::HeadlessTest {};

TEST_F(ResetColours, WhatTellsNothingOfANewMeshGivesWayToItsQuality) {
  const auto by = [this] { return state().colouring.by; };
  good("generate mixed");
  good("run 1");
  good("color-by displacement");
  good("generate solids 64");
  EXPECT_EQ(by(), ColourBy::Quality) << "nothing has moved";
  good("color-by size");
  good("generate annulus 300");
  EXPECT_EQ(by(), ColourBy::Size) << "that tells something of any mesh";
  good("color-by valence");
  good("generate solids 64");
  EXPECT_EQ(by(), ColourBy::Quality) << "around vertices a volume has no colours";
  good("color-by kind");
  good("generate annulus 300");
  EXPECT_EQ(by(), ColourBy::Quality) << "all are triangles";
  good("color-by difference");
  good("generate mixed");
  EXPECT_EQ(by(), ColourBy::Quality);
}

TEST_F(ResetColours, TheFileReadAgainKeepsThem) {
  const test::TemporaryFolder folder;
  good("generate mixed");
  good(fmt::format("export {}", (folder.path() / "mesh.off").string()));
  good(fmt::format("open {}", (folder.path() / "mesh.off").string()));
  good("run 1");
  good("color-by displacement");
  good("reload");
  EXPECT_EQ(state().colouring.by, ColourBy::Displacement);
}

}  // namespace
}  // namespace dmoscope::ui
