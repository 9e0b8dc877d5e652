// 800 x 600: everything can still be reached.
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "tests/gui/headless_test.h"
#include "ui/analysis/scene_points.h"

namespace dmoscope::app {
namespace {

class SmallWindow : public HeadlessTest {
 protected:
  void SetUp() override { open(800, 600); }
  [[nodiscard]] const ui::Items::Box& box(const std::string& item) { return window_->app().items().find(item); }
};

TEST_F(SmallWindow, FoldedPanelsOpenAndCloseAndTakeNothingFromOthers) {
  good("generate annulus");
  good("dock setup left");
  good("click fold:right");
  EXPECT_TRUE(state().panels.right_over);
  good("click fold:left");
  EXPECT_TRUE(state().panels.left_over);
  good("click step-iteration");
  EXPECT_EQ(window_->app().frame()->moment.iteration, 1U);
  good("key F1");
  EXPECT_EQ(state().dialog, ui::Dialog::Keys);
  good("click dialog:close");
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  good("key Ctrl+F");
  good("type 12");
  good("key Enter");
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, 12}));
  good("click fold:left");
  EXPECT_FALSE(state().panels.left_over);
  good("click fold:right");
  EXPECT_FALSE(state().panels.right_over);
}

TEST_F(SmallWindow, FactsDoNotCoverWhatTheyAreAbout) {
  for (const char* mesh : {"generate coast 400", "generate solids 216"}) {
    open(640, 520);
    good(mesh);
    const auto covered = [&](Index vertex) {
      const ui::PaneFacts& pane = window_->app().panes().front();
      const Vec2<double> at = *pane.view->place(ui::ScenePoints::of(*pane.frame()->input).at(pane.frame()->positions[vertex]));
      return pane.rect.x + pane.rect.w / 2 + static_cast<float>(at.x) > box("tab:mesh")[0];
    };
    // The vertex farthest to the right, and a command that brings it to the middle.
    const auto& positions = session()->frame->positions;
    const auto last = static_cast<Index>(std::ranges::max_element(positions, {}, &Vec3::x) - positions.begin());
    good(fmt::format("pick vertex {}", last));
    EXPECT_FALSE(covered(last)) << mesh;
    good(fmt::format("goto vertex {}", last / 2));
    EXPECT_FALSE(covered(last / 2)) << mesh;
  }
}

TEST_F(SmallWindow, AFitShowsAllOfTheMeshBesideTheFacts) {
  for (const char* mesh : {"generate coast 400", "generate solids 216"}) {
    open(1280, 800);
    good("scale 2");
    good(mesh);
    good("pick element 100");
    good("fit");
    const ui::PaneFacts& pane = window_->app().panes().front();
    const float edge = box("tab:mesh")[0];
    EXPECT_LT(pane.uncovered.x + pane.uncovered.w, edge) << mesh;
    for (const Vec3& p : session()->frame->positions) {
      const Vec2<double> at = *pane.view->place(ui::ScenePoints::of(*pane.frame()->input).at(p));
      const float x = pane.rect.x + pane.rect.w / 2 + static_cast<float>(at.x);
      ASSERT_GT(x, pane.uncovered.x) << mesh;
      ASSERT_LT(x, pane.uncovered.x + pane.uncovered.w) << mesh;
    }
    const float end = pane.uncovered.x + pane.uncovered.w;
    EXPECT_LE(box("pick-label")[2], end) << mesh;
    if (pane.in_space()) {
      EXPECT_LE(box("note")[2], end) << "of the worst element, which is hidden";
    }
    for (const char* button : {"fit", "wireframe", "worst-marker"}) EXPECT_LE(box(button)[2], end) << button;
    const double before = pane.view->place(Vec3{})->x;
    good("click fold:right");
    good("key Escape");
    EXPECT_GT(window_->app().panes().front().view->place(Vec3{})->x, before) << mesh << ": without the facts it stands in the middle again";
  }
}

TEST_F(SmallWindow, NotesAreWholeAndBesideTheMesh) {
  for (const double scale : {1.0, 2.0}) {
    if (scale > 1) open(1280, 800);
    good(fmt::format("scale {}", scale));
    good("generate tetrahedra 300");
    const auto& positions = session()->frame->positions;
    good("pick element 0");
    good("view-from iso");
    good("clip -x:0.6");
    good("fit");
    const ui::PaneFacts& pane = window_->app().panes().front();
    ASSERT_TRUE(pane.stepping_note.starts_with("hidden: ") && pane.stepping_note.ends_with("element 0")) << pane.stepping_note;
    const auto& note = box("note");
    const auto em = static_cast<float>(15 * scale);
    const float lines = std::round((note[3] - note[1] - em / 2) / em), letters = static_cast<float>(pane.stepping_note.size());
    EXPECT_GE((note[2] - note[0]) * lines, 0.42F * letters * em) << "no letter is left out";
    EXPECT_LE(note[2], pane.rect.x + pane.rect.w);
    float top = pane.rect.y + pane.rect.h;
    for (const Vec3& p : positions)
      top = std::min(
          top, pane.rect.y + pane.rect.h / 2 - static_cast<float>(pane.view->place(ui::ScenePoints::of(*pane.frame()->input).at(p))->y));
    EXPECT_LT(note[3], top) << "at scale " << scale;
  }
}

TEST_F(SmallWindow, AllSamplesAreInSight) {
  const float bottom = box("status-backend")[1];
  for (const GeneratorInfo& sample : generator_table()) {
    const std::string name(sample.name);
    const auto& card = box("sample:" + name);
    EXPECT_LE(card[3], bottom) << name;
    EXPECT_GE(card[0], 0.0F) << name;
    EXPECT_LE(card[2], 800.0F) << name;
  }
  good("click sample:grid");
  EXPECT_NE(window_->app().frame(), nullptr);
}

TEST_F(SmallWindow, EveryDialogFitsAndCanBeClosed) {
  good("generate annulus");
  for (const char* scale : {"1", "1.5"}) {
    good(std::string("scale ") + scale);
    for (const char* name : {"export", "screenshot", "find", "keys", "about", "log", "sequence", "open"}) {
      good(std::string("dialog ") + name);
      const auto& button = box("dialog:close");
      EXPECT_GE(button[1], 0.0F) << name << scale;
      EXPECT_LE(button[3], 600.0F) << name << scale;
      EXPECT_LE(button[2], 800.0F) << name << scale;
      good("click dialog:close");
      EXPECT_EQ(state().dialog, ui::Dialog::None) << name << scale;
    }
  }
}

}  // namespace
}  // namespace dmoscope::app
