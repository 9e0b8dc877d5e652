#include "core/reference/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dmoscope {

namespace {

/// Tolerance for rounding: lengths below this share of a triangle's longest edge, and areas below this share of the triangle's.
constexpr double kRounding = 1e-9;
constexpr double kUncovered = 1e-6;
/// Cosine of 60 degrees: facets that lean farther away are laid slowly.
constexpr double kFarAway = 0.5;
constexpr std::size_t kMostFacets = 4096;
/// Factors that differ from 1 by more than the rounding of a height.
constexpr double kSurely = 1.0 - 1e-8, kAbove = 1.0 + 1e-8;

Plane tangent(Vec3 normal, Vec3 along) {
  const Vec3 u = (1.0 / length(along)) * along;
  return {u, cross(normal, u), normal};
}

/// The part of a segment that runs inside the triangle by more than a margin, as shares of its length.
struct Part {
  double first = 0.0, last = 1.0;
};
/// Finds the part inside; false unless it is more than a point and not only along an edge.
[[nodiscard, gnu::always_inline]] inline bool find_part_inside(const OverlayRoom::Corner& from, const OverlayRoom::Corner& to,
                                                               double margin, Part& part) {
  for (std::size_t i = 0; i < 3; ++i) {
    const double at_first = from.inside[i] - margin, at_last = to.inside[i] - margin;
    if (at_first <= 0.0 && at_last <= 0.0) return false;
    if (at_first < 0.0) part.first = std::max(part.first, at_first / (at_first - at_last));
    if (at_last < 0.0) part.last = std::min(part.last, at_first / (at_first - at_last));
  }
  if (!(part.last > part.first)) return false;
  const Vec2<double> way = to.at - from.at;
  return (part.last - part.first) * (part.last - part.first) * dot(way, way) > margin * margin;
}

}  // namespace

/// A triangle and its plane, onto which facets are projected.
struct Overlay::Ground {
  Plane plane;
  Vec3 origin;
  std::array<Vec2<double>, 3> corners;  // corners in counter-clockwise order
  std::array<Vec2<double>, 3> inwards;  // unit vectors across each edge
  double size, area;                    // longest edge, and twice the area
  [[nodiscard]] Corner corner(Vec3 p) const {
    const Vec3 way = p - origin;
    Corner result{plane.project(way), dot(way, plane.normal), {}};
    for (std::size_t i = 0; i < 3; ++i) result.inside[i] = dot(inwards[i], result.at - corners[i]);
    return result;
  }
};

/// Cuts off the part of the polygon beyond one of the triangle's edges (Sutherland and Hodgman).
void Overlay::clip(std::size_t edge) {
  auto& polygon = room_.polygon;
  if (std::ranges::all_of(polygon, [edge](const Corner& corner) { return corner.inside[edge] >= 0.0; })) return;
  auto& clipped = room_.clipped;
  clipped.clear();
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Corner& from = polygon[k];
    const Corner& to = polygon[k + 1 < polygon.size() ? k + 1 : 0];
    const double at_from = from.inside[edge], at_to = to.inside[edge];
    if (at_from >= 0.0) clipped.push_back(from);
    if ((at_from >= 0.0) == (at_to >= 0.0)) continue;
    const double t = at_from / (at_from - at_to);
    const auto between = [t](double a, double b) { return a + t * (b - a); };
    Corner& cut = clipped.emplace_back();
    cut.at = {between(from.at.x, to.at.x), between(from.at.y, to.at.y)};
    cut.height = between(from.height, to.height);
    for (std::size_t i = 0; i < 3; ++i) cut.inside[i] = between(from.inside[i], to.inside[i]);
  }
  std::swap(polygon, clipped);
}

/// Lays one facet under the triangle and records the facets beyond its edges; false if the triangle lies across a feature edge.
bool Overlay::lay(const Ground& ground, Index facet, std::span<const Curves::Stretch> allowed, Laid& laid) {
  const Facet& here = facets_.facets()[facet];
  auto& polygon = room_.polygon;
  polygon.clear();
  for (const Index corner : here.corners) polygon.push_back(ground.corner(facets_.point(corner)));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    if (Part part; !find_part_inside(polygon[a], polygon[b], kRounding * ground.size, part)) continue;
    const Index across = here.across[i];
    if (across != kNoIndex) {
      if (std::ranges::find(room_.found, across) == room_.found.end()) room_.found.push_back(across);
    } else {
      if (!domain_.is_within(allowed, here.corners[a], here.corners[b])) return false;
      laid.beyond = true;
    }
  }
  const double whole = cross(polygon[1].at - polygon[0].at, polygon[2].at - polygon[0].at);
  for (const std::size_t edge : {0U, 1U, 2U}) clip(edge);
  double area = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) area += cross(polygon[k - 1].at - polygon[0].at, polygon[k].at - polygon[0].at);
  laid.covered += area;
  for (const Corner& corner : polygon) laid.fit.deviation = std::max(laid.fit.deviation, std::abs(corner.height));
  if (std::abs(area) > kUncovered * ground.area) laid.fit.least_cosine = std::min(laid.fit.least_cosine, whole / facets_.twice_area(facet));
  return true;
}

