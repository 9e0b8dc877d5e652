// Frames that a window shows besides the active run.

#include <chrono>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "core/session/session_standing.h"
#include "core/view/frame_builder.h"
#include "tests/support/fake_accelerator.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

class Watching : public ::testing::Test {
 protected:
  void say(const std::string& line) {
    engine_.post(line);
    engine_.wait_idle();
    for (const Message& message : engine_.take_messages()) ASSERT_NE(message.kind, Message::Kind::Error) << line << ": " << message.text;
  }
  /// Opens three runs on one mesh, the last of which is active.
  void open_three() {
    say("generate annulus 600");
    say("add-run dmo:scaled-jacobian");
    say("add-run dmo:radius-ratio");
  }
  [[nodiscard]] std::uint64_t id(std::size_t run) { return engine_.view()->runs.at(run).id; }
  [[nodiscard]] std::vector<WatchedFrame> watched(std::vector<Watch> what) {
    engine_.watch(std::move(what));
    engine_.wait_idle();
    return engine_.view()->watched;
  }
  /// The positions of a run made apart from the engine's.
  [[nodiscard]] std::vector<Vec3> after(Metric metric, std::uint64_t iterations) {
    dmoscope::Run run(engine_.view()->input, {.metric = metric}, std::make_shared<ThreadPool>(1), std::size_t{64} << 20U);
    Progress progress;
    run.iterate(iterations, progress);
    return {run.positions().begin(), run.positions().end()};
  }

  Engine engine_{2};
};

TEST_F(Watching, FramesHaveTheBitsOfTheRunsAndTheInput) {
  open_three();
  say("run 2");
  say("select-run 2");
  say("run 3");
  const auto seen = watched({{id(0), {}}, {id(1), {}}, {id(2), {}}, {Watch::kInput, {}}, {id(1), 1}});
  ASSERT_EQ(seen.size(), 5U);
  for (const WatchedFrame& one : seen) ASSERT_NE(one.frame, nullptr) << one.why_not;
  const auto view = engine_.view();
  EXPECT_EQ(seen[0].frame->positions, view->input->mesh.positions);
  EXPECT_EQ(seen[1].frame, view->frame) << "the active run has one frame";
  EXPECT_EQ(seen[1].frame->positions, after(Metric::ScaledJacobian, 3));
  EXPECT_EQ(seen[2].frame->positions, after(Metric::RadiusRatio, 2));
  EXPECT_EQ(seen[2].frame->run, 2U);
  EXPECT_EQ(seen[3].frame->positions, view->input->mesh.positions);
  EXPECT_EQ(seen[3].frame->run, Frame::kNoRun);
  EXPECT_EQ(seen[4].frame->positions, after(Metric::ScaledJacobian, 1));
  EXPECT_EQ(seen[4].frame->moment, Moment{1});
  EXPECT_EQ(seen[4].frame->statistics.minimum, view->runs[1].records[1].statistics.minimum);
  std::set<std::uint64_t> serials;
  for (const WatchedFrame& one : seen) serials.insert(one.frame->serial);
  EXPECT_EQ(serials.size(), 5U);
}

TEST_F(Watching, WhatDoesNotChangeIsTheSameObject) {
  open_three();
  say("run 2");
  const std::vector<Watch> all{{id(0), {}}, {id(2), {}}, {id(2), 1}, {Watch::kInput, {}}};
  const auto before = watched(all);
  say("run 1");
  const auto after = engine_.view()->watched;
  ASSERT_EQ(after.size(), 4U);
  EXPECT_EQ(after[0].frame, before[0].frame);
  EXPECT_NE(after[1].frame, before[1].frame) << "it has gone on";
  EXPECT_GT(after[1].frame->serial, before[1].frame->serial);
  EXPECT_EQ(after[2].frame, before[2].frame) << "its past has not";
  EXPECT_EQ(after[3].frame, before[3].frame);
  say("show scaled-jacobian");
  for (const WatchedFrame& one : engine_.view()->watched) EXPECT_EQ(one.frame->shown, Metric::ScaledJacobian);
  EXPECT_TRUE(watched({}).empty());
}

TEST_F(Watching, ARunIsKnownByItsIdWhateverItsPlace) {
  open_three();
  const std::uint64_t first = id(0), second = id(1), third = id(2);
  EXPECT_EQ((std::set{first, second, third, Watch::kInput}).size(), 4U);
  say("run 1");
  (void)watched({{first, {}}, {third, {}}});
  say("remove-run 1");
  auto seen = engine_.view()->watched;
  EXPECT_EQ(seen[0].frame, nullptr);
  EXPECT_FALSE(seen[0].why_not.empty());
  ASSERT_NE(seen[1].frame, nullptr);
  EXPECT_EQ(seen[1].frame->run, 1U) << "its place now";
  EXPECT_EQ(seen[1].frame->positions, after(Metric::RadiusRatio, 1));
  EXPECT_EQ(id(1), third);
  say("undo");
  EXPECT_EQ(id(0), first);
  EXPECT_NE(engine_.view()->watched[0].frame, nullptr);
  say("select-run 2");
  say("metric mean-ratio");
  EXPECT_EQ(id(1), second) << "an untouched run with another metric is the same run to whoever looks";
  say("generate annulus 300");
  EXPECT_FALSE((std::set{first, second, third}).contains(id(0)));
}

