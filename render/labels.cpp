#include "render/labels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>

#include "render/scene.h"
#include "render/text.h"

namespace dmoscope::render {
namespace {

constexpr float kText = 12.0F;  // pixels at scale 1

void blend(Image& image, int x, int y, Rgb colour, double cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const Rgba under = image.at(x, y);
  const double alpha = cover + under.a / 255.0 * (1.0 - cover);
  const auto mix = [&](std::uint8_t above, std::uint8_t below) {
    return static_cast<std::uint8_t>(std::lround((above * cover + below * (under.a / 255.0) * (1.0 - cover)) / alpha));
  };
  image.set(x, y,
            {mix(colour.r, under.r), mix(colour.g, under.g), mix(colour.b, under.b), static_cast<std::uint8_t>(std::lround(255 * alpha))});
}

double length_of(Vec2<double> v) { return std::hypot(v.x, v.y); }

/// A place within a polygon, and its distance from the border; 0 when it lies outside.
struct LabelRoom {
  Vec2<double> point;
  double radius = 0.0;
};

/// Room within a polygon: the inscribed circle of a triangle, else a circle around the mean of the corners.
LabelRoom room_of(std::span<const Vec2<double>> corners) {
  const std::size_t count = corners.size();
  Vec2<double> sum{0, 0};
  double weights = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double weight = count == 3 ? length_of(corners[(i + 2) % count] - corners[(i + 1) % count]) : 1.0;
    sum = sum + Vec2<double>{weight * corners[i].x, weight * corners[i].y};
    weights += weight;
  }
  if (!(weights > 0.0)) return {corners[0], 0.0};
  LabelRoom room{{sum.x / weights, sum.y / weights}, INFINITY};
  double side = 0.0;  // length of the first edge
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2<double> along = corners[(i + 1) % count] - corners[i];
    const double size = length_of(along), away = size > 0.0 ? cross(along, room.point - corners[i]) / size : 0.0;
    if (side == 0.0) side = away < 0.0 ? -1.0 : 1.0;
    room.radius = std::min(room.radius, std::max(0.0, side * away));
  }
  return room;
}

bool holds(Vec2<double> viewport, Vec2<double> point) {
  return std::abs(point.x) <= 0.5 * viewport.x && std::abs(point.y) <= 0.5 * viewport.y;
}

}  // namespace

Vec2<double> label_digit(float scale) {
  const auto size = static_cast<double>(kText * scale);
  return {0.64 * size, 1.25 * size};
}

double label_width(Index id, const LabelWish& wish) { return static_cast<double>(std::to_string(id).size()) * wish.digit_width; }

void draw_labels(Image& image, std::span<const Label> labels, Vec2<double> viewport, const Style& style, float scale) {
  const std::unique_ptr<Font> font = Font::load();
  if (!font || labels.empty()) return;
  const Rgba paper = style.casing_colour, ink = style.highlight_colour;
  const float size = kText * scale;
  for (const Label& label : labels) {
    const std::string text = std::to_string(label.id);
    const int width = font->width(text, size), pad = static_cast<int>(std::lround(2.0F * scale));
    const int height = static_cast<int>(std::lround(0.74F * size));  // height of a digit
    const Vec2<double> at{0.5 * viewport.x + label.point.x, 0.5 * viewport.y - label.point.y};
    const int left = static_cast<int>(std::lround(at.x)) - width / 2, top = static_cast<int>(std::lround(at.y)) - height / 2;
    // Labels of vertices are dark on light, those of elements light on dark.
    const Rgba plate = label.vertex ? ink : paper, letters = label.vertex ? paper : ink;
    for (int y = top - pad; y < top + height + pad; ++y) {
      for (int x = left - pad; x < left + width + pad; ++x) blend(image, x, y, {plate.r, plate.g, plate.b}, 0.88);
    }
    font->draw(image, left, top + height, text, size, {letters.r, letters.g, letters.b, 255});
  }
}

/// Adds a label for every element in the widest room that it has.
void Scene::add_element_labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish, std::vector<Label>& labels) const {
  const SceneView seen = view(camera, viewport);
  std::map<Index, LabelRoom> rooms;
  std::vector<Vec2<double>> corners;
  visit_shown(camera, viewport, [&](Index element, std::span<const Vec3> polygon) {
    corners.clear();
    for (const Vec3& point : polygon)
      if (const auto place = seen.place(point)) corners.push_back(*place);
    if (corners.size() != polygon.size()) return;
    const LabelRoom room = room_of(corners);
    if (!holds(viewport, room.point) || 0.5 * std::hypot(label_width(element, wish), wish.line_height) > room.radius) return;
    LabelRoom& best = rooms[element];
    if (room.radius > best.radius) best = room;
  });
  for (const auto& [element, room] : rooms) labels.push_back({room.point, element, false});
}

/// Adds labels of vertices; each needs room up to its nearest neighbour, which has a label, too.
void Scene::add_vertex_labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish, std::vector<Label>& labels) const {
  const auto shown = unhidden(camera, viewport);
  if (!shown) return;
  const SceneView seen = view(camera, viewport);
  std::vector<Corner> vertices(shown->vertices.size());
  std::ranges::transform(shown->vertices, vertices.begin(), [](Index v) { return Corner{kNoIndex, v}; });
  const std::vector<Vec3> points = places_of(vertices);
  std::vector<double> nearest(points.size(), INFINITY);
  const auto slot = [&](Index v) {
    return static_cast<std::size_t>(std::ranges::lower_bound(shown->vertices, v) - shown->vertices.begin());
  };
  for (const auto& [a, b] : shown->edges) {
    const double length = seen.pixels(points[slot(a)], points[slot(b)]);
    for (const Index v : {a, b}) nearest[slot(v)] = std::min(nearest[slot(v)], length);
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Index v = shown->vertices[k];
    const auto place = seen.place(points[k]);
    if (place && holds(viewport, *place) && std::isfinite(nearest[k]) && label_width(v, wish) + 2.0 * wish.digit_width <= nearest[k])
      labels.push_back({*place, v, true});
  }
}

std::vector<Label> Scene::labels(const Camera& camera, Vec2<double> viewport, const LabelWish& wish) const {
  std::vector<Label> labels;
  if (empty()) return labels;
  if (wish.elements) add_element_labels(camera, viewport, wish, labels);
  if (wish.vertices) add_vertex_labels(camera, viewport, wish, labels);
  if (labels.size() > wish.most) return {};
  // Ids on faces that are seen obliquely can come near each other, close to the faces' corners.
  std::vector<Label> apart;
  for (const Label& label : labels) {
    const auto covers = [&](const Label& other) {
      return std::abs(other.point.y - label.point.y) < wish.line_height &&
             std::abs(other.point.x - label.point.x) < 0.5 * (label_width(other.id, wish) + label_width(label.id, wish)) + wish.digit_width;
    };
    if (std::ranges::none_of(apart, covers)) apart.push_back(label);
  }
  return apart;
}

}  // namespace dmoscope::render
