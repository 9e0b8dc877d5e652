#include "render/triad.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "render/mark_painter.h"
#include "render/style.h"

namespace dmoscope::render {
namespace {

/// Strokes of X, Y and Z in a box from -1 to 1.
struct Stroke {
  Vec2<double> from, to;
};
constexpr std::array<Stroke, 2> kX{{{{-0.7, 1}, {0.7, -1}}, {{-0.7, -1}, {0.7, 1}}}};
constexpr std::array<Stroke, 3> kY{{{{-0.7, 1}, {0, 0}}, {{0.7, 1}, {0, 0}}, {{0, 0}, {0, -1}}}};
constexpr std::array<Stroke, 3> kZ{{{{-0.7, 1}, {0.7, 1}}, {{0.7, 1}, {-0.7, -1}}, {{-0.7, -1}, {0.7, -1}}}};

constexpr double kTriadLength = 34.0, kBeyondTip = 13.0;  // pixels at scale 1
constexpr double kTriadMargin = 58.0;                     // distance of the triad's middle from the right lower corner of the picture
constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Scale at which the triad leaves most of a small viewport to the mesh.
double in_proportion(double scale, Vec2<double> viewport) {
  constexpr double kRoomy = 240.0, kLeast = 0.5;  // side of a viewport, in pixels at scale 1
  return scale * std::clamp(std::min(viewport.x, viewport.y) / (scale * kRoomy), kLeast, 1.0);
}

/// Tip of an axis and the place of its letter in the view, in pixels from the triad's middle, y up.
std::pair<Vec2<double>, Vec2<double>> tip_and_letter(const OrbitCamera& camera, const Vec3& axis, double scale) {
  const Vec2<double> on_screen{dot(axis, camera.right), dot(axis, camera.up)};
  const double size = std::hypot(on_screen.x, on_screen.y), more = size > 0.15 ? kBeyondTip / size : 0.0;
  const auto at = [&](double distance) { return Vec2<double>{scale * distance * on_screen.x, scale * distance * on_screen.y}; };
  return {at(kTriadLength), at(kTriadLength + more)};
}

}  // namespace

std::array<Vec2<double>, 3> triad_letters(const OrbitCamera& camera, Vec2<double> viewport, double scale) {
  std::array<Vec2<double>, 3> places;
  scale = in_proportion(scale, viewport);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec2<double> letter = tip_and_letter(camera, kAxes[i], scale).second;
    places[i] = {viewport.x - scale * kTriadMargin + letter.x, viewport.y - scale * kTriadMargin - letter.y};
  }
  return places;
}

void gather_triad(const OrbitCamera& camera, Vec2<double> viewport, const PicturePart& part, const Style& style, MarkPainter& painter) {
  constexpr double kLetter = 4.5;  // size of a letter, in pixels at scale 1
  const double scale = in_proportion(static_cast<double>(style.scale), viewport);
  // Middle of the triad in pixels from the middle of the part, y up.
  const Vec2<double> middle{0.5 * viewport.x - kTriadMargin * scale - 0.5 * (part.low.x + part.high.x - viewport.x),
                            kTriadMargin * scale - 0.5 * viewport.y + 0.5 * (part.low.y + part.high.y - viewport.y)};
  struct Axis {
    Rgba colour;
    std::span<const Stroke> letter;
  };
  const std::array<Axis, 3> axes{{{{0xe0, 0x56, 0x4a, 255}, kX}, {{0x4f, 0xae, 0x55, 255}, kY}, {{0x4c, 0x8d, 0xf0, 255}, kZ}}};
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, {}, [&](std::size_t i) { return dot(kAxes[i], camera.back()); });
  for (const std::size_t i : order) {
    const Axis& axis = axes[i];
    const auto [tip, beyond] = tip_and_letter(camera, kAxes[i], scale);
    const Vec2<double> letter = middle + beyond;
    const auto place = [&](Vec2<double> p) { return letter + Vec2<double>{scale * kLetter * p.x, scale * kLetter * p.y}; };
    // A casing makes the axes readable over a mesh of any colour.
    for (const bool casing : {true, false}) {
      const float more = casing ? 3.0F : 0.0F;
      const Rgba ink = casing ? style.casing_colour : axis.colour;
      painter.line(middle, middle + tip, (3.0F + more) * static_cast<float>(scale), ink);
      for (const Stroke& stroke : axis.letter)
        painter.line(place(stroke.from), place(stroke.to), (1.8F + more) * static_cast<float>(scale), ink);
    }
  }
}

}  // namespace dmoscope::render
