#pragma once
// Pictures in memory: PNG, downsampling, comparison.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace dmoscope::render {

/// sRGB colour, 0 to 255.
struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};
/// sRGB colour with straight (not premultiplied) alpha, 0 to 255.
struct Rgba {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  friend constexpr bool operator==(const Rgba&, const Rgba&) = default;
};

/// sRGB pixels, top row first, straight alpha. rgba.size() == 4 * width * height.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
  Image() = default;
  Image(int w, int h, Rgba fill = {0, 0, 0, 0});
  [[nodiscard]] Rgba at(int x, int y) const;
  void set(int x, int y, Rgba colour);
};

/// The picture as a PNG file's bytes. Throws Error.
[[nodiscard]] std::string encode_png(const Image& image);
/// Writes a PNG to a file beside `path`, then renames it. Throws OutputError.
void write_png(const std::filesystem::path& path, const Image& image);
/// Reads a PNG. Throws InputError.
[[nodiscard]] Image read_png(const std::filesystem::path& path);

/// Averages blocks of n x n pixels, in linear light and weighted by alpha, so that edges get neither dark nor bright fringes.
/// width and height must be multiples of n.
[[nodiscard]] Image downsample(const Image& image, int n);
/// Draws `top` over `bottom` with its left upper corner at (x, y); parts that do not fit are cut off.
void blend_over(Image& bottom, const Image& top, int x, int y);

}  // namespace dmoscope::render
