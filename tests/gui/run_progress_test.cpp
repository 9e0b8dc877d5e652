// Texts about a run at work, and about a finished command.
#include "ui/state/run_progress.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/gui/plots.h"
#include "ui/state/result_line.h"

namespace dmoscope::ui {
namespace {

RunView run_with(const std::vector<double>& minima) {
  RunView run;
  std::vector<IterationRecord> records;
  for (std::size_t k = 0; k < minima.size(); ++k) records.push_back(record(k, minima[k], 0.9, k == 0 ? 0.0 : 0.5));
  run.moment = {minima.size() - 1};
  run.visits_per_iteration = 1000;
  run.free_vertices = 1000;
  set_records(run, std::move(records));
  return run;
}

std::string text_of(const RunView& run, std::optional<double> left = {}) {
  std::string text;
  for (const std::string& part : progress_parts(run, left)) text += (text.empty() ? "" : " | ") + part;
  return text;
}

TEST(RunProgress, SaysHowMuchTheMinimumRoseOfLate) {
  RunView run = run_with({0.1, 0.2, 0.25});
  run.pursuit = Pursuit{0, 100, false, {}};
  EXPECT_EQ(text_of(run, 12.3), "iteration 3 of 100 | minimum 0.2500, +0.1500 in the last 2 | 13 s left");
  std::vector<double> minima;
  for (int k = 0; k <= 30; ++k) minima.push_back(0.3 + 0.001 * k);
  EXPECT_EQ(trend_text(*trend_of(run_with(minima).records, 30)), "minimum 0.3300, +0.01000 in the last 10");
  EXPECT_EQ(trend_text(*trend_of(run_with({0.5, 0.4}).records, 1)), "minimum 0.4000, −0.1000 in the last iteration");
  EXPECT_EQ(trend_text(*trend_of(run_with({0.5}).records, 0)), "minimum 0.5000");
  EXPECT_FALSE(trend_of(run.records, 7)) << "no such record";
  EXPECT_FALSE(trend_of(run_with({0.1, INFINITY}).records, 1)) << "no element";
}

TEST(RunProgress, SaysForHowLongTheMinimumIsSteadyAndWhenPatienceEnds) {
  std::vector<double> minima{0.1, 0.2, 0.3};
  for (int k = 0; k < 20; ++k) minima.push_back(0.3 + 1e-9 * k);
  RunView run = run_with(minima);
  run.pursuit = Pursuit{0, 10000, true, 180};
  EXPECT_EQ(text_of(run), "iteration 23 | minimum 0.3000, steady for 20 iterations | ends after 180 more without gain");
  change(run, 22, [](Statistics& its) { its.inverted = 1200; });
  EXPECT_TRUE(text_of(run).starts_with("iteration 23 | 1,200 inverted | ")) << text_of(run);
}

TEST(RunProgress, CountsIterationsFromWhereTheRunBegan) {
  RunView run = run_with({0.1, 0.2, 0.25, 0.26});
  run.pursuit = Pursuit{2, 12, false, {}};
  EXPECT_TRUE(text_of(run).starts_with("iteration 2 of 10 | "));
  run.moment = {12};
  EXPECT_TRUE(text_of(run).starts_with("iteration 10 of 10")) << "no eleventh";
}

TEST(RunProgress, VerticesThatWerePassedOverAreNoVisits) {
  RunView run = run_with({0.1, 0.2});
  run.free_vertices = 158'000'000;
  EXPECT_EQ(speed_text(run), "") << "nobody was searched";
  std::vector<IterationRecord> records = run.records.whole();
  records[1].searched = 4'000'000;
  set_records(run, std::move(records));
  EXPECT_EQ(speed_text(run), "8 M visits/s");
  RunView device = run_with({0.1, 0.2});
  device.backend = Backend::Cuda;
  EXPECT_EQ(speed_text(device), "2 k vertices/s") << "visits are not counted there";
}

TEST(RunProgress, TheRunAtWorkIsTheOneInPursuit) {
  SessionView session = session_of(3, 2);
  EXPECT_EQ(run_at_work(session), nullptr);
  session.runs[2].pursuit = Pursuit{};
  EXPECT_EQ(run_at_work(session), &session.runs[2]);
}

TEST(RunPace, TellsTheTimeLeftFromTheLastSeconds) {
  Pace pace;
  EXPECT_FALSE(pace.seconds_left());
  double now = 100.0;
  const auto step = [&](double seconds, double done) { pace.note(now += seconds, WorkDone{"run 100", done, 100.0}); };
  step(0.0, 0.0);
  EXPECT_FALSE(pace.seconds_left()) << "too little is known";
  for (int k = 1; k <= 10; ++k) step(1.0, k);
  ASSERT_TRUE(pace.seconds_left());
  EXPECT_NEAR(*pace.seconds_left(), 90.0, 1e-9);
  for (int k = 1; k <= 20; ++k) step(0.5, 10 + 2 * k);  // four times as fast
  EXPECT_NEAR(*pace.seconds_left(), 50.0 / 4, 1e-9) << "what was slow before is forgotten";
  pace.note(now + 0.1, WorkDone{"run 7", 0.0, 7.0});
  EXPECT_FALSE(pace.seconds_left()) << "other work";
  pace.note(now + 1.0, std::nullopt);
  EXPECT_FALSE(pace.seconds_left());
}

TEST(RunPace, OfARunCountsItsVisitsOfOtherWorkItsShare) {
  RunView run = run_with({0.1, 0.2, 0.25});
  EXPECT_EQ(work_done(nullptr, "open x", 0.25), (WorkDone{"open x", 0.25, 1.0}));
  EXPECT_EQ(work_done(&run, "each run 3", 0.5), (WorkDone{"each run 3", 0.5, 1.0}));
  run.pursuit = Pursuit{1, 11, false, {}};
  run.moment = {4, 500, 0};
  EXPECT_EQ(work_done(&run, "run 10", 0.5), (WorkDone{"run 10", 3.5, 10.0}));
  run.pursuit->until_converged = true;
  EXPECT_FALSE(work_done(&run, "until-converged", 0.5)) << "nobody knows";
}

TEST(RunPace, IsSaidInRoundWords) {
  EXPECT_EQ(time_left_text(0.3), "1 s left");
  EXPECT_EQ(time_left_text(100.0), "100 s left");
  EXPECT_EQ(time_left_text(300.0), "5 min left");
  EXPECT_EQ(time_left_text(10'000.0), "3 h left");
}

TEST(Results, TheNextSuccessTakesThePlaceOfWhatWasSaidBefore) {
  ResultLine line;
  const auto end = [](CommandEnd::Kind kind, Moment at = {}, bool moved = false) {
    CommandEnd made;
    made.kind = kind;
    made.at = at;
    made.moved = moved;
    return made;
  };
  line.say({Message::Kind::Info, "read 2,404 vertices", 0});
  line.ended("open x.14", end(CommandEnd::Kind::Done));
  EXPECT_EQ(line.newest()->text, "read 2,404 vertices") << "its own words";
  line.ended("step iteration", end(CommandEnd::Kind::Done, {1}, true));
  EXPECT_EQ(line.newest()->text, "step iteration: now at iteration 1");
  line.say({Message::Kind::Error, "no such file", 3});
  line.ended("export /x", end(CommandEnd::Kind::Failed));
  EXPECT_EQ(line.newest()->kind, Message::Kind::Error);
  line.ended("step vertex 3", end(CommandEnd::Kind::Done, {1, 3, 0}, true));
  EXPECT_EQ(line.newest()->text, "step vertex 3: now at iteration 1 and 3 visits");
  EXPECT_EQ(line.newest()->kind, Message::Kind::Info);
  line.say({Message::Kind::Error, "no such colour", 2});
  line.succeeded();
  EXPECT_FALSE(line.newest()) << "a success of the window itself";
  line.say({Message::Kind::Warning, "cancelled: run 5", 4});
  line.succeeded();
  EXPECT_TRUE(line.newest()) << "no error";
}

}  // namespace
}  // namespace dmoscope::ui
