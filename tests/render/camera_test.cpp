#include "render/camera.h"

#include <gtest/gtest.h>

namespace dmoscope::render {
namespace {

constexpr Vec2<double> kView{1280, 800};

TEST(Camera2D, PixelsAndPlaneRoundTrip) {
  Camera2D camera;
  camera.centre = {1e6 + 17.25, -3e5};
  camera.units_per_pixel = 0.37;
  for (const Vec2<double> pixel : {Vec2<double>{0, 0}, Vec2<double>{1279.5, 12.25}, Vec2<double>{640, 400}}) {
    const Vec2<double> back = camera.to_pixel(camera.to_plane(pixel, kView), kView);
    EXPECT_NEAR(back.x, pixel.x, 1e-6);
    EXPECT_NEAR(back.y, pixel.y, 1e-6);
  }
  EXPECT_GT(camera.to_plane({640, 0}, kView).y, camera.centre.y) << "y is up in the plane, down in pixels";
}

TEST(Camera2D, ZoomKeepsThePointUnderTheCursor) {
  Camera2D camera;
  camera.centre = {4e5, 5.1e6};
  camera.units_per_pixel = 12.0;
  const Vec2<double> cursor{200, 700}, held = camera.to_plane(cursor, kView);
  for (int i = 0; i < 40; ++i) {
    camera.zoom_at(cursor, kView, i < 30 ? 1.3 : 0.6);
    const Vec2<double> now = camera.to_pixel(held, kView);
    EXPECT_NEAR(now.x, cursor.x, 0.01);
    EXPECT_NEAR(now.y, cursor.y, 0.01);
  }
  const double before = camera.units_per_pixel;
  camera.zoom_at(cursor, kView, 2.0);
  EXPECT_DOUBLE_EQ(camera.units_per_pixel, before / 2);
  camera.zoom_at(cursor, kView, 0.0);
  EXPECT_DOUBLE_EQ(camera.units_per_pixel, before / 2);
}

TEST(Camera2D, FitShowsAllWithAMargin) {
  const Bounds2 box{{-3, 10}, {7, 90}};
  const Camera2D camera = Camera2D::fit(box, kView, 24);
  const Vec2<double> low = camera.to_pixel(box.low, kView), high = camera.to_pixel(box.high, kView);
  EXPECT_NEAR(low.y, 800 - 24, 1e-9);
  EXPECT_NEAR(high.y, 24, 1e-9);
  EXPECT_GE(low.x, 24);
  EXPECT_NEAR((low.x + high.x) / 2, 640, 1e-9);
  EXPECT_GT(Camera2D::fit({}, kView).units_per_pixel, 0);
  EXPECT_GT(Camera2D::fit({{5, 5}, {5, 5}}, kView).units_per_pixel, 0);
  EXPECT_GT(Camera2D::fit(box, {0, 0}).units_per_pixel, 0);
}

TEST(Camera2D, PanMovesWhatIsSeenWithTheMouse) {
  Camera2D camera;
  camera.units_per_pixel = 2.0;
  const Vec2<double> point = camera.to_plane({100, 100}, kView);
  camera.pan({30, -20});
  EXPECT_NEAR(camera.to_pixel(point, kView).x, 130, 1e-9);
  EXPECT_NEAR(camera.to_pixel(point, kView).y, 80, 1e-9);
}

TEST(Camera2D, OtherViewportShowsAtLeastTheSame) {
  Camera2D camera;
  const Bounds2 seen = camera.visible(kView), after = camera.for_viewport(kView, {400, 400}).visible({400, 400});
  EXPECT_LE(after.low.x, seen.low.x);
  EXPECT_LE(after.low.y, seen.low.y);
  EXPECT_GE(after.high.x, seen.high.x);
}

}  // namespace
}  // namespace dmoscope::render
