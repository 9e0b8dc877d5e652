// Cuts through solids against closed forms: areas of cuts of a cube, and the divergence theorem over the remaining part.
#include "core/clipping/plane_cut.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/clipping/clipping.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using test::Fill;
using test::volume_grid;

/// Sum of the polygons' areas as vectors.
Vec3 area_of(const PlaneCuts& cuts) {
  Vec3 area{};
  for (const CutPolygon& polygon : cuts.polygons) {
    const Vec3* p = cuts.points.data() + polygon.first;
    for (Index i = 1; i + 1 < polygon.count; ++i) area = area + 0.5 * cross(p[i] - p[0], p[i + 1] - p[0]);
  }
  return area;
}

PlaneCuts cuts_of(const Mesh& mesh, const ClipPlane& plane) {
  PlaneCuts cuts;
  for (Index e = 0; e < mesh.elements.size(); ++e) cut_element(mesh.elements, mesh.positions, e, plane, 1.0, cuts);
  return cuts;
}

class CutOfEachFill : public testing::TestWithParam<Fill> {};
INSTANTIATE_TEST_SUITE_P(PlaneCut, CutOfEachFill, testing::Values(Fill::Hexahedra, Fill::Tetrahedra, Fill::Mixed), [](const auto& tested) {
  return std::string(tested.param == Fill::Hexahedra ? "Hexahedra" : tested.param == Fill::Tetrahedra ? "Tetrahedra" : "Mixed");
});

/// The area of the unit cube's section, tilted, flipped or not, facing the part that was cut away.
TEST_P(CutOfEachFill, AreaOfACubesSections) {
  const Mesh mesh = volume_grid(4, GetParam());
  struct Case {
    Vec3 normal;
    double offset, area;
  };
  const double third = std::sqrt(3.0), half = std::sqrt(2.0);
  for (const Case& c : {Case{{0, 0, 1}, 0.3, 1.0}, Case{{0, 2, 0}, 1.1, 1.0}, Case{{1, 1, 0}, 1.0, half}, Case{{1, 1, 0}, 0.5, half / 2},
                        // The regular hexagon through the middle, and a triangle near a corner.
                        Case{{1, 1, 1}, 1.5, 0.75 * third}, Case{{1, 1, 1}, 0.6, third / 2 * 0.36}, Case{{1, 1, 1}, 3.5, 0.0}}) {
    for (const bool flip : {false, true}) {
      const Vec3 area = area_of(cuts_of(mesh, {.on = true, .normal = c.normal, .offset = c.offset, .flip = flip}));
      const Vec3 wanted = (flip ? -c.area : c.area) / length(c.normal) * c.normal;
      EXPECT_NEAR(length(area - wanted), 0.0, 1e-12) << c.normal.x << c.normal.y << c.normal.z << ' ' << c.offset << flip;
    }
  }
}

/// Shrunk cells have sections of their own; each lies in the plane and within its cell.
TEST_P(CutOfEachFill, PointsLieInThePlane) {
  const Mesh mesh = volume_grid(3, GetParam(), 0.3);
  std::mt19937 random(5);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int turn = 0; turn < 20; ++turn) {
    ClipPlane plane{.on = true, .normal = {unit() - 0.5, unit() - 0.5, unit()}, .offset = 0.0};
    plane.offset = dot(plane.normal, {unit(), unit(), unit()});
    for (const double shrink : {1.0, 0.7}) {
      PlaneCuts cuts;
      for (Index e = 0; e < mesh.elements.size(); ++e) cut_element(mesh.elements, mesh.positions, e, plane, shrink, cuts);
      std::size_t points = 0;
      for (const CutPolygon& polygon : cuts.polygons) {
        EXPECT_GE(polygon.count, 3U);
        EXPECT_EQ(polygon.first, points);
        points += polygon.count;
      }
      EXPECT_EQ(points, cuts.points.size());
      for (const Vec3& p : cuts.points) ASSERT_NEAR(plane.beyond(p), 0.0, 1e-14);
    }
  }
}

/// A tetrahedron grid cut by any plane is cut without a gap, so the sections' area is that of the cube whatever the inner vertices are.
TEST(PlaneCut, InnerVerticesDoNotChangeTheAreaOfTetrahedra) {
  const Mesh plain = volume_grid(4, Fill::Tetrahedra), moved = volume_grid(4, Fill::Tetrahedra, 0.2);
  for (const double offset : {0.21, 0.5, 0.83}) {
    const ClipPlane plane{.on = true, .normal = {0.2, 0.1, 1.0}, .offset = offset};
    EXPECT_NEAR(length(area_of(cuts_of(plain, plane)) - area_of(cuts_of(moved, plane))), 0.0, 1e-12);
  }
}

/// Corners of one side that touch only across a face are cut off one by one, the same from both sides of that face.
TEST(PlaneCut, AFaceWithOppositeCornersBeyondIsCutTwice) {
  Mesh mesh = volume_grid(1, Fill::Hexahedra);
  mesh.positions[4].z = 2.0;  // over (0, 0)
  mesh.positions[7].z = 2.0;  // over (1, 1)
  const PlaneCuts cuts = cuts_of(mesh, {.on = true, .normal = {0, 0, 1}, .offset = 1.5});
  ASSERT_EQ(cuts.polygons.size(), 2U);
  EXPECT_EQ(cuts.polygons[0].count, 3U);
  EXPECT_EQ(cuts.polygons[1].count, 3U);
  // Each is the triangle over a corner: from the upright edge half-way along two edges that fall by 1 over a length of 1.
  EXPECT_NEAR(length(area_of(cuts) - Vec3{0, 0, 0.25}), 0.0, 1e-15);
}

TEST(PlaneCut, OnlyWhatIsVisibleIsCut) {
  const Mesh mesh = volume_grid(4, Fill::Hexahedra);
  const FaceNeighbours neighbours(mesh);
  std::vector<float> quality(mesh.elements.size(), 1.0F);
  for (std::size_t e = 0; e < quality.size(); e += 2) quality[e] = 0.5F;
  Clipping inside(mesh.elements, neighbours);
  ClippingView view;
  view.clip = {.on = true, .normal = {0, 0, 1}, .offset = 0.4, .mode = ClipPlane::Mode::Cut};
  const CellState state{mesh.positions, quality, {}, 1};
  EXPECT_NEAR(area_of(inside.update(view, state).cuts).z, 1.0, 1e-14);
  view.isolate = std::pair{0.0F, 0.6F};
  EXPECT_NEAR(area_of(inside.update(view, state).cuts).z, 0.5, 1e-14);
  view.clip.mode = ClipPlane::Mode::Crinkle;
  EXPECT_TRUE(inside.update(view, state).cuts.polygons.empty());
  // Between two layers nothing is cut: the faces there are drawn.
  view = {};
  view.clip = {.on = true, .normal = {0, 0, 1}, .offset = 0.5, .mode = ClipPlane::Mode::Cut};
  EXPECT_TRUE(inside.update(view, state).cuts.polygons.empty());
  EXPECT_EQ(inside.faces().visible_cells, 32U);
  view.clip.flip = true;
  EXPECT_EQ(inside.update(view, state).visible_cells, 32U);
  EXPECT_TRUE(inside.faces().cuts.polygons.empty());
}

}  // namespace
}  // namespace dmoscope
