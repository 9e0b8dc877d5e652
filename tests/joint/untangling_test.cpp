// Untangling by joint moves, which they do first: never more inverted elements, never a lower minimum, and most tangles come undone.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

#include <gmock/gmock.h>

#include "core/base/same_bits.h"
#include "core/joint/atoms.h"
#include "core/joint/joint_clusters.h"
#include "tests/smooth/promises.h"
#include "tests/smooth/tangled_zoo.h"

namespace dmoscope {
namespace {

using namespace testing;

/// Mesh with the data that a run would hold of it.
struct Tangle {
  explicit Tangle(std::shared_ptr<const InputMesh> of, Metric by = Metric::MeanRatio)
      : mesh(std::move(of)),
        metric(by),
        run(make_run(mesh, {.metric = by})),
        clusters(*mesh, by, run.fixed()),
        positions(run.positions().begin(), run.positions().end()) {}
  [[nodiscard]] Statistics judge() const {
    return compute_statistics(mesh->quality_context(), positions, metric, run.immovable(), nullptr);
  }
  std::optional<JointCluster> call() { return clusters.raise_worst(positions, state, options, progress); }
  /// Calls joint moves while they untangle.
  void untangle() {
    while (judge().inverted > 0) {
      const auto cluster = call();
      if (!cluster || !cluster->is_untangling) return;
    }
  }

