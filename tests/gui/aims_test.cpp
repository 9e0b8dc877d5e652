// A second aim in the window: the panel's switches, the point placed with the mouse, its colours, and where the second phase begins.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/gui/plots.h"
#include "tests/support/meshes.h"
#include "ui/analysis/element_colours.h"
#include "ui/commands/size_point.h"
#include "ui/plots/plot_drawing.h"

namespace dmoscope::app {
namespace {

class AimsInTheWindow : public HeadlessTest {
 protected:
  [[nodiscard]] const RunView& run() { return session()->runs[session()->active]; }
};

TEST_F(AimsInTheWindow, ThePanelSwitchesThem) {
  good("generate random 300 7");
  good("click then-mean");
  EXPECT_TRUE(session()->runs[session()->active].parameters.then_mean);
  good("click then-mean");
  good("click combine");
  auto parameters = session()->runs[session()->active].parameters;
  EXPECT_FALSE(parameters.then_mean);
  ASSERT_TRUE(parameters.combination);
  EXPECT_NE(parameters.combination->size(), nullptr);
  good("click size-function");
  good("click size-function:h2");
  parameters = session()->runs[session()->active].parameters;
  EXPECT_EQ(parameters.combination->size()->kind, SizeFunction::Kind::InverseDistance);
}

TEST_F(AimsInTheWindow, AClickPlacesThePoint) {
  good("generate random 300 7");
  EXPECT_TRUE(window_->run("place-size-point").has_value()) << "there is no point to place";
  good("combine mean-ratio:0.4:density h1:0,0");
  good("place-size-point");
  EXPECT_TRUE(state().placing_size_point);
  good("click viewport");
  EXPECT_FALSE(state().placing_size_point);
  const auto view = session();
  const Vec3* point = ui::size_point_of(view->runs[view->active]);
  ASSERT_NE(point, nullptr);
  const Vec2<double> middle = state().camera.centre;
  EXPECT_NEAR(point->x, middle.x, 2 * state().camera.units_per_pixel);
  EXPECT_NEAR(point->y, middle.y, 2 * state().camera.units_per_pixel);
  EXPECT_EQ(state().picked.kind, ui::Picked::Kind::None) << "it picks nothing";
}

TEST_F(AimsInTheWindow, AMarkIsLookedIntoWithTheAimOfItsOwnPhase) {
  good("generate random 300 7");
  good("click then-mean");
  good("mark a");
  good("step iteration");
  good("run 400");
  good("mark b");
  ASSERT_TRUE(run().phases.mean_since);
  ASSERT_LT(*run().phases.mean_since, run().moment.iteration);
  const Index vertex = run().colouring->order.front();
  good("inspect on");
  good("pick vertex " + std::to_string(vertex));
  const auto has_optimum = [&] { return window_->app().inspection().optimum.has_value(); };  // of the first phase's single aim
  ASSERT_TRUE(window_->app().inspection().trace);
  EXPECT_FALSE(has_optimum());
  good("flip a");
  ASSERT_TRUE(window_->app().inspection().trace);
  EXPECT_TRUE(has_optimum());
  good("seek 0");
  EXPECT_TRUE(has_optimum());
  good("flip b");
  ASSERT_TRUE(window_->app().inspection().trace);
  EXPECT_FALSE(has_optimum());
}

TEST(ElementColours, EdgeLengthAndSizeOverTarget) {
  const auto input = dmoscope::testing::input(dmoscope::testing::lattice(10, 0.0, 1, dmoscope::testing::Cells::Quadrilaterals));
  const auto frame = std::make_shared<Frame>();
  frame->input = input;
  frame->positions = input->mesh.positions;
  const auto colours = [&](ui::ColourBy by, std::shared_ptr<const SizeField> size) {
    return ui::colour_elements({by, frame, nullptr, render::ColourMap::Viridis, false, std::move(size)});
  };
  const auto lengths = colours(ui::ColourBy::EdgeLength, nullptr), nothing = colours(ui::ColourBy::SizeOverTarget, nullptr);
  for (const float value : lengths.shading->values) EXPECT_NEAR(static_cast<double>(value), -1.0, 1e-6) << "edges are 0.1 long";
  for (const float value : nothing.shading->values) EXPECT_TRUE(std::isnan(value));
  const Vec3 point{-1.0, -1.0, 0.0};
  const auto size = std::make_shared<const SizeField>(input, SizeFunction{SizeFunction::Kind::Distance, point, {}});
  const auto over = colours(ui::ColourBy::SizeOverTarget, size);
  EXPECT_TRUE(over.logarithmic);
  EXPECT_DOUBLE_EQ(over.range.first, -over.range.second);
  EXPECT_TRUE(over.centred);
  EXPECT_FALSE(nothing.has_values);
  EXPECT_NE(nothing.note.find("no size function"), std::string::npos);
  double mean = 0.0;
  for (const Vec3& p : input->mesh.positions) mean += std::log10(0.1 / length(p - point));
  mean /= static_cast<double>(input->mesh.positions.size());
  for (const Index e : {0U, 42U, 99U}) {
    double sum = 0.0;
    for (const Index corner : input->mesh.elements.corners(e)) sum += std::log10(0.1 / length(input->mesh.positions[corner] - point));
    EXPECT_NEAR(static_cast<double>(over.shading->values[e]), sum / 4 - mean, 1e-5);
  }
}

TEST_F(AimsInTheWindow, ARunWithoutSizesDoesNotStretchTheColours) {
  good("generate annulus 400");
  good("run 1");
  good("combine mean-ratio:0.7:density h1:0,0");
  good("run 2");
  good("color-by size-over-target");
  good("viewports 2");
  good("pane 1 input");
  good("pane 2 run 2");
  good("focus-pane 1");
  EXPECT_TRUE(window_->app().colours()->has_values) << "the bar is of the one that has sizes";
  EXPECT_EQ(window_->app().values_range(), window_->app().colours()->range);
}

TEST(PlotSeries, TheSecondPhaseIsMarked) {
  SessionView session = ui::session_of(2, 9);
  EXPECT_TRUE(std::ranges::none_of(ui::plot_of(session).marks, [](const ui::PlotMark& mark) { return !mark.label.empty(); }));
  for (RunView& run : session.runs) run.phases.mean_since = 3;
  session.runs[session.active].phases.mean_since = 4;
  const auto marks = ui::plot_of(session).marks;
  const auto found = std::ranges::find(marks, std::string("mean"), &ui::PlotMark::label);
  ASSERT_NE(found, marks.end());
  EXPECT_EQ(found->x, 4.0);
  EXPECT_EQ(std::ranges::count(marks, std::string("mean"), &ui::PlotMark::label), 1) << "those of all runs would lie on one another";
}

TEST(PlotSeries, PhasesThatBeginTogetherAreBothReadable) {
  SessionView session = ui::session_of(2, 9);
  session.runs[session.active].phases.joint_since = session.runs[session.active].phases.mean_since = 4;
  const Drawing drawing = ui::whole_plot(ui::plot_of(session), {}, 900, 600, ui::ink_of(ui::colours()));
  const auto joint = *std::ranges::find(drawing.labels, std::string("joint"), &Drawing::Label::text);
  EXPECT_TRUE(std::ranges::any_of(drawing.labels, [&](const Drawing::Label& label) {
    return label.text == "mean" && label.at.x == joint.at.x && std::abs(label.at.y - joint.at.y) >= label.size;
  }));
}

}  // namespace
}  // namespace dmoscope::app
