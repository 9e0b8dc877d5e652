// Messages about elements that stay inverted, the best state of a run, and the rule of each iteration, from records alone.

#include <tuple>

#include <gmock/gmock.h>

#include "core/run/ending.h"
#include "core/run/sweep_after.h"
#include "tests/session/spoken_session.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;

/// Squares of side 4 side by side, each of four triangles around a vertex of its own, which comes first; it stands at `middles`, seen from
/// the lower left corner.
Mesh fans(const std::vector<Vec3>& middles) {
  Mesh mesh;
  for (const Vec3& middle : middles) {
    const auto first = static_cast<Index>(mesh.positions.size());
    const double x = 10.0 * (first / 5U);
    for (const Vec3& p : {middle, Vec3{0, 0, 0}, Vec3{4, 0, 0}, Vec3{4, 4, 0}, Vec3{0, 4, 0}}) mesh.positions.push_back({x + p.x, p.y, 0});
    for (Index i = 0; i < 4; ++i) testing::add(mesh, {first + 1 + i, first + 1 + (i + 1) % 4, first});
  }
  return mesh;
}

using LeftInvertedTest = testing::SpokenSession;

TEST_F(LeftInvertedTest, TheMostInvertedElementAndAFixedVertexAreNamed) {
  session_.open(fans({{5, 2, 0}, {2, 2, 0}, {-3, 2, 0}, {2, -1, 0}}), progress_);
  const auto found = find_left_inverted(session_.active());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->all.all, 3U);
  EXPECT_EQ(found->element, 11U) << "3 beyond the left side of the third square";
  EXPECT_EQ(found->vertex, 2U) << "all have one inverted element: of these the first that is fixed, not the free one before it";
  EXPECT_EQ(found->around, 1U);
  EXPECT_EQ(found->place, (Vec3{4, 0, 0}));
  EXPECT_EQ(found->why_fixed, "it lies on the boundary, which stays");
  EXPECT_EQ(found->sentence(),
            "3 elements stay inverted. Look at element 11 and at vertex 2 at (4, 0, 0), which is in 1 of them; it lies on the boundary, "
            "which stays.");
  session_.open(fans({{2, 2, 0}}), progress_);
  EXPECT_FALSE(find_left_inverted(session_.active()));
}

TEST_F(LeftInvertedTest, AVertexOfMoreOfThemComesBeforeAFixedOne) {
  session_.open(fans({{5, 5, 0}}), progress_);  // beyond a corner: both triangles there are inverted
  const auto found = find_left_inverted(session_.active());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->all.all, 2U);
  EXPECT_EQ(found->around, 2U);
  EXPECT_EQ(found->vertex, 3U) << "the corner, which is fixed, before the middle, which is not, of as many";
  session_.open(fans({{5, 2, 0}}), progress_);
  EXPECT_EQ(find_left_inverted(session_.active())->sentence(),
            "1 element stays inverted. Look at element 1 and at vertex 2 at (4, 0, 0); it lies on the boundary, which stays.");
}

class BestIteration : public testing::SpokenSession {
 protected:
  /// The last of those that are best by these values.
  template <class Worth>
  std::uint64_t best_by(const Worth& worth) {
    const auto& records = session_.active().history().records();
    std::uint64_t best = 0;
    for (std::uint64_t i = 1; i < records.size(); ++i)
      if (worth(records[i].statistics) >= worth(records[best].statistics)) best = i;
    return best;
  }
  std::uint64_t last() { return session_.active().history().records().size() - 1; }
};

TEST_F(BestIteration, IsByInvertedElementsMinimumAndMean) {
  int mean_decides = 0, before_the_end = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const std::string method : {"dmo", "laplace"}) {
      SCOPED_TRACE(method + " " + std::to_string(seed));
      session_.open(testing::lattice(4, 0.45, seed), progress_);
      say("method " + method);
      say("run 30");
      const auto plain = [](const Statistics& s) { return std::tuple(-static_cast<double>(s.inverted), s.minimum, s.movable_minimum); };
      const auto with_mean = [&](const Statistics& s) { return std::tuple_cat(plain(s), std::tuple(s.mean)); };
      const std::uint64_t found = best_iteration(session_.active()), expected = best_by(with_mean);
      const auto& records = session_.active().history().records();
      if (method == "laplace") {
        EXPECT_EQ(found, expected);
      } else {  // rises too small to count may have been given up for a better mean
        const Statistics &here = records[found].statistics, &there = records[expected].statistics;
        EXPECT_EQ(here.inverted, there.inverted);
        EXPECT_GT(here.minimum, there.minimum - 1e-6);
        EXPECT_GT(here.movable_minimum, there.movable_minimum - 1e-6);
        EXPECT_GE(here.mean, there.mean);
      }
      if (expected != best_by(plain)) ++mean_decides;
      if (found != last()) ++before_the_end;
    }
  }
  EXPECT_GT(mean_decides, 0) << "else this test shows less than it says";
  EXPECT_GT(before_the_end, 0);
}

