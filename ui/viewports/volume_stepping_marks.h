#pragma once
// What is drawn of stepping over a volume mesh: arrows, ghosts and dots of what nothing hides. Plain functions of positions.

#include <span>

#include "render/volume_scene.h"

namespace dmoscope::ui {

/// The picture that marks are made for.
struct SpaceMarkView {
  render::OrbitCamera camera;
  render::Projection projection;
  double scale = 1.0;  // of the interface
  /// Pixels between the places of two points; 0 where one is behind the eye.
  [[nodiscard]] double pixels(Vec3 a, Vec3 b) const;
  /// From the middle of an arrow's head to one of its ends: it lies flat before the eye, and is as broad as `back` is long.
  [[nodiscard]] Vec3 across(Vec3 way, Vec3 back) const;
};

/// By how much arrows are scaled: `wanted`, or where that is 0 what makes the longest of `vertices` 40 pixels long, seen from the side.
[[nodiscard]] double space_arrow_factor(const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
                                        std::span<const Index> vertices, double wanted);

struct ArrowsAdded {
  std::size_t drawn = 0, left_out = 0;  // left out for want of room
};
/// Arrows from where `vertices` were to where they are, scaled by `factor` from there, where they are four pixels long or more: the longest
/// first, and none begins near another's beginning.
ArrowsAdded add_space_arrows(render::SpaceMarks& marks, const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
                             std::span<const Index> vertices, double factor, render::Rgba ink, render::Rgba casing);

/// Edges as they were, where an end has moved by a pixel or more and the edge is long enough to be told apart. Returns how many.
std::size_t add_space_ghost(render::SpaceMarks& marks, const SpaceMarkView& view, std::span<const Vec3> from, std::span<const Vec3> to,
                            std::span<const std::array<Index, 2>> edges, render::Rgba ink, render::Rgba casing);

/// Dots on those of `vertices` that nothing hides; `unhidden` is ascending.
void add_space_dots(render::SpaceMarks& marks, std::span<const Vec3> positions, std::span<const Index> vertices,
                    std::span<const Index> unhidden, render::Rgba colour, float diameter);

}  // namespace dmoscope::ui
