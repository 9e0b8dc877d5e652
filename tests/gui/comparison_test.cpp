// Runs compared by the metrics of all: the matrix, the curves that one metric judges, and the dialog.
#include "ui/analysis/comparison.h"

#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "core/view/judgements.h"
#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/plots/plot_builder.h"

namespace dmoscope::app {
namespace {

using ::testing::ElementsAre;

/// Mean ratio, 2 sqrt(3) |area| over the sum of the squared edges, and least angle over 60 degrees, straight from the corners of a
/// triangle.
std::pair<double, double> by_hand(const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto squared = [](const Vec3& p, const Vec3& q) { return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y); };
  const double area = 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  const double ab = squared(a, b), bc = squared(b, c), ca = squared(c, a);
  const auto angle = [](double opposite, double p, double q) { return std::acos((p + q - opposite) / (2 * std::sqrt(p * q))); };
  const double least = std::min({angle(bc, ab, ca), angle(ca, ab, bc), angle(ab, bc, ca)});
  return {4 * std::sqrt(3.0) * area / (ab + bc + ca), least / (std::acos(-1.0) / 3)};
}

std::pair<double, double> minima_of(const InputMesh& input, std::span<const Vec3> positions) {
  std::pair<double, double> least{INFINITY, INFINITY};
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const auto corners = input.mesh.elements.corners(e);
    const auto [ratio, angle] = by_hand(positions[corners[0]], positions[corners[1]], positions[corners[2]]);
    least = {std::min(least.first, ratio), std::min(least.second, angle)};
  }
  return least;
}

class ComparisonWindow : public HeadlessTest {
 protected:
  void SetUp() override { open_explaining(); }  // courses come after everything else, when the session rests
  [[nodiscard]] const RunView& run(std::size_t k) { return session()->runs[k]; }
  [[nodiscard]] const ui::Items::Box& box(const std::string& item) { return window_->app().items().find(item); }
};

TEST_F(ComparisonWindow, EveryRunIsJudgedByTheMetricsOfAll) {
  good("generate coast 400");
  good("compare with dmo:min-angle converged");
  const ui::Comparison comparison = ui::compare_runs(*session());
  ASSERT_THAT(comparison.metrics, ElementsAre(Metric::MeanRatio, Metric::MinAngle));
  ASSERT_EQ(comparison.rows.size(), 3U);
  for (const ui::Comparison::Row& row : comparison.rows) {
    if (row.run != ui::Comparison::kInput) good("select-run " + std::to_string(row.run + 1));
    const auto view = session();
    const std::span<const Vec3> positions = row.run == ui::Comparison::kInput ? view->input->mesh.positions : view->frame->positions;
    const auto [ratio, angle] = minima_of(*view->input, positions);
    EXPECT_NEAR(row.cells[0].value, ratio, 1e-12);
    EXPECT_NEAR(row.cells[3].value, angle, 1e-12);
    EXPECT_LE(row.cells[0].value, row.cells[1].value) << "the worst, the worst hundredth, the mean";
    EXPECT_LE(row.cells[1].value, row.cells[2].value);
  }
  EXPECT_FALSE(comparison.rows[0].cells[0].best) << "the input is no run";
  EXPECT_TRUE(comparison.rows[1].cells[0].best);
  EXPECT_TRUE(comparison.rows[2].cells[3].best);
  EXPECT_EQ(comparison.remark, "Each metric wins by its own measure.");
}

