// DMO on a device, with the host in the device's place: the very bits of the processor's own lanes.

#include "gpu/host_queue.h"
#include "tests/gpu/meshes.h"
#include "tests/gpu/same_bits.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;
using dmoscope::testing::defined_for_all;

std::shared_ptr<HostQueue> host(const HostDevice& device = {}) { return make_host_queue(device); }

class DeviceDmo : public ::testing::TestWithParam<Metric> {};

TEST_P(DeviceDmo, SameBitsOnTheZoo) {
  for (auto& specimen : dmoscope::testing::zoo()) {
    if (!defined_for_all(GetParam(), specimen.mesh)) continue;
    SCOPED_TRACE(specimen.name);
    Progress progress;
    const Subject subject(prepare_input(std::move(specimen.mesh), {}, Need::Smoothing, progress));
    expect_same_visits(host(), subject, GetParam(), specimen.search, 4);
    expect_same_statistics(host(), subject, GetParam());
  }
}

TEST_P(DeviceDmo, SameBitsOnTheBundledMeshes) {
  const auto meshes = bundled_meshes();
  ASSERT_FALSE(meshes.empty());
  for (const auto& mesh : meshes) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same_visits(host(), Subject(mesh), GetParam(), {}, 3);
  }
}

TEST_P(DeviceDmo, SameBitsOnTheSharedMeshes) {
  const auto meshes = shared_meshes();
  if (meshes.empty()) GTEST_SKIP() << "no shared meshes here";
  for (const auto& mesh : meshes) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same_visits(host(), Subject(mesh), GetParam(), {}, 1);
    expect_same_statistics(host(), Subject(mesh), GetParam());
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, DeviceDmo, every_metric(), name_of_metric);

Subject jittered(Index size, double jitter = 0.35, std::uint64_t seed = 51) {
  Progress progress;
  return Subject(prepare_input(dmoscope::testing::lattice(size, jitter, seed), {}, Need::Smoothing, progress));
}

/// However many lanes work at once, and however an iteration is cut into calls.
TEST(DeviceDmoVisits, NeitherThreadsNorCutsChangeTheResult) {
  const Subject subject = jittered(30);
  ThreadPool pool(4);
  const auto whole = make_device_dmo(host(), subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
  const auto cut =
      make_device_dmo(host({.pool = &pool}), subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, &pool);
  std::vector<Vec3> one = subject.input->mesh.positions, other = one;
  for (int iteration = 0; iteration < 3; ++iteration) {
    const std::uint64_t moved = whole->visit(0, subject.visits(), one, nullptr);
    std::uint64_t in_parts = 0;
    for (std::uint64_t first = 0; first < subject.visits(); first += 97)
      in_parts += cut->visit(first, std::min<std::uint64_t>(97, subject.visits() - first), other, nullptr);
    EXPECT_EQ(moved, in_parts);
    EXPECT_GT(moved, 0U);
  }
  whole->store(one, nullptr);
  cut->store(other, nullptr);
  for (Index v = 0; v < one.size(); ++v) ASSERT_TRUE(same(one[v], other[v])) << v;
}

TEST(DeviceDmoVisits, ReplacedPositionsAreTakenUp) {
  const Subject subject = jittered(12);
  const auto smoother = make_device_dmo(host(), subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
  std::vector<Vec3> positions = subject.input->mesh.positions;
  smoother->visit(0, subject.visits(), positions, nullptr);
  smoother->store(positions, nullptr);
  const std::vector<Vec3> once = positions;
  positions = subject.input->mesh.positions;
  smoother->positions_replaced();
  EXPECT_FALSE(smoother->statistics().has_value());
  smoother->store(positions, nullptr);
  for (Index v = 0; v < once.size(); ++v) ASSERT_TRUE(same(positions[v], subject.input->mesh.positions[v])) << "nothing was visited since";
  smoother->visit(0, subject.visits(), positions, nullptr);
  smoother->store(positions, nullptr);
  for (Index v = 0; v < once.size(); ++v) ASSERT_TRUE(same(positions[v], once[v])) << v;
}

/// Positions cross to the host when they are asked for, and not before.
TEST(DeviceDmoVisits, PositionsStayOnTheDevice) {
  const Subject subject = jittered(12);
  const auto queue = host();
  const auto smoother = make_device_dmo(queue, subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
  std::vector<Vec3> positions = subject.input->mesh.positions;
  for (int i = 0; i < 5; ++i) {
    smoother->visit(0, subject.visits(), positions, nullptr);
    ASSERT_TRUE(smoother->statistics().has_value());
  }
  const std::uint64_t before = queue->counters().bytes_to_host;
  EXPECT_EQ(before, 0U);
  smoother->store(positions, nullptr);
  EXPECT_EQ(queue->counters().bytes_to_host - before, positions.size() * sizeof(Vec3));
  smoother->store(positions, nullptr);
  EXPECT_EQ(queue->counters().bytes_to_host - before, positions.size() * sizeof(Vec3)) << "they are up to date";
}

TEST(DeviceDmoErrors, OutOfMemoryNamesTheSizesAndLeavesNothingBehind) {
  const Subject subject = jittered(20);
  const auto queue = host({.memory = 30000});
  try {
    (void)make_device_dmo(queue, subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
    FAIL() << "it cannot fit";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("out of memory"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("bytes were asked for"), std::string::npos) << error.what();
  }
  EXPECT_EQ(queue->counters().bytes_allocated, 0U);
}

TEST(DeviceDmoErrors, ALostDeviceLeavesTheHostsPositions) {
  const Subject subject = jittered(20);
  const auto queue = host();
  {
    const auto smoother = make_device_dmo(queue, subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
    std::vector<Vec3> positions = subject.input->mesh.positions;
    smoother->visit(0, subject.visits(), positions, nullptr);
    smoother->store(positions, nullptr);
    const std::vector<Vec3> good = positions;
    queue->lose_after(3);
    EXPECT_THROW(smoother->visit(0, subject.visits(), positions, nullptr), DeviceError);
    EXPECT_THROW(smoother->visit(0, subject.visits(), positions, nullptr), DeviceError) << "lost is lost";
    for (Index v = 0; v < good.size(); ++v) ASSERT_TRUE(same(positions[v], good[v])) << v;
  }
  EXPECT_EQ(queue->counters().bytes_allocated, 0U) << "its memory is given back all the same";
}

TEST(DeviceDmoVisits, AMeshWithoutFreeVertices) {
  Progress progress;
  const Subject subject(prepare_input(dmoscope::testing::lattice(1, 0.0, 1), {}, Need::Smoothing, progress));
  ASSERT_EQ(subject.visits(), 0U);
  const auto smoother = make_device_dmo(host(), subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
  std::vector<Vec3> positions = subject.input->mesh.positions;
  EXPECT_EQ(smoother->visit(0, 0, positions, nullptr), 0U);
  ASSERT_TRUE(smoother->statistics().has_value());
  EXPECT_EQ(smoother->statistics()->movable_minimum, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace dmoscope::gpu
