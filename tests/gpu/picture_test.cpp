// Snapshots of a run on a device, with the host in the device's place.

#include <algorithm>
#include <thread>

#include "core/run/device_picture.h"
#include "core/view/frame_builder.h"
#include "gpu/host_queue.h"
#include "tests/gpu/same_bits.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;

struct Stepped {
  Subject subject;
  std::shared_ptr<HostQueue> queue = make_host_queue({});
  std::unique_ptr<Smoother> smoother;
  std::vector<Vec3> positions;

  explicit Stepped(Mesh mesh) : subject(prepare(std::move(mesh))), positions(subject.input->mesh.positions) {
    smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
    step();
  }
  static std::shared_ptr<const InputMesh> prepare(Mesh mesh) {
    Progress progress;
    return prepare_input(std::move(mesh), {}, Need::Smoothing, progress);
  }
  void step() { smoother->visit(0, subject.visits(), positions, nullptr); }
  /// The run's positions, read through the host.
  const std::vector<Vec3>& stored() {
    smoother->store(positions, nullptr);
    return positions;
  }
};

using dmoscope::testing::Cells;

TEST(DevicePicture, ShowsTheMoment) {
  for (const Metric shown : {Metric::MeanRatio, Metric::ScaledJacobian, Metric::MinAngle}) {
    Stepped run(dmoscope::testing::lattice(12, 0.9, 71, Cells::Mixed));  // with inverted elements, and of two kinds
    const auto picture = run.smoother->picture(shown);
    ASSERT_NE(picture, nullptr);
    const InputMesh& input = *run.subject.input;
    const std::vector<Vec3>& positions = run.stored();
    const Vec2<double> origin{3.25, -1.5};
    std::vector<Vec2<float>> points(positions.size());
    std::vector<float> shades(input.mesh.elements.size());
    picture->download(points, shades, origin);
    for (Index v = 0; v < positions.size(); ++v) {
      ASSERT_EQ(points[v].x, static_cast<float>(positions[v].x - origin.x));
      ASSERT_EQ(points[v].y, static_cast<float>(positions[v].y - origin.y));
    }
    std::vector<double> qualities;
    for (Index e = 0; e < shades.size(); ++e) {
      const double q = element_quality(input.quality_context(), positions, shown, e);
      const bool inverted = smallest_jacobian(input.quality_context(), positions, e) <= 0.0;
      ASSERT_EQ(shades[e], shade_of(static_cast<float>(q), inverted)) << e;
      qualities.push_back(q);
    }
    const Histogram expected = make_histogram(qualities);
    EXPECT_EQ(picture->summary().histogram.counts, expected.counts);
    EXPECT_EQ(picture->summary().histogram.below, expected.below);
    EXPECT_EQ(picture->summary().histogram.above, expected.above);
    const Statistics statistics = compute_statistics(input.quality_context(), positions, shown, run.subject.immovable, nullptr);
    EXPECT_TRUE(same(picture->summary().statistics.mean, statistics.mean));
    EXPECT_GT(statistics.inverted, 0U);
    EXPECT_EQ(picture->summary().statistics.inverted, statistics.inverted);
    const auto worst = worst_elements(qualities, 1);
    ASSERT_EQ(picture->summary().worst.size(), 1U);
    EXPECT_EQ(picture->summary().worst[0].element, worst[0].element);
    const std::vector<Index> wanted{7, 0, static_cast<Index>(positions.size() - 1), 7};
    const auto some = picture->positions(wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_TRUE(same(some[i], positions[wanted[i]]));
  }
}

/// A picture stays the same while the run goes on, and when the run is gone; its memory is used again afterwards.
TEST(DevicePicture, IsASnapshot) {
  Stepped run(dmoscope::testing::lattice(12, 0.35, 72));
  auto picture = run.smoother->picture(Metric::MeanRatio);
  const std::vector<Vec3> then = run.stored();
  run.step();
  run.step();
  const auto later = run.smoother->picture(Metric::MeanRatio);
  EXPECT_GE(later->summary().statistics.minimum, picture->summary().statistics.minimum);
  const auto statistics = run.smoother->statistics();  // not the values of the picture's metric
  EXPECT_TRUE(same(statistics->mean, later->summary().statistics.mean));
  run.smoother.reset();
  std::vector<Index> all(then.size());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  const auto kept = picture->positions(all);
  for (Index v = 0; v < then.size(); ++v) ASSERT_TRUE(same(kept[v], then[v])) << v;
}

TEST(DevicePicture, AnotherMetricDoesNotSpoilTheStatistics) {
  Stepped run(dmoscope::testing::lattice(12, 0.35, 73));
  const Statistics before = *run.smoother->statistics();
  (void)run.smoother->picture(Metric::MinAngle);
  const Statistics after = *run.smoother->statistics();
  EXPECT_TRUE(same(before.mean, after.mean));
  EXPECT_TRUE(same(before.minimum, after.minimum));
}

TEST(DevicePicture, MemoryIsUsedAgain) {
  Stepped run(dmoscope::testing::lattice(12, 0.35, 74));
  (void)run.smoother->picture(Metric::MeanRatio);
  const std::uint64_t bytes = run.queue->counters().bytes_allocated;
  for (int i = 0; i < 20; ++i) {
    run.step();
    (void)run.smoother->picture(Metric::MeanRatio);
  }
  EXPECT_EQ(run.queue->counters().bytes_allocated, bytes);
}

TEST(DevicePicture, NothingWasVisitedNothingIsShown) {
  Stepped run(dmoscope::testing::lattice(12, 0.35, 75));
  run.smoother->positions_replaced();
  EXPECT_EQ(run.smoother->picture(Metric::MeanRatio), nullptr);
}

/// A lost device causes an error, and its objects can be destroyed.
TEST(DevicePicture, ALostDevice) {
  Stepped run(dmoscope::testing::lattice(12, 0.35, 76));
  const auto picture = run.smoother->picture(Metric::MeanRatio);
  run.queue->lose_after(0);
  std::vector<Vec2<float>> points(run.positions.size());
  std::vector<float> shades(run.subject.input->mesh.elements.size());
  EXPECT_THROW(picture->download(points, shades, {}), DeviceError);
  EXPECT_THROW((void)run.smoother->picture(Metric::MeanRatio), DeviceError);
}

}  // namespace
}  // namespace dmoscope::gpu
