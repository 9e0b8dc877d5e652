// DMO of volumes on a device, with the host in the device's place: the processor's bits, in either precision.

#include "gpu/host_queue.h"
#include "gpu/listed_star.h"
#include "tests/gpu/meshes.h"
#include "tests/gpu/same_bits.h"
#include "tests/gpu/volumes.h"
#include "tests/smooth/zoo.h"
#include "tests/support/sanitized.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;
using dmoscope::testing::defined_for_all;
using dmoscope::testing::kSanitized;

std::shared_ptr<HostQueue> volume_host(const HostDevice& device = {}) { return make_host_queue(device); }

class VolumeDeviceDmo : public ::testing::TestWithParam<Metric> {
 protected:
  void expect_same(const SearchParameters& parameters, std::size_t size, int iterations) {
    for (const VolumeSample& sample : volume_samples(size)) {
      if (!defined_for_all(GetParam(), sample.input->mesh)) continue;
      SCOPED_TRACE(sample.name);
      const Subject subject(sample.input);
      ASSERT_GT(subject.visits(), 0U);
      expect_same_visits(volume_host(), subject, GetParam(), parameters, iterations);
    }
  }
};

/// 27 free vertices, or eight.
TEST_P(VolumeDeviceDmo, SameBitsInFloat) { expect_same({}, kSanitized ? 64 : 125, 3); }
TEST_P(VolumeDeviceDmo, SameBitsInDouble) { expect_same({.precision = Precision::Double}, 64, kSanitized ? 1 : 2); }
TEST_P(VolumeDeviceDmo, SameBitsInRepairs) {
  for (const VolumeSample& sample : volume_samples(64)) {
    if (!defined_for_all(GetParam(), sample.input->mesh)) continue;
    SCOPED_TRACE(sample.name);
    expect_same_visits(volume_host(), Subject(sample.input), GetParam(), {}, 1, {.untangling = {.repair = true}});
  }
}
/// Grids of 7 and 2 candidates per axis, not multiples of the number that a lane ranks at a time.
TEST_P(VolumeDeviceDmo, SameBitsWithOtherGrids) {
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    expect_same({.grid_points = 7, .levels = 2, .omega = 1.25, .precision = precision}, 64, 2);
    expect_same({.grid_points = 2, .levels = 5, .precision = precision}, 64, 2);
  }
}

/// Small meshes: the host is slow in a device's place.
TEST_P(VolumeDeviceDmo, SameBitsOnSharedMeshes) {
  const auto meshes = shared_volumes(kSanitized ? 400 : 1000);
  if (meshes.empty()) GTEST_SKIP() << "no shared meshes here";
  for (const auto& mesh : meshes) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same_visits(volume_host(), Subject(mesh), GetParam(), {}, 1);
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, VolumeDeviceDmo, every_volume_metric(), name_of_metric);

/// The order of a mean over a star's elements is list after list, as in VolumeStarView, whatever the mesh's order.
TEST(VolumeDeviceStar, HasItsElementsListAfterList) {
  const auto input = volume_samples(216)[9].input;  // "solids, tangled": it has all lists
  std::size_t mixed = 0;
  for (Index vertex = 0; vertex < input->mesh.vertex_count(); ++vertex) {
    if (input->topology.star(vertex).empty()) continue;
    const PositionView positions(input->mesh.positions);
    VolumeStar<double> expected;
    gather_star(MeshStar<Space>(input->view<Space>(), positions, vertex), expected);
    using Seen = std::pair<unsigned, double>;  // its list and its reference
    std::vector<Seen> there, here;
    const ListedStar<Space> star(input->view<Space>(), positions, vertex);
    star.for_each<true>([&here](const auto& e) { here.emplace_back(kListOf<std::remove_cvref_t<decltype(e)>>, e.reference); });
    VolumeStarView<double>(expected).for_each<true>(
        [&there](const auto& e) { there.emplace_back(kListOf<std::remove_cvref_t<decltype(e)>>, e.reference); });
    ASSERT_EQ(here, there) << vertex;
    if (here.front().first != here.back().first) ++mixed;
  }
  EXPECT_GT(mixed, 0U);
}

Subject jittered_volumes() {
  Progress progress;
  return Subject(volume_input_of(tangled(generate_mesh("solids", 216, 7, progress), 0.4)));
}

/// Neither the number of lanes nor the division of an iteration into calls matters.
TEST(VolumeDeviceVisits, NeitherThreadsNorCutsChangeTheResult) {
  const Subject subject = jittered_volumes();
  ThreadPool pool(4);
  const auto whole = make_device_dmo(volume_host(), subject.task(Metric::MeanRatio));
  const auto cut = make_device_dmo(volume_host({.pool = &pool}), subject.task(Metric::MeanRatio, {}, &pool));
  expect_cuts_change_nothing(*whole, *cut, subject, 37, std::vector<Sweep>(3));
}

/// Pictures of a volume use positions from the host.
TEST(VolumeDeviceVisits, HasNoPicture) {
  const Subject subject = jittered_volumes();
  const auto smoother = make_device_dmo(volume_host(), subject.task(Metric::MeanRatio));
  std::vector<Vec3> positions = subject.input->mesh.positions;
  smoother->visit(0, subject.visits(), positions, nullptr);
  EXPECT_EQ(smoother->picture(Metric::MeanRatio), nullptr);
  EXPECT_TRUE(smoother->statistics().has_value());
}

}  // namespace
}  // namespace dmoscope::gpu