  std::shared_ptr<const InputMesh> mesh;
  Metric metric;
  dmoscope::Run run;
  JointClusters clusters;
  std::vector<Vec3> positions;
  JointState state{};
  JointOptions options{};
  Progress progress{};
};

void expect_promises(Tangle& tangle, const std::string& what) {
  Statistics before = tangle.judge();
  for (int call = 0; call < 6; ++call) {
    const std::vector<Vec3> old = tangle.positions;
    const JointState old_state = tangle.state;
    const auto cluster = tangle.call();
    const Statistics now = tangle.judge();
    if (!cluster) {
      EXPECT_TRUE(same_bits(std::span(tangle.positions), std::span(old))) << what;
      return;
    }
    ASSERT_LE(now.inverted, before.inverted) << what << ", call " << call;
    ASSERT_GE(now.minimum, before.minimum) << what << ", call " << call;
    if (cluster->is_untangling) {
      ASSERT_LT(now.inverted, before.inverted) << what << ", call " << call;
      ASSERT_GE(cluster->after, cluster->before) << what << ", call " << call;
    }
    std::vector<Vec3> moved = old;
    for (const JointCluster::Moved& each : cluster->moved) {
      ASSERT_EQ(tangle.run.fixed()[each.vertex], 0) << what << ", vertex " << each.vertex;
      moved[each.vertex] = each.to;
    }
    ASSERT_TRUE(same_bits(std::span(moved), std::span(tangle.positions))) << what << ", call " << call;
    std::vector<Vec3> again = old;
    JointState state_again = old_state;
    (void)tangle.clusters.raise_worst(again, state_again, tangle.options, tangle.progress);
    ASSERT_TRUE(same_bits(std::span(again), std::span(tangle.positions)) && state_again == tangle.state) << what << ": another time";
    before = now;
  }
}

TEST(Untangling, NeverWorseAndTheSameAgain) {
  for (const Spoiling spoiling : kSpoilings) {
    const std::string what = name_of(spoiling);
    for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
      Tangle tangle(input(spoiled(lattice(6, 0.2, 71, cells), 6.0, spoiling, 1)));
      expect_promises(tangle, what + ", planar " + std::to_string(static_cast<int>(cells)));
    }
    for (const test::Fill fill : {test::Fill::Tetrahedra, test::Fill::Hexahedra, test::Fill::Mixed}) {
      Tangle tangle(input(spoiled(test::volume_grid(3, fill, 0.2), 3.0, spoiling, 1)));
      expect_promises(tangle, what + ", volume " + std::to_string(static_cast<int>(fill)));
    }
  }
}

TEST(Untangling, JudgesByTheRunsMetric) {
  std::size_t tried = 0;
  for (const Metric metric : all_metrics()) {
    if (!joint_supports(metric, kind_set(ElementKind::Triangle))) continue;
    Tangle tangle(input(lattice(6, 0.9, 5)), metric);
    ASSERT_GT(tangle.judge().inverted, 0U);
    expect_promises(tangle, title(metric));
    EXPECT_EQ(tangle.judge().inverted, 0U) << title(metric);
    ++tried;
  }
  EXPECT_GT(tried, 5U);
}

/// Puts inner vertices at random places of the mesh's box, or moves them by up to so many units.
void scatter(Tangle& tangle, double amount, bool volume, std::uint64_t seed) {
  Random random(seed);
  Vec3 low = tangle.positions[0], high = low;
  for (const Vec3& p : tangle.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  for (Index v = 0; v < tangle.positions.size(); ++v) {
    if (tangle.run.fixed()[v] != 0) continue;
    Vec3& p = tangle.positions[v];
    if (amount > 0.0)
      p = p + Vec3{random(-amount, amount), random(-amount, amount), volume ? random(-amount, amount) : 0.0};
    else
      p = {random(low.x, high.x), random(low.y, high.y), volume ? random(low.z, high.z) : 0.0};
  }
}

/// Bends a mesh over the unit square or cube round a corner, so that its box is not its own.
Mesh bent_round(Mesh mesh) {
  for (Vec3& p : mesh.positions) {
    const double r = 0.3 + p.y, angle = 4.5 * p.x;
    p = {r * std::cos(angle), r * std::sin(angle), p.z};
  }
  return mesh;
}

/// Expects that most tangles come undone, of vertices moved across and of vertices thrown about.
void expect_undone(const std::function<Mesh(unsigned)>& make, bool volume, double cell, const std::string& what) {
  int moved = 0, thrown = 0, tangled = 0;
  constexpr unsigned kSeeds = 5;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    for (const bool all : {false, true}) {
      Tangle tangle(input(make(seed)));
      scatter(tangle, all ? 0.0 : 0.9 * cell, volume, seed);
      tangled += tangle.judge().inverted > 0 ? 1 : 0;
      tangle.untangle();
      (all ? thrown : moved) += tangle.judge().inverted == 0 ? 1 : 0;
    }
  }
  EXPECT_GE(tangled, 9) << what;
  EXPECT_EQ(moved, kSeeds) << what << ", moved across";
  EXPECT_GE(thrown, 4) << what << ", thrown about";
}

TEST(Untangling, UndoesPlanarTangles) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const std::string what = "cells " + std::to_string(static_cast<int>(cells));
    expect_undone([&](unsigned seed) { return lattice(10, 0.1, seed, cells); }, false, 0.1, what);
    expect_undone([&](unsigned seed) { return bent_round(lattice(10, 0.1, seed, cells)); }, false, 0.1, what + ", bent");
  }
}

TEST(Untangling, UndoesTangledVolumes) {
  for (const test::Fill fill : {test::Fill::Tetrahedra, test::Fill::Hexahedra, test::Fill::Mixed}) {
    const std::string what = "fill " + std::to_string(static_cast<int>(fill));
    expect_undone([&](unsigned seed) { return test::volume_grid(4, fill, 0.1, seed); }, true, 0.25, what);
    expect_undone([&](unsigned seed) { return bent_round(test::volume_grid(4, fill, 0.1, seed)); }, true, 0.25, what + ", bent");
  }
}

TEST(Untangling, MovesFewVerticesWhereFewElementsAreInverted) {
  Mesh mesh = lattice(30, 0.1, 3);
  mesh.positions[15 * 31 + 15] = mesh.positions[15 * 31 + 17];
  Tangle tangle(input(std::move(mesh)));
  ASSERT_GT(tangle.judge().inverted, 0U);
  const auto cluster = tangle.call();
  ASSERT_TRUE(cluster && cluster->is_untangling);
  EXPECT_EQ(tangle.judge().inverted, 0U);
  EXPECT_LT(cluster->moved.size(), 100U);
  EXPECT_EQ(tangle.state.untanglings, 1U);
}

