// DMO on a CUDA device compared with the processor's lanes. These tests need a device, and are skipped without one.

#include <cstdlib>

#include "gpu/cuda_queue.h"
#include "gpu/device.h"
#include "gpu/nvrtc.h"
#include "gpu/task.h"
#include "tests/gpu/defined.h"
#include "tests/gpu/meshes.h"
#include "tests/gpu/two_aims.h"
#include "tests/gpu/volumes.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu {
namespace {

using namespace testing;
using dmoscope::testing::defined_for_all;

template <class Tested>
class CudaTestOf : public ::testing::TestWithParam<Tested> {
 protected:
  void SetUp() override {
    const Availability available = availability();
    if (!available.reason.empty()) GTEST_SKIP() << "needs a CUDA device; " << available.reason;
    queue = make_cuda_queue(available.best);
  }
  std::shared_ptr<Queue> queue;
};
using CudaTest = CudaTestOf<Metric>;

class CudaDmo : public CudaTest {
 protected:
  void expect_same(const Subject& subject, const SearchParameters& parameters, int iterations) {
    expect_same_visits(queue, subject, GetParam(), parameters, iterations);
  }
};

TEST_P(CudaDmo, SameBitsOnTheZoo) {
  for (auto& specimen : dmoscope::testing::zoo()) {
    if (!defined_for_all(GetParam(), specimen.mesh)) continue;
    SCOPED_TRACE(specimen.name);
    Progress progress;
    expect_same(Subject(prepare_input(std::move(specimen.mesh), {}, Need::Smoothing, progress)), specimen.search, 4);
  }
}

TEST_P(CudaDmo, SameBitsOnTheBundledMeshes) {
  for (const auto& mesh : bundled_meshes()) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same(Subject(mesh), {}, 5);
  }
}

TEST_P(CudaDmo, SameBitsOnTheSharedMeshes) {
  const auto meshes = shared_meshes();
  if (meshes.empty()) GTEST_SKIP() << "no shared meshes here";
  for (const auto& mesh : meshes) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same(Subject(mesh), {}, 2);
  }
}

/// Classes too large for teams.
TEST_P(CudaDmo, SameBitsOnALargeMesh) {
  for (const auto cells : {dmoscope::testing::Cells::Triangles, dmoscope::testing::Cells::Mixed}) {
    Mesh mesh = dmoscope::testing::lattice(700, 0.35, 81, cells);
    if (!defined_for_all(GetParam(), mesh)) continue;
    Progress progress;
    expect_same(Subject(prepare_input(std::move(mesh), {}, Need::Smoothing, progress)), {}, 2);
  }
}

TEST_P(CudaDmo, SameBitsOfTwoAims) {
  for (auto& specimen : dmoscope::testing::zoo()) {
    if (!defined_for_all(GetParam(), specimen.mesh)) continue;
    SCOPED_TRACE(specimen.name);
    Progress progress;
    const Subject subject(prepare_input(std::move(specimen.mesh), {}, Need::Smoothing, progress));
    expect_same_mean(queue, subject, GetParam(), specimen.search);
    expect_same_combinations(queue, subject, GetParam(), specimen.search);
  }
  for (const auto& mesh : bundled_meshes()) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same_mean(queue, Subject(mesh), GetParam(), {});
    expect_same_combinations(queue, Subject(mesh), GetParam(), {});
  }
}

class CudaVolumeDmo : public CudaTest {};

TEST_P(CudaVolumeDmo, SameBits) {
  for (const Precision precision : {Precision::Float, Precision::Double})
    for (const VolumeSample& sample : volume_samples(512)) {
      if (!defined_for_all(GetParam(), sample.input->mesh)) continue;
      SCOPED_TRACE(sample.name);
      expect_same_visits(queue, Subject(sample.input), GetParam(), {.precision = precision}, 2);
    }
}
TEST_P(CudaVolumeDmo, SameBitsOfTwoAims) {
  for (const VolumeSample& sample : volume_samples(125)) {
    if (!defined_for_all(GetParam(), sample.input->mesh)) continue;
    SCOPED_TRACE(sample.name);
    expect_same_mean(queue, Subject(sample.input), GetParam(), {});
    expect_same_combinations(queue, Subject(sample.input), GetParam(), {});
  }
}
TEST_P(CudaVolumeDmo, SameBitsOnTheSharedMeshes) {
  const auto meshes = shared_volumes(30000);
  if (meshes.empty()) GTEST_SKIP() << "no shared meshes here";
  for (const auto& mesh : meshes) {
    if (!defined_for_all(GetParam(), mesh->mesh)) continue;
    SCOPED_TRACE(mesh->mesh.name);
    expect_same_visits(queue, Subject(mesh), GetParam(), {}, 2);
  }
}
INSTANTIATE_TEST_SUITE_P(CudaMetrics, CudaVolumeDmo, every_volume_metric(), name_of_metric);

