// Fits: vertices beside the surface of another mesh are drawn to it, its corners and edges first, and no element becomes inverted.

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/reference/slide_on.h"
#include "core/reference/surface_distance.h"
#include "core/run/recipe.h"
#include "tests/smooth/surface_judge.h"
#include "tests/smooth/surface_zoo.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using namespace testing;
using test::Fill;
using test::volume_grid;
using ::testing::HasSubstr;

Mesh scaled(Mesh mesh, double by) {
  for (Vec3& p : mesh.positions) p = by * p;
  return mesh;
}
RunParameters fitting(double distance) {
  RunParameters parameters;
  parameter_info("fit").from_text(parameters, fmt::format("{}", distance));
  return parameters;
}
double least_mean_ratio(const InputMesh& mesh, std::span<const Vec3> positions) {
  double least = 1.0;
  for (Index e = 0; e < mesh.mesh.elements.size(); ++e)
    least = std::min(least, element_quality(mesh.quality_context(), positions, Metric::MeanRatio, e));
  return least;
}

/// A smaller ball inside a sphere.
TEST(SurfaceFit, DrawsBallsOutToASphere) {
  const Mesh sphere = skin(mapped(volume_grid(12, Fill::Hexahedra), ball), Cells::Triangles);
  for (const Fill fill : {Fill::Tetrahedra, Fill::Hexahedra, Fill::Wedges}) {
    const Mesh start = scaled(mapped(volume_grid(5, fill, 0.05, 3), ball), 0.9);
    const auto mesh = slide_on(*input(start), input(sphere));
    dmoscope::Run run = make_run(mesh, fitting(0.2));
    EXPECT_EQ(run.parameters().boundary, BoundaryRule::Slide);
    Progress progress;
    run.iterate(1, progress);
    const SurfaceDistance before = surface_distance(*mesh, start.positions), after = surface_distance(*mesh, run.positions());
    EXPECT_GT(before.to.greatest, 0.05);
    EXPECT_FALSE(before.beside.empty());
    EXPECT_THAT(after.beside, ::testing::IsEmpty());
    EXPECT_LT(after.to.mean, 0.3 * before.to.mean);
    EXPECT_LT(after.back.mean, 0.3 * before.back.mean);
    const auto boundary = mesh->topology.boundary();
    for (Index v = 0; v < boundary.size(); ++v)
      if (boundary[v] != 0) {
        const double radius = length(run.positions()[v]);
        ASSERT_TRUE(radius <= 1.0 + 1e-9 && radius > 0.97) << "vertex " << v << " at radius " << radius;
      }
    EXPECT_EQ(run.statistics().inverted, 0U);
    EXPECT_GE(least_mean_ratio(*mesh, run.positions()), least_mean_ratio(*mesh, start.positions));
    EXPECT_EQ(best_iteration(run.parameters(), run.history().records()), 1U);  // the input is not fitted
  }
}

/// The skin of the smaller ball alone.
TEST(SurfaceFit, DrawsSurfacesToo) {
  const Mesh sphere = skin(mapped(volume_grid(12, Fill::Hexahedra), ball), Cells::Triangles);
  const Mesh start = scaled(skin(mapped(volume_grid(6, Fill::Hexahedra), ball), Cells::Mixed), 0.95);
  const auto mesh = slide_on(*input(start), input(sphere));
  dmoscope::Run run = make_run(mesh, fitting(0.2));
  Progress progress;
  run.iterate(1, progress);
  EXPECT_THAT(surface_distance(*mesh, run.positions()).beside, ::testing::IsEmpty());
  EXPECT_EQ(run.statistics().inverted, 0U);
}

