#pragma once
// Place on a line where the least of several fractions is largest.

#include <span>

namespace dmoscope {

/// Fraction (a t + b) / (c t^2 + e t + f), the denominator positive, c >= 0: rises to one maximum and falls from there on, wherever the
/// numerator is positive, and everywhere if the denominator is constant. A constant has a = c = e = 0.
struct LineFraction {
  double a, b, c, e, f;
  [[nodiscard]] double value(double t) const { return (a * t + b) / ((c * t + e) * t + f); }
};

/// Returns the t from [low, high], which contains 0, at which the least of the fractions is largest; among equals one near 0. All fractions
/// must rise to one maximum in [low, high] and fall from there on, none need be different from the others. Not empty.
///
/// It lies where a fraction has its own maximum or a rising and a falling one cross, a root of a cubic (Rangarajan and Lew compare all of
/// these). The least fraction at any t says on which side of t it is, and which fraction bounds it from there; the two bounds' crossing is
/// the next t. That ends after a few rounds.
[[nodiscard]] double maximise_least(std::span<const LineFraction> fractions, double low, double high);

}  // namespace dmoscope
