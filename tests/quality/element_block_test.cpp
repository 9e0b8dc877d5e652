// Many elements at once have the bits of one after the other.

#include "core/quality/element_block.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "core/base/thread_pool.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::input;
using testing::lattice;

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

/// A mesh with elements of no area, of no extent, inverted ones and sharp ones among the others.
Mesh tangled(Cells cells) {
  Mesh mesh = lattice(24, 0.9, 11, cells);
  for (std::size_t v = 30; v < 500; v += 31) mesh.positions[v] = mesh.positions[v + 1];
  for (std::size_t v = 40; v < 500; v += 57) mesh.positions[v] = 0.5 * (mesh.positions[v - 1] + mesh.positions[v + 1]);
  return mesh;
}

Mesh tilted(Mesh mesh) {
  for (Vec3& p : mesh.positions) p = {0.6 * p.x - 0.3 * p.y + 7.0, 0.2 * p.x + 0.9 * p.y, 0.5 * p.x - 0.1 * p.y};
  return mesh;
}

/// Tilts the mesh so little that one component of the frame's vectors is exactly 1 and the others still count; the vertices are off the
/// plane besides.
Mesh hardly_tilted(Mesh mesh) {
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) mesh.positions[v].z = 3e-9 * mesh.positions[v].x + (v % 2 == 0 ? 4e-7 : -4e-7);
  return mesh;
}

/// Puts the mesh in the plane x = 3 or y = 3.
Mesh upright(Mesh mesh, bool in_yz) {
  for (Vec3& p : mesh.positions) p = in_yz ? Vec3{3.0, p.x, p.y} : Vec3{p.y, 3.0, p.x};
  return mesh;
}

Mesh curved(Mesh mesh) {
  for (Vec3& p : mesh.positions) p.z = std::sin(3.0 * p.x) * std::cos(2.0 * p.y);
  return mesh;
}

void expect_the_very_bits(const InputMesh& mesh) {
  const QualityContext context = mesh.quality_context();
  const std::size_t count = mesh.mesh.elements.size();
  for (const MetricInfo& entry : metric_table()) {
    std::size_t seen = 0;
    for_blocks(context, mesh.mesh.positions, entry.metric, 3, count, [&](const ElementBlock& block) {
      ASSERT_EQ(block.first, 3 + seen);
      for (std::size_t i = 0; i < block.count; ++i) {
        const Index e = block.first + static_cast<Index>(i);
        const double quality = element_quality(context, mesh.mesh.positions, entry.metric, e);
        const double jacobian = smallest_jacobian(context, mesh.mesh.positions, e);
        ASSERT_TRUE(same_bits(block.quality[i], quality)) << entry.name << " " << e << ": " << block.quality[i] << " " << quality;
        ASSERT_EQ(block.jacobian[i], jacobian) << entry.name << " " << e;
      }
      seen += block.count;
    });
    EXPECT_EQ(seen, count - 3) << entry.name;
  }
}

TEST(ElementBlock, HasTheVeryBitsOfEachElementInAnyPlane) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    expect_the_very_bits(*input(tangled(cells)));
    expect_the_very_bits(*input(tilted(tangled(cells))));
    expect_the_very_bits(*input(hardly_tilted(tangled(cells))));
    for (const bool in_yz : {true, false}) expect_the_very_bits(*input(upright(tangled(cells), in_yz)));
  }
}

/// Puts the mesh in degrees, across the meridian of 180.
Mesh across_the_seam(Mesh mesh) {
  for (Vec3& p : mesh.positions) {
    p = {170.0 + 20.0 * p.x, 30.0 * p.y, 0.0};
    if (p.x > 180.0) p.x -= 360.0;
  }
  return mesh;
}

TEST(ElementBlock, HasTheVeryBitsOfEachElementAcrossASeam) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const auto mesh = input(across_the_seam(lattice(24, 0.4, 11, cells)));
    ASSERT_GT(mesh->report.seam_elements, 20U);
    expect_the_very_bits(*mesh);
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e)
      ASSERT_LT(std::abs(smallest_jacobian(mesh->quality_context(), mesh->mesh.positions, e)), 4.0) << "as small as it is unwrapped";
  }
}

TEST(ElementBlock, HasTheVeryBitsOfEachElementOfACurvedSurface) {
  const auto mesh = input(curved(tangled(Cells::Mixed)), Need::QualityOnly);
  ASSERT_EQ(mesh->geometry.shape, Shape::Surface);
  expect_the_very_bits(*mesh);
}

TEST(ElementBlock, HasTheVeryBitsOfEachElementOfAVolume) {
  using test::Fill;
  std::size_t inverted_inside_alone = 0;
  for (const Fill fill : {Fill::Tetrahedra, Fill::Hexahedra, Fill::Mixed})
    for (const double jitter : {0.2, 0.5, 0.9}) {
      Mesh mesh = test::volume_grid(6, fill, jitter, 7);
      for (std::size_t v = 30; v < 200; v += 31) mesh.positions[v] = mesh.positions[v + 1];
      const auto held = input(std::move(mesh));
      expect_the_very_bits(*held);
      for (Index e = 0; e < held->mesh.elements.size(); ++e)
        if (smallest_jacobian(held->quality_context(), held->mesh.positions, e) == 0.0) ++inverted_inside_alone;
    }
  EXPECT_GT(inverted_inside_alone, 0U) << "none that its corners do not tell of";
}

TEST(ElementBlock, ElementQualitiesAreThoseOfEachElementForAnyPool) {
  const auto mesh = input(tangled(Cells::Mixed));
  std::vector<double> qualities(mesh->mesh.elements.size());
  ThreadPool pool(2);
  for (ThreadPool* any : {static_cast<ThreadPool*>(nullptr), &pool}) {
    std::ranges::fill(qualities, -7.0);
    element_qualities(mesh->quality_context(), mesh->mesh.positions, Metric::ScaledJacobian, any, qualities);
    for (Index e = 0; e < qualities.size(); ++e)
      ASSERT_TRUE(same_bits(qualities[e], element_quality(mesh->quality_context(), mesh->mesh.positions, Metric::ScaledJacobian, e))) << e;
  }
}

}  // namespace
}  // namespace dmoscope
