#include "core/mesh/coast_map.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::generators {
namespace {

constexpr double kCentreY = 8.0, kHalfWidth = 64.0, kHalfHeight = 54.0;  // the ellipse of the open boundary
constexpr double kPixelsPerEdge = 3.0;

/// Quadratic form of a point that is 1 on the ellipse.
double ellipse(Vec2<double> p) {
  const double x = p.x / kHalfWidth;
  const double y = (p.y - kCentreY) / kHalfHeight;
  return std::sqrt(x * x + y * y);
}

struct Island {
  Vec2<double> centre;
  double radius;
};

/// Islands off the coast, apart from each other, a few large and more small ones.
std::vector<Island> draw_islands(Random& random) {
  std::vector<Island> islands;
  for (int tries = 0; tries < 400 && islands.size() < 9; ++tries) {
    const double small = random.unit();
    const Island island{{random.between(-42.0, 42.0), random.between(-26.0, 6.0)}, 1.6 + 5.2 * small * small};
    const bool apart = std::ranges::all_of(islands, [&](const Island& other) {
      const auto d = other.centre - island.centre;
      return std::sqrt(dot(d, d)) > 2.2 * (other.radius + island.radius);
    });
    if (apart && ellipse(island.centre) < 0.72) islands.push_back(island);
  }
  return islands;
}

/// Land function at a point, positive on land.
double land(Vec2<double> p, const std::vector<Island>& islands, std::uint64_t seed) {
  const double rough = fractal_noise(p.x / 26.0 + 11.0, p.y / 26.0, 6, seed);
  const double bays = fractal_noise(p.x / 55.0, 0.37 * p.y / 55.0 + 5.0, 2, seed + 100);
  double height = (p.y - 15.0) / 15.0 + 2.4 * rough + 1.2 * bays;
  for (const Island& island : islands) {
    const auto d = p - island.centre;
    if (dot(d, d) > 4.0 * island.radius * island.radius) continue;  // beyond the island's ragged rim
    const double ragged = 1.0 + 1.3 * fractal_noise(p.x / (1.6 * island.radius), p.y / (1.6 * island.radius), 4, seed + 200);
    height = std::max(height, (island.radius * ragged - std::sqrt(dot(d, d))) / island.radius);
  }
  return height;
}

}  // namespace

CoastMap::CoastMap(double finest, std::uint64_t seed, Progress& progress)
    : finest_(finest), step_(finest / kPixelsPerEdge), outline_(0, 0, 0.0), from_land_(0, 0, 0.0) {
  const auto width = static_cast<Index>(std::ceil((kEast - kWest) / step_)) + 1;
  const auto height = static_cast<Index>(std::ceil((kNorth - kSouth) / step_)) + 1;
  Random random(seed);
  const std::vector<Island> islands = draw_islands(random);
  const std::uint64_t noise_seed = random.next();
  const auto place = [&](Index i, Index j) { return Vec2<double>{kWest + i * step_, kSouth + j * step_}; };

  Mask ground(width, height, 0);  // land, or beyond the arc
  for (Index j = 0; j < height; ++j) {
    progress.check();
    for (Index i = 0; i < width; ++i) {
      const Vec2<double> p = place(i, j);
      ground.at(i, j) = ellipse(p) >= 1.0 || land(p, islands, noise_seed) > 0.0 ? 1 : 0;
    }
  }
  // Closes straits and removes spits that are narrower than the edges that shall follow them.
  ground = closed(ground, 1.1 * kPixelsPerEdge);
  progress.check();
  ground = opened(ground, 0.9 * kPixelsPerEdge);
  progress.check();
  Mask sea = ground;
  for (auto& m : sea.values) m = m == 0 ? 1 : 0;
  sea = connected(sea, static_cast<Index>(pixel(-kWest)), static_cast<Index>(pixel(kCentreY - 0.9 * kHalfHeight - kSouth)));
  outline_ = signed_distance(sea);
  progress.check();
  Mask shore(width, height, 0);
  for (Index j = 0; j < height; ++j) {
    for (Index i = 0; i < width; ++i) shore.at(i, j) = sea.at(i, j) == 0 && ellipse(place(i, j)) < 0.985 ? 1 : 0;
  }
  from_land_ = distance_to(shore);
  progress.check();
}

double CoastMap::edge_length(Vec2<double> p) const { return edge_length(from_land(p), finest_); }

double CoastMap::edge_length(double from_land, double finest) { return std::min(finest + 0.17 * from_land, 10.0 * finest); }

bool CoastMap::on_arc(Vec2<double> p) const { return (1.0 - ellipse(p)) * kHalfHeight < 1.5 * step_; }

Vec2<double> CoastMap::to_arc(Vec2<double> p) {
  const double s = 1.0 / ellipse(p);
  return {s * p.x, kCentreY + s * (p.y - kCentreY)};
}

std::vector<std::vector<Vec2<double>>> CoastMap::outlines() const {
  auto curves = zero_curves(outline_);
  for (auto& curve : curves) {
    for (auto& p : curve) p = {kWest + p.x * step_, kSouth + p.y * step_};
  }
  std::ranges::stable_sort(curves, [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return curves;
}

double CoastMap::estimated_vertices(double finest) const {
  double vertices = 0;
  for (std::size_t k = 0; k < outline_.values.size(); ++k) {
    if (outline_.values[k] >= 0) continue;
    const double edge = edge_length(from_land_.values[k] * step_, finest);
    vertices += step_ * step_ / (0.91 * edge * edge);
  }
  return vertices;
}

}  // namespace dmoscope::generators
