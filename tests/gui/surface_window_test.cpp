// A curved surface in the window: shown in space, stepped, picked, with its feature edges.
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "core/io/mesh_io.h"
#include "tests/gui/headless_test.h"
#include "tests/smooth/surface_judge.h"
#include "tests/support/plain_surface.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/analysis/inspection.h"
#include "ui/analysis/scene_points.h"
#include "ui/overlays/overlay.h"

namespace dmoscope::app {
namespace {

/// The surface of a cube of n x n x n cells, shaken on its sides.
Mesh cube(Index n) {
  const Mesh volume = dmoscope::testing::shaken(test::volume_grid(n, test::Fill::Hexahedra), 0.05, 3);
  Mesh mesh;
  mesh.positions = volume.positions;
  for (const auto& face : dmoscope::testing::boundary_faces(volume)) mesh.elements.add(ElementKind::Quadrilateral, face);
  return mesh;
}

class SurfaceWindow : public HeadlessTest {
 protected:
  void SetUp() override {
    HeadlessTest::SetUp();
    if (IsSkipped()) return;
    const Mesh mesh = cube(5);
    Progress progress;
    write_mesh(folder_.path() / "cube.vtk", mesh, mesh.positions, progress);
    good("open \"" + (folder_.path() / "cube.vtk").string() + "\"");
  }
  [[nodiscard]] std::vector<std::uint8_t> picture() { return window_->picture().rgba; }
  test::TemporaryFolder folder_;
};

TEST_F(SurfaceWindow, IsSeenInSpaceSteppedAndPicked) {
  EXPECT_TRUE(state().in_space);
  std::vector<std::vector<std::uint8_t>> pictures{picture()};
  for (const char* line : {"view-from +x", "turn 40 20", "clip x:0.6", "clip off", "worst-cells 5", "show-all", "color-by size",
                           "color-by quality", "step iteration 3", "features on", "shrink 0.7"}) {
    good(line);
    pictures.push_back(picture());
    EXPECT_TRUE(pictures.back() != pictures[pictures.size() - 2]) << line;
  }
  good("view-from iso");
  good("click 640 330");
  EXPECT_NE(state().picked.kind, ui::Picked::Kind::None);
  EXPECT_GT(session()->frame->statistics.minimum, session()->input_summary->statistics.minimum);
}

TEST_F(SurfaceWindow, TheUpAxisIsGuessedAndCanBeSwitched) {
  EXPECT_EQ(state().orbit.up_axis, render::UpAxis::Z) << "the cube stands on a face in z";
  // An octahedron stands on no face; a roof on its square, which is below in y or in z.
  const auto open_with = [&](const char* file, const char* text) {
    std::ofstream(folder_ / file) << text;
    good("open \"" + (folder_ / file).string() + "\"");
    return state().orbit.up_axis;
  };
  const char* octahedron =
      "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n"
      "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
  const char* as_obj =
      "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
      "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  const char* roof = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1 0\nf 1 2 3 4\nf 2 1 5\nf 3 2 5\nf 4 3 5\nf 1 4 5\n";
  const char* roof_off = "OFF\n5 5 0\n-1 0 -1\n1 0 -1\n1 0 1\n-1 0 1\n0 1 0\n4 0 1 2 3\n3 1 0 4\n3 2 1 4\n3 3 2 4\n3 0 3 4\n";
  EXPECT_EQ(open_with("octahedron.off", octahedron), render::UpAxis::Z);
  EXPECT_EQ(open_with("octahedron.obj", as_obj), render::UpAxis::Y);
  EXPECT_EQ(open_with("roof.obj", roof), render::UpAxis::Y);
  EXPECT_EQ(open_with("roof.off", roof_off), render::UpAxis::Y);
  EXPECT_GT(state().orbit.up.y, 0.5);
  good("up-axis z");
  EXPECT_GT(state().orbit.up.z, 0.5);
  good("view-from +x");
  EXPECT_EQ(state().orbit.up.z, 1.0);
  good("click inside:up");
  good("click inside:up:y");
  EXPECT_EQ(state().orbit.up.y, 1.0);
}

/// Every run of a surface takes parameters of sliding, and its name tells them.
TEST_F(SurfaceWindow, SaysWhatItsRunsReadOfSliding) {
  const auto has = [&](const char* item) { return window_->app().items().boxes().contains(item); };
  good("size 1280 1500");  // nothing is scrolled away
  good("settings on");
  (void)picture();
  for (const char* item : {"feature-angle", "corner-angle", "max-deviation"}) EXPECT_TRUE(has(item)) << item;
  EXPECT_FALSE(has("fit-surface")) << "there is no other surface";
  good("feature-angle 95");
  EXPECT_THAT(session()->runs[0].title, ::testing::HasSubstr("feature angle 95"));
  good("generate annulus");
  (void)picture();
  for (const char* item : {"feature-angle", "corner-angle", "max-deviation"}) EXPECT_FALSE(has(item)) << item;
}

TEST_F(SurfaceWindow, TheDistanceOfAFitIsTyped) {
  good("size 1280 1500");
  good("settings on");
  const std::string fine = (folder_.path() / "fine.vtk").string();
  Progress progress;
  const Mesh other = cube(8);
  write_mesh(fine, other, other.positions, progress);
  good("surface \"" + fine + "\"");
  good("double-click fit-surface");
  good("key Ctrl+A");
  good("type 0.25");
  good("key Enter");
  EXPECT_EQ(session()->runs[0].parameters.fit, 0.25);
}

TEST_F(SurfaceWindow, FitsFourViewportsInASmallWindow) {
  open(800, 600);
  good("open \"" + (folder_.path() / "cube.vtk").string() + "\"");
  good("compare with laplace:mean-ratio dmo:scaled-jacobian laplace:scaled-jacobian 2");
  good("move 5 5");
  ASSERT_EQ(window_->app().panes().size(), 4U) << session()->runs.size() << " runs";
  const Vec2<double> viewport = state().viewport;
  for (const ui::PaneFacts& pane : window_->app().panes()) {
    ASSERT_TRUE(pane.view);
    double least = 1e9, most = -1e9;
    for (const Vec3& at : pane.frame()->positions) {
      const auto place = pane.view->place(ui::ScenePoints::of(*pane.frame()->input).at(at));
      ASSERT_TRUE(place);
      EXPECT_LE(std::abs(place->x), 0.5 * viewport.x);
      EXPECT_LE(std::abs(place->y), 0.5 * viewport.y);
      least = std::min(least, place->x);
      most = std::max(most, place->x);
    }
    EXPECT_GT(most - least, 0.4 * std::min(viewport.x, viewport.y)) << "and fills it";
  }
}

/// Candidates at which the surface would deviate too much are marked alike in the mesh and in the maps of the levels.
TEST_F(SurfaceWindow, CandidatesThatAreRefusedAreMarked) {
  good("max-deviation 1e-9");
  const RunView& run = session()->runs[0];
  std::size_t refused = 0;
  for (Index v = 0; v < run.fixed.size() && refused == 0; ++v) {
    if (!run.domain->on_surface(v)) continue;
    good("inspect vertex " + std::to_string(v));
    const ui::Inspection& inspection = window_->app().inspection();
    for (int k = 0; k < static_cast<int>(inspection.level(1).quality.size()); ++k) {
      const bool counts = inspection.grid->levels[0].fates[static_cast<std::size_t>(k)] == CandidateFate::Counts;
      EXPECT_EQ(inspection.refuses(1, k), !counts);
      refused += counts ? 0 : 1;
    }
  }
  EXPECT_GT(refused, 0U);
}

TEST_F(SurfaceWindow, VisitsAreLookedIntoWhereVerticesSlideOnIt) {
  const RunView& run = session()->runs[0];
  Index inside = kNoIndex, corner = kNoIndex, edge = kNoIndex;
  for (Index v = 0; v < run.fixed.size(); ++v) {
    if (run.domain->on_surface(v) && inside == kNoIndex) inside = v;
    if (run.domain->on_curve(v) && edge == kNoIndex) edge = v;
    if (run.domain->is_held(v) && corner == kNoIndex) corner = v;
  }
  const auto before = picture();
  good("inspect vertex " + std::to_string(inside));
  EXPECT_TRUE(window_->app().inspection().trouble.empty());
  ASSERT_TRUE(window_->app().inspection().grid);
  EXPECT_EQ(window_->app().inspection().level_count(), 3U);
  const auto level = picture();
  EXPECT_TRUE(level != before);
  good("level next");
  EXPECT_TRUE(picture() != level);
  good("inspect vertex " + std::to_string(edge));
  EXPECT_THAT(window_->app().inspection().trouble, ::testing::HasSubstr("along a curve"));
  good("inspect vertex " + std::to_string(corner));
  EXPECT_THAT(window_->app().inspection().trouble, ::testing::HasSubstr("is fixed: "));
}

TEST_F(SurfaceWindow, SlidesOnTheSurfaceOfAnotherMesh) {
  const Mesh fine = cube(8);
  const std::string file = (folder_.path() / "fine.vtk").string();
  Progress progress;
  write_mesh(file, fine, fine.positions, progress);
  good("dialog open-surface");
  EXPECT_EQ(state().dialog, ui::Dialog::Open);
  EXPECT_EQ(ui::commands_to_open(state().open_for, {file}), std::vector<std::string>{"surface " + file});
  good("dialog none");
  good("run 2");
  good("surface " + file);
  ASSERT_NE(session()->frame->input->surface, nullptr);
  EXPECT_EQ(session()->runs[0].moment.iteration, 0U);
  EXPECT_EQ(session()->runs[0].domain->feature_edges().size(), 12U * 5U) << "edges of the mesh along those of the other";
  good("run 2");
  good("color-by deviation");
  (void)picture();
  EXPECT_THAT(window_->app().colours()->title, ::testing::HasSubstr("deviation from fine.vtk"));
  good("surface own");
  EXPECT_EQ(session()->frame->input->surface, nullptr);
}

/// Marks of a cube: twelve edges of n segments and eight corners, however many of them are visible.
TEST(FeatureMarks, OfACube) {
  constexpr Index n = 5;
  const auto mesh = dmoscope::testing::input(cube(n));
  const Domain domain(*mesh, {});
  EXPECT_EQ(domain.feature_edges().size(), 12U * n);
  // The view is from the front, as if the cube were of glass, and with a front that hides everything.
  render::OrbitCamera camera;
  render::Bounds3 box;
  for (const Vec3& position : mesh->mesh.positions) box.include(position);
  camera.fit(box, {400, 400});
  ui::MarkView view{{camera, camera.projection({400, 400}, box)}};
  render::Marks marks;
  ui::add_features(marks, view, domain, mesh->mesh.positions, {{0, 0, 0, 255}, {255, 255, 255, 255}});
  EXPECT_EQ(marks.lines.size(), 2 * 12U * n) << "each with a casing";
  EXPECT_EQ(marks.dots.size(), 8U);
  for (const auto& dot : marks.dots)
    for (const double x : {dot.point.x, dot.point.y, dot.point.z}) EXPECT_TRUE(x == 0.0 || x == 1.0);
  view.unhidden.emplace();
  render::Marks none;
  ui::add_features(none, view, domain, mesh->mesh.positions, {{0, 0, 0, 255}, {255, 255, 255, 255}});
  EXPECT_TRUE(none.lines.empty() && none.dots.empty()) << "what is hidden is not drawn";
}

}  // namespace
}  // namespace dmoscope::app
