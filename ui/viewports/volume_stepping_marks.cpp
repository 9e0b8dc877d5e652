#include "ui/viewports/volume_stepping_marks.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ui/toolkit/screen_occupancy.h"
#include "ui/viewports/cased_lines.h"
#include "ui/viewports/stepping_marks.h"

namespace dmoscope::ui {
using render::Rgba;

double SpaceMarkView::pixels(Vec3 a, Vec3 b) const {
  const auto p = projection.place(a), q = projection.place(b);
  return p && q ? std::hypot(q->x - p->x, q->y - p->y) : 0.0;
}

Vec3 SpaceMarkView::across(Vec3 way, Vec3 back) const {
  const Vec3 across = cross(way, camera.back());
  const double size = length(across);
  return size > 0.0 ? 0.5 * length(back) / size * across : Vec3{};
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
  CasedLines lines(marks, ink, casing);
  ArrowsAdded added;
  for (const One& one : ways) {
    const Vec3 start = from[one.vertex], way = factor * (to[one.vertex] - start), tip = start + way;
    if (added.drawn == kMostMarks || !taken.take(*view.projection.place(start))) {
      ++added.left_out;
      continue;
    }
    ++added.drawn;
    const Vec3 back = -std::min(0.4, 7.0 * view.scale / one.length) * way;
    lines.add_arrow(start, tip, back, view.across(way, back), 1.3F, 3.0F);
  }
  return added;
}

std::size_t add_space_ghost(render::SpaceMarks& marks, const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
                            std::span<const std::array<Index, 2>> edges, Rgba ink, Rgba casing) {
  const double least = view.scale, shortest = 8.0 * view.scale;
  CasedLines lines(marks, ink, casing);
  std::size_t drawn = 0;
  for (const auto& [a, b] : edges) {
    if (view.pixels(from[a], to[a]) < least && view.pixels(from[b], to[b]) < least) continue;
    if (view.pixels(from[a], from[b]) < shortest) continue;
    lines.add(from[a], from[b], 1.0F, 2.6F);
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
