// A mesh in drawing order.
#include "render/draw_order.h"

#include <algorithm>
#include <numeric>

#include "core/mesh/topology.h"
#include "fixture.h"

namespace dmoscope::render {
namespace {

TEST(DrawOrder, HasEveryElementOnceWithItsCornersAndItsSlot) {
  const Mesh mesh = wavy_sheet(70, 40);
  const auto layout = build_layout(std::make_shared<const Mesh>(mesh), Plane{});
  std::vector<Index> seen;
  Index before = 0;
  for (const Batch& batch : layout->batches) {
    const std::vector<Index> corners = layout->corners_of(batch);
    for (Index drawn = 0; drawn < batch.size(); ++drawn) {
      const Index element = batch.order[drawn];
      seen.push_back(element);
      EXPECT_EQ(layout->slots[element], before + drawn);
      EXPECT_TRUE(std::ranges::equal(std::span(corners).subspan(std::size_t{drawn} * batch.corner_count, batch.corner_count),
                                     mesh.elements.corners(element)));
    }
    before += batch.size();
  }
  std::ranges::sort(seen);
  std::vector<Index> all(mesh.elements.size());
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(seen, all);
}

TEST(DrawOrder, BoxesOfBlocksAreThoseOfTheirElements) {
  const Mesh mesh = wavy_sheet(70, 40);
  const auto layout = build_layout(std::make_shared<const Mesh>(mesh), Plane{});
  Placement placement(layout);
  std::vector<Vec3> moved = mesh.positions;
  for (std::size_t v = 0; v < moved.size(); ++v) moved[v].x += 0.1 * static_cast<double>(v % 7);
  placement.move(moved);
  Index blocks = 0;
  for (std::size_t k = 0; k < layout->batches.size(); ++k) {
    const Batch& batch = layout->batches[k];
    for (Index b = 0; b < batch.block_count(); ++b, ++blocks) {
      Bounds2 box;
      for (Index drawn = batch.block(b).first; drawn < batch.block(b).last; ++drawn)
        for (const Index v : mesh.elements.corners(batch.order[drawn])) box.include(Vec2<double>{moved[v].x, moved[v].y});
      EXPECT_EQ(placement.block_bounds(k, b).low, box.low);
      EXPECT_EQ(placement.block_bounds(k, b).high, box.high);
    }
  }
  EXPECT_GT(blocks, 3U);
}

TEST(DrawOrder, FindsTheSameBoundaryWhereItIsKnownAtWhichVerticesItRuns) {
  Mesh mesh = wavy_sheet(30, 20);
  // Adds an element apart from the others, and a third one on an edge.
  const Index loose = mesh.vertex_count();
  for (const Vec3 p : {Vec3{50, 0, 0}, Vec3{51, 0, 0}, Vec3{50, 1, 0}}) mesh.positions.push_back(p);
  const Index apart[] = {loose, loose + 1, loose + 2}, third[] = {40, 41, loose};
  mesh.elements.add(ElementKind::Triangle, apart);
  mesh.elements.add(ElementKind::Triangle, third);
  const Topology topology(mesh);
  const auto known = build_layout(std::make_shared<const Mesh>(mesh), Plane{}, topology.boundary())->boundary_edges;
  const auto found = build_layout(std::make_shared<const Mesh>(mesh), Plane{})->boundary_edges;
  EXPECT_EQ(known, found);
  EXPECT_EQ(found.size(), 2U * (30 + 20) + 3 + 2);
}

}  // namespace
}  // namespace dmoscope::render
