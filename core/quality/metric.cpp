#include "core/quality/metric.h"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

namespace {
constexpr std::array<MetricInfo, kMetricCount> kTable{{
    {Metric::MeanRatio, "mean-ratio", "Mean ratio", true, true, -1.0, 1.0, 0.3,
     "triangle: 4√3 A / Σ l²;  quadrilateral: 2 min aᵢ / (lᵢ² + lᵢ₋₁²)",
     "Shape; the paper's metric (eq. 4). Quadrilaterals by their least corner (Knupp)."},
    {Metric::MeanRatioArea, "mean-ratio-area", "Mean ratio by area", true, true, -1.0, 1.0, 0.3,
     "quadrilateral: 4 A / Σ l²;  triangle: the mean ratio",
     "The paper's quadrilateral metric (eq. 11) scaled to 1 for a square. It cannot see a concave corner."},
    {Metric::RadiusRatio, "radius-ratio", "Radius ratio", true, false, -1.0, 1.0, 0.3, "sign(A) 2 r / R", "Incircle against circumcircle."},
    {Metric::MinAngle, "min-angle", "Minimum angle", true, false, -1.0, 1.0, 0.5, "sign(A) 3 θmin / π", "Smallest angle against 60°."},
    {Metric::MaxAngle, "max-angle", "Maximum angle", true, false, -1.0, 1.0, 0.5, "sign(A) 1.5 (1 − θmax / π)",
     "Largest angle against 60°; 0 at 180°."},
    {Metric::Rectangularity, "rectangularity", "Rectangularity", true, false, -1.0, 1.0, 0.5,
     "sign(A) maxᵢ (1 − |π/2 − θᵢ| / (π/2)) (1 − |eᵢⱼ − eᵢₖ| / max(eᵢⱼ, eᵢₖ))",
     "One right angle with equal legs (paper eq. 9, 10). Not quasiconcave."},
    {Metric::ScaledJacobian, "scaled-jacobian", "Scaled Jacobian", true, true, -1.0, 1.0, 0.5,
     "triangle: (2/√3) 2A / largest product of two edges;  quadrilateral: min aᵢ / (lᵢ lᵢ₋₁)", "Sine of the worst corner (Verdict)."},
    {Metric::AspectRatio, "aspect-ratio", "Aspect ratio", true, false, -1.0, 1.0, 0.3, "4√3 A / (lmax Σ l)",
     "Longest edge against the inradius (Verdict's value inverted)."},
}};
}  // namespace

std::span<const MetricInfo> metric_table() { return kTable; }

const MetricInfo& info(Metric metric) { return kTable[static_cast<std::size_t>(metric)]; }

Metric parse_metric(std::string_view name) {
  for (const MetricInfo& entry : kTable)
    if (entry.name == name) return entry.metric;
  std::string known;
  for (const MetricInfo& entry : kTable) known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  throw UsageError(fmt::format("unknown metric '{}'; known are {}", name, known));
}

void require_defined(Metric metric, const Mesh& mesh) {
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Quadrilateral, ElementKind::Tetrahedron, ElementKind::Hexahedron,
                                 ElementKind::Wedge, ElementKind::Pyramid}) {
    if (info(metric).defined_for(kind)) continue;
    if (const auto count = std::ranges::count(mesh.elements.kinds(), kind); count > 0)
      throw UsageError(fmt::format("{} is not defined for {}, and the mesh has {} of them", info(metric).name, info(kind).plural, count));
  }
}

}  // namespace dmoscope
