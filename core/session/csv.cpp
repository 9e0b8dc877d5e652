#include "core/session/csv.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace dmoscope {

namespace {
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }
}  // namespace

std::string stats_csv(std::span<const std::string> titles, std::span<const std::vector<IterationRecord>* const> records) {
  std::string text = "run,iteration,min_quality,mean_quality,inverted,moved,seconds,movable_minimum\n";
  for (std::size_t r = 0; r < titles.size(); ++r)
    for (const IterationRecord& row : *records[r])
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}\n", titles[r], row.iteration, number(row.statistics.minimum),
                     number(row.statistics.mean), row.statistics.inverted, row.moved, number(row.seconds),
                     number(row.statistics.movable_minimum));
  return text;
}

std::string elements_csv(const QualityContext& context, std::span<const Vec3> positions, std::span<const Metric> metrics) {
  std::string text = "element,kind";
  for (const Metric metric : metrics) text += fmt::format(",{}", info(metric).name);
  text += '\n';
  for (Index e = 0; e < context.mesh.elements.size(); ++e) {
    fmt::format_to(std::back_inserter(text), "{},{}", e, info(context.mesh.elements.kind(e)).name);
    for (const Metric metric : metrics) text += ',' + number(element_quality(context, positions, metric, e));
    text += '\n';
  }
  return text;
}

}  // namespace dmoscope
