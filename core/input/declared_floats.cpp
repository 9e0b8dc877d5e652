#include "core/input/declared_floats.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/rounding.h"
#include "core/io/reading/source_file.h"

namespace dmoscope {
namespace {

double shortest_edge(const Mesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    for (std::size_t i = 0; i < corners.size(); ++i)
      shortest = std::min(shortest, length(mesh.positions[corners[i]] - mesh.positions[corners[(i + 1) % corners.size()]]));
  }
  return shortest;
}

}  // namespace

void round_to_floats(std::span<Vec3> positions) {
  for (Vec3& p : positions) p = {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

std::string round_to_declared(Mesh& mesh, const std::string& file) {
  constexpr double kShows = 1e-4;
  if (!mesh.source || !mesh.single_precision) return {};
  const CoordinateLayout& layout = mesh.source->layout();
  const auto declared = [&](std::size_t axis, double value) {
    return layout.scalar[axis] == CoordinateScalar::Float32 ? nearest_float(value) : value;
  };
  const double shortest = layout.binary ? 0.0 : shortest_edge(mesh);  // error in the text's digits; binary coordinates are exact
  double furthest = 0.0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3& p = mesh.positions[v];
    const Vec3 rounded{declared(0, p.x), declared(1, p.y), declared(2, p.z)};
    if (!std::isfinite(rounded.x + rounded.y + rounded.z))
      throw InputError(file, 0, fmt::format("its points are declared as float, which cannot hold the coordinates of vertex {}", v));
    furthest = std::max(furthest, length(rounded - p));
    p = rounded;
  }
  if (!(furthest > kShows * shortest)) return {};
  return fmt::format("its points are declared as float: digits beyond that were left out, which moves vertices by up to {:.3g}", furthest);
}

}  // namespace dmoscope
