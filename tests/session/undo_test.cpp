// Undo and redo of all changes of meshes and runs.

#include <cstring>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/commands/session_commands.h"
#include "core/engine/engine.h"
#include "tests/session/spoken_session.h"
#include "tests/support/fake_accelerator.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;

/// The state of a session as far as undo restores it.
struct State {
  std::shared_ptr<const InputMesh> input;
  struct OfRun {
    std::string method;
    Metric metric;
    SearchParameters search;
    MethodOptions options;
    VisitOrder order;
    std::vector<Index> fixed;
    Kinds kinds;
    Backend backend;
    Moment moment;
    std::vector<Edit> edits;
    std::vector<Vec3> positions;
  };
  std::vector<OfRun> runs;
};

State state_of(Session& session) {
  State state{session.input(), {}};
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    dmoscope::Run& run = session.run(i);
    const RunParameters& p = run.parameters();
    state.runs.push_back({p.method, p.metric, p.search, p.options, p.order, p.fixed, p.kinds, p.backend, run.moment(), run.edits().all(),
                          std::vector<Vec3>(run.positions().begin(), run.positions().end())});
  }
  return state;
}

void expect_same(const State& a, const State& b, const std::string& what) {
  EXPECT_EQ(a.input, b.input) << what;
  ASSERT_EQ(a.runs.size(), b.runs.size()) << what;
  for (std::size_t i = 0; i < a.runs.size(); ++i) {
    const auto &x = a.runs[i], &y = b.runs[i];
    EXPECT_EQ(x.method, y.method) << what;
    EXPECT_EQ(x.metric, y.metric) << what;
    EXPECT_EQ(x.search, y.search) << what;
    EXPECT_EQ(x.options, y.options) << what;
    EXPECT_EQ(x.order, y.order) << what;
    EXPECT_EQ(x.fixed, y.fixed) << what;
    EXPECT_EQ(x.kinds, y.kinds) << what;
    EXPECT_EQ(x.backend, y.backend) << what;
    EXPECT_EQ(x.moment, y.moment) << what;
    EXPECT_EQ(x.edits, y.edits) << what;
    ASSERT_EQ(x.positions.size(), y.positions.size()) << what;
    EXPECT_EQ(std::memcmp(x.positions.data(), y.positions.data(), x.positions.size() * sizeof(Vec3)), 0) << what;
  }
}

class Undo : public testing::SpokenSession {
 protected:
  using SpokenSession::SpokenSession;
  [[nodiscard]] std::string next_undo() const {
    const UndoEntry* entry = session_.undo_stack().to_undo();
    return entry == nullptr ? "" : entry->label;
  }
  Index free_vertex() {
    const dmoscope::Run& run = session_.active();
    return run.colouring().order[run.colouring().order.size() / 2];
  }
};

TEST_F(Undo, TakesBackEveryCommandAndDoesItAgain) {
  say("generate random 300");
  say("run 3");
  const std::string vertex = std::to_string(free_vertex());
  Index outside = 0;
  while (session_.input()->topology.boundary()[outside] == 0) ++outside;
  const std::string at_boundary = std::to_string(outside);
  for (const std::string& line : std::vector<std::string>{"step vertex",
                                                          "step class 2",
                                                          "step iteration",
                                                          "back vertex",
                                                          "back iteration",
                                                          "run 5",
                                                          "until-converged 3 6",
                                                          "seek 1",
                                                          "visit " + vertex,
                                                          "visit 0-299",
                                                          "seek 0 4",
                                                          "reset",
                                                          "run 2",
                                                          "metric scaled-jacobian",
                                                          "grid 6",
                                                          "levels 2",
                                                          "omega 0.4",
                                                          "precision double",
                                                          "relaxation 0.5",
                                                          "directions axes",
                                                          "seed 7",
                                                          "method smart-laplace",
                                                          "order shuffle:3",
                                                          "backend cpu",
                                                          "fix " + vertex,
                                                          "unfix",
                                                          "corner " + at_boundary,
                                                          "no-corner " + at_boundary,
                                                          "auto-corner",
                                                          "add-run dmo:radius-ratio",
                                                          "run 1",
                                                          "remove-run 1",
                                                          "each run 2",
                                                          "compare metrics 4",
                                                          "compare orders 2 1",
                                                          "each back",
                                                          "each reset",
                                                          "generate annulus 200",
                                                          "run 1",
                                                          "generate coast 300"}) {
    const State before = state_of(session_);
    say(line);
    const State after = state_of(session_);
    if (line != "backend cpu") {  // it may have been that before
      ASSERT_EQ(next_undo(), line);
    }
    say("undo");
    EXPECT_EQ(messages_.back(), "undid: " + line);
    expect_same(state_of(session_), before, "undo " + line);
    say("redo");
    EXPECT_EQ(messages_.back(), "redid: " + line);
    expect_same(state_of(session_), after, "redo " + line);
  }
}

