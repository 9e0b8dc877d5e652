#include "core/target/boundary_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "core/mesh/edges.h"
#include "core/mesh/faces.h"
#include "core/mesh/topology.h"

namespace dmoscope {

namespace {

constexpr double kAtWall = 2.0, kAbove = 1.2;  // least width over height of the first element of a stack, and of those above
constexpr double kShrinks = 0.8;               // layers get higher from the wall on: least height over that of the one below
constexpr double kFlat = 4.0,
                 kGrown = 1.5;      // for a pronounced stack: width over height of the first, height of the last over that of the first
constexpr std::size_t kLayers = 3;  // least number
constexpr double kEven = 0.95, kSteps = 2.5;  // least and most height over that of the layer beneath
constexpr double kUpright = 0.5;              // sine of the angle between the wall and the way up below which an element leans
constexpr double kMostLeaning = 0.15;         // share of layers that lean, in stacks that begin flat
constexpr std::uint16_t kHighest = 60000;     // layers of a stack

struct Extent {
  double width = 0.0, height = 0.0;  // mean width along the wall and mean height away from it
  double upright = 0.0;              // sine of the angle between the wall and the way up
  /// Returns whether it may be in a stack upon a layer of height `below`.
  [[nodiscard]] bool is_layer_on(double below, double flattest) const {
    return height > 0.0 && width >= flattest * height && height >= kShrinks * below;
  }
};

/// Widths and heights of elements that stand on one of their sides.
class Shapes {
 public:
  Shapes(const Mesh& mesh, const Plane& plane, std::span<const Vec3> positions) : mesh_(mesh), plane_(plane), positions_(positions) {}

  /// Height and width of a quadrilateral that stands on the edge from its first corner to the second.
  [[nodiscard]] Extent extent(const std::array<Index, 4>& c) const {
    const auto way = [&](std::size_t i) { return difference(c[(i + 1) % 4], c[i]); };
    const auto side = [&](std::size_t i) { return length(way(i)); };
    const Vec3 along = way(0) - way(2), up = way(1) - way(3);
    return {0.5 * (side(0) + side(2)), 0.5 * (side(1) + side(3)), length(cross(along, up)) / (length(along) * length(up))};
  }
  /// Height of a planar element above one of its edges; a triangle's is the shorter one of its two other edges.
  [[nodiscard]] double height(Index element, Index edge) const {
    const auto c = mesh_.elements.corners(element);
    const std::size_t n = c.size();
    const auto side = [&](std::size_t i) { return distance(c[(edge + i + 1) % n], c[(edge + i) % n]); };
    return n == 3 ? std::min(side(1), side(2)) : 0.5 * (side(1) + side(3));
  }
  [[nodiscard]] double distance(Index a, Index b) const { return length(difference(a, b)); }

  /// Face opposite to one; none where there is no such face.
  [[nodiscard]] static std::optional<Index> opposite(ElementKind kind, Index face) {
    const auto faces = faces_of(kind);
    for (Index other = 0; other < faces.size(); ++other) {
      if (faces[other].count != faces[face].count) continue;
      const bool apart = std::ranges::none_of(
          faces[other].span(), [&](Index corner) { return std::ranges::find(faces[face].span(), corner) != faces[face].span().end(); });
      if (apart) return other;
    }
    return std::nullopt;
  }

  /// Height and width of an element between two faces.
  [[nodiscard]] Extent extent(Index element, Index face, Index other) const {
    const auto c = mesh_.elements.corners(element);
    const auto faces = faces_of(mesh_.elements.kind(element));
    double width = 0.0, height = 0.0;
    Vec3 up{}, normal{};
    for (const Index one : {face, other}) {
      const auto corners = faces[one].span();
      for (std::size_t i = 0; i < corners.size(); ++i) width += distance(c[corners[i]], c[corners[(i + 1) % corners.size()]]);
      const Vec3 across = cross(difference(c[corners[1]], c[corners[0]]), difference(c[corners[2]], c[corners[0]]));
      normal = one == face ? normal + across : normal - across;
    }
    // Wedges and hexahedra: the corner above is the nearest of the other face by their numbers.
    for (const Index corner : faces[face].span()) {
      const Vec3 edge = difference(c[above(mesh_.elements.kind(element), face, other, corner)], c[corner]);
      height += length(edge);
      up = up + edge;
    }
    const auto edges = static_cast<double>(faces[face].count);
    return {0.5 * width / edges, height / edges, std::abs(dot(normal, up)) / (length(normal) * length(up))};
  }

