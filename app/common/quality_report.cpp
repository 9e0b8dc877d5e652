#include "app/common/quality_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "app/common/console.h"

namespace dmoscope::app {

Json json_of(const MetricSummary& summary, bool with_worst) {
  const MetricInfo& metric = info(summary.metric);
  Json object{{"metric", metric.name}, {"elements", summary.elements}};
  if (summary.elements == 0) return object;
  object["minimum"] = json_number(summary.minimum);
  object["mean"] = json_number(summary.mean);
  object["percentile_1"] = json_number(summary.percentile_1);
  object["percentile_5"] = json_number(summary.percentile_5);
  object["percentile_50"] = json_number(summary.percentile_50);
  object["acceptable"] = metric.acceptable;
  object["below_acceptable"] = summary.unacceptable;
  Json list = Json::array();
  for (const MetricSummary::Worst& one : summary.worst) {
    const Vec3 c = one.centroid;
    list.push_back({{"element", one.element},
                    {"kind", info(one.kind).name},
                    {"quality", json_number(one.quality)},
                    {"centroid", {json_number(c.x), json_number(c.y), json_number(c.z)}}});
  }
  if (with_worst) object["worst"] = std::move(list);
  return object;
}

namespace {

void print_table(const std::vector<MetricSummary>& summaries) {
  std::size_t width = 16;
  for (const MetricSummary& one : summaries) width = std::max(width, info(one.metric).name.size());
  print("{:<{}} {:>9} {:>10} {:>10} {:>10} {:>10} {:>10} {:>11} {:>8}\n", "metric", width, "elements", "min", "1 %", "5 %", "50 %", "mean",
        "acceptable", "below");
  for (const MetricSummary& one : summaries) {
    if (one.elements == 0) continue;
    const MetricInfo& metric = info(one.metric);
    print("{:<{}} {:>9} {:>10} {:>10} {:>10} {:>10} {:>10} {:>11} {:>8}\n", metric.name, width, one.elements, brief(one.minimum),
          brief(one.percentile_1), brief(one.percentile_5), brief(one.percentile_50), brief(one.mean), brief(metric.acceptable),
          one.unacceptable);
  }
}

constexpr double kMostDecimals = 9.0;

/// Formats places in a mesh, to six digits of the mesh's size; far from the origin the coordinates have more digits. Without z if all of
/// the mesh has the same. --json has all digits.
class PlaceText {
 public:
  explicit PlaceText(const Geometry& geometry);
  [[nodiscard]] std::string operator()(Vec3 p) const;
  [[nodiscard]] std::string head() const;

 private:
  [[nodiscard]] std::string coordinate(double x) const;
  std::optional<int> decimals_;  // none: numbers with an exponent
  bool flat_ = false;
};
PlaceText::PlaceText(const Geometry& geometry) {
  const double size = geometry.size;
  const double decimals = size > 0.0 && std::isfinite(size) ? 5.0 - std::floor(std::log10(size)) : kMostDecimals + 1;
  if (decimals <= kMostDecimals && decimals > -kMostDecimals) decimals_ = std::max(0, static_cast<int>(decimals));
  const PlaneAxes axes(geometry.plane);
  flat_ = geometry.shape == Shape::Planar && axes.u == 0 && axes.v == 1;
}

std::string PlaceText::operator()(Vec3 p) const {
  std::string text = fmt::format("{:>13} {:>13}", coordinate(p.x), coordinate(p.y));
  return flat_ ? text : text + fmt::format(" {:>13}", coordinate(p.z));
}

std::string PlaceText::head() const { return fmt::format("{:>13} {:>13}{}", "x", "y", flat_ ? "" : fmt::format(" {:>13}", "z")); }

std::string PlaceText::coordinate(double x) const {
  return decimals_ && std::isfinite(x) ? fmt::format("{:.{}f}", x, *decimals_) : brief(x);
}

void print_worst(const MetricSummary& summary, const PlaceText& place) {
  if (summary.worst.empty()) return;
  print("\nworst of {}, with the mean of their corners:\n{:>10} {:<14} {:>12} {}\n", info(summary.metric).name, "element", "kind",
        "quality", place.head());
  for (const MetricSummary::Worst& one : summary.worst)
    print("{:>10} {:<14} {:>12} {}\n", one.element, info(one.kind).name, brief(one.quality), place(one.centroid));
}

}  // namespace

Json json_of_inverted(const InvertedCount& inverted) {
  Json list = Json::array();
  for (const InvertedCount::Element& one : inverted.first)
    list.push_back({{"element", one.number}, {"inside_alone", one.inside_alone}, {"at", {one.at.x, one.at.y, one.at.z}}});
  return list;
}

Json json_of(const SurfaceDistance& distance) {
  const auto one = [](const Distances& d) { return Json{{"mean", d.mean}, {"greatest", d.greatest}}; };
  return {{"to", one(distance.to)}, {"back", one(distance.back)}, {"beside", distance.beside}};
}

std::string sentence_of(const InvertedCount& inverted) {
  constexpr std::size_t kMostSaid = 10;
  std::string text = fmt::format("{} inverted", grouped(inverted.all));
  if (inverted.inside_alone == 0) return text;
  text += fmt::format(", {} of them inside alone, where corners do not tell", grouped(inverted.inside_alone));
  std::size_t said = 0;
  for (const InvertedCount::Element& one : inverted.first) {
    if (!one.inside_alone || said == kMostSaid) continue;
    text += fmt::format("{}element {} at ({:.10g}, {:.10g}, {:.10g})", said++ == 0 ? ": " : ", ", one.number, one.at.x, one.at.y, one.at.z);
  }
  return said < inverted.inside_alone ? text + ", ..." : text;
}

void print_counts(const std::string& mesh, std::uint64_t vertices, std::uint64_t elements, const InvertedCount& inverted) {
  print("{}: {}, {}, {}\n\n", mesh, counted(vertices, "vertex", "vertices"), counted(elements, "element", "elements"),
        sentence_of(inverted));
}

void print_summaries(const std::vector<MetricSummary>& summaries, const Geometry& geometry) {
  print_table(summaries);
  const PlaceText place(geometry);
  for (const MetricSummary& summary : summaries) print_worst(summary, place);
}

}  // namespace dmoscope::app
