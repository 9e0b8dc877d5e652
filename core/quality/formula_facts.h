#pragma once
// Values of a formula on elements of all shapes, and whether it has the properties that a metric must have: higher is better, 1 at most, 0
// or less where an element is inverted.

#include <string>
#include <vector>

#include "core/formula/formula.h"

namespace dmoscope {

struct FormulaFacts {
  struct OfKind {
    ElementKind kind = ElementKind::Triangle;
    double ideal = 0.0;              // of the ideal element
    double least = 0.0;              // of all sampled elements
    double greatest = 0.0;           // of all sampled elements
    double greatest_inverted = 0.0;  // of those that are inverted
    bool overflows = false;          // some have no value
  };
  std::vector<OfKind> kinds{};
  double least = 0.0, greatest = 0.0;
  /// Properties of a metric that it lacks, one sentence each.
  std::vector<std::string> warnings{};
  /// "scale-free; 1 for the ideal triangle; from -1 to 1".
  std::string summary{};
};

/// Facts from a few thousand elements of each kind, always the same ones: ideal, stretched, flat, inverted. Fields are taken as 1.
[[nodiscard]] FormulaFacts facts_of(const Formula& formula);

/// The formula's value for an element that is `ratio` times as long as the ideal one against its width, and as large.
[[nodiscard]] double value_of_stretched(const Formula& formula, ElementKind kind, double ratio);

}  // namespace dmoscope
