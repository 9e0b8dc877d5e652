// Colours of things without an order.
#include <array>

#include "ui/analysis/element_colours.h"

namespace dmoscope::ui {

render::Rgb category_colour(std::size_t k) {
  static constexpr std::array<render::Rgb, 8> kColours{{{0x00, 0x72, 0xb2},
                                                        {0xe6, 0x9f, 0x00},
                                                        {0x00, 0x9e, 0x73},
                                                        {0xd5, 0x5e, 0x00},
                                                        {0x56, 0xb4, 0xe9},
                                                        {0xf0, 0xe4, 0x42},
                                                        {0xcc, 0x79, 0xa7},
                                                        {0x7f, 0x4f, 0x24}}};
  render::Rgb colour = kColours[k % kColours.size()];
  const std::size_t tier = k / kColours.size() % 3;
  const auto mix = [&](std::uint8_t value) {
    return tier == 0 ? value : static_cast<std::uint8_t>(tier == 1 ? value + (255 - value) * 55 / 100 : value * 55 / 100);
  };
  return {mix(colour.r), mix(colour.g), mix(colour.b)};
}

}  // namespace dmoscope::ui
