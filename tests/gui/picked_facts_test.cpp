// Texts of the window on a pick, the worst element, a run's end, and the reference of a difference.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"
#include "ui/analysis/facts.h"
#include "ui/analysis/step_report.h"
#include "ui/state/format.h"

namespace dmoscope::app {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class SaidInTheWindow : public HeadlessTest {
 protected:
  [[nodiscard]] bool shows(const std::string& item) { return window_->app().items().boxes().contains(item); }
};

TEST_F(SaidInTheWindow, AnglesInDegreesOfTheWorstElement) {
  good("generate annulus 300");
  good("show min-angle");
  const Frame& frame = *window_->app().frame();
  const auto angles = ui::angles_of(frame, frame.shown_statistics.worst_element);
  ASSERT_TRUE(angles.has_value());
  EXPECT_NEAR(angles->smallest, 60 * frame.shown_statistics.minimum, 1e-9) << "the metric is the least angle over 60 degrees";
  const auto corners = frame.input->mesh.elements.corners(frame.shown_statistics.worst_element);
  const auto side = [&](int i, int k) {
    const Vec3 a = frame.positions[corners[static_cast<std::size_t>(i)]], b = frame.positions[corners[static_cast<std::size_t>(k)]];
    return std::hypot(a.x - b.x, a.y - b.y);
  };
  // The greatest angle by the law of cosines, opposite the longest side.
  const double a = side(0, 1), b = side(1, 2), c = side(2, 0), longest = std::max({a, b, c});
  const double others = a * a + b * b + c * c - longest * longest, product = a * b * c / longest;
  EXPECT_NEAR(angles->largest, std::acos((others - longest * longest) / (2 * product)) * 180 / std::numbers::pi, 1e-6);
}

TEST_F(SaidInTheWindow, AnglesBetweenFacesOfVolumeElements) {
  good("generate tetrahedra 60");
  good("show min-angle");
  const Frame& frame = *window_->app().frame();
  const double regular = std::acos(1.0 / 3.0) * 180 / std::numbers::pi;
  for (Index e = 0; e < frame.element_count(); ++e) {
    const auto angles = ui::angles_of(frame, e);
    ASSERT_TRUE(angles.has_value());
    EXPECT_NEAR(angles->smallest, regular * static_cast<double>(frame.quality[e]), 1e-4)
        << "the metric is the least angle over the regular one's";
    EXPECT_GT(angles->largest, regular);
  }
  good(fmt::format("pick element {}", frame.worst.front().element));
  EXPECT_TRUE(shows("metric:min-angle"));
  EXPECT_FALSE(shows("metric:rectangularity")) << "it is not defined for tetrahedra";
  const test::TemporaryFolder folder;
  Progress progress;
  const Mesh bricks = test::volume_grid(2, test::Fill::Hexahedra, 0.0);
  write_mesh(folder.path() / "bricks.vtk", bricks, bricks.positions, progress);
  good("open \"" + (folder.path() / "bricks.vtk").string() + "\"");
  const auto angles = ui::angles_of(*window_->app().frame(), 0);
  EXPECT_NEAR(angles->smallest, 90.0, 1e-9);
  EXPECT_NEAR(angles->largest, 90.0, 1e-9);
}

TEST_F(SaidInTheWindow, TheWorstElementsAreWalkedFromTheirFacts) {
  good("generate random 300 3");
  const std::shared_ptr<const Frame> shown = window_->app().frame();
  const auto& worst = shown->worst;
  const auto element = [&](std::size_t rank) { return ui::Picked{ui::Picked::Kind::Element, worst[rank].element}; };
  good(fmt::format("pick element {}", worst.front().element));
  const auto place = window_->app().items().find("better-element");
  for (std::size_t rank = 1; rank <= 10; ++rank) {
    EXPECT_EQ(window_->app().items().find("better-element"), place) << "buttons stay under the pointer";
    good("click better-element");
    EXPECT_EQ(state().picked, element(rank));
  }
  good("click worse-element");
  EXPECT_EQ(state().picked, element(9));
  const auto listed = [&](Index e) { return std::ranges::find(worst, e, &RankedElement::element) != worst.end(); };
  Index other = 0;
  while (listed(other)) ++other;
  ASSERT_LT(other, shown->element_count());
  good(fmt::format("pick element {}", other));
  EXPECT_TRUE(shows("element-quality"));
  EXPECT_FALSE(shows("better-element")) << "it is none of the worst";
}

TEST_F(SaidInTheWindow, HowARunEndedInALine) {
  good("generate annulus 300");
  good("until-converged best");
  const RunView& run = session()->runs[0];
  const auto& first = run.records.whole().front().statistics;
  const std::string said = state().stepping.news.sentence;
  EXPECT_EQ(said, ui::end_sentence(run));
  EXPECT_THAT(said, StartsWith("Converged: minimum "));
  EXPECT_THAT(said, HasSubstr(ui::short_number(first.minimum) + " → "));
  EXPECT_THAT(said, HasSubstr(fmt::format("{} iterations, ", run.records.whole().back().iteration)));
  good("step iteration");
  EXPECT_THAT(state().stepping.news.sentence, ::testing::Not(StartsWith("Converged"))) << "of the step now";
  good("run 2");
  EXPECT_THAT(state().stepping.news.sentence, ::testing::Not(StartsWith("Stopped"))) << "a number of iterations is no end";
}

TEST_F(SaidInTheWindow, APickOpensItsFactsInANarrowWindow) {
  open(640, 520);
  good("generate annulus 300");
  ASSERT_FALSE(shows("tab:selection"));
  good("pick vertex 5");
  EXPECT_TRUE(shows("tab:selection"));
  EXPECT_TRUE(shows("inspect")) << "the facts of the vertex";
  EXPECT_FALSE(shows("settings")) << "and no more";
  good("pick none");
  EXPECT_FALSE(shows("tab:selection"));
  good("pick vertex 5");
  good("click fold:right");
  EXPECT_FALSE(shows("tab:selection")) << "it can be closed";
}

TEST_F(SaidInTheWindow, WhatADifferenceIsTakenFromIsChosen) {
  good("generate annulus 300");
  good("add-run laplace");
  good("each run 2");
  good("select-run 1");
  good("tab colours");
  EXPECT_FALSE(shows("reference"));
  good("color-by difference input");
  good("click reference");
  good("click \"reference:run 2\"");
  EXPECT_EQ(state().colouring.reference.kind, ui::PaneContent::Kind::Run);
  EXPECT_EQ(state().colouring.reference.run, session()->runs[1].id);
}

TEST_F(SaidInTheWindow, ARunByAnotherMethodIsAddedFromTheList) {
  good("generate annulus 300");
  good("click add-run");
  good("click add-run:laplace");
  ASSERT_EQ(session()->runs.size(), 2U);
  EXPECT_EQ(session()->runs[1].parameters.method, "laplace");
  EXPECT_EQ(session()->runs[1].parameters.metric, session()->runs[0].parameters.metric);
}

TEST_F(SaidInTheWindow, AWalkAlongABoundaryLoopComesBack) {
  good("generate annulus 300");
  good("select vertex loop:2");
  const std::vector<Index> inner = state().selection.vertices();
  good(fmt::format("pick vertex {}", inner.front()));
  std::set<Index> met;
  for (std::size_t k = 0; k < inner.size(); ++k) {
    met.insert(state().picked.id);
    good("click loop-next");
  }
  EXPECT_EQ(state().picked.id, inner.front());
  EXPECT_EQ(met, std::set<Index>(inner.begin(), inner.end()));
  good("click loop-back");
  good("click loop-next");
  EXPECT_EQ(state().picked.id, inner.front());
}

}  // namespace
}  // namespace dmoscope::app
