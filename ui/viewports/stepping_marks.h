#pragma once
// What is drawn of stepping: arrows, ghosts and dots, as marks of the scene. Plain functions of positions.

#include <array>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/colouring.h"
#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "render/camera.h"
#include "render/style.h"

namespace dmoscope::ui {

/// More dots or arrows than this would hide the mesh, and cost too much.
inline constexpr std::size_t kMostMarks = 20'000;

/// The picture that marks are made for.
struct MarkView {
  render::Camera2D camera;
  Vec2<double> viewport{};  // pixels
  double scale = 1.0;       // of the interface
  [[nodiscard]] double units(double pixels_at_scale_one) const { return pixels_at_scale_one * scale * camera.units_per_pixel; }
  [[nodiscard]] render::Bounds2 window() const { return camera.visible(viewport); }
};

/// Dots on those of `vertices` that are in view; an even sample of them where they are more than kMostMarks. Not larger than `diameter`
/// pixels at scale 1, and smaller where the elements are.
void add_dots(render::Marks& marks, const MarkView& view, const InputMesh& input, std::span<const Vec3> positions,
              std::span<const Index> vertices, render::Rgba colour, double diameter);

/// How far vertices have moved: found once, then looked up for every view.
class Displacements {
 public:
  Displacements() = default;
  /// Of as many vertices as both have.
  Displacements(const Plane& plane, std::span<const Vec3> from, std::span<const Vec3> to);

  struct One {
    Vec2<double> from, way;
  };
  /// Calls f with each, the longer ones first (to a factor of two), until it returns false.
  template <class F>
  void for_each(F f) const {
    for (const auto& bucket : by_length_)
      for (const One& one : bucket)
        if (!f(one)) return;
  }
  /// Of the longest; 0 when nothing moved.
  [[nodiscard]] double longest() const noexcept { return longest_; }

 private:
  static constexpr std::size_t kBuckets = 40;  // of lengths that are half as long as the one before's; the last holds all that are shorter
  std::array<std::vector<One>, kBuckets> by_length_;
  double longest_ = 0.0;
};

/// By how much arrows are scaled: `wanted`, or where that is 0 what makes the longest in view 28 to 56 pixels long.
[[nodiscard]] double arrow_factor(const MarkView& view, const Displacements& moved, double wanted);

/// Arrows of those in view that are four pixels long or more when scaled by `factor`, where there is room for them: a longer one has
/// none that begins near its beginning. Returns how many have none.
std::size_t add_arrows(render::Marks& marks, const MarkView& view, const Displacements& moved, double factor, render::Rgba ink,
                       render::Rgba casing);

/// The edges of `elements` as they were, where an end has moved by a pixel or more and the edge is long enough to be told apart.
void add_ghost(render::Marks& marks, const MarkView& view, const Mesh& mesh, const Plane& plane, std::span<const Vec3> from,
               std::span<const Vec3> to, std::span<const Index> elements, render::Rgba ink, render::Rgba casing);

/// Who moves next where an iteration has done so many visits: the rest of the class under way.
struct NextClass {
  Index number = 0, count = 0;      // 1 to count; 0 where nothing is free
  std::span<const Index> vertices;  // the next one first
};
[[nodiscard]] NextClass next_class(const Colouring& colouring, std::uint64_t visits);

}  // namespace dmoscope::ui
