#include "ui/thumbnails.h"

#include <algorithm>

#include "core/mesh/generate.h"
#include "core/mesh/orientation.h"
#include "core/quality/quality.h"

namespace dmoscope::ui {
namespace {

/// About how many vertices, tried in this order: some generators need more to make anything.
constexpr std::size_t kSizes[] = {180, 600, 1500};

Thumbnail make_one(const GeneratorInfo& generator, std::size_t size_wanted, render::ColourMap map) {
  Thumbnail out{std::string(generator.name), std::string(generator.doc), {}};
  Progress progress;
  Mesh mesh = generate_mesh(generator.name, size_wanted, 1, progress);
  const Geometry geometry = classify(mesh);
  normalise_orientation(mesh, geometry.plane);
  if (mesh.positions.empty()) return out;
  double low[2] = {1e300, 1e300}, high[2] = {-1e300, -1e300};
  std::vector<Vec2<double>> points;
  for (const Vec3& position : mesh.positions) {
    const Vec2<double> p = geometry.plane.project(position);
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
    if (corners.size() > 4) continue;
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

std::vector<Thumbnail> make_thumbnails(render::ColourMap map) {
  std::vector<Thumbnail> out;
  for (const GeneratorInfo& generator : generator_table()) {
    Thumbnail sample{std::string(generator.name), std::string(generator.doc), {}};
    for (const std::size_t size : kSizes) {
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
