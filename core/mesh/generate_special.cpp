// Samples grid and random, whose positions are drawn vertex by vertex, and those for one ability each: stretched, in degrees, or of two
// materials.

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "core/mesh/delaunay.h"
#include "core/mesh/generators.h"

namespace dmoscope::generators {

Mesh grid(const Request& request) {
  const auto columns = std::max<Index>(3, static_cast<Index>(std::lround(std::sqrt(static_cast<double>(request.size)))));
  const Index rows = std::max<Index>(3, static_cast<Index>((request.size + columns / 2) / columns));
  // Reach of the random offsets, in cells: below a quarter no triangle can turn over, whatever its diagonal; most vertices go nearly that
  // far.
  constexpr double kReach = 0.24;
  Random random(request.seed);
  const auto jitter = [&] {
    const double u = random.between(-1.0, 1.0);
    return u < 0 ? -kReach * (1.0 - (1.0 + u) * (1.0 + u)) : kReach * (1.0 - (1.0 - u) * (1.0 - u));
  };
  Mesh mesh;
  mesh.positions.reserve(std::size_t{columns} * rows);
  for (Index j = 0; j < rows; ++j) {
    request.progress.check();
    request.progress.set(0.5 * j / rows);
    for (Index i = 0; i < columns; ++i) {
      const bool inside = i > 0 && j > 0 && i + 1 < columns && j + 1 < rows;
      const double dx = inside ? jitter() : 0.0;
      const double dy = inside ? jitter() : 0.0;
      mesh.positions.push_back({neat(i + dx), neat(j + dy), 0.0});
    }
  }
  const std::size_t triangles = std::size_t{columns - 1} * (rows - 1) * 2;
  mesh.elements.reserve(triangles, triangles * 3);
  add_cells(mesh.elements, columns - 1, rows - 1, false, [&](Index i, Index j) {
    if (i == 0) {
      request.progress.check();
      request.progress.set(0.5 + 0.5 * j / rows);
    }
    return random.below(2) == 0 ? Cell::RisingDiagonal : Cell::FallingDiagonal;
  });
  return mesh;
}

Mesh random_points(const Request& request) {
  constexpr std::int32_t kUnit = 100'000'000;  // grid points along the unit square: eight digits
  Random random(request.seed);
  std::vector<GridPoint> points;
  points.reserve(request.size);
  std::unordered_set<std::uint64_t> taken;
  while (points.size() < request.size) {
    if (points.size() % 65536 == 0) request.progress.check();
    const auto x = static_cast<std::int32_t>(random.below(kUnit + 1));
    const auto y = static_cast<std::int32_t>(random.below(kUnit + 1));
    if (taken.insert((static_cast<std::uint64_t>(x) << 32U) | static_cast<std::uint64_t>(y)).second) points.push_back({x, y});
  }
  const auto triangles = delaunay(points, request.progress);
  Mesh mesh;
  mesh.positions.reserve(points.size());
  for (const GridPoint p : points) mesh.positions.push_back({static_cast<double>(p.x) / kUnit, static_cast<double>(p.y) / kUnit, 0.0});
  mesh.elements.reserve(triangles.size(), triangles.size() * 3);
  for (const auto& t : triangles) mesh.elements.add(ElementKind::Triangle, t);
  return mesh;
}

// Sample anisotropic: a mesh that is stretched on purpose, with the metric field that says how.

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

// Samples wrapped and globe: meshes in degrees of longitude and latitude, some of whose elements cross the meridian of 180.

namespace {

constexpr double kPerDegree = 1e7;  // grid units in a degree: about a centimetre each

/// The longitude in -180 to 180, as files have it.
double in_file(double longitude) {
  if (longitude >= 180.0) longitude -= 360.0;
  if (longitude < -180.0) longitude += 360.0;
  return neat(longitude, kPerDegree);
}

}  // namespace

Mesh wrapped(const Request& request) {
  Mesh mesh = coast(request);
  constexpr double kDegree = 4000.0;  // metres: 36 degrees from west to east
  for (Vec3& p : mesh.positions) p = {in_file(181.5 + p.x / kDegree), neat(p.y / kDegree - 17.0, kPerDegree), 0.0};
  return mesh;
}

Mesh globe(const Request& request) {
  // Number of rows: the mesh is 120 degrees high, so there are three times as many cells around.
  const auto rows = std::max<Index>(3, static_cast<Index>(std::lround(std::sqrt(static_cast<double>(request.size) / 3.0))) - 1);
  const auto columns = std::max<Index>(9, static_cast<Index>(request.size / (rows + 1)));
  const double width = 360.0 / columns, height = 120.0 / rows;
  // Reach of the random offsets, in cells: below a quarter of a cell nothing can turn over.
  constexpr double kReach = 0.24;
  Random random(request.seed);
  Mesh mesh;
  for (Index j = 0; j <= rows; ++j) {
    request.progress.check();
    for (Index i = 0; i < columns; ++i) {
      const bool inside = j > 0 && j < rows;
      const double dx = inside ? random.between(-kReach, kReach) : 0.0, dy = inside ? random.between(-kReach, kReach) : 0.0;
      mesh.positions.push_back({in_file(-180.0 + (i + dx) * width), neat(-60.0 + (j + dy) * height, kPerDegree), 0.0});
    }
  }
  add_cells(mesh.elements, columns, rows, true, [&](Index, Index) {
    constexpr Cell kKinds[]{Cell::RisingDiagonal, Cell::FallingDiagonal, Cell::Quadrilateral};
    return kKinds[random.below(3)];
  });
  return mesh;
}

// Samples of two materials, one inside the other: vertices between them keep their place when the mesh is smoothed.

namespace {

/// The inner part of a lattice of n cells along each axis: the lattice's lines from low to high.
struct Inner {
  Index low, high;
  explicit Inner(Index n) : low((n + 1) / 4), high(n - low) {}
  [[nodiscard]] bool has(Index line) const { return line >= low && line <= high; }
  [[nodiscard]] bool ends(Index line) const { return line == low || line == high; }
};

/// Makes elements all of whose corners lie in the inner part a material of their own.
template <class InInner>
void add_materials(Mesh& mesh, const InInner& in_inner) {
  Group inner{.name = "inner", .role = "material", .code = 1, .dimension = 2};
  Group outer{.name = "outer", .role = "material", .code = 2, .dimension = 2};
  Field field{.name = "material", .on = Field::On::Elements, .type = "int", .role = "material"};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const bool own = std::ranges::all_of(mesh.elements.corners(e), in_inner);
    (own ? inner : outer).members.push_back(e);
    field.values.push_back(own ? inner.code : outer.code);
  }
  mesh.groups = {std::move(inner), std::move(outer)};
  mesh.fields.push_back(std::move(field));
}

}  // namespace