/// Finds the fit without cutting any facet: the distance is greatest where a facet's edge begins or ends inside the triangle, or at a
/// corner of the triangle. None if the facets found may not be all: at feature edges, where a facet leans far away, and around vertices
/// where facets might cover the triangle more than once.
std::optional<Fit> Overlay::lay_quickly(const Ground& ground, Index start, const Need& need) {
  room_.found.assign(1, start);
  Crossed& first = room_for(0);
  first.from = 3;
  Fit fit;
  double highest = 0.0;  // greatest height of the facets' corners, and so of all their points
  for (std::size_t i = 0; i < 3; ++i) {
    first.corners[i] = ground.corner(facets_.point(facets_.facets()[start].corners[i]));
    highest = std::max(highest, std::abs(first.corners[i].height));
  }
  for (std::size_t k = 0; k < room_.found.size(); ++k) {
    if (k > kMostFacets || !cross_sides(ground, k, fit)) return std::nullopt;
    if (fit.deviation > need.limit) return fit;
    const Crossed& here = room_.crossed[k];
    if (here.from < 3) highest = std::max(highest, std::abs(here.corners[here.from].height));
  }
  if (!(highest <= kSurely * need.enough)) fit.deviation = std::max(fit.deviation, deviation_at_corners(ground));
  return fit;
}

/// Follows the sides of one of the facets found, and records those beyond them; false if the quick method fails.
bool Overlay::cross_sides(const Ground& ground, std::size_t k, Fit& fit) {
  const double margin = kRounding * ground.size;
  const Index number = room_.found[k];
  const Facet& facet = facets_.facets()[number];
  const std::size_t from = room_.crossed[k].from;
  {
    Crossed& here = room_.crossed[k];
    const auto& corner = here.corners;
    here.area = cross(corner[1].at - corner[0].at, corner[2].at - corner[0].at);
    const double cosine = here.area / facets_.twice_area(number);
    if (!(cosine >= kFarAway)) return false;
    fit.least_cosine = std::min(fit.least_cosine, cosine);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& corner = room_.crossed[k].corners;  // looked up again, since reaching another facet moves them
    const auto is_inside = [margin](const Corner& c) { return c.inside[0] > margin && c.inside[1] > margin && c.inside[2] > margin; };
    if ((from == 3 || i == from) && is_inside(corner[i]) && !facets_.covers_once(number, i)) return false;  // known for the other corners
    if (i == from) continue;
    const Corner &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
    Part part;
    if (!find_part_inside(a, b, margin, part)) continue;
    const double rise = b.height - a.height;
    fit.deviation = std::max(fit.deviation, std::max(std::abs(a.height + part.first * rise), std::abs(a.height + part.last * rise)));
    const Index across = facet.across[i];
    if (across == kNoIndex) return false;
    if (std::ranges::find(room_.found, across) == room_.found.end()) reach(ground, across, k, i);
  }
  return true;
}

OverlayRoom::Crossed& Overlay::room_for(std::size_t k) {
  if (k >= room_.crossed.size()) room_.crossed.resize(k + 1);
  return room_.crossed[k];
}

/// Records the facet beyond a side of another, two of whose corners are known.
void Overlay::reach(const Ground& ground, Index across, std::size_t through, std::size_t side) {
  const Facet &beyond = facets_.facets()[across], &before = facets_.facets()[room_.found[through]];
  const auto from = static_cast<std::size_t>(std::ranges::find(beyond.across, room_.found[through]) - beyond.across.begin());
  Crossed& reached = room_for(room_.found.size());
  room_.found.push_back(across);
  reached.from = from;
  const auto& known = room_.crossed[through].corners;
  const std::size_t a = (side + 1) % 3, b = (side + 2) % 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index corner = beyond.corners[i];
    reached.corners[i] = corner == before.corners[a]   ? known[a]
                         : corner == before.corners[b] ? known[b]
                                                       : ground.corner(facets_.point(corner));
  }
}

