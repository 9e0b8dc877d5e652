#include "core/quality/metric.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/unknown_value.h"
#include "core/quality/defined_metric.h"

namespace dmoscope {

namespace {
constexpr KindSet kTriangles = kind_set(ElementKind::Triangle), kQuadrilaterals = kind_set(ElementKind::Quadrilateral),
                  kTetrahedra = kind_set(ElementKind::Tetrahedron),
                  kOtherVolumes = kind_set(ElementKind::Hexahedron) | kind_set(ElementKind::Wedge) | kind_set(ElementKind::Pyramid);

constexpr std::array<MetricInfo, kMetricCount> kTable{{
    {Metric::MeanRatio, "mean-ratio", "Mean ratio", kTriangles | kQuadrilaterals | kTetrahedra | kOtherVolumes, -1.0, 1.0, 0.3,
     "triangle: 4√3 A / Σ l²;  quadrilateral: 2 min aᵢ / (lᵢ² + lᵢ₋₁²);  tetrahedron: 12 (3V)^⅔ / Σ l²;  hexahedron, wedge, pyramid: "
     "3 min det(Aᵢ)^⅔ / |Aᵢ|², Aᵢ a corner's Jacobian against the ideal one",
     "Shape; the paper's metric (eq. 4). Elements with other than simplex corners by their least corner (Knupp)."},
    {Metric::MeanRatioArea, "mean-ratio-area", "Mean ratio by area", kTriangles | kQuadrilaterals, -1.0, 1.0, 0.3,
     "quadrilateral: 4 A / Σ l²;  triangle: the mean ratio",
     "The paper's quadrilateral metric (eq. 11) scaled to 1 for a square. It cannot see a concave corner."},
    {Metric::RadiusRatio, "radius-ratio", "Radius ratio", kTriangles | kTetrahedra, -1.0, 1.0, 0.3,
     "triangle: sign(A) 2 r / R;  tetrahedron: sign(V) 3 r / R", "Incircle against circumcircle, insphere against circumsphere."},
    {Metric::MinAngle, "min-angle", "Minimum angle", kTriangles | kTetrahedra, -1.0, 1.0, 0.5,
     "triangle: sign(A) 3 θmin / π;  tetrahedron: sign(V) least dihedral angle / arccos ⅓",
     "Smallest angle against 60°; of tetrahedra the smallest dihedral angle against 70.53°."},
    {Metric::MaxAngle, "max-angle", "Maximum angle", kTriangles, -1.0, 1.0, 0.5, "sign(A) 1.5 (1 − θmax / π)",
     "Largest angle against 60°; 0 at 180°."},
    {Metric::Rectangularity, "rectangularity", "Rectangularity", kTriangles, -1.0, 1.0, 0.5,
     "sign(A) maxᵢ (1 − |π/2 − θᵢ| / (π/2)) (1 − |eᵢⱼ − eᵢₖ| / max(eᵢⱼ, eᵢₖ))",
     "One right angle with equal legs (paper eq. 9, 10). Not quasiconcave."},
    {Metric::ScaledJacobian, "scaled-jacobian", "Scaled Jacobian", kTriangles | kQuadrilaterals | kTetrahedra | kOtherVolumes, -1.0, 1.0,
     0.5,
     "triangle: (2/√3) 2A / largest product of two edges;  quadrilateral: min aᵢ / (lᵢ lᵢ₋₁);  tetrahedron: √2 6V / largest product of "
     "three edges at a corner;  hexahedron: least corner determinant of unit edges (wedge: × 2/√3, pyramid's base: × √2)",
     "Sine of the worst corner, or its counterpart in a volume (Verdict)."},
    {Metric::AspectRatio, "aspect-ratio", "Aspect ratio", kTriangles | kTetrahedra, -1.0, 1.0, 0.3,
     "triangle: 4√3 A / (lmax Σ l);  tetrahedron: sign(V) 2√6 r / lmax", "Longest edge against the inradius (Verdict's value inverted)."},
    {Metric::Condition, "condition", "Condition", kQuadrilaterals | kTetrahedra | kOtherVolumes, -1.0, 1.0, 0.3,
     "quadrilateral: the mean ratio;  volumes: least 3 det(Aᵢ) / (|Aᵢ| |adj Aᵢ|), Aᵢ a corner's Jacobian against the ideal one",
     "Inverse of the worst corner's condition number (Knupp; Verdict's value inverted), signed."},
}};
}  // namespace

std::span<const MetricInfo> metric_table() { return kTable; }

const MetricInfo& info(Metric metric) { return is_built_in(metric) ? kTable[static_cast<std::size_t>(metric)] : defined(metric).info; }

Metric parse_metric(std::string_view name) {
  for (const MetricInfo& entry : kTable)
    if (entry.name == name) return entry.metric;
  if (const auto known = define_metric(name)) return *known;
  std::vector<std::string_view> names;
  for (const MetricInfo& entry : kTable) names.push_back(entry.name);
  for (const NamedFormula& entry : named_formulas()) names.push_back(entry.name);
  throw UsageError(unknown_value("metric", name, names) + "; or formula:TEXT");
}

void refuse_defined_metric() { throw std::logic_error("a metric that is defined by a formula or a target has no code of its own"); }

void require_defined(Metric metric, const Mesh& mesh) {
  for (const ElementKind kind : {ElementKind::Triangle, ElementKind::Quadrilateral, ElementKind::Tetrahedron, ElementKind::Hexahedron,
                                 ElementKind::Wedge, ElementKind::Pyramid}) {
    if (info(metric).defined_for(kind)) continue;
    if (const auto count = std::ranges::count(mesh.elements.kinds(), kind); count > 0)
      throw UsageError(fmt::format("{} is not defined for {}, and the mesh has {} of them", info(metric).name, info(kind).plural, count));
  }
}

}  // namespace dmoscope
