// A run until it has converged ends once it is certified that nothing raises the worst element, with the result of one that goes on.

#include <memory>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/run/run.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {
namespace certified_end {

/// Many vertices that move on for long, and one whose neighbours all stay, one of them far too near.
struct Held {
  std::shared_ptr<const InputMesh> mesh;
  RunParameters parameters;
};
Held held() {
  constexpr Index kSide = 90, kVertex = 45 * (kSide + 1) + 45;
  Mesh mesh = testing::lattice(kSide, 0.3, 5);
  mesh.positions[kVertex] = {0.5, 0.5, 0.0};
  mesh.positions[kVertex + 1] = {0.5 + 0.1 / kSide, 0.5, 0.0};
  RunParameters parameters;
  for (const Index row : {kVertex - kSide - 1, kVertex, kVertex + kSide + 1})
    for (const Index v : {row - 1, row, row + 1})
      if (v != kVertex) parameters.fixed.push_back(v);
  return {testing::input(std::move(mesh)), parameters};
}
dmoscope::Run make_run(const Held& held) { return {held.mesh, held.parameters, std::make_shared<ThreadPool>(2), std::size_t{1} << 28U}; }

TEST(CertifiedEnd, IsThatOfARunThatGoesOn) {
  const Held mesh = held();
  Progress progress;
  dmoscope::Run run = make_run(mesh), longer = make_run(mesh);
  const Outcome outcome = run.until_converged({}, progress);
  ASSERT_EQ(outcome.reason, StopReason::Certified) << outcome.sentence();
  EXPECT_LT(outcome.iterations, 150U);
  longer.iterate(outcome.last_rise + ConvergenceLimits{}.patience, progress);
  const auto& all = longer.history().records();
  EXPECT_GT(all[outcome.iterations + 1].moved, 0U) << "else this test shows nothing";
  EXPECT_LT(all.back().statistics.minimum - all[outcome.last_rise].statistics.minimum, kLeastRise);
  const std::uint64_t best = best_iteration(mesh.parameters, all);
  run.end_at_best(progress);
  EXPECT_EQ(run.moment(), (Moment{best}));
  longer.seek({best}, progress);
  EXPECT_TRUE(same_bits(run.positions(), longer.positions()));
}

TEST(CertifiedEnd, CutsNoPhaseOff) {
  Held mesh = held();
  Progress progress;
  mesh.parameters.then_mean.emplace();
  dmoscope::Run run = make_run(mesh);
  EXPECT_EQ(run.until_converged({.max_iterations = 150}, progress).reason, StopReason::IterationLimit);
}

}  // namespace certified_end
}  // namespace
}  // namespace dmoscope
