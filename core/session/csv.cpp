#include "core/session/csv.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/base/csv_text.h"

namespace dmoscope {

namespace {
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }
}  // namespace

std::string stats_label(const RunParameters& parameters) {
  const auto& p = parameters;
  const std::string phases =
      fmt::format("{}{}", p.then_joint ? ":then-joint" : "", p.then_mean ? fmt::format(":then-{}", name(p.mean)) : "");
  if (!p.combination) return fmt::format("{}:{}{}", p.method, info(p.metric).name, phases);
  const std::string how = p.combination->size_text();
  return fmt::format("{}:{}{}{}{}", p.method, to_text(p.metric, *p.combination), how.empty() ? "" : ":", how.substr(0, how.find(':')),
                     phases);
}

std::string stats_csv(std::span<const std::string> titles, std::span<const std::vector<IterationRecord>* const> records,
                      std::span<const SharedVector<Percentiles>> percentiles) {
  std::string text = "run,iteration,min_quality,mean_quality,inverted,moved,seconds,movable_minimum";
  text += percentiles.empty() ? "\n" : ",p1,p5,p50\n";
  for (std::size_t r = 0; r < titles.size(); ++r) {
    const std::string title = csv_text(titles[r]);
    for (const IterationRecord& row : *records[r]) {
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{}", title, row.iteration, number(row.statistics.minimum),
                     number(row.statistics.mean), row.statistics.inverted, row.moved, number(row.seconds),
                     number(row.statistics.movable_minimum));
      if (!percentiles.empty()) {
        const Percentiles p = row.iteration < percentiles[r].size() ? percentiles[r][row.iteration] : Percentiles{};
        fmt::format_to(std::back_inserter(text), ",{},{},{}", number(p.p1), number(p.p5), number(p.p50));
      }
      text += '\n';
    }
  }
  return text;
}

std::string elements_csv(const QualityContext& context, std::span<const Vec3> positions, std::span<const Metric> metrics) {
  std::string text = "element,kind";
  std::vector<std::vector<double>> columns;
  for (const Metric metric : metrics) {
    text += ',' + csv_text(std::string(info(metric).name));
    element_qualities(context, positions, metric, nullptr, columns.emplace_back(context.mesh.elements.size()));
  }
  text += '\n';
  for (Index e = 0; e < context.mesh.elements.size(); ++e) {
    fmt::format_to(std::back_inserter(text), "{},{}", e, info(context.mesh.elements.kind(e)).name);
    for (const std::vector<double>& column : columns) text += ',' + number(column[e]);
    text += '\n';
  }
  return text;
}

}  // namespace dmoscope
