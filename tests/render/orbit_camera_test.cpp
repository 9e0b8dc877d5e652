// Looking at a volume mesh: what is where in the picture, by geometry worked out by hand.
#include "render/orbit_camera.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace dmoscope::render {
namespace {

constexpr Vec2<double> kSize{300, 200};
constexpr Bounds3 kBox{{-1, -2, -3}, {3, 2, 1}};

void expect_near(Vec3 got, Vec3 wanted, double tolerance = 1e-12) {
  EXPECT_NEAR(got.x, wanted.x, tolerance);
  EXPECT_NEAR(got.y, wanted.y, tolerance);
  EXPECT_NEAR(got.z, wanted.z, tolerance);
}

void expect_straight(const OrbitCamera& camera) {
  EXPECT_NEAR(length(camera.right), 1.0, 1e-12);
  EXPECT_NEAR(length(camera.up), 1.0, 1e-12);
  EXPECT_NEAR(dot(camera.right, camera.up), 0.0, 1e-12);
}

/// A pixel as ray() and the mouse count it.
Vec2<double> pixel_of(const OrbitCamera& camera, Vec3 point) {
  const auto place = camera.projection(kSize, kBox).place(point);
  return place ? Vec2<double>{0.5 * kSize.x + place->x, 0.5 * kSize.y - place->y} : Vec2<double>{-1e9, -1e9};
}

TEST(OrbitCamera, PresetsLookFromWhereTheySay) {
  OrbitCamera camera;
  const std::pair<const char*, Vec3> wanted[] = {{"+x", {1, 0, 0}},
                                                 {"-x", {-1, 0, 0}},
                                                 {"+y", {0, 1, 0}},
                                                 {"-y", {0, -1, 0}},
                                                 {"+z", {0, 0, 1}},
                                                 {"-z", {0, 0, -1}},
                                                 {"iso", {std::sqrt(1.0 / 3), -std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)}}};
  EXPECT_EQ(view_preset_table().size(), std::size(wanted));
  for (const auto& [name, back] : wanted) {
    SCOPED_TRACE(name);
    camera.look_from(view_preset_from_name(name));
    expect_near(camera.back(), back);
    expect_straight(camera);
    EXPECT_GE(camera.up.z, 0.0);
  }
  EXPECT_THROW(static_cast<void>(view_preset_from_name("+w")), UsageError);
}

TEST(OrbitCamera, FitShowsTheWholeBoxAndTouchesTheMargin) {
  for (const bool perspective : {false, true}) {
    for (const ViewPresetInfo& preset : view_preset_table()) {
      SCOPED_TRACE(preset.name);
      OrbitCamera camera;
      camera.perspective = perspective;
      camera.look_from(preset.preset);
      camera.fit(kBox, kSize, 20.0);
      double slack = 1e9;
      for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec2<double> p =
            pixel_of(camera, {(corner & 1U) != 0 ? -1.0 : 3.0, (corner & 2U) != 0 ? -2.0 : 2.0, (corner & 4U) != 0 ? -3.0 : 1.0});
        slack = std::min({slack, p.x, kSize.x - p.x, p.y, kSize.y - p.y});
      }
      EXPECT_GE(slack, 19.999);
      EXPECT_LE(slack, 31.0);  // 20 pixels of the shorter side are more of the longer one
    }
  }
  OrbitCamera camera;
  camera.fit({}, kSize);
  EXPECT_GT(camera.height, 0.0);
  camera.fit({{5, 5, 5}, {5, 5, 5}}, kSize);
  expect_near(camera.centre, {5, 5, 5});
  EXPECT_GT(camera.height, 0.0);
}

TEST(OrbitCamera, RaysAndProjectionAgree) {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (const bool perspective : {false, true}) {
    OrbitCamera camera;
    camera.perspective = perspective;
    camera.fit(kBox, kSize);
    for (int turn = 0; turn < 50; ++turn) {
      camera.turn({100 * unit() - 50, 100 * unit() - 50}, kSize);
      const Vec3 point{4 * unit() - 1, 4 * unit() - 2, 4 * unit() - 3};
      const ViewRay ray = camera.ray(pixel_of(camera, point), kSize);
      EXPECT_NEAR(length(cross(point - ray.from, ray.direction)), 0.0, 1e-10);
      EXPECT_NEAR(length(ray.direction), 1.0, 1e-12);
      EXPECT_GE(dot(point - ray.from, ray.direction), ray.first);
    }
  }
}

/// All of the box lies between the nearest and the farthest depth, and depths grow away from the eye.
TEST(OrbitCamera, DepthsOfTheBoxAreInRangeAndInOrder) {
  for (const bool perspective : {false, true}) {
    OrbitCamera camera;
    camera.perspective = perspective;
    camera.look_from(ViewPreset::Isometric);
    camera.fit(kBox, kSize);
    const Projection projection = camera.projection(kSize, kBox);
    double before = -1.0;
    for (int i = 0; i <= 10; ++i) {
      const double depth = projection.depth(kBox.centre() + (0.5 - 0.1 * i) * 2.0 * kBox.radius() * camera.back());
      EXPECT_GT(depth, before);
      EXPECT_LT(depth, 1.0);
      before = depth;
    }
  }
}

