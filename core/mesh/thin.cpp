#include "core/mesh/thin.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/base/vec.h"
#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"
#include "core/mesh/plane.h"

namespace dmoscope {

namespace {

/// A way for a cell to stand between two sheets: the corners of one face, and each one's partner on the opposite face, which is the corner
/// itself on an edge that both faces share. Seen from outside of the cell the first face runs clockwise: its normal points to the other.
struct PairedFaces {
  std::array<std::uint8_t, 4> bottom, top;
  std::uint8_t count;  // 3 or 4
};

constexpr std::array<PairedFaces, 3> kOfHexahedra{
    {{{0, 1, 2, 3}, {4, 5, 6, 7}, 4}, {{0, 3, 7, 4}, {1, 2, 6, 5}, 4}, {{0, 4, 5, 1}, {3, 7, 6, 2}, 4}}};
/// Ways of a wedge: upright, or lying with one of its three long edges on the axis.
constexpr std::array<PairedFaces, 4> kOfWedges{
    {{{0, 1, 2, 0}, {3, 4, 5, 0}, 3}, {{0, 3, 4, 1}, {0, 3, 5, 2}, 4}, {{1, 4, 5, 2}, {1, 4, 3, 0}, 4}, {{2, 5, 3, 0}, {2, 5, 4, 1}, 4}}};

std::span<const PairedFaces> ways_of(ElementKind kind) {
  return kind == ElementKind::Wedge ? std::span<const PairedFaces>(kOfWedges) : std::span<const PairedFaces>(kOfHexahedra);
}

/// A way chosen for a cell, as an index into ways_of(); `turned`: its top is the front.
struct Way {
  std::uint8_t number = 0;
  bool turned = false;
};

class Finder {
 public:
  Finder(const Mesh& mesh, const FaceNeighbours& faces)
      : mesh_(mesh), faces_(faces), way_(mesh.elements.size()), possible_(mesh.elements.size()) {
    const std::size_t vertices = mesh.positions.size();
    found_.front.assign(vertices, kNoIndex);
    found_.back.assign(vertices, kNoIndex);
  }

  FrontFaces find() {
    if (!faces_.non_manifold().empty()) return refused("some of its faces are of more than two cells");
    for (Index e = 0; e < size(); ++e) {
      possible_[e] = possible_ways(e);
      if (possible_[e] == 0) return refused(fmt::format("cell {} has no two faces across from each other on the boundary", e));
    }
    for (Index e = 0; e < size(); ++e)
      if (!way_[e] && std::has_single_bit(possible_[e]) && !follow(e)) return refused(std::move(why_not_));
    for (Index e = 0; e < size(); ++e)
      if (!way_[e]) return refused(fmt::format("cell {} may stand in several ways, and no neighbour tells in which", e));
    if (!keeps_its_thickness()) return refused(std::move(why_not_));
    take();
    return std::move(found_);
  }

 private:
  [[nodiscard]] Index size() const noexcept { return mesh_.elements.size(); }

  static FrontFaces refused(std::string why) {
    FrontFaces none;
    none.why_not = std::move(why);
    return none;
  }

  /// Bits of those of ways_of() whose two faces are both on the boundary.
  [[nodiscard]] std::uint8_t possible_ways(Index e) const {
    const ElementKind kind = mesh_.elements.kind(e);
    const auto local = faces_of(kind);
    const auto across = faces_.of(e);
    const auto outside = [&](const std::array<std::uint8_t, 4>& corners, std::uint8_t count) {
      for (std::size_t f = 0; f < local.size(); ++f) {
        const auto own = local[f].span();
        const auto has = [own](Index corner) { return std::ranges::find(own, corner) != own.end(); };
        if (own.size() == count && std::all_of(corners.begin(), corners.begin() + count, has)) return across[f] == kNoIndex;
      }
      return false;
    };
    const auto ways = ways_of(kind);
    unsigned possible = 0;
    for (std::size_t w = 0; w < ways.size(); ++w)
      if (outside(ways[w].bottom, ways[w].count) && outside(ways[w].top, ways[w].count)) possible |= 1U << w;
    return static_cast<std::uint8_t>(possible);
  }

