#include "render/volume_pick.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmoscope::render {
namespace {

/// Distance along the ray to the triangle (Möller and Trumbore); none if the ray misses it.
std::optional<double> meets(const ViewRay& ray, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a, v = c - a, p = cross(ray.direction, v);
  const double volume = dot(u, p);
  if (volume == 0.0) return std::nullopt;
  const Vec3 from = ray.from - a, q = cross(from, u);
  const double x = dot(from, p) / volume, y = dot(ray.direction, q) / volume;
  if (!(x >= 0.0 && y >= 0.0 && x + y <= 1.0)) return std::nullopt;
  const double along = dot(v, q) / volume;
  if (!(along >= ray.first)) return std::nullopt;
  return along;
}

Vec3 mean_of(const SeenFaces& seen, Index element) {
  const auto corners = seen.elements.corners(element);
  Vec3 mean{};
  for (const Index v : corners) mean = mean + seen.positions[v];
  return 1.0 / static_cast<double>(corners.size()) * mean;
}

/// Whether a ray passes so near the mean of an element's vertices that it may meet the element.
bool near_element(const SeenFaces& seen, Index element, const ViewRay& ray) {
  const Vec3 mean = mean_of(seen, element), away = cross(mean - ray.from, ray.direction);
  double square = 0.0;
  for (const Index v : seen.elements.corners(element)) {
    const Vec3 spoke = seen.positions[v] - mean;
    square = std::max(square, dot(spoke, spoke));
  }
  return dot(away, away) <= square * (1.0 + 1e-9);
}

/// Takes the face's corner, of those not cut away, that is nearest in pixels.
void take_nearest(const SeenFaces& seen, const DrawnFace& corners, const Projection& projection, Vec2<double> at, double radius, Pick& pick,
                  double& depth) {
  for (std::size_t i = 0; i < corners.count; ++i) {
    const auto place = projection.place(corners.points[i]);
    if (!place || cut_away(seen, corners.points[i])) continue;
    const double distance = std::hypot(place->x - at.x, place->y - at.y);
    if (distance > radius) continue;
    const double far = projection.depth(corners.points[i]);
    // The front one is taken if several vertices are behind each other.
    constexpr double kSame = 0.5;  // pixels
    const bool better =
        pick.vertex == kNoIndex || distance < pick.vertex_distance - kSame || (distance < pick.vertex_distance + kSame && far < depth);
    if (!better) continue;
    pick.vertex = corners.vertices[i];
    pick.vertex_distance = distance;
    depth = far;
  }
}

}  // namespace

DrawnFace drawn_face(const SeenFaces& seen, ElementFace face) {
  DrawnFace corners{{}, vertices_of(seen.elements, face), 4};
  if (corners.vertices[3] == kNoIndex) corners.count = 3;
  for (std::size_t i = 0; i < corners.count; ++i) corners.points[i] = seen.positions[corners.vertices[i]];
  if (seen.view.shrink < 1.0) {
    const Vec3 mean = mean_of(seen, face.element);
    for (Vec3& p : corners.points) p = mean + seen.view.shrink * (p - mean);
  }
  return corners;
}

bool cut_away(const SeenFaces& seen, Vec3 point) {
  const ClipPlane& clip = seen.view.clip;
  return clip.on && clip.mode == ClipPlane::Mode::Cut && clip.beyond(point) > 0.0;
}

bool SeenFaces::has_vertex(Index vertex) const {
  return (vertices.empty() || vertices[vertex] != 0) && !cut_away(*this, positions[vertex]);
}

