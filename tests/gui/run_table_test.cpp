// The table of runs, off screen.
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/plots/run_rows.h"

namespace dmoscope::app {
namespace {

class RunTable : public HeadlessTest {
 protected:
  void SetUp() override {
    HeadlessTest::SetUp();
    if (IsSkipped()) return;
    good("generate annulus 300");
    good("compare metrics 3");
    good("plot runs");
    good("wait");
  }
  [[nodiscard]] std::vector<RunRow> rows() { return ui::sorted_runs(*session(), state().plot_options); }
  [[nodiscard]] std::vector<std::size_t> order() {
    std::vector<std::size_t> runs;
    for (const RunRow& row : rows()) runs.push_back(row.run);
    return runs;
  }
  [[nodiscard]] float top(std::size_t run) { return window_->app().items().find("run-row:" + std::to_string(run + 1))[1]; }
  const test::TemporaryFolder folder_;
};

TEST_F(RunTable, StandsInTheOrderThatAClickOnAColumnAsksFor) {
  const std::vector<std::size_t> as_made = order();
  // One run for each metric of triangles; the condition is for other elements.
  const auto of_triangles =
      std::ranges::count_if(metric_table(), [](const MetricInfo& one) { return one.defined_for(ElementKind::Triangle); });
  ASSERT_EQ(as_made.size(), static_cast<std::size_t>(of_triangles));
  ASSERT_LT(as_made.size(), kMetricCount);
  EXPECT_TRUE(std::ranges::is_sorted(as_made));
  good("click run-table:min_quality");
  const auto best_first = rows();
  for (std::size_t k = 1; k < best_first.size(); ++k) EXPECT_GE(best_first[k - 1].minimum, best_first[k].minimum);
  EXPECT_LT(top(best_first.front().run), top(best_first[1].run));
  good("click run-table:min_quality");
  const auto worst_first = rows();
  for (std::size_t k = 1; k < worst_first.size(); ++k) EXPECT_LE(worst_first[k - 1].minimum, worst_first[k].minimum);
  EXPECT_NE(best_first.front().run, worst_first.front().run);
  good("click run-table:min_quality");
  EXPECT_EQ(order(), as_made);
  good("sort-runs run descending");
  const auto named = rows();
  const auto without_number = [](const RunRow& row) { return row.title.substr(row.title.find(' ')); };
  for (std::size_t k = 1; k < named.size(); ++k) EXPECT_GE(without_number(named[k - 1]), without_number(named[k]));
  EXPECT_TRUE(window_->run("sort-runs beauty").has_value());
  EXPECT_TRUE(window_->run("sort-runs run sideways").has_value());
  good("sort-runs off");
  EXPECT_EQ(order(), as_made);
}

TEST_F(RunTable, AllRowsAreJudgedByTheMetricThatIsShown) {
  for (const char* metric : {"mean-ratio", "min-angle"}) {
    good(std::string("show ") + metric);
    good("wait");
    for (const RunRow& row : rows()) {
      EXPECT_EQ(row.judged, metric);
      EXPECT_GT(row.minimum, 0.0);  // every row has a value, whichever metric its run optimises
      EXPECT_LE(row.minimum, row.p1);
      EXPECT_LE(row.p1, row.p5);
      EXPECT_EQ(row.iterations, 3U);
    }
  }
}

TEST_F(RunTable, TheInputStandsAboveTheRuns) {
  const auto inputs = ui::input_rows(*session());
  ASSERT_EQ(inputs.size(), 1U);
  const RunRow& row = inputs.front();
  double least = 1.0, sum = 0.0;
  const InputMesh& input = *session()->input;
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const double quality = element_quality(input.quality_context(), input.mesh.positions, session()->shown, e);
    least = std::min(least, quality);
    sum += quality;
  }
  EXPECT_DOUBLE_EQ(row.minimum, least);
  EXPECT_NEAR(row.mean, sum / static_cast<double>(input.mesh.elements.size()), 1e-12);
  EXPECT_EQ(row.iterations, 0U);
  EXPECT_TRUE(std::isnan(row.seconds));
  EXPECT_FALSE(std::isnan(row.p1)) << "whether or not percentiles of every iteration are asked for";
  EXPECT_LE(row.minimum, row.p1);
  EXPECT_LE(row.p1, row.p5);
  good("show mean-ratio-area");
  for (int k = 0; k < 2; ++k) good("remove-run 1");  // the runs by both metrics of that shape
  good("show mean-ratio");
  good("wait");
  const auto unused = ui::input_rows(*session());
  ASSERT_EQ(unused.size(), 1U) << "although no run optimises that";
  EXPECT_DOUBLE_EQ(unused.front().minimum, least);
  EXPECT_EQ(unused.front().p5, row.p5);
}

TEST_F(RunTable, HasColumnsOfSizesWhereARunHasASizeFunction) {
  good("size 1920 1080");  // so that all columns are in view
  EXPECT_TRUE(window_->run("click run-table:size_correlation").has_value());
  good("select-run 1");
  good("combine mean-ratio:0.3:density h1:0,0");
  good("run 2");
  good("wait");
  good("click run-table:size_correlation");
  EXPECT_EQ(rows().front().run, session()->active) << "the only one that has a value";
  good("size 1280 1400");  // so that all parameters are in view
  good("generate annulus 300");
  EXPECT_TRUE(window_->run("click run-table:size_correlation").has_value());
  good("combine mean-ratio:0.3:density h1:0,0");
  good("run 2");
  good("wait");
  good("settings on");
  EXPECT_GT(window_->app().items().find("size-course")[2], 0.0F);
}

TEST_F(RunTable, AClickOnARowMakesItsRunTheActiveOne) {
  good("click run-row:3");
  good("wait");
  EXPECT_EQ(session()->active, 2U);
}

TEST_F(RunTable, IsSavedAndCopiedAsItStands) {
  good("sort-runs mean_quality descending");
  const auto file = folder_ / "runs.csv";
  good("plot-save \"" + file.string() + "\"");
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  std::vector<RunRow> expected = rows();
  expected.insert(expected.begin(), ui::input_rows(*session()).front());
  EXPECT_EQ(text.str(), run_table_csv(expected)) << "the input above the runs, as it is seen";
  good("plot-copy");
  EXPECT_EQ(window_->clipboard(), text.str());
  EXPECT_TRUE(window_->run("plot-save \"" + (folder_ / "runs.svg").string() + "\"").has_value());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "runs.svg"));
}

}  // namespace
}  // namespace dmoscope::app