  /// Calls see(vertex of the front, its partner) for each corner of the front.
  template <class See>
  void for_pairs(Index e, Way way, const See& see) const {
    const auto corners = mesh_.elements.corners(e);
    const PairedFaces& pair = ways_of(mesh_.elements.kind(e))[way.number];
    for (std::size_t i = 0; i < pair.count; ++i) {
      const Index low = corners[pair.bottom[i]], high = corners[pair.top[i]];
      way.turned ? see(high, low) : see(low, high);
    }
  }

  /// Whether the pairs of this way agree with those known already.
  [[nodiscard]] bool fits(Index e, Way way) const {
    bool fit = true;
    for_pairs(e, way, [&](Index front, Index back) {
      const Index known = found_.front[front], known_back = found_.front[back];
      if (known != kNoIndex && (known != front || found_.back[front] != back)) fit = false;
      if (known_back != kNoIndex && known_back != front) fit = false;
    });
    return fit;
  }

  /// The only way of the cell that agrees with the known pairs; none if there are several or none.
  [[nodiscard]] std::optional<Way> fitting(Index e) const {
    std::optional<Way> only;
    for (std::uint8_t w = 0; w < ways_of(mesh_.elements.kind(e)).size(); ++w) {
      if ((possible_[e] >> w & 1U) == 0) continue;
      for (const bool turned : {false, true}) {
        if (!fits(e, {w, turned})) continue;
        if (only) return std::nullopt;
        only = Way{w, turned};
      }
    }
    return only;
  }

  void stand(Index e, Way way) {
    way_[e] = way;
    for_pairs(e, way, [&](Index front, Index back) {
      found_.front[front] = found_.front[back] = front;
      found_.back[front] = back;
    });
  }

  [[nodiscard]] Vec3 offset(Index e, Way way) const {
    Vec3 sum;
    for_pairs(e, way, [&](Index front, Index back) { sum = sum + (mesh_.positions[back] - mesh_.positions[front]); });
    return sum;
  }

  /// Way of the first cell of a part: in the first part the front has the lowest vertex; further parts have their front on that side.
  [[nodiscard]] Way first_way(Index e) {
    Way way{static_cast<std::uint8_t>(std::countr_zero(possible_[e])), false};
    if (const Way other{way.number, true}; !fits(e, way) && fits(e, other)) return other;
    if (!begun_) {
      std::pair<Index, Index> least{kNoIndex, kNoIndex};
      for_pairs(e, way, [&](Index front, Index back) {
        if (front != back) least = {std::min(least.first, front), std::min(least.second, back)};
      });
      way.turned = least.second < least.first;
      ahead_ = offset(e, way);
      begun_ = true;
    } else if (fits(e, {way.number, true})) {
      way.turned = dot(offset(e, way), ahead_) < 0.0;
    }
    return way;
  }

  /// Follows the neighbours from a cell to all connected ones. False: they contradict each other.
  bool follow(Index first) {
    const Way way = first_way(first);
    if (!fits(first, way)) return contradicted(first);
    stand(first, way);
    std::vector<Index> queue{first};
    while (!queue.empty()) {
      const Index e = queue.back();
      queue.pop_back();
      for (const Index next : faces_.of(e)) {
        if (next == kNoIndex || way_[next]) continue;
        const std::optional<Way> way_on = fitting(next);
        if (!way_on) return contradicted(next);
        stand(next, *way_on);
        queue.push_back(next);
      }
    }
    return true;
  }

  bool contradicted(Index e) {
    why_not_ = fmt::format("cell {} does not stand between front and back as its neighbours do", e);
    return false;
  }

  /// Whether the thickness changes slowly enough, see take_front().
  bool keeps_its_thickness() {
    constexpr double kMost = 0.25;
    for (Index e = 0; e < size(); ++e) {
      std::array<std::pair<Vec3, Vec3>, 4> corners;  // position, and offset to the back
      std::size_t n = 0;
      for_pairs(e, *way_[e], [&](Index front, Index back) {
        corners[n++] = {mesh_.positions[front], mesh_.positions[back] - mesh_.positions[front]};
      });
      for (std::size_t i = 0; i < n; ++i) {
        const auto& [at, ahead] = corners[i];
        const auto& [next, next_ahead] = corners[(i + 1) % n];
        if (length(next_ahead - ahead) <= kMost * length(next - at)) continue;
        why_not_ = fmt::format("the back of cell {} has another shape than its front", e);
        return false;
      }
    }
    return true;
  }

