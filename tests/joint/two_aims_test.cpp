// Joint moves by two aims: the first metric up to its threshold, and then the second, with the first kept beyond it.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/inspect/joint_hold.h"
#include "tests/smooth/surface_judge.h"
#include "tests/smooth/surface_zoo.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using namespace testing;
using ::testing::HasSubstr;

RunParameters two_aims(std::string_view combination, const char* method = "joint") {
  RunParameters parameters;
  parameters.method = method;
  std::tie(parameters.metric, parameters.combination) = parse_composite(combination);
  return parameters;
}

/// Least of both metrics among elements that can move.
struct Leasts {
  double first, second;
};
Leasts leasts(const dmoscope::Run& run) {
  const auto least = [&](Metric metric) {
    return compute_statistics(run.input().quality_context(), run.positions(), metric, run.immovable(), nullptr).movable_minimum;
  };
  return {least(run.parameters().metric), least(std::get<Metric>(run.parameters().combination->second))};
}

dmoscope::Run converged(const std::shared_ptr<const InputMesh>& mesh, const RunParameters& parameters, unsigned threads = 1) {
  dmoscope::Run run = testing::make_run(mesh, parameters, threads);
  Progress progress;
  run.until_converged({.patience = 100}, progress);
  return run;
}

struct Case {
  std::string name;
  Mesh mesh;
  const char* combination;
};
std::vector<Case> cases() {
  return {{"triangles", lattice(9, 0.35, 4), "mean-ratio:0.5:min-angle"},
          {"triangles, by a formula", lattice(9, 0.35, 4), "min-angle:0.4:formula:2*det/norm^2"},
          {"triangles, a formula first", lattice(9, 0.35, 4), "formula:2*det/norm^2:0.5:min-angle"},
          {"quadrilaterals", lattice(8, 0.35, 6, Cells::Quadrilaterals), "mean-ratio:0.6:scaled-jacobian"},
          {"both", lattice(8, 0.3, 7, Cells::Mixed), "scaled-jacobian:0.5:mean-ratio"},
          {"tetrahedra", test::volume_grid(4, test::Fill::Tetrahedra, 0.3, 2), "mean-ratio:0.45:min-angle"},
          {"hexahedra", test::volume_grid(4, test::Fill::Hexahedra, 0.3, 3), "scaled-jacobian:0.8:mean-ratio"}};
}

/// Compares, in the order of the two aims, with what single vertices reach; on the way neither the first falls back, nor the second.
TEST(JointByTwoAims, GetsAtLeastAsFarAsSingleVertices) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const auto mesh = testing::input(one.mesh);
    const Leasts alone = leasts(converged(mesh, two_aims(one.combination, "dmo")));
    dmoscope::Run run = testing::make_run(mesh, two_aims(one.combination));
    const double threshold = run.parameters().combination->threshold;
    Progress progress;
    Leasts before = leasts(run);
    bool turned = false;
    for (int iteration = 0; iteration < 80; ++iteration) {
      run.iterate(1, progress);
      const auto& record = run.history().records().back();
      const Leasts now = leasts(run);
      EXPECT_EQ(record.statistics.inverted, 0U);
      if (before.first > threshold) {
        EXPECT_GT(now.first, threshold) << iteration;
        if (turned) {
          EXPECT_GE(now.second, before.second) << iteration;
        }
      } else {
        EXPECT_GE(now.first, before.first) << iteration;
      }
      turned = turned || record.joint->beyond;
      before = now;
      if (record.joint->end != JointState::End::None) break;
    }
    EXPECT_TRUE(turned);
    EXPECT_GT(before.first, threshold);
    EXPECT_GE(std::min(before.first, threshold), std::min(alone.first, threshold));
    if (alone.first > threshold) {
      EXPECT_GE(before.second, alone.second * (1.0 - 5e-4));
    }
  }
}

/// Moves one vertex in a star: where the second metric alone would bring the first below its threshold, it finds the best place beyond it,
/// as a fine net of places does.
TEST(JointByTwoAims, ReachesTheBestPlaceBeyondTheThreshold) {
  int bound = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto mesh = testing::input(stars({{3, 3, 3, 3, 3, 3}}, seed));
    const QualityContext context = mesh->quality_context();
    std::vector<Vec3> positions = mesh->mesh.positions;
    const auto least = [&](Metric metric, Vec3 place) {
      positions[0] = place;
      return compute_statistics(context, positions, metric, std::span<const Index>(), nullptr).minimum;
    };
    // Finds the best place of a net around one, finer and finer.
    const auto best = [&](const auto& worth) {
      Vec3 middle{};
      double width = 1.6, most = -std::numeric_limits<double>::infinity();
      for (int round = 0; round < 7; ++round, width *= 0.25) {
        const Vec3 around = middle;
        for (int i = -16; i <= 16; ++i)
          for (int j = -16; j <= 16; ++j) {
            const Vec3 place = around + Vec3{width * i / 32, width * j / 32, 0};
            if (const double value = worth(place); value > most) most = value, middle = place;
          }
      }
      return std::pair(most, middle);
    };
    const auto [most_first, there] = best([&](Vec3 p) { return least(Metric::MeanRatio, p); });
    const auto [most_second, elsewhere] = best([&](Vec3 p) { return least(Metric::MinAngle, p); });
    const double first_there = least(Metric::MeanRatio, elsewhere);
    const double threshold = 0.5 * (first_there + most_first);
    const double wanted = best([&](Vec3 p) {
                            const double first = least(Metric::MeanRatio, p);
                            return first > threshold ? 1.0 + least(Metric::MinAngle, p) : first - 1.0;
                          }).first -
                          1.0;
    dmoscope::Run run = converged(mesh, two_aims(fmt::format("mean-ratio:{}:min-angle", threshold)));
    const Leasts reached = leasts(run);
    EXPECT_GT(reached.first, threshold) << seed;
    EXPECT_GE(reached.second, wanted - 1e-3) << seed;
    EXPECT_LE(reached.second, wanted + 2e-4) << seed;
    bound += wanted < most_second - 2e-3 ? 1 : 0;
  }
  EXPECT_GE(bound, 3);  // the threshold counted
}

