#include "core/mesh/thin.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/mesh/faces.h"
#include "core/mesh/front_faces.h"
#include "core/mesh/plane.h"
#include "core/mesh/volume.h"

namespace dmoscope {
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
