#pragma once
// How good a mesh's elements are, for a person and as JSON.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/common/text.h"
#include "core/mesh/plane.h"
#include "core/quality/metric.h"

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
  std::uint64_t elements = 0;  // for which it is defined
  double minimum = 0.0, percentile_1 = 0.0, percentile_5 = 0.0, percentile_50 = 0.0, mean = 0.0;
  std::uint64_t unacceptable = 0;
  std::vector<Worst> worst{};
};

[[nodiscard]] Json json_of(const MetricSummary& summary, bool with_worst);
void print_table(const std::vector<MetricSummary>& summaries);

/// Coordinates of places in a mesh, to six digits of the mesh's size; far from the origin that is more digits of the coordinate. Without z
/// where all of the mesh has the same. --json has all digits.
class PlaceText {
 public:
  explicit PlaceText(const Geometry& geometry);
  [[nodiscard]] std::string operator()(Vec3 p) const;
  [[nodiscard]] std::string head() const;

 private:
  [[nodiscard]] std::string coordinate(double x) const;
  std::optional<int> decimals_;  // none: such numbers are written with an exponent
  bool flat_ = false;
};
void print_worst(const MetricSummary& summary, const PlaceText& place);

}  // namespace dmoscope::app
