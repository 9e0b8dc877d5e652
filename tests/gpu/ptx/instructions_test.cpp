// Cost of a visit, in instructions: the one figure of speed that needs no GPU. The same code and the same nvcc give the same number, to the
// last instruction.

#include <map>
#include <string_view>

#include "core/mesh/generate.h"
#include "tests/gpu/ptx/ptx_queue.h"
#include "tests/gpu/same_bits.h"
#include "tests/support/meshes.h"

namespace dmoscope::gpu::ptx {
namespace {

using gpu::testing::Subject;

/// Instructions of all lanes for each vertex of a first iteration, by nvcc 13.0: its code generators up to 90 and from 100 on. Put new
/// numbers here when a change lowers them.
struct Budget {
  Work work;
  double older, newer;
};
constexpr Budget kFans{Work::VisitSmallFans, 8551, 8064}, kTeam{Work::VisitInTeam, 32089, 31380},
    kVolume{Work::VisitVolume, 811964, 823353};

class PtxInstructions : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kernels_folder().empty()) GTEST_SKIP() << "needs the kernels' PTX; built without a CUDA toolkit";
#ifdef DMOSCOPE_NVCC
    if (!std::string_view(DMOSCOPE_NVCC).starts_with("13.")) GTEST_SKIP() << "the budgets are those of nvcc 13, this is " << DMOSCOPE_NVCC;
#endif
    kernels = std::make_shared<Kernels>(kernels_folder());
  }
  /// Does one iteration of the mean ratio. Fails if a visit takes more than a tenth over the budget.
  void expect_within(const Budget& budget, std::size_t lanes_at_once, Mesh mesh) const {
    Progress progress;
    const Subject subject(prepare_input(std::move(mesh), {}, Need::Smoothing, progress));
    std::map<Work, std::uint64_t> instructions;
    const auto queue = make_ptx_queue(kernels, {.lanes_at_once = lanes_at_once, .instructions = &instructions});
    const auto device = make_device_dmo(queue, subject.task(Metric::MeanRatio));
    device->begin({});
    instructions.clear();  // earlier launches visit no vertex
    std::vector<Vec3> positions = subject.input->mesh.positions;
    EXPECT_GT(device->visit(0, subject.visits(), positions, nullptr), subject.visits() / 2);
    const double found = static_cast<double>(instructions.at(budget.work)) / static_cast<double>(subject.visits());
    const bool is_newer = std::stoi(kernels_folder().filename().string()) >= 100;
    const double most = 1.1 * (is_newer ? budget.newer : budget.older);
    EXPECT_LE(found, most) << "instructions a visit, PTX of compute_" << kernels_folder().filename().string() << ", " << subject.visits()
                           << " visits";
    EXPECT_GT(found, 0.5 * most) << "instructions a visit: so few are a new budget, or a mistake of the count";
  }
  std::shared_ptr<Kernels> kernels;
};

/// A lattice with all diagonals the same way, so that six triangles meet in every vertex.
Mesh sixes(Index n) {
  using dmoscope::testing::add, dmoscope::testing::Random;
  Mesh mesh;
  mesh.name = "sixes";
  Random random(12);
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double dx = inside ? random(-0.3, 0.3) : 0.0, dy = inside ? random(-0.3, 0.3) : 0.0;
      mesh.positions.push_back({i + dx, j + dy, 0.0});
    }
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) {
      const Index a = j * (n + 1) + i, b = a + 1, d = a + n + 1, c = d + 1;
      add(mesh, {a, b, c});
      add(mesh, {a, c, d});
    }
  return mesh;
}

TEST_F(PtxInstructions, OfAVisitByALane) { expect_within(kFans, 1, sixes(24)); }
TEST_F(PtxInstructions, OfAVisitByATeam) { expect_within(kTeam, 1U << 20U, sixes(24)); }
TEST_F(PtxInstructions, OfAVisitInAVolume) {
  Progress progress;
  expect_within(kVolume, 1U << 20U, generate_mesh("tetrahedra", 100, 5, progress));
}

}  // namespace
}  // namespace dmoscope::gpu::ptx
