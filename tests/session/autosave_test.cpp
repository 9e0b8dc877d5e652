// Automatic saving: in time, also during a run; found after a crash, removed after a regular end.
#include "core/engine/autosave.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "core/engine/engine.h"
#include "tests/session/spoken_session.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope {
namespace {

using namespace std::chrono_literals;

class AutosaveTest : public ::testing::Test {
 protected:
  AutosaveTest() { open(); }
  void open(std::chrono::milliseconds every = 20ms) {
    engine_ = std::make_unique<Engine>(2U);
    engine_->autosave({folder_.path(), every});
  }
  /// Leaves the session as a killed process does.
  void lose() { engine_.reset(); }
  void good(const std::string& line) {
    engine_->post(line);
    engine_->wait_idle();
    for (const Message& message : engine_->take_messages()) ASSERT_EQ(message.exit_code, 0) << line << ": " << message.text;
  }
  [[nodiscard]] std::vector<std::filesystem::path> files(const std::string& ending) const {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
      if (entry.path().extension() == ending && !entry.path().filename().string().starts_with('.')) found.push_back(entry.path());
    return found;
  }
  /// Waits patiently: no time is promised.
  [[nodiscard]] static bool comes(const std::function<bool()>& what) {
    for (int k = 0; k < 6000; ++k) {
      if (what()) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }
  [[nodiscard]] bool saved(std::size_t count = 1) const {
    return comes([&] { return files(".dmoscope").size() == count && files(".json").size() == count; });
  }
  [[nodiscard]] std::vector<Vec3> positions() { return engine_->view()->frame->positions; }

  const test::TemporaryFolder folder_;
  std::unique_ptr<Engine> engine_;
};

TEST_F(AutosaveTest, AtRestIsRecoveredBitForBit) {
  good("generate coast 500");
  good("run 3");
  good("add-run laplace");
  good("step class");
  ASSERT_TRUE(saved());
  ASSERT_TRUE(engine_->autosave_now(60s));
  const std::vector<Vec3> before = positions();
  EXPECT_TRUE(find_recoverable(folder_.path()).empty()) << "its window lives";
  lose();
  auto found = find_recoverable(folder_.path());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].mesh.starts_with("coast 500")) << found[0].mesh;
  EXPECT_EQ(found[0].iteration, 0U);
  EXPECT_EQ(found[0].runs, 2U);
  EXPECT_GT(found[0].when, 0);
  EXPECT_TRUE(find_recoverable(folder_.path()).empty()) << "two windows must not offer the same";
  open();
  good("recover " + found[0].names.session.string());
  EXPECT_EQ(positions(), before);
  EXPECT_EQ(engine_->view()->runs.size(), 2U);
  EXPECT_TRUE(engine_->view()->runs[0].unsaved);
  // After the next automatic save the old file is not needed any more.
  EXPECT_TRUE(comes([&] { return !std::filesystem::exists(found[0].names.session); }));
  EXPECT_TRUE(saved());
}

TEST_F(AutosaveTest, ALongRunIsSavedOnItsWay) {
  good("generate coast 2000");
  engine_->post("run 1000000");
  ASSERT_TRUE(saved());
  ASSERT_TRUE(engine_->busy());
  lose();
  const auto found = find_recoverable(folder_.path());
  ASSERT_EQ(found.size(), 1U);
  open(1h);
  good("recover " + found[0].names.session.string());
  const std::vector<Vec3> recovered = positions();
  const Moment at = engine_->view()->runs[0].moment;
  EXPECT_NE(at, Moment{});
  EXPECT_EQ(found[0].iteration, at.iteration);
  good("generate coast 2000");
  // On a slow machine the save may fall into an iteration.
  if (at.iteration > 0) good("run " + std::to_string(at.iteration));
  if (at.visits > 0) good("step vertex " + std::to_string(at.visits));
  EXPECT_EQ(engine_->view()->runs[0].moment, at);
  EXPECT_EQ(positions(), recovered);
}

TEST_F(AutosaveTest, InTheMidstOfAnIterationThatIsNoLongerKept) {
  good("history 0");
  good("generate coast 500");
  good("run 5");
  good("step class");
  ASSERT_TRUE(engine_->autosave_now(60s));
  const std::vector<Vec3> before = positions();
  lose();
  const auto found = find_recoverable(folder_.path());
  ASSERT_EQ(found.size(), 1U);
  open(1h);
  good("recover " + found[0].names.session.string());
  EXPECT_EQ(positions(), before);
  EXPECT_EQ(engine_->view()->runs[0].moment.iteration, 5U);
  EXPECT_GT(engine_->view()->runs[0].moment.visits, 0U);
}

/// A session whose history keeps nothing, saved automatically between any two blocks of visits and at no other time.
class AutosaveOnItsWayTest : public testing::SpokenSession {
 protected:
  AutosaveOnItsWayTest() {
    constexpr double kAllTheTime = 1e30;
    safe_ = std::make_unique<Autosave>(AutosaveOptions{folder_.path(), 0ms, kAllTheTime}, [](const std::string&) {});
    session_.observe([this](const auto& run) { safe_->while_running(session_, run); });
    say("history 0");
    say("generate coast 500");
  }
  [[nodiscard]] std::vector<Vec3> positions() {
    const auto now = session_.active().positions();
    return {now.begin(), now.end()};
  }
  /// Leaves the session as a killed process does; opens the file that is found.
  void lose_and_recover() {
    ASSERT_TRUE(safe_->flush(60s));
    session_.observe({});
    safe_.reset();
    const auto found = find_recoverable(folder_.path());
    ASSERT_EQ(found.size(), 1U);
    say("open-state " + found[0].names.session.string());
  }
  const test::TemporaryFolder folder_;
  std::unique_ptr<Autosave> safe_;
};

