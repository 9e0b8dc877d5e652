#pragma once

#include "core/base/host_device.h"
#include "core/base/rounding.h"

namespace dmoscope {

/// Returns coordinate + displacement, but a coordinate that does not move keeps its very bits (-0.0 + 0.0 would not). `single_precision`:
/// see Mesh. Always inlined: code for different processors shares it, and must not share one compiled copy.
[[gnu::always_inline]] DMOSCOPE_ANYWHERE double displaced(double coordinate, double displacement, bool single_precision) {
  if (displacement == 0.0) return coordinate;
  const double sum = coordinate + displacement;
  return single_precision ? nearest_float(sum) : sum;
}

/// Returns x, shifted by a period where it left [west, west + period], so that a vertex that moved across the seam stays in its file's
/// range.
[[gnu::always_inline]] DMOSCOPE_ANYWHERE double settled(double x, double west, double period, bool single_precision) {
  if (x >= west && x <= west + period) return x;
  const double moved = x < west ? x + period : x - period;
  return single_precision ? nearest_float(moved) : moved;
}

}  // namespace dmoscope
