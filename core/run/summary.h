#pragma once
// Summary of all elements for a person. The rules of counting are constexpr, so that a device counts by the very same.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/base/host_device.h"
#include "core/quality/quality.h"

namespace dmoscope {

/// Counts of element qualities. Bin i holds q in [lowest + i w, lowest + (i + 1) w); the last bin its upper end too.
struct Histogram {
  static constexpr std::size_t kBins = 64;
  double lowest = 0.0, highest = 1.0;
  std::array<Index, kBins> counts{};
  Index below = 0;  // q < lowest (inverted elements when lowest is 0)
  Index above = 0;
};

/// Slot in which a quality is counted: a bin of a Histogram, or one of the three after the last bin.
inline constexpr std::size_t kSlotBelow = Histogram::kBins, kSlotAbove = kSlotBelow + 1, kSlotNowhere = kSlotAbove + 1;
[[nodiscard]] DMOSCOPE_ANYWHERE std::size_t histogram_slot(double quality) {
  constexpr double kLowest = 0.0, kHighest = 1.0;
  constexpr double kScale = static_cast<double>(Histogram::kBins) / (kHighest - kLowest);
  if (quality != quality) return kSlotNowhere;  // NaN: not defined
  if (quality < kLowest) return kSlotBelow;
  if (quality > kHighest * (1.0 + 1e-12)) return kSlotAbove;  // rounding makes no element better than ideal
  const auto bin = static_cast<std::size_t>((quality - kLowest) * kScale);
  return bin < Histogram::kBins ? bin : Histogram::kBins - 1;
}

/// Shades that are no quality.
inline constexpr float kInvertedShade = -3e38F, kUndefinedShade = 3e38F;

/// Shade by which the renderer colours an element: its quality, or one of the values above. `quality`: NaN where it is not defined.
[[nodiscard]] DMOSCOPE_ANYWHERE float shade_of(float quality, bool inverted) {
  constexpr float kLargest = 1e37F;
  if (inverted) return kInvertedShade;
  if (quality != quality) return kUndefinedShade;
  return quality < -kLargest ? -kLargest : quality > kLargest ? kLargest : quality;
}

struct RankedElement {
  Index element = kNoIndex;
  double quality = 0.0;
  bool inverted = false;         // smallest_jacobian() is <= 0
  std::optional<Vec3> inside{};  // see inverted_inside()
};

/// Summary of all elements by one metric.
struct ElementSummary {
  Statistics statistics;
  Histogram histogram;
  std::vector<RankedElement> worst;  // worst first, ties by index; NaN is left out
};

}  // namespace dmoscope
