#include "render/legend.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "render/text.h"

namespace dmoscope::render {
namespace {

/// Sizes in pixels, multiplied by the scale.
struct Measures {
  explicit Measures(float scale) : unit(scale) {}
  float unit;
  [[nodiscard]] int px(double size) const { return static_cast<int>(std::lround(size * static_cast<double>(unit))); }
  [[nodiscard]] float text() const { return 13.0F * unit; }
};

Rgba text_colour(const Style& style) {
  // The background of a transparent picture is not known: middle grey reads on dark and on light.
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

/// Draws the magenta hatched square of inverted elements.
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

namespace {

struct BarTick {
  double value;
  std::string label;
};

/// Ticks at 1 of every power of ten, and at 2 and 5 when there are few powers.
std::vector<BarTick> powers_of_ten(double low, double high) {
  std::vector<BarTick> ticks;
  const bool few = high - low < 2.0;
  const double step = std::max(1.0, std::ceil((high - low) / 8.0));
  for (double power = std::floor(low); power <= std::ceil(high); power += step) {
    for (const double multiple : {1.0, 2.0, 5.0}) {
      const double value = power + std::log10(multiple);
      if ((multiple == 1.0 || few) && value >= low && value <= high)
        ticks.push_back({value, fmt::format("{:g}", multiple * std::pow(10.0, power))});
    }
  }
  return ticks;
}

std::vector<BarTick> bar_ticks(const Legend& legend, const ColourScale& scale) {
  if (legend.logarithmic) return powers_of_ten(scale.low, scale.high);
  std::vector<BarTick> ticks;
  for (const double value : round_ticks(scale.low, scale.high, 5)) ticks.push_back({value, fmt::format("{:.6g}", value)});
  return ticks;
}

/// Draws the parts of a legend from left to right.
class LegendPainter {
 public:
  LegendPainter(Image& image, const Style& style, float scale, const Font* font)
      : image_(image), style_(style), m_(scale), font_(font), ink_(text_colour(style)), top_(image.height - legend_height(scale)) {
    x_ = m_.px(16);
  }

  void title(const Legend& legend) {
    const int baseline = top_ + m_.px(17), margin = m_.px(16);
    text(margin, baseline, legend.title);
    const std::string right = legend.selection.empty() ? legend.subtitle : legend.subtitle + " · " + legend.selection;
    text(std::max(margin + width(legend.title) + m_.px(18), image_.width - margin - width(right)), baseline, right);
  }
  void bar(const Legend& legend) {
    const int margin = m_.px(16);
    const int size = std::min(std::clamp(image_.width * 2 / 5, m_.px(80), m_.px(420)), image_.width - 2 * margin);
    draw_bar(image_, style_, x_, row(), size, height());
    const ColourScale& scale = style_.colours;
    const float small = 0.92F * m_.text();
    const auto wide = [&](const std::string& words) { return font_ ? font_->width(words, small) : 0; };
    const auto write = [&](int left, const std::string& words) {
      if (font_) font_->draw(image_, left, row() + height() + m_.px(16), words, small, ink_);
    };
    // Both ends are always labelled; other numbers only where there is room between them.
    const auto end = [&](double value) { return fmt::format("{:.4g}", legend.logarithmic ? std::pow(10.0, value) : value); };
    const std::string low = end(scale.low), high = end(scale.high);
    const int low_ends = x_ + wide(low) + m_.px(8), high_begins = x_ + size - wide(high);
    write(x_, low);
    write(high_begins, high);
    for (const BarTick& tick : bar_ticks(legend, scale)) {
      const int x = x_ + static_cast<int>(std::lround((tick.value - scale.low) / (scale.high - scale.low) * (size - 1)));
      fill(image_, x, row() + height(), std::max(1, m_.px(1)), m_.px(4), ink_);
      const int left = x - wide(tick.label) / 2;
      if (left >= low_ends && left + wide(tick.label) + m_.px(8) <= high_begins) write(left, tick.label);
    }
    x_ += size + m_.px(20);
  }
  void inverted(std::size_t count) {
    if (count == 0) return;
    draw_inverted_swatch(image_, x_, row(), height(), m_.unit);
    beside_swatch(fmt::format("{} inverted", count));
  }
  void swatch(Rgb colour, const std::string& name) {
    fill(image_, x_, row(), height(), height(), opaque(colour));
    beside_swatch(name);
  }
  /// Draws as many categories as there is room for, and the number of the others.
  void categories(const std::vector<LegendEntry>& entries) {
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const std::string name = fmt::format("{} ({})", entries[k].name, entries[k].count);
      const bool last = k + 1 == entries.size();
      if (x_ + height() + m_.px(6) + width(name) + (last ? 0 : m_.px(90)) > image_.width) {
        plain(fmt::format("and {} more", entries.size() - k));
        return;
      }
      swatch(entries[k].colour, name);
    }
  }
  void plain(const std::string& words) {
    text(x_, row() + height() - m_.px(1), words);
    x_ += width(words) + m_.px(18);
  }

 private:
  [[nodiscard]] int row() const { return top_ + m_.px(24); }
  [[nodiscard]] int height() const { return m_.px(12); }
  [[nodiscard]] int width(const std::string& words) const { return font_ ? font_->width(words, m_.text()) : 0; }
  void text(int x, int baseline, const std::string& words) {
    if (font_) font_->draw(image_, x, baseline, words, m_.text(), ink_);
  }
  void beside_swatch(const std::string& words) {
    text(x_ + height() + m_.px(6), row() + height() - m_.px(1), words);
    x_ += height() + m_.px(6) + width(words) + m_.px(18);
  }

  Image& image_;
  const Style& style_;
  Measures m_;
  const Font* font_;
  Rgba ink_;
  int top_, x_ = 0;
};

}  // namespace

std::string draw_legend(Image& image, const Legend& legend, const Style& style, float scale) {
  const std::unique_ptr<Font> font = Font::load();
  LegendPainter painter(image, style, scale, font.get());
  painter.title(legend);
  if (legend.has_categories) {
    painter.categories(legend.categories);
  } else {
    painter.bar(legend);
  }
  for (const LegendEntry& entry : legend.beside) painter.swatch(entry.colour, fmt::format("{} {}", entry.count, entry.name));
  painter.inverted(legend.inverted);
  if (legend.undefined) painter.swatch(kUndefinedColour, "not defined");
  if (legend.below > 0) painter.plain(fmt::format("{} below", legend.below));
  if (legend.above > 0) painter.plain(fmt::format("{} above", legend.above));
  return font ? std::string{} : "the picture has no text: the font DejaVu Sans is not installed (package fonts-dejavu-core)";
}

}  // namespace dmoscope::render
