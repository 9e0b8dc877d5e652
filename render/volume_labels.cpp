#include "render/volume_labels.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "render/labels.h"

namespace dmoscope::render {
namespace {

double length_of(Vec2<double> v) { return std::hypot(v.x, v.y); }

/// A face or a cut in the picture.
struct Outline {
  std::vector<Vec2<double>> corners;
  Vec3 on_it;  // a point that is drawn
};

std::optional<Outline> outline_of(std::span<const Vec3> polygon, const Projection& projection) {
  Outline outline{{}, point_on(polygon)};
  for (const Vec3& point : polygon) {
    const auto place = projection.place(point);
    if (!place) return std::nullopt;
    outline.corners.push_back(*place);
  }
  return outline;
}

/// The mean of a polygon's corners, and how far it is from its border; 0 where it lies outside.
struct LabelRoom {
  Vec2<double> point;
  double radius = 0.0;
};

LabelRoom room_of(std::span<const Vec2<double>> corners) {
  LabelRoom room{{0, 0}, INFINITY};
  for (const Vec2<double>& p : corners) room.point = room.point + p;
  room.point = {room.point.x / static_cast<double>(corners.size()), room.point.y / static_cast<double>(corners.size())};
  double side = 0.0;  // of the first edge
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2<double> along = corners[(i + 1) % corners.size()] - corners[i];
    const double size = length_of(along), away = size > 0.0 ? cross(along, room.point - corners[i]) / size : 0.0;
    if (side == 0.0) side = away < 0.0 ? -1.0 : 1.0;
    room.radius = std::min(room.radius, std::max(0.0, side * away));
  }
  return room;
}

/// The widest room of every cell that has one.
class CellLabels {
 public:
  CellLabels(const DepthMap& depths, const LabelWish& wish) : depths_(depths), wish_(wish) {}
  void consider(Index cell, std::span<const Vec3> polygon) {
    const auto outline = outline_of(polygon, depths_.projection());
    if (!outline) return;
    const LabelRoom room = room_of(outline->corners);
    if (0.5 * std::hypot(label_width(cell, wish_), wish_.line_height) > room.radius || !depths_.shows(outline->on_it)) return;
    LabelRoom& best = rooms_[cell];
    if (room.radius > best.radius) best = room;
  }
  void add(std::vector<Label>& labels) const {
    for (const auto& [cell, room] : rooms_) labels.push_back({room.point, cell, false});
  }

 private:
  const DepthMap& depths_;
  const LabelWish& wish_;
  std::map<Index, LabelRoom> rooms_;
};

void add_cells(const SeenFaces& seen, const DepthMap& depths, const LabelWish& wish, std::vector<Label>& labels) {
  CellLabels cells(depths, wish);
  for (const ElementFace& face : seen.faces.faces) {
    const DrawnFace drawn = drawn_face(seen, face);
    if (std::ranges::none_of(drawn.corners(), [&](Vec3 p) { return cut_away(seen, p); })) cells.consider(face.element, drawn.corners());
  }
  const PlaneCuts& cuts = seen.faces.cuts;
  for (const CutPolygon& polygon : cuts.polygons)
    cells.consider(polygon.element, std::span(cuts.points).subspan(polygon.first, polygon.count));
  cells.add(labels);
}

/// A vertex needs room up to its nearest neighbour, which has a label, too.
void add_vertices(const SeenFaces& seen, const DepthMap& depths, const LabelWish& wish, std::vector<Label>& labels) {
  const Unhidden unhidden = unhidden_of(seen, depths);
  std::map<Index, double> nearest;
  const auto place = [&](Index v) { return *depths.projection().place(seen.positions[v]); };  // in view, so it has one
  for (const auto& [a, b] : unhidden.edges) {
    const double length = length_of(place(b) - place(a));
    for (const Index v : {a, b}) {
      const auto [at, added] = nearest.try_emplace(v, length);
      if (!added) at->second = std::min(at->second, length);
    }
  }
  for (const auto& [vertex, length] : nearest)
    if (label_width(vertex, wish) + 2.0 * wish.digit_width <= length) labels.push_back({place(vertex), vertex, true});
}

}  // namespace

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
      // The face beyond runs it the other way round.
      if (is_shown(a) && is_shown(b) && a < b) unhidden.edges.push_back({a, b});
    }
  }
  std::sort(unhidden.edges.begin(), unhidden.edges.end());
  unhidden.edges.erase(std::unique(unhidden.edges.begin(), unhidden.edges.end()), unhidden.edges.end());
  for (Index v = 0; v < known.size(); ++v)
    if (known[v] == Shown) unhidden.vertices.push_back(v);
  return unhidden;
}

std::vector<Label> labels_of(const SeenFaces& seen, const DepthMap& depths, const LabelWish& wish) {
  std::vector<Label> labels;
  if (wish.elements) add_cells(seen, depths, wish, labels);
  if (wish.vertices) add_vertices(seen, depths, wish, labels);
  if (labels.size() > wish.most) return {};
  // Faces that are seen obliquely bring what is written in them near their corners.
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
