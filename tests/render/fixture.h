#pragma once
// Small meshes and a headless context for the tests of this folder.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "render/context.h"
#include "render/framebuffer.h"
#include "render/planar_scene.h"

namespace dmoscope::render {

inline constexpr double kWidth = 200, kHeight = 120;
inline constexpr Vec2<double> kViewport{kWidth, kHeight};

/// Camera with one pixel per unit, (0, 0) in the middle of the viewport.
inline Camera2D unit_camera(Vec2<double> centre = {0, 0}) {
  Camera2D camera;
  camera.centre = centre;
  return camera;
}

/// Triangle (-80,-50) (0,-50) (-40,50), quadrilateral (10,-50) (90,-50) (90,40) (10,40), all moved by `shift`.
inline Mesh triangle_and_quadrilateral(Vec3 shift = {}) {
  Mesh mesh;
  for (const Vec3 p :
       {Vec3{-80, -50, 0}, Vec3{0, -50, 0}, Vec3{-40, 50, 0}, Vec3{10, -50, 0}, Vec3{90, -50, 0}, Vec3{90, 40, 0}, Vec3{10, 40, 0}}) {
    mesh.positions.push_back(p + shift);
  }
  const Index triangle[] = {0, 1, 2}, quadrilateral[] = {3, 4, 5, 6};
  mesh.elements.add(ElementKind::Triangle, triangle);
  mesh.elements.add(ElementKind::Quadrilateral, quadrilateral);
  return mesh;
}

/// A wavy sheet of columns x rows cells; every third cell is split into triangles.
inline Mesh wavy_sheet(int columns, int rows) {
  Mesh mesh;
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      const double x = i + 0.25 * std::sin(1.7 * i + 2.3 * j), y = j + 0.25 * std::cos(2.1 * i - 1.3 * j);
      mesh.positions.push_back({x, y, 0});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<Index>(j * (columns + 1) + i); };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      const Index c[] = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if ((i + j) % 3 == 0) {
        const Index first[] = {c[0], c[1], c[2]}, second[] = {c[0], c[2], c[3]};
        mesh.elements.add(ElementKind::Triangle, first);
        mesh.elements.add(ElementKind::Triangle, second);
      } else {
        mesh.elements.add(ElementKind::Quadrilateral, c);
      }
    }
  }
  return mesh;
}

/// A style without lines: every pixel inside an element has exactly the element's colour.
inline Style flat_style() {
  Style style = Style::dark();
  style.wireframe = false;
  style.occlusion = false;
  style.boundary = false;
  return style;
}

class WithContext : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      context = create_headless_context();
    } catch (const Error& error) {
      GTEST_SKIP() << error.what();
    }
    target = std::make_unique<Framebuffer>(static_cast<int>(kWidth), static_cast<int>(kHeight));
    scene = std::make_unique<PlanarScene>();
  }
  void TearDown() override {
    scene.reset();
    target.reset();
    context.reset();
  }
  void load(const Mesh& mesh, const std::vector<float>& quality, const std::vector<std::uint8_t>& inverted = {}) {
    scene->set_mesh(mesh, Plane{});
    scene->update(mesh.positions, quality, inverted);
  }
  Image picture(const Camera2D& camera, const Style& style, const Marks& marks = {}, double detail = 1.0) {
    scene->draw(*target, camera, style, marks, detail);
    return target->read_pixels();
  }

  std::unique_ptr<Context> context;
  std::unique_ptr<Framebuffer> target;
  std::unique_ptr<PlanarScene> scene;
};

inline ::testing::AssertionResult near_colour(Rgba got, Rgb wanted, int tolerance = 3) {
  const int off = std::max({std::abs(got.r - wanted.r), std::abs(got.g - wanted.g), std::abs(got.b - wanted.b)});
  if (off <= tolerance && got.a == 255) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "got " << int{got.r} << ' ' << int{got.g} << ' ' << int{got.b} << " alpha " << int{got.a}
                                       << ", wanted " << int{wanted.r} << ' ' << int{wanted.g} << ' ' << int{wanted.b};
}

}  // namespace dmoscope::render
