#pragma once
// Colours of quality: perceptually uniform, colour-blind safe maps.

#include <span>
#include <string_view>

#include "render/image.h"

namespace dmoscope::render {

/// Maps of colours. OrangeBlue is for differences, from orange (below) through white to blue, and is not among the maps of quality.
enum class ColourMap { Beacon, Viridis, Cividis, Magma, Grey, OrangeBlue };

struct ColourMapInfo {
  ColourMap map;
  std::string_view name;  // "viridis", as on the command line
  std::string_view doc;   // one line
};
/// All maps of quality, the default first.
[[nodiscard]] std::span<const ColourMapInfo> colour_map_table();
[[nodiscard]] std::string_view name(ColourMap map);
/// Map of this name. Throws UsageError that lists the names.
[[nodiscard]] ColourMap colour_map_from_name(std::string_view name);

/// Whether low values are bright; they are in maps of quality, because low qualities are sought.
[[nodiscard]] constexpr bool low_is_bright(ColourMap map) { return map == ColourMap::Beacon; }

/// Colour at t in [0, 1] (clamped). OKLab lightness rises linearly with t, or falls so where the low is bright; hue and chroma follow the
/// map's control colours. The lightness of OrangeBlue rises so up to the middle and falls as much from there.
[[nodiscard]] Rgb sample(ColourMap map, double t);

/// Colour of inverted elements, drawn with hatching: far from every colour of every map.
inline constexpr Rgb kInvertedColour{255, 0, 255};
/// Colour of elements whose quality is not defined (NaN).
inline constexpr Rgb kUndefinedColour{128, 128, 128};

/// How a quality becomes a colour; the same for elements, colour bars and plots.
struct ColourScale {
  ColourMap map = ColourMap::Viridis;
  bool reversed = false;
  int steps = 0;      // 0: continuous; n >= 2: n colours of equal width
  double low = 0.0;   // quality of the first colour; below it: the first colour
  double high = 1.0;  // quality of the last colour; above it: the last colour
  friend bool operator==(const ColourScale&, const ColourScale&) = default;
  /// Position in the map, [0, 1], of a quality: clamped, reversed and stepped. NaN gives NaN.
  [[nodiscard]] double position(double quality) const;
  /// Colour of a quality; NaN gives kUndefinedColour. The caller colours inverted elements (kInvertedColour).
  [[nodiscard]] Rgb colour(double quality) const;
};

/// sRGB to OKLab (L in [0, 1]) and back; the way back moves colours outside sRGB to its border.
struct Oklab {
  double l = 0, a = 0, b = 0;
};
[[nodiscard]] Oklab to_oklab(Rgb colour);
[[nodiscard]] Rgb from_oklab(Oklab colour);

}  // namespace dmoscope::render
