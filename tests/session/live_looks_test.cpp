// Commands that only change the view overtake a run that computes.
#include <algorithm>
#include <chrono>
#include <functional>
#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "core/view/judging.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

using std::chrono::steady_clock;
constexpr std::chrono::seconds kPatience{120};

class LiveLooks : public ::testing::Test {
 protected:
  void open(const char* mesh) {
    engine.post(mesh);
    engine.wait_idle();
  }
  /// Waits for a view with the property; null if that takes too long, or if no work is left.
  std::shared_ptr<const SessionView> wait_for(const std::function<bool(const SessionView&)>& wanted) {
    std::shared_ptr<const SessionView> last;
    for (const auto until = steady_clock::now() + kPatience; steady_clock::now() < until;) {
      const bool busy = engine.busy();
      const auto view = engine.view();
      if (view != last) ++views;
      last = view;
      if (view->frame && wanted(*view)) return view;
      if (!busy) return nullptr;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return nullptr;
  }
  bool begin_endless_run() {
    run = engine.post("run 100000000");
    return wait_for([](const SessionView& view) { return view.frame->moment > Moment{}; }) != nullptr;
  }
  std::vector<CommandEnd> stop() {
    engine.cancel();
    engine.wait_idle();
    const std::vector<CommandEnd> last = engine.take_ends();
    ends.insert(ends.end(), last.begin(), last.end());
    return ends;
  }
  [[nodiscard]] CommandEnd::Kind how(std::uint64_t id) const { return std::ranges::find(ends, id, &CommandEnd::id)->kind; }

  Engine engine{2};
  std::uint64_t run = 0;
  std::vector<CommandEnd> ends;
  int views = 0;
};

/// Expects a frame's values of the shown metric to agree with its definition.
void expect_true_of_its_metric(const Frame& frame, const SessionView& view) {
  const QualityContext context = frame.input->quality_context();
  ASSERT_EQ(frame.quality.size(), frame.element_count());
  std::vector<double> now(frame.element_count()), before(frame.element_count());
  for (Index e = 0; e < frame.element_count(); ++e) {
    now[e] = element_quality(context, frame.positions, frame.shown, e);
    before[e] = element_quality(context, frame.input->mesh.positions, frame.shown, e);
    ASSERT_EQ(frame.quality[e], static_cast<float>(now[e])) << e;
  }
  EXPECT_EQ(frame.now.counts, make_histogram(now).counts);
  EXPECT_EQ(frame.shown_statistics.minimum, std::ranges::min(now));
  ASSERT_FALSE(frame.worst.empty());
  EXPECT_EQ(frame.worst[0].quality, std::ranges::min(now));
  if (frame.provisional && frame.input_spread == nullptr) {
    EXPECT_TRUE(std::ranges::all_of(frame.before.counts, [](Index n) { return n == 0; })) << "no other metric's";
    return;
  }
  EXPECT_EQ(frame.before.counts, make_histogram(before).counts);
  ASSERT_NE(frame.input_spread, nullptr);
  EXPECT_EQ(frame.input_spread->range(), (std::pair{std::ranges::min(before), std::ranges::max(before)})) << "none is inverted";
  if (frame.provisional) return;
  const RunView& run = view.runs[frame.run];
  const Statistics plain = compute_statistics(context, frame.positions, run.parameters.metric, run.fixed, nullptr);
  EXPECT_EQ(frame.statistics.minimum, plain.minimum);
  EXPECT_NEAR(frame.statistics.mean, plain.mean, 1e-12) << "added in another order";
}

TEST_F(LiveLooks, ColoursOfAnotherMetricComeAtOnceAndWhatIsCountedFollows) {
  std::mutex mutex;
  std::vector<std::shared_ptr<const SessionView>> all;  // every view that was published
  engine.set_wake([&] {
    const std::scoped_lock lock(mutex);
    const auto view = engine.view();
    if (view->frame && (all.empty() || all.back() != view)) all.push_back(view);
  });
  const auto shows = [&](Metric metric) {
    return wait_for([&](const SessionView& view) { return view.frame->shown == metric && !view.frame->provisional; }) != nullptr;
  };
  open("generate random 2000");
  ASSERT_TRUE(begin_endless_run());
  for (const auto& [line, metric] : {std::pair{"show min-angle", Metric::MinAngle},
                                     {"show mean-ratio", Metric::MeanRatio},
                                     {"show radius-ratio", Metric::RadiusRatio},
                                     {"show min-angle", Metric::MinAngle}}) {
    engine.post(line);
    ASSERT_TRUE(shows(metric)) << line;
  }
  stop();
  engine.set_wake({});
  std::vector<std::pair<Metric, bool>> seen;  // without those that only go on
  for (const auto& view : all) {
    EXPECT_EQ(view->frame->shown, view->shown);
    const std::pair one{view->frame->shown, view->frame->provisional};
    if (!seen.empty() && seen.back() == one) continue;
    seen.push_back(one);
    expect_true_of_its_metric(*view->frame, *view);
  }
  const std::vector<std::pair<Metric, bool>> wanted{{Metric::MeanRatio, false}, {Metric::MinAngle, true},    {Metric::MinAngle, false},
                                                    {Metric::MeanRatio, false}, {Metric::RadiusRatio, true}, {Metric::RadiusRatio, false},
                                                    {Metric::MinAngle, true},   {Metric::MinAngle, false}};
  EXPECT_EQ(seen, wanted) << "mean-ratio, which the run raises, was known";
}

TEST_F(LiveLooks, AtRestNothingIsLeftOut) {
  open("generate random 2000");
  ASSERT_TRUE(begin_endless_run());
  engine.post("show min-angle");
  stop();
  const auto view = engine.view();
  EXPECT_EQ(view->frame->shown, Metric::MinAngle);
  EXPECT_FALSE(view->frame->provisional);
  expect_true_of_its_metric(*view->frame, *view);
}

TEST_F(LiveLooks, AnotherMetricIsShownWhileTheRunGoesOn) {
  open(testing::kSanitized ? "generate random 20000" : "generate random 200000");
  ASSERT_TRUE(begin_endless_run());
  views = 0;
  const std::uint64_t show = engine.post("show min-angle");
  const auto seen = wait_for([](const SessionView& view) { return view.frame->shown == Metric::MinAngle; });
  ASSERT_NE(seen, nullptr) << "not before the run's end";
  EXPECT_TRUE(engine.busy());
  EXPECT_LE(views, 3) << "the one that was there, one that was on its way, and this one";
  EXPECT_EQ(seen->shown, Metric::MinAngle);
  EXPECT_EQ(seen->runs[0].parameters.metric, Metric::MeanRatio) << "which the run still raises";
  ASSERT_TRUE(wait_for([&](const SessionView& view) { return view.frame->moment > seen->frame->moment; })) << "it still goes on";
  stop();
  EXPECT_EQ(how(show), CommandEnd::Kind::Done);
  EXPECT_EQ(how(run), CommandEnd::Kind::Cancelled);
  EXPECT_EQ(std::ranges::find(ends, show, &CommandEnd::id)->moved, false);
}

TEST_F(LiveLooks, PressesInARowEachGoOneFurther) {
  open("generate random 5000");
  ASSERT_TRUE(begin_endless_run());
  for (int k = 0; k < 3; ++k) engine.post("show next");
  Engine at_rest(1);
  for (const char* line : {"generate random 100", "show next", "show next", "show next"}) at_rest.post(line);
  at_rest.wait_idle();
  const Metric third = at_rest.view()->shown;
  EXPECT_NE(third, Metric::MeanRatio);
  EXPECT_TRUE(wait_for([&](const SessionView& view) { return view.shown == third; }));
  stop();
}

TEST_F(LiveLooks, WhatCannotBeShownIsSaidAtOnceAndStopsNothing) {
  open("generate random 5000");
  ASSERT_TRUE(begin_endless_run());
  (void)engine.take_messages();
  engine.post("show nonsense");
  std::vector<Message> said;
  for (const auto until = steady_clock::now() + kPatience; said.empty() && steady_clock::now() < until;) {
    said = engine.take_messages();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].kind, Message::Kind::Error);
  EXPECT_NE(said[0].text.find("nonsense"), std::string::npos);
  EXPECT_TRUE(engine.busy());
  stop();
}

