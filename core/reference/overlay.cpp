#include "core/reference/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope {

namespace {

/// Lengths below this share of a triangle's longest edge, and areas below it of the triangle's, are rounding.
constexpr double kRounding = 1e-9;
constexpr double kUncovered = 1e-6;
/// Of 60 degrees: facets that lean farther away are laid slowly.
constexpr double kFarAway = 0.5;
constexpr std::size_t kMostFacets = 4096;

Plane tangent(Vec3 normal, Vec3 along) {
  const Vec3 u = (1.0 / length(along)) * along;
  return {u, cross(normal, u), normal};
}

}  // namespace

/// A triangle as the plane that facets are projected on.
struct Overlay::Ground {
  Plane plane;
  Vec3 origin;
  std::array<Vec2<double>, 3> corners;  // counter-clockwise
  std::array<Vec2<double>, 3> inwards;  // of length 1, across each edge
  double size, area;                    // the longest edge; twice the area
  [[nodiscard]] Corner corner(Vec3 p) const {
    const Vec3 way = p - origin;
    Corner result{plane.project(way), dot(way, plane.normal), {}};
    for (std::size_t i = 0; i < 3; ++i) result.inside[i] = dot(inwards[i], result.at - corners[i]);
    return result;
  }
};

/// The part of a segment that runs inside the triangle by more than a margin, if it is more than a point and not only along an edge.
std::optional<Overlay::Part> Overlay::part_inside(const Corner& from, const Corner& to, double margin) {
  double first = 0.0, last = 1.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double at_first = from.inside[i] - margin, at_last = to.inside[i] - margin;
    if (at_first <= 0.0 && at_last <= 0.0) return std::nullopt;
    if (at_first < 0.0) first = std::max(first, at_first / (at_first - at_last));
    if (at_last < 0.0) last = std::min(last, at_first / (at_first - at_last));
  }
  if (!(last > first)) return std::nullopt;
  const Vec2<double> way = to.at - from.at;
  if (!((last - first) * (last - first) * dot(way, way) > margin * margin)) return std::nullopt;
  return Part{first, last};
}

/// Cuts off what of the polygon lies beyond one of the triangle's edges (Sutherland and Hodgman).
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

/// Lays one facet under the triangle and notes the facets beyond its edges; false where the triangle lies across a feature edge.
bool Overlay::lay(const Ground& ground, Index facet, std::span<const Curves::Stretch> allowed, Laid& laid) {
  const Facet& here = facets_.facets()[facet];
  auto& polygon = room_.polygon;
  polygon.clear();
  for (const Index corner : here.corners) polygon.push_back(ground.corner(facets_.point(corner)));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    if (!part_inside(polygon[a], polygon[b], kRounding * ground.size)) continue;
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

/// Without cutting any facet: the distance is greatest where a facet's edge begins or ends inside the triangle, or at a corner of the
/// triangle. None where that may not be all: at feature edges, where a facet leans far away, and around vertices where facets might cover
/// the triangle more than once.
std::optional<Fit> Overlay::lay_quickly(const Ground& ground, Index start) {
  const double margin = kRounding * ground.size;
  auto& crossed = room_.crossed;
  crossed.assign(1, {start, 3});
  Fit fit;
  for (std::size_t k = 0; k < crossed.size(); ++k) {
    if (k > kMostFacets) return std::nullopt;
    const auto [facet, from] = crossed[k];
    const Facet& here = facets_.facets()[facet];
    const std::array<Corner, 3> corner{ground.corner(facets_.point(here.corners[0])), ground.corner(facets_.point(here.corners[1])),
                                       ground.corner(facets_.point(here.corners[2]))};
    const double area = cross(corner[1].at - corner[0].at, corner[2].at - corner[0].at), cosine = area / facets_.twice_area(facet);
    if (!(cosine >= kFarAway)) return std::nullopt;
    fit.least_cosine = std::min(fit.least_cosine, cosine);
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &a = corner[(i + 1) % 3], &b = corner[(i + 2) % 3];
      if (std::min({corner[i].inside[0], corner[i].inside[1], corner[i].inside[2]}) > margin && !facets_.covers_once(facet, i))
        return std::nullopt;
      if (i == from) continue;
      const auto part = part_inside(a, b, margin);
      if (!part) continue;
      const double rise = b.height - a.height;
      fit.deviation = std::max({fit.deviation, std::abs(a.height + part->first * rise), std::abs(a.height + part->last * rise)});
      const Index across = here.across[i];
      if (across == kNoIndex) return std::nullopt;
      if (std::ranges::find(crossed, across, &OverlayRoom::Crossed::facet) != crossed.end()) continue;
      const auto& back = facets_.facets()[across].across;
      crossed.push_back({across, static_cast<std::size_t>(std::ranges::find(back, facet) - back.begin())});
    }
    const double least = -kRounding * area;
    for (const Vec2<double> p : ground.corners) {
      const Vec2<double> to_0 = corner[0].at - p, to_1 = corner[1].at - p, to_2 = corner[2].at - p;
      const double at_0 = cross(to_1, to_2), at_1 = cross(to_2, to_0), at_2 = area - at_0 - at_1;
      if (at_0 < least || at_1 < least || at_2 < least) continue;
      const double height = (at_0 * corner[0].height + at_1 * corner[1].height + at_2 * corner[2].height) / area;
      fit.deviation = std::max(fit.deviation, std::abs(height));
    }
  }
  return fit;
}

