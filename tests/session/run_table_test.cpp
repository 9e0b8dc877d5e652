// The table of runs: its cells against sums and sorting done here, its order, its text.

#include "core/view/run_table.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/engine/engine.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

/// The value that a share of the elements does not exceed, by sorting.
double by_rank(std::vector<double> qualities, double share) {
  std::sort(qualities.begin(), qualities.end());
  return qualities[static_cast<std::size_t>(std::ceil(share * static_cast<double>(qualities.size()) - 1e-9)) - 1];
}

std::vector<double> qualities_of(const dmoscope::Run& run, Metric metric) {
  std::vector<double> qualities;
  for (Index e = 0; e < run.input().mesh.elements.size(); ++e)
    qualities.push_back(element_quality(run.input().quality_context(), run.positions(), metric, e));
  return qualities;
}

TEST(RunTable, ARowSaysHowTheRunFaresByTheMetricAskedFor) {
  Progress progress;
  const auto pool = std::make_shared<ThreadPool>(2);
  dmoscope::Run run(testing::input(testing::lattice(14, 0.45, 7)), {.metric = Metric::MinAngle}, pool, 0);
  run.iterate(3, progress);
  for (const Metric judged : {Metric::MinAngle, Metric::RadiusRatio}) {
    const RunRow row = row_of(run, judged, pool.get());
    const std::vector<double> qualities = qualities_of(run, judged);
    double sum = 0.0;
    for (const double q : qualities) sum += q;
    EXPECT_EQ(row.minimum, *std::min_element(qualities.begin(), qualities.end()));
    EXPECT_EQ(row.movable_minimum, row.minimum) << "no element of this mesh has fixed corners alone at its worst";
    EXPECT_NEAR(row.mean, sum / static_cast<double>(qualities.size()), 1e-12);
    EXPECT_EQ(row.p1, by_rank(qualities, 0.01));
    EXPECT_EQ(row.p5, by_rank(qualities, 0.05));
    EXPECT_EQ(row.inverted, 0.0);
    EXPECT_EQ(row.iterations, 3U);
    EXPECT_EQ(row.method, "dmo");
    EXPECT_EQ(row.metric, "min-angle");
    EXPECT_EQ(row.judged, info(judged).name);
    EXPECT_EQ(row.backend, "cpu");
    EXPECT_EQ(row.title, run.title());
    const auto& records = run.history().records();
    const double seconds = records[1].seconds + records[2].seconds + records[3].seconds;
    EXPECT_DOUBLE_EQ(row.seconds, seconds);
    EXPECT_DOUBLE_EQ(row.vertices_per_second, 3.0 * 13 * 13 / seconds);
  }
  const dmoscope::Run squares(testing::input(testing::lattice(4, 0.1, 1, testing::Cells::Quadrilaterals)), {}, pool, 0);
  EXPECT_THROW(static_cast<void>(row_of(squares, Metric::MinAngle, nullptr)), UsageError) << "not defined for quadrilaterals";
}

TEST(RunTable, IterationsThatTheRunHasGoneBackFromDoNotCount) {
  Progress progress;
  dmoscope::Run run(testing::input(testing::lattice(10, 0.4, 3)), {}, std::make_shared<ThreadPool>(1), std::size_t{1} << 20U);
  run.iterate(4, progress);
  run.seek({1, 0, 0}, progress);
  const RunRow row = row_of(run, Metric::MeanRatio, nullptr);
  EXPECT_EQ(row.iterations, 1U);
  EXPECT_EQ(row.seconds, run.history().records()[1].seconds);
  EXPECT_EQ(row.minimum, run.history().records()[1].statistics.minimum);
  run.seek({0, 0, 0}, progress);
  const RunRow input = row_of(run, Metric::MeanRatio, nullptr);
  EXPECT_EQ(input.seconds, 0.0);
  EXPECT_TRUE(std::isnan(input.vertices_per_second)) << "nothing has been visited";
}

void tell(Engine& engine, const std::string& line) {
  engine.post(line);
  engine.wait_idle();
}