TEST_F(ComparisonWindow, WhatACommandComparesIsSeenSideBySide) {
  good("generate random 300 3");
  good("run 2");
  EXPECT_TRUE(window_->run("compare with dmo:nothing 3").has_value());
  EXPECT_TRUE(state().panes.one()) << "nothing is compared";
  good("compare with dmo:min-angle 3");
  EXPECT_EQ(state().panes.layout, ui::PaneLayout::Two);
  EXPECT_EQ(state().plot, ui::PlotTab::Compare);
  EXPECT_TRUE(state().panels.plots());
  EXPECT_TRUE(window_->app().items().boxes().contains("viewport:2"));
  good("viewports 1");
  good("plot histogram");
  good("select-run 1");
  EXPECT_EQ(state().plot, ui::PlotTab::Histogram) << "only the comparison itself shows its runs";
  good("compare with laplace 3");
  EXPECT_EQ(state().panes.layout, ui::PaneLayout::Four);
  good("viewports 1");
  good("compare methods 3");
  EXPECT_TRUE(state().panes.one()) << "more than there could be";
  EXPECT_EQ(state().plot, ui::PlotTab::Compare);
}

TEST_F(ComparisonWindow, CurvesAreJudgedByTheShownMetricOrEachByItsOwn) {
  good("generate random 400 3");
  good("compare with dmo:min-angle 12");
  good("plot compare");
  const auto plot = [&] { return ui::build_plot(state(), *session(), {}, ui::palette(ui::Theme::Dark)); };
  const auto last = [&](std::size_t k) { return plot().series[k].y.back(); };
  ASSERT_EQ(plot().series.size(), 2U);
  EXPECT_EQ(last(0), run(0).records.back().statistics.minimum);
  EXPECT_EQ(last(1), ui::judged_by(run(1), Metric::MeanRatio)->minimum);
  good("seek 5");
  const double before = last(1);
  const JudgedBy* judged = ui::judged_by(run(1), Metric::MeanRatio);
  ASSERT_NE(judged, nullptr);
  ASSERT_EQ(judged->course.size(), judged_iterations(13).size());
  // Independent values come from the mesh at that iteration.
  good("select-run 2");
  good("seek 5");
  const double there = minima_of(*session()->input, session()->frame->positions).first;
  EXPECT_NEAR(ui::judged_by(run(1), Metric::MeanRatio)->course[5].minimum, there, 1e-12);
  EXPECT_EQ(last(1), before) << "the course stays when one looks back";
  good("judged-by own");
  EXPECT_EQ(last(1), run(1).records.back().statistics.minimum);
  good("show min-angle");
  good("judged-by shown");
  EXPECT_EQ(last(1), run(1).records.back().statistics.minimum);
  EXPECT_NE(last(0), run(0).records.back().statistics.minimum);
}

