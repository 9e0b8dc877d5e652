// What is where in a viewport.
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "render/labels.h"
#include "render/planar_scene_impl.h"

namespace dmoscope::render {

Pick PlanarScene::pick(const Camera& seen_from, Vec2<double> viewport, Vec2<double> pixel, double radius) const {
  const Camera2D& camera = std::get<Camera2D>(seen_from);
  Pick result;
  Impl& s = *impl_;
  if (empty() || s.source == Source::Unreachable) return result;
  try {
    s.place_all();
  } catch (const DeviceError&) {
    return result;
  }
  const Vec2<double> point = camera.to_plane(pixel, viewport);
  const double reach = std::max(radius, 0.0) * camera.units_per_pixel;
  const Bounds2 window{{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}};
  double nearest = reach * reach;
  bool on_top = false;
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements = s.placement.layout().batches[batch];
    for (const DrawRange& range : s.placement.visible(batch, window)) {
      for (Index drawn = range.first; drawn < range.last; ++drawn) {
        const Index element = elements.order[drawn];
        if (s.hidden(element)) continue;
        const auto corners = s.placement.layout().corners_of(elements.order[drawn]);
        for (const Index v : corners) {
          const Vec2<double> away = s.placement.points()[v] - point;
          const double square = dot(away, away);
          if (square < nearest || (square == nearest && v < result.vertex)) {
            nearest = square;
            result.vertex = v;
          }
        }
        if (s.placement.layout().is_across(corners, s.placement.points()) || !contains(corners, s.placement.points(), point)) continue;
        const bool inverted = element < s.shades.size() && s.shades[element] == kInvertedShade;
        if (on_top && !inverted) continue;  // the later one covers the earlier one, but no inverted one
        result.element = element;
        on_top = inverted;
      }
    }
  }
  result.vertex_distance = std::sqrt(nearest) / camera.units_per_pixel;
  return result;
}

