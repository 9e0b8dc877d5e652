#include "core/mesh/generators.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope::generators {
namespace {

/// Taylor's series of the sine for |x| <= pi / 2; the first term left out is below 1e-17.
double sine_series(double x) {
  const double s = x * x;
  double sum = 0.0;
  for (int k = 21; k >= 3; k -= 2) sum = (1.0 + sum) * (-s / (k * (k - 1)));
  return x * (1.0 + sum);
}

double lattice_value(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  Random random(seed ^ (static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ULL) ^ (static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fULL));
  random.next();
  return random.between(-1.0, 1.0);
}

double ease(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

/// Smallest of the corner triangles' areas, times two.
double smallest_corner(const Mesh& mesh, std::span<const Vec3> positions, Index e) {
  const auto c = mesh.elements.corners(e);
  const std::size_t n = c.size();
  double smallest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double area = cross(positions[c[(i + 1) % n]] - positions[c[i]], positions[c[(i + n - 1) % n]] - positions[c[i]]).z;
    smallest = i == 0 ? area : std::min(smallest, area);
  }
  return smallest;
}

}  // namespace

double sin_turns(double turns) {
  double r = turns - std::floor(turns + 0.5);  // turns reduced to -0.5 to 0.5
  if (r > 0.25) r = 0.5 - r;
  if (r < -0.25) r = -0.5 - r;
  return sine_series(6.283185307179586 * r);
}

double cos_turns(double turns) { return sin_turns(turns + 0.25); }

double noise(double x, double y, std::uint64_t seed) {
  const double fx = std::floor(x);
  const double fy = std::floor(y);
  const auto i = static_cast<std::int64_t>(fx);
  const auto j = static_cast<std::int64_t>(fy);
  const double u = ease(x - fx);
  const double v = ease(y - fy);
  const double low = lattice_value(i, j, seed) * (1.0 - u) + lattice_value(i + 1, j, seed) * u;
  const double high = lattice_value(i, j + 1, seed) * (1.0 - u) + lattice_value(i + 1, j + 1, seed) * u;
  return low * (1.0 - v) + high * v;
}

double fractal_noise(double x, double y, int octaves, std::uint64_t seed) {
  double sum = 0.0;
  double amplitude = 0.5;
  for (int k = 0; k < octaves; ++k, amplitude *= 0.5) {
    sum += amplitude * noise(x, y, seed + static_cast<std::uint64_t>(k) * 7919U);
    // Turns the lattice by about 37 degrees to hide it: (0.8, 0.6) is exact enough a unit vector.
    const double turned = 2.0 * (0.8 * x - 0.6 * y);
    y = 2.0 * (0.6 * x + 0.8 * y);
    x = turned;
  }
  return sum;
}

double neat(double x, double per_unit) { return std::round(x * per_unit) / per_unit; }

void add_cells(ElementTable& elements, Index nx, Index ny, bool ring, const std::function<Cell(Index, Index)>& cell) {
  const Index columns = ring ? nx : nx + 1;
  for (Index j = 0; j < ny; ++j) {
    for (Index i = 0; i < nx; ++i) {
      const Index next = ring && i + 1 == nx ? 0 : i + 1;
      const Index a = i + j * columns;
      const Index b = next + j * columns;
      const Index c = b + columns;
      const Index d = a + columns;
      switch (cell(i, j)) {
        case Cell::Quadrilateral:
          elements.add(ElementKind::Quadrilateral, std::array{a, b, c, d});
          break;
        case Cell::RisingDiagonal:
          elements.add(ElementKind::Triangle, std::array{a, b, c});
          elements.add(ElementKind::Triangle, std::array{a, c, d});
          break;
        case Cell::FallingDiagonal:
          elements.add(ElementKind::Triangle, std::array{a, b, d});
          elements.add(ElementKind::Triangle, std::array{b, c, d});
          break;
      }
    }
  }
}

void displace(Mesh& mesh, std::span<const Vec3> offsets, double per_unit, Progress& progress) {
  const std::vector<Vec3> base = mesh.positions;
  std::vector<double> allowed(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) allowed[e] = 0.1 * smallest_corner(mesh, base, e);
  std::vector<double> share(base.size(), 1.0);
  constexpr int kRounds = 40;
  for (int round = 0; round < kRounds; ++round) {
    progress.check();
    for (std::size_t v = 0; v < base.size(); ++v) {
      const Vec3 p = base[v] + share[v] * offsets[v];
      mesh.positions[v] = {neat(p.x, per_unit), neat(p.y, per_unit), base[v].z};
    }
    bool good = true;
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      if (smallest_corner(mesh, mesh.positions, e) >= allowed[e]) continue;
      good = false;
      for (const Index v : mesh.elements.corners(e)) share[v] = round + 2 < kRounds ? 0.75 * share[v] : 0.0;
    }
    if (good) return;
  }
}

}  // namespace dmoscope::generators
