#include "core/mesh/topology.h"

#include <algorithm>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/edges.h"
#include "core/mesh/random.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::band;
using test::lattice;
using test::make;
using test::with_holes;
using ::testing::SizeIs;

EdgeSurvey surveyed(const Mesh& mesh) { return survey_edges(mesh, Topology(mesh), nullptr); }

Index boundary_loops(const Mesh& mesh) {
  const Topology topology(mesh);
  return count_boundary_loops(mesh, topology, survey_edges(mesh, topology, nullptr));
}

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
}

TEST(Topology, EndsOfANonManifoldEdgeAreBoundary) {
  // Three wings on edge 0-1; each wing is closed to a disc around by nothing else.
  const Mesh mesh = make({{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, -1, 0}, {0.5, 2, 0}}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}});
  EXPECT_THAT(surveyed(mesh).non_manifold, SizeIs(1));
}

TEST(Topology, FollowsElementsThatAreReversed) {
  Mesh mesh = lattice(6, 5, 2);
  Topology topology(mesh);
  for (Index e = 0; e < mesh.elements.size(); e += 3) mesh.elements.flip(e);
  topology.follow(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    for (const Incidence& i : topology.star(v)) EXPECT_EQ(mesh.elements.corners(i.element)[i.corner], v);
  }
}

TEST(Edges, EverySideOnceAndItsElementRight) {
  const Mesh mesh = lattice(7, 4, 2);
  std::set<std::pair<Index, Index>> seen;
  std::size_t sides_seen = 0;
  for_each_edge(mesh, Topology(mesh), [&](Edge edge, std::span<const EdgeSide> sides) {
    EXPECT_LT(edge.low, edge.high);
    EXPECT_TRUE(seen.empty() || *seen.rbegin() < std::pair(edge.low, edge.high)) << "ascending";
    EXPECT_TRUE(seen.insert({edge.low, edge.high}).second);
    sides_seen += sides.size();
    for (const EdgeSide& side : sides) {
      const auto corners = mesh.elements.corners(side.element);
      const auto from = std::ranges::find(corners, side.leaving ? edge.low : edge.high);
      ASSERT_NE(from, corners.end());
      EXPECT_EQ(*(std::next(from) == corners.end() ? corners.begin() : std::next(from)), side.leaving ? edge.high : edge.low);
    }
  });
  EXPECT_EQ(sides_seen, mesh.elements.all_corners().size());
}

/// The survey by its definitions, from a table of all edges.
EdgeSurvey surveyed_by_hand(const Mesh& mesh) {
  EdgeSurvey survey;
  const Index count = mesh.elements.size();
  std::map<std::pair<Index, Index>, std::vector<std::pair<Index, bool>>> table;
  std::map<std::vector<Index>, std::set<Index>> sets;
  for (Index e = 0; e < count; ++e) {
    const auto c = mesh.elements.corners(e);
    std::vector<Index> set(c.begin(), c.end());
    std::ranges::sort(set);
    if (set.front() != set.back()) sets[set].insert(e);
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Index a = c[i];
      const Index b = c[(i + 1) % c.size()];
      if (a != b) table[std::minmax(a, b)].emplace_back(e, a < b);
    }
  }
  for (const auto& [set, elements] : sets) survey.duplicates.insert(survey.duplicates.end(), std::next(elements.begin()), elements.end());
  std::ranges::sort(survey.duplicates);
  survey.edges = static_cast<Index>(table.size());
  survey.component.assign(count, kNoIndex);
  for (Index e = 0; e < count; ++e) survey.component[e] = e;
  for (Index round = 0; round < count; ++round) {  // the lowest element of each component spreads
    for (const auto& [edge, sides] : table) {
      if (sides.size() != 2) continue;
      Index& a = survey.component[sides[0].first];
      Index& b = survey.component[sides[1].first];
      a = b = std::min(a, b);
    }
  }
  std::map<Index, Index> number;
  for (Index& c : survey.component) c = number.try_emplace(c, static_cast<Index>(number.size())).first->second;
  survey.components = static_cast<Index>(number.size());
  for (const auto& [edge, sides] : table) {
    if (sides.size() == 1) survey.boundary.push_back({{edge.first, edge.second}, sides[0].first});
    if (sides.size() > 2) survey.non_manifold.push_back({edge.first, edge.second});
    if (sides.size() != 2 || sides[0].first == sides[1].first) continue;
    const auto set = [&](Index e) { return std::multiset<Index>(mesh.elements.corners(e).begin(), mesh.elements.corners(e).end()); };
    survey.consistent = survey.consistent && sides[0].second != sides[1].second && set(sides[0].first) != set(sides[1].first);
  }
  return survey;
}

