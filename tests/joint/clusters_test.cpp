// Joint moves raise the minimum, never lower it, and leave alone what may not move.

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>

#include <gmock/gmock.h>

#include "core/base/same_bits.h"
#include "core/joint/joint_clusters.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using namespace testing;

/// Run that stands where DMO ends, or near it.
dmoscope::Run after_dmo(const std::shared_ptr<const InputMesh>& mesh, std::uint64_t iterations) {
  dmoscope::Run run = make_run(mesh, {.layers = LayerRule::Free});
  Progress progress;
  run.until_converged({.patience = 20, .max_iterations = iterations}, progress);
  return run;
}

Statistics judged(const dmoscope::Run& run, std::span<const Vec3> positions) {
  return compute_statistics(run.input().quality_context(), positions, Metric::MeanRatio, run.immovable(), nullptr);
}

TEST(JointClusters, NeverWorseAndWhatIsFixedStays) {
  std::size_t moved = 0;
  for (const Specimen& specimen : zoo()) {
    const auto mesh = input(specimen.mesh);
    const dmoscope::Run run = after_dmo(mesh, 3);
    JointClusters clusters(*mesh, Metric::MeanRatio, run.fixed());
    std::vector<Vec3> positions(run.positions().begin(), run.positions().end());
    JointState state;
    Progress progress;
    Statistics before = judged(run, positions);
    for (int call = 0; call < 4; ++call) {
      const std::vector<Vec3> old = positions;
      const JointState old_state = state;
      const auto cluster = clusters.raise_worst(positions, state, {}, progress);
      if (!cluster) {
        EXPECT_TRUE(same_bits(std::span(positions), std::span(old))) << specimen.name;
        break;
      }
      const Statistics now = judged(run, positions);
      ASSERT_GE(now.minimum, before.minimum) << specimen.name << ", call " << call;
      ASSERT_GE(now.movable_minimum, before.movable_minimum) << specimen.name << ", call " << call;
      ASSERT_LE(now.inverted, before.inverted) << specimen.name << ", call " << call;
      for (Index v = 0; v < old.size(); ++v) {
        if (run.fixed()[v] == 0) continue;
        ASSERT_TRUE(same_bits(std::span(positions).subspan(v, 1), std::span(old).subspan(v, 1))) << specimen.name << ": vertex " << v;
      }
      std::vector<Vec3> again = old;
      JointState state_again = old_state;
      (void)clusters.raise_worst(again, state_again, {}, progress);
      ASSERT_TRUE(same_bits(std::span(again), std::span(positions)) && state_again == state) << specimen.name << ": another time";
      moved += cluster->moved.size();
      before = now;
    }
  }
  EXPECT_GT(moved, 100U);
}

struct Wanted {
  const char* file;
  double minimum;
  friend void PrintTo(const Wanted& wanted, std::ostream* out) { *out << wanted.file; }
};
class JointClustersOfRealMeshes : public ::testing::TestWithParam<Wanted> {};

TEST_P(JointClustersOfRealMeshes, RaiseWhatDmoCannot) {
  const auto file = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  Progress progress;
  const auto mesh = load_input(file, Need::Smoothing, progress);
  const dmoscope::Run run = after_dmo(mesh, 200);
  JointClusters clusters(*mesh, Metric::MeanRatio, run.fixed());
  std::vector<Vec3> positions(run.positions().begin(), run.positions().end());
  JointState state;
  for (int call = 0; call < 50; ++call)
    if (!clusters.raise_worst(positions, state, {}, progress)) break;
  const double reached = judged(run, positions).movable_minimum;
  RecordProperty("minimum", std::to_string(reached));
  EXPECT_GE(reached, GetParam().minimum) << "from " << judged(run, run.positions()).movable_minimum;
  EXPECT_EQ(judged(run, positions).inverted, judged(run, run.positions()).inverted);
}
INSTANTIATE_TEST_SUITE_P(Wanted, JointClustersOfRealMeshes,
                         ::testing::Values(Wanted{"tri/shashkov.vtk", 0.26}, Wanted{"ocean/east.14", 0.81649},
                                           Wanted{"ocean/bahamas.14", 0.76908}, Wanted{"mixed2d/overt_hyb_1.vtk", 0.697},
                                           Wanted{"tet/cube-clip-5.vtk", 0.379}, Wanted{"mixed3d/mixed-hex-pyr-tet.vtk", 0.449},
                                           Wanted{"quad/shashkov_quad.vtk", 0.22}, Wanted{"tet/cinolib_sphere.mesh", 0.467},
                                           Wanted{"tet/tire.vtk", 0.3655}));

class JointClustersThatSlide : public ::testing::TestWithParam<Wanted> {};

/// Raises more than sliding single vertices (0.2552, 0.2602, 0.8609), and than joint moves with the boundary fixed (0.2643, 0.2272,
/// 0.8165).
TEST_P(JointClustersThatSlide, RaiseWhatNeitherAloneCan) {
  const auto file = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  Progress progress;
  RunParameters parameters{.layers = LayerRule::Free};  // the quadrilaterals are graded towards the boundary
  parameters.boundary = BoundaryRule::Slide;
  parameters.then_joint.emplace();
  dmoscope::Run run = make_run(load_input(file, Need::Smoothing, progress), parameters);
  run.until_converged({.patience = 5, .max_iterations = 2000}, progress);
  EXPECT_GE(run.statistics().minimum, GetParam().minimum);
  EXPECT_EQ(run.statistics().inverted, 0U);
}
INSTANTIATE_TEST_SUITE_P(Wanted, JointClustersThatSlide,
                         ::testing::Values(Wanted{"tri/shashkov.vtk", 0.3227}, Wanted{"quad/shashkov_quad.vtk", 0.3241},
                                           Wanted{"ocean/east.14", 0.8659}));

}  // namespace
}  // namespace dmoscope