TEST_F(BestIteration, OfTwoAimsIsTheLast) {
  int others_are_better = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    session_.open(testing::lattice(5, 0.4, seed), progress_);
    say("combine mean-ratio:0.2:min-angle");
    say("run 20");
    EXPECT_EQ(best_iteration(session_.active()), last());
    if (best_by([](const Statistics& s) { return s.minimum; }) != last()) ++others_are_better;
  }
  EXPECT_GT(others_are_better, 0) << "else this test shows less than it says";
}

std::vector<IterationRecord> records_with(const std::vector<Index>& inverted) {
  std::vector<IterationRecord> records;
  for (std::size_t i = 0; i < inverted.size(); ++i) {
    IterationRecord record{i, {}, 1, 0.0};
    record.statistics.inverted = inverted[i];
    record.statistics.movable_minimum = -1.0 - static_cast<double>(i);
    records.push_back(record);
  }
  return records;
}

TEST(SweepAfter, AttemptsComeInTheSecondToSixthIterationOfTwoCyclesAndThenNoMore) {
  const std::vector<IterationRecord> records = records_with(std::vector<Index>(90, 3));
  for (std::uint64_t i = 0; i < records.size(); ++i) {
    const Sweep sweep = sweep_after(records, i, {}, false);
    EXPECT_EQ(sweep.untangling.attempt, (i >= 1 && i <= 5) || (i >= 26 && i <= 30)) << i;
    EXPECT_EQ(sweep.untangling.floor, -1.0 - static_cast<double>(i));
    EXPECT_EQ(sweep.iteration, i);
  }
}

TEST(SweepAfter, OfAMeshWithStraysBeginsWithRepairsWhileEachLeavesFewerInverted) {
  const std::vector<IterationRecord> records = records_with({9, 8, 7, 7, 6, 5, 4}), falling = records_with({9, 8, 7, 6, 5, 4, 3, 2});
  for (std::uint64_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(sweep_after(records, i, {}, true).untangling.repair, i < 3) << i;
    EXPECT_FALSE(sweep_after(records, i, {}, false).untangling.repair);
    EXPECT_EQ(sweep_after(falling, i, {}, true).untangling.repair, i < 5) << i;
  }
  EXPECT_FALSE(sweep_after(records_with({0}), 0, {}, true).untangling.repair) << "nothing is inverted";
}

TEST(SweepAfter, CountsAnewWhenFewerAreInvertedAndNotWhenAsManyOrMore) {
  const std::vector<IterationRecord> records = records_with({5, 5, 5, 4, 4, 6, 6, 1, 0, 0});
  const std::vector<std::uint64_t> since{0, 1, 2, 0, 1, 2, 3, 0, 0, 1};
  for (std::uint64_t i = 0; i < records.size(); ++i) EXPECT_EQ(iterations_since_untangled(records, i), since[i]) << i;
  EXPECT_EQ(iterations_since_untangled(records_with(std::vector<Index>(90, 3)), 80), 50U) << "it looks no further";
  EXPECT_EQ(sweep_after(records, 9, {}, false).untangling, Untangling{}) << "nothing is inverted";
}

TEST(SweepAfter, TheFloorOfTheMeanIsTheMinimumFromTheVeryIterationOn) {
  const std::vector<IterationRecord> records = records_with({0, 0, 0, 0});
  EXPECT_EQ(sweep_after(records, 1, {2}, false).floor, Sweep{}.floor);
  EXPECT_EQ(sweep_after(records, 2, {2}, false).floor, -3.0);
  EXPECT_EQ(sweep_after(records, 3, {2}, false).floor, -4.0);
}

}  // namespace
}  // namespace dmoscope
