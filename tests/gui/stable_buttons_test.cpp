// No button moves while the pointer is on it: each is clicked ten times at one place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"

namespace dmoscope::app {
namespace {

class StableButtons : public HeadlessTest {
 protected:
  void expect_to_stay(const std::string& item) {
    const auto& boxes = window_->app().items().boxes();
    ASSERT_TRUE(boxes.contains(item)) << item;
    const ui::Items::Box before = boxes.find(item)->second;
    const std::string click = fmt::format("click {} {}", (before[0] + before[2]) / 2, (before[1] + before[3]) / 2);
    for (int k = 1; k <= 10; ++k) {
      good(click);
      const auto now = boxes.find(item);
      ASSERT_TRUE(now != boxes.end()) << item << " is gone after click " << k;
      EXPECT_EQ(now->second, before) << item << " has moved with click " << k;
    }
  }
  void expect_all_to_stay(std::initializer_list<const char*> items) {
    for (const char* item : items) expect_to_stay(item);
  }
};

TEST_F(StableButtons, OfPlanarMeshes) {
  good("generate coast 400");
  expect_all_to_stay({"step-iteration", "back-iteration", "step-class", "wireframe", "settings", "tab:mesh", "holds", "loops", "tab:worst",
                      "worst:0", "worst:1", "tab:selection", "tab:colours", "plot-histogram", "plot-convergence", "plot-runs"});
  good("tab mesh");
  good("unfold-loops on");
  expect_all_to_stay({"loop-select:1", "loop-fix:1"});
  good("select vertex loop:1");
  good("pick vertex " + std::to_string(state().selection.vertices().front()));
  expect_all_to_stay({"loop-next", "loop-back"});
}

TEST_F(StableButtons, OfAMethodThatPromisesNothing) {
  good("generate annulus 200");
  const auto below = [&] { return window_->app().items().find("settings"); };
  const auto before = below();
  for (const char* method : {"laplace", "dmo", "angle-based", "smart-laplace"}) {
    good(std::string("method ") + method);
    EXPECT_EQ(below(), before) << method;
    EXPECT_EQ(window_->app().items().boxes().contains("method-note"), method[0] == 'l' || method[0] == 'a') << method;
  }
}

TEST_F(StableButtons, OfTheInsideOfVolumes) {
  good("generate tetrahedra 200");
  good("tab inside");
  expect_all_to_stay({"inside:clip", "inside:x", "inside:flip", "inside:cut", "inside:whole", "inside:peel-more", "inside:peel-less",
                      "inside:ghost", "inside:worst", "tab:inside"});
}

TEST_F(StableButtons, OfAColumnWhoseContentsComeToScroll) {
  open(1280, 520);
  good("generate coast 400");
  good("tab mesh");
  const auto box = [&] { return window_->app().items().find("show-worst"); };
  const auto before = box();
  good("unfold-loops on");
  EXPECT_EQ(box(), before) << "beside the bar";
  good("unfold-loops off");
  EXPECT_EQ(box(), before);
}

TEST_F(StableButtons, OfAnInspection) {
  good("generate annulus 200");
  good("inspect-worst");
  expect_to_stay("level-next");
  expect_to_stay("level-back");
}

}  // namespace
}  // namespace dmoscope::app
