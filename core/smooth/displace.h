#pragma once

namespace dmoscope {

/// coordinate + displacement, but one that does not move keeps its very bits (-0.0 + 0.0 would not). `single_precision`: see Mesh.
/// Always inlined: code for different processors shares it, and must not share one compiled copy.
[[gnu::always_inline]] inline double displaced(double coordinate, double displacement, bool single_precision) {
  const double sum = coordinate + displacement;
  const double rounded = single_precision ? static_cast<double>(static_cast<float>(sum)) : sum;
  return displacement == 0.0 ? coordinate : rounded;
}

}  // namespace dmoscope
