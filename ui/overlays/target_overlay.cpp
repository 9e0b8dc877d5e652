#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/error.h"
#include "core/inspect/target_shape.h"
#include "ui/overlays/overlay.h"

namespace dmoscope::ui {
namespace {

constexpr std::size_t kMostEllipses = 200;  // more would hide the mesh
constexpr double kLongAxis = 1.05;          // least ratio of axes for which an axis is drawn
// Colours that can be seen on any colour, unlike the outlines of the pick.
constexpr render::Rgba kInk{255, 255, 255, 255}, kTargetCasing{20, 20, 20, 255};

/// Image of the circle (or sphere) in an ideal element of unit edges, scaled to fill its element.
class Ellipsoid {
 public:
  Ellipsoid(const SmallMatrix& map, Vec3 centre) : count_(static_cast<std::size_t>(map.n)), centre_(centre) {
    constexpr double kRadius = 0.28;
    const Eigen e = eigen(map * transposed(map));
    for (std::size_t i = 0; i < count_; ++i) {
      const double half = kRadius * std::sqrt(std::max(e.values[i], 0.0));
      axes_[i] = {half * e.vectors.at[0][i], half * e.vectors.at[1][i], half * e.vectors.at[2][i]};
    }
  }
  /// Adds the ellipse, or the three around the axes of the ellipsoid.
  void draw(std::vector<render::OverlayLine>& lines, float width, render::Rgba colour) const {
    constexpr int kParts = 48;
    for (std::size_t k = 0; k < (count_ == 3 ? 3 : 1); ++k) {
      const auto at = [&](int i) {
        const double angle = 2.0 * std::numbers::pi * i / kParts;
        return centre_ + std::cos(angle) * axes_[k] + std::sin(angle) * axes_[(k + 1) % count_];
      };
      for (int i = 0; i < kParts; ++i) lines.push_back({at(i), at(i + 1), width, colour});
    }
  }
  void draw_longest_axis(std::vector<render::OverlayLine>& lines, float width, render::Rgba colour) const {
    const Vec3 axis = *std::ranges::max_element(axes_, {}, [](Vec3 a) { return dot(a, a); });
    lines.push_back({centre_ - axis, centre_ + axis, width, colour});
  }

 private:
  std::size_t count_;
  std::array<Vec3, 3> axes_{};
  Vec3 centre_;
};

/// Target of an element; none if there is none, or if the metric belongs to another mesh.
std::optional<TargetShapeOfElement> shape_of(const Frame& frame, Metric metric, Index element) {
  try {
    return target_shape(*frame.input, frame.positions, metric, element);
  } catch (const Error&) {
    return std::nullopt;
  }
}

class TargetOverlay final : public Overlay {
 public:
  /// Not around a vertex of a volume, because the ellipsoids of a star would hide one another.
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    return !in.searching &&
           (in.picked().kind == Picked::Kind::Element || (in.picked().kind == Picked::Kind::Vertex && !in.input().in_space()));
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    add_targets(marks, view.points, in.frame(), metric_of(in), picked_elements(in));
  }

 private:
  /// The shown metric, if it has targets or no other can have them; else that of the run.
  static Metric metric_of(const OverlayInput& in) {
    const Metric shown = in.frame().shown;
    return !is_built_in(shown) || in.run() == nullptr ? shown : in.session.runs[in.session.active].parameters.metric;
  }
};

}  // namespace

void add_targets(render::Marks& marks, const ScenePoints& points, const Frame& frame, Metric metric, std::span<const Index> elements) {
  const InputMesh& input = *frame.input;
  if (input.geometry.shape == Shape::Surface || frame.positions.empty() || elements.size() > kMostEllipses) return;
  std::vector<render::OverlayLine> inked;
  for (const Index element : elements) {
    const std::optional<TargetShapeOfElement> shape = shape_of(frame, metric, element);
    if (!shape) continue;
    const auto corners = input.mesh.elements.corners(element);
    Vec3 centre{};
    for (const Index v : corners)
      centre = centre + (1.0 / static_cast<double>(corners.size())) * points.at(frame.positions[v], frame.positions[corners[0]]);
    const double size = std::pow(determinant(shape->now) / determinant(shape->wished), 1.0 / shape->now.n);
    const Ellipsoid wished(scaled(size, shape->wished), centre), now(shape->now, centre);
    now.draw(marks.lines, 1.0F, kTargetCasing);
    wished.draw(marks.lines, 3.4F, kTargetCasing);
    wished.draw(inked, 1.6F, kInk);
    if (TargetShapeOfElement::aspect(shape->wished) > kLongAxis) wished.draw_longest_axis(inked, 1.0F, kInk);
  }
  marks.lines.insert(marks.lines.end(), inked.begin(), inked.end());
}

OverlayPointer target_overlay() { return std::make_unique<TargetOverlay>(); }

}  // namespace dmoscope::ui