TEST_F(Undo, LeavesNoEntryForWhatFailedOrChangedNothing) {
  EXPECT_TRUE(fails("undo"));
  say("generate random 100");
  EXPECT_EQ(next_undo(), "") << "before the first mesh there is nothing to go back to";
  EXPECT_TRUE(fails("undo"));
  say("run 1");
  for (const char* line : {"run 0", "reset nonsense", "grid 1000", "visit 100000", "show radius-ratio", "select-run 1", "say hello",
                           "history 100", "threads 2", "seek 1", "open /no/such/file"}) {
    (void)fails(line);
    EXPECT_EQ(next_undo(), "run 1") << line;
  }
  EXPECT_TRUE(fails("redo"));
}

TEST_F(Undo, ANewCommandForgetsWhatWasUndone) {
  say("generate random 100");
  say("run 1");
  say("run 2");
  say("undo");
  say("step class");
  EXPECT_TRUE(fails("redo"));
  say("undo");
  say("undo");
  EXPECT_EQ(session_.active().moment(), Moment{});
  EXPECT_TRUE(fails("undo"));
}

TEST_F(Undo, SeeksInARowAreOneEntry) {
  say("generate random 100");
  say("run 9");
  for (const char* line : {"seek 3", "seek 7", "seek 2"}) say(line);
  say("undo");
  EXPECT_EQ(session_.active().moment(), Moment{9});
  say("redo");
  EXPECT_EQ(session_.active().moment(), Moment{2});
  say("seek 5 1");
  say("undo");
  EXPECT_EQ(session_.active().moment(), Moment{2}) << "a seek into an iteration stands for itself";
}

TEST_F(Undo, KeepsWhatWasChosenToBeShown) {
  say("generate random 100");
  say("run 1");
  say("show min-angle");
  say("undo");
  EXPECT_EQ(session_.shown(), Metric::MinAngle) << "showing is not what was undone";
  say("show mean-ratio");
  say("metric radius-ratio");
  EXPECT_EQ(session_.shown(), Metric::RadiusRatio) << "it follows";
  say("undo");
  EXPECT_EQ(session_.shown(), Metric::MeanRatio);
}

TEST_F(Undo, BringsBackTheRecordsOfBefore) {
  say("generate random 200");
  say("run 8");
  const auto records = session_.active().history().records();
  say("seek 2");
  say("visit 0-199");
  EXPECT_EQ(session_.active().history().records().size(), 3U);
  say("undo");
  ASSERT_EQ(session_.active().history().records().size(), 9U);
  EXPECT_EQ(session_.active().history().records()[8].statistics.mean, records[8].statistics.mean);
  say("seek 8");
  EXPECT_EQ(session_.active().statistics().mean, records[8].statistics.mean);
}

TEST_F(Undo, IsBounded) {
  say("generate random 60");
  for (int i = 0; i < 20; ++i) say(fmt::format("generate random {}", 61 + i));
  int inputs = 0;
  while (!fails("undo")) ++inputs;
  EXPECT_EQ(inputs, static_cast<int>(UndoStack::kMostInputs));
  say("generate random 60");
  for (int i = 0; i < 300; ++i) say("step vertex");
  int steps = 0;
  while (!fails("undo")) ++steps;
  EXPECT_EQ(steps, static_cast<int>(UndoStack::kMostEntries));
  for (int i = 0; i < 40; ++i) say(fmt::format("omega 0.{}", 11 + i));
  int changes = 0;
  while (!fails("undo")) ++changes;
  EXPECT_LE(changes, static_cast<int>(UndoStack::kMostRuns) + 1);
  EXPECT_GE(changes, static_cast<int>(UndoStack::kMostRuns) / 2);
}

TEST_F(Undo, OfACancelledCommandThatMoved) {
  say("generate random 400");
  const State start = state_of(session_);
  session_.active().set_observer([&](const dmoscope::Run& run) {
    if (run.moment().iteration >= 3) progress_.request_cancel();
  });
  EXPECT_THROW(say("run 1000"), Cancelled);
  session_.active().set_observer({});
  progress_.clear_cancel();
  const State stopped = state_of(session_);
  EXPECT_EQ(next_undo(), "run 1000");
  say("undo");
  expect_same(state_of(session_), start, "undo");
  say("redo");
  expect_same(state_of(session_), stopped, "redo");
}

TEST_F(Undo, CancelledInTheMidstCanBeAskedForAgain) {
  session_.set_history_budget(0);  // so that it has to be computed again
  say("generate random 400");
  say("run 10");
  const State before = state_of(session_);
  say("reset");
  progress_.request_cancel();
  EXPECT_THROW(say("undo"), Cancelled);
  progress_.clear_cancel();
  EXPECT_EQ(next_undo(), "reset");
  say("step class");  // the session is intact
  say("undo");
  say("undo");
  expect_same(state_of(session_), before, "undo");
}

