#include "core/reference/curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/number_text.h"
#include "core/base/rounding.h"
#include "core/mesh/edges.h"
#include "core/mesh/named_lists.h"

namespace dmoscope {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
/// Roundings of a coordinate that a point of a segment, computed, may lie beside it.
constexpr double kRoundings = 8.0;

double largest_coordinate(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double distance_to_segment(const Plane& plane, Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = plane.difference(b, a), r = plane.difference(p, a);
  const double square = dot(d, d);
  const double t = square > 0.0 ? std::clamp(dot(r, d) / square, 0.0, 1.0) : 0.0;
  return length(r - t * d);
}

/// The names that the file gives to edges: by its lines, and by its strings of vertices.
class NamedEdges {
 public:
  NamedEdges(const Mesh& mesh, const Topology& topology) : mesh_(mesh) {
    for (Index g = 0; g < mesh.groups.size(); ++g) {
      const Group& group = mesh.groups[g];
      const std::size_t step = group.dimension == 1 ? 2 : 1;
      if (group.dimension != 1 && !is_string(group)) continue;
      for (std::size_t i = 0; i + 1 < group.members.size(); i += step) add(group.members[i], group.members[i + 1], g);
      if (group.dimension == 1) lines_.push_back(&group);
    }
    std::ranges::sort(names_);
    if (!lines_.empty()) list_.emplace(NamedKind::Lines, lines_, mesh, topology);
  }
  /// Are two edges at a vertex named by the very same groups?
  [[nodiscard]] bool same(Index vertex, Index one, Index other) const {
    return std::ranges::equal(of(vertex, one), of(vertex, other), {}, &Name::group, &Name::group);
  }
  /// Calls visit(a, b) for every edge that a line names, but where all edges around are merely listed.
  template <class Visit>
  void for_lines(const Visit& visit) {
    for (const Name& name : names_)
      if (mesh_.groups[name.group].dimension == 1 && !list_->surrounds(name.low) && !list_->surrounds(name.high))
        visit(name.low, name.high);
  }

 private:
  struct Name {
    Index low, high, group;
    friend auto operator<=>(const Name&, const Name&) = default;
  };
  void add(Index a, Index b, Index group) { names_.push_back({std::min(a, b), std::max(a, b), group}); }
  [[nodiscard]] std::span<const Name> of(Index a, Index b) const {
    const Index low = std::min(a, b), high = std::max(a, b);
    const auto first = std::lower_bound(names_.begin(), names_.end(), Name{low, high, 0});
    const auto last = std::upper_bound(first, names_.end(), Name{low, high, kNoIndex});
    return {first, last};
  }

  const Mesh& mesh_;
  std::vector<Name> names_;
  std::vector<const Group*> lines_;
  std::optional<NamedList> list_;
};

}  // namespace

/// Finds who slides, and chains them.
class Curves::Builder {
 public:
  Builder(Curves& out, const InputMesh& input) : out_(out), input_(input), ends_(input.mesh.vertex_count(), kNone) {}

  void build(const StandingRule& rule) {
    const bool boundary = rule.boundary == BoundaryRule::Slide, interfaces = rule.interfaces == InterfaceRule::Slide;
    for_each_edge(input_.mesh, input_.topology, [&](const Edge& edge, std::span<const EdgeSide> sides) {
      if (sides.size() > 2) return hold(edge.low), hold(edge.high);
      const bool along = sides.size() == 1 ? boundary : interfaces && input_.interfaces.between(sides[0].element, sides[1].element);
      if (along) join(edge.low, edge.high), join(edge.high, edge.low);
    });
    for (Index v = 0; v < ends_.size() && !boundary; ++v)
      if (on_boundary(v)) hold(v);
    hold_corners(rule.corner_angle);
    hold_named(rule.interfaces);
    for (Index v = 0; v < ends_.size(); ++v)
      if (slides(v) && out_.curve_of_[v] == kNoIndex) chain(v);
    for (Index v = 0; v < ends_.size(); ++v) {
      out_.sliding_ += out_.slides(v) ? 1 : 0;
      out_.inside_ += out_.slides(v) && !on_boundary(v) ? 1 : 0;
      out_.corners_ += boundary && on_boundary(v) && !out_.slides(v) ? 1 : 0;
    }
  }

 private:
  using Ends = std::array<Index, 2>;  // the neighbours along the boundary; kNoIndex: none. {kNoIndex, 0}: the vertex is held
  static constexpr Ends kNone{kNoIndex, kNoIndex}, kHeld{kNoIndex, 0};

  [[nodiscard]] bool on_boundary(Index v) const { return input_.topology.boundary()[v] != 0; }
  [[nodiscard]] bool slides(Index v) const { return ends_[v][0] != kNoIndex && ends_[v][1] != kNoIndex; }
  void hold(Index v) { ends_[v] = kHeld; }
  void join(Index v, Index other) {
    Ends& ends = ends_[v];
    if (ends == kNone)
      ends[0] = other;
    else if (ends[0] != kNoIndex && ends[1] == kNoIndex)
      ends[1] = other;
    else
      hold(v);  // the boundary touches itself
  }

