#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/error.h"
#include "core/inspect/target_shape.h"
#include "render/draw_order.h"
#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {

namespace {

constexpr std::size_t kMostEllipses = 200;  // more would hide the mesh
constexpr double kLongAxis = 1.05;          // what is less long shows no axis
// Unlike the outlines of what is picked, on any colour.
constexpr render::Rgba kInk{255, 255, 255, 255}, kTargetCasing{20, 20, 20, 255};

/// Of the circle in an ideal element of unit edges, so that an ellipse fills its element.
constexpr double kRadius = 0.28;

class Ellipse {
 public:
  Ellipse(const SmallMatrix& map, Vec2<double> centre) : map_(map), centre_(centre) {}
  [[nodiscard]] Vec2<double> at(double angle) const {
    const double x = kRadius * std::cos(angle), y = kRadius * std::sin(angle);
    return {centre_.x + map_.at[0][0] * x + map_.at[0][1] * y, centre_.y + map_.at[1][0] * x + map_.at[1][1] * y};
  }
  void draw(std::vector<render::OverlayLine>& lines, float width, render::Rgba colour) const {
    constexpr int kParts = 48;
    for (int i = 0; i < kParts; ++i) lines.push_back({at(angle(i, kParts)), at(angle(i + 1, kParts)), width, colour});
  }
  void draw_longer_axis(std::vector<render::OverlayLine>& lines, float width, render::Rgba colour) const {
    constexpr int kParts = 180;
    double longest = -1.0, best = 0.0;
    for (int i = 0; i < kParts; ++i) {
      const Vec2<double> way = at(angle(i, 2 * kParts)) - centre_;
      if (dot(way, way) > longest) longest = dot(way, way), best = angle(i, 2 * kParts);
    }
    lines.push_back({at(best), at(best + std::numbers::pi), width, colour});
  }

 private:
  static double angle(int i, int of) { return 2.0 * std::numbers::pi * i / of; }
  SmallMatrix map_;
  Vec2<double> centre_;
};

/// Of the sphere in an ideal element of unit edges.
class Ellipsoid {
 public:
  Ellipsoid(const SmallMatrix& map, Vec3 centre) : centre_(centre) {
    const Eigen e = eigen(map * transposed(map));
    for (std::size_t i = 0; i < 3; ++i) {
      const double half = kRadius * std::sqrt(std::max(e.values[i], 0.0));
      axes_[i] = {half * e.vectors.at[0][i], half * e.vectors.at[1][i], half * e.vectors.at[2][i]};
    }
  }
  void draw(std::vector<render::SpaceLine>& lines, float width, render::Rgba colour) const {
    constexpr int kParts = 40;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = [&](int i) {
        const double angle = 2.0 * std::numbers::pi * i / kParts;
        return centre_ + std::cos(angle) * axes_[k] + std::sin(angle) * axes_[(k + 1) % 3];
      };
      for (int i = 0; i < kParts; ++i) lines.push_back({at(i), at(i + 1), width, colour});
    }
  }

 private:
  std::array<Vec3, 3> axes_;
  Vec3 centre_;
};

/// None where there is no target, or the metric is another mesh's.
std::optional<TargetShapeOfElement> shape_of(const Frame& frame, Metric metric, Index element) {
  try {
    return target_shape(*frame.input, frame.positions, metric, element);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

void add_targets(render::Marks& marks, const Frame& frame, Metric metric, std::span<const Index> elements) {
  const InputMesh& input = *frame.input;
  if (input.geometry.shape != Shape::Planar || frame.positions.empty() || elements.size() > kMostEllipses) return;
  std::vector<render::OverlayLine> inked;
  for (const Index element : elements) {
    const std::optional<TargetShapeOfElement> shape = shape_of(frame, metric, element);
    if (!shape) continue;
    const auto corners = input.mesh.elements.corners(element);
    Vec2<double> centre{};
    for (const Index v : corners) {
      const Vec2<double> p = render::place_near(input.geometry.plane, frame.positions[v], frame.positions[corners[0]]);
      centre = {centre.x + p.x / static_cast<double>(corners.size()), centre.y + p.y / static_cast<double>(corners.size())};
    }
    const double size = std::sqrt(determinant(shape->now) / determinant(shape->wished));
    const Ellipse wished(scaled(size, shape->wished), centre), now(shape->now, centre);
    now.draw(marks.lines, 1.0F, kTargetCasing);
    wished.draw(marks.lines, 3.4F, kTargetCasing);
    wished.draw(inked, 1.6F, kInk);
    if (TargetShapeOfElement::aspect(shape->wished) > kLongAxis) wished.draw_longer_axis(inked, 1.0F, kInk);
  }
  marks.lines.insert(marks.lines.end(), inked.begin(), inked.end());
}

void add_space_target(render::SpaceMarks& marks, const Frame& frame, Metric metric, Index element) {
  const InputMesh& input = *frame.input;
  if (!input.is_volume() || frame.positions.empty()) return;
  const std::optional<TargetShapeOfElement> shape = shape_of(frame, metric, element);
  if (!shape) return;
  const auto corners = input.mesh.elements.corners(element);
  Vec3 centre{};
  for (const Index v : corners) centre = centre + (1.0 / static_cast<double>(corners.size())) * frame.positions[v];
  const double size = std::cbrt(determinant(shape->now) / determinant(shape->wished));
  const Ellipsoid wished(scaled(size, shape->wished), centre), now(shape->now, centre);
  now.draw(marks.lines, 1.0F, kTargetCasing);
  wished.draw(marks.lines, 3.4F, kTargetCasing);
  wished.draw(marks.lines, 1.6F, kInk);
}

}  // namespace dmoscope::ui
