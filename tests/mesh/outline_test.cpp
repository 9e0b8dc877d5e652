#include "core/mesh/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/generate.h"
#include "core/mesh/vertex_words.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using std::numbers::pi;

double perimeter(double radius, Index n) { return 2 * n * radius * std::sin(pi / n); }
double polygon_area(double radius, Index n) { return n * radius * radius * std::sin(2 * pi / n) / 2; }

/// A ring of n quadrilaterals between circles about `centre`; `layers` of them, whose radii rise from `inner` to `outer`.
void add_annulus(Mesh& mesh, Vec3 centre, double inner, double outer, Index n, Index layers) {
  const Index first = mesh.vertex_count();
  for (Index k = 0; k <= layers; ++k) {
    const double r = inner + (outer - inner) * k / layers;
    for (Index i = 0; i < n; ++i) mesh.positions.push_back(centre + Vec3{r * std::cos(2 * pi * i / n), r * std::sin(2 * pi * i / n), 0});
  }
  for (Index k = 0; k < layers; ++k) {
    for (Index i = 0; i < n; ++i) {
      const Index a = first + k * n + i, b = first + k * n + (i + 1) % n;
      test::add(mesh, {a, a + n, b + n, b});
    }
  }
}

/// A grid of n x m quadrilaterals, closed along the first direction and, if `both`, along the second.
Mesh tube(Index n, Index m, bool both) {
  Mesh mesh;
  const Index rows = both ? m : m + 1;
  for (Index j = 0; j < rows; ++j) {
    for (Index i = 0; i < n; ++i) {
      const double u = 2 * pi * i / n, v = 2 * pi * j / m;
      const double r = both ? 2 + std::cos(v) : 1.0;
      mesh.positions.push_back({r * std::cos(u), r * std::sin(u), both ? std::sin(v) : double(j)});
    }
  }
  for (Index j = 0; j < m; ++j) {
    for (Index i = 0; i < n; ++i) {
      const Index up = (j + 1) % rows, right = (i + 1) % n;
      test::add(mesh, {j * n + i, j * n + right, up * n + right, up * n + i});
    }
  }
  return mesh;
}

TEST(Outline, AnAnnulusHasTwoLoopsOfKnownLengthAndArea) {
  for (const double far : {0.0, 1e6}) {
    Mesh mesh;
    add_annulus(mesh, {far, -far, 0}, 1, 3, 40, 4);
    const Outline outline = outline_of(mesh);
    ASSERT_EQ(outline.loops.size(), 2U);
    EXPECT_EQ(outline.name(0), "loop 1 (outer)");
    EXPECT_EQ(outline.name(1), "loop 2");
    for (const auto& [loop, radius] : {std::pair(0U, 3.0), std::pair(1U, 1.0)}) {
      EXPECT_EQ(outline.loops[loop].vertices.size(), 40U);
      EXPECT_NEAR(outline.loops[loop].length, perimeter(radius, 40), far * 1e-14 + 1e-12);
      EXPECT_NEAR(outline.loops[loop].area, polygon_area(radius, 40), far * 1e-14 + 1e-12);
    }
    ASSERT_EQ(outline.parts.size(), 1U);
    EXPECT_EQ(outline.parts[0].vertices, 200U);
    EXPECT_EQ(outline.parts[0].loops, 2U);
    EXPECT_NEAR(outline.parts[0].area, polygon_area(3, 40) - polygon_area(1, 40), far * 1e-14 + 1e-12);
    EXPECT_EQ(outline.left_out, 0U);
  }
}

TEST(Outline, WhichLoopIsTheOuterOneDoesNotHangOnTheWinding) {
  Mesh mesh;
  add_annulus(mesh, {}, 1, 2, 12, 1);
  for (Index e = 0; e < mesh.elements.size(); ++e) mesh.elements.flip(e);
  const Outline outline = outline_of(mesh);
  ASSERT_EQ(outline.loops.size(), 2U);
  EXPECT_TRUE(outline.loops[0].outer);
  EXPECT_FALSE(outline.loops[1].outer);
  EXPECT_NEAR(outline.loops[0].length, perimeter(2, 12), 1e-12);
}

TEST(Outline, HolesComeInTheOrderOfTheirLowestVertices) {
  // 9 x 9 cells without the cell (6, 1) and without the block of 2 x 3 at (2, 4).
  const Mesh mesh = test::with_holes(9, [](Index i, Index j) { return !(i == 6 && j == 1) && !(i >= 2 && i < 4 && j >= 4 && j < 7); });
  const Outline outline = outline_of(mesh);
  ASSERT_EQ(outline.loops.size(), 3U);
  EXPECT_DOUBLE_EQ(outline.loops[0].area, 81);
  EXPECT_DOUBLE_EQ(outline.loops[1].area, 1);
  EXPECT_DOUBLE_EQ(outline.loops[2].area, 6);
  EXPECT_DOUBLE_EQ(outline.loops[2].length, 10);
  EXPECT_EQ(outline.loops[1].vertices.front(), 1 * 10 + 6);
  EXPECT_EQ(outline.loops[2].vertices.front(), 4 * 10 + 2);
  EXPECT_DOUBLE_EQ(outline.parts[0].area, 81 - 7);
}

TEST(Outline, LoopsRunWithTheMeshToTheLeftFromTheirLowestVertex) {
  const Mesh mesh = test::lattice(2, 1, 1);
  const Outline outline = outline_of(mesh);
  ASSERT_EQ(outline.loops.size(), 1U);
  EXPECT_EQ(outline.loops[0].vertices, (std::vector<Index>{0, 1, 2, 5, 4, 3}));
  const auto place = outline.find(4);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->loop, 0U);
  EXPECT_EQ(place->at, 4U);
  EXPECT_FALSE(outline_of(test::lattice(2, 2, 1)).find(4)) << "inside";
}

