#include "core/mesh/topology.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/mesh/edges.h"
#include "core/mesh/halfedge.h"
#include "core/mesh/random.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::band;
using test::lattice;
using test::make;

TEST(Topology, StarsAgreeWithASearchThroughAllElements) {
  for (const Index every : {1U, 2U, 1000U}) {
    const Mesh mesh = lattice(9, 6, every);
    const Topology topology(mesh);
    ASSERT_EQ(topology.vertex_count(), mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      std::vector<std::pair<Index, Index>> expected;
      for (Index e = 0; e < mesh.elements.size(); ++e) {
        for (Index i = 0; i < mesh.elements.corners(e).size(); ++i) {
          if (mesh.elements.corners(e)[i] == v) expected.emplace_back(e, i);
        }
      }
      std::vector<std::pair<Index, Index>> found;
      for (const Incidence& i : topology.star(v)) found.emplace_back(i.element, i.corner);
      EXPECT_EQ(found, expected);
    }
  }
}

TEST(Topology, BoundaryOfALatticeIsItsRim) {
  const Mesh mesh = lattice(8, 5, 3);
  const Topology topology(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 p = mesh.positions[v];
    EXPECT_EQ(topology.boundary()[v] != 0, p.x == 0 || p.x == 8 || p.y == 0 || p.y == 5);
  }
  // Euler: V - E + F = 1 for a disc.
  EXPECT_EQ(mesh.vertex_count() + mesh.elements.size(), topology.edge_count() + 1);
}

TEST(Topology, UnusedVerticesHaveEmptyStarsAndHighValenceWorks) {
  Mesh mesh;
  constexpr Index n = 5000;
  mesh.positions.push_back({});
  for (Index i = 0; i < n; ++i) {
    mesh.positions.push_back({std::cos(6.283185307179586 * i / n), std::sin(6.283185307179586 * i / n), 0});
    test::add(mesh, {0, 1 + i, 1 + (i + 1) % n});
  }
  mesh.positions.push_back({9, 9, 9});
  const Topology topology(mesh);
  EXPECT_EQ(topology.star(0).size(), n);
  EXPECT_EQ(topology.boundary()[0], 0);
  EXPECT_TRUE(topology.star(n + 1).empty());
  EXPECT_EQ(topology.boundary()[n + 1], 0);
  EXPECT_EQ(HalfEdges(mesh).ring(0).size(), n);
}

TEST(Topology, EndsOfANonManifoldEdgeAreBoundary) {
  // Three wings on edge 0-1; each wing is closed to a disc around by nothing else.
  const Mesh mesh = make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 2, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  const EdgeTable edges(mesh);
  Index non_manifold = 0;
  for (Index i = 0; i < edges.size(); ++i) non_manifold += edges.sides(i).size() > 2 ? 1 : 0;
  EXPECT_EQ(non_manifold, 1U);
  EXPECT_EQ(HalfEdges(mesh).refused_elements(), 1U);
}

TEST(Edges, EverySideOnceAndItsElementRight) {
  const Mesh mesh = lattice(7, 4, 2);
  const EdgeTable edges(mesh);
  std::set<Index> seen;
  for (Index i = 0; i < edges.size(); ++i) {
    if (i > 0) {
      EXPECT_TRUE(edges.edge(i - 1).low < edges.edge(i).low ||
                  (edges.edge(i - 1).low == edges.edge(i).low && edges.edge(i - 1).high < edges.edge(i).high));
    }
    for (const Index side : edges.sides(i)) {
      EXPECT_TRUE(seen.insert(side).second);
      const Index e = edges.element(side);
      const auto corners = mesh.elements.corners(e);
      EXPECT_NE(std::ranges::find(corners, edges.edge(i).low), corners.end());
      EXPECT_NE(std::ranges::find(corners, edges.edge(i).high), corners.end());
      EXPECT_GE(side, mesh.elements.offsets()[e]);
      EXPECT_LT(side, mesh.elements.offsets()[e + 1]);
    }
  }
  EXPECT_EQ(seen.size(), mesh.elements.all_corners().size());
}

/// A lattice with holes: cells for which keep() is false are left out.
template <class Keep>
Mesh with_holes(Index n, Keep keep) {
  Mesh mesh = lattice(n, n, 1);
  const ElementTable all = mesh.elements;
  mesh.elements = {};
  for (Index e = 0; e < all.size(); ++e) {
    if (keep(e % n, e / n)) mesh.elements.add(all.kind(e), all.corners(e));
  }
  return mesh;
}

TEST(Edges, BoundaryLoopsAgreeWithTheHalfEdges) {
  EXPECT_EQ(count_boundary_loops(lattice(5, 5, 2), EdgeTable(lattice(5, 5, 2))), 1U);
  const Mesh holes = with_holes(9, [](Index i, Index j) { return !((i == 2 || i == 6) && (j == 2 || j == 5)); });
  EXPECT_EQ(count_boundary_loops(holes, EdgeTable(holes)), 5U);
  EXPECT_EQ(HalfEdges(holes).boundary_loops().size(), 5U);
  const Mesh ring = band(7, false);
  EXPECT_EQ(count_boundary_loops(ring, EdgeTable(ring)), 2U);
  const Mesh moebius = band(7, true);
  EXPECT_EQ(count_boundary_loops(moebius, EdgeTable(moebius)), 1U);
}

TEST(Edges, CurvesThatTouchInAVertexAreFollowedAlongTheirFans) {
  // Two squares that share one corner only: two fans there, two curves.
  const Mesh bow_tie = with_holes(2, [](Index i, Index j) { return i == j; });
  EXPECT_EQ(count_boundary_loops(bow_tie, EdgeTable(bow_tie)), 2U);
  // Two holes that touch in one vertex, inside a ring of cells: outer curve + the curve around both holes, as fans see it.
  const Mesh holes = with_holes(4, [](Index i, Index j) { return !((i == 1 && j == 1) || (i == 2 && j == 2)); });
  EXPECT_EQ(count_boundary_loops(holes, EdgeTable(holes)), 2U);
}

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
  for (const auto& loop : HalfEdges(mesh).boundary_loops()) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      total += cross(mesh.positions[loop[i]], mesh.positions[loop[(i + 1) % loop.size()]]).z / 2;
    }
  }
  EXPECT_DOUBLE_EQ(total, 24.0);
}

}  // namespace
}  // namespace dmoscope