  void hold_corners(double corner_angle) {
    const Plane& plane = input_.geometry.plane;
    for (Index v = 0; v < ends_.size(); ++v) {
      if (!slides(v)) continue;
      const Vec3 here = input_.mesh.positions[v];
      const Vec2<double> in = plane.offset(here, input_.mesh.positions[ends_[v][0]]);
      const Vec2<double> out = plane.offset(input_.mesh.positions[ends_[v][1]], here);
      const double turn = std::atan2(std::abs(cross(in, out)), dot(in, out));
      const bool has_direction = dot(in, in) > 0.0 && dot(out, out) > 0.0;
      if (!has_direction || !(turn <= corner_angle * kDegree)) hold(v);
    }
  }

  void hold_named(InterfaceRule interfaces) {
    const Mesh& mesh = input_.mesh;
    NamedEdges edges(mesh, input_.topology);
    for (Index v = 0; v < ends_.size(); ++v)
      if (slides(v) && !edges.same(v, ends_[v][0], ends_[v][1])) hold(v);
    hold_points();
    for (const Group& group : mesh.groups)
      if (group.of_elements() && is_required(group))
        for (const Index e : group.members)
          for (const Index v : mesh.elements.corners(e)) hold(v);
    if (interfaces == InterfaceRule::Free) return;
    for (Index v = 0; v < ends_.size(); ++v)
      if (slides(v) && input_.interfaces.meets_boundary_at(v)) hold(v);
    edges.for_lines([this](Index a, Index b) {
      for (const auto& [v, other] : {std::pair(a, b), std::pair(b, a)})
        if (slides(v) && ends_[v][0] != other && ends_[v][1] != other) hold(v);
    });
  }

  void hold_points() {
    std::vector<const Group*> points;
    for (const Group& group : input_.mesh.groups)
      if (group.dimension == 0 && !is_string(group)) points.push_back(&group);
    if (points.empty()) return;
    NamedList list(NamedKind::Points, points, input_.mesh, input_.topology);
    for (const Group* group : points)
      for (const Index v : group->members)
        if (slides(v) && (is_required(*group) || !list.surrounds(v))) hold(v);
  }

  [[nodiscard]] Index beyond(Index from, Index v) const { return ends_[v][0] == from ? ends_[v][1] : ends_[v][0]; }

  /// The curve of a vertex that slides, from one held vertex to the next, or all around.
  void chain(Index start) {
    Index before = start, first = ends_[start][0];
    while (first != start && slides(first)) before = std::exchange(first, beyond(before, first));
    Curve curve;
    curve.closed = first == start;
    // From `first` on, away from where the way back came from.
    const Index end = first;
    Index v = curve.closed ? ends_[start][1] : before, last = first;
    curve.vertices.push_back(first);
    while (v != end && slides(v)) {
      curve.vertices.push_back(v);
      v = beyond(std::exchange(last, v), v);
    }
    if (!curve.closed) curve.vertices.push_back(v);
    if (curve.closed && curve.vertices.size() < 3) return;
    add(std::move(curve));
  }

  void add(Curve curve) {
    const auto number = static_cast<Index>(out_.curves_.size());
    const std::size_t count = curve.vertices.size(), first = curve.closed ? 0 : 1, last = curve.closed ? count : count - 1;
    for (std::size_t i = first; i < last; ++i) {
      out_.curve_of_[curve.vertices[i]] = number;
      out_.index_on_[curve.vertices[i]] = static_cast<Index>(i);
    }
    curve.lengths.push_back(0.0);
    for (std::size_t i = 1; i < count + (curve.closed ? 1 : 0); ++i)
      curve.lengths.push_back(curve.lengths.back() +
                              dmoscope::length(out_.plane_.difference(out_.point(curve, i), out_.point(curve, i - 1))));
    out_.curves_.push_back(std::move(curve));
  }