TEST(OrbitCamera, APartOfThePictureIsThatPart) {
  OrbitCamera camera;
  camera.perspective = true;
  camera.look_from(ViewPreset::Isometric);
  camera.fit(kBox, kSize);
  const PicturePart part{{60, 40}, {160, 100}};
  const Projection whole = camera.projection(kSize, kBox), cut = camera.projection(kSize, kBox, part);
  const Vec3 point{0.3, -0.4, 0.2};
  const Vec2<double> a = *whole.place(point), b = *cut.place(point);
  // In pixels of the whole from its left upper corner.
  EXPECT_NEAR(150 + a.x, 110 + b.x, 1e-9);
  EXPECT_NEAR(100 - a.y, 70 - b.y, 1e-9);
  EXPECT_EQ(cut.viewport().x, 100.0);
}

TEST(OrbitCamera, WhatIsBehindTheEyeHasNoPlace) {
  OrbitCamera camera;
  camera.perspective = true;
  camera.fit(kBox, kSize);
  const Projection projection = camera.projection(kSize, kBox);
  EXPECT_FALSE(projection.place(camera.eye() + camera.back()));
  EXPECT_TRUE(projection.place(camera.eye() - camera.back()));
}

/// The front of the mesh follows the mouse.
TEST(OrbitCamera, TurningFollowsTheMouseAndStaysUpright) {
  OrbitCamera camera;
  camera.look_from(ViewPreset::MinusY);
  camera.turn({10, 0}, kSize);
  EXPECT_LT(camera.back().x, 0.0);  // the eye went left, so the mesh turned right
  EXPECT_NEAR(camera.back().z, 0.0, 1e-12);
  camera.turn({0, 20}, kSize);
  EXPECT_GT(camera.back().z, 0.0);  // and up
  EXPECT_NEAR(camera.right.z, 0.0, 1e-12);
  camera.turn({0, 1e5}, kSize);
  EXPECT_NEAR(camera.back().z, 1.0, 1e-12);  // no farther than straight above
  const Vec3 right = camera.right;
  camera.turn({0, -20}, kSize);
  expect_near(camera.right, right, 1e-9);  // comes back the way it went
  for (int i = 0; i < 10000; ++i) camera.turn({13, i % 2 == 0 ? 31.0 : -30.0}, kSize);
  expect_straight(camera);
}

TEST(OrbitCamera, ATurnOverTheShorterSideIsHalfARound) {
  OrbitCamera camera;
  camera.look_from(ViewPreset::MinusY);
  camera.turn({kSize.y, 0}, kSize);
  expect_near(camera.back(), {0, 1, 0});
}

TEST(OrbitCamera, RollingTakesThePointAlongOnTheBall) {
  OrbitCamera camera;
  camera.look_from(ViewPreset::PlusZ);
  camera.height = 2.0;  // the ball of radius 1 fills the viewport
  const Vec2<double> from{150, 100}, to{170, 70};
  const Vec3 point{0, 0, 1};  // on the ball under `from`
  camera.roll(from, to, kSize);
  const Vec2<double> at = pixel_of(camera, point);
  EXPECT_NEAR(at.x, to.x, 1e-9);
  EXPECT_NEAR(at.y, to.y, 1e-9);
  for (int i = 0; i < 1000; ++i) camera.roll({20, 30}, {250, 170}, kSize);
  expect_straight(camera);
  camera.turn({0, 0}, kSize);
  EXPECT_NEAR(camera.right.z, 0.0, 1e-12);  // upright again
}

TEST(OrbitCamera, PanningMovesWhatIsSeenWithTheMouse) {
  for (const bool perspective : {false, true}) {
    OrbitCamera camera;
    camera.perspective = perspective;
    camera.look_from(ViewPreset::Isometric);
    camera.fit(kBox, kSize);
    const Vec3 point = camera.centre;
    camera.pan({12, -7}, kSize);
    const Vec2<double> at = pixel_of(camera, point);
    EXPECT_NEAR(at.x, 162.0, 1e-9);
    EXPECT_NEAR(at.y, 93.0, 1e-9);
  }
}

TEST(OrbitCamera, ZoomingKeepsThePointUnderTheCursor) {
  for (const bool perspective : {false, true}) {
    OrbitCamera camera;
    camera.perspective = perspective;
    camera.look_from(ViewPreset::Isometric);
    camera.fit(kBox, kSize);
    const Vec2<double> cursor{40, 150};
    const double unit = camera.units_per_pixel(kSize);
    const Vec3 point = camera.centre + unit * (cursor.x - 150) * camera.right - unit * (cursor.y - 100) * camera.up;
    const double height = camera.height;
    camera.zoom_at(cursor, kSize, 2.5);
    EXPECT_NEAR(camera.height, height / 2.5, 1e-12);
    const Vec2<double> at = pixel_of(camera, point);
    EXPECT_NEAR(at.x, cursor.x, 1e-9);
    EXPECT_NEAR(at.y, cursor.y, 1e-9);
    for (int i = 0; i < 2000; ++i) camera.zoom_at(cursor, kSize, i < 1000 ? 10.0 : 0.1);
    EXPECT_TRUE(std::isfinite(camera.height) && camera.height > 0.0 && std::isfinite(length(camera.centre)));
  }
}

}  // namespace
}  // namespace dmoscope::render