/// Coordinates show corners, edges and sides of a cube.
TEST(SurfaceFit, CornersAndEdgesClaimTheirVerticesFirst) {
  constexpr Index n = 5;
  const Mesh sound = volume_grid(n, Fill::Hexahedra);
  testing::Random random(7);
  Mesh start = sound;
  const auto outer = [](double x) { return x < 1e-9 || x > 1.0 - 1e-9; };
  for (Vec3& p : start.positions)
    if (outer(p.x) || outer(p.y) || outer(p.z)) p = p + 0.03 * Vec3{random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)};
  const auto mesh = slide_on(*input(start), input(skin(volume_grid(7, Fill::Hexahedra), Cells::Quadrilaterals)));
  std::vector<std::vector<Vec3>> results;
  for (const unsigned threads : {1U, 2U, 8U}) {
    dmoscope::Run run(mesh, fitting(0.06), std::make_shared<ThreadPool>(threads), 0);
    Progress progress;
    run.iterate(1, progress);
    results.emplace_back(run.positions().begin(), run.positions().end());
  }
  for (Index v = 0; v < sound.vertex_count(); ++v) {
    const Vec3 was = sound.positions[v], is = results[0][v];
    const auto stays = [&](double before, double now) { return !outer(before) || std::abs(now - before) < 1e-9; };
    ASSERT_TRUE(stays(was.x, is.x) && stays(was.y, is.y) && stays(was.z, is.z)) << "vertex " << v;
  }
  EXPECT_TRUE(same_bits(std::span<const Vec3>(results[0]), std::span<const Vec3>(results[1])));
  EXPECT_TRUE(same_bits(std::span<const Vec3>(results[0]), std::span<const Vec3>(results[2])));
}

/// A ball that is tangled on its sphere. Vertices that leave it farther than the fit allows to untangle an element can be drawn back.
TEST(SurfaceFit, UntanglesOnTheSurface) {
  Mesh start = mapped(volume_grid(3, Fill::Hexahedra), ball);
  testing::Random random(1);
  for (Vec3& p : start.positions) {
    if (length(p) < 1.0 - 1e-9) continue;
    p = p + 0.3 * Vec3{random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)};
    p = (1.0 / length(p)) * p;
  }
  constexpr double kDistance = 0.003;
  const auto mesh = slide_on(*input(start), input(skin(mapped(volume_grid(12, Fill::Hexahedra), ball), Cells::Triangles)));
  dmoscope::Run run = make_run(mesh, fitting(kDistance));
  EXPECT_GT(run.statistics().inverted, 5U);
  Progress progress;
  run.iterate(1, progress);
  EXPECT_EQ(run.statistics().inverted, 0U);
  const auto boundary = mesh->topology.boundary();
  for (Index v = 0; v < boundary.size(); ++v)
    if (boundary[v] != 0) {
      EXPECT_LE(std::abs(1.0 - length(run.positions()[v])), kDistance + 0.03) << "vertex " << v;  // the facets' own depth
    }
}

/// Cubes, which a fit to a bulge makes worse for good: rises are those above the fitted state.
TEST(SurfaceFit, RisesCountFromTheFittedState) {
  Mesh bulged = skin(volume_grid(12, Fill::Hexahedra), Cells::Triangles);
  for (Vec3& p : bulged.positions)
    if (p.z > 1.0 - 1e-9) p.z += 0.2 * std::sin(std::numbers::pi * p.x) * std::sin(std::numbers::pi * p.y);
  const auto mesh = slide_on(*input(volume_grid(5, Fill::Hexahedra)), input(bulged));
  RunParameters parameters = fitting(0.3);
  parameter_info("guard").from_text(parameters, "mean-ratio:0.1");
  for (const bool then_mean : {false, true}) {
    if (then_mean) {
      set_then(parameters, "mean", {});
      be_patient(parameters, 3);
    }
    dmoscope::Run run = make_run(mesh, parameters);
    Progress progress;
    const Outcome outcome = run.until_converged({.patience = 3, .max_iterations = 60}, progress);
    const auto minimum = [&](std::uint64_t i) { return run.history().records()[i].statistics.minimum; };
    EXPECT_LT(minimum(1), 0.9);
    EXPECT_GT(outcome.last_rise, 1U);
    EXPECT_EQ(run.mean_since().has_value(), then_mean);
    if (then_mean) {
      EXPECT_GT(minimum(*run.mean_since()), minimum(1) + 1e-3);
    }
  }
}