Fit Overlay::triangle(const std::array<Vec3, 3>& corners, Index from, std::span<const Curves::Stretch> allowed) {
  const Vec3 across = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = length(across);
  if (!(area > 0.0)) return kNoFit;
  Ground ground{tangent((1.0 / area) * across, corners[1] - corners[0]), corners[0], {}, {}, 0.0, area};
  for (std::size_t i = 0; i < 3; ++i) ground.corners[i] = ground.plane.project(corners[i] - corners[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2<double> edge = ground.corners[(i + 1) % 3] - ground.corners[i];
    const double size = std::sqrt(dot(edge, edge));
    ground.inwards[i] = {-edge.y / size, edge.x / size};
    ground.size = std::max(ground.size, size);
  }
  const Vec2<double> centre{(ground.corners[0].x + ground.corners[1].x + ground.corners[2].x) / 3.0,
                            (ground.corners[0].y + ground.corners[1].y + ground.corners[2].y) / 3.0};
  const auto start = facets_.walk(from, ground.plane, ground.origin, centre, 0.0);
  if (!start) return kNoFit;
  if (const auto fit = lay_quickly(ground, start->facet)) return *fit;
  Laid laid;
  room_.found.assign(1, start->facet);
  for (std::size_t i = 0; i < room_.found.size(); ++i)
    if (i > kMostFacets || !lay(ground, room_.found[i], allowed, laid) || !(laid.fit.least_cosine > 0.0)) return kNoFit;
  // What lies beyond a curve is nearer to it than its chord is, and that is bounded where vertices slide along it.
  const bool whole = laid.covered >= (1.0 - kUncovered) * area && laid.covered <= (1.0 + kUncovered) * area;
  return whole || laid.beyond ? laid.fit : kNoFit;
}

/// The stretches of curves along a face's edges.
void Overlay::find_stretches(PositionView positions, Index face, Index vertex, Vec3 target) {
  room_.stretches.clear();
  const Curves& curves = domain_.curves();
  const auto c = facets_.faces().corners(face);
  const auto position = [&](Index v) { return v == vertex ? target : positions[v]; };
  for (std::size_t i = 0; i < c.size(); ++i) {
    const Index a = c[i], b = c[i + 1 < c.size() ? i + 1 : 0];
    const Index slider = curves.slides(a) ? a : b, other = slider == a ? b : a;
    if (!curves.slides(slider)) continue;
    if (const auto stretch = curves.stretch_to(slider, position(slider), other, position(other))) room_.stretches.push_back(*stretch);
  }
}

/// Facets near a face: beneath its vertex, or beside that on its curve, and where the face was in the input.
void Overlay::find_starts(Index vertex, Vec3 target, Index face, const FacetPlace* beneath) {
  room_.starts.clear();
  if (beneath != nullptr) {
    room_.starts.push_back(beneath->facet);
  } else if (const auto place = domain_.curves().place(vertex, target)) {
    for (const auto& [from, to] : domain_.curves().edges_at(vertex, *place)) {
      if (from == kNoIndex) continue;
      for (const FacetSide& side : facets_.sides_of(from, to))
        if (facets_.facets()[side.facet].patch == facets_.patch_of_face(face)) room_.starts.push_back(side.facet);
    }
  }
  const Index first = facets_.first_facet(face), count = static_cast<Index>(facets_.faces().corners(face).size()) - 2;
  for (Index i = 0; i < count; ++i) room_.starts.push_back(first + i);
}

Fit Overlay::face(PositionView positions, Index face, Index vertex, Vec3 target) {
  find_stretches(positions, face, vertex, target);
  const auto c = facets_.faces().corners(face);
  const auto at = [&](std::size_t i) { return c[i] == vertex ? target : positions[c[i]]; };
  const auto lay = [&](std::size_t i, std::size_t j, std::size_t k) {
    for (const Index start : room_.starts) {
      const Fit fit = triangle({at(i), at(j), at(k)}, start, room_.stretches);
      if (fit.deviation < kNoFit.deviation) return fit;
    }
    return kNoFit;
  };
  if (c.size() == 3) return lay(0, 1, 2);
  const auto both = [&](std::size_t first) {  // from one end of a diagonal to the other
    const Fit one = lay(first, first + 1, first + 2), other = lay(first, first + 2, (first + 3) % 4);
    return Fit{std::max(one.deviation, other.deviation), 0.0, std::min(one.least_cosine, other.least_cosine)};
  };
  const Vec3 one = at(2) - at(0), other = at(3) - at(1);
  const bool by_first = dot(one, one) <= dot(other, other);
  Fit fit = both(by_first ? 0 : 1);
  fit.other_split = both(by_first ? 1 : 0).deviation;
  return fit;
}

Fit Overlay::star(PositionView positions, Index vertex, Vec3 target, const FacetPlace* beneath, const Fit& within) {
  Fit fit;
  for (const Index f : facets_.faces_at(vertex)) {
    find_starts(vertex, target, f, beneath);
    const Fit here = face(positions, f, vertex, target);
    fit.deviation = std::max(fit.deviation, here.deviation);
    fit.other_split = std::max(fit.other_split, here.other_split);
    fit.least_cosine = std::min(fit.least_cosine, here.least_cosine);
    if (fit.deviation == kNoFit.deviation) return kNoFit;
    if (!is_within(fit, within)) break;
  }
  return fit;
}

}  // namespace dmoscope
