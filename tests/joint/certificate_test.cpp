// Certificate of joint moves: the forces balance, and no direction that was tried raises all holders.

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/joint/joint_clusters.h"
#include "core/quality/quality.h"
#include "tests/smooth/promises.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

struct Certified {
  std::shared_ptr<const InputMesh> mesh;
  std::vector<std::uint8_t> fixed;
  std::vector<Vec3> positions;
  JointCluster cluster;
};

/// Certificate of the whole mesh's minimum: that of the last cluster, which nothing raised.
std::optional<Certified> certify(Mesh mesh, Metric metric) {
  const auto made = testing::input(std::move(mesh));
  const dmoscope::Run run = testing::make_run(made, {.metric = metric});
  Certified found{made, {run.fixed().begin(), run.fixed().end()}, made->mesh.positions, {}};
  JointClusters clusters(*made, metric, found.fixed);
  JointState state;
  Progress progress;
  JointOptions options;
  options.push_first = true;
  for (int call = 0; call < 30; ++call)
    if (!clusters.raise_worst(found.positions, state, options, progress)) break;
  if (state.end != JointState::End::Certified) return std::nullopt;
  JointState anew;
  auto last = clusters.raise_worst(found.positions, anew, {}, progress);
  if (!last || !last->certified) return std::nullopt;
  found.cluster = std::move(*last);
  return found;
}

/// Least quality of the holders, with all vertices displaced.
double least_of_holders(const Certified& c, Metric metric, const std::vector<Vec3>& displaced) {
  double least = std::numeric_limits<double>::infinity();
  for (const JointCluster::Active& one : c.cluster.active)
    least = std::min(least, element_quality(c.mesh->quality_context(), std::span<const Vec3>(displaced), metric, one.element));
  return least;
}

void expect_balance(const Certified& c, const std::string& what) {
  double sum = 0.0, greatest = 0.0;
  for (const JointCluster::Active& one : c.cluster.active) sum += one.multiplier;
  EXPECT_NEAR(sum, 1.0, 1e-9) << what;
  std::vector<Vec3> total(c.positions.size());
  for (const JointCluster::Force& one : c.cluster.forces) {
    total[one.vertex] = total[one.vertex] + one.force;
    greatest = std::max(greatest, length(one.force));
  }
  ASSERT_GT(greatest, 0.0) << what;
  for (const Index v : c.cluster.vertices) EXPECT_LT(length(total[v]), 0.05 * greatest) << what << ": vertex " << v;
}

/// Tries random directions, and those in which single holders pull: the worst of the holders gains no more than the gap in any.
void expect_no_direction_raises(const Certified& c, Metric metric, const std::string& what) {
  testing::Random random(7);
  const double before = least_of_holders(c, metric, c.positions);
  double edge = 0.0;  // rough edge length in the cluster
  for (const JointCluster::Force& one : c.cluster.forces)
    for (const JointCluster::Force& other : c.cluster.forces)
      if (one.element == other.element) edge = std::max(edge, length(c.positions[one.vertex] - c.positions[other.vertex]));
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Vec3> moved = c.positions;
    const double size = edge * std::pow(10.0, random(-5.0, -2.0));
    if (trial % 2 == 0) {
      for (const Index v : c.cluster.vertices) {
        const double z = c.mesh->is_volume() ? random(-1.0, 1.0) : 0.0;
        moved[v] = moved[v] + size * Vec3{random(-1.0, 1.0), random(-1.0, 1.0), z};
      }
    } else {
      double greatest = 0.0;
      std::vector<double> weights(c.mesh->mesh.elements.size());
      for (double& weight : weights) weight = random();
      for (const JointCluster::Force& one : c.cluster.forces) greatest = std::max(greatest, length(one.force));
      for (const JointCluster::Force& one : c.cluster.forces)
        if (std::ranges::binary_search(c.cluster.vertices, one.vertex))
          moved[one.vertex] = moved[one.vertex] + size / greatest * weights[one.element] * one.force;
    }
    EXPECT_LE(least_of_holders(c, metric, moved), before * (1.0 + 1e-3)) << what << ", trial " << trial;
  }
}

TEST(JointCertificate, ForcesBalanceAndNoDirectionRaisesAllOfPlanarMeshes) {
  int certified = 0;
  for (const testing::Cells cells : {testing::Cells::Triangles, testing::Cells::Quadrilaterals, testing::Cells::Mixed})
    for (std::uint64_t seed = 1; seed <= 8; ++seed)
      for (const Metric metric : {Metric::MeanRatio, Metric::RadiusRatio, Metric::ScaledJacobian}) {
        Mesh mesh = testing::lattice(7, 0.3, seed, cells);
        if (!testing::defined_for_all(metric, mesh)) continue;
        const std::string what = fmt::format("cells {}, seed {}, {}", static_cast<int>(cells), seed, dmoscope::info(metric).name);
        const auto found = certify(std::move(mesh), metric);
        // Skips meshes of ideal elements alone: nothing pulls there.
        if (!found || least_of_holders(*found, metric, found->positions) > 0.999) continue;
        ++certified;
        expect_balance(*found, what);
        expect_no_direction_raises(*found, metric, what);
      }
  EXPECT_GT(certified, 20);
}

TEST(JointCertificate, ForcesBalanceAndNoDirectionRaisesAllOfVolumes) {
  int certified = 0;
  for (const test::Fill fill : {test::Fill::Tetrahedra, test::Fill::Mixed})
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const auto found = certify(test::volume_grid(3, fill, 0.15, seed), Metric::MeanRatio);
      if (!found || least_of_holders(*found, Metric::MeanRatio, found->positions) > 0.999) continue;
      ++certified;
      const std::string what = fmt::format("fill {}, seed {}", static_cast<int>(fill), seed);
      expect_balance(*found, what);
      expect_no_direction_raises(*found, Metric::MeanRatio, what);
    }
  EXPECT_GT(certified, 3);
}

TEST(JointCertificate, AVertexMovedAwayIsNotCertified) {
  auto found = certify(testing::lattice(7, 0.3, 2), Metric::MeanRatio);
  ASSERT_TRUE(found);
  JointClusters clusters(*found->mesh, Metric::MeanRatio, found->fixed);
  const Index v = found->cluster.vertices.front();
  found->positions[v] = found->positions[v] + Vec3{0.02, 0.01, 0.0};
  JointState anew;
  Progress progress;
  const auto again = clusters.raise_worst(found->positions, anew, {}, progress);
  ASSERT_TRUE(again);
  EXPECT_GT(again->after, again->before) << "what was moved away is raised again";
}

/// No metric goes beyond the end of its range: a lattice of squares or cubes needs no cluster to be certified.
TEST(Certificate, NeedsNoClusterAtTheEndOfTheRange) {
  for (const bool volume : {false, true}) {
    const auto mesh = volume ? testing::input(test::volume_grid(3, test::Fill::Hexahedra))
                             : testing::input(testing::lattice(5, 0.0, 1, testing::Cells::Quadrilaterals));
    for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian})
      for (const std::optional<MeanKind> mean : {std::optional<MeanKind>(), std::optional(MeanKind::Harmonic)}) {
        JointClusters clusters(*mesh, metric, testing::make_run(mesh, {}).fixed());
        std::vector<Vec3> positions = mesh->mesh.positions;
        JointState state;
        Progress progress;
        EXPECT_FALSE(clusters.raise_worst(positions, state, {.gap = 1e-9, .push_first = true, .mean = mean}, progress));
        EXPECT_EQ(state.end, JointState::End::Certified);
      }
  }
}

}  // namespace
}  // namespace dmoscope
