// The paper's claims about DMO and the methods it is compared with (Sections 5.1, 5.3 and 5.4), on the paper's own meshes if they are
// there, and on generated ones; the figures expected of other methods were computed apart.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/run/run.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

using Input = std::shared_ptr<const InputMesh>;

Input real_mesh(const std::string& name) {
  const std::filesystem::path path = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes" / name;
  Progress progress;
  return std::filesystem::exists(path) ? load_input(path, Need::Smoothing, {progress}) : nullptr;
}

Input stand_in(const std::string& words) {
  Progress progress;
  return generate_input(words, progress);
}

#define REQUIRE_MESH(mesh, name)      \
  const Input mesh = real_mesh(name); \
  if (!mesh) GTEST_SKIP() << "the shared meshes are not here"

dmoscope::Run smoothed(const Input& input, RunParameters parameters, std::uint64_t iterations) {
  Progress progress;
  parameters.backend = Backend::Cpu;
  dmoscope::Run run(input, std::move(parameters), std::make_shared<ThreadPool>(2), 0);
  run.iterate(iterations, progress);
  return run;
}

double minimum_after(const dmoscope::Run& run, std::uint64_t iteration) { return run.history().records().at(iteration).statistics.minimum; }
double minimum(const Input& input, const char* method, std::uint64_t iterations) {
  return smoothed(input, {.method = method}, iterations).statistics().minimum;
}

/// The first iteration after which the minimum is at least this.
std::uint64_t reaches(const dmoscope::Run& run, double wanted) {
  const auto& records = run.history().records();
  const auto found = std::ranges::find_if(records, [&](const IterationRecord& r) { return r.statistics.minimum >= wanted; });
  return static_cast<std::uint64_t>(found - records.begin());
}

std::vector<double> sorted_qualities(const dmoscope::Run& run) {
  std::vector<double> qualities(run.input().mesh.elements.size());
  element_qualities(run.input().quality_context(), run.positions(), Metric::MeanRatio, nullptr, qualities);
  std::sort(qualities.begin(), qualities.end());
  return qualities;
}

TEST(Paper, OnEastDmoConvergesAtOnceAndOthersLaterOrNever) {
  REQUIRE_MESH(east, "ocean/east.14");
  const dmoscope::Run dmo = smoothed(east, {}, 10);
  EXPECT_NEAR(minimum_after(dmo, 0), 0.65, 0.005);
  EXPECT_GE(minimum_after(dmo, 4), 0.812) << "within 4 iterations";
  EXPECT_NEAR(minimum_after(dmo, 2), minimum_after(dmo, 10), 1e-3) << "Fig. 4a: after two";
  const dmoscope::Run dvr = smoothed(east, {.method = "dvr"}, 10);
  EXPECT_GE(minimum_after(dvr, 10), 0.79);
  EXPECT_GT(reaches(dvr, minimum_after(dmo, 2) - 1e-3), 2U) << "later than DMO";
  EXPECT_NEAR(minimum(east, "laplace", 10), 0.653, 0.01);
  EXPECT_NEAR(minimum(east, "angle-based", 10), 0.58, 0.02);
}

TEST(Paper, OnBahamasEveryMethodGetsWhereItIsKnownToGet) {
  REQUIRE_MESH(bahamas, "ocean/bahamas.14");
  EXPECT_GE(minimum(bahamas, "dmo", 50), 0.765);
  EXPECT_GE(minimum(bahamas, "dvr", 50), 0.76);
  EXPECT_NEAR(minimum(bahamas, "smart-laplace", 50), 0.75, 0.02);
  EXPECT_NEAR(minimum(bahamas, "laplace", 50), 0.57, 0.03);
  EXPECT_NEAR(minimum(bahamas, "angle-based", 50), 0.67, 0.03);
}

TEST(Paper, OnShashkovDvrTakesManyTimesAsManyIterations) {
  REQUIRE_MESH(shashkov, "tri/shashkov.vtk");
  const dmoscope::Run dmo = smoothed(shashkov, {}, 2000), dvr = smoothed(shashkov, {.method = "dvr"}, 2000);
  EXPECT_GE(minimum_after(dmo, 2000), 0.19);
  EXPECT_NEAR(minimum_after(dmo, 1400), minimum_after(dmo, 2000), 1e-3) << "converged within about 1400";
  const double reached = minimum_after(dvr, 2000);
  EXPECT_LT(reached, 0.19);
  EXPECT_LE(reaches(dmo, reached), 2000U / 7U) << "10000 over 1400 in the paper";
  EXPECT_GT(reaches(dvr, reached), 1500U) << "it is still rising";
}

TEST(Paper, TheSecondPhaseRaisesTheMeanAndKeepsTheMinimum) {
  for (const auto& [name, mean] : {std::pair{"ocean/east.14", 0.953}, {"ocean/bahamas.14", 0.978}}) {
    REQUIRE_MESH(mesh, name);
    if (testing::kSanitized && mesh->mesh.vertex_count() > 5000) continue;
    const Statistics plain = smoothed(mesh, {}, 60).statistics();
    const Statistics raised = smoothed(mesh, {.then_mean = PhaseBegin{.patience = 5}}, 60).statistics();
    EXPECT_GE(raised.minimum, plain.minimum - 0.001) << name;
    EXPECT_GE(raised.mean, mean) << name;
  }
}

