#include "render/volume_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace dmoscope::render {
namespace {

void line(const Projection& projection, Vec3 from, Vec3 to, float width, Rgba colour, MarkPainter& painter) {
  const auto a = projection.place(from), b = projection.place(to);
  if (a && b) painter.line(*a, *b, width, colour);
}

/// What marks are drawn with: faintly where what they mark was taken away.
struct Inks {
  Inks(const Style& style, bool there) : highlight(style.highlight_colour), casing(style.casing_colour) {
    if (there) return;
    highlight.a = static_cast<std::uint8_t>(highlight.a * 3 / 8);
    casing.a = static_cast<std::uint8_t>(casing.a / 4);
  }
  Rgba highlight, casing;
};

void outline(const SeenFaces& seen, Index cell, const Projection& projection, const Style& style, const Inks& inks, MarkPainter& painter) {
  for (const bool casing : {true, false}) {
    const auto faces = static_cast<Index>(faces_of(seen.elements.kind(cell)).size());
    for (Index f = 0; f < faces; ++f) {
      const auto v = vertices_of(seen.elements, {cell, f});
      const std::size_t n = v[3] == kNoIndex ? 3 : 4;
      for (std::size_t i = 0; i < n; ++i) {
        const Index a = v[i], b = v[(i + 1) % n];
        if (a > b) continue;  // each edge belongs to two faces, which run it in opposite directions
        line(projection, drawn_corner(seen, cell, a), drawn_corner(seen, cell, b), (casing ? 4.4F : 2.0F) * style.scale,
             casing ? inks.casing : inks.highlight, painter);
      }
    }
  }
}

void ring(const SeenFaces& seen, Index cell, const Projection& projection, const Style& style, const Inks& inks, MarkPainter& painter) {
  Bounds2 box;
  for (const Index v : seen.elements.corners(cell)) {
    const auto place = projection.place(drawn_corner(seen, cell, v));
    if (!place) return;
    box.include(*place);
  }
  const double size = std::hypot(box.size().x, box.size().y);
  const float diameter = std::max(26.0F * style.scale, static_cast<float>(std::min(size, 1e5)) * 1.15F + 8.0F * style.scale);
  painter.dot(box.centre(), diameter, DotShape::Ring, inks.highlight, inks.casing);
}

/// Strokes of X, Y and Z in a box from -1 to 1.
struct Stroke {
  Vec2<double> from, to;
};
constexpr std::array<Stroke, 2> kX{{{{-0.7, 1}, {0.7, -1}}, {{-0.7, -1}, {0.7, 1}}}};
constexpr std::array<Stroke, 3> kY{{{{-0.7, 1}, {0, 0}}, {{0.7, 1}, {0, 0}}, {{0, 0}, {0, -1}}}};
constexpr std::array<Stroke, 3> kZ{{{{-0.7, 1}, {0.7, 1}}, {{0.7, 1}, {-0.7, -1}}, {{-0.7, -1}, {0.7, -1}}}};

}  // namespace

void gather_marks(const SeenFaces& seen, const Projection& projection, const Style& style, const SpaceMarks& marks, MarkPainter& painter) {
  const auto inks = [&](bool there) { return Inks(style, there || !marks.faint_where_taken_away); };
  for (const Index cell : marks.cells) {
    if (cell < seen.elements.size()) outline(seen, cell, projection, style, inks(seen.has_cell(cell)), painter);
  }
  for (const Index v : marks.vertices) {
    if (v >= seen.positions.size()) continue;
    const Inks of_vertex = inks(seen.has_vertex(v));
    if (const auto place = projection.place(seen.positions[v]))
      painter.dot(*place, 9.0F * style.scale, DotShape::Round, of_vertex.highlight, of_vertex.casing);
  }
  if (marks.worst && *marks.worst < seen.elements.size())
    ring(seen, *marks.worst, projection, style, inks(seen.has_cell(*marks.worst) && !marks.worst_behind), painter);
  for (const SpaceLine& l : marks.lines) line(projection, l.from, l.to, l.width * style.scale, l.colour, painter);
  std::vector<std::pair<double, std::size_t>> order;  // farthest first
  order.reserve(marks.dots.size());
  for (std::size_t i = 0; i < marks.dots.size(); ++i) order.emplace_back(-projection.depth(marks.dots[i].point), i);
  std::ranges::sort(order);
  for (const auto& [depth, i] : order) {
    const SpaceDot& dot = marks.dots[i];
    if (const auto place = projection.place(dot.point)) {
      painter.dot(*place, dot.diameter * style.scale, dot.shape, dot.colour, style.casing_colour);
    }
  }
}

namespace {

constexpr double kTriadLength = 34.0, kBeyondTip = 13.0;  // pixels at scale 1
constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Of an axis in the view, in pixels from the triad's middle, y up: its tip, and where its letter is.
std::pair<Vec2<double>, Vec2<double>> tip_and_letter(const OrbitCamera& camera, const Vec3& axis, double scale) {
  const Vec2<double> on_screen{dot(axis, camera.right), dot(axis, camera.up)};
  const double size = std::hypot(on_screen.x, on_screen.y), more = size > 0.15 ? kBeyondTip / size : 0.0;
  const auto at = [&](double distance) { return Vec2<double>{scale * distance * on_screen.x, scale * distance * on_screen.y}; };
  return {at(kTriadLength), at(kTriadLength + more)};
}

}  // namespace

std::array<Vec2<double>, 3> triad_letters(const OrbitCamera& camera, Vec2<double> viewport, double scale) {
  std::array<Vec2<double>, 3> places;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2<double> letter = tip_and_letter(camera, kAxes[i], scale).second;
    places[i] = {viewport.x - scale * kTriadMargin + letter.x, viewport.y - scale * kTriadMargin - letter.y};
  }
  return places;
}

void gather_triad(const OrbitCamera& camera, Vec2<double> middle, const Style& style, MarkPainter& painter) {
  constexpr double kLetter = 4.5;  // pixels at scale 1
  struct Axis {
    Rgba colour;
    std::span<const Stroke> letter;
  };
  const std::array<Axis, 3> axes{{{{0xe0, 0x56, 0x4a, 255}, kX}, {{0x4f, 0xae, 0x55, 255}, kY}, {{0x4c, 0x8d, 0xf0, 255}, kZ}}};
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](std::size_t i) { return dot(kAxes[i], camera.back()); });
  const auto scale = static_cast<double>(style.scale);
  for (const std::size_t i : order) {
    const Axis& axis = axes[i];
    const auto [tip, beyond] = tip_and_letter(camera, kAxes[i], scale);
    const Vec2<double> letter = middle + beyond;
    const auto place = [&](Vec2<double> p) { return letter + Vec2<double>{scale * kLetter * p.x, scale * kLetter * p.y}; };
    // Over a mesh of any colour.
    for (const bool casing : {true, false}) {
      const float more = casing ? 3.0F : 0.0F;
      const Rgba ink = casing ? style.casing_colour : axis.colour;
      painter.line(middle, middle + tip, (3.0F + more) * style.scale, ink);
      for (const Stroke& stroke : axis.letter) painter.line(place(stroke.from), place(stroke.to), (1.8F + more) * style.scale, ink);
    }
  }
}

}  // namespace dmoscope::render
