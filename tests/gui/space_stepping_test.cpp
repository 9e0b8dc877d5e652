// Arrows, ghosts, dots and labels over volume meshes: their ends, and that the window draws them for visible vertices.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "tests/gui/headless_test.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/overlays/moves.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

/// A view of 1000 pixels for 10 units from +x: y points to the right and z up.
MarkView seen_from_x() {
  render::OrbitCamera camera;
  camera.look_from(render::ViewPreset::PlusX);
  camera.height = 10.0;
  render::Bounds3 bounds;
  bounds.include({-5, -5, -5});
  bounds.include({5, 5, 5});
  return {{camera, camera.projection({1000, 1000}, bounds)}};
}

const std::vector<Vec3> kFrom{{0, 0, 0}, {0, 2, 0}, {0, -3, 0}, {0, 0, 3}, {0, 0.03, 3}, {0, 9, 0}};

TEST(SpaceArrows, LeadFromWhereVerticesWereLongestFirstWhereThereIsRoom) {
  std::vector<Vec3> to = kFrom;
  to[0].y += 0.5;   // 50 pixels
  to[1].x += 2.0;   // towards the eye, so that nothing of it can be seen
  to[2].z += 0.03;  // 3 pixels
  to[3].z += 0.2;   // 20 pixels
  to[4].z += 0.1;   // 10 pixels, from the begin of another one
  const std::vector<Index> all{0, 1, 2, 3, 4};
  render::Marks marks;
  const ArrowsAdded added = add_arrows(marks, seen_from_x(), Displacements({}, kFrom, to, all), 1.0, {{1, 2, 3, 255}, {4, 5, 6, 255}});
  EXPECT_EQ(added.drawn, 2U);
  EXPECT_EQ(added.left_out, 1U);
  ASSERT_EQ(marks.lines.size(), 12U);  // a shaft and two lines of a head each, with casings below
  EXPECT_EQ(marks.lines[0].from, kFrom[0]);
  EXPECT_EQ(marks.lines[0].to, to[0]);
  EXPECT_EQ(marks.lines[3].from, kFrom[3]);
  EXPECT_EQ(marks.lines[6].colour, (render::Rgba{1, 2, 3, 255}));
  // The head reaches 7 pixels back from the tip, and is equally wide.
  EXPECT_NEAR(marks.lines[1].to.y, 0.5 - 0.07, 1e-12);
  EXPECT_NEAR(std::abs(marks.lines[1].to.z), 0.035, 1e-12);
  EXPECT_NEAR(marks.lines[1].to.z, -marks.lines[2].to.z, 1e-12);
  // Arrows are drawn for some vertices only.
  marks = {};
  EXPECT_EQ(add_arrows(marks, seen_from_x(), Displacements({}, kFrom, to, std::vector<Index>{3}), 2.0, {}).drawn, 1U);
  EXPECT_NEAR(marks.lines[0].to.z, 3.4, 1e-12);
}

TEST(SpaceArrows, AreFortyPixelsLongWhereNothingElseIsWanted) {
  std::vector<Vec3> to = kFrom;
  to[0].y += 0.5;
  to[5].y += 100.0;  // not among the visible ones
  MarkView view = seen_from_x();
  view.unhidden = {{0, 3}, {}};
  EXPECT_NEAR(arrow_factor(view, Displacements({}, kFrom, to), 0.0) * 0.5 * 100.0, 40.0, 1e-9);
  EXPECT_EQ(arrow_factor(view, Displacements({}, kFrom, to), 3.0), 3.0);
  EXPECT_EQ(arrow_factor(view, Displacements({}, kFrom, kFrom), 0.0), 1.0);
}

TEST(SpaceGhost, HasTheEdgesOfWhatMovedWhereTheyWere) {
  std::vector<Vec3> to = kFrom;
  to[0].y += 0.5;
  const std::vector<std::array<Index, 2>> edges{{0, 1}, {1, 2}, {3, 4}, {0, 3}};
  render::Marks marks;
  add_ghost(marks, seen_from_x(), kFrom, to, edges, {});
  ASSERT_EQ(marks.lines.size(), 4U);
  EXPECT_EQ(marks.lines[0].from, kFrom[0]);
  EXPECT_EQ(marks.lines[0].to, kFrom[1]);
  EXPECT_EQ(marks.lines[1].to, kFrom[3]);
}

TEST(SpaceDots, AreOnWhatNothingHides) {
  const auto input = dmoscope::testing::input(test::volume_grid(2, test::Fill::Hexahedra));
  MarkView view = seen_from_x();
  view.unhidden = {{0, 1, 4}, {}};
  render::Marks marks;
  add_dots(marks, view, *input, input->mesh.positions, std::vector<Index>{4, 2, 0}, {9, 9, 9, 255}, 8.0);
  ASSERT_EQ(marks.dots.size(), 2U);
  EXPECT_EQ(marks.dots[0].point, input->mesh.positions[4]);
  EXPECT_EQ(marks.dots[1].point, input->mesh.positions[0]);
}

