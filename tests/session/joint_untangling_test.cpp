// Vertices around inverted elements are moved together first, as one iteration like any other.

#include <algorithm>
#include <memory>
#include <string_view>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {
namespace joint_untangling {

using testing::Cells;
using testing::input;
using testing::lattice;

/// Nine squares whose inner square is turned round by half a turn: every element of each free vertex but two is inverted.
std::shared_ptr<const InputMesh> turned_square() {
  Mesh mesh = lattice(3, 0.0, 1, Cells::Quadrilaterals);
  std::swap(mesh.positions[5], mesh.positions[10]);
  std::swap(mesh.positions[6], mesh.positions[9]);
  return input(std::move(mesh));
}

dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters = {}, std::size_t history = 0) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(2), history};
}

TEST(JointUntangling, TurnsASquareThatNoSingleVertexTurns) {
  const auto mesh = turned_square();
  for (const char* method : {"dmo", "smart-laplace", "dvr", "pattern-search", "active-set"}) {
    dmoscope::Run run = make_run(mesh, {.method = method});
    Progress progress;
    run.iterate(20, progress);
    const auto& records = run.history().records();
    EXPECT_EQ(records[0].statistics.inverted, 4U);
    EXPECT_EQ(records[20].statistics.inverted, 0U) << method;
    EXPECT_GT(records[20].statistics.minimum, method == std::string_view("dmo") ? 0.999 : 0.0) << method;
    for (std::size_t i = 1; i < records.size(); ++i) EXPECT_GE(records[i].statistics.minimum, records[i - 1].statistics.minimum) << method;
  }
}

TEST(JointUntangling, IsAnIterationLikeAnyOther) {
  const auto mesh = turned_square();
  Progress progress;
  dmoscope::Run there = make_run(mesh);
  there.iterate(6, progress);
  const auto& records = there.history().records();
  const auto turned = std::ranges::find(records, 0U, [](const IterationRecord& record) { return record.statistics.inverted; });
  ASSERT_NE(turned, records.end());
  EXPECT_EQ(turned->moved, 4U);
  const std::vector<Vec3> end(there.positions().begin(), there.positions().end());
  // Nothing is kept: it is computed again.
  there.seek({turned->iteration - 1}, progress);
  EXPECT_TRUE(same_bits(there.positions(), mesh->mesh.positions));
  EXPECT_EQ(there.step(StepUnit::Vertex, progress), 4U) << "it is one step, whatever the unit";
  EXPECT_EQ(there.moment(), (Moment{turned->iteration}));
  EXPECT_TRUE(there.back(StepUnit::Class, progress));
  EXPECT_EQ(there.moment(), (Moment{turned->iteration - 1}));
  there.seek({6}, progress);
  EXPECT_TRUE(same_bits(there.positions(), end));
}

TEST(JointUntangling, TakesAnyMetricAndSaysWhatItDid) {
  Progress progress;
  dmoscope::Run run = make_run(turned_square(), {.metric = parse_metric("formula:min_corner(det/norm^2)")});
  const Outcome outcome = run.iterate(1, progress);
  EXPECT_EQ(run.history().records()[1].statistics.inverted, 0U);
  ASSERT_EQ(outcome.untanglings.size(), 1U);
  EXPECT_EQ(outcome.untanglings[0].iteration, 1U);
  EXPECT_EQ(outcome.untanglings[0].before, 4U);
  EXPECT_EQ(outcome.untanglings[0].after, 0U);
  EXPECT_NE(outcome.sentence().find("in iteration 1, 4 vertices moved together, which untangled 4 of 4 inverted elements"),
            std::string::npos)
      << outcome.sentence();
}

TEST(JointUntangling, LeavesAloneWhatDoesNotOptimise) {
  Progress progress;
  dmoscope::Run run = make_run(turned_square(), {.method = "laplace"});
  EXPECT_TRUE(run.iterate(60, progress).untanglings.empty());
}

TEST(JointUntangling, ComesFirstAndOnceAfterTheLastAttempt) {
  std::vector<IterationRecord> records(UntanglingPlan::kEnd + 10);
  for (std::size_t i = 0; i < records.size(); ++i) {
    records[i].iteration = i;
    records[i].moved = 1;
    records[i].statistics.inverted = i < 4 ? 3 : 2;
  }
  const auto joint_iterations = [&records](bool strays) {
    std::vector<std::uint64_t> all;
    for (std::size_t i = 0; i < records.size(); ++i)
      if (untangles_jointly(records, i, strays)) all.push_back(i);
    return all;
  };
  EXPECT_EQ(joint_iterations(false), (std::vector<std::uint64_t>{0, 4 + UntanglingPlan::kEnd}));
  // Strays go home first; the first iteration here brings none home.
  EXPECT_EQ(joint_iterations(true), (std::vector<std::uint64_t>{1, 4 + UntanglingPlan::kEnd}));
  records[1].statistics.inverted = 2;
  for (std::size_t i = 2; i < records.size(); ++i) records[i].statistics.inverted = 1;
  EXPECT_EQ(joint_iterations(true), (std::vector<std::uint64_t>{3, 2 + UntanglingPlan::kEnd}));
}

}  // namespace joint_untangling
}  // namespace
}  // namespace dmoscope
