// Samples grid and random: meshes whose positions are drawn vertex by vertex.

#include <algorithm>
#include <cmath>
#include <unordered_set>

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

}  // namespace dmoscope::generators
