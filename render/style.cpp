#include "render/style.h"

namespace dmoscope::render {

Style Style::dark() { return {}; }

Style Style::light() {
  Style style;
  style.background = {0xf6, 0xf7, 0xf9};
  style.wire_colour = {0x10, 0x12, 0x16, 170};
  style.boundary_colour = {0x22, 0x26, 0x2d, 255};
  style.free_colour = {0xff, 0xff, 0xff, 255};
  style.fixed_colour = {0xff, 0x8c, 0x1a, 255};
  style.highlight_colour = {0x00, 0x00, 0x00, 255};
  style.casing_colour = {0xff, 0xff, 0xff, 235};
  style.neutral_colour = {0xb4, 0xb9, 0xc2};
  style.faded_colour = {0xe2, 0xe5, 0xe9};
  style.hollow_colour = {0xa4, 0xaa, 0xb4};
  return style;
}

}  // namespace dmoscope::render
