// How an iteration is cut into calls of visit() changes nothing.

#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/colouring.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/smoother.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

constexpr int kIterations = 3;

class Visit : public ::testing::TestWithParam<Precision> {
 protected:
  Visit() {
    std::vector<Index> free;
    for (Index v = 0; v < input_->mesh.vertex_count(); ++v)
      if (input_->topology.boundary()[v] == 0) free.push_back(v);
    colouring_ = std::make_shared<const Colouring>(colour_vertices(input_->mesh, input_->topology, free));
  }

  /// Positions after some iterations, each cut after the visits of `cuts`, which ends with the number of all.
  [[nodiscard]] std::vector<Vec3> smoothed(const std::vector<std::uint64_t>& cuts, ThreadPool* pool, std::uint64_t& moved) const {
    const auto smoother = make_smoother({.input = input_, .colouring = colouring_, .search = {.precision = GetParam()}, .pool = pool});
    std::vector<Vec3> positions = input_->mesh.positions;
    moved = 0;
    for (int i = 0; i < kIterations; ++i) {
      std::uint64_t first = 0;
      for (const std::uint64_t cut : cuts) {
        moved += smoother->visit(first, cut - first, positions, pool);
        first = cut;
      }
    }
    smoother->store(positions, pool);
    return positions;
  }

  std::shared_ptr<const InputMesh> input_ = testing::input(testing::lattice(40, 0.4, 5, testing::Cells::Mixed));
  std::shared_ptr<const Colouring> colouring_;
};

TEST_P(Visit, AnyStretchGivesWhatTheClassesGive) {
  const std::uint64_t all = colouring_->order.size();
  ASSERT_GT(colouring_->class_count(), 3U);
  const std::vector<std::uint64_t> classes(colouring_->class_offsets.begin() + 1, colouring_->class_offsets.end());
  std::uint64_t expected_moved = 0;
  const std::vector<Vec3> expected = smoothed(classes, nullptr, expected_moved);
  EXPECT_GT(expected_moved, all);

  std::vector<std::uint64_t> sevens;
  for (std::uint64_t cut = 7; cut < all; cut += 7) sevens.push_back(cut);
  sevens.push_back(all);
  const std::vector<std::uint64_t> whole{all}, odd{classes[0] - 1, classes[2] + 1, all};
  ThreadPool two(2);
  for (ThreadPool* pool : {static_cast<ThreadPool*>(nullptr), &two})
    for (const auto& cuts : {whole, odd, sevens, classes}) {
      std::uint64_t moved = 0;
      const std::vector<Vec3> found = smoothed(cuts, pool, moved);
      EXPECT_EQ(std::memcmp(found.data(), expected.data(), found.size() * sizeof(Vec3)), 0) << cuts.size() << " calls";
      EXPECT_EQ(moved, expected_moved) << cuts.size() << " calls";
    }
}

INSTANTIATE_TEST_SUITE_P(Precisions, Visit, ::testing::Values(Precision::Float, Precision::Double),
                         [](const auto& p) { return p.param == Precision::Float ? "Float" : "Double"; });

}  // namespace
}  // namespace dmoscope
