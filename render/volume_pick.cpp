#include "render/volume_pick.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

constexpr double kLongerSide = 800.0;  // length of the longer side, in pixels of the map
constexpr double kLeastSlack = 2e-3;   // share of the range of depths, -1 to 1
constexpr double kSteep = 3.0;         // steepness of faces whose outermost corner must not be lost

/// Part of a convex polygon that a cutting plane leaves (Sutherland and Hodgman).
std::vector<Vec3> left_by(const ClipPlane& clip, std::span<const Vec3> polygon) {
  std::vector<Vec3> left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double at_a = clip.beyond(a), at_b = clip.beyond(b);
    if (at_a <= 0.0) left.push_back(a);
    if ((at_a > 0.0) != (at_b > 0.0)) left.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return left;
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

DepthMap::DepthMap(const SeenFaces& seen, const Projection& projection) : projection_(projection) {
  const Vec2<double> size = projection.viewport();
  scale_ = std::min(1.0, kLongerSide / std::max({size.x, size.y, 1.0}));
  width_ = std::max(1, static_cast<int>(std::ceil(scale_ * size.x)));
  height_ = std::max(1, static_cast<int>(std::ceil(scale_ * size.y)));
  slack_ = std::max(kLeastSlack, kSteep * depth_of_a_pixel());
  depths_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), std::numeric_limits<float>::infinity());
  for (const ElementFace& face : seen.faces.faces) {
    const DrawnFace drawn = drawn_face(seen, face);
    const auto beyond = [&](Vec3 p) { return cut_away(seen, p); };
    if (std::ranges::any_of(drawn.corners(), beyond)) {
      draw(left_by(seen.view.clip, drawn.corners()));
    } else {
      draw(drawn.corners());
    }
  }
  const PlaneCuts& cuts = seen.faces.cuts;
  for (const CutPolygon& polygon : cuts.polygons) draw(std::span(cuts.points).subspan(polygon.first, polygon.count));
}

/// Difference of depth for a way behind the mesh's middle as long as a pixel of the map is wide there.
double DepthMap::depth_of_a_pixel() const {
  const auto& m = projection_.matrix();
  const Vec3 right{m[0], m[4], m[8]}, up{m[1], m[5], m[9]}, across = cross(right, up);
  const double step = 1e-3 / length(right);  // half the viewport is 1 there
  const Vec3 middle = projection_.origin(), behind = middle - step / length(across) * across;
  const auto here = projection_.place(middle), beside = projection_.place(middle + step / length(right) * right);
  if (!here || !beside || !projection_.place(behind)) return 0.0;
  const double pixels = scale_ * std::hypot(beside->x - here->x, beside->y - here->y);
  return std::abs(projection_.depth(behind) - projection_.depth(middle)) / pixels;
}

std::optional<DepthMap::Corner> DepthMap::corner(Vec3 point) const {
  const auto place = projection_.place(point);
  if (!place) return std::nullopt;
  const Vec2<double> size = projection_.viewport();
  return Corner{scale_ * (0.5 * size.x + place->x), scale_ * (0.5 * size.y + place->y), projection_.depth(point)};
}

void DepthMap::draw(std::span<const Vec3> polygon) {
  std::array<Corner, 3> fan{};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto next = corner(polygon[i]);
    if (!next) return;  // behind the eye
    fan[std::min<std::size_t>(i, 2)] = *next;
    if (i < 2) continue;
    draw(fan[0], fan[1], fan[2]);
    fan[1] = fan[2];
  }
}

/// Draws a triangle. Depths are linear over its picture, also in perspective.
void DepthMap::draw(const Corner& a, const Corner& b, const Corner& c) {
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 1e-12)) return;
  const auto within = [](double at, int count) { return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(count))); };
  const int left = within(std::floor(std::min({a.x, b.x, c.x})), width_), end = within(std::ceil(std::max({a.x, b.x, c.x})), width_);
  const int low = within(std::floor(std::min({a.y, b.y, c.y})), height_), high = within(std::ceil(std::max({a.y, b.y, c.y})), height_);
  // Growth of the shares of b and c along x and y, from a.
  const double b_x = (c.y - a.y) / area, b_y = (a.x - c.x) / area, c_x = (a.y - b.y) / area, c_y = (b.x - a.x) / area;
  for (int row = low; row < high; ++row) {
    const double y = row + 0.5 - a.y;
    float* depths = depths_.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_);
    for (int column = left; column < end; ++column) {
      const double x = column + 0.5 - a.x, of_b = b_x * x + b_y * y, of_c = c_x * x + c_y * y;
      if (of_b < 0.0 || of_c < 0.0 || of_b + of_c > 1.0) continue;
      depths[column] = std::min(depths[column], static_cast<float>(a.depth + of_b * (b.depth - a.depth) + of_c * (c.depth - a.depth)));
    }
  }
}

bool DepthMap::shows(Vec3 point) const {
  const auto at = corner(point);
  if (!at || at->x < 0.0 || at->y < 0.0 || at->x >= width_ || at->y >= height_) return false;
  const int column = static_cast<int>(at->x), row = static_cast<int>(at->y);
  // On a face that is seen obliquely, some pixel beside the point's own is as far away as the point. Empty pixels prove nothing: they may
  // be beside the face that hides the point.
  bool all_empty = true;
  for (int y = std::max(0, row - 1); y <= std::min(height_ - 1, row + 1); ++y) {
    for (int x = std::max(0, column - 1); x <= std::min(width_ - 1, column + 1); ++x) {
      const float depth = depths_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
      if (std::isinf(depth)) continue;
      all_empty = false;
      if (static_cast<double>(depth) >= at->depth - slack_) return true;
    }
  }
  return all_empty;
}

Unhidden unhidden_of(const SeenFaces& seen, const DepthMap& depths) {
  enum : std::uint8_t { Unknown, Shown, Hidden };
  std::vector<std::uint8_t> known(seen.positions.size(), Unknown);
  const auto is_shown = [&](Index v) {
    if (known[v] == Unknown) known[v] = !cut_away(seen, seen.positions[v]) && depths.shows(seen.positions[v]) ? Shown : Hidden;
    return known[v] == Shown;
  };
  Unhidden unhidden;
  for (const ElementFace& face : seen.faces.faces) {
    const auto vertices = vertices_of(seen.elements, face);
    const std::size_t count = vertices[3] == kNoIndex ? 3 : 4;
    for (std::size_t i = 0; i < count; ++i) {
      const Index a = vertices[i], b = vertices[(i + 1) % count];
      if (is_shown(a) && is_shown(b)) unhidden.edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  for (Index v = 0; v < known.size(); ++v)
    if (known[v] == Shown) unhidden.vertices.push_back(v);
  unhidden.tidy();
  return unhidden;
}

}  // namespace dmoscope::render
