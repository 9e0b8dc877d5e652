#include "render/labels.h"

#include <cmath>
#include <memory>
#include <string>

#include "render/text.h"

namespace dmoscope::render {
namespace {

constexpr float kText = 12.0F;  // pixels at scale 1

void blend(Image& image, int x, int y, Rgb colour, double cover) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
  const Rgba under = image.at(x, y);
  const double alpha = cover + under.a / 255.0 * (1.0 - cover);
  const auto mix = [&](std::uint8_t above, std::uint8_t below) {
    return static_cast<std::uint8_t>(std::lround((above * cover + below * (under.a / 255.0) * (1.0 - cover)) / alpha));
  };
  image.set(x, y,
            {mix(colour.r, under.r), mix(colour.g, under.g), mix(colour.b, under.b), static_cast<std::uint8_t>(std::lround(255 * alpha))});
}

}  // namespace

Vec2<double> label_digit(float scale) {
  const auto size = static_cast<double>(kText * scale);
  return {0.64 * size, 1.25 * size};
}

double label_width(Index id, const LabelWish& wish) { return static_cast<double>(std::to_string(id).size()) * wish.digit_width; }

void draw_labels(Image& image, std::span<const Label> labels, Vec2<double> viewport, const Style& style, float scale) {
  const std::unique_ptr<Font> font = Font::load();
  if (!font || labels.empty()) return;
  const Rgba paper = style.casing_colour, ink = style.highlight_colour;
  const float size = kText * scale;
  for (const Label& label : labels) {
    const std::string text = std::to_string(label.id);
    const int width = font->width(text, size), pad = static_cast<int>(std::lround(2.0F * scale));
    const int height = static_cast<int>(std::lround(0.74F * size));  // height of a digit
    const Vec2<double> at{0.5 * viewport.x + label.point.x, 0.5 * viewport.y - label.point.y};
    const int left = static_cast<int>(std::lround(at.x)) - width / 2, top = static_cast<int>(std::lround(at.y)) - height / 2;
    // Labels of vertices are dark on light, those of elements light on dark.
    const Rgba plate = label.vertex ? ink : paper, letters = label.vertex ? paper : ink;
    for (int y = top - pad; y < top + height + pad; ++y) {
      for (int x = left - pad; x < left + width + pad; ++x) blend(image, x, y, {plate.r, plate.g, plate.b}, 0.88);
    }
    font->draw(image, left, top + height, text, size, {letters.r, letters.g, letters.b, 255});
  }
}

}  // namespace dmoscope::render
