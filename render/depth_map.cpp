#include "render/depth_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dmoscope::render {
namespace {

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
