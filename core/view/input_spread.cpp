#include "core/view/input_spread.h"

#include <algorithm>
#include <cmath>

namespace dmoscope {

void InputSpread::add(double quality) {
  if (std::isnan(quality)) return;
  lowest = std::min(lowest, quality);
  highest = std::max(highest, quality);
  ++count;
  const double at = std::clamp(quality, 0.0, 1.0) * static_cast<double>(kBins);
  ++bins[std::min(static_cast<std::size_t>(at), kBins - 1)];
}

void InputSpread::add(const InputSpread& other) {
  lowest = std::min(lowest, other.lowest);
  highest = std::max(highest, other.highest);
  count += other.count;
  for (std::size_t bin = 0; bin < kBins; ++bin) bins[bin] += other.bins[bin];
}

std::optional<std::pair<double, double>> InputSpread::range() const {
  return count > 0 ? std::optional(std::pair{lowest, highest}) : std::nullopt;
}

std::optional<std::pair<double, double>> InputSpread::range_without_tail() const {
  constexpr double kOthers = 95.0;
  if (count == 0) return std::nullopt;
  const double high = percentiles(0.0, kOthers)->second;
  return std::pair{lowest, high < std::min(1.0, 0.5 * (lowest + highest)) ? high : highest};
}

std::optional<std::pair<double, double>> InputSpread::percentiles(double low, double high) const {
  if (count == 0) return std::nullopt;
  const auto bin_of = [this](double percent) {
    const double wanted = std::max(1.0, std::ceil(percent / 100.0 * static_cast<double>(count)));
    std::uint64_t so_far = 0;
    std::size_t bin = 0;
    while (bin + 1 < kBins && static_cast<double>(so_far += bins[bin]) < wanted) ++bin;
    return static_cast<double>(bin);
  };
  const auto within = [this](double value) { return std::clamp(value, lowest, highest); };
  return std::pair{within(bin_of(low) / static_cast<double>(kBins)), within((bin_of(high) + 1.0) / static_cast<double>(kBins))};
}

std::pair<double, double> tidy_range(std::pair<double, double> range) {
  constexpr double kNarrowest = 0.02;  // least width of the range in quality; and a tolerance, so that 0.7 in float is 0.7
  constexpr double kHair = 1e-6;
  auto [low, high] = range;
  if (high - low < kNarrowest) low = std::max(std::min(low, 0.0), high - kNarrowest);
  if (high - low < kNarrowest) high = low + kNarrowest;
  const double rough = (high - low) / 10.0, power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double multiple : {1.0, 2.0, 5.0}) {
    if (multiple * power < rough * (1.0 - 1e-9)) continue;
    step = multiple * power;
    break;
  }
  // Divides instead of multiplying: 7 tenths are 0.7, 7 times 0.1 is not.
  const double parts = std::round(1.0 / step);
  const auto times = [&](double n) { return parts >= 1.0 ? n / parts : n * step; };
  return {times(std::floor(low / step + kHair)), times(std::ceil(high / step - kHair))};
}

}  // namespace dmoscope
