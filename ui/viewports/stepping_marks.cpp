#include "ui/viewports/stepping_marks.h"

#include <algorithm>
#include <cmath>

#include "render/draw_order.h"
#include "ui/toolkit/screen_occupancy.h"
#include "ui/viewports/cased_lines.h"

namespace dmoscope::ui {
namespace {

bool holds(const render::Bounds2& box, Vec2<double> p) {
  return p.x >= box.low.x && p.x <= box.high.x && p.y >= box.low.y && p.y <= box.high.y;
}

bool meets(const render::Bounds2& box, Vec2<double> a, Vec2<double> b) {
  return std::max(a.x, b.x) >= box.low.x && std::min(a.x, b.x) <= box.high.x && std::max(a.y, b.y) >= box.low.y &&
         std::min(a.y, b.y) <= box.high.y;
}

/// How far the other corners of the vertex's first element are: how large elements are here.
double edge_at(const InputMesh& input, std::span<const Vec3> positions, Index vertex) {
  const auto star = input.topology.star(vertex);
  if (star.empty()) return 0.0;
  const auto corners = input.mesh.elements.corners(star.front().element);
  double sum = 0.0;
  for (const Index corner : corners) sum += length(input.geometry.plane.difference(positions[corner], positions[vertex]));
  return sum / static_cast<double>(corners.size() - 1);
}

Vec2<double> times(double s, Vec2<double> v) { return {s * v.x, s * v.y}; }
double length_of(Vec2<double> v) { return std::hypot(v.x, v.y); }

}  // namespace

void add_dots(render::Marks& marks, const MarkView& view, const InputMesh& input, std::span<const Vec3> positions,
              std::span<const Index> vertices, render::Rgba colour, double diameter) {
  const Plane& plane = input.geometry.plane;
  const render::Bounds2 window = view.window();
  std::vector<Index> seen;
  for (const Index v : vertices)
    if (holds(window, plane.place(positions[v]))) seen.push_back(v);
  const std::size_t stride = (seen.size() + kMostMarks - 1) / kMostMarks;
  for (std::size_t i = 0; i < seen.size(); i += stride) {
    const double room = 0.3 * edge_at(input, positions, seen[i]) / view.units(1.0);
    marks.dots.push_back({plane.place(positions[seen[i]]), static_cast<float>(std::clamp(room, 2.0, diameter)), colour});
  }
}

Displacements::Displacements(const Plane& plane, std::span<const Vec3> from, std::span<const Vec3> to) {
  const std::size_t count = std::min(from.size(), to.size());
  double longest = 0.0;
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 way = plane.difference(to[v], from[v]);
    longest = std::max(longest, dot(way, way));
  }
  longest_ = std::sqrt(longest);
  if (!(longest_ > 0.0) || !std::isfinite(longest_)) return;
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3 way = plane.difference(to[v], from[v]);
    const double square = dot(way, way);
    if (!(square > 0.0)) continue;
    const auto halvings = static_cast<std::size_t>(0.5 * std::log2(longest / square));
    by_length_[std::min(halvings, kBuckets - 1)].push_back({plane.place(from[v]), plane.project(way)});
  }
}

double arrow_factor(const MarkView& view, const Displacements& moved, double wanted) {
  constexpr double kLong = 28.0;  // pixels at scale 1
  if (wanted > 0.0) return wanted;
  const render::Bounds2 window = view.window();
  double longest = 0.0;
  moved.for_each([&](const Displacements::One& one) {
    if (holds(window, one.from)) longest = length_of(one.way);
    return longest == 0.0;
  });
  return longest > 0.0 ? view.units(kLong) / longest : 1.0;
}

std::size_t add_arrows(render::Marks& marks, const MarkView& view, const Displacements& moved, double factor, render::Rgba ink,
                       render::Rgba casing) {
  const render::Bounds2 window = view.window();
  const double least = view.units(4.0);
  std::size_t drawn = 0, left_out = 0;
  CellsTaken taken(window, view.units(14.0));
  CasedLines lines(marks, ink, casing);
  moved.for_each([&](const Displacements::One& one) {
    const Vec2<double> way = times(factor, one.way);
    const double length = length_of(way);
    if (2.0 * length < least) return false;  // and all that follow are no more than twice as long as this one
    const Vec2<double> tip = one.from + way;
    if (length < least || !meets(window, one.from, tip)) return true;
    if (drawn == kMostMarks || !taken.take(one.from)) {
      ++left_out;
      return true;
    }
    ++drawn;
    const double head = std::min(0.4 * length, view.units(7.0)) / length;
    const Vec2<double> back = times(-head, way), side = times(0.5, {-back.y, back.x});
    lines.add_arrow(one.from, tip, back, side, 1.3F, 3.0F);
    return true;
  });
  return left_out;
}

void add_ghost(render::Marks& marks, const MarkView& view, const Mesh& mesh, const Plane& plane, std::span<const Vec3> from,
               std::span<const Vec3> to, std::span<const Index> elements, render::Rgba ink, render::Rgba casing) {
  const render::Bounds2 window = view.window();
  const double least = view.units(1.0), shortest = view.units(8.0);
  CasedLines lines(marks, ink, casing);
  const auto moved = [&](Index v) { return length_of(plane.offset(to[v], from[v])) >= least; };
  for (const Index e : elements) {
    const auto corners = mesh.elements.corners(e);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      // The neighbour has it the other way round; an edge without one is the boundary, which stays.
      if (a > b || !(moved(a) || moved(b))) continue;
      const Vec2<double> p = plane.place(from[a]), q = render::place_near(plane, from[b], from[a]);
      if (length_of(q - p) < shortest || !meets(window, p, q)) continue;
      lines.add(p, q, 1.0F, 2.6F);
    }
  }
}

NextClass next_class(const Colouring& colouring, std::uint64_t visits) {
  if (colouring.order.empty()) return {};
  const std::uint64_t at = visits < colouring.order.size() ? visits : 0;
  const auto end = std::upper_bound(colouring.class_offsets.begin(), colouring.class_offsets.end(), at);
  const std::span<const Index> order(colouring.order);
  return {static_cast<Index>(end - colouring.class_offsets.begin()), colouring.class_count(), order.subspan(at, *end - at)};
}

}  // namespace dmoscope::ui
