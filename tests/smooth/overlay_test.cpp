// The facets of a surface: the nearest one, the way over them, and how far a triangle laid over them deviates, against plain geometry.

#include "core/reference/overlay.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/smooth/zoo.h"
#include "tests/support/plain_surface.h"

namespace dmoscope {
namespace {

using namespace testing;

TEST(FacetTree, FindsTheNearestOfItsPatch) {
  dmoscope::testing::Random random(4);
  for (const double width : {1.0, 1e-3, 1e-8}) {  // includes needles
    std::vector<Vec3> points;
    std::vector<std::array<Vec3, 3>> triangles;
    std::vector<Index> patch_of;
    for (Index i = 0; i < 60; ++i) {
      const Vec3 a{random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)}, b = a + Vec3{random(-0.5, 0.5), random(-0.5, 0.5), 0.3};
      const Vec3 c = a + 0.4 * (b - a) + width * Vec3{random(-0.3, 0.3), random(-0.3, 0.3), random(-0.3, 0.3)};
      triangles.push_back({a, b, c});
      patch_of.push_back(i % 3);
    }
    const FacetTree tree(triangles, patch_of);
    for (int k = 0; k < 300; ++k) {
      // Anywhere, and on one of the triangles.
      const auto& t = triangles[static_cast<std::size_t>(k) % triangles.size()];
      const double u = random(0.0, 0.5), v = random(0.0, 0.5);
      const bool on_one = k % 2 == 0;
      const Vec3 p = on_one ? t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) : Vec3{random(-2.0, 2.0), random(-2.0, 2.0), random(-2.0, 2.0)};
      const Index patch = on_one ? patch_of[static_cast<std::size_t>(k) % triangles.size()] : static_cast<Index>(k / 2 % 3);
      double least = 1e9;
      for (std::size_t i = patch; i < triangles.size(); i += 3)
        least = std::min(least, distance_to_triangle(p, triangles[i][0], triangles[i][1], triangles[i][2]));
      const auto found = tree.nearest(p, patch);
      ASSERT_EQ(patch_of[found.triangle], patch);
      for (Index near = patch; near < 60; near += 3) {  // from any start of the search
        const auto again = tree.nearest(p, near);
        ASSERT_EQ(again.triangle, found.triangle);
        ASSERT_EQ(again.point.weights, found.point.weights);
      }
      if (on_one) {
        ASSERT_LE(std::sqrt(found.point.square), 1e-14) << "width " << width;
      } else {
        ASSERT_NEAR(std::sqrt(found.point.square), least, 1e-9) << "width " << width;
      }
    }
  }
}

/// A hilly square; facet 0 is at a corner.
std::shared_ptr<const InputMesh> hills(std::uint64_t seed, Cells cells) {
  return input(mapped(lattice(12, 0.3, seed, cells), [](Vec3 p) {
    return Vec3{p.x, p.y, 0.05 * std::sin(6 * p.x + 1) * std::cos(5 * p.y)};
  }));
}

