// Views of a volume mesh: places in the picture, against geometry worked out by hand.
#include "render/orbit_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

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

/// The pixel of a point, in the coordinates of ray() and the mouse.
Vec2<double> pixel_of(const OrbitCamera& camera, Vec3 point) {
  const auto place = camera.projection(kSize, kBox).place(point);
  return place ? Vec2<double>{0.5 * kSize.x + place->x, 0.5 * kSize.y - place->y} : Vec2<double>{-1e9, -1e9};
}

TEST(OrbitCamera, FacesWhatLooksAway) {
  OrbitCamera camera;
  camera.look_from(ViewPreset::PlusX);
  const OrbitCamera before = camera;
  camera.face({2, 1, -1});
  EXPECT_EQ(camera, before) << "it is seen from here";
  for (const Vec3 outward : {Vec3{-3, 0, 0}, Vec3{0.2, 5, 1}, Vec3{0, 0, 2}, Vec3{-1, 0, -1000}}) {
    camera.look_from(ViewPreset::PlusX);
    camera.face(outward);
    expect_straight(camera);
    expect_near(camera.back(), (1.0 / length(outward)) * outward);
    EXPECT_TRUE(camera.is_valid());
    if (std::abs(outward.z) < length(outward) * 0.9) {
      EXPECT_GT(camera.up.z, 0.0) << "upright";
      EXPECT_NEAR(camera.right.z, 0.0, 1e-12);
    }
  }
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
      EXPECT_NEAR(slack, 20.0, 1e-6);
    }
  }
  OrbitCamera camera;
  camera.fit({}, kSize);
  EXPECT_GT(camera.height, 0.0);
  camera.fit({{5, 5, 5}, {5, 5, 5}}, kSize);
  expect_near(camera.centre, {5, 5, 5});
  EXPECT_GT(camera.height, 0.0);
}

/// Distance of the nearest of the points from each border of a part of the picture: left, right, below, above; less than 0 beyond it.
std::array<double, 4> spaces(const OrbitCamera& camera, const std::vector<Vec3>& points, Vec2<double> size, const PicturePart& room) {
  Bounds3 box;
  for (const Vec3& p : points) box.include(p);
  const Projection projection = camera.projection(size, box);
  std::array<double, 4> least{1e9, 1e9, 1e9, 1e9};
  for (const Vec3& p : points) {
    const auto place = projection.place(p);
    if (!place) return {-1e9, -1e9, -1e9, -1e9};
    const double x = 0.5 * size.x + place->x, y = 0.5 * size.y - place->y;
    const std::array<double, 4> now{x - room.low.x, room.high.x - x, room.high.y - y, y - room.low.y};
    for (std::size_t i = 0; i < 4; ++i) least[i] = std::min(least[i], now[i]);
  }
  return least;
}

TEST(OrbitCamera, FitOfPointsFillsTheRoomThatIsThere) {
  std::mt19937 random(7);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  // A long thin cloud, far from the origin, along no axis: a box around it is much larger than it is.
  std::vector<Vec3> points;
  for (int i = 0; i < 200; ++i) {
    const double along = 10.0 * unit();
    points.push_back({1000.0 + along + 0.3 * unit(), -500.0 + along, 20.0 - along + 0.5 * unit()});
  }
  const std::pair<Vec2<double>, PicturePart> places[] = {
      {{1280, 400}, {{20, 50}, {1260, 330}}}, {{300, 700}, {{10, 40}, {250, 690}}}, {{400, 400}, {{200, 100}, {390, 390}}}};
  for (const bool perspective : {false, true}) {
    for (const ViewPresetInfo& preset : view_preset_table()) {
      for (const auto& [size, room] : places) {
        SCOPED_TRACE(std::string(preset.name) + (perspective ? " perspective" : ""));
        OrbitCamera camera;
        camera.perspective = perspective;
        camera.look_from(preset.preset);
        camera.turn({13, 7}, size);
        const Vec3 right = camera.right;
        camera.fit(points, size, room);
        EXPECT_EQ(camera.right, right);
        const auto space = spaces(camera, points, size, room);
        for (const double each : space) EXPECT_GE(each, -1e-6);
        const bool touches_sides = space[0] < 1e-6 && space[1] < 1e-6, touches_ends = space[2] < 1e-6 && space[3] < 1e-6;
        EXPECT_TRUE(touches_sides || touches_ends);
        const double in_depth = dot(camera.back(), camera.centre - points.front());
        EXPECT_LT(std::abs(in_depth), 20.0) << "what it is turned about is among the points";
      }
    }
  }
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
  // Places are in pixels of the whole from its upper left corner.
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
TEST(OrbitCamera, AnotherAxisCanBeUp) {
  OrbitCamera camera;
  camera.up_axis = UpAxis::Y;
  for (const ViewPreset preset : {ViewPreset::PlusX, ViewPreset::MinusX, ViewPreset::PlusZ, ViewPreset::MinusZ}) {
    camera.look_from(preset);
    expect_near(camera.up, {0, 1, 0});
    expect_straight(camera);
  }
  camera.look_from(ViewPreset::PlusZ);
  expect_near(camera.right, {1, 0, 0});  // the usual axes on paper
  camera.look_from(ViewPreset::PlusY);
  expect_near(camera.back(), {0, 1, 0});
  camera.look_from(ViewPreset::Isometric);
  expect_near(camera.back(), {std::sqrt(1.0 / 3), std::sqrt(1.0 / 3), std::sqrt(1.0 / 3)});
  for (int i = 0; i < 100; ++i) camera.turn({13, i % 2 == 0 ? 31.0 : -30.0}, kSize);
  EXPECT_NEAR(camera.right.y, 0.0, 1e-9) << "level";
  EXPECT_GT(camera.up.y, 0.0);
  camera.turn({0, 1e5}, kSize);
  expect_near(camera.back(), {0, 1, 0}, 1e-9);
}

TEST(OrbitCamera, TheOtherAxisUpShowsAsMuchOfWhatIsTurnedAlong) {
  OrbitCamera camera;
  camera.look_from(ViewPreset::Isometric);
  camera.turn({40, 25}, kSize);
  const Vec3 point{0.3, -0.2, 0.7}, turned{point.x, point.z, -point.y};
  const double right = dot(camera.right, point), up = dot(camera.up, point);
  const OrbitCamera before = camera;
  camera.raise(UpAxis::Y);
  EXPECT_NEAR(dot(camera.right, turned), right, 1e-12);
  EXPECT_NEAR(dot(camera.up, turned), up, 1e-12);
  camera.raise(UpAxis::Z);
  expect_near(camera.right, before.right, 1e-12);
  expect_near(camera.up, before.up, 1e-12);
}

TEST(OrbitCamera, TurningFollowsTheMouseAndStaysUpright) {
  OrbitCamera camera;
  camera.look_from(ViewPreset::MinusY);
  camera.turn({10, 0}, kSize);
  EXPECT_LT(camera.back().x, 0.0);  // the eye went left, so the mesh turned right
  EXPECT_NEAR(camera.back().z, 0.0, 1e-12);
  camera.turn({0, 20}, kSize);
  EXPECT_GT(camera.back().z, 0.0);  // the eye went up
  EXPECT_NEAR(camera.right.z, 0.0, 1e-12);
  camera.turn({0, 1e5}, kSize);
  EXPECT_NEAR(camera.back().z, 1.0, 1e-12);  // not beyond straight above
  const Vec3 right = camera.right;
  camera.turn({0, -20}, kSize);
  expect_near(camera.right, right, 1e-9);  // comes back the same way
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
