#pragma once
// The angle of a point, from operations that every processor rounds alike: library functions differ in the last bits.

#include <array>
#include <cstddef>

#include "core/base/host_device.h"

namespace dmoscope::scalar {

/// The angles whose tangents are k / 8, k from 0 to 8.
struct KnownAngles {
  static constexpr std::array kTable{0x0.0p+0,
                                     0x1.fd5ba9aac2f6ep-4,
                                     0x1.f5b75f92c80ddp-3,
                                     0x1.6f61941e4def1p-2,
                                     0x1.dac670561bb4fp-2,
                                     0x1.1e00babdefeb4p-1,
                                     0x1.4978fa3269ee1p-1,
                                     0x1.700a7c5784634p-1,
                                     0x1.921fb54442d18p-1};
};

/// The angle whose tangent is `r`, from a near one whose tangent is `known`. R: double or a pack of it. Always inlined: code for different
/// processors shares it, and must not share one compiled copy.
template <class R>
[[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE R angle_from_known(R r, R known, R known_angle) {
  const R t = (r - known) / (R(1.0) + r * known), square = t * t;
  R series(1.0 / 13.0);
  for (int odd = 11; odd >= 3; odd -= 2) series = R(1.0 / odd) - square * series;
  return known_angle + (t - t * square * series);
}

/// The function std::atan2, within three units in the last place: by the tangent of a difference to the nearest of nine known angles, and
/// the series there.
[[nodiscard]] DMOSCOPE_ANYWHERE double arc_tangent(double y, double x) {
  constexpr double kPi = 0x1.921fb54442d18p+1;
  const double width = x < 0.0 ? -x : x, height = y < 0.0 ? -y : y;
  const bool steep = height > width;
  const double large = steep ? height : width, small = steep ? width : height;
  const double r = large == 0.0 ? 0.0 : small / large;
  const int nearest = r > 0.0 ? static_cast<int>(r * 8.0 + 0.5) : 0;  // also for NaN, which passes through
  constexpr auto known_angles = KnownAngles::kTable;                  // constexpr: a GPU knows the table's content, not its address
  double angle = angle_from_known(r, nearest * 0.125, known_angles[static_cast<std::size_t>(nearest)]);
  if (steep) angle = kPi / 2.0 - angle;
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

}  // namespace dmoscope::scalar
