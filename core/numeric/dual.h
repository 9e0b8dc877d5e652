#pragma once
// A scalar with its derivatives by the coordinates of a point: with it the formulas give the exact gradient of every metric.

#include <cmath>

#include "core/base/vec.h"
#include "core/numeric/scalar.h"

namespace dmoscope {

namespace dual {
[[nodiscard]] constexpr double times(double s, double g) { return s * g; }
[[nodiscard]] constexpr Vec2<double> times(double s, Vec2<double> g) { return {s * g.x, s * g.y}; }
[[nodiscard]] constexpr Vec3 times(double s, Vec3 g) { return {s * g.x, s * g.y, s * g.z}; }
[[nodiscard]] constexpr double over(double g, double s) { return g / s; }
[[nodiscard]] constexpr Vec2<double> over(Vec2<double> g, double s) { return {g.x / s, g.y / s}; }
[[nodiscard]] constexpr Vec3 over(Vec3 g, double s) { return {g.x / s, g.y / s, g.z / s}; }
}  // namespace dual

/// A value with its gradient. Gradient: Vec2<double> or Vec3, like the point; double on a line. Comparisons are those of the values. At a
/// kink of a formula (the lesser of two angles) the derivatives are those of the branch that it takes.
template <class Gradient>
struct DualOf {
  double value = 0.0;
  Gradient by{};

  constexpr DualOf() = default;
  constexpr explicit DualOf(double v) : value(v) {}
  constexpr DualOf(double v, Gradient g) : value(v), by(g) {}

  /// Applies a function with the value `f` and the slope `slope` here.
  [[nodiscard]] constexpr DualOf through(double f, double slope) const { return {f, dual::times(slope, by)}; }

  friend constexpr DualOf operator+(DualOf a, DualOf b) { return {a.value + b.value, a.by + b.by}; }
  friend constexpr DualOf operator-(DualOf a, DualOf b) { return {a.value - b.value, a.by - b.by}; }
  friend constexpr DualOf operator*(DualOf a, DualOf b) {
    return {a.value * b.value, dual::times(b.value, a.by) + dual::times(a.value, b.by)};
  }
  friend constexpr DualOf operator/(DualOf a, DualOf b) {
    const double q = a.value / b.value;
    return {q, dual::over(a.by - dual::times(q, b.by), b.value)};
  }
  friend constexpr bool operator<(DualOf a, DualOf b) { return a.value < b.value; }
  friend constexpr bool operator>(DualOf a, DualOf b) { return a.value > b.value; }
  friend constexpr bool operator<=(DualOf a, DualOf b) { return a.value <= b.value; }
  friend constexpr bool operator==(DualOf a, DualOf b) { return a.value == b.value; }

  friend constexpr DualOf select(bool condition, DualOf yes, DualOf no) { return condition ? yes : no; }
  friend constexpr DualOf min(DualOf a, DualOf b) { return b < a ? b : a; }
  friend constexpr DualOf max(DualOf a, DualOf b) { return a < b ? b : a; }
  friend constexpr DualOf abs(DualOf a) { return a.value < 0.0 ? a.through(-a.value, -1.0) : a; }
  /// Square root; at 0, where its slope is infinite, the derivatives are 0.
  friend DualOf sqrt(DualOf a) {
    const double root = std::sqrt(a.value);
    return a.through(root, root > 0.0 ? 0.5 / root : 0.0);
  }
  /// Cube root; at 0, where its slope is infinite, the derivatives are 0.
  friend constexpr DualOf cube_root(DualOf a) {
    const double root = scalar::cube_root(a.value), square = root * root;
    return a.through(root, square > 0.0 ? 1.0 / (3.0 * square) : 0.0);
  }
  friend constexpr DualOf atan2(DualOf y, DualOf x) {
    const double square = x.value * x.value + y.value * y.value, angle = scalar::atan2(y.value, x.value);
    if (!(square > 0.0)) return DualOf(angle);
    return {angle, dual::over(dual::times(x.value, y.by) - dual::times(y.value, x.by), square)};
  }
};

using Dual = DualOf<Vec2<double>>;  // derivatives in a plane
using SolidDual = DualOf<Vec3>;     // derivatives in space
using LineDual = DualOf<double>;    // derivative on a line

/// The point as a variable that derivatives are taken by.
[[nodiscard]] constexpr Vec2<Dual> variable(Vec2<double> p) { return {{p.x, {1, 0}}, {p.y, {0, 1}}}; }
[[nodiscard]] constexpr Vec3Of<SolidDual> variable(Vec3 p) { return {{p.x, {1, 0, 0}}, {p.y, {0, 1, 0}}, {p.z, {0, 0, 1}}}; }

}  // namespace dmoscope
