#pragma once
// How a scene looks, and what is marked in it.

#include <optional>
#include <vector>

#include "core/base/vec.h"
#include "render/colour_map.h"

namespace dmoscope::render {

/// The share of a colour that occlusion takes away at most: in corners, and of the lines, two or three pixels wide, along sharp edges.
inline constexpr float kMostDarkened = 0.2F, kEdgeDarkened = 0.5F;

/// Widths are in pixels at scale 1; `scale` multiplies them all (HiDPI, supersampling).
struct Style {
  ColourScale colours;
  Rgb background{0x1b, 0x1e, 0x23};
  bool transparent = false;  // background with alpha 0 instead
  bool wireframe = true;     // edges of elements; they fade out where elements get smaller than a few pixels
  float wire_width = 1.0F;
  Rgba wire_colour{0x10, 0x12, 0x16, 190};
  bool boundary = true;  // edges that have one element
  float boundary_width = 1.6F;
  Rgba boundary_colour{0xe6, 0xe9, 0xee, 255};
  bool shading = false;   // faces of volumes by a light, too: their colours are then darker or lighter than their values say
  bool occlusion = true;  // volumes darker in corners, by kMostDarkened at most, and lines along sharp edges
  bool vertices = false;  // dots for free (round) and fixed (square) vertices, once there is space for them
  Rgba free_colour{0xff, 0xff, 0xff, 255};
  Rgba fixed_colour{0xff, 0xb0, 0x3a, 255};
  Rgba vertex_casing_colour{0x10, 0x12, 0x16, 230};
  Rgba highlight_colour{0xff, 0xff, 0xff, 255};  // outlines, dots and the ring; drawn on a casing of the opposite lightness
  Rgba casing_colour{0x10, 0x12, 0x16, 230};
  Rgb neutral_colour{0x5c, 0x62, 0x6c};  // of no category
  Rgb faded_colour{0x2e, 0x32, 0x39};    // of elements that do not count
  Rgb hollow_colour{0x5c, 0x62, 0x6c};   // of the outlines of those, where only that is drawn
  float scale = 1.0F;
  friend bool operator==(const Style&, const Style&) = default;
  [[nodiscard]] static Style dark();
  [[nodiscard]] static Style light();
};

enum class DotShape { Round, Square, Ring, Cross, Diamond };

/// A dot at a point of the plane (a candidate of the grid).
struct OverlayDot {
  Vec2<double> point;
  float diameter = 6.0F;  // pixels
  Rgba colour{255, 255, 255, 255};
  DotShape shape = DotShape::Round;
  friend bool operator==(const OverlayDot& a, const OverlayDot& b) {
    return a.point.x == b.point.x && a.point.y == b.point.y && a.diameter == b.diameter && a.colour == b.colour && a.shape == b.shape;
  }
};
/// A straight line between two points of the plane (the box of a candidate grid, a vertex's path).
struct OverlayLine {
  Vec2<double> from, to;
  float width = 1.5F;  // pixels
  Rgba colour{255, 255, 255, 255};
  friend bool operator==(const OverlayLine& a, const OverlayLine& b) {
    return a.from.x == b.from.x && a.from.y == b.from.y && a.to.x == b.to.x && a.to.y == b.to.y && a.width == b.width &&
           a.colour == b.colour;
  }
};

/// What is marked on top of the elements, in this order.
struct Marks {
  std::vector<Index> elements;  // outlined
  std::vector<Index> vertices;  // dots
  std::optional<Index> worst;   // element with a ring around it
  std::vector<OverlayLine> lines;
  std::vector<OverlayDot> dots;
  friend bool operator==(const Marks&, const Marks&) = default;
};

}  // namespace dmoscope::render
