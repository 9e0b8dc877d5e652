// The smoother on what nvcc made of the kernels: the processor's bits, although no GPU is at hand.

#include "core/session/frame_builder.h"
#include "tests/gpu/ptx/ptx_queue.h"
#include "tests/gpu/same_bits.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::ptx {
namespace {

using namespace gpu::testing;
using dmoscope::testing::Cells;
using dmoscope::testing::defined_for_all;
using dmoscope::testing::lattice;
using dmoscope::testing::Specimen;

/// The processor's and the device's functions of angles differ in the last bits; the others are IEEE 754's.
bool is_algebraic(Metric metric) { return metric != Metric::MinAngle && metric != Metric::MaxAngle && metric != Metric::Rectangularity; }

class PtxTest : public ::testing::TestWithParam<Metric> {
 protected:
  void SetUp() override {
#ifdef DMOSCOPE_PTX_DIR
    kernels = std::make_shared<Kernels>(DMOSCOPE_PTX_DIR);
#else
    GTEST_SKIP() << "needs the kernels' PTX; built without a CUDA toolkit";
#endif
  }
  /// Some lanes alone, some in teams; some forwards, some backwards.
  [[nodiscard]] std::shared_ptr<Queue> teams(Schedule schedule = {}) const { return make_ptx_queue(kernels, {1U << 20U, schedule}); }
  [[nodiscard]] std::shared_ptr<Queue> singles(Schedule schedule = {}) const { return make_ptx_queue(kernels, {1, schedule}); }

  std::shared_ptr<Kernels> kernels;
};

Subject subject_of(Mesh mesh) {
  Progress progress;
  return Subject(prepare_input(std::move(mesh), {}, Need::Smoothing, progress));
}

class PtxDmo : public PtxTest {
 protected:
  void expect_same(const std::shared_ptr<Queue>& queue, Specimen specimen, int iterations) {
    const Metric metric = GetParam();
    if (!defined_for_all(metric, specimen.mesh)) return;
    SCOPED_TRACE(specimen.name);
    const Subject subject = subject_of(std::move(specimen.mesh));
    const bool exact = is_algebraic(metric);
    // Two candidates of the same quality but for the last bits are both right: after one iteration they may still be told apart.
    expect_same_visits(queue, subject, metric, specimen.search, exact ? iterations : 1, nullptr, exact ? 0.0 : 1e-6);
    expect_same_statistics(queue, subject, metric, exact);
  }
};

TEST_P(PtxDmo, SameBitsInTeams) {
  for (Specimen& specimen : dmoscope::testing::zoo()) expect_same(teams(), std::move(specimen), 2);
}
TEST_P(PtxDmo, SameBitsAlone) {
  for (Specimen& specimen : dmoscope::testing::zoo()) expect_same(singles({.together = true, .backwards = true}), std::move(specimen), 2);
}

INSTANTIATE_TEST_SUITE_P(Metrics, PtxDmo, ::testing::ValuesIn([] {
                           std::vector<Metric> all;
                           for (const MetricInfo& entry : metric_table()) all.push_back(entry.metric);
                           return all;
                         }()),
                         [](const auto& tested) {
                           std::string name(dmoscope::info(tested.param).name);
                           std::erase(name, '-');
                           return name;
                         });

}  // namespace
}  // namespace dmoscope::gpu::ptx
