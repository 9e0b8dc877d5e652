#pragma once
// What a formula does on elements of all shapes, and whether it keeps what metrics must: higher is better, 1 at most, 0 or less where an
// element is inverted.

#include <string>
#include <vector>

#include "core/formula/formula.h"

namespace dmoscope {

struct FormulaFacts {
  struct OfKind {
    ElementKind kind = ElementKind::Triangle;
    double ideal = 0.0;              // of the ideal element
    double least = 0.0;              // of all elements that were looked at
    double greatest = 0.0;           // likewise
    double greatest_inverted = 0.0;  // of those that are inverted
    bool overflows = false;          // some have no value
  };
  std::vector<OfKind> kinds{};
  double least = 0.0, greatest = 0.0;
  /// What it does not keep, one sentence each; none of a formula that is as metrics must be.
  std::vector<std::string> warnings{};
  /// "scale-free; 1 for the ideal triangle; from -1 to 1".
  std::string summary{};
};

/// By a few thousand elements of each kind, always the same ones: ideal, stretched, flat, inverted. Fields are taken as 1.
[[nodiscard]] FormulaFacts facts_of(const Formula& formula);

/// Of an element that is `ratio` times as long as the ideal one against its width, and as large.
[[nodiscard]] double value_of_stretched(const Formula& formula, ElementKind kind, double ratio);

}  // namespace dmoscope
