#include "core/reference/surface_ends.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "core/mesh/orientation.h"
#include "core/reference/attachment.h"
#include "core/reference/hold.h"

namespace dmoscope {

namespace {

/// Collects the faces, parts them at feature edges, and finds the vertices that are held.
class SurfaceFinder {
 public:
  /// `is_reference`: whether another mesh slides on the surface, so that creases that end in it are none.
  SurfaceFinder(const InputMesh& input, const StandingRule& rule, bool is_reference)
      : input_(input), rule_(rule), is_reference_(is_reference), ends_(input.mesh.vertex_count()), names_(input.mesh, input.topology) {}

  SurfaceEnds find() {
    collect_faces();
    find_named_edges();
    if (input_.surface) return find_on_another();
    const std::vector<Index> links = part();
    hold_what_stays();
    const auto facets = std::make_shared<const Facets>(input_.mesh, faces_, links);
    hold_touching(*facets);
    hold_parting(input_, faces_, ends_);
    SlidingFaces faces(input_, std::move(faces_), facets);
    const std::vector<Index> home = facets->whole_fans();
    for (Index v = 0; v < ends_.size(); ++v)
      if (ends_.off(v)) faces.carry(v, home[v]);
    return {std::move(ends_), std::move(faces)};
  }

 private:
  /// Finds feature edges and corners by the surface of another mesh; edges that the file names along none of these stay.
  SurfaceEnds find_on_another() {
    const StandingRule of_reference{InterfaceRule::Slide, BoundaryRule::Slide, rule_.corner_angle, rule_.feature_angle};
    SurfaceEnds reference = SurfaceFinder(*input_.surface, of_reference, true).find();
    Attachment attachment(input_, faces_, *input_.surface, reference.faces.shared_facets(), reference.curves, rule_.fit);
    attachment_ = &attachment;
    for (Index v = 0; v < ends_.size(); ++v)
      if (attachment.on_corner(v)) ends_.hold(v, HeldOn::Corner);
    const std::vector<Index> links = part();
    hold_what_stays();
    const Facets own(input_.mesh, faces_, links);
    hold_touching(own);
    SlidingFaces faces = attachment.lay(std::move(faces_), own, ends_);
    return {std::move(ends_), std::move(faces), attachment.take_lines()};
  }

