#include "core/reference/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/number_text.h"
#include "core/mesh/faces.h"
#include "core/reference/simplex_tree.h"

namespace dmoscope {

namespace {

constexpr double kOnIt = 1e-6;  // share of the mesh's size: a vertex so near is on the reference, where files hold floats

using Triangle = std::array<Vec3, 3>;

/// The surface of a mesh as triangles, and its vertices.
struct Skin {
  std::vector<Triangle> triangles;
  std::vector<Vec3> points;      // vertices, each once, and middles of triangles
  std::vector<Index> vertex_of;  // by point; kNoIndex: a middle
};

Skin skin_of(const InputMesh& input, PositionView positions) {
  Skin skin;
  std::vector<std::uint8_t> known(input.mesh.vertex_count(), 0);
  const auto add = [&](std::span<const Index> corners) {
    for (std::size_t i = 2; i < corners.size(); ++i) {
      const Triangle triangle{positions[corners[0]], positions[corners[i - 1]], positions[corners[i]]};
      skin.triangles.push_back(triangle);
      skin.points.push_back((1.0 / 3.0) * (triangle[0] + triangle[1] + triangle[2]));
      skin.vertex_of.push_back(kNoIndex);
    }
    for (const Index v : corners) {
      if (std::exchange(known[v], std::uint8_t{1}) != 0) continue;
      skin.points.push_back(positions[v]);
      skin.vertex_of.push_back(v);
    }
  };
  if (input.is_surface())
    for (Index e = 0; e < input.mesh.elements.size(); ++e) add(input.mesh.elements.corners(e));
  for (const ElementFace& face : input.faces.boundary()) {
    const auto corners = vertices_of(input.mesh.elements, face);
    add(std::span(corners).first(corners[3] == kNoIndex ? 3 : 4));
  }
  return skin;
}

/// `is_at(i, distance)`: told of each point.
template <class IsAt>
Distances distances(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles, const IsAt& is_at) {
  Distances found;
  if (points.empty() || triangles.empty()) return found;
  const FacetTree tree(triangles, std::vector<Index>(triangles.size(), 0));
  Index near = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto nearest = tree.nearest(points[i], near);
    near = nearest.triangle;
    const double distance = std::sqrt(nearest.point.square);
    found.mean += distance / static_cast<double>(points.size());
    found.greatest = std::max(found.greatest, distance);
    is_at(i, distance);
  }
  return found;
}

}  // namespace

SurfaceDistance surface_distance(const InputMesh& input, PositionView positions) {
  const Skin mesh = skin_of(input, positions), reference = skin_of(*input.surface, input.surface->mesh.positions);
  SurfaceDistance found;
  found.to = distances(mesh.points, reference.triangles, [&](std::size_t i, double distance) {
    if (mesh.vertex_of[i] != kNoIndex && distance > kOnIt * input.geometry.size) found.beside.push_back(mesh.vertex_of[i]);
  });
  found.back = distances(reference.points, mesh.triangles, [](std::size_t, double) {});
  std::ranges::sort(found.beside);
  return found;
}

std::string fit_sentence(const InputMesh& input, const SurfaceDistance& before, const SurfaceDistance& after) {
  const auto fell = [](const Distances& a, const Distances& b) {
    return fmt::format("{:.2g} -> {:.2g}, at most {:.2g} -> {:.2g}", a.mean, b.mean, a.greatest, b.greatest);
  };
  std::string text = fmt::format("fit: distance of the boundary from {} in the mean {}; back {}", input.surface->mesh.name,
                                 fell(before.to, after.to), fell(before.back, after.back));
  if (after.beside.empty()) return text;
  constexpr std::size_t kNamed = 5;
  const std::size_t named = std::min(kNamed, after.beside.size());
  return text + fmt::format("; {} {} not reach it: {}{}", counted(after.beside.size(), "vertex", "vertices"),
                            after.beside.size() == 1 ? "does" : "do", fmt::join(std::span(after.beside).first(named), ", "),
                            named < after.beside.size() ? ", ..." : "");
}

}  // namespace dmoscope
