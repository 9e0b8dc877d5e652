#include "core/run/percentiles.h"

#include <algorithm>
#include <cmath>

namespace dmoscope {
namespace {

/// Rank, counted from 0, of the last of the fewest elements that are so many hundredths of all.
std::size_t rank_of(std::size_t hundredths, std::size_t count) { return (hundredths * count + 99) / 100 - 1; }

}  // namespace

Percentiles percentiles_of(std::vector<double>& qualities) {
  std::erase_if(qualities, [](double q) { return std::isnan(q); });
  if (qualities.empty()) return {};
  const std::size_t count = qualities.size();
  // Searches from above downwards, so that each search has less to look through.
  auto end = qualities.end();
  const auto of = [&](std::size_t hundredths) {
    const auto place = qualities.begin() + static_cast<std::ptrdiff_t>(rank_of(hundredths, count));
    std::nth_element(qualities.begin(), place, end);
    end = place + 1;
    return *place;
  };
  Percentiles found;
  found.p50 = of(50);
  found.p5 = of(5);
  found.p1 = of(1);
  return found;
}

Percentiles percentiles_of_sorted(std::span<const float> qualities) {
  if (qualities.empty()) return {};
  const auto of = [&](std::size_t hundredths) { return static_cast<double>(qualities[rank_of(hundredths, qualities.size())]); };
  return {of(1), of(5), of(50)};
}

Percentiles compute_percentiles(const QualityContext& context, std::span<const Vec3> positions, Metric metric, ThreadPool* pool) {
  std::vector<double> qualities(context.mesh.elements.size());
  element_qualities(context, positions, metric, pool, qualities);
  return percentiles_of(qualities);
}

}  // namespace dmoscope
