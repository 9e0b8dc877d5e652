#include "app/window/drawing_picture.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/error.h"
#include "render/text.h"

namespace dmoscope::app {
namespace {

constexpr int kPixelsPerUnit = 2;
constexpr int kSupersample = 3;  // drawn that much larger and averaged, which smooths the edges
constexpr double kScale = kPixelsPerUnit * kSupersample;

using Point = Drawing::Point;

render::Rgba opaque(DrawingColour c) { return {c.r, c.g, c.b, 255}; }

Point scaled(Point p) { return {kScale * p.x, kScale * p.y}; }

double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double t = squared > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - t * dx, p.y - a.y - t * dy);
}

/// All pixels whose centre is within `reach` of the stretch from a to b.
void stroke(render::Image& image, Point a, Point b, double reach, render::Rgba colour) {
  const auto from = [reach](double u, double v) { return std::max(0, static_cast<int>(std::floor(std::min(u, v) - reach))); };
  const auto to = [reach](double u, double v, int end) { return std::min(end - 1, static_cast<int>(std::ceil(std::max(u, v) + reach))); };
  for (int y = from(a.y, b.y); y <= to(a.y, b.y, image.height); ++y) {
    for (int x = from(a.x, b.x); x <= to(a.x, b.x, image.width); ++x) {
      if (distance({x + 0.5, y + 0.5}, a, b) <= reach) image.set(x, y, colour);
    }
  }
}

void draw(render::Image& image, const Drawing::Line& line) {
  const double reach = 0.5 * kScale * line.width;
  double drawn = 0.0;  // of the line so far: where in the pattern of dashes it is
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    const Point a = scaled(line.points[i - 1]), b = scaled(line.points[i]);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double period = line.dash > 0.0 ? 2.0 * kScale * line.dash : 0.0;
    if (period == 0.0 || length == 0.0) {
      stroke(image, a, b, reach, opaque(line.colour));
      continue;
    }
    const auto at = [&](double s) { return Point{a.x + s / length * (b.x - a.x), a.y + s / length * (b.y - a.y)}; };
    for (double start = -std::fmod(drawn, period); start < length; start += period) {
      const double end = std::min(start + 0.5 * period, length);
      if (end > 0.0) stroke(image, at(std::max(start, 0.0)), at(end), reach, opaque(line.colour));
    }
    drawn += length;
  }
}

void draw(render::Image& image, const render::Font& font, const Drawing::Label& label) {
  const auto pixels = static_cast<float>(kScale * label.size);
  double x = kScale * label.at.x;
  if (label.anchor != Drawing::Anchor::Start) x -= (label.anchor == Drawing::Anchor::End ? 1.0 : 0.5) * font.width(label.text, pixels);
  font.draw(image, static_cast<int>(std::lround(x)), static_cast<int>(std::lround(kScale * label.at.y)), label.text, pixels,
            opaque(label.colour));
}

}  // namespace

render::Image picture_of(const Drawing& drawing) {
  const std::unique_ptr<render::Font> font = render::Font::load();
  if (!font) throw Error("the picture's labels need the font DejaVu Sans (package fonts-dejavu-core)");
  const auto side = [](double units) { return static_cast<int>(std::ceil(units)) * kPixelsPerUnit * kSupersample; };
  render::Image image(side(drawing.width), side(drawing.height), {255, 255, 255, 255});
  for (const Drawing::Line& line : drawing.lines) draw(image, line);
  for (const Drawing::Disc& disc : drawing.discs) {
    stroke(image, scaled(disc.centre), scaled(disc.centre), kScale * disc.radius, opaque(disc.colour));
  }
  for (const Drawing::Label& label : drawing.labels) draw(image, *font, label);
  return render::downsample(image, kSupersample);
}

}  // namespace dmoscope::app
