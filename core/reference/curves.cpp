#include "core/reference/curves.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/rounding.h"

namespace dmoscope {

namespace {

/// Tolerance for a computed point to lie beside its segment, in roundings of a coordinate.
constexpr double kRoundings = 8.0;

double largest_coordinate(Vec3 p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

double distance_to_segment(const Plane& plane, Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = plane.difference(b, a), r = plane.difference(p, a);
  const double square = dot(d, d);
  const double t = square > 0.0 ? std::clamp(dot(r, d) / square, 0.0, 1.0) : 0.0;
  return length(r - t * d);
}

}  // namespace

std::vector<FeatureLine> chains(const CurveEnds& ends) {
  std::vector<FeatureLine> lines;
  std::vector<std::uint8_t> done(ends.size(), 0);
  const auto beyond = [&ends](Index from, Index v) { return ends.of(v)[0] == from ? ends.of(v)[1] : ends.of(v)[0]; };
  for (Index start = 0; start < ends.size(); ++start) {
    if (!ends.slides(start) || done[start] != 0) continue;
    Index before = start, first = ends.of(start)[0];
    while (first != start && ends.slides(first)) before = std::exchange(first, beyond(before, first));
    FeatureLine line;
    line.closed = first == start;
    // Goes on from `first` in the other direction.
    const Index end = first;
    Index v = line.closed ? ends.of(start)[1] : before, last = first;
    line.points.push_back(first);
    while (v != end && ends.slides(v)) {
      line.points.push_back(v);
      v = beyond(std::exchange(last, v), v);
    }
    if (!line.closed) line.points.push_back(v);
    for (const Index point : line.points) done[point] = 1;
    if (!line.closed || line.points.size() >= 3) lines.push_back(std::move(line));
  }
  return lines;
}

Curves::Curves(const InputMesh& input, const CurveEnds& ends)
    : points_(input.mesh.positions),
      plane_(input.geometry.plane),
      single_precision_(input.mesh.single_precision),
      string_of_(input.mesh.vertex_count(), kNoIndex),
      index_on_(input.mesh.vertex_count(), 0) {
  take_strings(ends);
  for (String& string : strings_) {  // gives each string a curve of its own
    string.curve = static_cast<Index>(curves_.size());
    Curve& curve = curves_.emplace_back(Curve{string.members, {}, string.closed});
    measure(curve);
    string.near.resize(string.members.size());
    std::iota(string.near.begin(), string.near.end(), std::size_t{0});
  }
}

Curves::Curves(const InputMesh& input, const CurveEnds& ends, const OntoLines& onto)
    : points_(input.surface->mesh.positions),
      plane_(input.geometry.plane),
      single_precision_(input.mesh.single_precision),
      beside_(onto.beside),
      string_of_(input.mesh.vertex_count(), kNoIndex),
      index_on_(input.mesh.vertex_count(), 0) {
  take_strings(ends);
  put_along(onto);
  for (String& string : strings_) {
    const Curve& curve = curves_[string.curve];
    for (const Index v : string.members) {
      const auto place = place_of(curve, 0, input.mesh.positions[v]);
      string.near.push_back(place ? segment_at(curve, *place) : 0);
    }
    turn_along(string);
  }
  for (Index s = 0; s < strings_.size(); ++s)
    for (std::size_t i = 0; i < strings_[s].members.size(); ++i)
      if (string_of_[strings_[s].members[i]] == s) index_on_[strings_[s].members[i]] = static_cast<Index>(i);
}

void Curves::take_strings(const CurveEnds& ends) {
  for (FeatureLine& line : chains(ends)) {
    const std::size_t count = line.points.size(), from = line.closed ? 0 : 1, to = line.closed ? count : count - 1;
    for (std::size_t i = from; i < to; ++i) {
      string_of_[line.points[i]] = static_cast<Index>(strings_.size());
      index_on_[line.points[i]] = static_cast<Index>(i);
    }
    strings_.push_back({kNoIndex, std::move(line.points), {}, line.closed});
  }
}

void Curves::measure(Curve& curve) const {
  const std::size_t count = curve.points.size();
  curve.lengths.assign(1, 0.0);
  for (std::size_t i = 1; i < count + (curve.closed ? 1 : 0); ++i)
    curve.lengths.push_back(curve.lengths.back() + dmoscope::length(plane_.difference(point(curve, i), point(curve, i - 1))));
}

/// Assigns to each string the line near which its members stand.
void Curves::put_along(const OntoLines& onto) {
  for (const FeatureLine& line : onto.lines) {
    Curve& curve = curves_.emplace_back(Curve{line.points, {}, line.closed});
    measure(curve);
  }
  for (String& string : strings_) string.curve = onto.line_of[string.members[string.closed ? 0 : 1]];
}

/// Reverses a string that runs against its curve. Along a closed one, the shorter way round from member to member is then the forward one.
void Curves::turn_along(String& string) const {
  const Curve& curve = curves_[string.curve];
  double forwards = 0.0, backwards = 0.0;
  for (std::size_t i = 1; i < string.near.size(); ++i) {
    const double from = curve.lengths[string.near[i - 1]], to = curve.lengths[string.near[i]];
    double way = to - from;
    if (curve.closed && std::abs(way) > 0.5 * curve.length()) way += way > 0.0 ? -curve.length() : curve.length();
    (way > 0.0 ? forwards : backwards) += std::abs(way);
  }
  if (forwards >= backwards) return;
  std::ranges::reverse(string.members);
  std::ranges::reverse(string.near);
}

Curves::Member Curves::beside(Index vertex, bool after) const {
  const String& string = strings_[string_of_[vertex]];
  const std::size_t count = string.members.size(), i = (index_on_[vertex] + (after ? 1 : count - 1)) % count;
  return {string.members[i], string.near[i]};
}

/// The place of the nearest point of the segment.
double Curves::place_near(const Curve& curve, std::size_t segment, Vec3 position, double& distance) const {
  const Vec3 a = point(curve, segment), b = point(curve, segment + 1);
  const Vec3 d = plane_.difference(b, a), r = plane_.difference(position, a);
  const double square = dot(d, d), t = square > 0.0 ? std::clamp(dot(r, d) / square, 0.0, 1.0) : 0.0;
  distance = length(r - t * d);
  return curve.lengths[segment] + t * std::sqrt(square);
}

std::optional<double> Curves::place_on(const Curve& curve, std::size_t segment, Vec3 position) const {
  const double rounding = single_precision_ ? std::numeric_limits<float>::epsilon() : std::numeric_limits<double>::epsilon();
  const double largest = std::max(largest_coordinate(point(curve, segment)), largest_coordinate(point(curve, segment + 1)));
  double distance = 0.0;
  const double place = place_near(curve, segment, position, distance);
  return distance <= kRoundings * rounding * largest ? std::optional(place) : std::nullopt;
}

std::optional<double> Curves::place_of(const Curve& curve, std::size_t near, Vec3 position) const {
  const std::size_t count = curve.segments();
  for (std::size_t step = 0; step <= count; ++step) {  // segments on either side, nearest first
    for (const bool forwards : {true, false}) {
      std::size_t segment = 0;
      if (curve.closed)
        segment = (near + (forwards ? step : count - 1 - step % count)) % count;
      else if (forwards ? near + step < count : near >= step + 1)
        segment = forwards ? near + step : near - step - 1;
      else
        continue;
      if (const auto found = place_on(curve, segment, position)) return found;
    }
  }
  std::optional<double> nearest;
  double least = beside_;
  for (std::size_t segment = 0; beside_ > 0.0 && segment < count; ++segment) {
    double distance = 0.0;
    const double place = place_near(curve, segment, position, distance);
    if (distance < least) least = distance, nearest = place;
  }
  return nearest;
}

std::optional<double> Curves::place(Index vertex, Vec3 position) const { return place_of(curve_of(vertex), near_of(vertex), position); }

std::size_t Curves::segment_at(const Curve& curve, double place) {
  const auto next = std::upper_bound(curve.lengths.begin(), curve.lengths.end(), place);
  const auto segment = next == curve.lengths.begin() ? 0 : static_cast<std::size_t>(next - curve.lengths.begin()) - 1;
  return std::min(segment, curve.segments() - 1);
}

Vec3 Curves::at(Index vertex, double place) const {
  const Vec3 p = point_at(vertex, place);
  if (!single_precision_) return p;
  return {nearest_float(p.x), nearest_float(p.y), nearest_float(p.z)};
}

Vec3 Curves::point_at(Index vertex, double place) const {
  const Curve& curve = curve_of(vertex);
  if (curve.closed && place < 0.0) place += curve.length();
  if (curve.closed && place >= curve.length()) place -= curve.length();
  const std::size_t segment = segment_at(curve, place);
  const Vec3 a = point(curve, segment), b = point(curve, segment + 1), d = plane_.difference(b, a);
  const double whole = curve.lengths[segment + 1] - curve.lengths[segment];
  const double t = whole > 0.0 ? std::clamp((place - curve.lengths[segment]) / whole, 0.0, 1.0) : 0.0;
  return t <= 0.5 ? a + t * d : b - (1.0 - t) * d;  // the ends have the bits of the input
}

std::optional<Curves::Straight> Curves::straight(Index vertex, double place, bool forwards) const {
  const Curve& curve = curve_of(vertex);
  const double whole = curve.length();
  if (curve.closed && forwards && place >= whole) place -= whole;
  if (curve.closed && !forwards && place <= 0.0) place += whole;
  if (forwards ? place >= whole : place <= 0.0) return std::nullopt;
  // Assigns a place at a point to the segment that begins there.
  const auto& lengths = curve.lengths;
  const auto bound =
      forwards ? std::upper_bound(lengths.begin(), lengths.end(), place) : std::lower_bound(lengths.begin(), lengths.end(), place);
  const auto segment = static_cast<std::size_t>(bound - lengths.begin()) - 1;
  const Vec3 d = plane_.difference(point(curve, segment + 1), point(curve, segment));
  const double size = (forwards ? 1.0 : -1.0) * dmoscope::length(d), end = lengths[segment + (forwards ? 1 : 0)];
  return Straight{(1.0 / size) * d, forwards ? end - place : place - end, end};
}

std::optional<Curves::Neighbours> Curves::neighbours(Index vertex, double place, PositionView positions) const {
  const Curve& curve = curve_of(vertex);
  const Member before = beside(vertex, false), after = beside(vertex, true);
  const auto place_before = place_of(curve, before.near, positions[before.vertex]);
  const auto place_after = place_of(curve, after.near, positions[after.vertex]);
  if (!place_before || !place_after) return std::nullopt;
  Neighbours found{before.vertex, after.vertex, *place_before, *place_after};
  if (curve.closed && found.place_before >= place) found.place_before -= curve.length();
  if (curve.closed && found.place_after <= place) found.place_after += curve.length();
  if (!(found.place_before < place && place < found.place_after)) return std::nullopt;
  return found;
}

std::optional<Curves::Stretch> Curves::stretch_to(Index vertex, Vec3 position, Index other, Vec3 position_of_other) const {
  const Curve& curve = curve_of(vertex);
  const bool forwards = beside(vertex, true).vertex == other;
  const Member end = beside(vertex, forwards);
  if (end.vertex != other) return std::nullopt;
  const auto here = place_of(curve, near_of(vertex), position), there = place_of(curve, end.near, position_of_other);
  if (!here || !there) return std::nullopt;
  const double from = forwards ? *here : *there, to = forwards ? *there : *here;
  const std::size_t first = segment_at(curve, from);
  std::size_t last = segment_at(curve, to);
  if (to <= curve.lengths[last] && last != first) last = last > 0 ? last - 1 : curve.segments() - 1;
  return Stretch{strings_[string_of_[vertex]].curve, first, last};
}

std::array<std::pair<Index, Index>, 2> Curves::edges_at(Index vertex, double place) const {
  const Curve& curve = curve_of(vertex);
  const std::size_t i = segment_at(curve, place);
  std::array<std::pair<Index, Index>, 2> edges{ends_of(curve, i), {kNoIndex, kNoIndex}};
  if (place <= curve.lengths[i] && (i > 0 || curve.closed)) edges[1] = ends_of(curve, i > 0 ? i - 1 : curve.segments() - 1);
  return edges;
}

double Curves::deviation(Index vertex, double first, double last, Vec3 from, Vec3 to) const {
  const Curve& curve = curve_of(vertex);
  double shift = 0.0;
  if (curve.closed) shift = first < 0.0 ? -curve.length() : first >= curve.length() ? curve.length() : 0.0;
  const auto count = static_cast<std::ptrdiff_t>(curve.segments());  // number of points of a closed curve; else one less
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