  /// Corner of the other face that an edge joins with one of the first.
  [[nodiscard]] static Index above(ElementKind kind, Index face, Index other, Index corner) {
    const auto faces = faces_of(kind);
    for (const LocalFace& side : faces) {
      const auto corners = side.span();
      if (&side == &faces[face] || &side == &faces[other]) continue;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] != corner) continue;
        for (const std::size_t step : {std::size_t{1}, corners.size() - 1}) {
          const Index end = corners[(i + step) % corners.size()];
          if (std::ranges::find(faces[other].span(), end) != faces[other].span().end()) return end;
        }
      }
    }
    return corner;
  }

 private:
  /// Shortest way to a from b.
  [[nodiscard]] Vec3 difference(Index a, Index b) const { return plane_.difference(positions_[a], positions_[b]); }

  const Mesh& mesh_;
  const Plane& plane_;
  std::span<const Vec3> positions_;
};

/// Finder of the elements of stacks, by the sides of elements, which are edges in the plane and faces in space.
class Finder {
 public:
  Finder(const Mesh& mesh, const Geometry& geometry)
      : mesh_(mesh),
        shapes_(mesh, geometry.plane, mesh.positions),
        height_(mesh.elements.size()),
        base_(mesh.elements.size()),
        pronounced_(mesh.elements.size()) {}

