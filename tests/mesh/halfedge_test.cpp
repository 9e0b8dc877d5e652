#include "core/mesh/halfedge.h"

#include <set>

#include <gtest/gtest.h>

#include "core/mesh/edges.h"
#include "core/mesh/topology.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::lattice;
using test::make;
using test::with_holes;

TEST(HalfEdges, RingsAreOrderedCounterClockwise) {
  for (const Index every : {1U, 2U, 1000U}) {
    const Mesh mesh = lattice(6, 6, every);
    const HalfEdges half_edges(mesh);
    EXPECT_EQ(half_edges.refused_elements(), 0U);
    std::vector<std::set<Index>> neighbours(mesh.positions.size());
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      const auto c = mesh.elements.corners(e);
      for (std::size_t i = 0; i < c.size(); ++i) {
        neighbours[c[i]].insert(c[(i + 1) % c.size()]);
        neighbours[c[(i + 1) % c.size()]].insert(c[i]);
      }
    }
    const Topology topology(mesh);
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const auto ring = half_edges.ring(v);
      EXPECT_EQ(std::set<Index>(ring.begin(), ring.end()), neighbours[v]);
      EXPECT_EQ(ring.size(), neighbours[v].size());
      const bool boundary = topology.boundary()[v] != 0;
      for (std::size_t i = 0; i + (boundary ? 1 : 0) < ring.size(); ++i) {
        const Vec3 a = mesh.positions[ring[i]] - mesh.positions[v];
        const Vec3 b = mesh.positions[ring[(i + 1) % ring.size()]] - mesh.positions[v];
        EXPECT_GE(cross(a, b).z, -1e-12) << "turns left";
      }
      if (boundary) {
        EXPECT_EQ(topology.boundary()[ring.front()], 1);
        EXPECT_EQ(topology.boundary()[ring.back()], 1);
      }
    }
  }
}

TEST(HalfEdges, BoundaryLoopsKeepTheMeshToTheLeft) {
  const Mesh mesh = with_holes(5, [](Index i, Index j) { return !(i == 2 && j == 2); });
  double total = 0;
  for (const auto& [around, element] : HalfEdges(mesh).boundary_loops()) {
    for (std::size_t i = 0; i < around.size(); ++i) {
      total += cross(mesh.positions[around[i]], mesh.positions[around[(i + 1) % around.size()]]).z / 2;
    }
  }
  EXPECT_DOUBLE_EQ(total, 24.0);
}

TEST(HalfEdges, BoundaryLoopsAreAsManyAsTheSurveyCounts) {
  const Mesh holes = with_holes(9, [](Index i, Index j) { return !((i == 2 || i == 6) && (j == 2 || j == 5)); });
  const Topology topology(holes);
  EXPECT_EQ(HalfEdges(holes).boundary_loops().size(), 5U);
  EXPECT_EQ(count_boundary_loops(holes, topology, survey_edges(holes, topology, nullptr)), 5U);
}

TEST(HalfEdges, AVertexMayHaveManyNeighbours) {
  constexpr Index n = 5000;
  Mesh mesh;
  mesh.positions.push_back({});
  for (Index i = 0; i < n; ++i) {
    mesh.positions.push_back({std::cos(6.283185307179586 * i / n), std::sin(6.283185307179586 * i / n), 0});
    test::add(mesh, {0, 1 + i, 1 + (i + 1) % n});
  }
  EXPECT_EQ(HalfEdges(mesh).ring(0).size(), n);
}

TEST(HalfEdges, AThirdElementAtAnEdgeIsRefused) {
  const Mesh mesh = make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 2, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_EQ(HalfEdges(mesh).refused_elements(), 1U);
}

}  // namespace
}  // namespace dmoscope
