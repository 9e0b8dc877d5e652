#include "render/drawing_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "render/text.h"

namespace dmoscope::render {
namespace {

constexpr int kSupersample = 3;  // factor of the size drawn; averaging then smooths the edges

using Point = Drawing::Point;

Rgba opaque(DrawingColour c) { return {c.r, c.g, c.b, 255}; }

double squared_distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  const double u = p.x - a.x - t * dx, v = p.y - a.y - t * dy;
  return u * u + v * v;
}

/// Draws with lengths in units into an image of `factor` pixels a unit.
class Painter {
 public:
  Painter(Image& image, double factor) : image_(image), factor_(factor) {}

  void draw(const Drawing::Line& line) const {
    const double reach = 0.5 * factor_ * line.width;
    double drawn = 0.0;  // length of the line drawn so far: gives the place in the pattern of dashes
    for (std::size_t i = 1; i < line.points.size(); ++i) {
      const Point a = scaled(line.points[i - 1]), b = scaled(line.points[i]);
      const double length = std::hypot(b.x - a.x, b.y - a.y);
      const double period = line.dash > 0.0 ? 2.0 * factor_ * line.dash : 0.0;
      if (period == 0.0 || length == 0.0) {
        stroke(a, b, reach, opaque(line.colour));
        continue;
      }
      const auto at = [&](double s) { return Point{a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)}; };
      for (double start = -std::fmod(drawn, period); start < length; start += period) {
        const double end = std::min(start + 0.5 * period, length);
        if (end > 0.0) stroke(at(std::max(start, 0.0)), at(end), reach, opaque(line.colour));
      }
      drawn += length;
    }
  }
  void draw(const Drawing::Disc& disc) const {
    stroke(scaled(disc.centre), scaled(disc.centre), factor_ * disc.radius, opaque(disc.colour));
  }
  void draw(const Drawing::Box& box) const {
    const Point from = scaled(box.from), to = scaled(box.to);
    const auto pixel = [](double at, int end) { return std::clamp(static_cast<int>(std::lround(at)), 0, end); };
    const int left = pixel(from.x, image_.width), right = pixel(to.x, image_.width);
    const int top = pixel(from.y, image_.height), bottom = pixel(to.y, image_.height);
    if (right <= left || bottom <= top) return;
    Rgba colour = opaque(box.colour);
    colour.a = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(box.opacity, 0.0, 1.0)));
    blend_over(image_, Image(right - left, bottom - top, colour), left, top);
  }
  void draw(const Font& font, const Drawing::Label& label) const {
    const auto pixels = static_cast<float>(factor_ * label.size);
    double x = factor_ * label.at.x;
    if (label.anchor != Drawing::Anchor::Start) x -= (label.anchor == Drawing::Anchor::End ? 1.0 : 0.5) * font.width(label.text, pixels);
    font.draw(image_, static_cast<int>(std::lround(x)), static_cast<int>(std::lround(factor_ * label.at.y)), label.text, pixels,
              opaque(label.colour));
  }

 private:
  [[nodiscard]] Point scaled(Point p) const { return {factor_ * p.x, factor_ * p.y}; }

  /// Colours all pixels whose centre is within `reach` of the stretch from a to b.
  void stroke(Point a, Point b, double reach, Rgba colour) const {
    const auto from = [reach](double u, double v) { return std::max(0, static_cast<int>(std::floor(std::min(u, v) - reach))); };
    const auto to = [reach](double u, double v, int end) { return std::min(end - 1, static_cast<int>(std::ceil(std::max(u, v) + reach))); };
    const double dx = b.x - a.x, dy = b.y - a.y;
    // In a row, only pixels near the whole straight line can be near the stretch; without this, long slanted lines would cost their whole
    // box.
    const double half = dy != 0.0 ? reach * std::hypot(dx, dy) / std::abs(dy) + 1.0 : 0.0;
    const int left = from(a.x, b.x), right = to(a.x, b.x, image_.width);
    for (int y = from(a.y, b.y); y <= to(a.y, b.y, image_.height); ++y) {
      int first = left, last = right;
      if (dy != 0.0) {
        const double middle = a.x + (y + 0.5 - a.y) / dy * dx;
        first = static_cast<int>(std::clamp(std::floor(middle - half), static_cast<double>(left), static_cast<double>(right) + 1.0));
        last = static_cast<int>(std::clamp(std::ceil(middle + half), static_cast<double>(left) - 1.0, static_cast<double>(right)));
      }
      for (int x = first; x <= last; ++x) {
        if (squared_distance({x + 0.5, y + 0.5}, a, b) <= reach * reach) image_.set(x, y, colour);
      }
    }
  }

  Image& image_;
  double factor_;
};

}  // namespace

Image picture_of(const Drawing& drawing, int scale) {
  const std::unique_ptr<Font> font = Font::load();
  if (!font) throw Error("the picture's labels need the font DejaVu Sans (package fonts-dejavu-core)");
  const auto side = [scale](double units) { return static_cast<int>(std::ceil(units * scale)) * kSupersample; };
  Image image(side(drawing.width), side(drawing.height), {255, 255, 255, 255});
  const Painter painter(image, scale * kSupersample);
  for (const Drawing::Line& line : drawing.rules) painter.draw(line);
  for (const Drawing::Box& box : drawing.boxes) painter.draw(box);
  for (const Drawing::Line& line : drawing.lines) painter.draw(line);
  for (const Drawing::Disc& disc : drawing.discs) painter.draw(disc);
  for (const Drawing::Label& label : drawing.labels) painter.draw(*font, label);
  return downsample(image, kSupersample);
}

}  // namespace dmoscope::render