std::vector<Index> PlanarScene::vertices_near(const Camera2D& camera, Vec2<double> viewport, Vec2<double> pixel, double radius) const {
  std::vector<Index> found;
  Impl& s = *impl_;
  if (empty() || s.source == Source::Unreachable) return found;
  try {
    s.place_all();
  } catch (const DeviceError&) {
    return found;
  }
  const Vec2<double> point = camera.to_plane(pixel, viewport);
  const double reach = radius * camera.units_per_pixel;
  const Bounds2 window{{point.x - reach, point.y - reach}, {point.x + reach, point.y + reach}};
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements = s.placement.layout().batches[batch];
    for (const DrawRange& range : s.placement.visible(batch, window)) {
      for (Index drawn = range.first; drawn < range.last; ++drawn) {
        if (s.hidden(elements.order[drawn])) continue;
        for (const Index v : s.placement.layout().corners_of(elements.order[drawn])) {
          const Vec2<double> away = s.placement.points()[v] - point;
          if (dot(away, away) <= reach * reach) found.push_back(v);
        }
      }
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::optional<std::vector<Index>> PlanarScene::elements_in_view(const Camera2D& camera, Vec2<double> viewport, std::size_t most) const {
  const Impl& s = *impl_;
  std::vector<Index> found;
  if (empty()) return found;
  if (!s.placement_current) return std::nullopt;
  const Impl::InView seen = s.in_view(camera.visible(viewport));
  if (seen.count > most) return std::nullopt;
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements = s.placement.layout().batches[batch];
    for (const DrawRange& range : seen.ranges[batch])
      for (Index drawn = range.first; drawn < range.last; ++drawn)
        if (!s.hidden(elements.order[drawn])) found.push_back(elements.order[drawn]);
  }
  return found;
}

namespace {

/// Where an element's label belongs, and how far that is from the nearest edge; nothing for an element that is too thin for words.
struct FreeSpace {
  Vec2<double> point;
  double radius = 0.0;
};

FreeSpace room_of(std::span<const Index> corners, std::span<const Vec2<double>> points) {
  FreeSpace room{{0, 0}, INFINITY};
  if (corners.size() == 3) {
    const Vec2<double> a = points[corners[0]], b = points[corners[1]], c = points[corners[2]];
    const auto length = [](Vec2<double> d) { return std::hypot(d.x, d.y); };
    const double wa = length(c - b), wb = length(a - c), wc = length(b - a), whole = wa + wb + wc;
    if (!(whole > 0.0)) return {a, 0.0};
    const Vec2<double> ab = b - a, ac = c - a;
    room.point = a + Vec2<double>{(wb * ab.x + wc * ac.x) / whole, (wb * ab.y + wc * ac.y) / whole};  // of the inscribed circle
  } else {
    const auto share = 1.0 / static_cast<double>(corners.size());
    for (const Index v : corners) room.point = room.point + Vec2<double>{share * points[v].x, share * points[v].y};
    if (!contains(corners, points, room.point)) return {room.point, 0.0};
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2<double> a = points[corners[i]], along = points[corners[(i + 1) % corners.size()]] - a;
    const double size = std::hypot(along.x, along.y);
    if (size > 0.0) room.radius = std::min(room.radius, std::abs(cross(along, room.point - a)) / size);
  }
  return room;
}

bool inside(const Bounds2& box, Vec2<double> point) {
  return point.x >= box.low.x && point.x <= box.high.x && point.y >= box.low.y && point.y <= box.high.y;
}

}  // namespace

std::vector<Label> PlanarScene::labels(const Camera& seen_from, Vec2<double> viewport, const LabelWish& wish) const {
  const Camera2D& camera = std::get<Camera2D>(seen_from);
  Impl& s = *impl_;
  constexpr Index kMostInView = 40'000;  // as blocks tell: few of them are looked at however big the mesh is
  if (empty() || s.source == Source::Unreachable || !(wish.vertices || wish.elements)) return {};
  try {
    s.place_all();
  } catch (const DeviceError&) {
    return {};
  }
  const Bounds2 window = camera.visible(viewport);
  const Impl::InView seen = s.in_view(window);
  if (seen.count > kMostInView) return {};
  const auto points = s.placement.points();
  const auto fits = [&](double pixels, double plane) { return pixels * camera.units_per_pixel <= plane; };
  std::vector<Label> labels;
  std::map<Index, double> nearest;  // of the vertices in view: the shortest of their edges
  for (std::size_t batch = 0; batch < 2; ++batch) {
    const Batch& elements = s.placement.layout().batches[batch];
    for (const DrawRange& range : seen.ranges[batch]) {
      for (Index drawn = range.first; drawn < range.last; ++drawn) {
        const Index element = elements.order[drawn];
        if (s.hidden(element)) continue;
        const auto corners = s.placement.layout().corners_of(elements.order[drawn]);
        if (s.placement.layout().is_across(corners, points)) continue;
        if (wish.elements) {
          const FreeSpace room = room_of(corners, points);
          const double half = 0.5 * std::hypot(label_width(element, wish), wish.line_height);
          if (inside(window, room.point) && fits(half, room.radius)) labels.push_back({room.point, element, false});
        }
        for (std::size_t i = 0; wish.vertices && i < corners.size(); ++i) {
          const Index a = corners[i], b = corners[(i + 1) % corners.size()];
          const Vec2<double> edge = points[b] - points[a];
          const double length = std::hypot(edge.x, edge.y);
          for (const Index v : {a, b}) {
            if (!inside(window, points[v])) continue;
            const auto [at, added] = nearest.try_emplace(v, length);
            if (!added) at->second = std::min(at->second, length);
          }
        }
      }
    }
  }
  // Neighbours with labels of the same width keep some room between them.
  for (const auto& [vertex, length] : nearest) {
    if (fits(label_width(vertex, wish) + 2.0 * wish.digit_width, length)) labels.push_back({points[vertex], vertex, true});
  }
  if (labels.size() > wish.most) labels.clear();
  std::sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.vertex != b.vertex ? b.vertex : a.id < b.id; });
  return labels;
}

}  // namespace dmoscope::render
