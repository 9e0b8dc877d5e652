// Recipes where nearly all elements are boxes: the right angles stay.

#include "core/run/recipe.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/run/percentiles.h"
#include "tests/smooth/promises.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::lattice;

/// Long boxes that become longer to one side: their mean ratio is low, their scaled Jacobian is 1 or nearly so.
Mesh stretched(Mesh mesh, double bend) {
  for (Vec3& p : mesh.positions) p = {3.0 * p.x + p.x * p.x, 0.4 * p.y + bend * std::sin(3.0 * p.x), p.z};
  return mesh;
}

Percentiles scaled_jacobian(const InputMesh& mesh, std::span<const Vec3> positions) {
  return compute_percentiles(mesh.quality_context(), positions, Metric::ScaledJacobian, nullptr);
}

TEST(RecipeOfBoxes, KeepsTheirRightAngles) {
  for (const double bend : {0.0, 0.05})
    for (const bool volume : {false, true}) {
      SCOPED_TRACE(volume ? "hexahedra" : "quadrilaterals");
      const auto mesh = testing::input(
          stretched(volume ? test::volume_grid(6, test::Fill::Hexahedra) : lattice(12, 0.0, 1, Cells::Quadrilaterals), bend));
      RunParameters parameters;
      EXPECT_EQ(follow_recipe(recipe("best"), *mesh, parameters).size(), 1U);
      const Percentiles before = scaled_jacobian(*mesh, mesh->mesh.positions);
      ASSERT_TRUE(parameters.guard && parameters.guard->floor);
      EXPECT_NEAR(*parameters.guard->floor, before.p5, 0.003);
      dmoscope::Run run = testing::make_run(mesh, parameters);
      Progress progress;
      (void)run.until_converged({.patience = 20, .max_iterations = 400}, progress);
      const Percentiles after = scaled_jacobian(*mesh, run.positions());
      EXPECT_GE(after.p1, std::min(before.p1, before.p5 - 0.003));
      EXPECT_GE(after.p5, before.p5 - 0.003);
      const Statistics& input = run.history().records().front().statistics;
      EXPECT_GE(run.statistics().minimum, input.minimum);
      EXPECT_GE(run.statistics().mean, input.mean - 0.005);

      RunParameters free;
      free.guard.reset();
      EXPECT_TRUE(follow_recipe(recipe("best"), *mesh, free).empty());
      EXPECT_FALSE(free.guard) << "--guard off stays";
    }
}

/// A few bad elements among boxes can be mended, and their minimum rises as without a guard.
TEST(RecipeOfBoxes, RaisesTheMinimumOfAFewThatAreNone) {
  Mesh dented = lattice(24, 0.0, 1, Cells::Quadrilaterals);
  for (Vec3& p : dented.positions) {
    p.x *= 3.0;
    if (std::abs(p.x - 1.5) < 0.01 && std::abs(p.y - 0.5) < 0.01) p = p + Vec3{0.09, 0.025, 0.0};
  }
  const auto mesh = testing::input(std::move(dented));
  RunParameters parameters;
  EXPECT_TRUE(follow_recipe(recipe("best"), *mesh, parameters).empty());
  dmoscope::Run run = testing::make_run(mesh, parameters);
  Progress progress;
  (void)run.until_converged({.patience = 20, .max_iterations = 400}, progress);
  EXPECT_GT(run.statistics().minimum, run.history().records().front().statistics.minimum + 0.1);
}

TEST(RecipeOfBoxes, EndsWithTheRecipe) {
  const auto mesh = testing::input(stretched(lattice(12, 0.0, 1, Cells::Quadrilaterals), 0.0));
  RunParameters parameters;
  (void)follow_recipe(recipe("best"), *mesh, parameters);
  ASSERT_NE(parameters.guard, GuardRule{});
  (void)follow_recipe(recipe("minimum"), *mesh, parameters);
  EXPECT_EQ(parameters.guard, GuardRule{});
  parameters.backend = Backend::Cuda;
  EXPECT_EQ(follow_recipe(recipe("mean"), *mesh, parameters).size(), 1U) << "the guard is kept on the CPU alone, and that is said";
  EXPECT_EQ(parameters.guard, GuardRule{});
}

TEST(RecipeOfBoxes, IsThatOfOtherMeshesElsewhere) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    RunParameters parameters;
    EXPECT_TRUE(follow_recipe(recipe("best"), *testing::input(lattice(8, 0.0, 1, cells)), parameters).empty());
    EXPECT_EQ(parameters.guard, GuardRule{});
  }
  const auto jittered = testing::input(lattice(8, 0.3, 1, Cells::Quadrilaterals));
  const auto boxes = testing::input(stretched(lattice(12, 0.0, 1, Cells::Quadrilaterals), 0.0));
  RunParameters parameters;
  EXPECT_TRUE(follow_recipe(recipe("best"), *jittered, parameters).empty());
  EXPECT_TRUE(follow_recipe(recipe("minimum"), *boxes, parameters).empty()) << "it raises no mean";
  parameters.metric = Metric::MinAngle;
  (void)follow_recipe(recipe("best"), *boxes, parameters);
  EXPECT_EQ(parameters.guard, GuardRule{}) << "which is in force for another metric";
}

}  // namespace
}  // namespace dmoscope
