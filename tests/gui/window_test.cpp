// The real window, off screen: keys, clicks by name and by pixel, pictures.
#include <filesystem>
#include <fstream>
#include <memory>

#include <gtest/gtest.h>

#include "app/window/picture.h"
#include "app/window/script.h"
#include "core/quality/metric.h"
#include "render/context.h"
#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"

namespace dmoscope::app {
namespace {

using ui::Dialog;
using ui::Picked;

std::filesystem::path folder() {
  const auto path = std::filesystem::path(testing::TempDir()) / "dmoscope window";
  std::filesystem::create_directories(path);
  return path;
}

class Window : public HeadlessTest {
 protected:
  [[nodiscard]] std::uint64_t iteration() { return session()->frame->moment.iteration; }
};

TEST_F(Window, StepsByKeyAndByButton) {
  good("generate annulus");
  good("key N");
  EXPECT_EQ(iteration(), 1U);
  good("click step-iteration");
  EXPECT_EQ(iteration(), 2U);
  good("key B");
  EXPECT_EQ(iteration(), 1U);
  good("click reset");
  EXPECT_EQ(iteration(), 0U);
  good("key C");
  EXPECT_EQ(iteration(), 0U);
  EXPECT_GT(session()->frame->moment.visits, 1U);
}

TEST_F(Window, TheBackendIsChosenInTheParametersAndARefusalIsSaid) {
  open(1280, 1400);
  good("generate annulus");
  EXPECT_EQ(session()->runs[0].parameters.backend, Backend::Auto);
  good("click backend");
  good("click backend:cpu");
  EXPECT_EQ(session()->runs[0].parameters.backend, Backend::Cpu);
  EXPECT_EQ(session()->runs[0].backend, Backend::Cpu);
  EXPECT_EQ(session()->runs[0].backend_reason, "");
  good("click backend");
  const auto failure = window_->run("click backend:cuda");
  if (!failure) GTEST_SKIP() << "there is a CUDA device: nothing was refused";
  EXPECT_NE(failure->text.find("the cuda backend cannot be used: "), std::string::npos) << failure->text;
  EXPECT_EQ(session()->runs[0].parameters.backend, Backend::Cpu);
}

TEST_F(Window, StepsNothingWithoutAMesh) {
  good("key N");
  EXPECT_EQ(session()->frame, nullptr);
  EXPECT_EQ(state().dialog, Dialog::None);
}

TEST_F(Window, ASampleOpensFromTheStartPage) {
  good("click sample:annulus");
  ASSERT_NE(session()->frame, nullptr);
  EXPECT_NE(session()->input->mesh.name.find("annulus"), std::string::npos);
}

TEST_F(Window, TheShownMetricChangesWithoutLoadingAgain) {
  good("generate annulus");
  const auto before = session();
  good("key M");  // not the mean ratio by area, which has the same values for triangles
  const auto after = session();
  EXPECT_NE(before->shown, after->shown);
  EXPECT_EQ(before->input, after->input);
  EXPECT_NE(before->frame->quality, after->frame->quality);
  EXPECT_EQ(before->frame->positions, after->frame->positions);
}

/// Place of a point of the mesh in the window.
std::pair<double, double> on_window(HeadlessWindow& window, Vec2<double> point) {
  const auto& state = window.app().state();
  const auto pixel = state.camera.to_pixel(point, state.viewport);
  const auto& box = window.app().items().find("viewport");
  return {static_cast<double>(box[0]) + pixel.x, static_cast<double>(box[1]) + pixel.y};
}

TEST_F(Window, AClickOnAVertexPicksThatVertex) {
  good("generate annulus");
  for (const Index vertex : {10U, 57U, 101U}) {
    good("goto vertex " + std::to_string(vertex));
    good("pick none");
    const auto view = session();
    const auto [x, y] = on_window(*window_, view->input->geometry.plane.project(view->frame->positions[vertex]));
    good("click " + std::to_string(x) + " " + std::to_string(y));
    EXPECT_EQ(state().picked, (Picked{Picked::Kind::Vertex, vertex}));
  }
}

TEST_F(Window, AClickInsideAnElementPicksThatElement) {
  good("generate annulus");
  for (const Index element : {3U, 44U, 120U}) {
    good("goto element " + std::to_string(element));
    good("pick none");
    good("move 3 3");
    const auto view = session();
    Vec2<double> centre{0, 0};
    const auto corners = view->input->mesh.elements.corners(element);
    for (const Index corner : corners) {
      const auto p = view->input->geometry.plane.project(view->frame->positions[corner]);
      centre = {centre.x + p.x / static_cast<double>(corners.size()), centre.y + p.y / static_cast<double>(corners.size())};
    }
    const auto [x, y] = on_window(*window_, centre);
    good("click " + std::to_string(x) + " " + std::to_string(y));
    EXPECT_EQ(state().picked, (Picked{Picked::Kind::Element, element}));
  }
}

TEST_F(Window, ADragMovesThePictureAndPicksNothing) {
  good("generate annulus");
  good("pick vertex 5");
  const auto before = state().camera;
  good("drag 500 300 600 340");
  EXPECT_NEAR((before.centre.x - state().camera.centre.x) / before.units_per_pixel, 100, 1.0);
  EXPECT_NEAR((state().camera.centre.y - before.centre.y) / before.units_per_pixel, 40, 1.0);
  good("right-drag 600 340 500 300");
  EXPECT_NEAR((before.centre.x - state().camera.centre.x) / before.units_per_pixel, 0, 1.0);
  EXPECT_EQ(state().picked, (Picked{Picked::Kind::Vertex, 5}));
}

TEST_F(Window, TheWheelKeepsThePointUnderTheCursor) {
  good("generate annulus");
  const auto& box = window_->app().items().find("viewport");
  const Vec2<double> cursor{500.0 - static_cast<double>(box[0]), 300.0 - static_cast<double>(box[1])};
  const auto before = state().camera.to_plane(cursor, state().viewport);
  const double scale = state().camera.units_per_pixel;
  good("wheel 500 300 2");
  const auto after = state().camera.to_plane(cursor, state().viewport);
  EXPECT_LT(state().camera.units_per_pixel, scale);
  EXPECT_NEAR(before.x, after.x, 1e-6 * scale * 1000);
  EXPECT_NEAR(before.y, after.y, 1e-6 * scale * 1000);
}

TEST_F(Window, PicturesTellStatesApart) {
  good("generate annulus");
  const render::Image before = window_->picture();
  window_->settle();
  EXPECT_TRUE(render::compare(before, window_->picture()).alike());
  good("run 5");
  const render::Image after = window_->picture();
  EXPECT_FALSE(render::compare(before, after).alike());
  good("theme light");
  EXPECT_FALSE(render::compare(after, window_->picture()).alike());
  good("theme dark");
  EXPECT_TRUE(render::compare(after, window_->picture()).alike());
}

TEST_F(Window, ScreenshotsAreWrittenInTheSizeAskedFor) {
  good("generate annulus");
  const auto mesh = folder() / "mesh.png", whole = folder() / "window.png";
  good("screenshot \"" + mesh.string() + "\" --size 320x200 --supersample 2");
  good("screenshot \"" + whole.string() + "\" --window");
  EXPECT_EQ(render::read_png(mesh).width, 320);
  EXPECT_EQ(render::read_png(mesh).height, 200);
  EXPECT_EQ(render::read_png(whole).width, 1280);
  EXPECT_TRUE(window_->run("screenshot /proc/none/x.png").has_value());
}

TEST_F(Window, ABadFileOpensTheErrorDialogAndLeavesTheMesh) {
  good("generate annulus");
  const auto bad = folder() / "bad.off";
  std::ofstream(bad) << "OFF\n3 1 0\n0 0 0\n1 0 0\nnonsense\n3 0 1 2\n";
  const auto failure = window_->run("open \"" + bad.string() + "\"");
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->exit_code, 3);
  EXPECT_EQ(state().dialog, Dialog::Error);
  EXPECT_NE(state().error_text.find("bad.off:5"), std::string::npos) << state().error_text;
  EXPECT_NE(session()->input->mesh.name.find("annulus"), std::string::npos);
  good("click error:copy");
  EXPECT_EQ(window_->clipboard(), state().error_text);
  good("key Escape");
  EXPECT_EQ(state().dialog, Dialog::None);
}

TEST_F(Window, ASuccessTakesAnOldErrorAway) {
  good("generate annulus");
  for (const char* success : {"theme light", "wireframe toggle", "step iteration"}) {
    EXPECT_TRUE(window_->run("open /none.off").has_value());
    good("key Escape");
    ASSERT_TRUE(state().result.newest());
    EXPECT_EQ(state().result.newest()->kind, Message::Kind::Error);
    good(success);
    EXPECT_TRUE(!state().result.newest() || state().result.newest()->kind != Message::Kind::Error) << success;
  }
}

TEST_F(Window, ThePaletteRunsWhatIsTyped) {
  good("generate annulus");
  good("key Ctrl+P");
  ASSERT_EQ(state().dialog, Dialog::Palette);
  good("type \"step iteration 2\"");
  good("key Enter");
  EXPECT_EQ(state().dialog, Dialog::None);
  EXPECT_EQ(iteration(), 2U);
}

TEST_F(Window, KeysTypedIntoATextAreNoCommands) {
  good("generate annulus");
  good("key Ctrl+F");
  ASSERT_EQ(state().dialog, Dialog::Find);
  good("type 12");
  good("key N");
  EXPECT_EQ(iteration(), 0U);
  good("key Enter");
  EXPECT_EQ(state().picked, (Picked{Picked::Kind::Vertex, 12}));
}

TEST_F(Window, EveryDialogOpensAndCloses) {
  good("generate annulus");
  for (const char* name : {"open", "export", "screenshot", "find", "palette", "keys", "about"}) {
    good(std::string("dialog ") + name);
    EXPECT_NE(state().dialog, Dialog::None) << name;
    good("key Escape");
    EXPECT_EQ(state().dialog, Dialog::None) << name;
  }
  good("key N");
  EXPECT_EQ(iteration(), 1U);
}

TEST_F(Window, TheWorstListJumps) {
  good("generate annulus");
  const Index worst = session()->frame->worst[0].element;
  good("click worst:0");
  EXPECT_EQ(state().picked, (Picked{Picked::Kind::Element, worst}));
}

TEST_F(Window, MetricNamesFitOnOneLineWhateverTheKindAndScale) {
  for (const auto& [size, scale] : {std::pair{"1280 1400", "1"}, {"2560 2800", "2"}}) {
    good(std::string("size ") + size);
    good(std::string("scale ") + scale);
    for (const char* mesh : {"annulus", "quads", "mixed"}) {
      good(std::string("generate ") + mesh);
      good("step iteration");
      good("pick element 3");
      for (const MetricInfo& metric : metric_table()) {
        if (!metric.defined_for(window_->app().frame()->input->mesh.elements.kind(3))) continue;
        const auto& box = window_->app().items().find("metric:" + std::string(metric.name));
        EXPECT_LT(box[3] - box[1], 1.5F * 15.0F * static_cast<float>(state().scale)) << metric.name << " " << mesh << " " << scale;
        EXPECT_GT(box[2] - box[0], 3.0F * 15.0F * static_cast<float>(state().scale)) << metric.name;
      }
    }
  }
}

TEST_F(Window, SmallWindowsFoldTheirPanels) {
  good("size 700 600");
  good("generate annulus");
  EXPECT_FALSE(window_->app().items().boxes().contains("fold:left")) << "no dock stands there";
  good("click fold:right");
  EXPECT_TRUE(state().panels.right_over);
  good("key N");
  EXPECT_EQ(iteration(), 1U);
}

TEST(Script, StopsAtTheFirstFailingLine) {
  ScriptOptions options;
  options.threads = 1;
  options.lines = {"# a comment", "generate annulus", "run 2", "expect iteration == 2"};
  EXPECT_EQ(run_script(options), 0);
  options.lines.push_back("expect iteration == 7");
  testing::internal::CaptureStderr();
  EXPECT_EQ(run_script(options), 1);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("script:5: "), std::string::npos);
  options.lines = {"open /no/such/file.off"};
  EXPECT_EQ(run_script(options), 3);
  options.lines = {"step sideways"};
  EXPECT_EQ(run_script(options), 2);
  options.lines = {"say \"open quote"};
  EXPECT_EQ(run_script(options), 2);
}

}  // namespace
}  // namespace dmoscope::app