  Curves& out_;
  const InputMesh& input_;
  std::vector<Ends> ends_;
};

Curves::Curves(const InputMesh& input, const StandingRule& rule)
    : points_(input.mesh.positions),
      plane_(input.geometry.plane),
      single_precision_(input.mesh.single_precision),
      curve_of_(input.mesh.vertex_count(), kNoIndex),
      index_on_(input.mesh.vertex_count(), 0) {
  Builder(*this, input).build(rule);
}

std::string Curves::sentence() const {
  const auto slide = [](Index n) { return fmt::format("{} {}", counted(n, "vertex", "vertices"), n == 1 ? "slides" : "slide"); };
  std::string text;
  if (sliding_ > inside_ || corners_ > 0)
    text = fmt::format("{} along the boundary, and {} of its vertices {}", slide(sliding_ - inside_), grouped(corners_),
                       corners_ == 1 ? "stays" : "stay");
  if (inside_ > 0 || text.empty()) text += fmt::format("{}{} along interfaces", text.empty() ? "" : "; ", slide(inside_));
  return text;
}

std::optional<double> Curves::place_on(const Curve& curve, std::size_t segment, Vec3 position) const {
  const Vec3 a = point(curve, segment), b = point(curve, segment + 1);
  const Vec3 d = plane_.difference(b, a), r = plane_.difference(position, a);
  const double square = dot(d, d), t = square > 0.0 ? std::clamp(dot(r, d) / square, 0.0, 1.0) : 0.0;
  const double rounding = single_precision_ ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  if (!(length(r - t * d) <= kRoundings * rounding * std::max(largest_coordinate(a), largest_coordinate(b)))) return std::nullopt;
  return curve.lengths[segment] + t * std::sqrt(square);
}

std::optional<double> Curves::place_of(const Curve& curve, std::size_t index, Vec3 position) const {
  const std::size_t count = curve.segments();
  for (std::size_t step = 0; step <= count; ++step) {  // the segments on either side, nearest first
    for (const bool forwards : {true, false}) {
      std::size_t segment = 0;
      if (curve.closed)
        segment = (index + (forwards ? step : count - 1 - step % count)) % count;
      else if (forwards ? index + step < count : index >= step + 1)
        segment = forwards ? index + step : index - step - 1;
      else
        continue;
      if (const auto found = place_on(curve, segment, position)) return found;
    }
  }
  return std::nullopt;
}

std::optional<double> Curves::place(Index vertex, Vec3 position) const {
  return place_of(curves_[curve_of_[vertex]], index_on_[vertex], position);
}

std::size_t Curves::segment_at(const Curve& curve, double place) {
  const auto next = std::upper_bound(curve.lengths.begin(), curve.lengths.end(), place);
  const auto segment = next == curve.lengths.begin() ? 0 : static_cast<std::size_t>(next - curve.lengths.begin()) - 1;
  return std::min(segment, curve.segments() - 1);
}

Vec3 Curves::at(Index vertex, double place) const {
  const Curve& curve = curves_[curve_of_[vertex]];
  if (curve.closed && place < 0.0) place += curve.length();
  if (curve.closed && place >= curve.length()) place -= curve.length();
  const std::size_t segment = segment_at(curve, place);
  const Vec3 a = point(curve, segment), b = point(curve, segment + 1), d = plane_.difference(b, a);
  const double whole = curve.lengths[segment + 1] - curve.lengths[segment];
  const double t = whole > 0.0 ? std::clamp((place - curve.lengths[segment]) / whole, 0.0, 1.0) : 0.0;
  const Vec3 p = t <= 0.5 ? a + t * d : b - (1.0 - t) * d;  // the ends have the bits of the input
  if (!single_precision_) return p;
  return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

std::optional<Curves::Neighbours> Curves::neighbours(Index vertex, double place, PositionView positions) const {
  const Curve& curve = curves_[curve_of_[vertex]];
  const std::size_t count = curve.vertices.size(), i = index_on_[vertex];
  const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
  const auto place_before = place_of(curve, before, positions[curve.vertices[before]]);
  const auto place_after = place_of(curve, after, positions[curve.vertices[after]]);
  if (!place_before || !place_after) return std::nullopt;
  Neighbours found{curve.vertices[before], curve.vertices[after], *place_before, *place_after};
  if (curve.closed && found.place_before >= place) found.place_before -= curve.length();
  if (curve.closed && found.place_after <= place) found.place_after += curve.length();
  if (!(found.place_before < place && place < found.place_after)) return std::nullopt;
  return found;
}

double Curves::deviation(Index vertex, double first, double last, Vec3 from, Vec3 to) const {
  const Curve& curve = curves_[curve_of_[vertex]];
  double shift = 0.0;
  if (curve.closed) shift = first < 0.0 ? -curve.length() : first >= curve.length() ? curve.length() : 0.0;
  const auto count = static_cast<std::ptrdiff_t>(curve.segments());  // points of a closed curve; else one less
  auto j = std::upper_bound(curve.lengths.begin(), curve.lengths.end(), first - shift) - curve.lengths.begin();
  double greatest = 0.0;
  for (; curve.closed || j <= count; ++j) {
    const double there = curve.lengths[static_cast<std::size_t>(j % (count + (curve.closed ? 0 : 1)))] +
                         (curve.closed ? static_cast<double>(j / count) * curve.length() : 0.0) + shift;
    if (!(there < last)) break;
    greatest = std::max(greatest, distance_to_segment(plane_, point(curve, static_cast<std::size_t>(j)), from, to));
  }
  return greatest;
}

}  // namespace dmoscope
