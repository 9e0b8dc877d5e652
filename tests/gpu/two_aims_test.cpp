// Two aims on a device, with the host in the device's place: the processor's bits.

#include "tests/gpu/two_aims.h"

#include "core/run/run.h"
#include "core/smooth/visit/star_judge.h"
#include "gpu/composite_bodies.h"
#include "gpu/host_queue.h"
#include "tests/gpu/meshes.h"
#include "tests/gpu/volumes.h"
#include "tests/support/sanitized.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;
using dmoscope::testing::defined_for_all;
using dmoscope::testing::kSanitized;

class DeviceTwoAims : public ::testing::TestWithParam<Metric> {
 protected:
  template <class Expect>
  void on_the_zoo(const Expect& expect) {
    std::size_t turn = 0;
    for (auto& specimen : dmoscope::testing::zoo()) {
      if (!defined_for_all(GetParam(), specimen.mesh) || (kSanitized && ++turn % 4 != 0)) continue;
      SCOPED_TRACE(specimen.name);
      Progress progress;
      expect(Subject(prepare_input(std::move(specimen.mesh), {}, Need::Smoothing, progress)), specimen.search);
    }
  }
};

TEST_P(DeviceTwoAims, TheMeanHasTheSameBitsOnTheZoo) {
  on_the_zoo(
      [](const Subject& subject, const SearchParameters& search) { expect_same_mean(make_host_queue({}), subject, GetParam(), search); });
}
TEST_P(DeviceTwoAims, CombinationsHaveTheSameBitsOnTheZoo) {
  std::size_t turn = 0;
  on_the_zoo([&turn](const Subject& subject, const SearchParameters& search) {
    expect_same_combinations(make_host_queue({}), subject, GetParam(), search, 4, turn++);
  });
}
TEST_P(DeviceTwoAims, CombinationsHaveTheSameBitsOnTheBundledMeshes) {
  for (const auto& mesh : bundled_meshes()) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same_mean(make_host_queue({}), Subject(mesh), GetParam(), {});
    expect_same_combinations(make_host_queue({}), Subject(mesh), GetParam(), {}, 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, DeviceTwoAims, every_metric(), name_of_metric);

class VolumeDeviceTwoAims : public ::testing::TestWithParam<Metric> {};

TEST_P(VolumeDeviceTwoAims, HaveTheSameBits) {
  std::size_t turn = 0;
  for (const VolumeSample& sample : volume_samples(64)) {
    ++turn;
    if (!defined_for_all(GetParam(), sample.input->mesh) || (kSanitized && turn % 3 != 0)) continue;
    SCOPED_TRACE(sample.name);
    expect_same_mean(make_host_queue({}), Subject(sample.input), GetParam(), {.levels = 2});
    expect_same_combinations(make_host_queue({}), Subject(sample.input), GetParam(), {.grid_points = 6, .levels = 2}, 2, turn);
  }
}

INSTANTIATE_TEST_SUITE_P(Metrics, VolumeDeviceTwoAims, every_volume_metric(), name_of_metric);

/// The order of a mean over a star's elements is that of StarView, whatever the mesh's order. Bits of positions hardly ever show it.
TEST(DeviceTwoAimsScore, SumsAsTheProcessorDoes) {
  const auto input = dmoscope::testing::input(dmoscope::testing::lattice(12, 0.4, 53, dmoscope::testing::Cells::Mixed));
  const PositionView positions(input->mesh.positions);
  std::size_t otherwise = 0;
  for (Index vertex = 0; vertex < input->mesh.vertex_count(); ++vertex) {
    if (input->topology.star(vertex).empty()) continue;
    Star<double> expected;
    gather_star(MeshStar<Plane>(input->planar_view(), positions, vertex), expected);
    const ListedStar<Plane> star(input->planar_view(), positions, vertex);
    const PlainComposite aims{.threshold = 0.1};
    const bodies::CompositeLaneScore<Metric::MeanRatio, Plane> score(aims, star, {}, {});
    const Vec2<double> place{0.01, -0.02};
    const double least = metric_functions<Plane>(Metric::MeanRatio).least_at(expected, place, -1.0);
    if (score.tangled() || !aims.beyond(least)) continue;
    const double mean = metric_functions<Plane>(Metric::MeanRatio).mean_at(expected, place, MeanKind::Harmonic);
    EXPECT_TRUE(same(score(place), 0.1 + mean)) << vertex;
    if (!same(mean_of<Metric::MeanRatio>(star.star(), place, MeanKind::Harmonic), mean)) ++otherwise;
  }
  EXPECT_GT(otherwise, 0U) << "the order matters";
}

/// A floor that starts during a run, and a lower one, wake the vertices that slept by the one before.
TEST(DeviceTwoAimsVisits, ThreadsCutsAndRecordingsChangeNothing) {
  Progress progress;
  const Subject subject(prepare_input(dmoscope::testing::lattice(24, 0.35, 52), {}, Need::Smoothing, progress));
  ThreadPool pool(4);
  SmoothingTask task = subject.task(Metric::MeanRatio);
  task.then_mean = true;
  const auto whole = make_device_dmo(make_host_queue({}), task), cut = make_device_dmo(make_host_queue({.pool = &pool}), task);
  expect_cuts_change_nothing(*whole, *cut, subject, 97, std::vector<Sweep>{{}, {.floor = 0.3}, {.floor = 0.3}, {.floor = 0.2}, {}});
}

}  // namespace
}  // namespace dmoscope::gpu