TEST_F(Watching, APastThatIsNotKeptIsComputedAgainAtRest) {
  say("generate annulus 600");
  say("history 0");
  say("run 6");
  const auto moment = engine_.view()->runs[0].moment;
  const auto seen = watched({{id(0), 4}, {id(0), 9}});
  ASSERT_NE(seen[0].frame, nullptr) << seen[0].why_not;
  EXPECT_EQ(seen[0].frame->positions, after(Metric::MeanRatio, 4));
  EXPECT_EQ(seen[1].frame, nullptr);
  EXPECT_NE(seen[1].why_not.find("iteration 9"), std::string::npos);
  const auto view = engine_.view();
  EXPECT_EQ(view->runs[0].moment, moment) << "the run stays where it stands";
  EXPECT_EQ(view->undo_label, "run 6");
  say("run 3");
  EXPECT_EQ(engine_.view()->watched[0].frame, seen[0].frame);
  ASSERT_NE(engine_.view()->watched[1].frame, nullptr) << "now it has come there";
  EXPECT_EQ(engine_.view()->watched[1].frame->positions, after(Metric::MeanRatio, 9));
}

TEST(Past, IsThePathWithItsEditsAndStopsWhenItShall) {
  Session session(1);
  Progress progress;
  session.open(testing::lattice(12, 0.4, 5), progress);
  session.set_history_budget(0);
  dmoscope::Run& run = session.active();
  run.iterate(2, progress);
  const std::vector<Index> some{30, 31, 44};
  run.visit_vertices(some, progress);
  run.iterate(1, progress);
  const std::vector<Vec3> third(run.positions().begin(), run.positions().end());
  run.iterate(2, progress);
  ASSERT_FALSE(run.history().kept(3));
  EXPECT_EQ(positions_at(session, run, 3, [] { return true; }), third);
  EXPECT_EQ(positions_at(session, run, 3, [] { return false; }), std::nullopt);
  EXPECT_EQ(run.moment(), Moment{5});
}

/// Steps runs by turns, as a verb about all of them may.
TEST(WatchedFrames, OfARunThatStepsWithoutBeingActiveFollow) {
  Session session(1);
  Progress progress;
  session.open(testing::lattice(12, 0.4, 5), progress);
  session.add_run({});
  FrameBuilder builder;
  const std::vector<Watch> both{{session.run(0).id(), {}}, {session.run(1).id(), {}}};
  const auto before = builder.build(session, FrameDetail::Live, both);
  session.run(0).step(StepUnit::Class, progress);
  const auto after = builder.build(session, FrameDetail::Live, both);
  EXPECT_EQ(session.active_index(), 1U);
  EXPECT_EQ(after->watched[1].frame, before->watched[1].frame);
  EXPECT_NE(after->watched[0].frame, before->watched[0].frame);
  const auto positions = session.run(0).positions();
  EXPECT_TRUE(std::ranges::equal(after->watched[0].frame->positions, positions));
}

TEST(WatchedFrames, OfTheActiveRunAreLightWhileItIsOnADevice) {
  const auto device = std::make_shared<testing::FakeDevice>();
  device->pictures = std::make_shared<testing::FakePictureDevice>();
  Session session(1, testing::acceleration(device), Backend::Cuda);
  Progress progress;
  session.open(testing::lattice(12, 0.4, 5), progress);
  session.active().iterate(1, progress);
  FrameBuilder builder;
  const std::vector<Watch> all{{session.run(0).id(), {}}, {session.run(0).id(), 0}, {Watch::kInput, {}}};
  const auto live = builder.build(session, FrameDetail::Live, all);
  EXPECT_NE(live->frame->device, nullptr);
  EXPECT_EQ(live->watched[0].frame, live->frame);
  EXPECT_EQ(live->watched[1].frame->device, nullptr);
  EXPECT_EQ(live->watched[1].frame->positions, session.input()->mesh.positions);
  EXPECT_EQ(live->watched[2].frame->positions, session.input()->mesh.positions);
  const auto whole = builder.build(session, FrameDetail::Whole, all);
  EXPECT_EQ(whole->frame->device, nullptr);
  EXPECT_GT(whole->frame->serial, live->frame->serial);
  EXPECT_EQ(whole->watched[0].frame, whole->frame);
  EXPECT_EQ(whole->watched[2].frame, live->watched[2].frame);
}

}  // namespace
}  // namespace dmoscope
