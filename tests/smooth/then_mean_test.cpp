// Two smoothers in one: on the way from a phase to the other and back, no change by one is lost to the other.

#include "core/smooth/methods/then_mean.h"

#include <cstring>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/colouring.h"
#include "core/smooth/execution/method_table.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

std::vector<Index> free_vertices(const InputMesh& input) {
  std::vector<Index> free;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v)
    if (input.topology.boundary()[v] == 0) free.push_back(v);
  return free;
}

class Phases : public ::testing::TestWithParam<Precision> {};
INSTANTIATE_TEST_SUITE_P(ThenMean, Phases, ::testing::Values(Precision::Float, Precision::Double));

TEST_P(Phases, FollowEachOtherEitherWay) {
  const auto input = testing::input(testing::lattice(12, 0.3, 3));
  SmoothingTask task;
  task.input = input;
  task.colouring = std::make_shared<const Colouring>(colour_vertices(input->mesh, input->topology, free_vertices(*input)));
  task.search.precision = GetParam();
  task.then_mean = true;
  const std::uint64_t whole = task.colouring->order.size(), half = whole / 2;
  struct Stretch {
    Sweep sweep;
    std::uint64_t first, count;
  };
  const std::vector<Stretch> path{{{0}, 0, whole},      {{1, 0.3}, 0, whole}, {{2}, 0, half},     {{2, 0.4}, half, whole - half},
                                  {{3, 0.4}, 0, whole}, {{4}, 0, whole},      {{5, 0.4}, 0, half}};
  // One is left alone; the other is brought up to date and forgets all its state after every stretch.
  const auto alone = make_smoother(task), forgetful = make_smoother(task);
  std::vector<Vec3> a = input->mesh.positions, b = a;
  for (const auto& [sweep, first, count] : path) {
    alone->begin(sweep);
    forgetful->begin(sweep);
    EXPECT_EQ(alone->visit(first, count, a, nullptr), forgetful->visit(first, count, b, nullptr));
    forgetful->store(b, nullptr);
    forgetful->positions_replaced();
  }
  alone->store(a, nullptr);
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
  EXPECT_NE(std::memcmp(a.data(), input->mesh.positions.data(), a.size() * sizeof(Vec3)), 0);
}

/// While the floor stays, vertices whose stars rest are not visited again; changes by the user or another floor wake them.
TEST(ThenMean, WhoSleepsIsNotMissed) {
  const auto input = testing::input(testing::lattice(12, 0.3, 4));
  SmoothingTask task;
  task.input = input;
  task.colouring = std::make_shared<const Colouring>(colour_vertices(input->mesh, input->topology, free_vertices(*input)));
  task.then_mean = true;
  const std::uint64_t whole = task.colouring->order.size();
  const auto alone = make_smoother(task), forgetful = make_smoother(task);
  std::vector<Vec3> a = input->mesh.positions, b = a;
  std::uint64_t iteration = 0;
  const auto until_at_rest = [&](double floor) {
    std::uint64_t moved = 0, last = 1;
    while (last > 0) {
      const Sweep sweep{++iteration, floor, MeanKind::Arithmetic};
      alone->begin(sweep);
      forgetful->begin(sweep);
      forgetful->positions_replaced();
      last = alone->visit(0, whole, a, nullptr);
      const std::uint64_t expected = forgetful->visit(0, whole, b, nullptr);
      EXPECT_EQ(last, expected) << iteration;
      moved += expected;
      if (iteration > 2000 || last != expected) ADD_FAILURE() << "no rest, or another way";
      if (::testing::Test::HasFailure()) return moved;
    }
    return moved;
  };
  EXPECT_GT(until_at_rest(0.75), 0U);
  const Index hub = task.colouring->order[whole / 3];
  a[hub].x += 0.01;
  b[hub].x += 0.01;
  alone->positions_replaced();
  EXPECT_GT(until_at_rest(0.75), 0U);
  EXPECT_GT(until_at_rest(0.6), 0U) << "a lower floor leaves more room";
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3)), 0);
}

}  // namespace
}  // namespace dmoscope
