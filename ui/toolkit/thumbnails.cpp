#include "ui/toolkit/thumbnails.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/mesh/edges.h"
#include "core/mesh/faces.h"
#include "core/mesh/generate.h"
#include "core/mesh/orientation.h"
#include "core/mesh/seam.h"
#include "core/mesh/volume.h"
#include "core/quality/quality.h"
#include "render/orbit_camera.h"

namespace dmoscope::ui {
namespace {

/// About how many vertices, tried in this order: some generators need more to make anything.
constexpr std::size_t kSideLengths[] = {180, 600, 1500};

/// Darker, as a face that looks away from the light.
render::Rgb lit(render::Rgb ink, double light) {
  const double part = 0.55 + 0.45 * std::clamp(light, 0.0, 1.0);
  const auto channel = [part](std::uint8_t value) { return static_cast<std::uint8_t>(std::lround(part * value)); };
  return {channel(ink.r), channel(ink.g), channel(ink.b)};
}

/// The skin of a volume mesh seen from a corner, the farthest face first.
void add_skin(Thumbnail& out, Mesh& mesh, const Geometry& geometry, render::ColourMap map) {
  FaceNeighbours neighbours(mesh);
  if (normalise_orientation(mesh, neighbours).flipped > 0) neighbours = FaceNeighbours(mesh);
  render::Bounds3 box;
  for (const Vec3& position : mesh.positions) box.include(position);
  render::OrbitCamera camera;
  camera.look_from(render::ViewPreset::Isometric);
  camera.fit(box, {1.0, 1.0}, 0.0);
  const QualityContext context{mesh, geometry};
  const render::ColourScale colours{map};
  std::vector<std::pair<double, Thumbnail::Polygon>> faces;
  for (const ElementFace& face : neighbours.boundary()) {
    const auto vertices = vertices_of(mesh.elements, face);
    Thumbnail::Polygon polygon;
    polygon.count = vertices[3] == kNoIndex ? 3 : 4;
    const auto at = [&](std::size_t k) { return mesh.positions[vertices[k]] - camera.centre; };
    double depth = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(polygon.count); ++k) {
      depth += dot(at(k), camera.back()) / polygon.count;
      polygon.corners[k] = {static_cast<float>(0.5 + dot(at(k), camera.right) / camera.height),
                            static_cast<float>(0.5 - dot(at(k), camera.up) / camera.height)};
    }
    const Vec3 normal = cross(at(1) - at(0), at(2) - at(0));
    const double size = length(normal), towards = size > 0.0 ? dot(normal, camera.back()) / size : 0.0;
    if (towards <= 0.0) continue;
    const bool inverted = smallest_jacobian(context, mesh.positions, face.element) <= 0.0;
    const render::Rgb ink =
        inverted ? render::kInvertedColour : colours.colour(element_quality(context, mesh.positions, Metric::MeanRatio, face.element));
    // The light comes from above the shoulder, so that the three sides of a block differ.
    const Vec3 light = camera.back() + 0.7 * camera.up + 0.3 * camera.right;
    polygon.colour = lit(ink, dot(normal, light) / (size * length(light)));
    faces.emplace_back(depth, polygon);
  }
  std::ranges::sort(faces, {}, &std::pair<double, Thumbnail::Polygon>::first);
  for (const auto& [depth, polygon] : faces) out.polygons.push_back(polygon);
}

/// Does the element lie across the seam of a mesh that wraps? It is not drawn then.
bool is_wide(std::span<const Vec2<double>> points, std::span<const Index> corners, const Plane& plane) {
  return plane.period > 0.0 &&
         std::ranges::any_of(corners, [&](Index v) { return std::abs(points[v].x - points[corners[0]].x) > 0.5 * plane.period; });
}

Thumbnail make_one(const GeneratorInfo& generator, std::size_t size_wanted, render::ColourMap map) {
  Thumbnail out{std::string(generator.name), std::string(generator.doc), {}};
  Progress progress;
  Mesh mesh = generate_mesh(generator.name, size_wanted, 1, progress);
  Geometry geometry = classify(mesh);
  if (mesh.positions.empty()) return out;
  if (geometry.shape == Shape::Volume) {
    add_skin(out, mesh, geometry, map);
    return out;
  }
  EdgeSurvey edges;
  Progress unwatched;
  const Topology topology(mesh, edges, unwatched);
  find_seam(mesh, topology, edges, geometry);
  normalise_orientation(mesh, geometry.plane);
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  std::vector<Vec2<double>> points;
  for (const Vec3& position : mesh.positions) {
    const Vec2<double> p = geometry.plane.place(position);
    points.push_back(p);
    low[0] = std::min(low[0], p.x);
    low[1] = std::min(low[1], p.y);
    high[0] = std::max(high[0], p.x);
    high[1] = std::max(high[1], p.y);
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], 1e-300});
  const QualityContext context{mesh, geometry};
  const render::ColourScale colours{map};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    if (corners.size() > 4 || is_wide(points, corners, geometry.plane)) continue;
    Thumbnail::Polygon polygon;
    polygon.count = static_cast<int>(corners.size());
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec2<double> p = points[corners[k]];
      polygon.corners[k] = {static_cast<float>(0.5 + (p.x - (low[0] + high[0]) / 2) / size),
                            static_cast<float>(0.5 - (p.y - (low[1] + high[1]) / 2) / size)};
    }
    const bool inverted = smallest_jacobian(context, mesh.positions, e) <= 0.0;
    polygon.colour = inverted ? render::kInvertedColour : colours.colour(element_quality(context, mesh.positions, Metric::MeanRatio, e));
    out.polygons.push_back(polygon);
  }
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
        continue;  // too small for this one
      }
    }
    out.push_back(std::move(sample));
  }
  return out;
}

}  // namespace dmoscope::ui
