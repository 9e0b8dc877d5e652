#pragma once
// Marks of vertices and how far they have moved: arrows, ghosts and dots. Plain functions of positions.

#include <array>
#include <span>
#include <vector>

#include "core/mesh/colouring.h"
#include "ui/overlays/cased_lines.h"
#include "ui/overlays/mark_view.h"

namespace dmoscope::ui {

/// Dots on those of `vertices` that are seen; an even sample of them where they are more than kMostMarks. Not larger than `diameter`
/// pixels at scale 1, and smaller where the elements are.
void add_dots(render::Marks& marks, const MarkView& view, const InputMesh& input, std::span<const Vec3> positions,
              std::span<const Index> vertices, render::Rgba colour, double diameter);

/// A ring around a vertex.
void add_ring(render::Marks& marks, const MarkView& view, Vec3 position, float diameter, render::Rgba colour);

/// How far vertices have moved: found once, then looked up for every view. The positions must outlive it.
class Displacements {
 public:
  Displacements() = default;
  /// Of all vertices, as many as both have.
  Displacements(const ScenePoints& points, std::span<const Vec3> from, std::span<const Vec3> to);
  /// Of some vertices.
  Displacements(const ScenePoints& points, std::span<const Vec3> from, std::span<const Vec3> to, std::span<const Index> vertices);

  struct One {
    Index vertex;
    Vec3 from, way;  // in the scene
  };
  /// Calls f with each, the longer ones first (to a factor of two), until it returns false.
  template <class F>
  void for_each(F f) const {
    for (const auto& bucket : by_length_)
      for (const Index v : bucket)
        if (!f(One{v, points_.at(from_[v]), points_.way(to_[v], from_[v])})) return;
  }
  /// Of the longest; 0 when nothing moved.
  [[nodiscard]] double longest() const noexcept { return longest_; }

 private:
  /// `vertex_at(k)`: of `count` of them.
  template <class VertexAt>
  void sort(std::size_t count, VertexAt vertex_at);
  static constexpr std::size_t kBuckets = 40;  // of lengths that are half as long as the one before's; the last holds all that are shorter
  ScenePoints points_;
  std::span<const Vec3> from_, to_;
  std::array<std::vector<Index>, kBuckets> by_length_;
  double longest_ = 0.0;
};

/// By how much arrows are scaled: `wanted`, or where that is 0 what makes the longest that is seen 40 pixels long.
[[nodiscard]] double arrow_factor(const MarkView& view, const Displacements& moved, double wanted);

/// From a point of the scene along `way`; the head is up to `head` pixels long.
void add_arrow(CasedLines& lines, const MarkView& view, Vec3 from, Vec3 way, double head, float width, float casing_width);

struct ArrowsAdded {
  std::size_t drawn = 0, left_out = 0;  // left out for want of room
};
/// Arrows of those in view that are four pixels long or more when scaled by `factor`, where there is room for them: a longer one has
/// none that begins near its beginning.
ArrowsAdded add_arrows(render::Marks& marks, const MarkView& view, const Displacements& moved, double factor, Inks inks);

/// Edges as they were, where an end has moved by a pixel or more and the edge is long enough to be told apart.
void add_ghost(render::Marks& marks, const MarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
               std::span<const EdgeEnds> edges, Inks inks);

/// Who moves next where an iteration has done so many visits: the rest of the class under way.
struct NextClass {
  Index number = 0, count = 0;      // 1 to count; 0 where nothing is free
  std::span<const Index> vertices;  // the next one first
};
[[nodiscard]] NextClass next_class(const Colouring& colouring, std::uint64_t visits);

}  // namespace dmoscope::ui