  void take() {
    found_.corners.resize(size());
    found_.counts.resize(size());
    for (Index e = 0; e < size(); ++e) {
      std::array<Index, 4>& corners = found_.corners[e];
      std::uint8_t& n = found_.counts[e];
      for_pairs(e, *way_[e], [&](Index front, Index) { corners[n++] = front; });
      if (way_[e]->turned) std::reverse(corners.begin() + 1, corners.begin() + n);
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (found_.front[v] == kNoIndex) found_.front[v] = v;
  }

  const Mesh& mesh_;
  const FaceNeighbours& faces_;
  std::vector<std::optional<Way>> way_;
  std::vector<std::uint8_t> possible_;
  FrontFaces found_;
  std::string why_not_;
  Vec3 ahead_{};
  bool begun_ = false;
};

}  // namespace

std::string why_not_prismatic(const Mesh& mesh) {
  const auto prismatic = [](ElementKind kind) { return kind == ElementKind::Wedge || kind == ElementKind::Hexahedron; };
  if (mesh.elements.size() == 0 || !std::ranges::all_of(mesh.elements.kinds(), prismatic))
    return "not all of its cells are hexahedra and wedges";
  // Bounds the number of ways at a vertex: around a vertex of a triangulated sheet are six cells on average, and more only if sheets have
  // many handles.
  constexpr std::size_t kMost = 7;
  if (mesh.elements.all_corners().size() > kMost * mesh.positions.size()) return "its vertices have cells on all sides";
  return {};
}

FrontFaces find_front_faces(const Mesh& mesh, const FaceNeighbours& faces) { return Finder(mesh, faces).find(); }

namespace {

constexpr std::array<std::string_view, 3> kThinWords{"off", "on", "auto"};

/// The front faces as elements. If the normals, which point to the back, look down a coordinate axis, all are reversed, as planar meshes
/// are wound so.
ElementTable as_elements(const FrontFaces& found, std::span<const Vec3> positions) {
  Vec3 normal;
  for (std::size_t e = 0; e < found.corners.size(); ++e) {
    const auto& c = found.corners[e];
    const Vec3 across = positions[c[2]] - positions[c[0]];
    normal = normal +
             (found.counts[e] == 4 ? cross(across, positions[c[3]] - positions[c[1]]) : cross(positions[c[1]] - positions[c[0]], across));
  }
  const Vec3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const double largest = size.z >= size.x && size.z >= size.y ? normal.z : size.y >= size.x ? normal.y : normal.x;
  ElementTable elements;
  elements.reserve(found.corners.size(), 4 * found.corners.size());
  for (std::size_t e = 0; e < found.corners.size(); ++e) {
    std::array<Index, 4> corners = found.corners[e];
    const ElementKind kind = found.counts[e] == 4 ? ElementKind::Quadrilateral : ElementKind::Triangle;
    if (largest < 0.0) flip_corners(kind, corners.data());
    elements.add(kind, std::span<const Index>(corners).first(found.counts[e]));
  }
  return elements;
}

/// Groups of the cells' vertices, edges and faces, carried over to the front.
class FrontGroups {
 public:
  FrontGroups(const Mesh& mesh, const FrontFaces& found) : mesh_(mesh), found_(found) {}

  [[nodiscard]] std::vector<Group> find() {
    std::vector<Group> groups;
    for (const Group& group : mesh_.groups) groups.push_back(on_front(group));
    return groups;
  }

 private:
  [[nodiscard]] Group on_front(const Group& group) {
    if (group.of_elements()) return group;
    if (group.dimension == 2) return of_faces(group);
    Group one{group.name, group.role, group.code, group.dimension, {}, {}};
    const std::size_t step = group.dimension == 1 ? 2 : 1;
    std::vector<std::array<Index, 2>> seen;
    for (std::size_t i = 0; i + step <= group.members.size(); i += step) {
      const Index a = found_.front[group.members[i]], b = found_.front[group.members[i + step - 1]];
      if (step == 2 && a == b) continue;  // an edge from front to back
      seen.push_back({a, b});
    }
    add_each_once(seen, step, one.members);
    return one;
  }

  /// Appends each vertex or edge once, in the order in which it came first; edges in either direction are the same.
  static void add_each_once(const std::vector<std::array<Index, 2>>& seen, std::size_t step, std::vector<Index>& members) {
    std::map<std::array<Index, 2>, bool> there;
    for (const auto& [a, b] : seen) {
      if (!there.emplace(std::array{std::min(a, b), std::max(a, b)}, true).second) continue;
      members.push_back(a);
      if (step == 2) members.push_back(b);
    }
  }

