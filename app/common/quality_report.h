#pragma once
// Quality of a mesh's elements, for the user and as JSON.

#include <cstdint>
#include <string>
#include <vector>

#include "app/common/text.h"
#include "core/mesh/plane.h"
#include "core/quality/metric.h"
#include "core/quality/quality.h"
#include "core/reference/surface_distance.h"

namespace dmoscope::app {

/// One metric over all elements of a mesh.
struct MetricSummary {
  struct Worst {
    std::uint64_t element;
    ElementKind kind;
    double quality;
    Vec3 centroid;
  };
  Metric metric{};
  std::uint64_t elements = 0;  // number for which the metric is defined
  double minimum = 0.0, percentile_1 = 0.0, percentile_5 = 0.0, percentile_50 = 0.0, mean = 0.0;
  std::uint64_t unacceptable = 0;
  std::vector<Worst> worst{};
};

[[nodiscard]] Json json_of(const MetricSummary& summary, bool with_worst);
/// The list of the elements that `inverted` names.
[[nodiscard]] Json json_of_inverted(const InvertedCount& inverted);
/// One sentence: "0 inverted"; "3 inverted, 2 of them inside alone, where corners do not tell: element 17 at (1, 0.5, 1), element 18 at (2,
/// 0.5, 1)"; of many elements the first.
[[nodiscard]] std::string sentence_of(const InvertedCount& inverted);
/// Prints the counts: "coast.14: 4,934 vertices, 9,290 elements, 0 inverted".
void print_counts(const std::string& mesh, std::uint64_t vertices, std::uint64_t elements, const InvertedCount& inverted);
/// Prints the table of all metrics, then the worst elements of each.
void print_summaries(const std::vector<MetricSummary>& summaries, const Geometry& geometry);

/// {"to": {"mean": ..., "greatest": ...}, "back": ..., "beside": [...]}
[[nodiscard]] Json json_of(const SurfaceDistance& distance);

}  // namespace dmoscope::app
