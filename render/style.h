#pragma once
// Look of a scene.

#include "render/colour_map.h"

namespace dmoscope::render {

/// Greatest share of a colour that occlusion takes away: in corners, and in lines, two or three pixels wide, along sharp edges.
inline constexpr float kMostDarkened = 0.2F, kEdgeDarkened = 0.5F;

/// Colours, widths and choices. Widths are in pixels at scale 1; `scale` multiplies them all (HiDPI, supersampling).
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
  bool shading = false;   // lights the faces of volumes, too: their colours are then darker or lighter than their values say
  bool occlusion = true;  // volumes darker in corners, by kMostDarkened at most, and lines along sharp edges
  bool vertices = false;  // dots for free (round) and fixed (square) vertices, once there is space for them
  Rgba free_colour{0xff, 0xff, 0xff, 255};
  Rgba fixed_colour{0xff, 0xb0, 0x3a, 255};
  Rgba vertex_casing_colour{0x10, 0x12, 0x16, 230};
  Rgba highlight_colour{0xff, 0xff, 0xff, 255};  // outlines, dots and the ring; drawn on a casing of the opposite lightness
  Rgba casing_colour{0x10, 0x12, 0x16, 230};
  Rgba tint{0xff, 0xff, 0xff, 0};        // over the colours of tinted elements, see Selection
  Rgb neutral_colour{0x5c, 0x62, 0x6c};  // colour for no category
  Rgb faded_colour{0x2e, 0x32, 0x39};    // fill of elements that do not count
  Rgb hollow_colour{0x5c, 0x62, 0x6c};   // outline of elements that do not count, when only the outline is drawn
  float scale = 1.0F;
  friend bool operator==(const Style&, const Style&) = default;
  [[nodiscard]] static Style dark();
  [[nodiscard]] static Style light();
};

}  // namespace dmoscope::render
