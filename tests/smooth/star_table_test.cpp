// The table of stars against the elements themselves.

#include "core/smooth/kernels/star_table.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/thread_pool.h"
#include "tests/smooth/zoo.h"

namespace dmoscope {
namespace {

/// The other corners of each element of a vertex, in the element's order; elements are sorted.
using Corners = std::vector<std::vector<Index>>;

std::vector<Corners> stars_of(const Mesh& mesh) {
  std::vector<Corners> stars(mesh.positions.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    std::vector<Index> corners(mesh.elements.corners(e).begin(), mesh.elements.corners(e).end());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      stars[corners[0]].emplace_back(corners.begin() + 1, corners.end());
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
  }
  for (Corners& star : stars) std::ranges::sort(star);
  return stars;
}

/// Whether the elements form one closed ring of triangles.
bool is_fan(const Corners& star) {
  std::map<Index, Index> next;
  for (const auto& corners : star)
    if (corners.size() != 2 || !next.emplace(corners[0], corners[1]).second) return false;
  Index at = star[0][0];
  std::set<Index> seen;
  while (next.contains(at) && seen.insert(at).second) at = next[at];
  return seen.size() == star.size() && at == star[0][0];
}

/// The elements that a shape describes, in the mesh's numbers.
Corners told(const StarTable& table, const StarShape& shape) {
  const auto other = [&](std::size_t i) { return table.vertex_of_rank[table.others[shape.first + i]]; };
  const std::size_t n = shape.triangles;
  Corners star;
  for (std::size_t i = 0; i < n; ++i) {
    if (shape.kind == StarShape::Kind::Fan)
      star.push_back({other(i), other((i + 1) % n)});
    else
      star.push_back({other(2 * i), other(2 * i + 1)});
  }
  for (std::size_t i = 0, p = 2 * n; i < shape.quadrilaterals; ++i, p += 3) star.push_back({other(p), other(p + 1), other(p + 2)});
  std::ranges::sort(star);
  return star;
}

StarTable table_of(const InputMesh& input, ThreadPool* pool, Colouring& colouring) {
  std::vector<Index> free;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v)
    if (!input.topology.star(v).empty() && v % 11 != 5) free.push_back(v);  // on the boundary too: there fans are open
  colouring = colour_vertices(input.mesh, input.topology, shuffled(free, 3));
  return build_star_table(input.mesh, input.topology, colouring, pool);
}

void expect_star(const StarTable& table, std::size_t rank, const Corners& star) {
  const StarShape& shape = table.shapes[rank];
  const std::size_t size = table.shapes[rank + 1].first - shape.first;
  const auto triangles = static_cast<std::size_t>(std::ranges::count_if(star, [](const auto& c) { return c.size() == 2; }));
  const std::size_t quadrilaterals = star.size() - triangles;
  if (is_fan(star) && triangles <= kMaxFan) {
    EXPECT_EQ(shape.kind, StarShape::Kind::Fan);
    EXPECT_EQ(size, triangles);
    EXPECT_EQ(told(table, shape), star);
  } else if (triangles <= kMaxTriangles && quadrilaterals <= kMaxQuadrilaterals) {
    EXPECT_EQ(shape.kind, StarShape::Kind::General);
    EXPECT_EQ(size, 2 * triangles + 3 * quadrilaterals);
    EXPECT_EQ(told(table, shape), star);
  } else {
    EXPECT_EQ(shape.kind, StarShape::Kind::Alone);
    EXPECT_EQ(shape.triangles + shape.quadrilaterals, 0);
    std::set<Index> neighbours, listed;
    for (const auto& corners : star) neighbours.insert(corners.begin(), corners.end());
    for (std::size_t i = 0; i < size; ++i) listed.insert(table.vertex_of_rank[table.others[shape.first + i]]);
    EXPECT_EQ(listed, neighbours);
  }
}

TEST(StarTable, TellsTheElementsOfEveryFreeVertexAndRanksAllVertices) {
  std::map<StarShape::Kind, int> kinds;
  for (const testing::Specimen& specimen : testing::zoo()) {
    SCOPED_TRACE(specimen.name);
    const auto mesh = testing::input(specimen.mesh);
    Colouring colouring;
    const StarTable table = table_of(*mesh, nullptr, colouring);
    ASSERT_EQ(table.vertex_of_rank.size(), mesh->mesh.positions.size());
    ASSERT_EQ(table.shapes.size(), colouring.order.size() + 1);
    EXPECT_TRUE(std::equal(colouring.order.begin(), colouring.order.end(), table.vertex_of_rank.begin()));
    std::vector<Index> sorted = table.vertex_of_rank, all(sorted.size());
    std::ranges::sort(sorted);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(sorted, all);
    EXPECT_EQ(table.shapes[0].first, 0U);
    EXPECT_EQ(table.shapes.back().first, table.others.size());
    const auto stars = stars_of(mesh->mesh);
    for (std::size_t rank = 0; rank < colouring.order.size(); ++rank) {
      expect_star(table, rank, stars[colouring.order[rank]]);
      ++kinds[table.shapes[rank].kind];
    }
  }
  EXPECT_EQ(kinds.size(), 3U) << "the meshes show all kinds";
}

TEST(StarTable, IsTheSameForAnyPool) {
  const auto mesh = testing::input(testing::lattice(150, 0.3, 51, testing::Cells::Mixed));  // more than two chunks
  Colouring colouring;
  const StarTable alone = table_of(*mesh, nullptr, colouring);
  const auto stars = stars_of(mesh->mesh);
  for (std::size_t rank = 0; rank < colouring.order.size(); ++rank) expect_star(alone, rank, stars[colouring.order[rank]]);
  for (const unsigned threads : {1U, 4U}) {
    ThreadPool pool(threads);
    const StarTable other = table_of(*mesh, &pool, colouring);
    EXPECT_EQ(other.vertex_of_rank, alone.vertex_of_rank);
    EXPECT_EQ(other.others, alone.others);
    EXPECT_TRUE(std::ranges::equal(other.shapes, alone.shapes, [](const StarShape& a, const StarShape& b) {
      return a.first == b.first && a.triangles == b.triangles && a.quadrilaterals == b.quadrilaterals && a.kind == b.kind;
    }));
  }
}

TEST(StarTable, OfNothingFreeIsEmpty) {
  const auto mesh = testing::input(testing::lattice(1, 0, 1));
  const StarTable table = build_star_table(mesh->mesh, mesh->topology, {{}, {0}}, nullptr);
  EXPECT_EQ(table.vertex_of_rank, (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(table.shapes.size(), 1U);
  EXPECT_TRUE(table.others.empty());
}

}  // namespace
}  // namespace dmoscope