TEST(Overlay, IsTheGreatestDistance) {
  dmoscope::testing::Random random(6);
  std::size_t laid = 0;
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const auto mesh = hills(6, cells);
    const Domain domain(*mesh, {});
    const Facets& facets = domain.faces().facets();
    ASSERT_TRUE(domain.faces().any());
    const auto triangles = triangles_of(surface_faces(mesh->mesh), mesh->mesh.positions);
    ASSERT_EQ(facets.facets().size(), triangles.size());
    OverlayRoom room;
    Overlay overlay(domain, room);
    for (int k = 0; k < 60; ++k) {
      const Vec2<double> centre{random(0.2, 0.8), random(0.2, 0.8)};
      std::array<Vec3, 3> corners;
      Index from = kNoIndex;
      for (std::size_t i = 0; i < 3; ++i) {
        const double angle = 2.1 * static_cast<double>(i) + random(-0.4, 0.4);
        const auto place = facets.walk(0, Plane{}, {}, {centre.x + 0.17 * std::cos(angle), centre.y + 0.17 * std::sin(angle)}, 0.0);
        ASSERT_TRUE(place);
        corners[i] = facets.at(*place);
        ASSERT_NEAR(corners[i].x, centre.x + 0.17 * std::cos(angle), 1e-9) << "straight down";
        ASSERT_LE(distance_to(corners[i], mesh->mesh.positions, triangles), 1e-14);
        from = place->facet;
      }
      const Fit fit = overlay.triangle(corners, from, {});
      ASSERT_LT(fit.deviation, 1.0);
      ASSERT_GT(fit.least_cosine, 0.8);
      double most = 0.0;
      for (double u = 0.0; u <= 1.0; u += 0.04)
        for (double v = 0.0; u + v <= 1.0; v += 0.04)
          most = std::max(most, distance_to(corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]),
                                            mesh->mesh.positions, triangles));
      ASSERT_LE(most, fit.deviation + 1e-14);
      ASSERT_GE(most, 0.75 * fit.deviation) << "distances along the normal are hardly longer here, and samples hardly miss the greatest";
      ++laid;
    }
  }
  EXPECT_EQ(laid, 180U);
}

/// A face without facets beneath, or turned away, has no fit.
TEST(Overlay, WhatCannotBeIsNoFit) {
  const auto mesh = hills(7, Cells::Triangles);
  const Domain domain(*mesh, {});
  OverlayRoom room;
  Overlay overlay(domain, room);
  const auto at = [&](double x, double y) {
    return domain.faces().facets().at(*domain.faces().facets().walk(0, Plane{}, {}, {x, y}, 0.0));
  };
  const std::array<Vec3, 3> good{at(0.4, 0.4), at(0.6, 0.4), at(0.5, 0.6)};
  EXPECT_LT(overlay.triangle(good, 0, {}).deviation, 0.1);
  EXPECT_EQ(overlay.triangle({good[0], good[2], good[1]}, 0, {}).deviation, kNoFit.deviation) << "turned over";
  EXPECT_EQ(overlay.triangle({good[0], good[1], good[1]}, 0, {}).deviation, kNoFit.deviation) << "a line";
  EXPECT_EQ(overlay.triangle({good[0], good[1], {0.5, 1.4, 0}}, 0, {}).deviation, kNoFit.deviation) << "beyond the boundary";
}

/// With a bound, the faces around a vertex are examined only as far as it takes: the comparison with the bound is the same.
TEST(Overlay, ABoundShortensItOnly) {
  dmoscope::testing::Random random(9);
  int within = 0, beyond = 0;
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const auto mesh = hills(8, cells);
    const Domain domain(*mesh, {});
    const Facets& facets = domain.faces().facets();
    const std::vector<Vec3>& positions = mesh->mesh.positions;
    OverlayRoom room;
    Overlay overlay(domain, room);
    for (Index v = 0; v < positions.size(); ++v) {
      if (!domain.on_surface(v)) continue;
      const auto here = domain.faces().place(v, positions[v]);
      ASSERT_TRUE(here);
      const auto there = facets.walk(here->facet, Plane{}, positions[v], {random(-0.06, 0.06), random(-0.06, 0.06)}, 0.0);
      if (!there) continue;
      const Vec3 target = facets.at(*there);
      const Fit whole = overlay.star(positions, v, target, &*there, kNoFit);
      for (const double size : {1e-4, 1e-3, 2e-3, 4e-3, 1e-2, 0.999 * whole.deviation, 1.001 * whole.deviation}) {
        const Fit bound{size, 2.0 * size, 0.5};
        const bool fits = is_within(whole, bound);
        ASSERT_EQ(is_within(overlay.star(positions, v, target, &*there, bound), bound), fits) << "vertex " << v << ", " << size;
        ++(fits ? within : beyond);
      }
    }
  }
  EXPECT_GT(within, 200);
  EXPECT_GT(beyond, 200);
}

}  // namespace
}  // namespace dmoscope
