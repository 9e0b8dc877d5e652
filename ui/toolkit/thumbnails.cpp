#include "ui/toolkit/thumbnails.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/input/input_mesh.h"
#include "core/mesh/faces.h"
#include "core/mesh/generate.h"
#include "core/quality/quality.h"
#include "render/orbit_camera.h"
#include "ui/analysis/scene_points.h"

namespace dmoscope::ui {
namespace {

/// Approximate numbers of vertices, tried in this order: some generators need more to make anything.
constexpr std::size_t kSideLengths[] = {180, 600, 1500};

/// A colour made darker, as on a face that looks away from the light.
render::Rgb lit(render::Rgb ink, double light) {
  const double part = 0.55 + 0.45 * std::clamp(light, 0.0, 1.0);
  const auto channel = [part](std::uint8_t value) { return static_cast<std::uint8_t>(std::lround(part * value)); };
  return {channel(ink.r), channel(ink.g), channel(ink.b)};
}

/// Whether the element lies across the seam of a mesh that wraps, and is not drawn.
bool is_wide(const Plane& plane, std::span<const Vec3> points, std::span<const Index> corners) {
  return plane.period > 0.0 &&
         std::ranges::any_of(corners, [&](Index v) { return std::abs(points[v].x - points[corners[0]].x) > 0.5 * plane.period; });
}

/// Picture of a sample: elements of a plane from above; a surface or the skin of a volume from a corner, the farthest face first.
Thumbnail make_one(const GeneratorInfo& generator, std::size_t size_wanted, render::ColourMap map) {
  Thumbnail out{std::string(generator.name), std::string(generator.doc), {}};
  Progress progress;
  const auto input = generate_input(fmt::format("{} {}", generator.name, size_wanted), progress);
  const Mesh& mesh = input->mesh;
  const ScenePoints scene = ScenePoints::of(*input);
  std::vector<Vec3> points(mesh.positions.size());
  std::ranges::transform(mesh.positions, points.begin(), [&](Vec3 position) { return scene.at(position); });
  render::Bounds3 box;
  for (const Vec3& point : points) box.include(point);
  render::OrbitCamera camera;
  camera.look_from(input->in_space() ? render::ViewPreset::Isometric : render::ViewPreset::PlusZ);
  camera.fit(box, {1.0, 1.0}, 0.0);
  // The light comes from above the shoulder, so that the three sides of a block differ.
  const Vec3 light = camera.back() + 0.7 * camera.up + 0.3 * camera.right;
  const QualityContext context = input->quality_context();
  const render::ColourScale colours{map};
  std::vector<std::pair<double, Thumbnail::Polygon>> faces;
  const auto add = [&](ElementFace face) {
    const auto vertices = vertices_of(mesh.elements, face);
    Thumbnail::Polygon polygon;
    polygon.count = vertices[3] == kNoIndex ? 3 : 4;
    const auto at = [&](std::size_t k) { return points[vertices[k]] - camera.centre; };
    double depth = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k) {
      depth += dot(at(k), camera.back()) / polygon.count;
      polygon.corners[k] = {static_cast<float>(0.5 + dot(at(k), camera.right) / camera.height),
                            static_cast<float>(0.5 - dot(at(k), camera.up) / camera.height)};
    }
    const bool inverted = smallest_jacobian(context, mesh.positions, face.element) <= 0.0;
    polygon.colour =
        inverted ? render::kInvertedColour : colours.colour(element_quality(context, mesh.positions, Metric::MeanRatio, face.element));
    const Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
    const double towards = dot(normal, camera.back());
    if (input->is_volume() && towards <= 0.0) return;
    if (input->in_space() && length(normal) > 0.0)
      polygon.colour = lit(polygon.colour, dot(towards < 0.0 ? -1.0 * normal : normal, light) / (length(normal) * length(light)));
    faces.emplace_back(depth, polygon);
  };
  if (input->is_volume()) {
    for (const ElementFace& face : input->faces.boundary()) add(face);
  } else {
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if (!is_wide(input->geometry.plane, points, mesh.elements.corners(e))) add({e, 0});
  }
  std::ranges::stable_sort(faces, {}, &std::pair<double, Thumbnail::Polygon>::first);
  for (const auto& [depth, polygon] : faces) out.polygons.push_back(polygon);
  return out;
}

}  // namespace

std::vector<Thumbnail> make_thumbnails(render::ColourMap map, bool pictures) {
  std::vector<Thumbnail> out;
  for (const GeneratorInfo& generator : generator_table()) {
    Thumbnail sample{std::string(generator.name), std::string(generator.doc), {}};
    for (const std::size_t size : kSideLengths) {
      if (!pictures) break;
      try {
        sample = make_one(generator, size, map);
        break;
      } catch (const UsageError&) {
        continue;  // too small for this generator
      }
    }
    out.push_back(std::move(sample));
  }
  return out;
}

}  // namespace dmoscope::ui