TEST_F(LiveLooks, WaitForAMeshThatWasAskedForBefore) {
  open("generate random 5000");
  ASSERT_TRUE(begin_endless_run());
  engine.post("step iteration");  // the command may overtake this one
  engine.post("show min-angle");
  engine.post("generate quads 100");
  engine.post("show scaled-jacobian");
  ASSERT_TRUE(wait_for([](const SessionView& view) { return view.shown == Metric::MinAngle; }));
  const auto later = wait_for([moment = engine.view()->frame->moment](const SessionView& view) { return view.frame->moment > moment; });
  ASSERT_NE(later, nullptr);
  EXPECT_EQ(later->shown, Metric::MinAngle) << "scaled-jacobian was asked for of the mesh that comes next";
  stop();
}

TEST_F(LiveLooks, CancelTakesBackNoLook) {
  open("generate random 5000");
  ASSERT_TRUE(begin_endless_run());
  const std::uint64_t step = engine.post("step iteration");
  const std::uint64_t show = engine.post("show min-angle");
  stop();
  EXPECT_EQ(how(show), CommandEnd::Kind::Done);
  EXPECT_EQ(how(step), CommandEnd::Kind::Dropped);
  EXPECT_EQ(engine.view()->frame->shown, Metric::MinAngle);
}

