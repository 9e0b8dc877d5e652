// DMO on a device, with the host in the device's place: the bits of the processor's own lanes.

#include "gpu/bodies.h"
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
  }
}

TEST_P(DeviceDmo, SameBitsInRepairs) {
  for (auto& specimen : dmoscope::testing::zoo()) {
    if (!defined_for_all(GetParam(), specimen.mesh)) continue;
    SCOPED_TRACE(specimen.name);
    Progress progress;
    const Subject subject(prepare_input(std::move(specimen.mesh), {}, Need::Smoothing, progress));
    expect_same_visits(host(), subject, GetParam(), specimen.search, 1, {.untangling = {.repair = true}});
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
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, DeviceDmo, every_metric(), name_of_metric);

Subject jittered(Index size, double jitter = 0.35, std::uint64_t seed = 51) {
  Progress progress;
  return Subject(prepare_input(dmoscope::testing::lattice(size, jitter, seed), {}, Need::Smoothing, progress));
}

/// All elements are alike, so that the worst is the first in every part and in their total.
TEST(DeviceDmoStatistics, TheFirstOfTheWorstIsTheWorst) { expect_same_visits(host(), jittered(40, 0.0), Metric::MeanRatio, {}, 1); }

/// A visit that was left to be judged exactly moves its vertex only if that gains.
TEST(DeviceDmoVisits, AnExactVisitRefusesWhatDoesNotGain) {
  const Subject subject = jittered(6);
  const StarTable table = build_star_table(subject.input->mesh, subject.input->topology, *subject.colouring, nullptr);
  std::vector<Vec3> ranked;
  for (const Index v : table.vertex_of_rank) ranked.push_back(subject.input->mesh.positions[v]);
  std::vector<std::uint8_t> awake(ranked.size(), 1);
  std::uint32_t moved = 0;
  Task task;
  task.shapes = table.shapes.data();
  task.others = table.others.data();
  task.mesh = subject.input->planar_view();
  task.rank_of_vertex = table.rank_of_vertex.data();
  task.vertex_of_rank = table.vertex_of_rank.data();
  task.ranked = ranked.data();
  task.awake = awake.data();
  task.moved = &moved;
  const Vec3 before = ranked[0], corner = ranked[table.others[table.shapes[0].first]];
  const Vec3 worse = before + 0.99 * (corner - before);
  ASSERT_FALSE(gains_at<Metric::MeanRatio>(task.mesh, positions_of(task), task.vertex_of_rank[0], worse, {}));
  bodies::ExactVisit<Metric::MeanRatio>::run(task, {0, true, {worse.x, worse.y, worse.z}}, Solo{});
  EXPECT_TRUE(same(ranked[0], before));
  EXPECT_EQ(moved, 0U);
  EXPECT_EQ(awake[0], 0) << "it was found at its best";
  bodies::ExactVisit<Metric::MeanRatio>::run(task, {0, false, {}}, Solo{});
  EXPECT_FALSE(same(ranked[0], before)) << "searched anew it gains";
  EXPECT_EQ(moved, 1U);
}

/// Neither the number of lanes nor the division of an iteration into calls matters.
TEST(DeviceDmoVisits, NeitherThreadsNorCutsChangeTheResult) {
  const Subject subject = jittered(30);
  ThreadPool pool(4);
  const auto whole = make_device_dmo(host(), subject.task(Metric::MeanRatio));
  const auto cut = make_device_dmo(host({.pool = &pool}), subject.task(Metric::MeanRatio, {}, &pool));
  expect_cuts_change_nothing(*whole, *cut, subject, 97, std::vector<Sweep>(3));
}

TEST(DeviceDmoVisits, ReplacedPositionsAreTakenUp) {
  const Subject subject = jittered(12);
  const auto smoother = make_device_dmo(host(), subject.task(Metric::MeanRatio));
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

/// More elements than one group of stretches (see TallyTotal).
TEST(DeviceDmoVisits, AddsUpTheMeanOfManyElementsAsTheHostDoes) {
  const Subject subject = jittered(760);
  ASSERT_GT(subject.input->mesh.elements.size(), Index{1} << 20U);
  const auto smoother = make_device_dmo(host(), subject.task(Metric::MeanRatio));
  std::vector<Vec3> positions = subject.input->mesh.positions;
  smoother->visit(0, 1, positions, nullptr);
  const Statistics found = *smoother->statistics();
  smoother->store(positions, nullptr);
  const Statistics want =
      compute_statistics(subject.input->quality_context(), positions, Metric::MeanRatio, std::span<const Index>(), nullptr);
  EXPECT_TRUE(same(found.mean, want.mean)) << found.mean << " and " << want.mean;
  EXPECT_EQ(found.minimum, want.minimum);
}

/// Positions cross to the host when they are asked for, and not before.
TEST(DeviceDmoVisits, PositionsStayOnTheDevice) {
  const Subject subject = jittered(12);
  const auto queue = host();
  const auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
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
    (void)make_device_dmo(queue, subject.task(Metric::MeanRatio));
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
    const auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
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
  const auto smoother = make_device_dmo(host(), subject.task(Metric::MeanRatio));
  std::vector<Vec3> positions = subject.input->mesh.positions;
  EXPECT_EQ(smoother->visit(0, 0, positions, nullptr), 0U);
  ASSERT_TRUE(smoother->statistics().has_value());
  EXPECT_EQ(smoother->statistics()->movable_minimum, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace dmoscope::gpu
