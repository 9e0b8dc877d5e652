#include "core/reference/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/rounding.h"

namespace dmoscope {

namespace {

/// Roundings of a coordinate that a point of a segment, computed, may lie beside it.
constexpr double kRoundings = 8.0;

double largest_coordinate(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double distance_to_segment(const Plane& plane, Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = plane.difference(b, a), r = plane.difference(p, a);
  const double square = dot(d, d);
  const double t = square > 0.0 ? std::clamp(dot(r, d) / square, 0.0, 1.0) : 0.0;
  return length(r - t * d);
}

}  // namespace

/// Chains the edges along which vertices slide.
class Curves::Builder {
 public:
  Builder(Curves& out, const CurveEnds& ends) : out_(out), ends_(ends) {}

  void build() {
    for (Index v = 0; v < ends_.size(); ++v)
      if (slides(v) && out_.curve_of_[v] == kNoIndex) chain(v);
  }

 private:
  [[nodiscard]] bool slides(Index v) const { return ends_.slides(v); }
  [[nodiscard]] Index beyond(Index from, Index v) const { return ends_.of(v)[0] == from ? ends_.of(v)[1] : ends_.of(v)[0]; }

  /// The curve of a vertex that slides, from one held vertex to the next, or all around.
  void chain(Index start) {
    Index before = start, first = ends_.of(start)[0];
    while (first != start && slides(first)) before = std::exchange(first, beyond(before, first));
    Curve curve;
    curve.closed = first == start;
    // From `first` on, away from where the way back came from.
    const Index end = first;
    Index v = curve.closed ? ends_.of(start)[1] : before, last = first;
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
  const CurveEnds& ends_;
};

Curves::Curves(const InputMesh& input, const CurveEnds& ends)
    : points_(input.mesh.positions),
      plane_(input.geometry.plane),
      single_precision_(input.mesh.single_precision),
      curve_of_(input.mesh.vertex_count(), kNoIndex),
      index_on_(input.mesh.vertex_count(), 0) {
  Builder(*this, ends).build();
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

std::optional<Curves::Stretch> Curves::stretch_to(Index vertex, Vec3 position, Index other, Vec3 position_of_other) const {
  const Curve& curve = curves_[curve_of_[vertex]];
  const std::size_t count = curve.vertices.size(), i = index_on_[vertex], before = (i + count - 1) % count, after = (i + 1) % count;
  const bool forwards = curve.vertices[after] == other;
  if (!forwards && curve.vertices[before] != other) return std::nullopt;
  const auto here = place_of(curve, i, position), there = place_of(curve, forwards ? after : before, position_of_other);
  if (!here || !there) return std::nullopt;
  const double from = forwards ? *here : *there, to = forwards ? *there : *here;
  const std::size_t first = segment_at(curve, from);
  std::size_t last = segment_at(curve, to);
  if (to <= curve.lengths[last] && last != first) last = last > 0 ? last - 1 : curve.segments() - 1;
  return Stretch{curve_of_[vertex], first, last};
}

std::array<std::pair<Index, Index>, 2> Curves::edges_at(Index vertex, double place) const {
  const Curve& curve = curves_[curve_of_[vertex]];
  const std::size_t i = segment_at(curve, place);
  std::array<std::pair<Index, Index>, 2> edges{ends_of(curve, i), {kNoIndex, kNoIndex}};
  if (place <= curve.lengths[i] && (i > 0 || curve.closed)) edges[1] = ends_of(curve, i > 0 ? i - 1 : curve.segments() - 1);
  return edges;
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