void expect_surveyed(const Mesh& mesh) {
  const EdgeSurvey expected = surveyed_by_hand(mesh);
  EdgeSurvey found = surveyed(mesh);
  EXPECT_EQ(found.edges, expected.edges);
  EXPECT_EQ(found.consistent, expected.consistent);
  EXPECT_EQ(found.duplicates, expected.duplicates);
  EXPECT_EQ(found.component, expected.component);
  EXPECT_EQ(found.components, expected.components);
  const auto boundary = [](const EdgeSurvey& s) {
    std::set<std::array<Index, 3>> all;
    for (const auto& [edge, element] : s.boundary) all.insert({edge.low, edge.high, element});
    return all;
  };
  EXPECT_EQ(found.boundary.size(), expected.boundary.size());
  EXPECT_EQ(boundary(found), boundary(expected));
  const auto non_manifold = [](const EdgeSurvey& s) {
    std::set<std::array<Index, 2>> all;
    for (const Edge edge : s.non_manifold) all.insert({edge.low, edge.high});
    return all;
  };
  EXPECT_EQ(found.non_manifold.size(), expected.non_manifold.size());
  EXPECT_EQ(non_manifold(found), non_manifold(expected));
}

TEST(Edges, SurveyOfLatticesWithOddElements) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U, 5U, 6U, 7U, 8U}) {
    Random random(seed);
    Mesh mesh = lattice(7, 6, seed % 3 == 0 ? 1000 : static_cast<Index>(seed % 3));
    expect_surveyed(mesh);
    const Index count = mesh.elements.size();
    for (int i = 0; i < 3; ++i) {  // one irregularity after the other
      if (seed % 2 == 0) mesh.elements.flip(static_cast<Index>(random.below(count)));
      const auto c = mesh.elements.corners(static_cast<Index>(random.below(count)));
      std::vector<Index> again(c.begin(), c.end());
      if (i == 1) std::swap(again[0], again[1]);
      if (i == 2) again[random.below(again.size())] = static_cast<Index>(random.below(mesh.vertex_count()));
      mesh.elements.add(again.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, again);
      expect_surveyed(mesh);
    }
  }
}

TEST(Edges, SurveyOfARandomHeap) {
  for (const std::uint64_t seed : {11U, 12U, 13U, 14U, 15U, 16U}) {
    Random random(seed);
    Mesh mesh;
    const auto vertices = 4 + 4 * (seed - 11);
    mesh.positions.resize(vertices);
    for (int i = 0; i < 60; ++i) {
      std::vector<Index> c(3 + random.below(2));
      for (Index& v : c) v = static_cast<Index>(random.below(vertices));
      mesh.elements.add(c.size() == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, c);
    }
    expect_surveyed(mesh);
  }
}

TEST(Edges, BoundaryLoopsAreCounted) {
  EXPECT_EQ(boundary_loops(lattice(5, 5, 2)), 1U);
  const Mesh holes = with_holes(9, [](Index i, Index j) { return !((i == 2 || i == 6) && (j == 2 || j == 5)); });
  EXPECT_EQ(boundary_loops(holes), 5U);
  const Mesh ring = band(7, false);
  EXPECT_EQ(boundary_loops(ring), 2U);
  const Mesh moebius = band(7, true);
  EXPECT_EQ(boundary_loops(moebius), 1U);
}

TEST(Edges, CurvesThatTouchInAVertexAreFollowedAlongTheirFans) {
  // Two squares that share one corner only: two fans there, two curves.
  const Mesh bow_tie = with_holes(2, [](Index i, Index j) { return i == j; });
  EXPECT_EQ(boundary_loops(bow_tie), 2U);
  // Two holes that touch in one vertex, inside a ring of cells: outer curve + the curve around both holes, as fans see it.
  const Mesh holes = with_holes(4, [](Index i, Index j) { return !((i == 1 && j == 1) || (i == 2 && j == 2)); });
  EXPECT_EQ(boundary_loops(holes), 2U);
}

}  // namespace
}  // namespace dmoscope