  BoundaryLayers run(bool volume) {
    if (volume)
      from_faces();
    else
      from_edges();
    if (static_cast<double>(leaning_) > kMostLeaning * static_cast<double>(flat_)) std::ranges::fill(pronounced_, std::uint8_t{0});
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      if (height_[e] == 0) continue;
      layers_.elements.push_back(e);
      layers_.heights.push_back(height_[e]);
      layers_.bases.push_back(base_[e]);
      layers_.pronounced.push_back(pronounced_[e]);
      layers_.most = std::max(layers_.most, height_[e]);
    }
    return std::move(layers_);
  }

 private:
  [[nodiscard]] static bool is_flat(const Extent& extent) { return extent.width >= kFlat * extent.height; }
  void begin_stack() {
    stack_.clear();
    climbed_.clear();
    steady_layers_ = climbed_layers_ = 0;
  }
  /// Keeps the steady part of the stack, from the wall on. `elements`: those of the layer that comes next.
  void add_to_stack(std::span<const Index> elements, const Extent& extent) {
    climbed_.insert(climbed_.end(), elements.begin(), elements.end());
    ++climbed_layers_;
    const bool is_first = climbed_layers_ == 1;
    if (is_first) first_ = last_ = extent, steady_ = true, ++layers_.stacks;
    if (is_flat(first_)) {
      ++flat_;
      if (!(extent.upright >= kUpright)) ++leaning_;
    }
    steady_ = steady_ && extent.height <= kSteps * last_.height && extent.height >= kEven * last_.height;
    if (!steady_) return;
    last_ = extent;
    ++steady_layers_;
    stack_.insert(stack_.end(), elements.begin(), elements.end());
  }
  void end_stack() {
    // Discards a stack of a flat triangle or two on the boundary: these are no layers.
    if (!climbed_.empty() && mesh_.elements.kind(climbed_[0]) == ElementKind::Triangle && climbed_layers_ < kLayers) {
      for (const Index element : climbed_) height_[element] = 0;
      --layers_.stacks;
    }
    if (steady_layers_ < kLayers || !is_flat(first_) || last_.height < kGrown * first_.height) return;
    for (const Index element : stack_) pronounced_[element] = 1;
  }

  // Stacks in the plane: a side is an element's edge i, from corner i to i + 1.

  /// Layer of a stack: a quadrilateral, or two triangles that one was cut into.
  struct Rung {
    std::array<Index, 2> elements{}, bases{};
    std::size_t count = 0;
    std::array<Index, 4> corners{};  // the first two at the base, the others above
    [[nodiscard]] std::span<const Index> all() const { return std::span(elements).first(count); }
  };
  [[nodiscard]] std::optional<Rung> rung_on(Index element, Index edge) const {
    const auto c = mesh_.elements.corners(element);
    if (c.size() == 4) return Rung{{element}, {edge}, 1, {c[edge], c[(edge + 1) % 4], c[(edge + 2) % 4], c[(edge + 3) % 4]}};
    const Index a = c[edge], b = c[(edge + 1) % 3], tip = c[(edge + 2) % 3];
    const bool above_first = shapes_.distance(tip, a) < shapes_.distance(tip, b);  // the other side is the cut
    const Index cut = above_first ? (edge + 1) % 3 : (edge + 2) % 3;
    const Index beside = across_[4 * std::size_t{element} + cut];
    if (beside == kNoIndex || mesh_.elements.kind(beside) != ElementKind::Triangle) return std::nullopt;
    const Index end = above_first ? b : a;  // end of the cut at the base
    Index corner = kNoIndex;
    for (const Index v : mesh_.elements.corners(beside))
      if (v != tip && v != end) corner = v;
    if (corner == kNoIndex) return std::nullopt;
    const Index top = edge_of(beside, {std::min(tip, corner), std::max(tip, corner)});
    const std::array<Index, 4> corners = above_first ? std::array{a, b, corner, tip} : std::array{a, b, tip, corner};
    return Rung{{element, beside}, {edge, top}, 2, corners};
  }

  void from_edges() {
    const Topology topology(mesh_);
    across_.assign(4 * std::size_t{mesh_.elements.size()}, kNoIndex);
    std::vector<std::pair<Index, Index>> walls;  // element, edge
    for_each_edge(mesh_, topology, [&](Edge edge, std::span<const EdgeSide> sides) {
      if (sides.size() == 1) walls.emplace_back(sides[0].element, edge_of(sides[0].element, edge));
      if (sides.size() != 2) return;
      across_[4 * std::size_t{sides[0].element} + edge_of(sides[0].element, edge)] = sides[1].element;
      across_[4 * std::size_t{sides[1].element} + edge_of(sides[1].element, edge)] = sides[0].element;
    });
    for (const auto& [element, edge] : walls) climb_edges(element, edge);
  }

  [[nodiscard]] Index edge_of(Index element, Edge edge) const {
    const auto corners = mesh_.elements.corners(element);
    const Index n = static_cast<Index>(corners.size());
    for (Index i = 0; i < n; ++i) {
      const Index a = corners[i], b = corners[(i + 1) % n];
      if ((a == edge.low && b == edge.high) || (a == edge.high && b == edge.low)) return i;
    }
    return 0;
  }

  void climb_edges(Index element, Index edge) {
    begin_stack();
    climb_from_edge(element, edge);
    end_stack();
  }
  void climb_from_edge(Index element, Index edge) {
    double below = 0.0;
    for (std::uint16_t height = 1; height < kHighest; ++height) {
      const auto rung = rung_on(element, edge);
      if (!rung || std::ranges::any_of(rung->all(), [this](Index e) { return height_[e] != 0; })) return;
      const Extent here = shapes_.extent(rung->corners);
      if (!here.is_layer_on(below, height == 1 ? kAtWall : kAbove)) return;
      below = here.height;
      for (std::size_t i = 0; i < rung->count; ++i) {
        height_[rung->elements[i]] = height;
        base_[rung->elements[i]] = static_cast<std::uint8_t>(rung->bases[i]);
      }
      add_to_stack(rung->all(), here);
      const Index last = rung->all().back(), a = rung->corners[2], b = rung->corners[3];
      const Edge top{std::min(a, b), std::max(a, b)};
      const Index next = across_[4 * std::size_t{last} + edge_of(last, top)];
      if (next == kNoIndex) return;
      edge = edge_of(next, top);
      element = next;
    }
  }

  // Finds stacks in space: a side is a face.

  void from_faces() {
    const FaceNeighbours neighbours(mesh_);
    for (const ElementFace& wall : neighbours.boundary()) climb_faces(neighbours, wall);
  }

  void climb_faces(const FaceNeighbours& neighbours, ElementFace at) {
    begin_stack();
    climb_from_face(neighbours, at);
    end_stack();
  }
  void climb_from_face(const FaceNeighbours& neighbours, ElementFace at) {
    double below = 0.0;
    for (std::uint16_t height = 1; height < kHighest; ++height) {
      const ElementKind kind = mesh_.elements.kind(at.element);
      if ((kind != ElementKind::Hexahedron && kind != ElementKind::Wedge) || height_[at.element] != 0) return;
      const auto other = Shapes::opposite(kind, at.face);
      if (!other) return;
      const Extent here = shapes_.extent(at.element, at.face, *other);
      if (!here.is_layer_on(below, height == 1 ? kAtWall : kAbove)) return;
      below = here.height;
      height_[at.element] = height;
      base_[at.element] = static_cast<std::uint8_t>(at.face);
      add_to_stack(std::span(&at.element, 1), here);
      const ElementFace top{at.element, *other};
      const Index next = neighbours.of(at.element)[*other];
      if (next == kNoIndex) return;
      at = {next, neighbours.face_across(mesh_.elements, top)};
      if (at.face == kNoIndex) return;
    }
  }

  const Mesh& mesh_;
  Shapes shapes_;
  std::vector<std::uint16_t> height_;  // by element; 0: in no stack
  std::vector<std::uint8_t> base_;     // by element: the side that it stands on
  std::vector<std::uint8_t> pronounced_;
  std::vector<Index> stack_, climbed_;  // elements of the stack that is climbed: its steady part, from the wall on, and all of it
  Extent first_, last_;                 // shapes of its first and last element
  std::size_t steady_layers_ = 0, climbed_layers_ = 0;
  Index flat_ = 0, leaning_ = 0;  // numbers of layers
  bool steady_ = true;            // whether no layer of the stack so far differed much from the one beneath
  std::vector<Index> across_;     // neighbours, by element and edge
  BoundaryLayers layers_;
};

}  // namespace

