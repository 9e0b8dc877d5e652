// Formulas and targets in joint moves: their atoms' least is the metric as the program judges it, their derivatives are those of their
// values, and joint moves by a built-in metric's formula get as far as by the metric.

#include "core/joint/defined_atoms.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "core/quality/defined_metric.h"
#include "tests/joint/elements.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;

struct Split {
  const char* formula;
  double ceiling = std::numeric_limits<double>::infinity();  // quality of a part that no vertex changes: no atom has it
};
/// Formulas of all that splits: corners, edges, the least of numbers under functions that rise and fall, and formulas without parts.
constexpr std::array kFormulas{Split{"2*det/norm^2"},
                               Split{"exp(-1/det)"},
                               Split{"min(l12, l23)/max(l12, l23)"},
                               Split{"1/max(norm^2/det, 1.5)", 1.0 / 1.5},
                               Split{"sqrt(min(2*det/norm^2, 0.81)) - 0.1", 0.8},
                               Split{"clamp(2*det/norm^2, 0.05, 0.8)", 0.8},
                               Split{"log(2*det/norm^2) + 3"},
                               Split{"(2*det/norm^2)^0.7"},
                               Split{"det*(0.5 + cos(norm)^2)"},
                               Split{"atan(det/norm^2)*1.2"}};

template <int D>
void expect_least_and_derivatives(const Mesh& mesh, const std::string& name, double ceiling, testing::Random& random) {
  const auto input = testing::input(mesh);
  const Metric metric = parse_metric(name);
  const auto atoms = std::make_shared<const DefinedAtoms<D>>(*input, metric);
  const AtomFunction<D> function(atoms);
  std::vector<Atom<D>> all;
  atoms->append(input->mesh.elements, 0, all);
  const double unit = random(0.3, 3.0);
  double most = 0.0;
  for (const Atom<D>& atom : all) {
    if (atom.piece == kGuardPiece) continue;
    AtomEdges<D> edges = testing::edges_of<D>(atom, input->mesh.positions);
    for (auto& edge : edges)
      for (double& x : edge) x *= unit;
    const double f = function.value(atom, edges, unit);
    most = std::max(most, f);
    if (f < 10.0 && f > 0.02) testing::expect_derivatives<D>(function, atom, edges, unit);
  }
  const double quality = element_quality(input->quality_context(), input->mesh.positions, metric, 0);
  EXPECT_NEAR(std::min(function.quality_of(most), ceiling), quality, 1e-11 * (1.0 + std::abs(quality)))
      << name << " of " << info(mesh.elements.kind(0)).name;
}

TEST(DefinedAtoms, TheirLeastIsTheMetricAndTheirDerivativesAreThoseOfTheirValues) {
  testing::Random random(7);
  int looked_at = 0;
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    for (const Split& split : kFormulas) {
      const std::string name = std::string("formula:") + split.formula;
      if (!defined_joint_obstacle(parse_metric(name), kind_set(kind)).empty()) continue;
      for (int round = 0; round < 4; ++round) {
        const Mesh mesh = testing::random_element(kind, 0.2, random);
        if (testing::input(mesh)->report.inverted_elements.size() > 0) continue;
        ++looked_at;
        if (info(kind).dimension == 3)
          expect_least_and_derivatives<3>(mesh, name, split.ceiling, random);
        else
          expect_least_and_derivatives<2>(mesh, name, split.ceiling, random);
      }
    }
  }
  EXPECT_GT(looked_at, 150);
}

TEST(DefinedAtoms, AMetricsFormulaHasItsSmoothPieces) {
  const auto pieces = [](Metric metric, ElementKind kind) { return Formula(formula_of(metric)).pieces(kind, FormulaSpace::Plain).size(); };
  EXPECT_EQ(pieces(Metric::MeanRatio, ElementKind::Triangle), 1U);
  EXPECT_EQ(pieces(Metric::MeanRatio, ElementKind::Hexahedron), 8U);
  EXPECT_EQ(pieces(Metric::MinAngle, ElementKind::Triangle), 3U);
  EXPECT_EQ(pieces(Metric::MinAngle, ElementKind::Tetrahedron), 6U);
  EXPECT_EQ(pieces(Metric::AspectRatio, ElementKind::Triangle), 3U);
  EXPECT_EQ(pieces(Metric::AspectRatio, ElementKind::Tetrahedron), 6U);
  EXPECT_EQ(pieces(Metric::ScaledJacobian, ElementKind::Quadrilateral), 4U);
}

TEST(DefinedAtoms, SaysWhyItCannotBe) {
  const auto why_not = [](const char* name, ElementKind kind) { return joint_obstacle(parse_metric(name), kind_set(kind)); };
  EXPECT_THAT(why_not("formula:2*det/norm^2 + 0.01*x(p1)", ElementKind::Triangle), HasSubstr("where elements lie"));
  EXPECT_THAT(why_not("scaled-jacobian-inside", ElementKind::Hexahedron), HasSubstr("corners"));
  EXPECT_EQ(why_not("formula:2*det/norm^2", ElementKind::Hexahedron), "");
  EXPECT_EQ(why_not("mean-ratio@input", ElementKind::Pyramid), "");
}

double reached(const std::shared_ptr<const InputMesh>& mesh, Metric metric, const std::string& method = "joint") {
  dmoscope::Run run = testing::make_run(mesh, {.method = method, .metric = metric});
  Progress progress;
  run.iterate(60, progress);
  EXPECT_EQ(run.statistics().inverted, mesh->report.inverted_elements.size());
  return run.statistics().movable_minimum;
}

/// Expects that joint moves by a metric and by its formula get as far, both judged as they are.
void expect_as_far(const std::shared_ptr<const InputMesh>& mesh, Metric metric) {
  const Metric formula = parse_metric(std::string("formula:") + std::string(formula_of(metric)));
  const double built_in = reached(mesh, metric), typed = reached(mesh, formula);
  EXPECT_NEAR(typed, built_in, 1e-4) << info(metric).name;
}

TEST(JointFormulas, GetAsFarAsTheMetric) {
  const auto plane = testing::input(testing::lattice(12, 0.35, 3));
  for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle, Metric::RadiusRatio, Metric::ScaledJacobian})
    expect_as_far(plane, metric);
}

/// Uses a formula below 0 nearly everywhere, with its optimum where the mean ratio has it.
TEST(JointFormulas, MayBeNegative) {
  const auto mesh = testing::input(testing::lattice(12, 0.35, 3));
  const double plain = reached(mesh, Metric::MeanRatio), lowered = reached(mesh, parse_metric("formula:2*det/norm^2 - 5"));
  EXPECT_NEAR(lowered + 5.0, plain, 2e-2 * plain);
  EXPECT_LT(lowered, 0.0);
}

/// Uses the longest edge against the shortest, which does not see inversion: elements stay sound all the same.
TEST(JointFormulas, ThatAreBlindToInversionInvertNothing) {
  const auto mesh = testing::input(testing::lattice(12, 0.35, 3));
  const Metric blind = parse_metric("formula:min(l12, l23, l13)/max(l12, l23, l13)");
  dmoscope::Run run = testing::make_run(mesh, {.method = "joint", .metric = blind});
  const double before = run.statistics().movable_minimum;
  Progress progress;
  run.iterate(60, progress);
  EXPECT_GT(run.statistics().movable_minimum, before);
  EXPECT_EQ(run.statistics().inverted, 0U);
}

}  // namespace
}  // namespace dmoscope