/// The distance of the triangle's own corners from the facets found.
double Overlay::deviation_at_corners(const Ground& ground) const {
  double deviation = 0.0;
  for (std::size_t k = 0; k < room_.found.size(); ++k) {
    const Crossed& here = room_.crossed[k];
    const auto& corner = here.corners;
    const double least = -kRounding * here.area;
    for (const Vec2<double> p : ground.corners) {
      const Vec2<double> to_0 = corner[0].at - p, to_1 = corner[1].at - p, to_2 = corner[2].at - p;
      const double at_0 = cross(to_1, to_2);
      if (at_0 < least) continue;
      const double at_1 = cross(to_2, to_0), at_2 = here.area - at_0 - at_1;
      if (at_1 < least || at_2 < least) continue;
      const double height = (at_0 * corner[0].height + at_1 * corner[1].height + at_2 * corner[2].height) / here.area;
      deviation = std::max(deviation, std::abs(height));
    }
  }
  return deviation;
}

/// Ground of a triangle; none if it is shrunk to a line.
std::optional<Overlay::Ground> Overlay::ground_of(const std::array<Vec3, 3>& corners) {
  const Vec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = length(across);
  if (!(area > 0.0)) return std::nullopt;
  Ground ground{tangent((1.0 / area) * across, corners[1] - corners[0]), corners[0], {}, {}, 0.0, area};
  for (std::size_t i = 0; i < 3; ++i) ground.corners[i] = ground.plane.project(corners[i] - corners[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2<double> edge = ground.corners[(i + 1) % 3] - ground.corners[i];
    const double size = std::sqrt(dot(edge, edge));
    ground.inwards[i] = {-edge.y / size, edge.x / size};
    ground.size = std::max(ground.size, size);
  }
  return ground;
}

std::optional<FacetPlace> Overlay::beneath_centre(const Ground& ground, Index from) const {
  const Vec2<double> centre{(ground.corners[0].x + ground.corners[1].x + ground.corners[2].x) / 3.0,
                            (ground.corners[0].y + ground.corners[1].y + ground.corners[2].y) / 3.0};
  return facets_.walk(from, ground.plane, ground.origin, centre, 0.0);
}

Fit Overlay::triangle(const std::array<Vec3, 3>& corners, Index from, std::span<const Curves::Stretch> allowed) {
  return triangle(corners, from, {}, [allowed] { return allowed; });
}

template <class Allowed>
Fit Overlay::triangle(const std::array<Vec3, 3>& corners, Index from, const Need& need, const Allowed& allowed) {
  const auto ground = ground_of(corners);
  if (!ground) return kNoFit;
  const auto start = beneath_centre(*ground, from);
  if (!start) return kNoFit;
  if (const auto fit = lay_quickly(*ground, start->facet, need)) return *fit;
  const std::span<const Curves::Stretch> stretches = allowed();
  Laid laid;
  room_.found.assign(1, start->facet);
  for (std::size_t i = 0; i < room_.found.size(); ++i)
    if (i > kMostFacets || !lay(*ground, room_.found[i], stretches, laid) || !(laid.fit.least_cosine > 0.0)) return kNoFit;
  // Points beyond a curve are nearer to it than its chord is, and the chord's distance is bounded for vertices that slide along it.
  const bool whole = laid.covered >= (1.0 - kUncovered) * ground->area && laid.covered <= (1.0 + kUncovered) * ground->area;
  return whole || laid.beyond ? laid.fit : kNoFit;
}

/// Finds the stretches of curves along a face's edges.
void Overlay::find_stretches(const Face& face) {
  room_.stretches.clear();
  const Curves& curves = domain_.curves();
  const auto c = faces_.table().corners(face.face);
  const auto position = [&](Index v) { return v == face.vertex ? face.target : face.positions[v]; };
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Index a = c[i], b = c[i + 1 < c.size() ? i + 1 : 0];
    const Index slider = curves.slides(a) ? a : b, other = slider == a ? b : a;
    if (!curves.slides(slider)) continue;
    if (const auto stretch = curves.stretch_to(slider, position(slider), other, position(other))) room_.stretches.push_back(*stretch);
  }
}

/// Finds facets near a face: beneath its vertex, or beside that on its curve, and beneath the face in the input.
void Overlay::find_starts(const Face& face) {
  room_.starts.clear();
  if (face.beneath != nullptr) {
    room_.starts.push_back(face.beneath->facet);
  } else if (const auto place = domain_.curves().place(face.vertex, face.target)) {
    for (const auto& [from, to] : domain_.curves().edges_at(face.vertex, *place)) {
      if (from == kNoIndex) continue;
      for (const FacetSide& side : facets_.sides_of(from, to))
        if (facets_.facets()[side.facet].patch == faces_.patch_of(face.face)) room_.starts.push_back(side.facet);
    }
  }
  const auto [first, count] = faces_.beneath(face.face);
  for (Index i = 0; i < count; ++i) room_.starts.push_back(first + i);
}

