#include "core/smooth/line_maximum.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dmoscope {

namespace {

constexpr int kRounds = 100, kRootSteps = 80;
constexpr double kSame = 1e-15;  // relative difference of two values by rounding alone

/// Slope of the fraction times a positive number: positive where it rises.
double slope(const LineFraction& q, double t) { return q.a * q.f - q.b * q.e - q.c * t * (2.0 * q.b + q.a * t); }

/// Place where the fraction is largest, infinite where it rises (or falls) for ever. Of the slope's two roots it is the one with a positive
/// numerator.
double own_maximum(const LineFraction& q) {
  if (q.c == 0.0) return q.a > 0.0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  const double p = q.b * q.c, r = q.a * q.f - q.b * q.e, root = std::sqrt(std::max(0.0, p * p + q.a * q.c * r));
  return p >= 0.0 ? r / (p + root) : (root - p) / (q.a * q.c);
}

/// Place between low and high where both are equal, if one - other is not positive at low and not negative at high. Takes Newton's steps,
/// and halves where those lead astray.
double crossing(const LineFraction& one, const LineFraction& other, double low, double high) {
  const double p3 = one.a * other.c - other.a * one.c, p2 = one.a * other.e + one.b * other.c - other.a * one.e - other.b * one.c,
               p1 = one.a * other.f + one.b * other.e - other.a * one.f - other.b * one.e, p0 = one.b * other.f - other.b * one.f;
  double t = low + 0.5 * (high - low);
  for (int i = 0; i < kRootSteps; ++i) {
    const double value = ((p3 * t + p2) * t + p1) * t + p0;
    if (value == 0.0) break;
    (value < 0.0 ? low : high) = t;
    const double rise = (3.0 * p3 * t + 2.0 * p2) * t + p1;
    double next = t - value / rise;
    if (!(next > low && next < high)) next = low + 0.5 * (high - low);
    const double before = t;
    t = next;
    if (std::abs(t - before) <= 2e-16 * std::abs(t)) break;
  }
  return t;
}

/// Search to the right of 0, where the least fraction rises.
class Climb {
 public:
  Climb(std::span<const LineFraction> fractions, double sign) : fractions_(fractions), sign_(sign) {}

  [[nodiscard]] double top(double high) const {
    double left = 0.0, right = high, best = 0.0;
    LineFraction rising = lowest(0.0);
    std::optional<LineFraction> falling;
    double best_value = rising.value(0.0);
    for (int round = 0; round < kRounds && left < right; ++round) {
      const auto [t, bound] = next(rising, falling, left, right);
      const LineFraction least = lowest(t);
      const double value = least.value(t);
      if (value > best_value) best = t, best_value = value;
      if (value >= bound - kSame * std::abs(bound)) break;
      const double rise = slope(least, t);
      if (rise > 0.0) {
        if (!(t > left)) break;
        left = t, rising = least;
      } else if (rise < 0.0) {
        if (!(t < right) && falling) break;
        right = t, falling = least;
      } else {
        break;
      }
    }
    return best;
  }

  [[nodiscard]] LineFraction lowest(double t) const {
    LineFraction least = of(0);
    double value = least.value(t);
    for (std::size_t k = 1; k < fractions_.size(); ++k) {
      const LineFraction q = of(k);
      if (const double other = q.value(t); other < value) least = q, value = other;
    }
    return least;
  }

 private:
  struct Next {
    double t, bound;  // no t has a value above `bound`
  };

  /// Fraction as seen from the side of the search.
  [[nodiscard]] LineFraction of(std::size_t k) const {
    const LineFraction& q = fractions_[k];
    return {sign_ * q.a, q.b, q.c, sign_ * q.e, q.f};
  }

  /// Best place by two of the fractions: one rises at left, one falls at right.
  [[nodiscard]] static Next next(const LineFraction& rising, const std::optional<LineFraction>& falling, double left, double right) {
    const double end = std::min(own_maximum(rising), right);
    if (!falling) return {end, rising.value(end)};
    const double cross = crossing(rising, *falling, left, right), other_end = own_maximum(*falling);
    if (end > left && end < cross) return {end, rising.value(end)};
    if (other_end < right && other_end > cross) return {other_end, falling->value(other_end)};
    return {cross, std::min(rising.value(cross), falling->value(cross))};
  }

  std::span<const LineFraction> fractions_;
  double sign_;
};

}  // namespace

double maximise_least(std::span<const LineFraction> fractions, double low, double high) {
  const LineFraction least = Climb(fractions, 1.0).lowest(0.0);
  const double rise = slope(least, 0.0);
  if (rise > 0.0) return Climb(fractions, 1.0).top(high);
  if (rise < 0.0) return -Climb(fractions, -1.0).top(-low);
  return 0.0;
}

}  // namespace dmoscope
