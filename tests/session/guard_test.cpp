// The guard: the least of the guarded metric never falls further, for any raised metric and any method.

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/run/run.h"
#include "core/smooth/composite_objective.h"
#include "core/smooth/execution/method_table.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using test::volume_grid;
using testing::Cells;
using testing::input;
using testing::lattice;

dmoscope::Run make_run(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters) {
  return {mesh, std::move(parameters), std::make_shared<ThreadPool>(2), 0};
}

double least(const dmoscope::Run& run, Metric metric) {
  return compute_statistics(run.input().quality_context(), run.positions(), metric, run.immovable(), nullptr).movable_minimum;
}

/// A lattice stretched so that the scaled Jacobian, which does not depend on an element's length, lets elements collapse.
Mesh stretched(Cells cells, std::uint64_t seed) {
  Mesh mesh = lattice(10, 0.35, seed, cells);
  for (Vec3& p : mesh.positions) p.y *= 0.3;
  return mesh;
}

TEST(Guard, KeepsTheMeanRatioByEveryMethod) {
  Progress progress;
  int fell = 0, rose = 0;
  for (const MethodInfo& method : method_table()) {
    if (!method.optimises) continue;
    for (const Cells cells : {Cells::Quadrilaterals, Cells::Mixed})
      for (const std::uint64_t seed : {3U, 4U, 5U}) {
        const auto mesh = input(stretched(cells, seed));
        RunParameters parameters{.method = std::string(method.name), .metric = Metric::ScaledJacobian, .guard = std::nullopt};
        dmoscope::Run off = make_run(mesh, parameters);
        parameters.guard = GuardRule{};
        dmoscope::Run on = make_run(mesh, parameters);
        const double before = least(on, Metric::MeanRatio), metric_before = least(on, Metric::ScaledJacobian);
        off.iterate(30, progress);
        ASSERT_TRUE(on.guard());
        for (int iteration = 1; iteration <= 30; ++iteration) {
          on.iterate(1, progress);
          ASSERT_GE(least(on, Metric::MeanRatio), before) << method.name << ", iteration " << iteration;
        }
        EXPECT_GE(least(on, Metric::ScaledJacobian), metric_before) << method.name;
        fell += least(off, Metric::MeanRatio) < before ? 1 : 0;
        rose += least(on, Metric::ScaledJacobian) > metric_before ? 1 : 0;
      }
  }
  EXPECT_GT(fell, 5) << "else there is nothing to guard";
  EXPECT_GT(rose, 20) << "a guard is no reason to stay";
}

TEST(Guard, KeepsItInVolumesAndWhereVerticesSlide) {
  Progress progress;
  int fell = 0;
  for (const BoundaryRule boundary : {BoundaryRule::Fixed, BoundaryRule::Slide})
    for (const unsigned seed : {1U, 2U, 3U}) {
      Mesh grid = volume_grid(4, test::Fill::Hexahedra, 0.3, seed);
      for (Vec3& p : grid.positions) p.z *= 0.25;
      const auto mesh = input(std::move(grid));
      RunParameters parameters{.metric = Metric::ScaledJacobian, .guard = std::nullopt, .boundary = boundary};
      dmoscope::Run off = make_run(mesh, parameters);
      parameters.guard = GuardRule{};
      dmoscope::Run on = make_run(mesh, parameters);
      if (on.statistics().inverted > 0) continue;
      const double before = least(on, Metric::MeanRatio);
      off.iterate(15, progress);
      for (int iteration = 1; iteration <= 15; ++iteration) {
        on.iterate(1, progress);
        ASSERT_GE(least(on, Metric::MeanRatio), before) << "iteration " << iteration;
      }
      fell += least(off, Metric::MeanRatio) < before ? 1 : 0;
    }
  EXPECT_GT(fell, 0);
}

/// A tangled mesh guards the least of its sound elements: what was sound keeps it, and what is untangled below it falls no further.
TEST(Guard, KeepsTheLeastOfTheSoundOnesInATangledMesh) {
  Progress progress;
  int fell = 0;
  for (const std::uint64_t seed : {3U, 4U, 5U, 6U}) {
    Mesh mesh = stretched(Cells::Quadrilaterals, seed);
    for (const Index v : {36U, 62U, 84U}) std::swap(mesh.positions[v], mesh.positions[v + 1]);
    const auto tangled = input(std::move(mesh));
    double floor = 1.0;
    for (Index e = 0; e < tangled->mesh.elements.size(); ++e)
      if (const double q = element_quality(tangled->quality_context(), tangled->mesh.positions, Metric::MeanRatio, e); q > 0.0)
        floor = std::min(floor, q);
    RunParameters parameters{.metric = Metric::ScaledJacobian, .guard = std::nullopt};
    dmoscope::Run off = make_run(tangled, parameters);
    parameters.guard = GuardRule{};
    dmoscope::Run on = make_run(tangled, parameters);
    ASSERT_GT(on.statistics().inverted, 0U);
    ASSERT_TRUE(on.guard());
    EXPECT_EQ(on.guard()->floor, floor);
    while (on.statistics().inverted > 0 && on.moment().iteration < 10) on.iterate(1, progress);
    ASSERT_EQ(on.statistics().inverted, 0U);
    const double kept = std::min(floor, least(on, Metric::MeanRatio));
    for (int iteration = 1; iteration <= 30; ++iteration) {
      on.iterate(1, progress);
      ASSERT_GE(least(on, Metric::MeanRatio), kept) << "iteration " << iteration;
    }
    off.iterate(40, progress);
    fell += least(off, Metric::MeanRatio) < kept ? 1 : 0;
  }
  EXPECT_GT(fell, 0) << "else there is nothing to guard";
}