TEST(Outline, EveryPartHasAnOuterLoop) {
  Mesh mesh;
  add_annulus(mesh, {10, 0, 0}, 1, 2, 16, 1);
  add_annulus(mesh, {0, 0, 0}, 3, 4, 24, 2);
  const Outline outline = outline_of(mesh);
  ASSERT_EQ(outline.parts.size(), 2U);
  EXPECT_EQ(outline.parts[0].elements.size(), 16U);
  EXPECT_EQ(outline.parts[1].elements.size(), 48U);
  ASSERT_EQ(outline.loops.size(), 4U);
  const double radii[] = {2, 1, 4, 3};
  const Index corners[] = {16, 16, 24, 24};
  for (Index l = 0; l < 4; ++l) {
    EXPECT_EQ(outline.loops[l].part, l / 2);
    EXPECT_EQ(outline.loops[l].outer, l % 2 == 0);
    EXPECT_NEAR(outline.loops[l].area, polygon_area(radii[l], corners[l]), 1e-12);
  }
}

TEST(Outline, ATorusHasNoLoopAndATubeTwoOfWhichNoneIsTheOuterOne) {
  const Outline torus = outline_of(tube(12, 9, true));
  EXPECT_TRUE(torus.loops.empty());
  ASSERT_EQ(torus.parts.size(), 1U);
  EXPECT_EQ(torus.parts[0].vertices, 108U);
  const Outline open = outline_of(tube(12, 3, false));
  ASSERT_EQ(open.loops.size(), 2U);
  for (const BoundaryLoop& loop : open.loops) {
    EXPECT_FALSE(loop.outer);
    EXPECT_NEAR(loop.length, perimeter(1, 12), 1e-12);
    EXPECT_NEAR(loop.area, polygon_area(1, 12), 1e-12);
  }
  EXPECT_NEAR(open.parts[0].area, 3 * perimeter(1, 12), 1e-12);
}

TEST(Outline, WhatHalfEdgesCannotHaveIsCounted) {
  EXPECT_EQ(outline_of(test::band(8, true)).left_out, 1U) << "a Moebius band";
  EXPECT_EQ(outline_of(test::band(8, false)).left_out, 0U);
}

TEST(Outline, AnElementWithACornerTwiceIsOneWithACornerLess) {
  const Mesh mesh = test::make({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 2}, {0, 2, 3}});
  const Outline outline = outline_of(mesh);
  EXPECT_EQ(outline.left_out, 0U);
  ASSERT_EQ(outline.loops.size(), 1U);
  EXPECT_DOUBLE_EQ(outline.loops[0].area, 1);
  EXPECT_DOUBLE_EQ(outline.loops[0].length, 4);
}

TEST(Outline, WordsNameLoopsAndParts) {
  Mesh mesh;
  add_annulus(mesh, {}, 1, 2, 12, 1);
  std::vector<Index> inner(12), all(24);
  for (Index v = 0; v < 24; ++v) all[v] = v;
  for (Index v = 0; v < 12; ++v) inner[v] = v;
  EXPECT_EQ(vertices_named(mesh, "loop:2"), inner);
  EXPECT_EQ(vertices_named(mesh, "part:1"), all);
  const auto error = [&](const Mesh& of, const char* word) -> std::string {
    try {
      static_cast<void>(vertices_named(of, word));
    } catch (const UsageError& wrong) {
      return wrong.what();
    }
    return "";
  };
  EXPECT_EQ(error(mesh, "loop:3"), "loop:3: the mesh has 2 boundary loops, loop:1 to loop:2");
  EXPECT_EQ(error(mesh, "loop:0"), "loop:0: the mesh has 2 boundary loops, loop:1 to loop:2");
  EXPECT_EQ(error(mesh, "loop:outer"), "loop:outer: the mesh has 2 boundary loops, loop:1 to loop:2");
  EXPECT_EQ(error(mesh, "part:2"), "part:2: the mesh has one part, part:1");
  EXPECT_EQ(error(tube(12, 9, true), "loop:1"), "loop:1: the mesh has no boundary loop");
  Progress progress;
  EXPECT_EQ(error(generate_mesh("tetrahedra", 0, 1, progress), "loop:1"), "loop:1: a volume mesh has no boundary loops");
}

TEST(Outline, RingsAreThoseOfTheWholeMesh) {
  const Mesh mesh = test::lattice(4, 4, 2);
  const Topology topology(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const std::vector<Index> ring = ordered_ring(mesh, topology, v);
    double turned = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const bool gap = topology.boundary()[v] != 0 && i + 1 == ring.size();
      const Vec3 a = mesh.positions[ring[i]] - mesh.positions[v], b = mesh.positions[ring[(i + 1) % ring.size()]] - mesh.positions[v];
      if (!gap) turned += std::atan2(cross(a, b).z, dot(a, b));
    }
    const auto [x, y] = std::pair(mesh.positions[v].x, mesh.positions[v].y);
    const int sides = (x == 0 || x == 4 ? 1 : 0) + (y == 0 || y == 4 ? 1 : 0);
    EXPECT_NEAR(turned, sides == 0 ? 2 * pi : sides == 1 ? pi : pi / 2, 1e-12) << v;
  }
}

}  // namespace
}  // namespace dmoscope
