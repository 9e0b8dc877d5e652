#include "core/input/mesh_region.h"

#include <algorithm>

#include "core/input/mesh_share.h"

namespace dmoscope {
namespace {

/// For each vertex 1 + its distance from the seeds in rings of elements, or 0 beyond `rings`.
std::vector<std::uint8_t> rings_around(const InputMesh& input, std::span<const Index> seeds, int rings) {
  const ElementTable& elements = input.mesh.elements;
  std::vector<std::uint8_t> marks(input.mesh.vertex_count(), 0);
  for (const Index e : seeds)
    for (const Index v : elements.corners(e)) marks[v] = 1;
  for (int ring = 1; ring <= rings; ++ring) {
    if (input.share) input.share->agree(marks);
    for (Index v = 0; v < marks.size(); ++v) {
      if (marks[v] != ring) continue;
      for (const Incidence& incidence : input.topology.star(v))
        for (const Index w : elements.corners(incidence.element))
          if (marks[w] == 0) marks[w] = static_cast<std::uint8_t>(ring + 1);
    }
  }
  if (input.share) input.share->agree(marks);
  return marks;
}

std::uint64_t count_marked(const InputMesh& input, std::span<const std::uint8_t> marks) {
  std::uint64_t count = 0;
  for (Index v = 0; v < marks.size(); ++v) count += marks[v] != 0 && (!input.share || input.share->owns(v)) ? 1 : 0;
  return input.share ? input.share->sum(count) : count;
}

RegionParts parts_here(const InputMesh& input, std::span<const Vec3> positions, std::span<const std::uint8_t> fixed,
                       std::span<const std::uint8_t> marks) {
  const MeshShare* share = input.share.get();
  const auto number = [share](Index v) { return share != nullptr ? share->vertex_numbers()[v] : v; };
  RegionParts parts;
  std::vector<std::uint8_t> taken(marks.size(), 0);
  for (Index e = 0; e < input.mesh.elements.size(); ++e) {
    const auto corners = input.mesh.elements.corners(e);
    if (std::ranges::none_of(corners, [&](Index v) { return marks[v] != 0; }) || (share != nullptr && !share->counts(e))) continue;
    RegionParts::Element element{share != nullptr ? share->element_numbers()[e] : e, input.mesh.elements.kind(e), {}};
    std::ranges::transform(corners, element.corners.begin(), number);
    parts.elements.push_back(element);
    for (const Index v : corners) {
      if (taken[v] != 0) continue;
      taken[v] = 1;
      parts.vertices.push_back({number(v), positions[v], fixed[v], static_cast<std::uint8_t>(marks[v] == 0 && fixed[v] == 0)});
    }
  }
  if (share != nullptr) share->join(parts);
  std::ranges::sort(parts.elements, {}, &RegionParts::Element::number);
  std::ranges::sort(parts.vertices, {}, &RegionParts::Vertex::number);
  const auto same = [](const RegionParts::Vertex& a, const RegionParts::Vertex& b) { return a.number == b.number; };
  parts.vertices.erase(std::unique(parts.vertices.begin(), parts.vertices.end(), same), parts.vertices.end());
  return parts;
}

MeshRegion assembled(const InputMesh& input, const RegionParts& parts) {
  MeshRegion region;
  Mesh mesh;
  mesh.single_precision = input.mesh.single_precision;
  for (const RegionParts::Vertex& vertex : parts.vertices) {
    region.vertices.push_back(vertex.number);
    region.fixed.push_back(vertex.fixed | vertex.rim);
    region.rim.push_back(vertex.rim);
    mesh.positions.push_back(vertex.position);
  }
  std::array<Index, 8> corners{};
  for (const RegionParts::Element& element : parts.elements) {
    const std::size_t count = info(element.kind).corners;
    for (std::size_t i = 0; i < count; ++i)
      corners[i] = static_cast<Index>(std::ranges::lower_bound(region.vertices, element.corners[i]) - region.vertices.begin());
    mesh.elements.add(element.kind, std::span(corners).first(count));
  }
  Topology topology(mesh);
  region.input = std::make_shared<const InputMesh>(InputMesh{std::move(mesh), input.geometry, std::move(topology), {}, {}, {}, {}});
  return region;
}

}  // namespace

bool MeshRegion::touches_rim(Index element) const {
  return std::ranges::any_of(input->mesh.elements.corners(element), [this](Index v) { return rim[v] != 0; });
}

std::optional<MeshRegion> region_around(const InputMesh& input, std::span<const Vec3> positions, std::span<const std::uint8_t> fixed,
                                        std::span<const Index> seeds, int rings, std::size_t most) {
  const std::vector<std::uint8_t> marks = rings_around(input, seeds, rings);
  const std::uint64_t count = count_marked(input, marks);
  if (count == 0 || count > most) return std::nullopt;
  return assembled(input, parts_here(input, positions, fixed, marks));
}

Index find_vertex(const InputMesh& input, std::uint64_t number) {
  if (!input.share) return static_cast<Index>(number);
  const auto numbers = input.share->vertex_numbers();
  const auto found = std::ranges::lower_bound(numbers, number);
  return found != numbers.end() && *found == number ? static_cast<Index>(found - numbers.begin()) : kNoIndex;
}

}  // namespace dmoscope