Mesh nested(const Request& request) {
  const Index n = std::max<Index>(4, static_cast<Index>(std::lround(std::sqrt(static_cast<double>(request.size)))) - 1);
  const Inner inner(n);
  const auto in_inner = [&](Index v) { return inner.has(v % (n + 1)) && inner.has(v / (n + 1)); };
  Mesh mesh;
  Random random(request.seed);
  std::vector<Vec3> offsets;
  for (Index j = 0; j <= n; ++j) {
    for (Index i = 0; i <= n; ++i) {
      const bool between = in_inner(i + j * (n + 1)) && (inner.ends(i) || inner.ends(j));
      const double reach = i > 0 && i < n && j > 0 && j < n && !between ? 0.45 : 0.0;
      const double x = reach * random.between(-1.0, 1.0), y = reach * random.between(-1.0, 1.0);
      mesh.positions.push_back({static_cast<double>(i), static_cast<double>(j), 0.0});
      offsets.push_back({x, y, 0.0});
    }
  }
  add_cells(mesh.elements, n, n, false, [&](Index, Index) { return random.below(2) == 0 ? Cell::RisingDiagonal : Cell::FallingDiagonal; });
  displace(mesh, offsets, 1e6, request.progress);
  add_materials(mesh, in_inner);
  return mesh;
}

Mesh nested_volumes(const Request& request) {
  Mesh mesh = tetrahedra(request);
  const auto lines = static_cast<Index>(std::lround(std::cbrt(static_cast<double>(mesh.positions.size()))));
  const Inner inner(lines - 1);
  const auto at = [lines](Index v) { return std::array{v % lines, v / lines % lines, v / (lines * lines)}; };
  const auto in_inner = [&](Index v) { return std::ranges::all_of(at(v), [&](Index line) { return inner.has(line); }); };
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const auto [i, j, k] = at(v);
    if (!in_inner(v) || (!inner.ends(i) && !inner.ends(j) && !inner.ends(k))) continue;
    mesh.positions[v] = {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }
  add_materials(mesh, in_inner);
  return mesh;
}

}  // namespace dmoscope::generators