/// Vertices farther away than the distance stay, and are told.
TEST(SurfaceFit, LeavesWhatIsTooFarAway) {
  const Mesh sphere = skin(mapped(volume_grid(12, Fill::Hexahedra), ball), Cells::Triangles);
  const Mesh start = scaled(mapped(volume_grid(4, Fill::Hexahedra), ball), 0.9);
  const auto mesh = slide_on(*input(start), input(sphere));
  dmoscope::Run run = make_run(mesh, fitting(0.02));
  Progress progress;
  run.iterate(1, progress);
  const SurfaceDistance before = surface_distance(*mesh, start.positions), after = surface_distance(*mesh, run.positions());
  EXPECT_EQ(after.beside.size(), before.beside.size());
  EXPECT_THAT(fit_sentence(*mesh, before, after), HasSubstr(fmt::format("{} vertices do not reach it", before.beside.size())));
}

TEST(SurfaceFit, IsRefusedWithoutASurface) {
  const auto mesh = input(volume_grid(3, Fill::Hexahedra));
  try {
    static_cast<void>(make_run(mesh, fitting(0.1)));
    ADD_FAILURE() << "nothing was thrown";
  } catch (const UsageError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--surface FILE"));
  }
  RunParameters parameters;
  for (const char* word : {"0", "-1", "near"}) EXPECT_ANY_THROW(parameter_info("fit").from_text(parameters, word)) << word;
}

/// A crease of the reference that ends in it is none: a fold along half of a line.
TEST(SurfaceFit, CreasesThatEndInTheSurfaceAreNone) {
  const auto bent = [](Index n) {
    Mesh mesh = skin(volume_grid(n, Fill::Hexahedra), Cells::Triangles);
    for (Vec3& p : mesh.positions)
      if (p.z > 1.0 - 1e-9) p.z += 1.2 * (0.5 - std::abs(p.x - 0.5)) * std::max(0.0, 0.5 - p.y);
    return mesh;
  };
  const auto own = input(bent(8));
  const auto on = slide_on(*own, own);
  const dmoscope::Run alone = make_run(own, sliding_by()), run = make_run(on, sliding_by());
  std::size_t ridge = 0;
  for (Index v = 0; v < own->mesh.vertex_count(); ++v) {
    const Vec3 p = own->mesh.positions[v];
    if (p.z <= 1.0 + 1e-9 || p.y < 1e-9 || std::abs(p.x - 0.5) > 1e-9) continue;
    ridge += alone.domain()->on_surface(v) ? 0 : 1;
    EXPECT_TRUE(run.domain()->on_surface(v)) << "vertex " << v;
  }
  EXPECT_GT(ridge, 0U);
}

/// Its floor is by the least mean ratio of the input, and a metric that a person names is raised instead.
TEST(HexRecipe, RaisesTheScaledJacobianAboveAMeanRatio) {
  const auto mesh = input(volume_grid(4, Fill::Hexahedra, 0.25, 5));
  const double least = least_mean_ratio(*mesh, mesh->mesh.positions);
  ASSERT_TRUE(least > 0.01 && least < 0.9) << least;
  RunParameters parameters;
  EXPECT_TRUE(follow_recipe(recipe("hex"), *mesh, parameters).empty());
  ASSERT_TRUE(parameters.combination);
  EXPECT_DOUBLE_EQ(parameters.combination->threshold, std::min(0.3, 1.3 * least));
  dmoscope::Run run = make_run(mesh, parameters);
  Progress progress;
  run.iterate(10, progress);
  EXPECT_GE(least_mean_ratio(*mesh, run.positions()), std::min(parameters.combination->threshold, least));
  const auto scaled = [&](std::span<const Vec3> positions) {
    return compute_statistics(mesh->quality_context(), positions, Metric::ScaledJacobian, std::span<const Index>(), nullptr).minimum;
  };
  EXPECT_GT(scaled(run.positions()), scaled(mesh->mesh.positions));
  parameters.metric = Metric::ScaledJacobian;
  EXPECT_TRUE(follow_recipe(recipe("hex"), *mesh, parameters).empty());
  EXPECT_FALSE(parameters.combination);
}

}  // namespace
}  // namespace dmoscope