/// Fit of a triangular face, or of half a quadrilateral one.
Fit Overlay::triangle_of(const Face& face, const std::array<Vec3, 3>& corners) {
  bool known = false;  // whether the stretches, which are seldom needed, are known
  const auto stretches = [&] {
    if (!std::exchange(known, true)) find_stretches(face);
    return std::span<const Curves::Stretch>(room_.stretches);
  };
  for (const Index start : room_.starts) {
    const Fit fit = triangle(corners, start, face.need, stretches);
    if (fit.deviation < kNoFit.deviation) return fit;
  }
  return kNoFit;
}

Fit Overlay::face(const Face& face) {
  find_starts(face);
  const auto c = faces_.table().corners(face.face);
  const auto at = [&](std::size_t i) { return c[i] == face.vertex ? face.target : face.positions[c[i]]; };
  const auto lay = [&](std::size_t i, std::size_t j, std::size_t k) { return triangle_of(face, {at(i), at(j), at(k)}); };
  if (c.size() == 3) return lay(0, 1, 2);
  const auto both = [&](std::size_t first) {  // fit of both halves at one diagonal
    const Fit one = lay(first, first + 1, first + 2), other = lay(first, first + 2, (first + 3) % 4);
    return Fit{std::max(one.deviation, other.deviation), 0.0, std::min(one.least_cosine, other.least_cosine)};
  };
  const Vec3 one = at(2) - at(0), other = at(3) - at(1);
  const bool by_first = dot(one, one) <= dot(other, other);
  Fit fit = both(by_first ? 0 : 1);
  fit.other_split = both(by_first ? 1 : 0).deviation;
  return fit;
}

/// The triangles of the faces around a vertex, each with the facet beneath its centre.
struct Overlay::Sketch {
  static constexpr std::size_t kMost = 12;
  struct Part {
    std::optional<Ground> ground;
    std::optional<FacetPlace> start;
  };
  std::array<Part, kMost> parts;
};

/// Sketches the faces; false if the deviation at the centre of one exceeds the limit already, which rejects most bad places at little cost.
bool Overlay::sketch(PositionView positions, Index vertex, Vec3 target, const FacetPlace& beneath, double limit, Sketch& out) const {
  const auto around = faces_.at(vertex);
  for (std::size_t k = 0; k < std::min(around.size(), Sketch::kMost); ++k) {
    const auto c = faces_.table().corners(around[k]);
    if (c.size() != 3) continue;
    const auto at = [&](std::size_t i) { return c[i] == vertex ? target : positions[c[i]]; };
    auto& [ground, start] = out.parts[k];
    ground = ground_of({at(0), at(1), at(2)});
    if (!ground) continue;
    start = beneath_centre(*ground, beneath.facet);
    if (start && std::abs(dot(facets_.at(*start) - ground->origin, ground->plane.normal)) > limit) return false;
  }
  return true;
}

Fit Overlay::star(PositionView positions, Index vertex, Vec3 target, const FacetPlace* beneath, const Fit& within) {
  // Limits the precision if the fit need only be within another one.
  Need need;
  if (within.deviation < kNoFit.deviation)
    need = {std::min(within.deviation, within.other_split), kAbove * std::max(within.deviation, within.other_split)};
  Sketch drawn;
  if (beneath != nullptr && !sketch(positions, vertex, target, *beneath, need.limit, drawn)) return kNoFit;
  Fit fit;
  std::size_t k = 0;
  for (const Index f : faces_.at(vertex)) {
    std::optional<Fit> here;
    if (k < Sketch::kMost && drawn.parts[k].start) here = lay_quickly(*drawn.parts[k].ground, drawn.parts[k].start->facet, need);
    if (!here) here = face({positions, f, vertex, target, beneath, need});
    ++k;
    fit = worse(fit, *here);
    if (fit.deviation == kNoFit.deviation) return kNoFit;
    if (!is_within(fit, within)) break;
  }
  return fit;
}

bool Overlay::keeps_what_lies(PositionView positions, Index vertex, Vec3 here, const FacetPlace* here_beneath, Vec3 target,
                              const FacetPlace* beneath, const Fit& bound) {
  const Need all;
  const auto faces = faces_.at(vertex);
  Fit worst = bound;
  std::vector<bool> lies;
  for (const Index f : faces) {
    const Fit now = face({positions, f, vertex, here, here_beneath, all});
    lies.push_back(now.deviation < kNoFit.deviation);
    if (lies.back()) worst = worse(worst, now);
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Fit there = face({positions, faces[i], vertex, target, beneath, all});
    const bool lies_there = there.deviation < kNoFit.deviation;
    if (lies_there ? !is_within(there, worst) : lies[i]) return false;
  }
  return true;
}

}  // namespace dmoscope
