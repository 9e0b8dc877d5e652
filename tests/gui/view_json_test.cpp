#include "ui/commands/view_json.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/meshes.h"

namespace dmoscope::ui {
namespace {

ViewState some_view() {
  ViewState state;
  state.camera = {{1.0 / 3.0, -1e7}, 0.1};
  state.wireframe = false;
  state.vertices = true;
  state.colour_map = render::ColourMap::Magma;
  state.panels.setup = false;
  state.panels.bottom_height = 21.5;
  state.plot = PlotTab::Sorted;
  state.plots[1].axis = ValueAxis::Log;
  state.plots[1].x_range = std::pair{0.25, 0.75};
  state.plots[1].hidden = {"dmo", "a \"quoted\" one"};
  state.timeline.play.speed = 2.5;
  state.picked = {Picked::Kind::Vertex, 7};
  state.orbit = {{1e-9, 2.0, 1.0 / 3.0}, 7.5, {0, 1, 0}, {0, 0, 1}, true};
  state.trackball = true;
  state.inside.clip = {true, {0.0, -3.0, 4.0}, 0.1, true, ClipPlane::Mode::Cut};
  state.inside.peel = 2;
  state.inside.peel_quality = 0.3F;
  state.inside.isolate = std::pair{0.1F, 0.7F};
  state.inside.worst = 12;
  state.inside.ghost = true;
  state.inside.shrink = 0.7;
  return state;
}

TEST(ViewJson, ComesBackAsItWas) {
  const Mesh mesh = testing::lattice(4, 0.0, 1);
  const ViewState state = some_view();
  ViewState read;
  apply_view_json(view_json(state), read, &mesh);
  EXPECT_EQ(read.camera, state.camera);
  EXPECT_FALSE(read.wireframe);
  EXPECT_EQ(read.colour_map, state.colour_map);
  EXPECT_FALSE(read.panels.setup);
  EXPECT_EQ(read.panels.bottom_height, 21.5);
  EXPECT_EQ(read.plot, PlotTab::Sorted);
  EXPECT_EQ(read.plots, state.plots);
  EXPECT_EQ(read.timeline.play.speed, 2.5);
  EXPECT_EQ(read.picked, state.picked);
  EXPECT_EQ(read.orbit, state.orbit);
  EXPECT_TRUE(read.trackball);
  EXPECT_EQ(read.inside, state.inside);
  EXPECT_EQ(view_json(read), view_json(state));
  EXPECT_EQ(view_json(state).find('\n'), std::string::npos);
}

TEST(ViewJson, WhatIsNotKnownOrMissingIsLeftAlone) {
  ViewState state = some_view();
  const std::string before = view_json(state);
  const Mesh mesh = testing::lattice(4, 0.0, 1);
  apply_view_json("{}", state, &mesh);
  EXPECT_EQ(view_json(state), before);
  state = {};
  apply_view_json(R"({"hologram": {"x": 1}, "wireframe": false, "camera": {"x": 5, "roll": 3}})", state, nullptr);
  EXPECT_FALSE(state.wireframe);
  EXPECT_EQ(state.camera.centre.x, 5.0);
  EXPECT_EQ(state.camera.units_per_pixel, 1.0);
}

TEST(ViewJson, WhatMakesNoSenseIsNamedAndChangesNothing) {
  const Mesh mesh = testing::lattice(4, 0.0, 1);
  const std::pair<const char*, const char*> wrong[] = {
      {"not json", "view: "},
      {"[1]", "view: expected an object"},
      {R"({"wireframe": false, "vertices": 1})", "view.vertices: "},
      {R"({"wireframe": false, "camera": 3})", "view.camera: "},
      {R"({"wireframe": false, "camera": {"units_per_pixel": 0}})", "view.camera.units_per_pixel: "},
      {R"({"wireframe": false, "camera": {"x": "left"}})", "view.camera.x: "},
      {R"({"wireframe": false, "colormap": "rainbow"})", "view.colormap: expected one of beacon"},
      {R"({"wireframe": false, "volume": {"centre": [1, 2]}})", "view.volume.centre: "},
      {R"({"wireframe": false, "volume": {"up": [1, 0, 0]}})", "view.volume.right, up: "},
      {R"({"wireframe": false, "volume": {"inside": {"shrink": 0}}})", "view.volume.inside.shrink: "},
      {R"({"wireframe": false, "volume": {"inside": {"clip": {"normal": [0, 0, 0]}}}})", "view.volume.inside.clip.normal: "},
      {R"({"wireframe": false, "colormap": 3})", "view.colormap: "},
      {R"({"wireframe": false, "plots": {"sorted": {"x_range": [1, 0]}}})", "view.plots.sorted.x_range: "},
      {R"({"wireframe": false, "plots": {"sorted": {"hidden": [1]}}})", "view.plots.sorted.hidden: "},
      {R"({"wireframe": false, "plots": {"sorted": {"hidden": "x"}}})", "view.plots.sorted.hidden: "},
      {R"({"wireframe": false, "plots": {"bins": "7"}})", "view.plots.bins: "},
      {R"({"wireframe": false, "picked": {"kind": "vertex", "id": 25}})", "view.picked.id: "},
      {R"({"wireframe": false, "picked": {"kind": "vertex", "id": -1}})", "view.picked.id: "},
      {R"({"wireframe": false, "speed": 1e9})", "view.speed: "}};
  for (const auto& [text, said] : wrong) {
    ViewState state;
    try {
      apply_view_json(text, state, &mesh);
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, std::string_view(said).size()), said) << text;
    }
    EXPECT_TRUE(state.wireframe) << text;
  }
}

}  // namespace
}  // namespace dmoscope::ui