  /// Group of faces on the front: faces between front and back become edges, faces of front or back elements; with both it becomes one of
  /// vertices.
  [[nodiscard]] Group of_faces(const Group& group) {
    std::vector<std::array<Index, 2>> edges, vertices;
    std::vector<Index> elements;
    for (Index f = 0; f < group.faces.size(); ++f) {
      std::vector<Index> corners;
      for (const Index v : group.faces.corners(f)) {
        const Index front = found_.front[v];
        vertices.push_back({front, front});
        if (std::ranges::find(corners, front) == corners.end()) corners.push_back(front);
      }
      if (corners.size() == 2) edges.push_back({corners[0], corners[1]});
      if (corners.size() == group.faces.corners(f).size()) {
        if (const std::optional<Index> e = element_at(corners)) elements.push_back(*e);
      }
    }
    Group one{group.name, group.role, group.code, 0, {}, {}};
    if (edges.empty() && !elements.empty()) {
      one.dimension = 2;
      std::ranges::sort(elements);
      elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
      one.members = std::move(elements);
    } else if (elements.empty() && !edges.empty()) {
      one.dimension = 1;
      add_each_once(edges, 2, one.members);
    } else {
      add_each_once(vertices, 1, one.members);
    }
    return one;
  }

  std::optional<Index> element_at(std::vector<Index> corners) {
    if (elements_.empty()) {
      for (Index e = 0; e < found_.corners.size(); ++e) {
        std::vector<Index> own(found_.corners[e].begin(), found_.corners[e].begin() + found_.counts[e]);
        std::ranges::sort(own);
        elements_.emplace(std::move(own), e);
      }
    }
    std::ranges::sort(corners);
    const auto at = elements_.find(corners);
    return at == elements_.end() ? std::nullopt : std::optional(at->second);
  }

  const Mesh& mesh_;
  const FrontFaces& found_;
  std::map<std::vector<Index>, Index> elements_;
};

std::vector<std::array<Index, 2>> periodic_on_front(const Mesh& mesh, const FrontFaces& found) {
  std::vector<std::array<Index, 2>> pairs;
  for (const auto& [one, other] : mesh.periodic)
    if (const std::array pair{found.front[one], found.front[other]}; pair[0] != pair[1]) pairs.push_back(pair);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::string_view name(Thin choice) { return kThinWords[static_cast<std::size_t>(choice)]; }

Thin parse_thin(std::string_view word) { return parse_choice<Thin>("choice for meshes one cell thick", word, kThinWords); }

std::string take_front(Mesh& mesh, Progress& progress) {
  if (std::string why = why_not_prismatic(mesh); !why.empty()) return why;
  progress.begin("looking for front and back");
  Mesh turned;
  turned.positions = mesh.positions;
  turned.elements = mesh.elements;
  FaceNeighbours faces(turned, &progress);
  if (normalise_orientation(turned, faces).flipped > 0) faces = FaceNeighbours(turned, &progress);
  FrontFaces found = find_front_faces(turned, faces);
  if (!found.why_not.empty()) return std::move(found.why_not);
  ElementTable front = as_elements(found, mesh.positions);
  std::vector<Group> groups = FrontGroups(mesh, found).find();
  std::vector<std::array<Index, 2>> periodic = periodic_on_front(mesh, found);
  std::swap(groups, mesh.groups);
  std::swap(periodic, mesh.periodic);
  mesh.elements = std::move(front);
  mesh.thin = std::make_shared<const ThinMesh>(ThinMesh{std::move(turned.elements), std::move(turned.flipped), std::move(groups),
                                                        std::move(periodic), std::move(found.front), std::move(found.back)});
  return {};
}

Index on_front(const Mesh& mesh, Index vertex) { return mesh.thin ? mesh.thin->front[vertex] : vertex; }

Mesh with_cells(Mesh mesh) {
  if (!mesh.thin) return mesh;
  const std::shared_ptr<const ThinMesh> thin = std::move(mesh.thin);
  mesh.thin = nullptr;
  mesh.elements = thin->elements;
  mesh.flipped = thin->flipped;
  mesh.groups = thin->groups;
  mesh.periodic = thin->periodic;
  return mesh;
}

}  // namespace dmoscope
