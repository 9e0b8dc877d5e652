#include "core/mesh/coast_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dmoscope::generators {

namespace {

constexpr double kFar = 1e12;

/// Lower envelope of the parabolas f[q] + (x - q)^2 at every integer x.
class Envelope {
 public:
  explicit Envelope(std::size_t n) : f_(n), d_(n), root_(n), from_(n + 1) {}
  [[nodiscard]] std::vector<double>& values() { return f_; }
  const std::vector<double>& run() {
    std::size_t k = 0;
    root_[0] = 0;
    from_[0] = -kFar;
    from_[1] = kFar;
    for (std::size_t q = 1; q < f_.size(); ++q) {
      double s = crossing(root_[k], q);
      while (s <= from_[k]) s = crossing(root_[--k], q);
      root_[++k] = q;
      from_[k] = s;
      from_[k + 1] = kFar;
    }
    k = 0;
    for (std::size_t x = 0; x < f_.size(); ++x) {
      while (from_[k + 1] < static_cast<double>(x)) ++k;
      const double dx = static_cast<double>(x) - static_cast<double>(root_[k]);
      d_[x] = dx * dx + f_[root_[k]];
    }
    return d_;
  }

 private:
  [[nodiscard]] double crossing(std::size_t a, std::size_t b) const {
    const auto x = static_cast<double>(a);
    const auto y = static_cast<double>(b);
    return ((f_[b] - f_[a]) + (y * y - x * x)) / (2.0 * (y - x));
  }
  std::vector<double> f_, d_;
  std::vector<std::size_t> root_;
  std::vector<double> from_;
};

Mask complement(const Mask& mask) {
  Mask result = mask;
  for (auto& m : result.values) m = m == 0 ? 1 : 0;
  return result;
}

Mask grown(const Mask& mask, double radius) {
  const Distances d = distance_to(mask);
  Mask result(mask.width, mask.height, 0);
  for (std::size_t i = 0; i < d.values.size(); ++i) result.values[i] = d.values[i] <= radius ? 1 : 0;
  return result;
}

}  // namespace

Distances distance_to(const Mask& mask) {
  // Squared distances, first along columns, then along rows. kFar / 4 keeps sums finite and exact enough.
  Distances d(mask.width, mask.height, 0.0);
  Envelope column(mask.height);
  for (Index i = 0; i < mask.width; ++i) {
    for (Index j = 0; j < mask.height; ++j) column.values()[j] = mask.at(i, j) != 0 ? 0.0 : kFar / 4;
    const auto& result = column.run();
    for (Index j = 0; j < mask.height; ++j) d.at(i, j) = result[j];
  }
  Envelope row(mask.width);
  for (Index j = 0; j < mask.height; ++j) {
    for (Index i = 0; i < mask.width; ++i) row.values()[i] = d.at(i, j);
    const auto& result = row.run();
    for (Index i = 0; i < mask.width; ++i) d.at(i, j) = std::sqrt(result[i]);
  }
  return d;
}

Mask closed(const Mask& mask, double radius) { return complement(grown(complement(grown(mask, radius)), radius)); }

Mask opened(const Mask& mask, double radius) { return complement(closed(complement(mask), radius)); }

Mask connected(const Mask& mask, Index i, Index j) {
  Mask result(mask.width, mask.height, 0);
  std::vector<std::pair<Index, Index>> todo;
  const auto visit = [&](Index x, Index y) {
    if (x >= mask.width || y >= mask.height || mask.at(x, y) == 0 || result.at(x, y) != 0) return;
    result.at(x, y) = 1;
    todo.emplace_back(x, y);
  };
  visit(i, j);
  while (!todo.empty()) {
    const auto [x, y] = todo.back();
    todo.pop_back();
    visit(x + 1, y);
    visit(x - 1, y);  // wraps to a huge index at 0, which is outside
    visit(x, y + 1);
    visit(x, y - 1);
  }
  return result;
}

