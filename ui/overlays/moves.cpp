#include "ui/overlays/moves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "ui/overlays/overlay.h"
#include "ui/state/format.h"
#include "ui/toolkit/theme.h"

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

constexpr std::size_t kMostGhosts = 90'000;  // edges; more would be a grey veil

std::string_view since(Reference reference) {
  constexpr std::array<std::string_view, 5> kNames{"", "the input", "the last step", "A", "B"};  // in the order of Reference
  return kNames[static_cast<std::size_t>(reference)];
}
std::string why_not(Reference reference) {
  return reference == Reference::Previous ? "nothing has moved yet" : fmt::format("{} is not marked", since(reference));
}

class GhostOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.positions_of(in.state.stepping.ghost).has_value(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const auto seen = view.unhidden ? view.unhidden : in.scene->unhidden(in.camera, view.view.viewport());
    too_fine_ = !seen || seen->edges.size() > kMostGhosts;
    if (!too_fine_)  // the wireframe is dark in all themes
      add_ghost(marks, view, *in.positions_of(in.state.stepping.ghost), in.frame().positions, seen->edges,
                {{255, 255, 255, 255}, {16, 18, 22, 150}});
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    const Reference of = in.state.stepping.ghost;
    if (of == Reference::None) return {};
    if (!wanted(in)) return fmt::format("no ghost: {}", why_not(of));
    return too_fine_ ? std::string("ghost: zoom in to see it") : fmt::format("ghost of {}", since(of));
  }

 private:
  bool too_fine_ = false;
};

class ArrowOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.positions_of(in.state.stepping.arrows).has_value(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const auto from = *in.positions_of(in.state.stepping.arrows);
    const std::span<const Vec3> to = in.frame().positions;
    const std::tuple key{from.data(), to.data(), in.previous ? in.previous->serial : 0, in.frame().serial};
    if (moved_of_ != key) moved_ = Displacements(view.points, from, to);
    moved_of_ = key;
    factor_ = arrow_factor(view, moved_, in.state.stepping.arrow_scale);
    added_ = add_arrows(marks, view, moved_, factor_, in.inks(230));
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    const Reference of = in.state.stepping.arrows;
    if (of == Reference::None) return {};
    if (!wanted(in)) return fmt::format("no arrows: {}", why_not(of));
    if (in.state.in_space && added_.drawn == 0) {
      const bool cut = in.state.inside.clip.on && in.state.inside.clip.mode == ClipPlane::Mode::Cut;
      return fmt::format("arrows: no visible vertex has moved since {}{}", since(of),
                         cut ? "; whole cells show more of them than cut ones" : "");
    }
    return fmt::format("{}arrows × {:.3g} since {}", added_.left_out > 0 ? "longest " : "", factor_, since(of));
  }

 private:
  Displacements moved_;
  std::tuple<const Vec3*, const Vec3*, std::uint64_t, std::uint64_t> moved_of_;
  double factor_ = 1.0;  // factor of the arrows drawn last
  ArrowsAdded added_;    // counts of the arrows drawn last
};

class NextClassOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return !class_of(in).vertices.empty(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const std::span<const Index> vertices = class_of(in).vertices;
    const render::Rgba accent = in.inks(0).ink;
    add_dots(marks, view, in.input(), in.frame().positions, vertices, accent, 8.0);
    if (in.scene->sees_vertex(vertices.front())) add_ring(marks, view, in.frame().positions[vertices.front()], 20.0F, accent);
  }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    const NextClass next = class_of(in);
    return next.number == 0 ? "" : fmt::format("next: class {} of {}, {} vertices", next.number, next.count, count(next.vertices.size()));
  }

 private:
  static NextClass class_of(const OverlayInput& in) {
    const bool any = in.state.stepping.next_class && in.run() != nullptr && in.run()->colouring;
    return any ? next_class(*in.run()->colouring, in.frame().moment.visits) : NextClass{};
  }
};

Inks flash_inks(const ViewState& state) {
  const Palette& colours = palette(state.theme);
  const int level = std::clamp(state.stepping.flash_level, 0, kFlashLevels);
  return {solid(colours.text, 255 * level / kFlashLevels), solid(colours.background, 230 * level / kFlashLevels)};
}

/// Marks the only vertex that a step visited, even if something hides it: with a ring, and an arrow from its old place. Steps of several
/// vertices only tint their elements.
class FlashOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    const StepNews& news = in.state.stepping.news;
    return in.state.stepping.flash_level > 0 && news.serial == in.frame().serial && (news.moved.size() == 1 || news.vertex != kNoIndex);
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const StepNews& news = in.state.stepping.news;
    const Frame& frame = in.frame();
    const Inks inks = flash_inks(in.state);
    const Index vertex = news.moved.empty() ? news.vertex : news.moved.front();
    if (vertex >= frame.vertex_count()) return;
    add_ring(marks, view, frame.positions[vertex], 22.0F, inks.ink);
    if (!news.before || news.moved.empty()) return;
    MarkView all = view;
    all.unhidden.reset();
    const Displacements moved(view.points, news.before->positions, frame.positions, news.moved);
    add_arrows(marks, all, moved, arrow_factor(all, moved, 0.0), inks);
  }
};

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

OverlayPointer ghost_overlay() { return std::make_unique<GhostOverlay>(); }
OverlayPointer arrow_overlay() { return std::make_unique<ArrowOverlay>(); }
OverlayPointer next_class_overlay() { return std::make_unique<NextClassOverlay>(); }

OverlayPointer flash_overlay() { return std::make_unique<FlashOverlay>(); }

}  // namespace dmoscope::ui
