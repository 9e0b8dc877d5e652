#include "render/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope::render {
namespace {

constexpr std::array kTable{
    ColourMapInfo{ColourMap::Beacon, "beacon",
                  "bright orange for bad, calm blue for good; for every kind of colour vision and any background"},
    ColourMapInfo{ColourMap::Viridis, "viridis", "purple, blue, green, yellow; for every kind of colour vision"},
    ColourMapInfo{ColourMap::Cividis, "cividis", "blue to yellow; nearly the same picture for red-green blindness"},
    ColourMapInfo{ColourMap::Magma, "magma", "black, purple, orange, cream"},
    ColourMapInfo{ColourMap::Grey, "grey", "dark to light grey, for print"},
};

// Control colours, equally spaced in the maps as their authors published them (viridis and magma: van der Walt and Smith 2015;
// cividis: Nuñez, Anderton and Renslow 2018). Their lightness rises from one to the next.
// Beacon is our own: from blue by way of green to orange, so that yellow against blue, which every eye tells apart, rises with lightness;
// neither so dark nor so light that it would sink into the background of any theme. Its low end is the last of these.
constexpr std::array kBeacon{Rgb{0x23, 0x4f, 0x9b}, Rgb{0x17, 0x6d, 0x9b}, Rgb{0x22, 0x8a, 0x8f},
                             Rgb{0x7c, 0x9e, 0x69}, Rgb{0xc7, 0xa3, 0x36}, Rgb{0xfd, 0xa5, 0x12}};
constexpr std::array kViridis{Rgb{0x44, 0x01, 0x54}, Rgb{0x48, 0x24, 0x75}, Rgb{0x41, 0x44, 0x87}, Rgb{0x35, 0x5f, 0x8d},
                              Rgb{0x2a, 0x78, 0x8e}, Rgb{0x21, 0x91, 0x8c}, Rgb{0x22, 0xa8, 0x84}, Rgb{0x44, 0xbf, 0x70},
                              Rgb{0x7a, 0xd1, 0x51}, Rgb{0xbd, 0xdf, 0x26}, Rgb{0xfd, 0xe7, 0x25}};
constexpr std::array kCividis{Rgb{0x00, 0x22, 0x4e}, Rgb{0x12, 0x35, 0x70}, Rgb{0x3b, 0x49, 0x6c}, Rgb{0x57, 0x5d, 0x6d},
                              Rgb{0x70, 0x71, 0x73}, Rgb{0x8a, 0x86, 0x78}, Rgb{0xa5, 0x9c, 0x74}, Rgb{0xc3, 0xb3, 0x69},
                              Rgb{0xe1, 0xcc, 0x55}, Rgb{0xfe, 0xe8, 0x38}};
constexpr std::array kMagma{Rgb{0x00, 0x00, 0x04}, Rgb{0x14, 0x0e, 0x36}, Rgb{0x3b, 0x0f, 0x70}, Rgb{0x64, 0x1a, 0x80},
                            Rgb{0x8c, 0x29, 0x81}, Rgb{0xb7, 0x37, 0x79}, Rgb{0xde, 0x49, 0x68}, Rgb{0xf7, 0x70, 0x5c},
                            Rgb{0xfe, 0x9f, 0x6d}, Rgb{0xfe, 0xcf, 0x92}, Rgb{0xfc, 0xfd, 0xbf}};
constexpr std::array kGrey{Rgb{0x18, 0x18, 0x18}, Rgb{0xf4, 0xf4, 0xf4}};

std::span<const Rgb> controls(ColourMap map) {
  static constexpr std::array<std::span<const Rgb>, 6> kControls{kBeacon, kViridis, kCividis, kMagma, kGrey, kViridis};  // in its order
  return kControls[static_cast<std::size_t>(map)];
}

/// Linear light of a channel of sRGB.
double decode(std::uint8_t value) {
  static const std::array<double, 256> kLinear = [] {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      table[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return table;
  }();
  return kLinear[value];
}

double encode(double linear) { return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055; }

/// Linear light of an OKLab colour (Ottosson 2020), possibly outside [0, 1].
std::array<double, 3> linear_rgb(Oklab c) {
  const auto cube = [](double v) { return v * v * v; };
  const double l = cube(c.l + 0.3963377774 * c.a + 0.2158037573 * c.b);
  const double m = cube(c.l - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.l - 0.0894841775 * c.a - 1.2914855480 * c.b);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s, -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool in_srgb(const std::array<double, 3>& rgb) {
  return std::all_of(rgb.begin(), rgb.end(), [](double v) { return v >= -1e-4 && v <= 1.0 + 1e-4; });
}

}  // namespace

std::span<const ColourMapInfo> colour_map_table() { return kTable; }

std::string_view name(ColourMap map) {
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const ColourMapInfo& info) { return info.map == map; });
  return found == kTable.end() ? "difference" : found->name;
}