TEST(JudgedIterations, AreAllOfTheFirstAndFewOfMany) {
  EXPECT_TRUE(judged_iterations(0).empty());
  EXPECT_THAT(judged_iterations(3), ElementsAre(0, 1, 2));
  const auto many = judged_iterations(10'000);
  EXPECT_LE(many.size(), 42U);
  EXPECT_EQ(many.back(), 9999U);
  EXPECT_TRUE(std::ranges::is_sorted(many));
  EXPECT_EQ(std::ranges::adjacent_find(many), many.end());
}

TEST_F(ComparisonWindow, OneClickComparesTheMethodsOfThePapersFigure) {
  good("generate random 300 3");
  good("dialog compare");
  good("click compare:figure-4");
  good("click compare:go");
  EXPECT_EQ(state().dialog, ui::Dialog::None);
  ASSERT_EQ(session()->runs.size(), 4U);
  std::vector<std::string> methods;
  for (const RunView& each : session()->runs) {
    methods.push_back(each.parameters.method);
    EXPECT_FALSE(each.last_outcome.empty()) << "until it converges";
    EXPECT_TRUE(each.at_best());
  }
  EXPECT_THAT(methods, ::testing::UnorderedElementsAre("dmo", "laplace", "angle-based", "dvr"));
  EXPECT_EQ(state().plot, ui::PlotTab::Compare);
  EXPECT_EQ(state().panes.count(), 4U);
}

TEST_F(ComparisonWindow, TwoMetricsAreSeenSideBySideAndSubtractedByMouse) {
  good("generate random 300 3");
  good("dialog compare");
  good("click compare:min-angle");
  good("click compare:converged");
  good("click compare:go");
  ASSERT_EQ(session()->runs.size(), 2U);
  EXPECT_EQ(run(1).moment.iteration, 20U);
  EXPECT_EQ(state().panes.count(), 2U);
  EXPECT_TRUE(state().panes.linked);
  good("click judge:min-angle");
  EXPECT_EQ(session()->shown, Metric::MinAngle);
  good("click compare-difference");
  EXPECT_EQ(state().colouring.by, ui::ColourBy::Difference);
  EXPECT_EQ(state().colouring.reference.kind, ui::PaneContent::Kind::Run);
  good("click compare-difference");
  EXPECT_EQ(state().colouring.by, ui::ColourBy::Quality);
  good("click compared:2");
  EXPECT_EQ(session()->active, 1U);
}

TEST_F(ComparisonWindow, TheMatrixOfTwoMetricsIsWhole) {
  // Heights are a hundredth of what they were, so that qualities have many digits.
  good("generate random 300 3");
  const Mesh& mesh = session()->input->mesh;
  const test::TemporaryFolder folder;
  std::ofstream flat(folder / "flat.off");
  flat << "OFF\n" << mesh.positions.size() << ' ' << mesh.elements.size() << " 0\n";
  for (const Vec3& at : mesh.positions) flat << at.x << ' ' << 0.01 * at.y << " 0\n";
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    flat << "3 " << corners[0] << ' ' << corners[1] << ' ' << corners[2] << '\n';
  }
  flat.close();
  good("open " + (folder / "flat.off").string());
  good("compare with dmo:min-angle 3");
  good("move 5 5");
  const ui::Comparison comparison = ui::compare_runs(*session());
  ASSERT_LT(comparison.rows[0].cells[0].value, 0.01);
  EXPECT_LT(box("compared:min-angle:Mean")[2], box("run-list")[0]) << "no column is cut off";
  const ui::Items::Box first = box("legend:1 dmo · mean ratio"), second = box("legend:2 dmo · minimum angle");
  EXPECT_EQ(first[1], second[1]) << "one row";
  EXPECT_LT(box("plot")[1] - first[3], 15.0F) << "the plot begins below it";
  good("size 800 600");
  EXPECT_LT(box("compared:min-angle:Mean")[2], box("run-list")[0]) << "no column is cut off";
}

TEST_F(ComparisonWindow, TheMatrixIsSavedWithAllItsDigits) {
  const test::TemporaryFolder folder;
  good("generate random 300 3");
  good("compare with dmo:min-angle 4");
  good("plot compare");
  const auto file = folder / "comparison.csv";
  good("plot-save \"" + file.string() + "\"");
  std::ifstream stream(file);
  std::string head, input, first;
  std::getline(stream, head);
  std::getline(stream, input);
  std::getline(stream, first);
  EXPECT_EQ(head, "run,min mean-ratio,p1 mean-ratio,mean mean-ratio,min min-angle,p1 min-angle,mean min-angle");
  EXPECT_EQ(input.substr(0, 6), "input,");
  EXPECT_EQ(std::stod(first.substr(first.find(',') + 1)), run(0).records.back().statistics.minimum);
}

TEST_F(ComparisonWindow, RunsAreNamedOrRefused) {
  good("generate random 300 3");
  EXPECT_TRUE(window_->run("compare with").has_value());
  EXPECT_TRUE(window_->run("compare with nobody:mean-ratio 3").has_value());
  EXPECT_TRUE(window_->run("compare with dmo:nothing 3").has_value());
  EXPECT_EQ(session()->runs.size(), 1U);
  good("compare with laplace 3");
  EXPECT_EQ(run(1).parameters.method, "laplace");
  EXPECT_EQ(run(1).parameters.metric, run(0).parameters.metric);
  EXPECT_EQ(run(0).moment.iteration, 3U);
}

}  // namespace
}  // namespace dmoscope::app
