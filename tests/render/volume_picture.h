#pragma once
// A small volume mesh on the OpenGL side, for tests of its pictures.

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/mesh/faces.h"
#include "render/volume_scene.h"
#include "tests/render/fixture.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::render {

/// Two by two by two cubes of a side of a half over the unit cube, seen from +x; cell 1 has corner (0.5 to 1, 0 to 0.5, 0 to 0.5) and so
/// on.
class VolumePicture : public WithContext {
 protected:
  void SetUp() override {
    WithContext::SetUp();
    if (IsSkipped()) return;
    space = std::make_unique<VolumeScene>();
    space->set_mesh(mesh.elements, faces);
    show();
    camera.look_from(ViewPreset::PlusX);
    camera.fit(space->bounds(), kViewport, 10.0);
    plain.triad = false;
  }
  void TearDown() override {
    space.reset();
    WithContext::TearDown();
  }
  void show() { space->update({mesh.positions, quality, inverted, 0}); }
  Image shot(const Style& style = flat_style(), double detail = 1.0) {
    space->draw(*target, camera, style, plain, detail);
    return target->read_pixels();
  }
  /// The colour at a point of the mesh.
  Rgba at(const Image& image, Vec3 point) const {
    const auto place = camera.projection(kViewport, space->bounds()).place(point);
    return image.at(static_cast<int>(0.5 * kWidth + place->x), static_cast<int>(0.5 * kHeight - place->y));
  }
  /// Lit colour of a face that looks along +x, towards the eye: the light comes from over the left shoulder.
  static Rgb by_lamp(Rgb colour) {
    const double brightness = 0.70 + 0.30 / std::sqrt(1.0 + 0.45 * 0.45 + 0.3 * 0.3);
    const auto channel = [&](std::uint8_t c) { return static_cast<std::uint8_t>(std::lround(brightness * c)); };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
  }
  static Rgb of_quality(double q) { return flat_style().colours.colour(q); }

  Mesh mesh = test::volume_grid(2, test::Fill::Hexahedra);
  FaceNeighbours faces{mesh};
  std::vector<float> quality{0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F, 0.8F};
  std::vector<std::uint8_t> inverted = std::vector<std::uint8_t>(8, 0);
  std::unique_ptr<VolumeScene> space;
  OrbitCamera camera;
  Marks plain;
};

}  // namespace dmoscope::render