std::optional<RayHit> first_hit(const SeenFaces& seen, const ViewRay& ray) {
  std::optional<RayHit> hit;
  const auto consider = [&](std::optional<double> along, Index element, std::optional<ElementFace> face) {
    if (along && (!hit || *along < hit->along)) hit = RayHit{element, face, *along};
  };
  const auto kept = [&](std::optional<double> along) {
    return along && !cut_away(seen, ray.from + *along * ray.direction) ? along : std::nullopt;
  };
  Index element = kNoIndex;
  bool near = false;
  for (const ElementFace& face : seen.faces.faces) {
    if (std::exchange(element, face.element) != face.element) near = near_element(seen, element, ray);
    if (!near) continue;
    const DrawnFace c = drawn_face(seen, face);
    consider(kept(meets(ray, c.points[0], c.points[1], c.points[2])), face.element, face);
    if (c.count == 4) consider(kept(meets(ray, c.points[2], c.points[3], c.points[0])), face.element, face);
  }
  const PlaneCuts& cuts = seen.faces.cuts;
  for (const CutPolygon& polygon : cuts.polygons) {
    const Vec3* p = cuts.points.data() + polygon.first;
    for (Index i = 1; i + 1 < polygon.count; ++i) consider(meets(ray, p[0], p[i], p[i + 1]), polygon.element, std::nullopt);
  }
  return hit;
}

Vec3 point_on(std::span<const Vec3> polygon) {
  return polygon.size() == 4 ? 0.5 * (polygon[0] + polygon[2]) : 1.0 / 3.0 * (polygon[0] + polygon[1] + polygon[2]);
}

bool is_unhidden(const SeenFaces& seen, const Bounds3& bounds, const OrbitCamera& camera, Vec2<double> viewport, Index cell) {
  const Projection projection = camera.projection(viewport, bounds);
  const auto shows = [&](Vec3 point) {
    const auto place = cut_away(seen, point) ? std::nullopt : projection.place(point);
    if (!place) return false;
    const auto hit = first_hit(seen, camera.ray({0.5 * viewport.x + place->x, 0.5 * viewport.y - place->y}, viewport));
    return hit && hit->element == cell;
  };
  const auto shows_some = [&](std::span<const Vec3> polygon) {
    const Vec3 middle = point_on(polygon);
    return shows(middle) || std::ranges::any_of(polygon, [&](Vec3 corner) { return shows(0.5 * (middle + corner)); });
  };
  const PlaneCuts& cuts = seen.faces.cuts;
  return std::ranges::any_of(seen.faces.faces,
                             [&](ElementFace face) { return face.element == cell && shows_some(drawn_face(seen, face).corners()); }) ||
         std::ranges::any_of(cuts.polygons, [&](const CutPolygon& polygon) {
           return polygon.element == cell && shows_some(std::span(cuts.points).subspan(polygon.first, polygon.count));
         });
}

Pick pick(const SeenFaces& seen, const Bounds3& bounds, const OrbitCamera& camera, Vec2<double> viewport, Vec2<double> pixel,
          double radius) {
  Pick result;
  const Projection projection = camera.projection(viewport, bounds);
  const Vec2<double> at{pixel.x - 0.5 * viewport.x, 0.5 * viewport.y - pixel.y};
  double depth = 0.0;
  if (const auto hit = first_hit(seen, camera.ray(pixel, viewport))) {
    result.element = hit->element;
    if (hit->face) {
      take_nearest(seen, drawn_face(seen, *hit->face), projection, at, radius, result, depth);
    } else {
      const auto faces = static_cast<Index>(faces_of(seen.elements.kind(hit->element)).size());
      for (Index f = 0; f < faces; ++f) {
        take_nearest(seen, drawn_face(seen, {hit->element, f}), projection, at, radius, result, depth);
      }
    }
    return result;
  }
  for (const ElementFace& face : seen.faces.faces) take_nearest(seen, drawn_face(seen, face), projection, at, radius, result, depth);
  return result;
}

Vec3 drawn_corner(const SeenFaces& seen, Index element, Index vertex) {
  const Vec3 point = seen.positions[vertex];
  if (seen.view.shrink == 1.0) return point;
  const Vec3 mean = mean_of(seen, element);
  return mean + seen.view.shrink * (point - mean);
}

}  // namespace dmoscope::render
