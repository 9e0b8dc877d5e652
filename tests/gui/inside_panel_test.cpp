// The visible part of a volume mesh, chosen in the panel and in the view; as commands, saved and restored.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "render/image.h"
#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/state/command_log.h"

namespace dmoscope::app {
namespace {

class InsidePanel : public HeadlessTest {
 protected:
  void SetUp() override {
    HeadlessTest::SetUp();
    if (!IsSkipped()) open_block();
  }
  /// Opens 4 x 4 x 4 hexahedra over the unit cube.
  void open_block() {
    const Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.2);
    Progress progress;
    write_mesh(folder_.path() / "block.vtk", mesh, mesh.positions, progress);
    good("open \"" + (folder_.path() / "block.vtk").string() + "\"");
  }
  [[nodiscard]] const ClippingView& inside() { return state().inside; }
  [[nodiscard]] std::array<float, 4> box(const std::string& item) { return window_->app().items().find(item); }
  [[nodiscard]] bool has(const std::string& item) { return window_->app().items().boxes().contains(item); }
  /// Drags from the middle of an item.
  void drag(const std::string& item, float dx, float dy) {
    const auto at = box(item);
    const float x = (at[0] + at[2]) / 2, y = (at[1] + at[3]) / 2;
    good(fmt::format("drag {} {} {} {}", x, y, x + dx, y + dy));
  }
  /// Commands in the log with this first word.
  [[nodiscard]] std::size_t told(const std::string& verb) {
    const auto& lines = state().commands.lines();
    return static_cast<std::size_t>(std::ranges::count_if(
        lines, [&](const ui::LogLine& line) { return line.kind == ui::LogLine::Kind::Command && line.text.starts_with(verb + " "); }));
  }

