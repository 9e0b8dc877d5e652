#pragma once
// Values that elements are coloured by instead of their quality, and the choice of those that count.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "render/image.h"

namespace dmoscope::render {

/// Values to colour by. Inverted elements keep their own colour whatever the others are coloured by.
struct Shading {
  enum class By {
    Elements,  // one value per element
    Vertices   // one per vertex; each part of an element has the colour of the corner that is nearest
  };
  By by = By::Elements;
  std::vector<float> values;  // NaN: not defined. With a palette: index of a category, or -1 for none
  bool edges = false;         // boundary edges between two vertices of one category have its colour, too
  std::vector<Rgb> palette;   // colours of categories, at most 256; empty: values go through Style::colours
};

/// Choice of the elements that count. The default: all.
struct Selection {
  enum class Others { Fade, Hide, Outline };
  std::optional<std::pair<float, float>> quality;            // from, to; inverted elements count when `from` is 0 or less
  std::shared_ptr<const std::vector<std::uint8_t>> members;  // one per element, 0: does not count; null: all do
  std::shared_ptr<const std::vector<std::uint8_t>> tinted;   // one per element, 1: drawn with Style::tint over its colour; null: none
  Others others = Others::Fade;                              // how the others are drawn; hidden ones are not picked, either
  [[nodiscard]] bool all() const noexcept { return !quality && !members; }
  friend bool operator==(const Selection&, const Selection&) = default;
};

/// Whether an element of this shade (see shade_of) is within the range.
[[nodiscard]] constexpr bool in_quality_range(std::pair<float, float> range, float shade) {
  if (shade < -1e38F) return range.first <= 0.0F;
  return shade >= range.first && shade <= range.second;
}

}  // namespace dmoscope::render