INSTANTIATE_TEST_SUITE_P(CudaMetrics, CudaDmo, every_metric(), name_of_metric);

/// Formulas and targets.
class CudaDefinedDmo : public CudaTestOf<std::size_t> {};

TEST_P(CudaDefinedDmo, SameBits) {
  const std::string_view words = kDefinedMetrics[GetParam()];
  SCOPED_TRACE(words);
  for (auto& specimen : defined_specimens()) {
    const auto input = volume_input_of(std::move(specimen.mesh));
    if (!is_for(words, *input)) continue;
    SCOPED_TRACE(specimen.name);
    const Metric metric = parse_metric(words);
    expect_same_visits(queue, Subject(input), metric, {}, 3);
    expect_same_visits(queue, Subject(input), metric, {}, 1, {.untangling = {.repair = true}});
    const auto smoother = make_device_dmo(queue, Subject(input).task(metric));
    if (Nvrtc::find() != nullptr) {
      EXPECT_EQ(smoother->description(), "the metric compiled by " + Nvrtc::find()->description());
    }
  }
}
/// Several stretches, and classes too large for teams.
TEST_P(CudaDefinedDmo, SameBitsOnALargeMesh) {
  const std::string_view words = kDefinedMetrics[GetParam()];
  SCOPED_TRACE(words);
  for (const auto cells : {dmoscope::testing::Cells::Triangles, dmoscope::testing::Cells::Mixed}) {
    const auto input = volume_input_of(with_fields(dmoscope::testing::lattice(600, 0.35, 81, cells)));
    if (is_for(words, *input)) expect_same_visits(queue, Subject(input), parse_metric(words), {}, 1);
  }
}
INSTANTIATE_TEST_SUITE_P(CudaDefined, CudaDefinedDmo, ::testing::Range(std::size_t{0}, std::size(kDefinedMetrics)),
                         [](const ::testing::TestParamInfo<std::size_t>& tested) { return std::to_string(tested.param); });

class CudaQueueTest : public CudaTest {};
INSTANTIATE_TEST_SUITE_P(CudaAny, CudaQueueTest, ::testing::Values(Metric::MeanRatio));

TEST_P(CudaQueueTest, OutOfMemoryIsSaidAndForgotten) {
  try {
    (void)queue->allocate(std::size_t{1} << 50U);
    FAIL() << "no device has a pebibyte";
  } catch (const DeviceError& error) {
    EXPECT_NE(std::string(error.what()).find("out of memory"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("are free"), std::string::npos) << error.what();
  }
  EXPECT_EQ(queue->counters().bytes_allocated, 0U);
  Progress progress;
  const Subject subject(prepare_input(dmoscope::testing::lattice(12, 0.35, 82), {}, Need::Smoothing, progress));
  expect_same_visits(queue, subject, Metric::MeanRatio, {}, 2);
}

TEST_P(CudaQueueTest, GivesItsMemoryBack) {
  Progress progress;
  const Subject subject(prepare_input(dmoscope::testing::lattice(12, 0.35, 83), {}, Need::Smoothing, progress));
  {
    const auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
    std::vector<Vec3> positions = subject.input->mesh.positions;
    smoother->visit(0, subject.visits(), positions, nullptr);
    EXPECT_NE(smoother->picture(Metric::MeanRatio), nullptr);
    EXPECT_GT(queue->counters().bytes_allocated, 0U);
  }
  EXPECT_EQ(queue->counters().bytes_allocated, 0U);
}

/// In a process of its own, since a device that a kernel's fault took away is lost to the whole process.
TEST_P(CudaQueueTest, ALostDeviceIsSaidAndTheHostsPositionsStay) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto lose_it = [&] {
    Progress progress;
    const Subject subject(prepare_input(dmoscope::testing::lattice(12, 0.35, 84), {}, Need::Smoothing, progress));
    const auto smoother = make_device_dmo(queue, subject.task(Metric::MeanRatio));
    std::vector<Vec3> positions = subject.input->mesh.positions;
    smoother->visit(0, subject.visits(), positions, nullptr);
    smoother->store(positions, nullptr);
    const std::vector<Vec3> good = positions;
    Task nowhere;  // its pointers are null
    try {
      queue->launch(Work::Load, Metric::MeanRatio, nowhere, 1);
      queue->wait();
    } catch (const DeviceError& error) {
      try {
        smoother->visit(0, subject.visits(), positions, nullptr);
      } catch (const DeviceError& again) {
        const bool kept = std::ranges::equal(good, positions, [](Vec3 a, Vec3 b) { return same(a, b); });
        std::exit(kept && std::string(error.what()).find("illegal") != std::string::npos ? 0 : 1);
      }
    }
    std::exit(2);
  };
  EXPECT_EXIT(lose_it(), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace dmoscope::gpu
