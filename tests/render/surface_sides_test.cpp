// Pictures of surfaces: both sides are visible; of a closed surface only the outside.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/render/volume_picture.h"

namespace dmoscope::render {
namespace {

using SurfacePicture = VolumePicture;

/// A square in the plane x = 1 that looks along +x, in triangles of quality 0.5.
Mesh square_towards_x() {
  Mesh square;
  square.positions = {{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}};
  square.elements.add(ElementKind::Triangle, std::array<Index, 3>{0, 1, 2});
  square.elements.add(ElementKind::Triangle, std::array<Index, 3>{0, 2, 3});
  return square;
}

TEST_F(SurfacePicture, BothSidesOfASurfaceAreSeenTheBackALittleDarker) {
  const Mesh square = square_towards_x();
  const FaceNeighbours sides(square);
  const std::vector<float> half(2, 0.5F);
  const Vec3 there{1, 0.3, 0.6};
  const Rgb front = of_quality(0.5F);
  const auto darker = [](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(0.8 * c)); };
  const Rgb back{darker(front.r), darker(front.g), darker(front.b)};
  const auto has = [](const Image& image, Rgb colour) {
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        if (near_colour(image.at(x, y), colour, 1)) return true;
    return false;
  };
  for (const double detail : {1.0, 0.5}) {
    SCOPED_TRACE(detail);
    space->set_mesh(square.elements, sides);
    space->update({square.positions, half, {}, 0});
    camera.look_from(ViewPreset::PlusX);
    camera.fit(space->bounds(), kViewport, 10.0);
    EXPECT_TRUE(has(shot(flat_style(), detail), front));
    camera.look_from(ViewPreset::MinusX);
    camera.fit(space->bounds(), kViewport, 10.0);
    EXPECT_TRUE(has(shot(flat_style(), detail), back));
    EXPECT_FALSE(has(shot(flat_style(), detail), front));
    EXPECT_TRUE(detail < 1.0 || near_colour(at(shot(), there), back, 1));
    const auto place = camera.projection(kViewport, space->bounds()).place(there);
    EXPECT_NE(space->pick(camera, kViewport, {0.5 * kWidth + place->x, 0.5 * kHeight - place->y}).element, kNoIndex);
    // Inverted elements keep their colour, as on the front.
    const std::vector<std::uint8_t> all_inverted(2, 1);
    space->update({square.positions, half, all_inverted, 0});
    EXPECT_TRUE(has(shot(flat_style(), detail), kInvertedColour));
  }
}

/// The back of a ball lies behind its front, also at the outline.
TEST_F(SurfacePicture, TheBackOfAClosedSurfaceIsHidden) {
  constexpr Index kAround = 24, kHigh = 12;
  constexpr double kPi = 3.14159265358979323846;
  Mesh ball, front;
  for (Index j = 0; j <= kHigh; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const double up = kPi * (j + 0.5) / (kHigh + 1.0), round = 2.0 * kPi * i / kAround;
      ball.positions.push_back({std::sin(up) * std::cos(round), std::sin(up) * std::sin(round), -std::cos(up)});
    }
  for (Index j = 0; j < kHigh; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const Index a = i + j * kAround, b = (i + 1) % kAround + j * kAround;
      ball.elements.add(ElementKind::Quadrilateral, std::array<Index, 4>{a, b, b + kAround, a + kAround});
    }
  for (const Index ring : {Index{0}, kHigh * kAround}) {  // the caps
    for (Index i = 1; i + 1 < kAround; ++i) {
      const std::array<Index, 3> corners =
          ring == 0 ? std::array<Index, 3>{0, i + 1, i} : std::array<Index, 3>{ring, ring + i, ring + i + 1};
      ball.elements.add(ElementKind::Triangle, corners);
    }
  }
  camera.look_from(ViewPreset::Isometric);
  for (const auto perspective : {false, true}) {
    camera.perspective = perspective;
    Bounds3 box;
    for (const Vec3 p : ball.positions) box.include(p);
    camera.fit(box, kViewport, 10.0);
    front = {};
    front.positions = ball.positions;
    for (Index e = 0; e < ball.elements.size(); ++e) {
      const auto c = ball.elements.corners(e);
      const Vec3 a = ball.positions[c[0]], normal = cross(ball.positions[c[1]] - a, ball.positions[c[2]] - a);
      if (dot(normal, perspective ? camera.eye() - a : camera.back()) > 0.0) front.elements.add(ball.elements.kind(e), c);
    }
    const auto picture = [&](const Mesh& shown) {
      const FaceNeighbours sides(shown);
      const std::vector<float> good(shown.elements.size(), 0.7F);
      space->set_mesh(shown.elements, sides);
      space->update({shown.positions, good, {}, 0});
      Image image = shot();
      space->set_mesh(mesh.elements, faces);  // they outlive the scene
      return image;
    };
    ASSERT_GT(front.elements.size(), 100U);
    ASSERT_LT(front.elements.size(), ball.elements.size() - 100U);
    EXPECT_EQ(picture(ball).rgba, picture(front).rgba);
  }
}

}  // namespace
}  // namespace dmoscope::render