bool may_have_layers(const Mesh& mesh, const Geometry& geometry) {
  if (geometry.shape == Shape::Surface) return false;
  const Shapes shapes(mesh, geometry.plane, mesh.positions);
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const ElementKind kind = mesh.elements.kind(e);
    if (kind == ElementKind::Quadrilateral || kind == ElementKind::Wedge || kind == ElementKind::Hexahedron) return true;
    if (kind != ElementKind::Triangle || geometry.shape == Shape::Volume) continue;
    const auto c = mesh.elements.corners(e);
    const std::array<double, 3> sides{shapes.distance(c[0], c[1]), shapes.distance(c[1], c[2]), shapes.distance(c[2], c[0])};
    const auto [least, most] = std::ranges::minmax(sides);
    if (most >= kFlat * least) return true;
  }
  return false;
}

BoundaryLayers find_boundary_layers(const Mesh& mesh, const Geometry& geometry) {
  return Finder(mesh, geometry).run(geometry.shape == Shape::Volume);
}

double height_on(const Mesh& mesh, const Geometry& geometry, std::span<const Vec3> positions, Index element, Index base) {
  const Shapes shapes(mesh, geometry.plane, positions);
  if (geometry.shape != Shape::Volume) return shapes.height(element, base);
  const auto other = Shapes::opposite(mesh.elements.kind(element), base);
  return other ? shapes.extent(element, base, *other).height : 0.0;
}

}  // namespace dmoscope
