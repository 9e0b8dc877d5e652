// Vertices that belong to others: they are found, and stay together where they could slide.

#include "core/mesh/ties.h"

#include <algorithm>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/input/input_mesh.h"
#include "core/reference/hold.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::input;

Mesh extruded(const Mesh& flat, int cells) {
  Mesh mesh;
  const Index n = flat.vertex_count();
  for (int k = 0; k <= cells; ++k)
    for (const Vec3& p : flat.positions) mesh.positions.push_back({p.x, p.y, 0.05 * k});
  for (int k = 0; k < cells; ++k)
    for (Index e = 0; e < flat.elements.size(); ++e) {
      std::vector<Index> corners;
      for (const int side : {k, k + 1})
        for (const Index v : flat.elements.corners(e)) corners.push_back(v + static_cast<Index>(side) * n);
      mesh.elements.add(corners.size() == 8 ? ElementKind::Hexahedron : ElementKind::Wedge, corners);
    }
  return mesh;
}

std::size_t count(const std::vector<Tie>& ties, Tie tie) { return static_cast<std::size_t>(std::ranges::count(ties, tie)); }
std::vector<Tie> ties_of(const InputMesh& mesh) { return find_ties(mesh.mesh, mesh.topology, mesh.faces); }

TEST(Ties, AMeshOneCellThickIsOneOfPairs) {
  for (const auto cells : {testing::Cells::Quadrilaterals, testing::Cells::Mixed}) {
    const auto thin = input(extruded(testing::lattice(5, 0.2, 1, cells), 1));
    EXPECT_EQ(count(ties_of(*thin), Tie::Pair), thin->mesh.vertex_count());
    const auto thick = input(extruded(testing::lattice(5, 0.2, 1, cells), 3));
    EXPECT_EQ(count(ties_of(*thick), Tie::None), thick->mesh.vertex_count());
  }
}

TEST(Ties, DoublesOfASeamAreFoundAndNeighboursAreNot) {
  Mesh mesh = testing::lattice(4, 0.0, 1, testing::Cells::Quadrilaterals);
  const Mesh other = testing::lattice(4, 0.0, 1, testing::Cells::Quadrilaterals);
  const Index n = mesh.vertex_count();
  for (const Vec3& p : other.positions) mesh.positions.push_back({p.x + 1.0, p.y, 0.0});
  for (Index e = 0; e < other.elements.size(); ++e) {
    std::vector<Index> corners(other.elements.corners(e).begin(), other.elements.corners(e).end());
    for (Index& v : corners) v += n;
    mesh.elements.add(ElementKind::Quadrilateral, corners);
  }
  const auto seam = input(std::move(mesh));
  const auto ties = ties_of(*seam);
  EXPECT_EQ(count(ties, Tie::Double), 10U);
  const auto partners = find_partners(seam->mesh, seam->topology);
  ASSERT_EQ(partners.size(), 5U);
  for (const auto& [first, second, shift] : partners) {
    EXPECT_LT(first, second);
    EXPECT_EQ(seam->mesh.positions[first], seam->mesh.positions[second]);
    EXPECT_EQ(shift, Vec3{});
  }
  Mesh paired = seam->mesh;
  paired.periodic = {{partners[0].first, 0}, {partners[1].second, 0}};
  EXPECT_EQ(partners_of(*input(std::move(paired))).size(), 3U) << "others that the file pairs";
  for (Index v = 0; v < seam->mesh.vertex_count(); ++v) EXPECT_EQ(ties[v] == Tie::Double, seam->mesh.positions[v].x == 1.0) << v;
}

}  // namespace
}  // namespace dmoscope