TEST(Paper, OnBlocksDmoIsFarAheadOfDvrAndLaplaceIsUnstable) {
  const Input blocks = stand_in("block 10000 1");
  const dmoscope::Run dmo = smoothed(blocks, {}, 60), dvr = smoothed(blocks, {.method = "dvr"}, 60);
  EXPECT_LE(2 * reaches(dmo, minimum_after(dvr, 60)), reaches(dvr, minimum_after(dvr, 60)));
  const Statistics laplace = smoothed(blocks, {.method = "laplace"}, 60).statistics();
  EXPECT_LT(laplace.minimum, 0.5 * minimum_after(dmo, 60));
}

TEST(Paper, EveryMetricOfTheFiguresConverges) {
  const Input blocks = stand_in("block 2500 1");
  for (const Metric metric : {Metric::Rectangularity, Metric::RadiusRatio, Metric::MaxAngle, Metric::MinAngle}) {
    const dmoscope::Run run = smoothed(blocks, {.metric = metric}, 50);
    const double rise = minimum_after(run, 50) - minimum_after(run, 0);
    EXPECT_GT(rise, 0.3) << info(metric).name;
    EXPECT_GT(minimum_after(run, 20) - minimum_after(run, 0), 0.7 * rise) << info(metric).name;
  }
  const dmoscope::Run quads = smoothed(stand_in("quads 2000 1"), {.metric = Metric::MeanRatioArea}, 20);
  EXPECT_GT(minimum_after(quads, 20), minimum_after(quads, 0) + 0.4);
}

TEST(Paper, OnTireTheMinimumRisesToItsCeilingAndTheMovableElementsFarAbove) {
  REQUIRE_MESH(tire, "tet/tire.vtk");
  const dmoscope::Run run = smoothed(tire, {}, 10);
  EXPECT_NEAR(minimum_after(run, 0), 0.044167, 1e-6);
  EXPECT_NEAR(minimum_after(run, 10), 0.1637, 1e-4);
  EXPECT_GE(run.statistics().movable_minimum, 0.36);
}

TEST(Paper, TheOrderMattersLittleOnGoodMeshesAndMuchOnRandomOnes) {
  const auto spread = [](const Input& input) {
    std::vector<double> low, high;
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      RunParameters parameters;
      if (seed > 0) parameters.order.seed = seed;
      const std::vector<double> qualities = sorted_qualities(smoothed(input, parameters, 20));
      if (seed == 0) low = high = qualities;
      for (std::size_t i = 0; i < qualities.size(); ++i) {
        low[i] = std::min(low[i], qualities[i]);
        high[i] = std::max(high[i], qualities[i]);
      }
    }
    double widest = 0.0;
    for (std::size_t i = 0; i < low.size(); ++i) widest = std::max(widest, high[i] - low[i]);
    return widest;
  };
  const double good = spread(stand_in("coast 3000 1")), random = spread(stand_in("random 100 1"));
  EXPECT_LT(good, 0.05) << "Fig. 10: the lines mostly overlap";
  EXPECT_GT(random, 0.05) << "Fig. 11";
  EXPECT_GT(random, 2.0 * good);
}

TEST(Paper, DensityFollowsTheSizeFunctionAboveTheThreshold) {
  const Input bahamas = real_mesh("ocean/bahamas.14");
  const Input mesh = bahamas ? bahamas : stand_in("annulus 1000 1");
  const Vec3 point = mesh->mesh.positions[mesh->mesh.vertex_count() / 2];
  const auto mean_edge_near = [&](std::span<const Vec3> positions, bool near) {
    // The mean over the elements that are nearer to the point than most, or further.
    std::vector<std::pair<double, double>> all;
    const auto length = [](const Vec3& d) { return std::sqrt(dot(d, d)); };
    for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
      const auto c = mesh->mesh.elements.corners(e);
      const Vec3 &a = positions[c[0]], &b = positions[c[1]], &d = positions[c[2]];
      all.emplace_back(length((1.0 / 3.0) * (a + b + d) - point), length(a - b) + length(b - d) + length(d - a));
    }
    std::sort(all.begin(), all.end());
    if (!near) std::reverse(all.begin(), all.end());
    double sum = 0.0;
    for (std::size_t i = 0; i < all.size() / 4; ++i) sum += all[i].second;
    return sum;
  };
  const auto ratio = [&](std::span<const Vec3> positions) { return mean_edge_near(positions, true) / mean_edge_near(positions, false); };
  const double before = ratio(mesh->mesh.positions);
  for (const auto kind : {SizeFunction::Kind::Distance, SizeFunction::Kind::InverseDistance}) {
    const dmoscope::Run run = smoothed(mesh, {.combination = CompositeTerms{0.7, SizeFunction{.kind = kind, .point = point}}}, 40);
    EXPECT_GE(run.statistics().minimum, std::min(0.7, minimum_after(run, 0)) - 1e-9);
    if (kind == SizeFunction::Kind::Distance) {
      EXPECT_LT(ratio(run.positions()), 0.97 * before) << "h1: finer near the point";
    } else {
      EXPECT_GT(ratio(run.positions()), 1.03 * before) << "h2: coarser near it";
    }
  }
}

}  // namespace
}  // namespace dmoscope
