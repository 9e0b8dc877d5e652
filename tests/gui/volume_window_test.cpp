// A volume mesh in the window: drawn, turned, clipped and picked by commands and by the mouse.
#include <algorithm>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/overlays/overlay.h"
#include "ui/state/actions.h"

namespace dmoscope::app {
namespace {

class VolumeWindow : public HeadlessTest {
 protected:
  void SetUp() override {
    HeadlessTest::SetUp();
    if (IsSkipped()) return;
    const Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra, 0.2);
    Progress progress;
    write_mesh(folder_.path() / "block.vtk", mesh, mesh.positions, progress);
    good("open \"" + (folder_.path() / "block.vtk").string() + "\"");
  }
  [[nodiscard]] std::vector<std::uint8_t> picture() { return window_->picture().rgba; }
  test::TemporaryFolder folder_;
};

TEST_F(VolumeWindow, IsSeenFromEverySideAndInside) {
  std::vector<std::vector<std::uint8_t>> pictures{picture()};
  for (const char* line : {"view-from +x", "turn 40 20", "perspective on", "clip x:0.6", "clip-mode cut", "clip flip", "clip off", "peel 1",
                           "show-all", "shrink 0.7", "keep-quality 0 0.7", "keep-quality off", "worst-cells 5"}) {
    good(line);
    pictures.push_back(picture());
    EXPECT_TRUE(pictures.back() != pictures[pictures.size() - 2]) << line;
  }
  good("show-all");
  EXPECT_EQ(state().inside, ClippingView{});
}

TEST_F(VolumeWindow, ThePlaceInsideIsMarkedForAllThatAreListed) {
  Mesh mesh;
  mesh.positions = {{5, -6, -2}, {11, -6, -2}, {17, 6, 3}, {7, 6, 1}, {7, -2, 15}, {5, 5, 5}, {4, 4, 11}, {2, 6, 8}};
  mesh.elements.add(ElementKind::Hexahedron, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7});
  Progress progress;
  write_mesh(folder_.path() / "inside.vtk", mesh, mesh.positions, progress);
  good("open \"" + (folder_.path() / "inside.vtk").string() + "\"");
  good("view-from +x");
  const auto worst = session()->frame->worst;
  ASSERT_EQ(worst.size(), 1U);
  ASSERT_TRUE(worst[0].inside.has_value());
  EXPECT_EQ(state().picked.kind, ui::Picked::Kind::None);
  const auto marked = picture();
  good("worst off");
  EXPECT_NE(picture(), marked);
  render::Marks marks;
  const ui::MarkView view{window_->app().panes().front().view.value()};
  ui::add_inverted_inside(marks, view, *session()->frame, {});
  ASSERT_EQ(marks.dots.size(), 2U) << "casing and diamond";
  EXPECT_EQ(marks.dots[1].point, *worst[0].inside);
  EXPECT_EQ(marks.dots[1].shape, render::DotShape::Diamond);
}

TEST_F(VolumeWindow, ADragTurnsItAndAClickPicks) {
  const render::OrbitCamera before = state().orbit;
  good("drag 600 300 660 320");
  EXPECT_NE(state().orbit.right, before.right);
  EXPECT_EQ(state().orbit.centre, before.centre);
  EXPECT_EQ(state().picked.kind, ui::Picked::Kind::None);  // a drag is not a click
  good("click 640 330");
  EXPECT_NE(state().picked.kind, ui::Picked::Kind::None);
}

TEST_F(VolumeWindow, ARightDragPansAndOpensNoMenu) {
  const render::OrbitCamera before = state().orbit;
  const auto items = window_->app().items().boxes().size();
  good("right-drag 600 300 660 320");
  EXPECT_EQ(state().orbit.right, before.right);
  EXPECT_NE(state().orbit.centre, before.centre);
  good("move 600 300");
  EXPECT_EQ(window_->app().items().boxes().size(), items) << "no menu has come";
  good("right-click 600 300");
  good("move 600 300");
  EXPECT_GT(window_->app().items().boxes().size(), items) << "a click without a drag opens it";
}

/// A fitted mesh lies within its viewport, as large as title and colour bar allow.
TEST_F(VolumeWindow, AFitFillsViewportsOfEveryShape) {
  const double em = 15.0;
  for (const char* size : {"800 600", "1280 800", "700 1000"}) {
    for (const char* layout : {"1", "2", "4"}) {
      for (const char* line : {"perspective on", "view-from +y", "perspective off", "view-from iso"}) {
        for (const std::string& each : {std::string("size ") + size, std::string("viewports ") + layout, std::string(line)}) good(each);
        SCOPED_TRACE(fmt::format("{}, {} viewports, {}", size, layout, line));
        const auto frame = session()->frame;
        render::Bounds3 box;
        for (const Vec3& p : frame->positions) box.include(p);
        const Vec2<double> viewport = state().viewport;
        const render::Projection projection = state().orbit.projection(viewport, box);
        double left = 1e9, right = -1e9, low = 1e9, high = -1e9;
        for (const Vec3& p : frame->positions) {
          const auto place = projection.place(p);
          ASSERT_TRUE(place.has_value());
          left = std::min(left, 0.5 * viewport.x + place->x);
          right = std::max(right, 0.5 * viewport.x + place->x);
          low = std::min(low, 0.5 * viewport.y + place->y);
          high = std::max(high, 0.5 * viewport.y + place->y);
        }
        EXPECT_GT(left, 0.0);
        EXPECT_LT(right, viewport.x);
        EXPECT_GT(low, 0.5 * em);
        EXPECT_LT(high, viewport.y - 2.4 * em);
        const auto& boxes = window_->app().items().boxes();
        const auto note = boxes.find("note");
        const bool below = note != boxes.end() && note->second[1] > boxes.at("viewport")[1] + static_cast<float>(2 * em);
        const double above = below ? 8.7 : 6.8;  // a note below the title has a line of its own
        EXPECT_TRUE(right - left > 0.88 * viewport.x || high - low > 0.88 * (viewport.y - above * em));
      }
    }
  }
}

TEST_F(VolumeWindow, TheMenuHasEverySampleThatCanBeMade) {
  std::size_t samples = 0;
  for (const ui::Action& action : ui::actions()) samples += action.id.starts_with("sample-") ? 1 : 0;
  EXPECT_EQ(samples, generator_table().size());
  for (const GeneratorInfo& generator : generator_table()) {
    const ui::Action* action = ui::find_action(fmt::format("sample-{}", generator.name));
    ASSERT_NE(action, nullptr) << generator.name;
    EXPECT_EQ(action->command, fmt::format("generate {}", generator.name));
  }
  for (const char* line : {"click menu:File", "click menu:Samples", "click menu:sample-tangled-solids"}) good(line);
  EXPECT_EQ(session()->input->mesh.name, "tangled-solids");
  EXPECT_TRUE(state().in_space);
}

TEST_F(VolumeWindow, AnInsideIsOfVolumesAlone) {
  good("generate coast 500");
  EXPECT_TRUE(window_->run("clip x").has_value());
}

}  // namespace
}  // namespace dmoscope::app
