// Promises 1 to 3 of the methods beside dmo: all three for those that optimise, for the others those that always hold.

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/smooth/execution/method_table.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using testing::Cells;
using testing::expect_fixed_stay;
using testing::expect_promise_one;
using testing::input;
using testing::kBudget;
using testing::lattice;
using testing::make_run;
using testing::Specimen;

std::vector<MethodInfo> others() {
  std::vector<MethodInfo> methods;
  for (const MethodInfo& method : method_table())
    if (method.name != "dmo") methods.push_back(method);
  return methods;
}

RunParameters parameters_of(const MethodInfo& method, Metric metric = Metric::MeanRatio) {
  RunParameters parameters;
  parameters.method = method.name;
  parameters.metric = metric;
  return parameters;
}

std::vector<MethodInfo> others_of_any_metric() {
  std::vector<MethodInfo> methods = others();
  std::erase_if(methods, [](const MethodInfo& method) { return !method.optimises; });
  return methods;
}

std::string name_of(const ::testing::TestParamInfo<MethodInfo>& tested) {
  std::string name(tested.param.name);
  std::erase(name, '-');
  return name;
}

class Methods : public ::testing::TestWithParam<MethodInfo> {};
class MethodsOfAnyMetric : public Methods {};

TEST_P(Methods, KeepTheirPromisesOnEveryMeshWithTheSameBitsForAnyStepsAndThreads) {
  constexpr std::uint64_t kIterations = 3;
  Progress progress;
  for (const Specimen& specimen : testing::zoo()) {
    const auto mesh = input(specimen.mesh);
    RunParameters parameters = parameters_of(GetParam());
    for (Index v = 3; v < mesh->mesh.vertex_count(); v += 37) parameters.fixed.push_back(v);

    dmoscope::Run by_class = make_run(mesh, parameters);
    if (GetParam().optimises) {
      expect_promise_one(specimen, by_class, kIterations);
    } else {
      while (by_class.moment().iteration < kIterations) by_class.step(StepUnit::Class, progress);
    }
    expect_fixed_stay(specimen, by_class);
    EXPECT_GT(by_class.history().records()[1].moved, 0U) << specimen.name;
    for (const Vec3 p : by_class.positions()) {
      EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << specimen.name;
    }

    dmoscope::Run by_iteration = make_run(mesh, parameters, 3);
    by_iteration.iterate(kIterations, progress);
    EXPECT_TRUE(same_bits(by_class.positions(), by_iteration.positions())) << specimen.name << ", threads";

    dmoscope::Run by_vertex = make_run(mesh, parameters);
    while (by_vertex.moment().iteration < kIterations) by_vertex.step(StepUnit::Vertex, progress);
    EXPECT_TRUE(same_bits(by_class.positions(), by_vertex.positions())) << specimen.name << ", by vertex";
  }
}

TEST_P(MethodsOfAnyMetric, KeepTheirPromises) {
  for (const Metric metric : testing::all_metrics())
    for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed})
      for (const double jitter : {0.25, 0.9}) {  // valid, tangled
        const Specimen specimen{std::string(info(metric).name), lattice(10, jitter, 51, cells)};
        if (!testing::defined_for_all(metric, specimen.mesh)) continue;
        if (!testing::can_optimise(GetParam(), metric, *input(specimen.mesh))) continue;
        RunParameters parameters = parameters_of(GetParam(), metric);
        parameters.fixed = {40, 41, 80};
        dmoscope::Run run = make_run(input(specimen.mesh), parameters);
        expect_promise_one(specimen, run, 3);
        expect_fixed_stay(specimen, run);
        EXPECT_GT(run.history().records()[1].moved, 0U);
      }
}

TEST_P(Methods, GiveTheSameBitsWhereClassesAreLargeForAnyNumberOfThreads) {
  const auto mesh = input(lattice(60, 0.45, 52, Cells::Mixed));
  Progress progress;
  dmoscope::Run one = make_run(mesh, parameters_of(GetParam()), 1);
  ASSERT_GT(one.colouring().members(0).size(), 600U) << "or there is nothing to share";
  one.iterate(3, progress);
  for (const unsigned threads : {2U, 5U}) {
    dmoscope::Run many = make_run(mesh, parameters_of(GetParam()), threads);
    many.iterate(3, progress);
    EXPECT_TRUE(same_bits(one.positions(), many.positions())) << threads;
  }
}

TEST_P(Methods, ReachTheSameBitsAgainByWhateverWay) {
  const auto mesh = input(lattice(10, 0.4, 53));
  Progress progress;
  // Without memory for its history the run computes everything again.
  dmoscope::Run run(mesh, parameters_of(GetParam()), std::make_shared<ThreadPool>(1), 0);
  std::vector<std::vector<Vec3>> after;
  for (int i = 0; i < 6; ++i) {
    after.emplace_back(run.positions().begin(), run.positions().end());
    run.step(StepUnit::Iteration, progress);
  }
  run.step(StepUnit::Class, progress);
  const std::vector<Vec3> midst(run.positions().begin(), run.positions().end());
  const Moment there = run.moment();
  for (const std::uint64_t iteration : {4U, 1U, 5U, 0U, 2U}) {
    run.seek({iteration}, progress);
    EXPECT_TRUE(same_bits(run.positions(), after[iteration])) << iteration;
    run.seek(there, progress);
    EXPECT_TRUE(same_bits(run.positions(), midst)) << iteration;
  }
}

TEST_P(Methods, AreTheSameInEverySizeAndPlaceAndPlane) {
  const Mesh base = lattice(8, 0.3, 54);
  constexpr std::uint64_t kIterations = 4;
  constexpr double kTolerance = 1e-4;  // active-set ends when there is little to gain, in units of a power of two
  Progress progress;
  const auto minimum = [&](const Mesh& mesh) {
    dmoscope::Run run = make_run(input(mesh), parameters_of(GetParam()));
    run.iterate(kIterations, progress);
    EXPECT_EQ(run.statistics().inverted, 0U);
    return run.statistics().minimum;
  };
  const double expected = minimum(base);
  for (const double scale : {1e-5, 1e4, 1e-30, 1e30})
    EXPECT_NEAR(minimum(testing::mapped(base, [&](Vec3 p) { return scale * p; })), expected, kTolerance) << scale;
  EXPECT_NEAR(minimum(testing::mapped(base, [](Vec3 p) { return p + Vec3{1e6, 1e6, 0}; })), expected, kTolerance);
  EXPECT_NEAR(minimum(testing::mapped(base, [](Vec3 p) { return Vec3{-5, p.x, p.y}; })), expected, kTolerance);
}

INSTANTIATE_TEST_SUITE_P(Others, Methods, ::testing::ValuesIn(others()), name_of);
INSTANTIATE_TEST_SUITE_P(Others, MethodsOfAnyMetric, ::testing::ValuesIn(others_of_any_metric()), name_of);

}  // namespace
}  // namespace dmoscope