TEST_F(AutosaveOnItsWayTest, InTheMidstOfALongIterationToo) {
  say("run 5");
  say("step class");
  say("step class");
  const Moment before = session_.active().moment();
  ASSERT_EQ(before.iteration, 5U);
  ASSERT_GT(before.visits, 0U);
  ASSERT_FALSE(session_.active().history().kept(5));
  const std::vector<Vec3> there = positions();
  lose_and_recover();
  EXPECT_EQ(session_.active().moment(), before);
  EXPECT_EQ(positions(), there);
}

TEST_F(AutosaveOnItsWayTest, OfARunThatWaitsInTheMidstOfAnIterationWhileAnotherOneGoesOn) {
  say("run 3");
  say("step class");
  const std::vector<Vec3> there = positions();
  say("add-run laplace");
  say("run 2");
  say("step class");
  lose_and_recover();
  ASSERT_EQ(session_.run_count(), 2U);
  EXPECT_EQ(session_.active().moment().iteration, 2U);
  EXPECT_GT(session_.active().moment().visits, 0U);
  say("select-run 1");
  EXPECT_EQ(session_.active().moment().iteration, 3U);
  EXPECT_EQ(positions(), there);
}

/// Noted starts of iterations, while the path since then is not looked at.
class IterationStartsTest : public testing::SpokenSession {};

TEST_F(IterationStartsTest, ABeginOfAPathThatWasLeftIsNotTakenForThisOne) {
  say("history 0");
  say("generate coast 500");
  say("run 3");
  IterationStarts starts;
  starts.note(session_.identity(0));
  const auto noted = starts.of(session_.active());
  ASSERT_NE(noted, nullptr);
  say("step class");
  EXPECT_EQ(starts.of(session_.active()), noted) << "it stands in the iteration that begins there";
  const auto fixed = session_.active().fixed();
  const std::string visit = "visit " + std::to_string(std::ranges::find(fixed, 0) - fixed.begin());
  say(visit);
  EXPECT_EQ(starts.of(session_.active()), noted) << "an edit in the midst of the iteration leaves its begin as it was";
  say("seek 2");
  EXPECT_EQ(starts.of(session_.active()), nullptr);
  say(visit);
  say("seek 3");
  EXPECT_EQ(starts.of(session_.active()), nullptr) << "it came there by another path";
}

TEST_F(AutosaveTest, WhatIsInAFileIsNotKeptBesides) {
  good("generate coast 300");
  good("run 2");
  ASSERT_TRUE(saved());
  good("export " + (folder_ / "a.off").string());
  EXPECT_TRUE(comes([&] { return files(".dmoscope").empty() && files(".json").empty(); }));
  good("run 1");
  EXPECT_TRUE(saved());
  good("reset");
  EXPECT_TRUE(comes([&] { return files(".dmoscope").empty(); }));
}

TEST_F(AutosaveTest, AGoodEndLeavesNothing) {
  good("generate coast 300");
  good("run 2");
  ASSERT_TRUE(saved());
  engine_->end_autosave();
  lose();
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(AutosaveTest, AWindowThatDidNothingLeavesNothing) {
  good("generate coast 300");
  lose();
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(AutosaveTest, AFolderThatIsGoneIsSaidOnceAndStopsNothing) {
  good("generate coast 300");
  std::filesystem::remove_all(folder_.path());
  std::size_t said = 0;
  for (int k = 0; k < 5; ++k) {
    engine_->post("run 1");
    engine_->wait_idle();
    ASSERT_TRUE(engine_->autosave_now(60s));
    for (const Message& message : engine_->take_messages())
      if (message.text.find("not saved by itself") != std::string::npos) ++said;
  }
  EXPECT_EQ(said, 1U);
  EXPECT_EQ(engine_->view()->runs[0].moment.iteration, 5U);
  std::filesystem::create_directories(folder_.path());
  EXPECT_TRUE(saved());  // a replacement is computed
}

TEST_F(AutosaveTest, AFileOfAPersonIsRecoveredAndStays) {
  good("generate coast 300");
  good("run 2");
  const std::string own = (folder_ / "own.dmoscope").string();
  good("save-state " + own);
  good("recover " + own);
  ASSERT_TRUE(engine_->autosave_now(60s));
  EXPECT_EQ(files(".dmoscope").size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(own));
}

TEST_F(AutosaveTest, WhatIsToldOfItMayBeDamaged) {
  good("generate coast 300");
  good("run 2");
  ASSERT_TRUE(saved());
  lose();
  std::ofstream(files(".json").front()) << "{ nothing";
  const auto found = find_recoverable(folder_.path());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(found[0].when, 0);
  EXPECT_EQ(found[0].mesh, "");
}

}  // namespace
}  // namespace dmoscope