/// Uses displaced six-sided cells: only the equilateral lattice has the best of both.
TEST(JointByTwoAims, ReachesTheLatticeThatHasTheBestOfBoth) {
  Mesh mesh;
  testing::Random random(3);
  constexpr Index kCells = 7;
  for (Index j = 0; j <= kCells; ++j)
    for (Index i = 0; i <= kCells; ++i) {
      const bool inside = i > 0 && j > 0 && i < kCells && j < kCells;
      const double dx = inside ? random(-0.3, 0.3) : 0.0, dy = inside ? random(-0.3, 0.3) : 0.0;
      mesh.positions.push_back({i + 0.5 * j + dx, (j + dy) * std::sqrt(0.75), 0.0});
    }
  for (Index j = 0; j < kCells; ++j)
    for (Index i = 0; i < kCells; ++i) {
      const Index a = j * (kCells + 1) + i, d = a + kCells + 1;
      testing::add(mesh, {a, a + 1, d});
      testing::add(mesh, {a + 1, d + 1, d});
    }
  const Leasts reached = leasts(converged(testing::input(mesh), two_aims("mean-ratio:0.8:min-angle")));
  EXPECT_GT(reached.second, 1.0 - 1e-3);
  EXPECT_GT(reached.first, 1.0 - 1e-3);
}

TEST(JointByTwoAims, TheSameBitsByAnyNumberOfThreads) {
  for (const Case& one : cases()) {
    const auto mesh = testing::input(one.mesh);
    EXPECT_TRUE(
        same_bits(converged(mesh, two_aims(one.combination), 1).positions(), converged(mesh, two_aims(one.combination), 4).positions()))
        << one.name;
  }
}

/// Checks that a threshold that nothing is at or below is none, and that one that is never reached leaves the first metric alone.
TEST(JointByTwoAims, WhereOneAimAloneCountsItIsThatAim) {
  const auto mesh = testing::input(lattice(9, 0.35, 4));
  const auto alone = [&](Metric metric) {
    RunParameters parameters{.method = "joint", .metric = metric};
    return converged(mesh, parameters).statistics().movable_minimum;
  };
  EXPECT_NEAR(leasts(converged(mesh, two_aims("mean-ratio:0.01:min-angle"))).second, alone(Metric::MinAngle),
              1e-3 * alone(Metric::MinAngle));
  EXPECT_NEAR(leasts(converged(mesh, two_aims("mean-ratio:0.99:min-angle"))).first, alone(Metric::MeanRatio),
              1e-3 * alone(Metric::MeanRatio));
}

TEST(JointByTwoAims, KeepsToASurface) {
  const Specimen can{"can", wound(20, 6, false, false, 5, Cells::Triangles, on_cylinder)};
  const auto mesh = testing::input(can.mesh);
  RunParameters parameters = two_aims("mean-ratio:0.4:min-angle");
  parameters.boundary = BoundaryRule::Slide;
  parameters.max_deviation = 0.02;
  const Leasts before = leasts(testing::make_run(mesh, parameters));
  const dmoscope::Run run = converged(mesh, parameters);
  EXPECT_GT(leasts(run).first, 0.4);
  EXPECT_GT(leasts(run).second, before.second);
  EXPECT_EQ(run.statistics().inverted, 0U);
  SurfaceJudge(can, *mesh, parameters.max_deviation).expect_kept(run);
}

TEST(JointByTwoAims, TheCertificateSaysWhichAimItIsAbout) {
  const auto mesh = testing::input(lattice(9, 0.35, 4));
  const auto told = [&](const char* combination) {
    const RunParameters parameters = two_aims(combination);
    const dmoscope::Run run = converged(mesh, parameters);
    Progress progress;
    const auto cluster =
        joint_hold(*mesh, run.positions(), run.fixed(), {}, {parameters.metric, parameters.combination}, 0, nullptr, progress, {});
    EXPECT_TRUE(cluster);
    return cluster ? certificate_sentence(*cluster) : std::string();
  };
  EXPECT_THAT(told("mean-ratio:0.5:min-angle"), HasSubstr("no joint move raises the least min-angle and keeps mean-ratio above 0.5"));
  EXPECT_THAT(told("mean-ratio:0.99:min-angle"), HasSubstr("no joint move raises the least mean-ratio, to first order"));
}

TEST(JointByTwoAims, DensityIsRefusedInWords) {
  const auto mesh = testing::input(lattice(4, 0.1, 4));
  try {
    (void)testing::make_run(mesh, two_aims("mean-ratio:0.5:density"));
    ADD_FAILURE() << "it was not refused";
  } catch (const UsageError& error) {
    EXPECT_STREQ(error.what(), "joint moves raise the least of something over all elements, and a density is none");
  }
}

}  // namespace
}  // namespace dmoscope
