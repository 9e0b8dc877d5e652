// Runs that continue from the best state of another one, and sessions with such runs.

#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "core/run/ending.h"
#include "core/session/state_file.h"
#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {
namespace continuing {

using ::testing::Contains;
using ::testing::HasSubstr;

class Continuing : public testing::SpokenSession {
 protected:
  [[nodiscard]] std::vector<Vec3> places() {
    const auto now = session_.active().positions();
    return {now.begin(), now.end()};
  }
  [[nodiscard]] double minimum() { return session_.active().statistics().minimum; }
  test::TemporaryFolder folder_;
};

TEST_F(Continuing, BeginsWithTheBestStateAndNeverFalls) {
  for (const char* mesh : {"generate coast 300", "generate mixed 200", "generate tetrahedra 120", "generate screw 150"}) {
    SCOPED_TRACE(mesh);
    say(mesh);
    say("run 5");
    say("best");
    const std::uint64_t iteration = session_.active().moment().iteration;
    const std::vector<Vec3> best = places();
    const double before = minimum();
    const auto input = session_.active().input().mesh.positions;
    say("continue-with boundary slide");
    ASSERT_EQ(session_.run_count(), 2U);
    EXPECT_THAT(messages_, Contains(HasSubstr("from iteration " + std::to_string(iteration) + " of run 1, its best")));
    EXPECT_EQ(session_.active().parameters().boundary, BoundaryRule::Slide);
    EXPECT_EQ(session_.active().moment(), Moment{});
    EXPECT_EQ(places(), best);
    EXPECT_EQ(minimum(), before);
    EXPECT_EQ(session_.active().input().mesh.positions, input) << "the reference stays";
    say("run 10");
    const double after = minimum();
    EXPECT_GE(after, before);
    const std::vector<Vec3> there = places();
    say("seek 0");
    EXPECT_EQ(places(), best);
    say("seek 10");
    EXPECT_EQ(places(), there) << "the same bits";
    say("reset");
    EXPECT_EQ(places(), best);
    say("undo");
    EXPECT_EQ(places(), there);
    say("select-run 1");
    EXPECT_EQ(places(), best) << "the run before is kept";
  }
}

TEST_F(Continuing, TheBestStateIsNotAlwaysTheLast) {
  session_.open(testing::lattice(8, 0.45, 3), progress_);
  say("history 0");
  say("method laplace");
  say("run 12");
  const std::uint64_t best = best_iteration(session_.active());
  say("continue-with method dmo");
  const std::vector<Vec3> begin = places();
  say("select-run 1");
  EXPECT_EQ(session_.active().moment(), Moment{12}) << "it has not moved";
  say("best");
  EXPECT_EQ(session_.active().moment(), Moment{best});
  EXPECT_EQ(places(), begin);
}

TEST_F(Continuing, ARunThatHasNotMovedGetsTheParametersInPlace) {
  session_.open(testing::lattice(8, 0.3, 3), progress_);
  say("continue-with grid 9");
  EXPECT_EQ(session_.run_count(), 1U);
  EXPECT_EQ(session_.active().parameters().search.grid_points, 9);
  EXPECT_FALSE(session_.active().begin());
  say("run 2");
  say("continue-with boundary slide");
  const std::vector<Vec3> begin = places();
  say("max-deviation 0.01");
  EXPECT_EQ(session_.run_count(), 2U);
  EXPECT_EQ(places(), begin) << "it still begins there";
  say("run 2");
  say("then mean");
  ASSERT_EQ(session_.run_count(), 3U);
  EXPECT_EQ(places(), begin) << "a change begins where its run began";
  EXPECT_THAT(messages_, Contains(HasSubstr("from where run 2 began")));
  say("run 3");
  say("continue-with grid 7");
  EXPECT_TRUE(session_.active().begin());
  say("run 1");
  say("boundary fixed");
  ASSERT_EQ(session_.run_count(), 5U);
  EXPECT_FALSE(session_.active().begin()) << "vertices that have moved cannot be fixed there";
}

TEST_F(Continuing, WhatHasMovedIsNotHeldMoreFirmly) {
  session_.open(testing::lattice(8, 0.3, 3), progress_);
  say("boundary slide");
  say("run 3");
  const std::vector<Vec3> before = places();
  EXPECT_THAT(why("continue-with boundary fixed"), HasSubstr("has moved"));
  EXPECT_EQ(session_.run_count(), 1U);
  EXPECT_EQ(places(), before);
  say("grid 9");  // after a failure it is no continuation
  EXPECT_FALSE(session_.active().begin());
  EXPECT_THAT(why("continue-with run 3"), HasSubstr("changes no parameter"));
  EXPECT_THAT(why("continue-with boundary"), HasSubstr("too few arguments"));
  EXPECT_THAT(why("continue-with method nonsense"), HasSubstr("nonsense"));
}

TEST_F(Continuing, IsSavedAndOpenedBitForBit) {
  say("generate mixed 200");
  say("run 4");
  const auto file = folder_.path() / "session.json";
  const auto version = [&] {
    save_state(file, session_, "", progress_);
    std::ifstream in(file);
    return nlohmann::json::parse(in).at("version").get<int>();
  };
  EXPECT_EQ(version(), 2) << "programs of before read what they can";
  say("continue-with boundary slide");
  const std::vector<Vec3> begin = places();
  say("run 3");
  const std::vector<Vec3> there = places();
  EXPECT_EQ(version(), 4);
  Session other(1);
  EXPECT_EQ(open_state(file, other, progress_), "");
  const auto placed = [&] {
    const auto now = other.active().positions();
    return std::vector<Vec3>(now.begin(), now.end());
  };
  EXPECT_EQ(placed(), there);
  other.active().seek({2}, progress_);
  other.active().seek({3}, progress_);
  EXPECT_EQ(placed(), there) << "computed again from where it began";
  other.active().seek({}, progress_);
  EXPECT_EQ(placed(), begin);

  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(text.str());
  json["runs"][1].erase("begin");
  std::ofstream(file) << json.dump();
  EXPECT_THROW((void)open_state(file, other, progress_), InputError);
}

}  // namespace continuing
}  // namespace
}  // namespace dmoscope