  using Key = std::array<Index, 4>;
  using Edge = std::array<Index, 2>;
  [[nodiscard]] bool on_boundary(Index v) const { return input_.topology.boundary()[v] != 0; }
  static Key key_of(std::span<const Index> corners) {
    Key key{kNoIndex, kNoIndex, kNoIndex, kNoIndex};
    std::ranges::copy(corners, key.begin());
    std::ranges::sort(key);
    return key;
  }
  static Edge edge_of(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

  void collect_faces() {
    if (input_.is_surface()) return collect_elements();
    if (rule_.boundary == BoundaryRule::Slide)
      for (const ElementFace& face : input_.faces.boundary()) add(face);
    boundary_faces_ = faces_.size();
    if (rule_.interfaces == InterfaceRule::Slide) {
      for (Index e = 0; e < input_.mesh.elements.size(); ++e) {
        const auto across = input_.faces.of(e);
        for (Index f = 0; f < across.size(); ++f)
          if (across[f] != kNoIndex && across[f] > e && input_.interfaces.between(e, across[f])) add({e, f});
      }
    }
    name_faces();
  }

  /// Collects the elements of a surface mesh as faces, wound alike as far as possible.
  void collect_elements() {
    Index contradictions = 0;
    const auto against = relate_windings(input_.mesh, input_.topology, contradictions);
    const ElementTable& elements = input_.mesh.elements;
    for (Index e = 0; e < elements.size(); ++e) {
      add(elements.corners(e));
      if (against[e] != 0) faces_.flip(e);
    }
    name_of_.assign(faces_.size(), 0);
    if (rule_.interfaces == InterfaceRule::Free) return;
    for (Index v = 0; v < ends_.size() && rule_.interfaces == InterfaceRule::Fixed; ++v)
      if (input_.interfaces.holds(v) || input_.interfaces.meets_boundary_at(v)) ends_.hold(v, HeldOn::Rule);
  }

  void add(ElementFace face) {
    const Key corners = vertices_of(input_.mesh.elements, face);
    add(std::span(corners).first(corners[3] == kNoIndex ? 3 : 4));
  }
  /// Adds a face: a quadrilateral with a repeated corner as a triangle; the corners of other degenerate faces are held.
  void add(std::span<const Index> corners) {
    std::array<Index, 4> kept{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (corners[i] != corners[i + 1 < corners.size() ? i + 1 : 0]) kept[count++] = corners[i];
    if (count < 3) {
      for (const Index v : corners) ends_.hold(v, HeldOn::Touching);
      count = 3;
      std::ranges::copy(corners.first(3), kept.begin());
    }
    faces_.add(count == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, std::span(kept).first(count));
  }

  /// Gives each face the set of groups that name it, numbered; holds the corners of the faces that groups name elsewhere.
  void name_faces() {
    name_of_.assign(faces_.size(), 0);
    std::vector<const Group*> groups;
    for (const Group& group : input_.mesh.groups)
      if (group.dimension == 2 && group.faces.size() > 0) groups.push_back(&group);
    if (groups.empty()) return;
    std::map<Key, Index> face_of;
    for (Index f = 0; f < faces_.size(); ++f) face_of.emplace(key_of(faces_.corners(f)), f);
    NamedList list(NamedKind::Faces, groups, input_.mesh, input_.topology);
    std::map<std::pair<Index, Index>, Index> sets;  // number of a set with a group added, by set and group
    for (Index g = 0; g < groups.size(); ++g) {
      const ElementTable& named = groups[g]->faces;
      for (Index i = 0; i < named.size(); ++i) {
        const auto found = face_of.find(key_of(named.corners(i)));
        if (found != face_of.end()) {
          Index& name = name_of_[found->second];
          name = sets.try_emplace({name, g}, static_cast<Index>(sets.size() + 1)).first->second;
        } else if (rule_.interfaces != InterfaceRule::Free) {
          for (const Index v : named.corners(i))
            if (!list.surrounds(v)) ends_.hold(v, HeldOn::Named);
        }
      }
    }
  }

  void find_named_edges() {
    if (input_.is_surface() && rule_.interfaces == InterfaceRule::Free) return;
    names_.for_lines([this](Index a, Index b) { named_edges_.push_back(edge_of(a, b)); });
    std::ranges::sort(named_edges_);
  }

  struct Side {
    Edge edge;
    Index face, corner;  // the corner: index among all corners
    bool forwards;
  };
  /// Sides of all faces, by edge.
  [[nodiscard]] std::vector<Side> sides_of_faces() const {
    std::vector<Side> sides;
    for (Index f = 0; f < faces_.size(); ++f) {
      const auto c = faces_.corners(f);
      for (Index i = 0; i < c.size(); ++i) {
        const Index a = c[i], b = c[i + 1 < c.size() ? i + 1 : 0];
        if (a == b) continue;
        sides.push_back({edge_of(a, b), f, faces_.offsets()[f] + i, a < b});
      }
    }
    std::ranges::sort(sides, {}, [](const Side& s) { return std::pair(s.edge, s.corner); });
    return sides;
  }

  /// Joins feature edges, and returns the links across all other edges; see Facets.
  std::vector<Index> part() {
    const std::vector<Side> sides = sides_of_faces();
    if (is_reference_) find_dead_ends(sides);
    std::vector<Index> links(faces_.all_corners().size(), kNoIndex);
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
      const Side &one = sides[first], &other = sides[last - 1];
      const auto [a, b] = one.edge;
      const bool touches = input_.is_surface() ? last - first > 2 : first + 2 < last && sides[first + 2].face < boundary_faces_;
      const bool twisted = input_.is_surface() && last - first == 2 && one.forwards == other.forwards;  // like in a Moebius strip
      if (touches || twisted) ends_.hold(a, HeldOn::Touching), ends_.hold(b, HeldOn::Touching);
      if (last - first == 2 && one.forwards != other.forwards && !is_feature(one.edge, one.face, other.face)) {
        links[one.corner] = other.corner;
        links[other.corner] = one.corner;
      } else if (attachment_ == nullptr || attachment_->is_along(a, b)) {
        ends_.join(a, b);
      } else {
        for (const Index v : one.edge) ends_.hold(v, last - first == 2 ? HeldOn::Named : HeldOn::Unmatched);
      }
    }
    settle_named_edges();
    return links;
  }

  /// Finds the creases of a line that ends inside the surface, as those of a coarse or noisy surface do: no shape has an edge there.
  void find_dead_ends(std::span<const Side> sides) {
    std::map<Index, std::vector<std::pair<Index, bool>>>
        edges_at;  // by vertex, the other ends of feature edges, and whether they fold alone
    for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
      while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
      const auto [a, b] = sides[first].edge;
      const bool between_two = last - first == 2 && sides[first].forwards != sides[first + 1].forwards;
      if (between_two && !is_feature(sides[first].edge, sides[first].face, sides[first + 1].face)) continue;
      edges_at[a].emplace_back(b, between_two && !is_named(sides[first].edge, sides[first].face, sides[first + 1].face));
      edges_at[b].emplace_back(a, edges_at[a].back().second);
    }
    std::vector<Index> ends;
    for (const auto& [v, edges] : edges_at) ends.push_back(v);
    while (!ends.empty()) {
      const Index v = ends.back();
      ends.pop_back();
      auto& edges = edges_at[v];
      if (edges.size() != 1 || !edges.front().second) continue;
      const Index other = edges.front().first;
      dead_ends_.push_back(edge_of(v, other));
      edges.clear();
      std::erase_if(edges_at[other], [v](const auto& edge) { return edge.first == v; });
      ends.push_back(other);
    }
    std::ranges::sort(dead_ends_);
  }