/// Takes inverted elements whose rings meet and make a patch that is too large to be solved at once: there are fewer rings then.
TEST(Untangling, TakesFewerRingsWherePatchesWouldBeTooLarge) {
  Mesh mesh = test::volume_grid(12, test::Fill::Hexahedra, 0.05, 2);
  constexpr Index kRow = 13;
  const auto at = [](Index i, Index j, Index k) { return (k * kRow + j) * kRow + i; };
  for (const Index i : {3U, 6U, 9U})
    for (const Index j : {3U, 6U, 9U})
      for (const Index k : {3U, 6U, 9U}) mesh.positions[at(i, j, k)] = mesh.positions[at(i, j, k)] + Vec3{1.4 / 12, 0.0, 0.0};
  Tangle tangle(input(std::move(mesh)));
  ASSERT_GE(tangle.judge().inverted, 27U);
  tangle.options.whole_at_most = 200;  // the mesh has 1,331 vertices
  tangle.untangle();
  EXPECT_EQ(tangle.judge().inverted, 0U);
}

TEST(Untangling, LeavesAloneWhatCannotBeTurned) {
  // Moves a vertex of the boundary across the mesh: the elements that it inverts are held by fixed vertices.
  Mesh mesh = lattice(5, 0.0, 1);
  mesh.positions[2] = {0.4, 1.2, 0.0};
  Tangle tangle(input(std::move(mesh)));
  const Index before = tangle.judge().inverted;
  tangle.untangle();
  EXPECT_GT(tangle.judge().inverted, 0U);
  EXPECT_LE(tangle.judge().inverted, before);
  const JointState over = tangle.state;
  (void)tangle.call();
  EXPECT_EQ(tangle.state.untanglings, over.untanglings) << "it is not tried again";
}

TEST(Untangling, CancelledLeavesAllAsItWas) {
  Tangle tangle(input(lattice(10, 0.9, 4)));
  const std::vector<Vec3> before = tangle.positions;
  tangle.options.on_step = [&](const JointStep& step) {
    if (step.steps >= 3) tangle.progress.request_cancel();
  };
  EXPECT_THROW((void)tangle.call(), Cancelled);
  EXPECT_TRUE(same_bits(std::span(tangle.positions), std::span(before)));
  EXPECT_EQ(tangle.state, JointState{});
}

struct Tangled {
  const char* file;
  double minimum;
  friend void PrintTo(const Tangled& tangled, std::ostream* out) { *out << tangled.file; }
};
class UntanglingOfRealMeshes : public ::testing::TestWithParam<Tangled> {};

TEST_P(UntanglingOfRealMeshes, ReachesWhatItShould) {
  const auto file = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  Progress progress;
  Tangle tangle(load_input(file, Need::Smoothing, progress));
  ASSERT_GT(tangle.judge().inverted, 0U);
  tangle.options.push_first = true;
  tangle.untangle();
  EXPECT_EQ(tangle.judge().inverted, 0U);
  for (int call = 0; call < 10 && tangle.judge().movable_minimum < GetParam().minimum; ++call)
    if (!tangle.call()) break;
  EXPECT_GE(tangle.judge().movable_minimum, GetParam().minimum);
}
INSTANTIATE_TEST_SUITE_P(Wanted, UntanglingOfRealMeshes,
                         ::testing::Values(Tangled{"tri/tangled_tri.vtk", 0.866}, Tangled{"tet/tet_4_tangled.vtk", 0.71},
                                           Tangled{"hex/hex_5_tangled.vtk", 0.999}, Tangled{"quad/tangled_quad.vtk", 0.999},
                                           Tangled{"quad/shest_grid32.vtk", 0.08}, Tangled{"mixed3d/mixed-hex-pyr-tet.vtk", 0.44},
                                           Tangled{"hex/pave2.e.vtk", 0.0}));

}  // namespace
}  // namespace dmoscope