  const test::TemporaryFolder folder_;
};

TEST_F(InsidePanel, EveryWidgetDoesWhatItsCommandDoes) {
  good("click inside:clip");
  EXPECT_TRUE(inside().clip.on);
  EXPECT_EQ(inside().clip.normal, (Vec3{1, 0, 0}));
  EXPECT_DOUBLE_EQ(inside().clip.offset, 0.5);
  good("click inside:z");
  EXPECT_EQ(inside().clip.normal, (Vec3{0, 0, 1}));
  good("click inside:flip");
  EXPECT_TRUE(inside().clip.flip);
  good("click inside:cut");
  EXPECT_EQ(inside().clip.mode, ClipPlane::Mode::Cut);
  good("click inside:whole");
  EXPECT_EQ(inside().clip.mode, ClipPlane::Mode::Crinkle);
  good("click inside:peel-more");
  EXPECT_EQ(inside().peel, 1U);
  good("click inside:peel-less");
  EXPECT_EQ(inside().peel, 0U);
  good("click inside:worst");
  EXPECT_EQ(inside().worst, 50U);
  EXPECT_TRUE(inside().ghost);
  good("click inside:ghost");
  EXPECT_FALSE(inside().ghost);
  good("click inside:perspective");
  EXPECT_TRUE(state().orbit.perspective);
  good("click inside:trackball");
  EXPECT_TRUE(state().trackball);
  good("click from:+x");
  EXPECT_NEAR(state().orbit.back().x, 1.0, 1e-12);
  good("click inside:all");
  EXPECT_EQ(inside(), ClippingView{});
}

TEST_F(InsidePanel, KeysAndMenusReachIt) {
  good("key J");
  EXPECT_TRUE(inside().clip.on);
  EXPECT_FALSE(inside().clip.flip);
  good("key Ctrl+J");
  EXPECT_EQ(inside().clip.normal, (Vec3{0, 1, 0}));
  EXPECT_TRUE(inside().clip.flip);  // seen from (1, -1, 1): the side towards the eye is taken away
  good("key Shift+J");
  EXPECT_FALSE(inside().clip.flip);
  good("key Y");
  EXPECT_EQ(inside().peel, 1U);
  good("key E");
  EXPECT_LT(inside().shrink, 1.0);
  good("key Z");
  EXPECT_EQ(inside(), ClippingView{});
  good("key Alt+Z");
  EXPECT_NEAR(state().orbit.back().z, 1.0, 1e-12);
  good("click menu:View");
  good("click menu:Inside");
  good("click menu:inside-worst");
  EXPECT_EQ(inside().worst, 50U);
}

TEST_F(InsidePanel, ASliderIsSeenAsItMovesAndToldOnce) {
  good("clip x");
  const std::size_t before = told("clip");
  good("tab inside");
  const auto at = box("inside:place");
  drag("inside:place", -(at[2] - at[0]) / 4, 0);
  EXPECT_NEAR(inside().clip.offset, 0.25, 0.05);  // a quarter of its length; the knob has a width
  EXPECT_EQ(told("clip"), before + 1);
  drag("inside:shrink", -20, 0);
  EXPECT_LT(inside().shrink, 1.0);
  EXPECT_EQ(told("shrink"), 1U);
}

TEST_F(InsidePanel, TheClipPlaneIsDraggedAlongItsNormal) {
  good("view-from +z");  // x points to the right
  good("clip x");
  const std::size_t before = told("clip");
  const render::OrbitCamera camera = state().orbit;
  drag("clip-handle", 50, 30);
  const double unit = camera.height / state().viewport.y;
  EXPECT_NEAR(inside().clip.offset, 0.5 + 50 * unit, 1e-3);  // commands have four digits
  EXPECT_EQ(told("clip"), before + 1);
  EXPECT_EQ(state().orbit, camera);
  drag("clip-handle", 5000, 0);
  EXPECT_NEAR(inside().clip.offset, 1.0, 1e-12);  // never outside the mesh
}

TEST_F(InsidePanel, APlaneSeenFromAboveIsDraggedUpAndDown) {
  good("view-from +z");
  good("clip z");
  drag("clip-handle", 0, -40);  // up is towards the eye
  EXPECT_NEAR(inside().clip.offset, 0.5 + 40 * state().orbit.height / state().viewport.y, 1e-3);
}

TEST_F(InsidePanel, ANewPlaneUncoversWhatTheEyeSees) {
  for (const auto& [from, axis, flip] : {std::tuple{"-x", "x", true}, {"+x", "x", false}, {"+y", "y", false}, {"-z", "z", true}}) {
    good("clip off");
    good(fmt::format("view-from {}", from));
    good(fmt::format("click inside:{}", axis));
    EXPECT_EQ(inside().clip.flip, flip) << from;
  }
  good("view-from -x");
  good("show-all");
  good("clip on");
  EXPECT_TRUE(inside().clip.flip);
  EXPECT_DOUBLE_EQ(inside().clip.offset, 0.5);
  good("clip x:0.3");  // as the command says it
  EXPECT_FALSE(inside().clip.flip);
}

TEST_F(InsidePanel, ARangeThatNoSliderTellsIsSaidAndTakenBack) {
  EXPECT_FALSE(has("inside:kept"));
  good("keep-quality 0 0.4");
  good("click inside:kept");
  EXPECT_FALSE(inside().isolate.has_value());
  EXPECT_FALSE(has("inside:kept"));
  good("keep-quality 0.2 1");
  EXPECT_FALSE(has("inside:kept"));  // "hide worse" shows the range
}

TEST_F(InsidePanel, IsOfVolumesAlone) {
  good("tab inside");
  EXPECT_TRUE(has("inside:clip"));
  EXPECT_TRUE(window_->run("brush on").has_value());
  EXPECT_TRUE(window_->run("link-cameras off").has_value());
  EXPECT_TRUE(window_->run("color-by valence").has_value());
  EXPECT_FALSE(window_->run("dialog none").has_value());
  for (const char* by : {"edge-length", "size", "displacement", "kind", "inverted", "difference"}) good(fmt::format("color-by {}", by));
  good("generate grid 100");
  EXPECT_FALSE(has("inside:clip"));
  good("brush on");
  good("link-cameras off");
}

class SavedInside : public InsidePanel {
 protected:
  void look_inside() {
    for (const char* line : {"clip -y:0.3", "clip-mode cut", "peel-quality 0.95", "ghost-rest on", "shrink 0.9", "perspective on",
                             "drag 600 300 680 330", "wheel 600 300 2", "move 2 2"})
      good(line);
    orbit_ = state().orbit;
    picture_ = window_->picture();
  }
  void expect_the_same() {
    good("move 2 2");
    EXPECT_NEAR(length(state().orbit.right - orbit_.right), 0.0, 1e-12);
    EXPECT_NEAR(length(state().orbit.centre - orbit_.centre), 0.0, 1e-12);
    EXPECT_TRUE(state().orbit.perspective);
    EXPECT_DOUBLE_EQ(inside().shrink, 0.9);
    const render::Difference difference = render::compare(window_->picture(), picture_);
    EXPECT_TRUE(difference.alike()) << difference.off_share << " of the pixels differ";
  }
  render::OrbitCamera orbit_;
  render::Image picture_;
};

TEST_F(SavedInside, ComesBackWithASession) {
  look_inside();
  const std::string file = (folder_ / "inside.dmoscope").string();
  good("save-session \"" + file + "\"");
  open();
  good("open-session \"" + file + "\"");
  EXPECT_TRUE(inside().clip.on);
  EXPECT_TRUE(inside().clip.flip);
  expect_the_same();
}

TEST_F(SavedInside, ComesBackWithAScript) {
  look_inside();
  const std::string file = (folder_ / "inside.txt").string();
  good("save-script \"" + file + "\"");
  open();
  std::ifstream script(file);
  for (std::string line; std::getline(script, line);) good(line);
  expect_the_same();
}

}  // namespace
}  // namespace dmoscope::app
