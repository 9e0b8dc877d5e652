#pragma once
// The angle of a point, by operations that every processor rounds alike: the libraries' own functions differ in the last bits.

#include "core/base/anywhere.h"

namespace dmoscope::scalar {

/// As std::atan2, within three units in the last place: by the tangent of a difference to the nearest of nine known angles, and the series
/// there.
[[nodiscard]] DMOSCOPE_ANYWHERE double arc_tangent(double y, double x) {
  constexpr double kPi = 0x1.921fb54442d18p+1;
  constexpr double kKnown[] = {0x0.0p+0,  // of k / 8
                               0x1.fd5ba9aac2f6ep-4,
                               0x1.f5b75f92c80ddp-3,
                               0x1.6f61941e4def1p-2,
                               0x1.dac670561bb4fp-2,
                               0x1.1e00babdefeb4p-1,
                               0x1.4978fa3269ee1p-1,
                               0x1.700a7c5784634p-1,
                               0x1.921fb54442d18p-1};
  const double width = x < 0.0 ? -x : x, height = y < 0.0 ? -y : y;
  const bool steep = height > width;
  const double large = steep ? height : width, small = steep ? width : height;
  const double r = large == 0.0 ? 0.0 : small / large;
  const int nearest = r > 0.0 ? static_cast<int>(r * 8.0 + 0.5) : 0;  // NaN: none, and goes on as it is
  const double known = nearest * 0.125;
  const double t = (r - known) / (1.0 + r * known), square = t * t;
  double series = 1.0 / 13.0;
  for (int odd = 11; odd >= 3; odd -= 2) series = 1.0 / odd - square * series;
  double angle = kKnown[nearest] + (t - t * square * series);
  if (steep) angle = kPi / 2.0 - angle;
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

}  // namespace dmoscope::scalar
