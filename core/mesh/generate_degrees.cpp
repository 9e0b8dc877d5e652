// Samples wrapped and globe: meshes in degrees of longitude and latitude, some of whose elements cross the meridian of 180.

#include <algorithm>
#include <cmath>

#include "core/mesh/generators.h"

namespace dmoscope::generators {
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

}  // namespace dmoscope::generators
