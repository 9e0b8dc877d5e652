#include "render/legend.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "render/text.h"

namespace dmoscope::render {
namespace {

/// Sizes in pixels, all grown with the scale.
struct Measures {
  explicit Measures(float scale) : unit(scale) {}
  float unit;
  [[nodiscard]] int px(double size) const { return static_cast<int>(std::lround(size * static_cast<double>(unit))); }
  [[nodiscard]] float text() const { return 13.0F * unit; }
};

Rgba text_colour(const Style& style) {
  // On a transparent picture nobody knows what will lie below: middle grey reads on dark and on light.
  if (style.transparent) return {0x80, 0x84, 0x8c, 255};
  return to_oklab(style.background).l > 0.6 ? Rgba{0x22, 0x26, 0x2d, 255} : Rgba{0xdd, 0xe1, 0xe7, 255};
}

void fill(Image& image, int left, int top, int width, int height, Rgba colour) {
  for (int y = std::max(0, top); y < std::min(image.height, top + height); ++y) {
    for (int x = std::max(0, left); x < std::min(image.width, left + width); ++x) image.set(x, y, colour);
  }
}

Rgba opaque(Rgb c) { return {c.r, c.g, c.b, 255}; }

void draw_bar(Image& image, const Style& style, int left, int top, int width, int height) {
  ColourScale scale = style.colours;
  for (int x = 0; x < width; ++x) {
    const double t = width > 1 ? static_cast<double>(x) / (width - 1) : 0.0;
    const double quality = scale.low + t * (scale.high - scale.low);
    fill(image, left + x, top, 1, height, opaque(scale.colour(quality)));
  }
}

/// The magenta hatched square of inverted elements.
void draw_inverted_swatch(Image& image, int left, int top, int size, float unit) {
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const float period = 8.0F * unit, along = std::fmod(static_cast<float>(x + y), period);
      const bool stripe = std::abs(along - period / 2) < 0.18F * period;
      const Rgb c = kInvertedColour;
      const auto dim = [&](std::uint8_t v) { return stripe ? static_cast<std::uint8_t>(v * 35 / 100) : v; };
      if (left + x < image.width && top + y < image.height) image.set(left + x, top + y, {dim(c.r), dim(c.g), dim(c.b), 255});
    }
  }
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int wanted) {
  std::vector<double> ticks;
  const double span = high - low;
  if (!(span > 0.0) || !std::isfinite(span) || wanted < 1) return ticks;
  const double rough = span / wanted, power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double multiple : {1.0, 2.0, 2.5, 5.0}) {
    if (multiple * power >= rough * (1.0 - 1e-9)) {
      step = multiple * power;
      break;
    }
  }
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * span; ++i) ticks.push_back(i == 0.0 ? 0.0 : i * step);
  return ticks;
}

int legend_height(float scale) { return Measures(scale).px(58); }

std::string draw_legend(Image& image, const Legend& legend, const Style& style, float scale) {
  const Measures m(scale);
  const std::unique_ptr<Font> font = Font::load();
  const Rgba colour = text_colour(style);
  const int margin = m.px(16), top = image.height - legend_height(scale);
  const int bar_width = std::clamp(image.width * 2 / 5, m.px(80), m.px(420)), bar_height = m.px(12);
  const int left = margin, bar_top = top + m.px(24);
  draw_bar(image, style, left, bar_top, std::min(bar_width, image.width - 2 * margin), bar_height);
  int swatch_left = left + bar_width + m.px(20);
  if (legend.inverted > 0) draw_inverted_swatch(image, swatch_left, bar_top, bar_height, m.unit);
  if (!font) return "the picture has no text: the font DejaVu Sans is not installed (package fonts-dejavu-core)";
  font->draw(image, left, bar_top - m.px(7), legend.title, m.text(), colour);
  const int title_end = left + font->width(legend.title, m.text()) + m.px(18);
  const int subtitle_width = font->width(legend.subtitle, m.text());
  const int subtitle_left = std::max(title_end, image.width - margin - subtitle_width);
  font->draw(image, subtitle_left, bar_top - m.px(7), legend.subtitle, m.text(), colour);
  const ColourScale& scale_of = style.colours;
  for (const double tick : round_ticks(scale_of.low, scale_of.high, 5)) {
    const int x = left + static_cast<int>(std::lround((tick - scale_of.low) / (scale_of.high - scale_of.low) * (bar_width - 1)));
    fill(image, x, bar_top + bar_height, std::max(1, m.px(1)), m.px(4), colour);
    const std::string label = fmt::format("{:.6g}", tick);
    const int width = font->width(label, 0.92F * m.text());
    font->draw(image, std::max(m.px(2), x - width / 2), bar_top + bar_height + m.px(16), label, 0.92F * m.text(), colour);
  }
  if (legend.inverted > 0) {
    const std::string text = fmt::format("{} inverted", legend.inverted);
    font->draw(image, swatch_left + bar_height + m.px(6), bar_top + bar_height - m.px(1), text, m.text(), colour);
    swatch_left += bar_height + m.px(6) + font->width(text, m.text()) + m.px(18);
  }
  if (legend.undefined) {
    fill(image, swatch_left, bar_top, bar_height, bar_height, opaque(kUndefinedColour));
    font->draw(image, swatch_left + bar_height + m.px(6), bar_top + bar_height - m.px(1), "not defined", m.text(), colour);
  }
  return {};
}

}  // namespace dmoscope::render
