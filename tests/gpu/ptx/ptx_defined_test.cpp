// Formulas and targets on nvcc's code of the kernels that run programs step by step, and on NVRTC's code of the programs.

#include "gpu/defined/formula_source.h"
#include "gpu/nvrtc.h"
#include "tests/gpu/defined.h"
#include "tests/gpu/ptx/ptx_queue.h"

namespace dmoscope::gpu::ptx {
namespace {

using namespace gpu::testing;

class PtxDefinedDmo : public ::testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    if (kernels_folder().empty()) GTEST_SKIP() << "needs the kernels' PTX; built without a CUDA toolkit";
    kernels = std::make_shared<Kernels>(kernels_folder());
  }
  /// Compares on some of the meshes, with other metrics on each.
  void expect_same(const PtxDevice& device, int iterations) {
    const std::string_view words = kDefinedMetrics[GetParam()];
    std::size_t turn = 0, tried = 0;
    for (auto& specimen : defined_specimens()) {
      if (++turn % 4 != GetParam() % 4) continue;
      const auto input = volume_input_of(std::move(specimen.mesh));
      if (!is_for(words, *input)) continue;
      SCOPED_TRACE(specimen.name);
      SCOPED_TRACE(words);
      const SearchParameters parameters = input->is_volume() ? SearchParameters{.grid_points = 4} : SearchParameters{};
      expect_same_visits(make_ptx_queue(kernels, device), Subject(input), parse_metric(words), parameters, iterations);
      ++tried;
    }
    EXPECT_GT(tried, 0U);
  }
  std::shared_ptr<Kernels> kernels;
};

TEST_P(PtxDefinedDmo, SameBitsStepByStep) { expect_same({}, 1); }

TEST_P(PtxDefinedDmo, SameBitsCompiled) {
  if (Nvrtc::find() == nullptr) GTEST_SKIP() << "needs NVRTC, which is part of CUDA's toolkit";
  Races races;
  expect_same({.schedule = {.together = true, .backwards = true, .races = &races}, .compiles = true}, 2);
}

INSTANTIATE_TEST_SUITE_P(Metrics, PtxDefinedDmo, ::testing::Range(std::size_t{0}, std::size(kDefinedMetrics)),
                         [](const ::testing::TestParamInfo<std::size_t>& tested) { return std::to_string(tested.param); });

}  // namespace
}  // namespace dmoscope::gpu::ptx
