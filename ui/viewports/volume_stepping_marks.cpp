#include "ui/viewports/volume_stepping_marks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ui/toolkit/screen_occupancy.h"
#include "ui/viewports/stepping_marks.h"

namespace dmoscope::ui {
namespace {

using render::Rgba;
using render::SpaceLine;

/// Lines under a broader casing: all casings come first, so that none covers a line.
class CasedLines {
 public:
  CasedLines(render::SpaceMarks& marks, Rgba ink, Rgba casing, float width, float casing_width)
      : marks_(marks), ink_(ink), casing_(casing), width_(width), casing_width_(casing_width) {}
  ~CasedLines() { marks_.lines.insert(marks_.lines.end(), inner_.begin(), inner_.end()); }
  CasedLines(const CasedLines&) = delete;
  CasedLines& operator=(const CasedLines&) = delete;
  void add(Vec3 a, Vec3 b) {
    marks_.lines.push_back({a, b, casing_width_, casing_});
    inner_.push_back({a, b, width_, ink_});
  }

 private:
  render::SpaceMarks& marks_;
  Rgba ink_, casing_;
  float width_, casing_width_;
  std::vector<SpaceLine> inner_;
};

}  // namespace

double SpaceMarkView::pixels(Vec3 a, Vec3 b) const {
  const auto p = projection.place(a), q = projection.place(b);
  return p && q ? std::hypot(q->x - p->x, q->y - p->y) : 0.0;
}

double space_arrow_factor(const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to, std::span<const Index> vertices,
                          double wanted) {
  constexpr double kLong = 40.0;  // pixels at scale 1
  if (wanted > 0.0) return wanted;
  double longest = 0.0;
  for (const Index v : vertices) longest = std::max(longest, length(to[v] - from[v]));
  const double unit = view.camera.units_per_pixel(view.projection.viewport());
  return longest > 0.0 ? kLong * view.scale * unit / longest : 1.0;
}

ArrowsAdded add_space_arrows(render::SpaceMarks& marks, const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
                             std::span<const Index> vertices, double factor, Rgba ink, Rgba casing) {
  const double least = 4.0 * view.scale;
  struct One {
    double length;  // pixels
    Index vertex;
  };
  std::vector<One> ways;
  for (const Index v : vertices) {
    const double pixels = view.pixels(from[v], from[v] + factor * (to[v] - from[v]));
    if (pixels >= least) ways.push_back({pixels, v});
  }
  std::ranges::sort(ways, [](const One& a, const One& b) { return a.length != b.length ? a.length > b.length : a.vertex < b.vertex; });
  const Vec2<double> half{0.5 * view.projection.viewport().x, 0.5 * view.projection.viewport().y};
  CellsTaken taken({{-half.x, -half.y}, half}, 14.0 * view.scale);
  CasedLines lines(marks, ink, casing, 1.3F, 3.0F);
  ArrowsAdded added;
  for (const One& one : ways) {
    const Vec3 start = from[one.vertex], way = factor * (to[one.vertex] - start), tip = start + way;
    if (added.drawn == kMostMarks || !taken.take(*view.projection.place(start))) {
      ++added.left_out;
      continue;
    }
    ++added.drawn;
    lines.add(start, tip);
    // The head lies flat before the eye.
    const Vec3 back = -std::min(0.4, 7.0 * view.scale / one.length) * way, across = cross(way, view.camera.back());
    const double size = length(across);
    const Vec3 side = size > 0.0 ? 0.5 * length(back) / size * across : Vec3{};
    lines.add(tip, tip + back + side);
    lines.add(tip, tip + back - side);
  }
  return added;
}

std::size_t add_space_ghost(render::SpaceMarks& marks, const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
                            std::span<const std::array<Index, 2>> edges, Rgba ink, Rgba casing) {
  const double least = view.scale, shortest = 8.0 * view.scale;
  CasedLines lines(marks, ink, casing, 1.0F, 2.6F);
  std::size_t drawn = 0;
  for (const auto& [a, b] : edges) {
    if (view.pixels(from[a], to[a]) < least && view.pixels(from[b], to[b]) < least) continue;
    if (view.pixels(from[a], from[b]) < shortest) continue;
    lines.add(from[a], from[b]);
    ++drawn;
  }
  return drawn;
}

void add_space_dots(render::SpaceMarks& marks, std::span<const Vec3> positions, std::span<const Index> vertices,
                    std::span<const Index> unhidden, Rgba colour, float diameter) {
  for (const Index v : vertices)
    if (std::ranges::binary_search(unhidden, v)) marks.dots.push_back({positions[v], diameter, colour});
}

}  // namespace dmoscope::ui
