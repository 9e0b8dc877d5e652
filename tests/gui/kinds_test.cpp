// Corners and feature edges that a person sets in the window: shown, clicked, undone.
#include <string>

#include <gmock/gmock.h>

#include "core/io/mesh_io.h"
#include "tests/gui/headless_test.h"
#include "tests/smooth/surface_judge.h"
#include "tests/support/plain_surface.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::app {
namespace {

class KindsInTheWindow : public HeadlessTest {
 protected:
  static constexpr Index kN = 4;
  void SetUp() override {
    open(1280, 1500);
    if (IsSkipped()) return;
    // The surface of a cube, whose vertices count x first.
    const Mesh volume = dmoscope::testing::shaken(test::volume_grid(kN, test::Fill::Hexahedra), 0.05, 3);
    Mesh mesh;
    mesh.positions = volume.positions;
    for (const auto& face : dmoscope::testing::boundary_faces(volume)) mesh.elements.add(ElementKind::Quadrilateral, face);
    Progress progress;
    write_mesh(folder_.path() / "cube.vtk", mesh, mesh.positions, progress);
    good("open \"" + (folder_.path() / "cube.vtk").string() + "\"");
  }
  [[nodiscard]] const RunView& active() {
    view_ = session();
    return view_->runs.at(view_->active);
  }
  [[nodiscard]] const Kinds& kinds() { return active().parameters.kinds; }
  [[nodiscard]] std::vector<std::uint8_t> picture() { return window_->picture().rgba; }
  /// Picture of the mesh alone, without the title and the panels.
  [[nodiscard]] std::vector<std::uint8_t> mesh_picture() {
    const auto whole = window_->picture();
    std::vector<std::uint8_t> part;
    for (int y = 150; y < 900; ++y) {
      const auto row = whole.rgba.begin() + (static_cast<std::ptrdiff_t>(y) * whole.width + 230) * 4;
      part.insert(part.end(), row, row + 800 * 4);
    }
    return part;
  }
  [[nodiscard]] bool has(const std::string& item) { return window_->app().items().boxes().contains(item); }
  test::TemporaryFolder folder_;
  std::shared_ptr<const SessionView> view_;
};

TEST_F(KindsInTheWindow, AVertexIsMadeACornerAndBack) {
  const auto nothing = picture();
  EXPECT_FALSE(has("kind:corner"));
  good("pick vertex 2");
  (void)picture();
  ASSERT_TRUE(active().domain->on_curve(2));
  good("click kind:corner");
  EXPECT_EQ(kinds().corners, std::vector<Index>{2});
  EXPECT_EQ(active().domain->held_on(2), HeldOn::Hand);
  good("click kind:no-corner");
  EXPECT_TRUE(kinds().corners.empty());
  EXPECT_EQ(kinds().no_corners, std::vector<Index>{2});
  good("click kind:auto");
  EXPECT_TRUE(kinds().empty());
  good("undo");
  EXPECT_EQ(kinds().no_corners, std::vector<Index>{2});
  good("undo");
  EXPECT_EQ(kinds().corners, std::vector<Index>{2});
  good("undo");
  EXPECT_TRUE(kinds().empty());
  good("pick vertex 0");
  (void)picture();
  good("click kind:no-corner");
  EXPECT_TRUE(kinds().empty()) << "where three feature edges meet none of them can be slid along";
}

TEST_F(KindsInTheWindow, EdgesAreTurnedOneByOneAndByChains) {
  good("pick vertex 2");
  (void)picture();
  for (const char* item : {"edge:1-2", "edge:2-3", "edge:2-7", "chain:1-2"}) EXPECT_TRUE(has(item)) << item;
  good("click edge:1-2");
  EXPECT_EQ(kinds().no_features, (std::vector<EdgeEnds>{{1, 2}}));
  EXPECT_EQ(active().domain->held_on(2), HeldOn::End);
  good("click chain:2-3");
  EXPECT_EQ(kinds().no_features.size(), 3U) << "as far as the feature edges go, the other one was made smooth before";
  EXPECT_TRUE(active().domain->on_surface(2));
  good("click chain:2-3");
  EXPECT_TRUE(kinds().empty()) << "the way back";
  good("click edge:2-7");
  EXPECT_EQ(kinds().features, (std::vector<EdgeEnds>{{2, 7}}));
  good("click edge:2-7");
  EXPECT_TRUE(kinds().empty());
  good("pick element 0");
  (void)picture();
  int shown = 0;
  for (const auto& [item, box] : window_->app().items().boxes()) shown += item.starts_with("edge:") ? 1 : 0;
  EXPECT_EQ(shown, 4);
}

TEST_F(KindsInTheWindow, MarksAndColoursFollowAtOnce) {
  good("view-from iso");
  good("features on");
  Index seen = kNoIndex;  // on the side towards the eye
  for (Index v = 0; v < active().fixed.size() && seen == kNoIndex; ++v) {
    const Vec3 p = session()->frame->positions[v];
    if (p.z == 1.0 && active().domain->on_surface(v)) seen = v;
  }
  ASSERT_NE(seen, kNoIndex);
  for (const char* mode : {"color-by quality", "color-by freedom"}) {
    good(mode);
    const auto before = mesh_picture();
    good("corner " + std::to_string(seen));
    EXPECT_TRUE(mesh_picture() != before) << mode;
    good("undo");
    EXPECT_TRUE(mesh_picture() == before) << mode;
  }
  good("color-by quality");
  const auto before = mesh_picture();
  good("feature " + std::to_string(seen) + "-" + std::to_string(seen + 1));
  EXPECT_TRUE(mesh_picture() != before);
}

/// The edge below the mouse in the inspector is marked in the mesh.
TEST_F(KindsInTheWindow, TheMouseFindsAnEdge) {
  good("pick vertex 2");
  (void)picture();
  const auto box = window_->app().items().boxes().at("edge:2-3");
  EXPECT_FALSE(state().edge_under_mouse);
  good("move " + std::to_string(static_cast<int>((box[0] + box[2]) / 2)) + " " + std::to_string(static_cast<int>((box[1] + box[3]) / 2)));
  (void)picture();
  ASSERT_TRUE(state().edge_under_mouse);
  EXPECT_EQ(*state().edge_under_mouse, (EdgeEnds{2, 3}));
  good("move 640 600");
  (void)picture();
  EXPECT_FALSE(state().edge_under_mouse);
}

/// A right click offers the edge nearest to the mouse.
TEST_F(KindsInTheWindow, AMenuTurnsTheNearestEdge) {
  good("view-from +z");
  good("fit");
  good("right-click 640 400");
  (void)picture();
  EXPECT_TRUE(has("menu:edge"));
  good("click menu:edge");
  ASSERT_EQ(kinds().features.size(), 1U);
  for (const Index v : kinds().features[0]) EXPECT_EQ(session()->frame->positions[v].z, 1.0);
  good("right-click 640 400");
  (void)picture();
  good("click menu:edge");
  EXPECT_TRUE(kinds().empty()) << "the same edge, back";
}

TEST_F(KindsInTheWindow, KeysGiveThePickedVertexItsKind) {
  EXPECT_TRUE(window_->run("make corner").has_value()) << "nothing is picked";
  good("pick vertex 2");
  good("key Alt+V");
  EXPECT_EQ(kinds().corners, std::vector<Index>{2});
  good("key Shift+Alt+V");
  EXPECT_EQ(kinds().no_corners, std::vector<Index>{2});
  good("make auto-corner");
  EXPECT_TRUE(kinds().empty());
  good("select vertex 2 3");
  good("make corner");
  EXPECT_EQ(kinds().corners, (std::vector<Index>{2, 3}));
  EXPECT_TRUE(window_->run("make edge").has_value());
}

TEST_F(KindsInTheWindow, NothingIsOfferedWhereNothingSlides) {
  good("generate annulus");
  good("pick vertex 0");
  (void)picture();
  EXPECT_FALSE(has("kind:corner"));
  good("boundary slide");
  (void)picture();
  const bool at_boundary = session()->input->topology.boundary()[0] != 0;
  EXPECT_EQ(has("kind:corner"), at_boundary);
}

}  // namespace
}  // namespace dmoscope::app
