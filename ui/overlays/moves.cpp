#include "ui/overlays/moves.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {
namespace {

/// Distance to the other corners of the vertex's first element, a measure of the size of elements there.
double edge_at(const ScenePoints& points, const InputMesh& input, std::span<const Vec3> positions, Index vertex) {
  const auto star = input.topology.star(vertex);
  if (star.empty()) return 0.0;
  const auto corners = input.mesh.elements.corners(star.front().element);
  double sum = 0.0;
  for (const Index corner : corners) sum += length(points.way(positions[corner], positions[vertex]));
  return sum / static_cast<double>(corners.size() - 1);
}

}  // namespace

void add_dots(render::Marks& marks, const MarkView& view, const InputMesh& input, std::span<const Vec3> positions,
              std::span<const Index> vertices, render::Rgba colour, double diameter) {
  std::vector<Index> seen;
  std::ranges::copy_if(vertices, std::back_inserter(seen), [&](Index v) { return view.sees(v, positions); });
  const std::size_t stride = (seen.size() + kMostMarks - 1) / kMostMarks;
  for (std::size_t i = 0; i < seen.size(); i += stride) {
    const double room = 0.3 * edge_at(view.points, input, positions, seen[i]) / view.units(1.0);
    marks.dots.push_back({view.points.at(positions[seen[i]]), static_cast<float>(std::clamp(room, 2.0, diameter)), colour});
  }
}

void add_ring(render::Marks& marks, const MarkView& view, Vec3 position, float diameter, render::Rgba colour) {
  marks.dots.push_back({view.points.at(position), diameter, colour, render::DotShape::Ring});
}

Displacements::Displacements(const ScenePoints& points, std::span<const Vec3> from, std::span<const Vec3> to)
    : points_(points), from_(from), to_(to) {
  sort(std::min(from.size(), to.size()), [](std::size_t k) { return static_cast<Index>(k); });
}

Displacements::Displacements(const ScenePoints& points, std::span<const Vec3> from, std::span<const Vec3> to,
                             std::span<const Index> vertices)
    : points_(points), from_(from), to_(to) {
  sort(vertices.size(), [vertices](std::size_t k) { return vertices[k]; });
}

template <class VertexAt>
void Displacements::sort(std::size_t count, VertexAt vertex_at) {
  const auto square_of = [&](std::size_t k) {
    const Vec3 way = points_.way(to_[vertex_at(k)], from_[vertex_at(k)]);
    return dot(way, way);
  };
  double longest = 0.0;
  for (std::size_t k = 0; k < count; ++k) longest = std::max(longest, square_of(k));
  longest_ = std::sqrt(longest);
  if (!(longest_ > 0.0) || !std::isfinite(longest_)) return;
  for (std::size_t k = 0; k < count; ++k) {
    const double square = square_of(k);
    if (!(square > 0.0)) continue;
    const auto halvings = static_cast<std::size_t>(0.5 * std::log2(longest / square));
    by_length_[std::min(halvings, kBuckets - 1)].push_back(vertex_at(k));
  }
}

double arrow_factor(const MarkView& view, const Displacements& moved, double wanted) {
  constexpr double kLong = 40.0;  // pixels at scale 1
  if (wanted > 0.0) return wanted;
  double longest = 0.0;
  moved.for_each([&](const Displacements::One& one) {
    const double size = length(one.way);
    if (2.0 * size < longest) return false;
    if (size > longest && !view.hides(one.vertex) && view.view.holds(one.from)) longest = size;
    return true;
  });
  return longest > 0.0 ? view.units(kLong) / longest : 1.0;
}

void add_arrow(CasedLines& lines, const MarkView& view, Vec3 from, Vec3 way, double head, float width, float casing_width) {
  const Vec3 tip = from + way, back = -std::min(0.4, head / view.pixels(from, tip)) * way, side = view.view.across(way, back);
  lines.add(from, tip, width, casing_width);
  lines.add(tip, tip + back + side, width, casing_width);
  lines.add(tip, tip + back - side, width, casing_width);
}

ArrowsAdded add_arrows(render::Marks& marks, const MarkView& view, const Displacements& moved, double factor, Inks inks) {
  constexpr double kLeast = 4.0;  // pixels at scale 1
  ArrowsAdded added;
  PlacesTaken taken(view, 14.0);
  CasedLines lines(marks, inks);
  moved.for_each([&](const Displacements::One& one) {
    const Vec3 way = factor * one.way, tip = one.from + way;
    // All ways that follow are at most twice as long as this one.
    if (2.0 * view.view.most_pixels(length(way)) < kLeast * view.scale) return false;
    if (view.hides(one.vertex) || view.pixels(one.from, tip) < kLeast || !view.view.meets(one.from, tip)) return true;
    if (added.drawn == kMostMarks || !taken.take(one.from)) {
      ++added.left_out;
      return true;
    }
    ++added.drawn;
    add_arrow(lines, view, one.from, way, 7.0, 1.3F, 3.0F);
    return true;
  });
  return added;
}

void add_ghost(render::Marks& marks, const MarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
               std::span<const EdgeEnds> edges, Inks inks) {
  CasedLines lines(marks, inks);
  const auto has_moved = [&](Index v) {
    const Vec3 was = view.points.at(from[v]);
    return view.pixels(was, was + view.points.way(to[v], from[v])) >= 1.0;
  };
  for (const auto& [a, b] : edges) {
    if (!has_moved(a) && !has_moved(b)) continue;
    const Vec3 p = view.points.at(from[a]), q = view.points.at(from[b], from[a]);
    if (view.pixels(p, q) >= 8.0 && view.view.meets(p, q)) lines.add(p, q, 1.0F, 2.6F);
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
