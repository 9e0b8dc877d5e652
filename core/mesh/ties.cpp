#include "core/mesh/ties.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace dmoscope {

namespace {

bool share_an_element(const Mesh& mesh, const Topology& topology, Index a, Index b) {
  return std::ranges::any_of(topology.star(a), [&](const Incidence& at) {
    const auto corners = mesh.elements.corners(at.element);
    return std::ranges::find(corners, b) != corners.end();
  });
}

/// Calls take(a, b), a < b, for vertices of the boundary at one place of which no element has both: of three there, with two pairs.
template <class Take>
void for_doubles(const Mesh& mesh, const Topology& topology, const Take& take) {
  std::vector<Index> order;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (topology.boundary()[v] != 0 && !topology.star(v).empty()) order.push_back(v);
  const auto place = [&mesh](Index v) {
    const Vec3 p = mesh.positions[v];
    return std::tuple(p.x, p.y, p.z);
  };
  std::ranges::sort(order, {}, [&](Index v) { return std::tuple(place(v), v); });
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Index a = order[i - 1], b = order[i];
    if (place(a) == place(b) && !share_an_element(mesh, topology, a, b)) take(a, b);
  }
}

/// Whether two faces of an element on the boundary have no corner in common.
bool stands_between_boundaries(const Mesh& mesh, const FaceNeighbours& faces, Index element) {
  const auto across = faces.of(element);
  const auto local = faces_of(mesh.elements.kind(element));
  for (std::size_t a = 0; a < local.size(); ++a) {
    for (std::size_t b = a + 1; b < local.size(); ++b) {
      if (across[a] != kNoIndex || across[b] != kNoIndex || local[a].count != local[b].count) continue;
      const auto one = local[a].span(), other = local[b].span();
      if (std::ranges::none_of(one, [&](Index corner) { return std::ranges::find(other, corner) != other.end(); })) return true;
    }
  }
  return false;
}

}  // namespace

bool is_one_cell_thick(const Mesh& mesh, const Topology& topology, const FaceNeighbours& faces) {
  const auto prismatic = [](ElementKind kind) { return kind == ElementKind::Wedge || kind == ElementKind::Hexahedron; };
  if (mesh.elements.size() == 0 || !std::ranges::all_of(mesh.elements.kinds(), prismatic)) return false;
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (!topology.star(v).empty() && topology.boundary()[v] == 0) return false;
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (!stands_between_boundaries(mesh, faces, e)) return false;
  return true;
}

std::vector<Partners> find_partners(const Mesh& mesh, const Topology& topology) {
  std::vector<Partners> partners;
  for (const auto& [one, other] : mesh.periodic) {
    const Index first = std::min(one, other), second = std::max(one, other);
    if (!share_an_element(mesh, topology, first, second))
      partners.push_back({first, second, mesh.positions[second] - mesh.positions[first]});
  }
  for_doubles(mesh, topology, [&partners](Index a, Index b) { partners.push_back({a, b}); });
  const auto ends = [](const Partners& pair) { return std::pair(pair.first, pair.second); };
  std::ranges::stable_sort(partners, {}, ends);
  const auto same = [&ends](const Partners& a, const Partners& b) { return ends(a) == ends(b); };
  partners.erase(std::unique(partners.begin(), partners.end(), same), partners.end());
  return partners;
}

std::vector<Tie> find_ties(const Mesh& mesh, const Topology& topology, const FaceNeighbours& faces) {
  std::vector<Tie> ties(mesh.vertex_count(), Tie::None);
  for (const auto& [one, other] : mesh.periodic) ties[one] = ties[other] = Tie::Periodic;
  for_doubles(mesh, topology, [&ties](Index a, Index b) {
    for (const Index v : {a, b})
      if (ties[v] == Tie::None) ties[v] = Tie::Double;
  });
  if (is_one_cell_thick(mesh, topology, faces))
    for (Tie& tie : ties) tie = tie == Tie::None ? Tie::Pair : tie;
  return ties;
}

}  // namespace dmoscope
