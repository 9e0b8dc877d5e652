#pragma once
// A scalar that carries its derivatives by the two coordinates of a point: with it the formulas give the exact gradient of every metric.

#include <cmath>

#include "core/base/vec.h"
#include "core/quality/scalar.h"

namespace dmoscope {

/// Comparisons are those of the values. Where a formula has a kink (the lesser of two angles) the derivatives are those of the branch that
/// it takes.
struct Dual {
  double value = 0.0, dx = 0.0, dy = 0.0;

  constexpr Dual() = default;
  constexpr explicit Dual(double v) : value(v) {}
  constexpr Dual(double v, double by_x, double by_y) : value(v), dx(by_x), dy(by_y) {}

  /// f(value), where f has the slope `slope`.
  [[nodiscard]] constexpr Dual through(double f, double slope) const { return {f, slope * dx, slope * dy}; }

  friend constexpr Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.dx + b.dx, a.dy + b.dy}; }
  friend constexpr Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.dx - b.dx, a.dy - b.dy}; }
  friend constexpr Dual operator*(Dual a, Dual b) {
    return {a.value * b.value, a.dx * b.value + a.value * b.dx, a.dy * b.value + a.value * b.dy};
  }
  friend constexpr Dual operator/(Dual a, Dual b) {
    const double q = a.value / b.value;
    return {q, (a.dx - q * b.dx) / b.value, (a.dy - q * b.dy) / b.value};
  }
  friend constexpr bool operator<(Dual a, Dual b) { return a.value < b.value; }
  friend constexpr bool operator>(Dual a, Dual b) { return a.value > b.value; }

  friend constexpr Dual select(bool condition, Dual yes, Dual no) { return condition ? yes : no; }
  friend constexpr Dual min(Dual a, Dual b) { return b < a ? b : a; }
  friend constexpr Dual max(Dual a, Dual b) { return a < b ? b : a; }
  friend constexpr Dual abs(Dual a) { return a.value < 0.0 ? a.through(-a.value, -1.0) : a; }
  /// At 0, where its slope is infinite, the derivatives are 0.
  friend Dual sqrt(Dual a) {
    const double root = std::sqrt(a.value);
    return a.through(root, root > 0.0 ? 0.5 / root : 0.0);
  }
  friend constexpr Dual atan2(Dual y, Dual x) {
    const double square = x.value * x.value + y.value * y.value, angle = scalar::atan2(y.value, x.value);
    if (!(square > 0.0)) return Dual(angle);
    return {angle, (x.value * y.dx - y.value * x.dx) / square, (x.value * y.dy - y.value * x.dy) / square};
  }
};

/// The point that the derivatives are by.
[[nodiscard]] constexpr Vec2<Dual> variable(Vec2<double> p) { return {{p.x, 1.0, 0.0}, {p.y, 0.0, 1.0}}; }

}  // namespace dmoscope
