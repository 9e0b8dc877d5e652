// Sample anisotropic: a mesh that is stretched on purpose, with the metric field that says how.

#include <cmath>
#include <utility>

#include "core/mesh/generators.h"

namespace dmoscope::generators {

namespace {

/// Rows over the unit square, dense along a wave in its middle. x and s are parameters: s from -1 (below) to 1 (above).
struct WavyRows {
  /// Distance from the wave as a share of that to the edge of the square, 0 to 1; growth() is its derivative.
  static double share(double s) { return std::abs(s) * (kDense + (1.0 - kDense) * s * s); }
  static double growth(double s) { return kDense + 3.0 * (1.0 - kDense) * s * s; }
  static double wave(double x) { return 0.5 + 0.15 * sin_turns(x); }
  static double slope(double x) { return 0.15 * 6.283185307179586 * cos_turns(x); }

  static Vec3 place(double x, double s) {
    const double middle = wave(x);
    return {neat(x, 1e9), neat(s < 0.0 ? middle * (1.0 - share(s)) : middle + (1.0 - middle) * share(s), 1e9), 0.0};
  }
  /// The parameter s of a place, by bisection.
  static double parameter(Vec3 place) {
    const double middle = wave(place.x), way = place.y - middle, wanted = way < 0.0 ? -way / middle : way / (1.0 - middle);
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) (share(0.5 * (low + high)) < wanted ? low : high) = 0.5 * (low + high);
    return way < 0.0 ? -low : low;
  }

  /// Components m11, m12, m22 of the metric in which cells of these parameters are squares.
  static std::array<double, 3> metric(double x, double s, double dx, double ds) {
    const double leans = slope(x) * (1.0 - share(s)), length = std::sqrt(1.0 + leans * leans);
    const double room = s < 0.0 ? wave(x) : 1.0 - wave(x);
    const double along = dx * length, across = room * growth(s) * ds / length;
    const double c = 1.0 / length, n = leans / length, a = 1.0 / (along * along), b = 1.0 / (across * across);
    return {a * c * c + b * n * n, (a - b) * c * n, a * n * n + b * c * c};
  }

 private:
  static constexpr double kDense = 0.05;
};

}  // namespace

Mesh anisotropic(const Request& request) {
  constexpr double kReach = 0.4;  // reach of the random offsets, in cells
  const double side = std::sqrt(static_cast<double>(request.size));
  const Index columns = std::max<Index>(4, static_cast<Index>(std::lround(0.6 * side)));
  const Index rows = std::max<Index>(4, static_cast<Index>(std::lround(static_cast<double>(request.size) / columns)));
  const double dx = 1.0 / (columns - 1), ds = 2.0 / (rows - 1);
  Random random(request.seed);
  Mesh mesh;
  std::vector<Vec3> offsets;
  for (Index j = 0; j < rows; ++j) {
    request.progress.check();
    for (Index i = 0; i < columns; ++i) {
      const bool inside = i > 0 && j > 0 && i + 1 < columns && j + 1 < rows;
      const double u = inside ? random.between(-kReach, kReach) : 0.0, v = inside ? random.between(-kReach, kReach) : 0.0;
      const Vec3 here = WavyRows::place(i * dx, j * ds - 1.0);
      mesh.positions.push_back(here);
      offsets.push_back(WavyRows::place((i + u) * dx, (j + v) * ds - 1.0) - here);
    }
  }
  add_cells(mesh.elements, columns - 1, rows - 1, false,
            [&](Index, Index) { return random.below(2) == 0 ? Cell::RisingDiagonal : Cell::FallingDiagonal; });
  displace(mesh, offsets, 1e9, request.progress);
  Field metric;
  metric.name = "metric";
  metric.components = 3;
  for (const Vec3 place : mesh.positions)
    for (const double value : WavyRows::metric(place.x, WavyRows::parameter(place), dx, ds)) metric.values.push_back(value);
  mesh.fields.push_back(std::move(metric));
  return mesh;
}

}  // namespace dmoscope::generators