TEST(RunTable, APublishedRunHasTheSameRow) {
  Engine engine(2);
  tell(engine, "generate random 400");
  tell(engine, "run 3");
  tell(engine, "show radius-ratio");
  const auto view = engine.view();
  const RunRow shown = row_of(view->runs[0], Metric::RadiusRatio);
  // Does the same run separately.
  Progress progress;
  const auto pool = std::make_shared<ThreadPool>(1);
  dmoscope::Run apart(generate_input("random 400", progress), {}, pool, 0);
  apart.iterate(3, progress);
  const RunRow expected = row_of(apart, Metric::RadiusRatio, pool.get());
  for (const char* name :
       {"run", "method", "metric", "backend", "judged_by", "iterations", "min_quality", "movable_minimum", "mean_quality", "inverted"}) {
    EXPECT_EQ(cell(shown, run_column(name)), cell(expected, run_column(name))) << name;
  }
  EXPECT_FLOAT_EQ(static_cast<float>(shown.p1), static_cast<float>(expected.p1));
  EXPECT_FLOAT_EQ(static_cast<float>(shown.p5), static_cast<float>(expected.p5));
  EXPECT_GT(shown.vertices_per_second, 0.0);
}

TEST(RunTable, TheInputIsJudgedByAnyMetricOnceNothingRuns) {
  Engine engine(2);
  tell(engine, "generate random 400");
  tell(engine, "run 2");
  for (const Metric metric : {Metric::MeanRatio, Metric::RadiusRatio}) {
    tell(engine, std::string("show ") + std::string(info(metric).name));
    const auto view = engine.view();
    ASSERT_TRUE(view->input_summary);
    EXPECT_EQ(view->input_summary->metric, metric);
    const InputMesh& input = *view->input;
    std::vector<double> qualities;
    for (Index e = 0; e < input.mesh.elements.size(); ++e)
      qualities.push_back(element_quality(input.quality_context(), input.mesh.positions, metric, e));
    const RunRow row = row_of_input(metric, view->input_summary->statistics, view->input_summary->percentiles);
    EXPECT_EQ(row.minimum, *std::min_element(qualities.begin(), qualities.end()));
    EXPECT_EQ(row.p1, by_rank(qualities, 0.01));
    EXPECT_EQ(row.p5, by_rank(qualities, 0.05));
    EXPECT_EQ(row.judged, info(metric).name);
    EXPECT_TRUE(std::isnan(row.seconds));
  }
}

/// Pearson's correlation of the mean length of the edges at each free vertex and its distance to a point, for triangles: every edge of an
/// inner vertex lies in two of its triangles.
double correlation_with_distance(const InputMesh& input, std::span<const Vec3> positions, Vec3 point) {
  std::vector<double> edges, sizes;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v) {
    if (input.topology.boundary()[v] != 0) continue;
    double sum = 0.0;
    std::size_t count = 0;
    for (const Incidence& at : input.topology.star(v))
      for (const Index other : input.mesh.elements.corners(at.element))
        if (other != v) sum += length(positions[other] - positions[v]), ++count;
    edges.push_back(sum / static_cast<double>(count));
    sizes.push_back(length(positions[v] - point));
  }
  const auto n = static_cast<double>(edges.size());
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    a += edges[i], b += sizes[i], aa += edges[i] * edges[i], bb += sizes[i] * sizes[i], ab += edges[i] * sizes[i];
  return (n * ab - a * b) / std::sqrt((n * aa - a * a) * (n * bb - b * b));
}

TEST(RunTable, ARunWithASizeFunctionSaysHowWellSizesAreMet) {
  Engine engine(2);
  tell(engine, "generate random 400");
  tell(engine, "combine mean-ratio:0.3:density h1:0,0");
  tell(engine, "run 4");
  const auto view = engine.view();
  const RunRow row = row_of(view->runs[0], view->shown);
  const double before = correlation_with_distance(*view->input, view->input->mesh.positions, {});
  const double after = correlation_with_distance(*view->input, view->frame->positions, {});
  EXPECT_NEAR(row.input_size_correlation, before, 1e-9);
  EXPECT_NEAR(row.size_correlation, after, 1e-9);
  EXPECT_GT(after, before);
  tell(engine, "back");
  const auto earlier = engine.view();
  const RunRow back = row_of(earlier->runs[0], earlier->shown);
  EXPECT_NEAR(back.size_correlation, correlation_with_distance(*earlier->input, earlier->frame->positions, {}), 1e-9);
  EXPECT_EQ(back.input_size_correlation, row.input_size_correlation);
  tell(engine, "combine mean-ratio:0.3:density constant");
  EXPECT_TRUE(std::isnan(row_of(engine.view()->runs[1], view->shown).size_correlation)) << "one size for all";
  EXPECT_TRUE(has_values(std::vector{row}, run_column("size_correlation")));
  EXPECT_FALSE(has_values(std::vector{RunRow{}}, run_column("size_correlation")));
}