class VolumeStepping : public app::HeadlessTest {
 protected:
  void SetUp() override {
    HeadlessTest::SetUp();
    if (IsSkipped()) return;
    Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.3);
    mesh.positions[124] = {0.87, 0.87, 0.87};  // the corner in front, so that the worst element is seen
    Progress progress;
    write_mesh(folder_.path() / "block.vtk", mesh, mesh.positions, progress);
    good("open \"" + (folder_.path() / "block.vtk").string() + "\"");
    good("step iteration");
  }
  [[nodiscard]] std::vector<std::uint8_t> picture() { return window_->picture().rgba; }
  [[nodiscard]] std::string note() { return window_->app().panes().front().stepping_note; }
  const test::TemporaryFolder folder_;
};

TEST_F(VolumeStepping, ThePictureChangesWithWhatIsShown) {
  good("clip x");
  const auto plain = picture();
  for (const char* line : {"next-class on", "arrows input", "ghost input", "arrows previous", "ghost previous", "labels both"}) {
    good(line);
    EXPECT_NE(picture(), plain) << line;
    good(std::string(line).substr(0, std::string(line).find(' ')) + " off");
    EXPECT_EQ(picture(), plain) << line;
  }
}

TEST_F(VolumeStepping, WordsSayWhatIsShownAndWhyNot) {
  good("arrows input");
  EXPECT_EQ(note(), "arrows: no visible vertex has moved since the input");  // the boundary stays
  good("clip x");
  EXPECT_NE(note().find("arrows × "), std::string::npos) << note();
  good("ghost input");
  EXPECT_NE(note().find("ghost of the input"), std::string::npos) << note();
  for (const char* line : {"arrows off", "ghost off", "show-all"}) good(line);
  EXPECT_EQ(note(), "");
}

TEST_F(VolumeStepping, WhatIsMarkedAndTakenAwayIsNamed) {
  const Index worst = session()->frame->worst.front().element;
  good("worst off");
  good("pick vertex 124");  // at (1, 1, 1); there is no cell of that number
  EXPECT_EQ(note(), "");
  good("clip -x:0.6");
  EXPECT_EQ(note(), "");
  good("clip x:0.6");
  EXPECT_EQ(note(), "hidden: vertex 124");
  good("clip -x:0.6");
  good("pick element 0");
  EXPECT_EQ(note(), "hidden: element 0");
  good("worst on");
  good("show-all");
  EXPECT_EQ(note(), "");
  good("pick none");
  good("keep-quality 0.99 1");
  EXPECT_EQ(note(), "hidden: the worst element");
  good("worst-cells 1");
  good("keep-quality off");
  EXPECT_EQ(note(), "") << worst;
}

TEST_F(VolumeStepping, AWorstElementBehindOthersIsNamed) {
  const Index worst = session()->frame->worst.front().element;
  const std::array<Index, 3> place{worst % 4, worst / 4 % 4, worst / 16};
  constexpr std::array kSides{"-x", "+x", "-y", "+y", "-z", "+z"};
  for (std::size_t side = 0; side < kSides.size(); ++side) {
    good(std::string("view-from ") + kSides[side]);
    const bool lies_there = place[side / 2] == (side % 2 == 0 ? 0U : 3U);
    EXPECT_EQ(note(), lies_there ? "" : "hidden: the worst element") << kSides[side] << " of " << worst;
  }
}

TEST_F(VolumeStepping, AFittedMeshStaysFittedInPerspective) {
  good("fit");
  const double height = state().orbit.height;
  good("perspective on");
  EXPECT_NE(state().orbit.height, height);  // perspective makes near parts larger, so the eye is farther away
  good("perspective off");
  EXPECT_NEAR(state().orbit.height, height, 1e-12);
  good("zoom 2");
  good("perspective on");
  EXPECT_NEAR(state().orbit.height, height / 2.0, 1e-12) << "somebody has moved it";
}

TEST_F(VolumeStepping, ThePlaneIsSeenWithItsHandle) {
  good("clip z:0.999");
  const auto at = window_->app().items().find("clip-handle");
  const render::Image image = window_->picture();
  const render::Rgb accent = palette(state().theme).accent;
  int tinted = 0;
  for (int y = static_cast<int>(at[1]); y < static_cast<int>(at[3]); ++y)
    for (int x = static_cast<int>(at[0]); x < static_cast<int>(at[2]); ++x) {
      const render::Rgba pixel = image.at(x, y);
      tinted += pixel.r == accent.r && pixel.g == accent.g && pixel.b == accent.b ? 1 : 0;
    }
  EXPECT_GT(tinted, 100);
}

}  // namespace
}  // namespace dmoscope::ui