  /// Whether the file makes an edge a feature.
  [[nodiscard]] bool is_named(const Edge& edge, Index face, Index other) const {
    const bool interfaces = input_.is_surface() && rule_.interfaces != InterfaceRule::Free && input_.interfaces.between(face, other);
    return interfaces || name_of_[face] != name_of_[other] || std::ranges::binary_search(named_edges_, edge);
  }
  [[nodiscard]] bool is_feature(const Edge& edge, Index face, Index other) const {
    if (is_named(edge, face, other)) return true;
    if (std::ranges::binary_search(dead_ends_, edge)) return false;
    if (attachment_ != nullptr) return attachment_->is_along(edge[0], edge[1]);
    const Vec3 a = normal(face), b = normal(other);
    if (a == Vec3{} || b == Vec3{} || rule_.kinds.has_feature(edge)) return true;
    return !(std::atan2(length(cross(a, b)), dot(a, b)) <= rule_.feature_angle * kDegree) && !rule_.kinds.has_no_feature(edge);
  }
  [[nodiscard]] Vec3 normal(Index face) const {
    const auto c = faces_.corners(face);
    const auto at = [&](std::size_t i) { return input_.mesh.positions[c[i]]; };
    const Vec3 across = c.size() == 3 ? cross(at(1) - at(0), at(2) - at(0)) : cross(at(2) - at(0), at(3) - at(1));
    const double size = length(across);
    return size > 0.0 ? (1.0 / size) * across : Vec3{};
  }

  /// Holds the ends of lines that the file names inside, unless interfaces are free.
  void settle_named_edges() {
    if (rule_.interfaces == InterfaceRule::Free || input_.is_surface()) return;
    for (const auto& [a, b] : named_edges_) {
      const bool along_a = ends_.slides(a) && (ends_.of(a)[0] == b || ends_.of(a)[1] == b);
      const bool along_b = ends_.slides(b) && (ends_.of(b)[0] == a || ends_.of(b)[1] == a);
      if (!along_a) ends_.hold(a, HeldOn::Named);
      if (!along_b) ends_.hold(b, HeldOn::Named);
    }
  }

  void hold_what_stays() {
    for (const ElementFace& face : input_.faces.non_manifold())
      for (const Index v : vertices_of(input_.mesh.elements, face))
        if (v != kNoIndex) ends_.hold(v, HeldOn::Touching);
    for (Index v = 0; v < ends_.size(); ++v) {
      const bool stays = rule_.boundary != BoundaryRule::Slide && on_boundary(v);
      if (stays || (rule_.interfaces == InterfaceRule::Fixed && input_.interfaces.meets_boundary_at(v))) ends_.hold(v, HeldOn::Rule);
    }
    hold_said_corners();
    if (attachment_ == nullptr) hold_corners(input_, rule_, ends_);
    hold_ends_of_names(names_, ends_);
    hold_tied(input_, ends_);
    hold_named_points(input_, ends_);
  }

  /// Holds corners by hand; vertices off the faces do not slide anyway.
  void hold_said_corners() {
    if (rule_.kinds.corners.empty()) return;
    for (const Index v : faces_.all_corners())
      if (rule_.kinds.has_corner(v)) ends_.hold(v, HeldOn::Hand);
  }

  /// Holds a vertex of a curve if a sheet of the surface touches it that does not reach from one of its edges to the other.
  void hold_touching(const Facets& facets) {
    for (Index v = 0; v < ends_.size(); ++v) {
      if (!ends_.slides(v)) continue;
      const auto [a, b] = ends_.of(v);
      std::vector<Index> reached;
      for (const FacetSide& side : facets.sides_of(v, a)) {
        const auto fan = facets.fan_at(side.facet, v);
        const auto ends_there = [&](const FacetSide& s) { return std::ranges::find(fan, s.facet) != fan.end(); };
        if (std::ranges::any_of(facets.sides_of(v, b), ends_there)) reached.insert(reached.end(), fan.begin(), fan.end());
      }
      std::ranges::sort(reached);
      reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
      if (reached.size() != facets.count_at(v)) ends_.hold(v, HeldOn::Touching);
    }
  }

  const InputMesh& input_;
  const StandingRule& rule_;
  bool is_reference_;
  const Attachment* attachment_ = nullptr;  // attachment to the surface of another mesh
  CurveEnds ends_;
  NamedEdges names_;
  ElementTable faces_;
  Index boundary_faces_ = 0;  // number of boundary faces, which come first; the others are those of interfaces
  std::vector<Index> name_of_;
  std::vector<Edge> named_edges_;  // edges in ascending order
  std::vector<Edge> dead_ends_;    // of a reference; edges in ascending order
};

}  // namespace

SurfaceEnds surface_ends(const InputMesh& input, const StandingRule& rule) { return SurfaceFinder(input, rule, false).find(); }

}  // namespace dmoscope
