#include "core/mesh/outline.h"

#include <algorithm>
#include <array>
#include <tuple>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/number_in.h"
#include "core/mesh/halfedge.h"
#include "core/mesh/plane.h"

namespace dmoscope {
namespace {

bool has_volumes(const Mesh& mesh) {
  return std::ranges::any_of(mesh.elements.kinds(), [](ElementKind kind) { return info(kind).dimension == 3; });
}

/// Area vector of a closed polygon, times two, about its first corner: far from the origin nothing cancels.
Vec3 twice_area(std::span<const Vec3> places, std::span<const Index> polygon) {
  Vec3 sum;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    sum = sum + cross(places[polygon[i]] - places[polygon[0]], places[polygon[i + 1]] - places[polygon[0]]);
  return sum;
}

double length_of(std::span<const Vec3> places, std::span<const Index> polygon) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) sum += length(places[polygon[(i + 1) % polygon.size()]] - places[polygon[i]]);
  return sum;
}

/// Direction of the elements of each part: the sum of their area vectors.
std::vector<Vec3> measure_parts(const Mesh& mesh, std::vector<MeshPart>& parts, std::span<const Vec3> places) {
  std::vector<Index> seen_in(places.size(), kNoIndex);
  std::vector<Vec3> towards;
  for (Index p = 0; p < parts.size(); ++p) {
    MeshPart& part = parts[p];
    Vec3 sum;
    for (const Index e : part.elements) {
      const auto corners = mesh.elements.corners(e);
      const Vec3 twice = twice_area(places, corners);
      sum = sum + twice;
      part.area += length(twice) / 2;
      for (const Index v : corners) {
        if (seen_in[v] != p) ++part.vertices;
        seen_in[v] = p;
      }
    }
    towards.push_back(sum);
  }
  return towards;
}

/// Finds the outer loop of each planar part, which encloses it all: its area vector points where the elements' do, those of holes against
/// it.
void find_outer_loops(std::vector<BoundaryLoop>& loops, const std::vector<Vec3>& towards, std::span<const Vec3> places) {
  std::vector<BoundaryLoop*> largest(towards.size(), nullptr);
  std::vector<double> most(towards.size(), 0.0);
  for (BoundaryLoop& loop : loops) {
    const double along = dot(twice_area(places, loop.vertices), towards[loop.part]);
    if (along <= most[loop.part]) continue;
    most[loop.part] = along;
    largest[loop.part] = &loop;
  }
  for (BoundaryLoop* loop : largest)
    if (loop != nullptr) loop->outer = true;
}

}  // namespace

std::string Outline::name(Index loop) const { return fmt::format("loop {}{}", loop + 1, loops[loop].outer ? " (outer)" : ""); }

std::optional<Outline::Place> Outline::find(Index vertex) const {
  for (Index loop = 0; loop < loops.size(); ++loop) {
    const auto at = std::ranges::find(loops[loop].vertices, vertex);
    if (at != loops[loop].vertices.end()) return Place{loop, static_cast<Index>(at - loops[loop].vertices.begin())};
  }
  return std::nullopt;
}

Outline outline_of(const Mesh& mesh) { return outline_of(mesh, mesh.degrees ? *mesh.degrees : mesh.positions); }

Outline outline_of(const Mesh& mesh, std::span<const Vec3> places) {
  Outline outline;
  if (has_volumes(mesh) || mesh.elements.size() == 0) return outline;
  const HalfEdges half_edges(mesh);
  outline.left_out = half_edges.refused_elements();
  const std::vector<Index> part_of = half_edges.parts();
  for (Index e = 0; e < part_of.size(); ++e) {
    if (part_of[e] == kNoIndex) continue;
    outline.parts.resize(std::max<std::size_t>(outline.parts.size(), part_of[e] + 1));
    outline.parts[part_of[e]].elements.push_back(e);
  }
  const std::vector<Vec3> towards = measure_parts(mesh, outline.parts, places);
  for (HalfEdges::Loop& found : half_edges.boundary_loops()) {
    BoundaryLoop loop{.vertices = std::move(found.vertices), .part = part_of[found.element]};
    std::rotate(loop.vertices.begin(), std::ranges::min_element(loop.vertices), loop.vertices.end());
    loop.length = length_of(places, loop.vertices);
    loop.area = length(twice_area(places, loop.vertices)) / 2;
    ++outline.parts[loop.part].loops;
    outline.loops.push_back(std::move(loop));
  }
  if (classify(mesh).shape == Shape::Planar) find_outer_loops(outline.loops, towards, places);
  std::ranges::stable_sort(outline.loops, {},
                           [](const BoundaryLoop& loop) { return std::tuple(loop.part, !loop.outer, loop.vertices.front()); });
  return outline;
}

std::vector<Index> vertices_of_outline(const Mesh& mesh, std::string_view what, std::string_view number) {
  const auto fail = [&](const std::string& why) { throw UsageError(fmt::format("{}:{}: {}", what, number, why)); };
  const bool by_loop = what == "loop";
  if (has_volumes(mesh)) fail(fmt::format("a volume mesh has no {}", by_loop ? "boundary loops" : "numbered parts"));
  const Outline outline = outline_of(mesh);
  const std::size_t count = by_loop ? outline.loops.size() : outline.parts.size();
  const std::string_view one = by_loop ? "boundary loop" : "part";
  if (count == 0) fail(fmt::format("the mesh has no {}", one));
  const auto chosen = number_in<std::uint64_t>(number);
  if (!chosen || *chosen < 1 || *chosen > count)
    fail(count == 1 ? fmt::format("the mesh has one {}, {}:1", one, what)
                    : fmt::format("the mesh has {0} {1}s, {2}:1 to {2}:{0}", count, one, what));
  if (by_loop) return outline.loops[*chosen - 1].vertices;
  std::vector<Index> vertices;
  for (const Index e : outline.parts[*chosen - 1].elements) {
    const auto corners = mesh.elements.corners(e);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  return vertices;
}

std::vector<Index> ordered_ring(const Mesh& mesh, const Topology& topology, Index vertex) {
  // Half-edges of the star alone, with renumbered vertices: those of the whole mesh would take a second.
  std::vector<Index> whole;
  Mesh star;
  for (const Incidence& incidence : topology.star(vertex)) {
    const ElementKind kind = mesh.elements.kind(incidence.element);
    if (info(kind).dimension == 3) return {};
    std::array<Index, 4> corners{};
    const auto own = mesh.elements.corners(incidence.element);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto at = std::ranges::find(whole, own[i]);
      corners[i] = static_cast<Index>(at - whole.begin());
      if (at == whole.end()) whole.push_back(own[i]);
    }
    star.elements.add(kind, std::span(corners).first(own.size()));
  }
  if (whole.empty()) return {};
  for (const Index v : whole) star.positions.push_back(mesh.positions[v]);
  const auto centre = static_cast<Index>(std::ranges::find(whole, vertex) - whole.begin());
  std::vector<Index> ring = HalfEdges(star).ring(centre);
  for (Index& v : ring) v = whole[v];
  return ring;
}

}  // namespace dmoscope