TEST_F(LiveLooks, UndoOfTheRunKeepsWhatIsShown) {
  open("generate random 5000");
  ASSERT_TRUE(begin_endless_run());
  engine.post("show min-angle");
  ASSERT_TRUE(wait_for([](const SessionView& view) { return view.shown == Metric::MinAngle; }));
  stop();
  ASSERT_FALSE(engine.view()->undo_label.empty());
  engine.post("undo");
  engine.wait_idle();
  EXPECT_EQ(engine.view()->frame->moment, Moment{});
  EXPECT_EQ(engine.view()->shown, Metric::MinAngle) << "it was not the run that changed it";
}

TEST_F(LiveLooks, WhatIsWatchedFromNowOnComesWhileTheRunGoesOn) {
  open("generate random 20000");
  ASSERT_TRUE(begin_endless_run());
  engine.watch({{Watch::kInput, {}}});
  views = 0;
  const auto seen = wait_for([](const SessionView& view) { return !view.watched.empty(); });
  ASSERT_NE(seen, nullptr);
  EXPECT_TRUE(engine.busy());
  EXPECT_LE(views, 3);
  ASSERT_NE(seen->watched[0].frame, nullptr);
  EXPECT_EQ(seen->watched[0].frame->moment, Moment{});
  stop();
}

TEST(RunsInPursuit, TellHowFarTheyGoAndHowMuchPatienceIsLeft) {
  Engine engine(1);
  engine.post("generate random 1000");
  engine.post("step iteration 2");
  engine.post("until-converged 30 100000");
  std::optional<Pursuit> seen;
  std::uint64_t most = 0, least = 1000;
  while (engine.busy()) {
    const auto view = engine.view();
    if (view->runs.empty() || !view->runs[0].pursuit) continue;
    seen = view->runs[0].pursuit;
    EXPECT_EQ(seen->from, 2U);
    EXPECT_EQ(seen->last, 100002U);
    EXPECT_TRUE(seen->until_converged);
    ASSERT_TRUE(seen->patience_left);
    most = std::max(most, *seen->patience_left);
    least = std::min(least, *seen->patience_left);
  }
  EXPECT_LE(most, 30U);
  engine.wait_idle();
  EXPECT_FALSE(engine.view()->runs[0].pursuit) << "it has come to its end";
}

TEST(Searched, CountsNoVertexThatWasPassedOver) {
  Engine engine(2);
  engine.post("generate random 2000");
  engine.post("until-converged");
  engine.wait_idle();
  const RunView& run = engine.view()->runs[0];
  ASSERT_GT(run.records.size(), 5U);
  EXPECT_EQ(run.records[1].searched, run.free_vertices) << "at first nobody is at rest";
  for (std::size_t k = 1; k < run.records.size(); ++k) {
    EXPECT_GE(run.records[k].searched, run.records[k].moved) << k;
    EXPECT_LE(run.records[k].searched, run.free_vertices) << k;
  }
  EXPECT_LT(run.records.back().searched, run.free_vertices / 2) << "most are at rest in the end";
}

TEST(Searched, IsTheSameForEveryNumberOfThreadsAndBlocks) {
  const auto counts = [](unsigned threads, const char* method, const char* steps) {
    Engine engine(threads);
    for (const std::string& line : {std::string("generate random 2000"), std::string(method), std::string(steps)}) engine.post(line);
    engine.wait_idle();
    std::vector<std::uint64_t> all;
    for (const IterationRecord& record : engine.view()->runs[0].records) all.push_back(record.searched);
    return all;
  };
  for (const char* method : {"method dmo", "method laplace", "precision double"}) {
    const auto one = counts(1, method, "run 12");
    EXPECT_EQ(one, counts(3, method, "run 12")) << method;
    auto by_class = counts(1, method, "step class 90");
    ASSERT_GT(by_class.size(), 6U);
    by_class.resize(std::min(by_class.size(), one.size()));
    EXPECT_EQ(std::vector(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(by_class.size())), by_class) << method;
  }
}

}  // namespace
}  // namespace dmoscope
