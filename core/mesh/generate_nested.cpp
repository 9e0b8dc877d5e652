// Samples of two materials, one inside the other: vertices between them keep their place when the mesh is smoothed.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh/generators.h"

namespace dmoscope::generators {

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