/// Joint moves by two aims make no more of a way than the guard lets them.
TEST(Guard, KeepsItWhereTwoAimsMoveJointly) {
  Progress progress;
  int fell = 0;
  for (const std::uint64_t seed : {3U, 4U, 5U, 6U}) {
    Mesh flat = lattice(6, 0.35, seed, Cells::Quadrilaterals);
    for (Vec3& p : flat.positions) p.y *= 0.03;
    const auto mesh = input(std::move(flat));
    RunParameters parameters{
        .method = "joint", .metric = Metric::ScaledJacobian, .combination = CompositeTerms{0.9, Metric::Condition}, .guard = std::nullopt};
    dmoscope::Run off = make_run(mesh, parameters);
    off.iterate(10, progress);
    parameters.guard = GuardRule{};
    dmoscope::Run on = make_run(mesh, parameters);
    const double before = least(on, Metric::MeanRatio), first_before = least(on, Metric::ScaledJacobian);
    on.iterate(10, progress);
    EXPECT_GE(least(on, Metric::MeanRatio), before);
    EXPECT_GE(least(on, Metric::ScaledJacobian), first_before);
    fell += least(off, Metric::MeanRatio) < before ? 1 : 0;
  }
  EXPECT_GT(fell, 0) << "else the guard has nothing to do";
}

TEST(Guard, ByAValueIsReachedByNoneThatWasAboveIt) {
  Progress progress;
  const auto mesh = input(stretched(Cells::Quadrilaterals, 3));
  const double before = least(make_run(mesh, {}), Metric::MeanRatio), floor = 0.7 * before;
  dmoscope::Run run = make_run(mesh, {.metric = Metric::ScaledJacobian, .guard = GuardRule{Metric::MeanRatio, floor}});
  run.iterate(30, progress);
  EXPECT_GE(least(run, Metric::MeanRatio), floor);
}

TEST(Guard, ChangesNothingWhereItIsNotReached) {
  Progress progress;
  std::vector<std::shared_ptr<const InputMesh>> meshes{input(lattice(10, 0.3, 7)), input(lattice(10, 0.3, 7, Cells::Mixed))};
  for (const auto fill : {test::Fill::Tetrahedra, test::Fill::Hexahedra}) meshes.push_back(input(volume_grid(4, fill, 0.2, 2)));
  for (const auto& mesh : meshes)
    for (const Metric metric : {Metric::ScaledJacobian, mesh->is_volume() ? Metric::Condition : Metric::MeanRatioArea}) {
      RunParameters parameters{.metric = metric, .guard = std::nullopt};
      dmoscope::Run off = make_run(mesh, parameters);
      parameters.guard = GuardRule{Metric::MeanRatio, 1e-6};
      dmoscope::Run on = make_run(mesh, parameters);
      off.iterate(5, progress);
      on.iterate(5, progress);
      ASSERT_GT(least(off, Metric::MeanRatio), 1e-3);
      EXPECT_TRUE(std::ranges::equal(on.positions(), off.positions()));
      EXPECT_FALSE(std::ranges::equal(on.positions(), mesh->mesh.positions));
    }
}

TEST(Guard, SaysNothingOfTheMetricThatIsRaisedNorOfTargets) {
  const auto mesh = input(lattice(5, 0.2, 1));
  EXPECT_FALSE(make_run(mesh, {}).guard());
  EXPECT_TRUE(make_run(mesh, {.metric = Metric::MinAngle}).guard());
  EXPECT_FALSE(make_run(mesh, {.metric = parse_metric("mean-ratio@aspect:3:0")}).guard());
}

TEST(Guard, IsWrittenAsItIsRead) {
  for (const char* text : {"off", "mean-ratio:input", "scaled-jacobian:0.25"}) EXPECT_EQ(to_text(parse_guard(text)), text);
  for (const char* text : {"", "mean-ratio", "mean-ratio:much", "nothing:input", "mean-ratio:inf"})
    EXPECT_THROW((void)parse_guard(text), UsageError) << text;
}

}  // namespace
}  // namespace dmoscope
