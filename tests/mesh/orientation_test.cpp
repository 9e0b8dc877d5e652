#include "core/mesh/orientation.h"

#include <gtest/gtest.h>

#include "core/mesh/random.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::band;
using test::lattice;
using test::make;

const Plane kXy{};

double area(const Mesh& mesh, Index e) {
  const auto c = mesh.elements.corners(e);
  double sum = 0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Vec3 a = mesh.positions[c[i]];
    const Vec3 b = mesh.positions[c[(i + 1) % c.size()]];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

std::vector<Index> flat(const Mesh& mesh) { return {mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()}; }

TEST(Orientation, RandomWindingsBecomeAllPositive) {
  for (const Index every : {1U, 2U, 1000U}) {
    Mesh mesh = lattice(20, 15, every);
    const std::vector<Index> before = flat(mesh);
    Random random(every);
    Index reversed = 0;
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      if (random.below(2) == 0) continue;
      mesh.elements.flip(e);
      ++reversed;
    }
    const OrientationReport report = normalise_orientation(mesh, kXy);
    EXPECT_EQ(report.flipped, reversed);
    EXPECT_EQ(report.components, 1U);
    EXPECT_EQ(report.contradictions, 0U);
    EXPECT_EQ(flat(mesh), before);
    for (Index e = 0; e < mesh.elements.size(); ++e) EXPECT_GT(area(mesh, e), 0);
  }
}

TEST(Orientation, TangledElementStaysInverted) {
  Mesh mesh = lattice(4, 4, 1000);
  mesh.positions[12] = {4.5, 2, 0};  // the middle vertex, thrown over the boundary
  const std::vector<Index> before = flat(mesh);
  const OrientationReport report = normalise_orientation(mesh, kXy);
  EXPECT_EQ(report.flipped, 0U);
  EXPECT_EQ(flat(mesh), before);
  EXPECT_TRUE(mesh.flipped.empty());
}

TEST(Orientation, MeshWoundClockwiseIsReversedAndRemembersIt) {
  Mesh mesh = lattice(3, 3, 2);
  const std::vector<Index> positive = flat(mesh);
  for (Index e = 0; e < mesh.elements.size(); ++e) mesh.elements.flip(e);
  EXPECT_EQ(normalise_orientation(mesh, kXy).flipped, mesh.elements.size());
  EXPECT_EQ(flat(mesh), positive);
  ASSERT_EQ(mesh.flipped.size(), mesh.elements.size());
  for (const auto f : mesh.flipped) EXPECT_EQ(f, 1);
  // A second call changes nothing, and the flips of the first are still known.
  const auto flipped = mesh.flipped;
  EXPECT_EQ(normalise_orientation(mesh, kXy).flipped, 0U);
  EXPECT_EQ(mesh.flipped, flipped);
}

TEST(Orientation, IsolatedElementsKeepTheirWinding) {
  Mesh mesh = make({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}}, {{0, 1, 2}, {3, 5, 4}});
  const OrientationReport report = normalise_orientation(mesh, kXy);
  EXPECT_EQ(report.flipped, 0U);
  EXPECT_EQ(report.components, 2U);
  EXPECT_LT(area(mesh, 1), 0);
}

TEST(Orientation, NonManifoldEdgeIsNotCrossed) {
  Mesh mesh = make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 2, 0}}, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const std::vector<Index> before = flat(mesh);
  const OrientationReport report = normalise_orientation(mesh, kXy);
  EXPECT_EQ(report.components, 3U);
  EXPECT_EQ(report.contradictions, 1U);
  EXPECT_EQ(flat(mesh), before);
}

TEST(Orientation, MoebiusBandHasAContradictionAndABandHasNone) {
  Mesh moebius = band(9, true);
  EXPECT_EQ(normalise_orientation(moebius, kXy).contradictions, 1U);
  const std::vector<Index> once = flat(moebius);
  EXPECT_EQ(normalise_orientation(moebius, kXy).flipped, 0U);
  EXPECT_EQ(flat(moebius), once);
  Mesh plain = band(9, false);
  for (Index e = 0; e < 4; ++e) plain.elements.flip(e);
  EXPECT_EQ(normalise_orientation(plain, kXy).contradictions, 0U);
}

TEST(Orientation, DependsOnThePlanesNormal) {
  Mesh mesh = lattice(3, 3, 2);
  for (Vec3& p : mesh.positions) p = {p.y, p.x, 0};  // mirrored: all negative about +z
  EXPECT_EQ(normalise_orientation(mesh, kXy).flipped, mesh.elements.size());
}

}  // namespace
}  // namespace dmoscope
