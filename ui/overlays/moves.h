#pragma once
// Marks of vertices and how far they have moved: arrows, ghosts and dots. Plain functions of positions.

#include <array>
#include <span>
#include <vector>

#include "core/mesh/colouring.h"
#include "ui/overlays/mark_view.h"

namespace dmoscope::ui {

/// Adds dots on those of `vertices` that are seen; an even sample if they are more than kMostMarks. At most `diameter` pixels at scale 1,
/// and smaller on small elements.
void add_dots(render::Marks& marks, const MarkView& view, const InputMesh& input, std::span<const Vec3> positions,
              std::span<const Index> vertices, render::Rgba colour, double diameter);

/// Adds a ring around a vertex.
void add_ring(render::Marks& marks, const MarkView& view, Vec3 position, float diameter, render::Rgba colour);

/// Displacements of vertices: found once, then looked up for every view. The positions must outlive it.
class Displacements {
 public:
  Displacements() = default;
  /// Displacements of all vertices that both have.
  Displacements(const ScenePoints& points, std::span<const Vec3> from, std::span<const Vec3> to);
  /// Displacements of some vertices.
  Displacements(const ScenePoints& points, std::span<const Vec3> from, std::span<const Vec3> to, std::span<const Index> vertices);

  struct One {
    Index vertex;
    Vec3 from, way;  // points of the scene
  };
  /// Calls f with each, the longer ones first (to a factor of two), until it returns false.
  template <class F>
  void for_each(F f) const {
    for (const auto& bucket : by_length_)
      for (const Index v : bucket)
        if (!f(One{v, points_.at(from_[v]), points_.way(to_[v], from_[v])})) return;
  }
  /// Length of the longest; 0 when nothing moved.
  [[nodiscard]] double longest() const noexcept { return longest_; }

 private:
  /// Sorts `count` displacements by length; `vertex_at(k)`: vertex of the k-th.
  template <class VertexAt>
  void sort(std::size_t count, VertexAt vertex_at);
  static constexpr std::size_t kBuckets = 40;  // buckets by length, each half as long as the one before; the last holds all shorter ones
  ScenePoints points_;
  std::span<const Vec3> from_, to_;
  std::array<std::vector<Index>, kBuckets> by_length_;
  double longest_ = 0.0;
};

/// Factor of the arrows' length: `wanted`, or if that is 0 the one that makes the longest arrow in view 40 pixels long.
[[nodiscard]] double arrow_factor(const MarkView& view, const Displacements& moved, double wanted);

/// Adds an arrow from a point of the scene along `way`; the head is up to `head` pixels long.
void add_arrow(CasedLines& lines, const MarkView& view, Vec3 from, Vec3 way, double head, float width, float casing_width);

struct ArrowsAdded {
  std::size_t drawn = 0, left_out = 0;  // left out for lack of room
};
/// Adds arrows for displacements in view that are at least four pixels long when scaled by `factor`, and for which there is room: no arrow
/// begins near the begin of a longer one.
ArrowsAdded add_arrows(render::Marks& marks, const MarkView& view, const Displacements& moved, double factor, Inks inks);

/// Adds edges at their old places, if an end has moved by at least a pixel and the edge is long enough to be told apart.
void add_ghost(render::Marks& marks, const MarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
               std::span<const EdgeEnds> edges, Inks inks);

/// Vertices that move next after so many visits of an iteration: the rest of the colour class under way.
struct NextClass {
  Index number = 0, count = 0;      // number from 1 to count; 0 if nothing is free
  std::span<const Index> vertices;  // the next one first
};
[[nodiscard]] NextClass next_class(const Colouring& colouring, std::uint64_t visits);

}  // namespace dmoscope::ui
