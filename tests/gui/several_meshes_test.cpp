// Meshes beside each other in the window: linked viewports, one table, differences, picks.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/quality/quality.h"
#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/analysis/colour_worker.h"
#include "ui/plots/run_rows.h"
#include "ui/state/run_names.h"

namespace dmoscope::app {
namespace {

namespace fs = std::filesystem;

class SeveralMeshesWindow : public HeadlessTest {
 protected:
  void SetUp() override {
    open();
    if (IsSkipped()) return;
    good("generate random 200 3");
    good("export " + first_.string());
    good("run 5");
    good("export " + smoothed_.string());
    good("generate random 90 5");
    good("export " + other_.string());
    good("open " + first_.string());
  }
  const test::TemporaryFolder folder_;
  const fs::path first_ = folder_ / "first.off", smoothed_ = folder_ / "smoothed.off", other_ = folder_ / "other.off";
};

TEST_F(SeveralMeshesWindow, TheSecondComesIntoAViewportOfItsOwn) {
  good("open-beside " + smoothed_.string());
  EXPECT_EQ(state().panes.layout, ui::PaneLayout::Two);
  EXPECT_TRUE(state().panes.linked) << "they lie at the same place";
  const auto panes = window_->app().panes();
  ASSERT_EQ(panes.size(), 2U);
  EXPECT_EQ(panes[0].frame()->input->mesh.name, "first.off");
  EXPECT_EQ(panes[1].frame()->input->mesh.name, "smoothed.off");
  EXPECT_EQ(panes[0].session->input, panes[0].frame()->input);
  EXPECT_GT(panes[1].frame()->shown_statistics.minimum, panes[0].frame()->shown_statistics.minimum);
}

TEST_F(SeveralMeshesWindow, TheListOfRunsHasRoomForTwoWithTheirMeshes) {
  good("open-beside " + other_.string());
  good("move 5 5");
  const auto& items = window_->app().items();
  const auto &list = items.find("run-list"), &first = items.find("run:0"), &second = items.find("run:1");
  EXPECT_GT(first[3] - first[1], 30) << "each has a second line";
  EXPECT_GE(first[1], list[1]);
  EXPECT_LE(second[3], list[3]);
}

TEST_F(SeveralMeshesWindow, OneTableHasBothByTheSameMetric) {
  good("open-beside " + other_.string());
  good("run 2");
  const auto rows = ui::rows_to_save(*session(), state().plot_options);
  ASSERT_EQ(rows.size(), 4U) << "two inputs and two runs";
  EXPECT_EQ(rows[0].mesh, "first.off");
  EXPECT_EQ(rows[1].mesh, "other.off");
  EXPECT_EQ(rows[2].mesh, "first.off");
  EXPECT_EQ(rows[3].mesh, "other.off");
  for (const RunRow& row : rows) EXPECT_EQ(row.judged, rows[0].judged);
  EXPECT_EQ(rows[1].minimum, session()->runs[1].records[0].statistics.minimum);
  EXPECT_EQ(rows[3].minimum, session()->runs[1].records[2].statistics.minimum);
  EXPECT_THAT(ui::run_name(*session(), 1).whole(), testing::HasSubstr("other.off"));
}

TEST_F(SeveralMeshesWindow, MeshesOfTheSameElementsAreComparedElementByElement) {
  good("open-beside " + smoothed_.string());
  good("color-by difference run 1");
  const auto colours = window_->app().colours();
  ASSERT_TRUE(colours);
  const auto& first = *session()->watched.front().frame;
  std::size_t better = 0;
  for (std::size_t e = 0; e < first.quality.size(); ++e) better += session()->frame->quality[e] > first.quality[e] ? 1U : 0U;
  EXPECT_GT(better, 0U);
  EXPECT_EQ(colours->better, better);
  EXPECT_THAT(colours->title, testing::HasSubstr("first.off"));
}

TEST_F(SeveralMeshesWindow, OthersAreNotAndNothingBreaks) {
  good("open-beside " + other_.string());
  good("color-by difference run 1");
  const auto panes = window_->app().panes();
  ASSERT_EQ(panes.size(), 2U);
  ASSERT_TRUE(panes[1].colours);
  EXPECT_FALSE(panes[1].colours->has_values);
  EXPECT_THAT(panes[1].colours->note, testing::AllOf(testing::HasSubstr("first.off"), testing::HasSubstr("other.off")));
  good("run 1");
}

TEST_F(SeveralMeshesWindow, ToLookAtAnotherKeepsCamerasMarksAndSizes) {
  good("mark a");
  good("open-beside " + other_.string());
  good("zoom 2");
  const auto camera = state().camera;
  good("select-run 1");
  EXPECT_EQ(state().camera, camera);
  EXPECT_TRUE(state().timeline.a.frame) << "the mark is of a mesh that is still open";
  good("pick vertex 150");  // the other mesh has fewer vertices
  good("select-run 2");
  EXPECT_EQ(state().picked, ui::Picked{});
  good("open " + other_.string());
  EXPECT_FALSE(state().timeline.a.frame);
}

TEST_F(SeveralMeshesWindow, OneRangeOfColoursHoldsBothInputs) {
  good("open-beside " + smoothed_.string());
  const auto [low, high] = window_->app().colour_range();
  double worst = 1.0;
  for (const auto& mesh : session()->meshes) {
    const QualityContext context = mesh.input->quality_context();
    for (Index e = 0; e < mesh.input->mesh.elements.size(); ++e)
      worst = std::min(worst, element_quality(context, mesh.input->mesh.positions, session()->shown, e));
  }
  EXPECT_LE(low, worst);
  good("select-run 1");
  EXPECT_EQ(window_->app().colour_range(), (std::pair{low, high})) << "whichever mesh commands are about";
}

TEST_F(SeveralMeshesWindow, TheMenuOpensBeside) {
  good("key Ctrl+Shift+O");
  ASSERT_EQ(state().dialog, ui::Dialog::Open);
  good("double-click open:path");
  good("key Ctrl+A");
  good("type \"" + other_.string() + "\"");
  good("key Enter");
  good("wait");
  ASSERT_EQ(session()->meshes.size(), 2U);
  good("key Ctrl+O");
  EXPECT_EQ(state().open_for, ui::OpenFor::Alone);
}

TEST_F(SeveralMeshesWindow, AtOtherPlacesEachIsSeenWhole) {
  std::ofstream(folder_ / "far.off") << "OFF\n3 1 0\n1000 1000 0\n1010 1000 0\n1000 1010 0\n3 0 1 2\n";
  good("open-beside " + (folder_ / "far.off").string());
  EXPECT_FALSE(state().panes.linked);
  const auto sees = [&](std::size_t pane, Vec2<double> point) {
    const Vec2<double> pixel = state().camera_of(pane).to_pixel(point, state().viewport);
    return pixel.x > 0 && pixel.y > 0 && pixel.x < state().viewport.x && pixel.y < state().viewport.y;
  };
  EXPECT_TRUE(sees(1, {1003, 1003}));
  const Vec3& somewhere = session()->meshes[0].input->mesh.positions[0];
  EXPECT_TRUE(sees(0, {somewhere.x, somewhere.y}));
}

TEST_F(SeveralMeshesWindow, EachStaysFittedWhenTheWindowIsResizedUnlessItWasMoved) {
  std::ofstream(folder_ / "far.off") << "OFF\n3 1 0\n1000 1000 0\n1010 1000 0\n1000 1010 0\n3 0 1 2\n";
  good("open-beside " + (folder_ / "far.off").string());
  const auto is_whole = [&](std::size_t pane) {
    const auto& positions = session()->meshes[pane].input->mesh.positions;
    return std::ranges::all_of(positions, [&](const Vec3& p) {
      const Vec2<double> pixel = state().camera_of(pane).to_pixel({p.x, p.y}, state().viewport);
      return pixel.x > 0 && pixel.y > 0 && pixel.x < state().viewport.x && pixel.y < state().viewport.y;
    });
  };
  for (const char* size : {"size 800 600", "size 1920 1080", "size 700 500"}) {
    SCOPED_TRACE(size);
    good(size);
    EXPECT_TRUE(is_whole(0));
    EXPECT_TRUE(is_whole(1));
  }
  const auto moved = [&] {
    good("select-run 1");
    good("zoom 3");
    good("select-run 2");
    return state().camera_of(0);
  };
  const render::Camera2D by_hand = moved();
  good("size 1280 800");
  EXPECT_EQ(state().camera_of(0), by_hand) << "somebody looks at something there";
  EXPECT_TRUE(is_whole(1));
}

TEST_F(SeveralMeshesWindow, AClickPicksOnTheMeshThatIsClicked) {
  good("open-beside " + other_.string());
  good("select-run 1");
  const auto panes = window_->app().panes();
  ASSERT_EQ(panes.size(), 2U);
  const auto& pane = panes[1];
  const Frame& frame = *pane.frame();
  const Vec3 at = frame.positions[17];
  const Vec2<double> pixel = state().camera_of(1).to_pixel({at.x, at.y}, state().viewport);
  good(fmt::format("click {} {}", pane.rect.x + pixel.x, pane.rect.y + pixel.y));
  EXPECT_EQ(session()->active, 1U);
  EXPECT_EQ(state().picked, (ui::Picked{ui::Picked::Kind::Vertex, 17}));
}

}  // namespace
}  // namespace dmoscope::app
