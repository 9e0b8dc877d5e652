// Percentiles and summaries: against sorting, for every run, at rest.

#include "core/run/percentiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "core/view/summaries.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

/// The smallest value that at least `share` of them do not exceed.
double by_counting(const std::vector<double>& values, double share) {
  double best = HUGE_VAL;
  for (const double candidate : values) {
    const auto not_above = std::ranges::count_if(values, [&](double q) { return q <= candidate; });
    if (static_cast<double>(not_above) >= share * static_cast<double>(values.size()) - 1e-9) best = std::min(best, candidate);
  }
  return best;
}

TEST(Percentiles, AreThoseOfCounting) {
  testing::Random random(3);
  for (const std::size_t count : {1U, 2U, 3U, 19U, 20U, 21U, 99U, 100U, 101U, 500U}) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(std::floor(random(-5, 40)) / 8);  // with ties
    std::vector<double> scratch = values;
    scratch.push_back(std::nan(""));
    const Percentiles found = percentiles_of(scratch);
    EXPECT_EQ(found.p1, by_counting(values, 0.01)) << count;
    EXPECT_EQ(found.p5, by_counting(values, 0.05)) << count;
    EXPECT_EQ(found.p50, by_counting(values, 0.5)) << count;
    std::ranges::sort(values);
    const Percentiles sorted = percentiles_of_sorted(std::vector<float>(values.begin(), values.end()));
    EXPECT_EQ(sorted.p1, found.p1) << count;
    EXPECT_EQ(sorted.p5, found.p5) << count;
    EXPECT_EQ(sorted.p50, found.p50) << count;
  }
  std::vector<double> none;
  EXPECT_FALSE(percentiles_of(none).known());
  EXPECT_FALSE(percentiles_of_sorted({}).known());
}

std::shared_ptr<const SessionView> say(Engine& engine, const std::string& line) {
  engine.post(line);
  engine.wait_idle();
  return engine.view();
}

TEST(Percentiles, AreOfEveryIterationThatIsKept) {
  Engine engine(2);
  say(engine, "generate random 300");
  say(engine, "run 3");
  EXPECT_TRUE(engine.view()->runs[0].percentiles.empty()) << "nobody asked for them";
  say(engine, "percentiles on");
  const auto view = say(engine, "run 2");
  const RunView& run = view->runs[0];
  ASSERT_EQ(run.percentiles.size(), 6U);
  for (std::uint64_t iteration = 0; iteration <= 5; ++iteration) {
    const auto there = say(engine, fmt::format("seek {}", iteration))->frame;
    std::vector<double> qualities;
    for (Index e = 0; e < there->element_count(); ++e)
      qualities.push_back(element_quality(there->input->quality_context(), there->positions, Metric::MeanRatio, e));
    EXPECT_EQ(run.percentiles[iteration].p1, by_counting(qualities, 0.01));
    EXPECT_EQ(run.percentiles[iteration].p50, by_counting(qualities, 0.5));
  }
  say(engine, "seek 2");
  EXPECT_EQ(say(engine, "visit 0-299")->runs[0].percentiles.size(), 3U) << "forgotten with the records";
  EXPECT_TRUE(say(engine, "percentiles off")->runs[0].percentiles.empty());
}

TEST(Percentiles, AreNotKnownWherePositionsAreNot) {
  Engine engine(1);
  say(engine, "history 0");
  say(engine, "generate random 300");
  say(engine, "percentiles on");
  const RunView run = say(engine, "run 4")->runs[0];
  ASSERT_EQ(run.percentiles.size(), 5U);
  EXPECT_TRUE(run.percentiles[0].known()) << "the input";
  EXPECT_FALSE(run.percentiles[2].known());
  EXPECT_TRUE(run.percentiles[4].known()) << "where it stands";
}

TEST(Percentiles, AreColumnsOfTheStatisticsWhenTheyAreOn) {
  const auto file = std::filesystem::temp_directory_path() / "dmoscope_test_percentiles.csv";
  Engine engine(1);
  say(engine, "generate random 100");
  say(engine, "percentiles on");
  say(engine, "run 2");
  say(engine, "stats " + file.string());
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  EXPECT_EQ(line, "run,iteration,min_quality,mean_quality,inverted,moved,seconds,movable_minimum,p1,p5,p50");
  while (std::getline(stream, line)) EXPECT_EQ(std::ranges::count(line, ','), 10) << line;
  std::filesystem::remove(file);
}

TEST(Summaries, AreOfEveryRunByTheShownMetric) {
  Engine engine(2);
  say(engine, "generate random 400");
  say(engine, "run 3");
  say(engine, "add-run dmo:radius-ratio");
  say(engine, "run 1");
  for (const char* metric : {"mean-ratio", "min-angle"}) {
    const auto view = say(engine, std::string("show ") + metric);
    ASSERT_EQ(view->runs.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto summary = view->runs[i].summary;
      ASSERT_NE(summary, nullptr) << i;
      const auto frame = say(engine, fmt::format("select-run {}", i + 1))->frame;
      EXPECT_EQ(summary->metric, parse_metric(metric));
      EXPECT_EQ(summary->moment, frame->moment);
      EXPECT_EQ(summary->statistics.mean, frame->shown_statistics.mean);
      EXPECT_EQ(summary->statistics.movable_minimum, frame->shown_statistics.movable_minimum);
      EXPECT_EQ(summary->histogram.counts, frame->now.counts);
      std::vector<float> sorted = frame->quality;
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(summary->sorted, sorted);
      EXPECT_EQ(summary->elements, sorted.size());
    }
    say(engine, "select-run 2");
  }
  const auto before = engine.view()->runs[0].summary;
  const auto after = say(engine, "step iteration");
  EXPECT_EQ(after->runs[0].summary, before) << "worked out once for each moment";
  EXPECT_EQ(after->runs[1].summary->moment, Moment{2});
}

TEST(Summaries, AnEvenChoiceHoldsTheEnds) {
  std::vector<float> values;
  for (int i = 0; i < 1000; ++i) values.push_back(static_cast<float>((i * 617) % 1000));
  values.push_back(NAN);
  const auto chosen = sorted_choice(values, 10);
  ASSERT_EQ(chosen.size(), 10U);
  EXPECT_EQ(chosen.front(), 0.0F);
  EXPECT_EQ(chosen.back(), 999.0F);
  EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
  EXPECT_NEAR(chosen[5], 555.0F, 1.0F);
  EXPECT_EQ(sorted_choice({3.0F, 1.0F, 2.0F}, 10), (std::vector<float>{1.0F, 2.0F, 3.0F}));
}

TEST(FrameCache, AFrameStaysWhileNothingThatItShowsChanges) {
  Engine engine(1);
  const auto first = say(engine, "generate random 100")->frame;
  EXPECT_EQ(say(engine, "say hello")->frame, first);
  EXPECT_EQ(say(engine, "seek 0")->frame, first);
  EXPECT_NE(say(engine, "show min-angle")->frame, first);
  EXPECT_NE(say(engine, "step vertex")->frame, first);
  say(engine, "undo");
  say(engine, "visit 0-99");
  const auto edited = engine.view()->frame;
  say(engine, "undo");
  say(engine, "visit 50-99");
  EXPECT_NE(engine.view()->frame, edited) << "the same moment of another path";
  EXPECT_NE(engine.view()->frame->serial, edited->serial);
}

}  // namespace
}  // namespace dmoscope