Distances signed_distance(const Mask& mask) {
  const Distances outside = distance_to(mask);
  const Distances inside = distance_to(complement(mask));
  Distances field = outside;
  for (std::size_t k = 0; k < field.values.size(); ++k) field.values[k] -= inside.values[k];
  // Smooths binomially, which takes the pixels' stairs out of the outline.
  for (int pass = 0; pass < 4; ++pass) {
    const Distances old = field;
    for (Index j = 1; j + 1 < field.height; ++j) {
      for (Index i = 1; i + 1 < field.width; ++i) {
        const double sides = old.at(i - 1, j) + old.at(i + 1, j) + old.at(i, j - 1) + old.at(i, j + 1);
        const double corners = old.at(i - 1, j - 1) + old.at(i + 1, j - 1) + old.at(i - 1, j + 1) + old.at(i + 1, j + 1);
        field.at(i, j) = 0.25 * old.at(i, j) + 0.125 * sides + 0.0625 * corners;
      }
    }
  }
  // Moves the values of pixels exactly on a curve, so that every crossing has a side.
  for (double& value : field.values) {
    if (value == 0.0) value = 1e-9;
  }
  return field;
}

double interpolate(const Distances& field, double x, double y) {
  x = std::clamp(x, 0.0, field.width - 1.001);
  y = std::clamp(y, 0.0, field.height - 1.001);
  const auto i = static_cast<Index>(x);
  const auto j = static_cast<Index>(y);
  const double u = x - i;
  const double v = y - j;
  return (field.at(i, j) * (1 - u) + field.at(i + 1, j) * u) * (1 - v) + (field.at(i, j + 1) * (1 - u) + field.at(i + 1, j + 1) * u) * v;
}

std::vector<std::vector<Vec2<double>>> zero_curves(const Distances& field) {
  // Number of a crossing by its raster edge: 2 * pixel for the edge to the right of it, + 1 for the edge above.
  const auto name = [&](Index i, Index j, bool up) { return 2 * (std::size_t{j} * field.width + i) + (up ? 1 : 0); };
  const auto place = [&](std::size_t edge) {
    const auto pixel = static_cast<Index>(edge / 2);
    const Index i = pixel % field.width;
    const Index j = pixel / field.width;
    const bool up = edge % 2 != 0;
    const double a = field.at(i, j);
    const double b = up ? field.at(i, j + 1) : field.at(i + 1, j);
    const double t = a / (a - b);
    return Vec2<double>{i + (up ? 0.0 : t), j + (up ? t : 0.0)};
  };
  constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<std::size_t> next(2 * field.values.size(), kNone);
  for (Index j = 0; j + 1 < field.height; ++j) {
    for (Index i = 0; i + 1 < field.width; ++i) {
      const std::array<double, 4> value{field.at(i, j), field.at(i + 1, j), field.at(i + 1, j + 1), field.at(i, j + 1)};
      const std::array<std::size_t, 4> edge{name(i, j, false), name(i + 1, j, true), name(i, j + 1, false), name(i, j, true)};
      for (std::size_t k = 0; k < 4; ++k) {
        if (!(value[k] < 0 && value[(k + 1) % 4] > 0)) continue;  // leaves the region, going round the cell
        // Returns across the side behind, if the cell's middle is outside or only one run of corners is inside.
        const bool saddle = value[(k + 2) % 4] < 0 && value[(k + 3) % 4] > 0;
        const bool joined = saddle && value[0] + value[1] + value[2] + value[3] < 0;
        std::size_t back = (k + 3) % 4;
        if (joined) {
          back = (k + 1) % 4;
        } else {
          while (!(value[back] > 0 && value[(back + 1) % 4] < 0)) back = (back + 3) % 4;
        }
        next[edge[k]] = edge[back];
      }
    }
  }
  std::vector<std::vector<Vec2<double>>> curves;
  for (std::size_t start = 0; start < next.size(); ++start) {
    if (next[start] == kNone) continue;
    std::vector<Vec2<double>> curve;
    for (std::size_t at = start; next[at] != kNone;) {
      curve.push_back(place(at));
      at = std::exchange(next[at], kNone);
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

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
