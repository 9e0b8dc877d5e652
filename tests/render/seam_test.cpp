// Meshes in longitude and latitude that wrap: elements across the seam do not cover the others.
#include <array>

#include <gtest/gtest.h>

#include "tests/render/fixture.h"

namespace dmoscope::render {
namespace {

/// Twelve quadrilaterals around the Earth, the last one across the seam: inverted, so that it would lie above all.
Mesh band() {
  Mesh mesh;
  for (const double y : {-60.0, 60.0})
    for (int i = 0; i < 12; ++i) mesh.positions.push_back({30.0 * i - 180.0, y, 0.0});
  for (Index i = 0; i < 12; ++i) {
    const Index next = (i + 1) % 12;
    mesh.elements.add(ElementKind::Quadrilateral, std::array<Index, 4>{i, next, next + 12, i + 12});
  }
  return mesh;
}

Plane wrapped(double cut) {
  Plane plane;
  plane.period = 360.0;
  plane.west = -180.0;
  plane.cut = cut;
  return plane;
}

TEST_F(WithContext, WhatLiesAcrossTheSeamDoesNotCoverTheRest) {
  const Mesh mesh = band();
  scene->set_mesh(mesh, wrapped(-180.0));
  std::vector<float> quality(12, 0.25F);
  quality[11] = -0.5F;
  std::vector<std::uint8_t> inverted(12, 0);
  inverted[11] = 1;
  scene->update(mesh.positions, quality, inverted);
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport);
  Style style = flat_style();
  const auto pixel = [&](double x, double y) { return camera.to_pixel({x, y}, kViewport); };
  const Image image = picture(camera, style);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) ASSERT_FALSE(near_colour(image.at(x, y), kInvertedColour)) << x << ' ' << y;
  for (const double x : {-165.0, -15.0, 130.0}) {
    const Vec2<double> at = pixel(x, 11.0);
    EXPECT_TRUE(near_colour(image.at(static_cast<int>(at.x), static_cast<int>(at.y)), sample(ColourMap::Viridis, 0.25)));
  }
  EXPECT_EQ(scene->pick(camera, kViewport, pixel(-15.0, 11.0)).element, 5U);
  {
    PlanarScene plain;
    plain.set_mesh(mesh, Plane{});
    plain.update(mesh.positions, quality, inverted);
    EXPECT_EQ(plain.pick(camera, kViewport, pixel(-15.0, 11.0)).element, 11U) << "taken plainly it covers all";
  }
  // Its edges belong to the boundary, too: without them the rims are those of the other elements, which end at 150 degrees.
  style.boundary = true;
  style.boundary_width = 3.0F;
  scene->update(mesh.positions, quality, {});
  const Image rims = picture(camera, style);
  const Vec2<double> rim = pixel(-15.0, 60.0);
  EXPECT_FALSE(near_colour(rims.at(static_cast<int>(rim.x), static_cast<int>(rim.y)), style.background, 20)) << "the others' rim";
}

TEST_F(WithContext, APieceAcrossTheSeamIsDrawnWhole) {
  Mesh mesh = band();
  mesh.elements = {};
  for (const Index i : {10U, 11U, 0U}) {
    const Index next = (i + 1) % 12;
    mesh.elements.add(ElementKind::Quadrilateral, std::array<Index, 4>{i, next, next + 12, i + 12});
  }
  scene->set_mesh(mesh, wrapped(100.0));
  scene->update(mesh.positions, std::vector<float>{0.2F, 0.5F, 0.8F}, std::vector<std::uint8_t>(3, 0));
  EXPECT_NEAR(scene->bounds().low.x, 120.0, 1e-9);
  EXPECT_NEAR(scene->bounds().high.x, 210.0, 1e-9);
  const Camera2D camera = Camera2D::fit(scene->bounds(), kViewport);
  const Image image = picture(camera, flat_style());
  const std::array colours{0.2, 0.5, 0.8};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2<double> at = camera.to_pixel({135.0 + 30.0 * static_cast<double>(k), 7.0}, kViewport);
    EXPECT_TRUE(near_colour(image.at(static_cast<int>(at.x), static_cast<int>(at.y)), sample(ColourMap::Viridis, colours[k])));
    EXPECT_EQ(scene->pick(camera, kViewport, at).element, static_cast<Index>(k));
  }
}

}  // namespace
}  // namespace dmoscope::render
