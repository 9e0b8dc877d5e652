#pragma once
// The inputs of a formula program that stay when vertices move, as plain data for any processor.

#include <cstddef>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/formula/program.h"

namespace dmoscope {

/// A view.
struct GivenNumbers {
  const double* fields = nullptr;  // by element, one field after the other
  std::size_t elements = 0, dimension = 2;
  double mean_measure = 1.0;  // of the mesh's elements

  /// The value of one input for an element; 0 for inputs that depend on its corners and their origin. `matrices`, `steepness`: its
  /// target's, see ElementTarget. `length`: in mesh units, of the unit of the corners.
  [[nodiscard]] DMOSCOPE_ANYWHERE double of(const FormulaInput& input, Index element, const double* matrices, double steepness,
                                            double length) const {
    using What = FormulaInput::What;
    if (input.what == What::Target) return matrices[(input.index * dimension + input.row) * dimension + input.column] * length;
    if (input.what == What::Stretch) return matrices[input.row * dimension + input.column] * length;
    if (input.what == What::MeanMeasure) return mean_measure / (dimension == 2 ? length * length : length * length * length);
    if (input.what == What::Steepness) return steepness;
    if (input.what == What::Field) return fields[input.index * elements + element];
    return 0.0;
  }
};

/// A value that falls `steepness` times as fast below 1, in any scalar.
template <class R>
[[nodiscard]] DMOSCOPE_ANYWHERE R steeper(const R& value, double steepness) {
  return steepness == 1.0 ? value : R(1.0) - (R(1.0) - value) * R(steepness);
}

/// From what a program says of an element to its metric.
[[nodiscard]] DMOSCOPE_ANYWHERE double settled_metric(double value, double steepness) {
  const double steep = steeper(value, steepness);
  return steep == steep ? steep + 0.0 : -1.0;  // else something overflowed
}

}  // namespace dmoscope
