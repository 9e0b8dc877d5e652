#include "render/screenshot.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/error.h"
#include "render/legend.h"

namespace dmoscope::render {
namespace {

constexpr int kLargestPicture = 32768;
constexpr int kTile = 2048;  // samples; keeps a tile's memory small whatever the picture's size

Image opaque_area(const Style& style, int width, int height) {
  return Image(width, height, style.transparent ? Rgba{0, 0, 0, 0} : Rgba{style.background.r, style.background.g, style.background.b, 255});
}

/// Copies `part` to (x, y) of `whole`.
void paste(Image& whole, const Image& part, int x, int y) {
  const std::size_t row = std::size_t{4} * static_cast<std::size_t>(part.width);
  for (int j = 0; j < part.height; ++j) {
    const auto from = part.rgba.begin() + static_cast<std::ptrdiff_t>(row * static_cast<std::size_t>(j));
    const std::size_t to = 4 * (static_cast<std::size_t>(y + j) * static_cast<std::size_t>(whole.width) + static_cast<std::size_t>(x));
    std::copy(from, from + static_cast<std::ptrdiff_t>(row), whole.rgba.begin() + static_cast<std::ptrdiff_t>(to));
  }
}

}  // namespace

Vec2<double> mesh_viewport(const Shot& shot) {
  const int below = shot.legend ? legend_height(shot.scale) : 0;
  return {static_cast<double>(shot.width), static_cast<double>(std::max(1, shot.height - below))};
}

namespace {

/// Draws a picture in tiles: `draw(target, style, tile)` draws the part `tile` of the mesh's viewport, in pixels of the picture. Each of
/// these is supersample x supersample pixels of the target.
template <class Draw>
Rendered draw_tiles(const Shot& shot, const Style& style, const Draw& draw) {
  if (shot.width < 1 || shot.height < 1 || shot.width > kLargestPicture || shot.height > kLargestPicture) {
    throw UsageError(
        fmt::format("a picture is 1 to {0} pixels wide and high, asked for {1} x {2}", kLargestPicture, shot.width, shot.height));
  }
  if (shot.supersample < 1 || shot.supersample > 8) throw UsageError("supersampling takes 1 to 8 samples along each side of a pixel");
  Style fine = style;
  fine.transparent = shot.transparent;
  fine.scale *= shot.scale * static_cast<float>(shot.supersample);
  const Vec2<double> viewport = mesh_viewport(shot);
  const int width = shot.width, height = static_cast<int>(viewport.y);
  // Side of a tile in whole pixels, within OpenGL's limits.
  const int tile = std::max(1, std::min(kTile, Framebuffer::largest_size()) / shot.supersample);
  Framebuffer target(std::min(tile, width) * shot.supersample, std::min(tile, height) * shot.supersample);
  Rendered result{opaque_area(fine, shot.width, shot.height), {}};
  for (int top = 0; top < height; top += tile) {
    for (int left = 0; left < width; left += tile) {
      const int right = std::min(left + tile, width), bottom = std::min(top + tile, height);
      target.resize((right - left) * shot.supersample, (bottom - top) * shot.supersample);
      const auto at = [](int x, int y) { return Vec2<double>{static_cast<double>(x), static_cast<double>(y)}; };
      draw(target, fine, PicturePart{at(left, top), at(right, bottom)});
      paste(result.image, downsample(target.read_pixels(), shot.supersample), left, top);
    }
  }
  if (shot.legend) {
    fine.scale = style.scale * shot.scale;
    result.note = draw_legend(result.image, *shot.legend, fine, shot.scale);
  }
  return result;
}

}  // namespace

Rendered render_image(Scene& scene, const Camera& camera, const Style& style, const Marks& marks, const Shot& shot) {
  const auto fine_pixels = static_cast<double>(shot.supersample);
  const auto scaled = [&](Vec2<double> p) { return Vec2<double>{p.x * fine_pixels, p.y * fine_pixels}; };
  Camera fine = camera;  // the same for any number of pixels: an OrbitCamera is about the whole viewport
  if (auto* planar = std::get_if<Camera2D>(&fine)) planar->units_per_pixel /= fine_pixels;
  return draw_tiles(shot, style, [&](Framebuffer& target, const Style& fine_style, const PicturePart& tile) {
    scene.draw_part(target, fine, fine_style, marks, scaled(mesh_viewport(shot)), {scaled(tile.low), scaled(tile.high)});
  });
}

}  // namespace dmoscope::render