/// Random sequences of all commands, by a seed.
class RandomUndo : public Undo, public ::testing::WithParamInterface<int> {};

std::string random_line(testing::Random& random, Session& session) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() * static_cast<double>(n)); };
  const auto& order = session.active().colouring().order;
  const auto vertex = [&] { return order[below(order.size())]; };
  switch (below(14)) {
    case 0:
      return "step vertex 3";
    case 1:
      return "step class";
    case 2:
      return fmt::format("run {}", 1 + below(4));
    case 3:
      return "back iteration";
    case 4:
      return "back vertex 2";
    case 5:
      return fmt::format("seek {}", below(8));
    case 6:
    case 7:
    case 8:
      return fmt::format("visit {} {} {}", vertex(), vertex(), vertex());
    case 9:
      return below(2) == 0 ? "reset" : "until-converged 2 3";
    case 10:
      return fmt::format("metric {}", below(2) == 0 ? "mean-ratio" : "scaled-jacobian");
    case 11:
      return fmt::format("fix {}", vertex());
    case 12:
      return session.run_count() > 1 ? fmt::format("remove-run {}", 1 + below(session.run_count())) : "add-run dmo:radius-ratio";
    default:
      return fmt::format("select-run {}", 1 + below(session.run_count()));
  }
}

TEST_P(RandomUndo, AllTheWayBackIsTheInputAndAllTheWayForwardsTheEnd) {
  testing::Random random(static_cast<std::uint64_t>(GetParam()));
  session_.set_history_budget(GetParam() % 2 == 0 ? Session::kDefaultHistoryBytes : 40000);
  say("generate random 150");
  const State start = state_of(session_);
  std::vector<State> states{start};
  std::string trail;
  for (int i = 0; i < 22; ++i) {
    const std::string line = random_line(random, session_);
    trail += line + "; ";
    const UndoEntry* before = session_.undo_stack().to_undo();
    const std::size_t merged = before != nullptr && before->label.starts_with("seek") && line.starts_with("seek") ? 1 : 0;
    const SessionPoint here = session_.point();
    say(line);
    if (here.same_state(session_.point())) continue;
    if (merged == 1) states.pop_back();
    states.push_back(state_of(session_));
  }
  std::size_t at = states.size() - 1;
  while (session_.undo_stack().to_undo() != nullptr) {
    say("undo");
    ASSERT_GT(at, 0U) << trail;
    expect_same(state_of(session_), states[--at], trail);
  }
  expect_same(state_of(session_), states[at], trail);
  if (at > 0) return;  // more runs than undo remembers
  expect_same(state_of(session_), start, trail);
  while (session_.undo_stack().to_redo() != nullptr) {
    say("redo");
    expect_same(state_of(session_), states[++at], trail);
  }
  EXPECT_EQ(at, states.size() - 1) << trail;
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomUndo, ::testing::Range(1, 25));

/// Undo on a device.
class DeviceUndo : public Undo {
 protected:
  DeviceUndo() : DeviceUndo(std::make_shared<testing::FakeDevice>()) {}
  explicit DeviceUndo(std::shared_ptr<testing::FakeDevice> device) : Undo(testing::acceleration(device)), device_(std::move(device)) {}
  std::shared_ptr<testing::FakeDevice> device_;
};

TEST_F(DeviceUndo, ARetiredRunLeavesTheDeviceAndComesBack) {
  say("generate random 200");
  ASSERT_EQ(session_.active().backend(), Backend::Cuda);
  say("run 2");
  say("add-run dmo:radius-ratio");
  say("remove-run 1");
  say("undo");
  say("undo");
  ASSERT_EQ(session_.run_count(), 1U);
  EXPECT_EQ(session_.active().moment(), Moment{2});
  const std::uint64_t visits = device_->visits;
  say("run 1");
  EXPECT_GT(device_->visits, visits) << "on the device again";
  say("undo");
  say("undo");
  EXPECT_EQ(session_.active().moment(), Moment{});
}

TEST(UndoEngine, ViewsTellWhatUndoIsAbout) {
  Engine engine(1);
  const auto say = [&](const std::string& line) {
    engine.post(line);
    engine.wait_idle();
    return engine.view();
  };
  EXPECT_EQ(say("generate random 100")->undo_label, "");
  EXPECT_EQ(say("run 2")->undo_label, "run 2");
  const auto undone = say("undo");
  EXPECT_EQ(undone->undo_label, "");
  EXPECT_EQ(undone->redo_label, "run 2");
  EXPECT_EQ(undone->frame->moment, Moment{});
  EXPECT_EQ(say("redo")->redo_label, "");
}

}  // namespace
}  // namespace dmoscope
