#include "core/mesh/colouring.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "core/base/thread_pool.h"
#include "tests/mesh/meshes.h"

namespace dmoscope {
namespace {

using test::lattice;

std::vector<Index> interior(const Mesh& mesh, const Topology& topology) {
  std::vector<Index> free;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (topology.boundary()[v] == 0) free.push_back(v);
  }
  return free;
}

constexpr Plane kPlane{};

TEST(Colouring, NoTwoOfAClassShareAnElementAndEveryVertexComesOnce) {
  for (const Index every : {1U, 2U, 1000U}) {
    const Mesh mesh = lattice(17, 13, every);
    const Topology topology(mesh);
    for (const std::uint64_t seed : {0U, 1U, 2U}) {
      std::vector<Index> free = interior(mesh, topology);
      if (seed != 0) free = shuffled(free, seed);
      const Colouring colouring = colour_vertices(mesh, topology, free);
      std::vector<Index> place(mesh.positions.size(), kNoIndex);
      for (Index i = 0; i < free.size(); ++i) place[free[i]] = i;
      std::vector<Index> colour(mesh.positions.size(), kNoIndex);
      for (Index c = 0; c < colouring.class_count(); ++c) {
        const auto members = colouring.members(c);
        EXPECT_FALSE(members.empty());
        EXPECT_TRUE(std::ranges::is_sorted(members, {}, [&](Index v) { return place[v]; }));
        for (const Index v : members) {
          EXPECT_EQ(colour[v], kNoIndex);
          colour[v] = c;
        }
      }
      EXPECT_EQ(colouring.order.size(), free.size());
      for (Index e = 0; e < mesh.elements.size(); ++e) {
        const auto corners = mesh.elements.corners(e);
        for (const Index a : corners) {
          for (const Index b : corners) EXPECT_TRUE(a == b || colour[a] == kNoIndex || colour[a] != colour[b]);
        }
      }
      EXPECT_LE(colouring.class_count(), 9U) << "at most one more than the neighbours in elements";
    }
  }
}

TEST(Colouring, RegularQuadrilateralsInNaturalOrderNeedFour) {
  const Mesh mesh = lattice(10, 10, 1);
  const Topology topology(mesh);
  EXPECT_EQ(colour_vertices(mesh, topology, interior(mesh, topology)).class_count(), 4U);
}

TEST(Colouring, IsTheSameForAnyPool) {
  const Mesh mesh = lattice(400, 300, 3);
  const Topology topology(mesh);
  ThreadPool pool(3);
  for (const std::uint64_t seed : {0U, 4U}) {
    std::vector<Index> free = interior(mesh, topology);
    if (seed != 0) free = shuffled(free, seed);
    Colouring alone = colour_vertices(mesh, topology, free), together = colour_vertices(mesh, topology, free, &pool);
    EXPECT_EQ(alone.order, together.order);
    EXPECT_EQ(alone.class_offsets, together.class_offsets);
    arrange_classes(alone, mesh, &kPlane, topology);
    arrange_classes(together, mesh, &kPlane, topology, &pool);
    EXPECT_EQ(alone.order, together.order);
  }
}

/// Every two vertices share an element, so that each needs a colour of its own.
TEST(Colouring, MoreColoursThanAWordHasBits) {
  constexpr Index kCount = 150;
  Mesh mesh;
  mesh.positions.resize(kCount + 1);
  for (Index a = 0; a < kCount; ++a)
    for (Index b = a + 1; b < kCount; ++b) mesh.elements.add(ElementKind::Triangle, std::array{a, b, kCount});
  std::vector<Index> free(kCount);
  std::iota(free.begin(), free.end(), 0U);
  const Colouring colouring = colour_vertices(mesh, Topology(mesh), free);
  EXPECT_EQ(colouring.class_count(), kCount);
  EXPECT_EQ(colouring.order, free);
}

TEST(ArrangeClasses, KeepsClassesAndTheirMembersAndIsDeterministic) {
  for (const Index every : {1U, 2U, 1000U}) {
    const Mesh mesh = lattice(150, 140, every);
    const Topology topology(mesh);
    const Colouring before = colour_vertices(mesh, topology, shuffled(interior(mesh, topology), 5));
    Colouring after = before, again = before;
    arrange_classes(after, mesh, &kPlane, topology);
    ThreadPool pool(3);
    arrange_classes(again, mesh, &kPlane, topology, &pool);
    EXPECT_EQ(after.order, again.order);
    EXPECT_NE(after.order, before.order);
    ASSERT_EQ(after.class_offsets, before.class_offsets);
    for (Index c = 0; c < before.class_count(); ++c) {
      std::vector<Index> old(before.members(c).begin(), before.members(c).end()), now(after.members(c).begin(), after.members(c).end());
      std::ranges::sort(old);
      std::ranges::sort(now);
      EXPECT_EQ(now, old);
    }
  }
}

TEST(ArrangeClasses, PutsNeighboursInSpaceSideBySide) {
  const Mesh mesh = lattice(64, 64, 1);  // all stars alike, so that space alone decides
  const Topology topology(mesh);
  Colouring colouring = colour_vertices(mesh, topology, shuffled(interior(mesh, topology), 6));
  const auto mean_step = [&] {
    double sum = 0.0;
    for (Index c = 0; c < colouring.class_count(); ++c)
      for (std::size_t i = 1; i < colouring.members(c).size(); ++i)
        sum += length(mesh.positions[colouring.members(c)[i]] - mesh.positions[colouring.members(c)[i - 1]]);
    return sum / static_cast<double>(colouring.order.size());
  };
  EXPECT_GT(mean_step(), 25.0) << "half of the lattice's width, by chance";
  arrange_classes(colouring, mesh, &kPlane, topology);
  EXPECT_LT(mean_step(), 6.0) << "two spacings of a class";
}

TEST(ArrangeClasses, PutsStarsOfOneSizeSideBySide) {
  const Mesh mesh = lattice(40, 40, 3);
  const Topology topology(mesh);
  Colouring colouring = colour_vertices(mesh, topology, shuffled(interior(mesh, topology), 7));
  arrange_classes(colouring, mesh, &kPlane, topology);
  const auto size = [&](Index v) { return topology.star(v).size(); };
  for (Index c = 0; c < colouring.class_count(); ++c) EXPECT_TRUE(std::ranges::is_sorted(colouring.members(c), {}, size)) << c;
}

TEST(ArrangeClasses, CopesWithNothingAndWithAllInOnePlace) {
  Mesh mesh = lattice(10, 10, 1);
  const Topology topology(mesh);
  Colouring none = colour_vertices(mesh, topology, {});
  arrange_classes(none, mesh, &kPlane, topology);
  EXPECT_TRUE(none.order.empty());
  for (Vec3& p : mesh.positions) p = {1e300, -1e300, 0};
  Colouring colouring = colour_vertices(mesh, topology, interior(mesh, topology));
  const std::vector<Index> before = colouring.order;
  arrange_classes(colouring, mesh, &kPlane, topology);
  EXPECT_EQ(colouring.order, before) << "nothing to tell them apart: they keep their order";
}

TEST(Colouring, NothingFreeGivesNoClass) {
  const Mesh mesh = lattice(1, 1, 1);
  const Colouring colouring = colour_vertices(mesh, Topology(mesh), {});
  EXPECT_EQ(colouring.class_count(), 0U);
  EXPECT_TRUE(colouring.order.empty());
}

TEST(Shuffled, IsAPermutationThatDependsOnTheSeedOnly) {
  std::vector<Index> vertices(1000);
  std::iota(vertices.begin(), vertices.end(), 7U);
  const auto a = shuffled(vertices, 42);
  EXPECT_EQ(a, shuffled(vertices, 42));
  EXPECT_NE(a, shuffled(vertices, 43));
  EXPECT_NE(a, vertices);
  auto sorted = a;
  std::ranges::sort(sorted);
  EXPECT_EQ(sorted, vertices);
}

TEST(Shuffled, EveryOrderOfThreeIsAboutEquallyLikely) {
  const std::vector<Index> three{0, 1, 2};
  std::vector<int> count(27, 0);
  for (std::uint64_t seed = 0; seed < 6000; ++seed) {
    const auto s = shuffled(three, seed);
    ++count[s[0] * 9 + s[1] * 3 + s[2]];
  }
  int orders = 0;
  for (const int c : count) {
    if (c == 0) continue;
    ++orders;
    EXPECT_NEAR(c, 1000, 150);  // five standard deviations
  }
  EXPECT_EQ(orders, 6);
}

}  // namespace
}  // namespace dmoscope
