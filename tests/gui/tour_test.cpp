// The tour: its steps wait for the person, and point at the right controls.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "ui/commands/settings.h"

namespace dmoscope::app {
namespace {

class TourTest : public HeadlessTest {
 protected:
  [[nodiscard]] std::string at() {
    const ui::Tour& tour = state().tour;
    return tour.on ? std::string(tour.now().title) : "off";
  }
  [[nodiscard]] bool on_screen(std::string_view item) { return window_->app().items().boxes().contains(item); }
  /// Whether one of the step's controls is on screen.
  [[nodiscard]] bool points_somewhere() {
    for (const std::string_view item : state().tour.now().items)
      if (!item.empty() && on_screen(item)) return true;
    return false;
  }
};

TEST(TourState, EachStepWaitsUntilItIsDone) {
  ui::Tour tour;
  ui::TourFacts now;
  tour.follow(now);
  EXPECT_FALSE(tour.on);
  tour.start();
  tour.follow(now);
  EXPECT_EQ(tour.step, 0U);
  now.mesh = true;
  tour.follow(now);
  EXPECT_EQ(tour.step, 0U) << "another mesh";
  now.coast = true;
  tour.follow(now);
  EXPECT_EQ(tour.step, 1U);
  now.iteration = 1;
  now.busy = true;
  tour.follow(now);
  EXPECT_EQ(tour.step, 1U) << "not done yet";
  now.busy = false;
  tour.follow(now);
  EXPECT_EQ(tour.step, 2U);
  now.iteration = 0;  // undone
  now.inspecting = true;
  tour.follow(now);
  EXPECT_EQ(tour.step, 3U);
  now.iteration = 1;
  tour.follow(now);
  EXPECT_EQ(tour.step, 4U);
  now.side_by_side = now.exporting = true;
  tour.follow(now);
  EXPECT_EQ(tour.step, 6U) << "what was done before is not asked for";
  tour.follow(now);
  EXPECT_TRUE(tour.on) << "the last words stay";
  tour.advance();
  EXPECT_FALSE(tour.on);
}

TEST(TourState, ThatItWasOfferedIsRemembered) {
  ui::ViewState state, read;
  EXPECT_FALSE(state.tour.offered);
  state.tour.stop();
  ASSERT_TRUE(ui::apply_settings(ui::settings_text(state), read));
  EXPECT_TRUE(read.tour.offered);
  EXPECT_FALSE(read.tour.on);
}

TEST_F(TourTest, IsTakenByHand) {
  EXPECT_FALSE(on_screen("tour:take")) << "scripts see no offer";
  good("tour offer");
  good("click tour:take");
  ASSERT_EQ(at(), "Open a mesh");
  EXPECT_TRUE(points_somewhere());
  good("click sample:coast");
  ASSERT_EQ(at(), "One step");
  EXPECT_TRUE(points_somewhere());
  good("key N");
  ASSERT_EQ(at(), "Why this place?");
  EXPECT_TRUE(points_somewhere());
  good("click why?");
  ASSERT_EQ(at(), "Let it run");
  EXPECT_TRUE(points_somewhere());
  good("click run-pause");
  ASSERT_EQ(at(), "Compare");
  EXPECT_TRUE(points_somewhere());
  good("key 2");
  ASSERT_EQ(at(), "Export");
  EXPECT_TRUE(points_somewhere());
  good("key Ctrl+S");
  ASSERT_EQ(at(), "That is all");
  good("key Escape");
  good("click tour:next");
  EXPECT_EQ(at(), "off");
}

TEST_F(TourTest, NextDoesEachStep) {
  good("generate grid 100");
  good("tour");
  for (const char* title : {"Open a mesh", "One step", "Why this place?", "Let it run", "Compare", "Export"}) {
    ASSERT_EQ(at(), title);
    good("click tour:next");
  }
  EXPECT_EQ(at(), "That is all");
  EXPECT_EQ(state().dialog, ui::Dialog::Export);
}

TEST_F(TourTest, IsSkippedAtAnyStep) {
  for (std::size_t step = 0; step + 1 < ui::tour_steps().size(); ++step) {
    good("tour on");
    state().tour.step = step;
    good("move 5 5");
    if (state().dialog != ui::Dialog::None) good("key Escape");
    good("click tour:off");
    EXPECT_EQ(at(), "off") << step;
  }
  good("tour offer");
  good("click tour:off");
  EXPECT_FALSE(state().tour.offer);
  EXPECT_TRUE(state().tour.offered);
}

TEST_F(TourTest, TheCardNeverCoversItsControl) {
  for (const auto& [width, height] : {std::pair{800, 600}, {1280, 800}, {1920, 1080}}) {
    open(width, height);
    good("tour");
    for (std::size_t step = 0; step + 1 < ui::tour_steps().size(); ++step) {
      const auto card = window_->app().items().find("tour:next");
      for (const std::string_view item : state().tour.now().items) {
        if (item.empty() || !on_screen(item)) continue;
        const auto box = window_->app().items().find(std::string(item));
        EXPECT_TRUE(card[2] <= box[0] || box[2] <= card[0] || card[3] <= box[1] || box[3] <= card[1]) << item;
        break;
      }
      good("click tour:next");
    }
  }
}

}  // namespace
}  // namespace dmoscope::app