TEST(RunTable, WithoutASummaryTheRecordsSayWhatTheyCan) {
  RunView view;
  view.parameters.metric = Metric::MeanRatio;
  view.moment = {1, 5, 0};
  view.visits_per_iteration = 10;
  std::vector<IterationRecord> records(2);
  records[1] = {1, {0.5, 0.75, 0.5, 1.0, 0, 2}, 4, 0.25};
  view.records = SharedVector<IterationRecord>(std::make_shared<const std::vector<IterationRecord>>(records));
  const RunRow own = row_of(view, Metric::MeanRatio);
  EXPECT_EQ(own.minimum, 0.5);
  EXPECT_EQ(own.inverted, 2.0);
  EXPECT_EQ(own.vertices_per_second, 40.0);
  EXPECT_TRUE(std::isnan(own.p1));
  const RunRow other = row_of(view, Metric::MinAngle);
  EXPECT_TRUE(std::isnan(other.minimum)) << "the records are of another metric";
  EXPECT_TRUE(std::isnan(other.inverted));
  EXPECT_EQ(other.seconds, 0.25);
}

RunRow row(std::string title, double minimum, std::uint64_t iterations) {
  RunRow made;
  made.title = std::move(title);
  made.minimum = minimum;
  made.iterations = iterations;
  return made;
}

std::string order_of(const std::vector<RunRow>& rows) {
  std::string order;
  for (const RunRow& r : rows) order += r.title;
  return order;
}

TEST(RunTable, SortsByAnyColumnAndPutsWhatIsUnknownLast) {
  const std::vector<RunRow> rows{row("b", 0.5, 3), row("d", NAN, 1), row("a", 0.25, 3), row("c", 0.75, 2)};
  const auto sorted = [&](const char* column, bool descending) {
    std::vector<RunRow> copy = rows;
    sort_rows(copy, run_column(column), descending);
    return order_of(copy);
  };
  EXPECT_EQ(sorted("run", false), "abcd");
  EXPECT_EQ(sorted("run", true), "dcba");
  EXPECT_EQ(sorted("min_quality", false), "abcd");
  EXPECT_EQ(sorted("min_quality", true), "cbad");
  EXPECT_EQ(sorted("iterations", false), "dcba") << "b before a, as it was";
  EXPECT_EQ(sorted("iterations", true), "bacd");
  EXPECT_EQ(sorted("p5", true), "bdac") << "nothing is known: nothing moves";
  EXPECT_THROW(static_cast<void>(run_column("beauty")), UsageError);
}

TEST(RunTable, CsvReadsBackAndQuotesWhatItMust) {
  RunRow odd = row("density 0,7 \"h1\"", 1.0 / 3.0, 12);
  odd.inverted = 0.0;
  odd.movable_minimum = HUGE_VAL;
  const std::vector<RunRow> rows{odd};
  std::istringstream text(run_table_csv(rows));
  std::string header, line, rest;
  std::getline(text, header);
  std::getline(text, line);
  EXPECT_EQ(header,
            "run,method,metric,backend,judged_by,iterations,min_quality,movable_minimum,mean_quality,p1,p5,inverted,seconds,"
            "vertices_per_second,input_size_correlation,size_correlation,mesh");
  EXPECT_EQ(line, "\"density 0,7 \"\"h1\"\"\",,,,,12,0.3333333333333333,,,,,0,0,,,,");
  EXPECT_FALSE(std::getline(text, rest));
}

TEST(RunTable, TextIsForAPerson) {
  RunRow one = row("a", 1.0 / 3.0, 1234567);
  one.movable_minimum = HUGE_VAL;
  EXPECT_EQ(cell_text(one, run_column("run")), "a");
  EXPECT_EQ(cell_text(one, run_column("iterations")), "1,234,567");
  EXPECT_EQ(cell_text(one, run_column("min_quality")), "0.3333");
  EXPECT_EQ(cell_text(one, run_column("movable_minimum")), "-");
  EXPECT_EQ(cell_text(one, run_column("p1")), "-");
  one.mean = 0.7;
  one.p5 = 0.0;
  one.vertices_per_second = 4728.4;
  EXPECT_EQ(cell_text(one, run_column("mean_quality")), "0.7000") << "digits below each other";
  EXPECT_EQ(cell_text(one, run_column("p5")), "0.000");
  EXPECT_EQ(cell_text(one, run_column("vertices_per_second")), "4.73 k");
  one.vertices_per_second = 1.576e7;
  EXPECT_EQ(cell_text(one, run_column("vertices_per_second")), "15.8 M");
}

}  // namespace
}  // namespace dmoscope