ColourMap colour_map_from_name(std::string_view name) {
  for (const ColourMapInfo& info : kTable)
    if (info.name == name) return info.map;
  throw UsageError(unknown_row("colour map", name, kTable));
}

Oklab to_oklab(Rgb colour) {
  const double r = decode(colour.r), g = decode(colour.g), b = decode(colour.b);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s, 1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Rgb from_oklab(Oklab colour) {
  std::array<double, 3> rgb = linear_rgb(colour);
  if (!in_srgb(rgb)) {
    // Less chroma at the same lightness and hue, just enough.
    double inside = 0.0, outside = 1.0;
    for (int i = 0; i < 24; ++i) {
      const double chroma = (inside + outside) / 2;
      (in_srgb(linear_rgb({colour.l, colour.a * chroma, colour.b * chroma})) ? inside : outside) = chroma;
    }
    rgb = linear_rgb({colour.l, colour.a * inside, colour.b * inside});
  }
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::lround(255.0 * encode(std::clamp(v, 0.0, 1.0)))); };
  return {byte(rgb[0]), byte(rgb[1]), byte(rgb[2])};
}

namespace {

/// A map's control colours in OKLab.
std::span<const Oklab> control_path(ColourMap map) {
  static const auto kPaths = [] {
    std::array<std::vector<Oklab>, kTable.size()> paths;
    for (std::size_t i = 0; i < kTable.size(); ++i)
      for (const Rgb colour : controls(kTable[i].map)) paths[i].push_back(to_oklab(colour));
    return paths;
  }();
  const auto found = std::find_if(kTable.begin(), kTable.end(), [&](const ColourMapInfo& info) { return info.map == map; });
  return kPaths[static_cast<std::size_t>(found - kTable.begin())];
}

/// A colour between two ends that are equally light and strong, and far apart for every kind of colour vision.
Rgb sample_diverging(double t) {
  constexpr Oklab kMiddle{0.96, 0.0, 0.005}, kBelow{0.60, 0.105, 0.125}, kAbove{0.60, -0.055, -0.125};
  const Oklab& end = t < 0.5 ? kBelow : kAbove;
  const double u = std::abs(2.0 * t - 1.0);
  return from_oklab({kMiddle.l + u * (end.l - kMiddle.l), kMiddle.a + u * (end.a - kMiddle.a), kMiddle.b + u * (end.b - kMiddle.b)});
}

}  // namespace

Rgb sample(ColourMap map, double t) {
  if (map == ColourMap::OrangeBlue) return sample_diverging(std::clamp(t, 0.0, 1.0));
  const std::span<const Rgb> colours = controls(map);
  t = std::clamp(low_is_bright(map) ? 1.0 - t : t, 0.0, 1.0);
  if (t == 0.0) return colours.front();
  if (t == 1.0) return colours.back();
  const std::span<const Oklab> path = control_path(map);
  const double lightness = path.front().l + t * (path.back().l - path.front().l);
  // Hue and chroma are read where the path of the control colours has this lightness.
  std::size_t end = 1;
  while (end + 1 < path.size() && lightness > path[end].l) ++end;
  const Oklab &low = path[end - 1], &high = path[end];
  const double u = (lightness - low.l) / (high.l - low.l);
  return from_oklab({lightness, low.a + u * (high.a - low.a), low.b + u * (high.b - low.b)});
}

double ColourScale::position(double quality) const {
  if (std::isnan(quality)) return std::numeric_limits<double>::quiet_NaN();
  double t = high > low ? std::clamp((quality - low) / (high - low), 0.0, 1.0) : (quality < low ? 0.0 : 1.0);
  if (steps >= 2) t = std::min(std::floor(t * steps), steps - 1.0) / (steps - 1.0);
  return reversed ? 1.0 - t : t;
}

Rgb ColourScale::colour(double quality) const {
  const double t = position(quality);
  return std::isnan(t) ? kUndefinedColour : sample(map, t);
}

}  // namespace dmoscope::render
