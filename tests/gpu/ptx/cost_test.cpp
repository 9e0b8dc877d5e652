// What the kernels cost, in instructions of a lane: a change that makes a visit a tenth dearer shall be noticed where no GPU is.

#include <string_view>

#include "gpu/device_dmo.h"
#include "tests/gpu/ptx/ptx_queue.h"
#include "tests/gpu/same_bits.h"
#include "tests/gpu/volumes.h"
#include "tests/smooth/zoo.h"

namespace dmoscope::gpu::ptx {
namespace {

using gpu::testing::Subject;

/// Of PTX of compute_75, made by nvcc 13.0; ptxas makes more or fewer of each, but those of a loop remain those of a loop.
struct Budget {
  const char* what;
  std::size_t lanes_at_once;  // 1: the kernels of a lane a vertex; many: those of a team
  bool volume;
  double instructions;  // a visit, of all its lanes, in the first iteration
};
constexpr Budget kBudgets[] = {
    {"triangles, a lane a vertex", 1, false, 11279},
    {"triangles, a team a vertex", std::size_t{1} << 20U, false, 42612},
    {"tetrahedra", 1, true, 811848},
};

TEST(PtxCost, OfAVisitIsWithinItsBudget) {
#ifndef DMOSCOPE_PTX_DIR
  GTEST_SKIP() << "needs the kernels' PTX; built without a CUDA toolkit";
#else
  const std::string_view made = DMOSCOPE_PTX_OF;
  if (!made.starts_with("compute_75 by nvcc 13.")) GTEST_SKIP() << "the budgets are those of compute_75 by nvcc 13, this is " << made;
  const auto kernels = std::make_shared<Kernels>(DMOSCOPE_PTX_DIR);
  Progress progress;
  const Subject plane(prepare_input(generate_mesh("random", 400, 5, progress), {}, Need::Smoothing, progress));
  const Subject solids(gpu::testing::volume_input_of(generate_mesh("tetrahedra", 200, 5, progress)));
  for (const Budget& budget : kBudgets) {
    SCOPED_TRACE(budget.what);
    const Subject& subject = budget.volume ? solids : plane;
    std::uint64_t executed = 0;
    const auto queue = make_ptx_queue(kernels, {budget.lanes_at_once, {.executed = &executed}});
    const auto smoother = make_device_dmo(queue, subject.input, subject.colouring, Metric::MeanRatio, {}, subject.immovable, nullptr);
    std::vector<Vec3> positions = subject.input->mesh.positions;
    executed = 0;
    smoother->visit(0, subject.visits(), positions, nullptr);
    const double each = static_cast<double>(executed) / static_cast<double>(subject.visits());
    EXPECT_LT(each, 1.1 * budget.instructions) << "dearer";
    EXPECT_GT(each, 0.9 * budget.instructions) << "cheaper: write down the new figure";
    std::printf("%s: %.0f instructions a visit\n", budget.what, each);
  }
#endif
}

}  // namespace
}  // namespace dmoscope::gpu::ptx
