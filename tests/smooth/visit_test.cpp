// Every method with every objective on every kind of place: properties of each combination.

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "core/quality/defined_metric.h"
#include "core/smooth/methods/dvr.h"
#include "core/smooth/visit/defined_pieces.h"
#include "tests/smooth/promises.h"
#include "tests/support/plain_surface.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {
namespace {

std::shared_ptr<const InputMesh> sample(std::string_view kind, std::size_t size) {
  Progress progress;
  return input(generate_mesh(kind, size, 3, progress));
}

/// The least and the mean of a metric, and the number of inverted elements.
Statistics judged(const InputMesh& mesh, std::span<const Vec3> positions, Metric metric) {
  return compute_statistics(mesh.quality_context(), positions, metric, std::span<const Index>(), nullptr);
}

constexpr const char* kOptimisers[] = {"dmo", "smart-laplace", "dvr", "pattern-search", "active-set"};
constexpr const char* kSamples[] = {"random", "quads", "mixed", "can", "tetrahedra", "hexahedra", "solids"};

/// No visit lowers its star's first metric below its old value or the threshold, nor the second if the first is beyond the threshold and
/// stays.
TEST(TwoAims, NoVisitOfAnyMethodGivesUpTheFirst) {
  constexpr double kThreshold = 0.45;
  constexpr Metric kFirst = Metric::MeanRatio, kSecond = Metric::ScaledJacobian;
  Progress progress;
  for (const char* kind : kSamples)
    for (const char* method : kOptimisers)
      for (const BoundaryRule boundary : {BoundaryRule::Fixed, BoundaryRule::Slide}) {
        const auto mesh = sample(kind, 60);
        dmoscope::Run run =
            make_run(mesh, {.method = method, .metric = kFirst, .combination = CompositeTerms{kThreshold, kSecond}, .boundary = boundary});
        const std::string what = fmt::format("{} on {}, boundary {}", method, kind, name(boundary));
        std::size_t moved = 0;
        for (int iteration = 0; iteration < 2; ++iteration) {
          const std::vector<Index> order = run.colouring().order;
          for (const Index v : order) {
            const Vec3 old = run.positions()[v];
            const auto state = [&](Metric metric) { return star_state(*mesh, run.positions(), metric, v); };
            const StarState first = state(kFirst), second = state(kSecond);
            run.step(StepUnit::Vertex, progress);
            if (run.positions()[v] == old) continue;
            ++moved;
            if (!(first.jacobian > 0.0)) continue;
            const StarState now = state(kFirst);
            ASSERT_GT(now.jacobian, 0.0) << what;
            if (first.quality <= kThreshold) {
              ASSERT_GT(now.quality, first.quality) << what;
            } else {
              ASSERT_GT(now.quality, kThreshold) << what;
              ASSERT_GT(state(kSecond).quality, second.quality) << what;
            }
          }
        }
        EXPECT_GT(moved, 3U) << what;
      }
}

/// A mean phase follows: neither least falls.
TEST(TwoAims, TheMeanPhaseKeepsBothMinima) {
  constexpr Metric kSecond = Metric::ScaledJacobian;
  Progress progress;
  int rises = 0, runs = 0;
  for (const char* kind : {"random", "quads", "mixed", "can", "tetrahedra", "hexahedra"})
    for (const double threshold : {0.2, 0.5}) {
      const auto mesh = sample(kind, 80);
      RunParameters parameters{.combination = CompositeTerms{threshold, kSecond}};
      dmoscope::Run first = make_run(mesh, parameters);
      (void)first.until_converged({}, progress);
      parameters.then_mean.emplace();
      dmoscope::Run both = make_run(mesh, parameters);
      (void)both.until_converged({}, progress);
      const std::string what = fmt::format("{} above {}", kind, threshold);
      for (const Metric metric : {Metric::MeanRatio, kSecond})
        EXPECT_GE(judged(*mesh, both.positions(), metric).minimum, judged(*mesh, first.positions(), metric).minimum - 1e-12) << what;
      const double before = judged(*mesh, first.positions(), Metric::MeanRatio).mean, after = both.statistics().mean;
      EXPECT_GE(after, before - 1e-12) << what;
      rises += after > before ? 1 : 0;
      ++runs;
    }
  EXPECT_GT(2 * rises, runs);
}

TEST(TwoAims, TheMeanWouldUndoADensity) {
  RunParameters parameters{.combination = CompositeTerms{0.5, SizeFunction{}}};
  parameters.then_mean.emplace();
  EXPECT_THROW((void)make_run(sample("random", 60), parameters), UsageError);
}

/// All refusals are documented for users, word by word.
TEST(Refusals, StandInTheManual) {
  std::ifstream file(std::string(DMOSCOPE_SOURCE_DIR) + "/docs/user/methods.md");
  const std::string manual{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(manual.empty());
  for (const Refusal& refusal : refusals())
    EXPECT_NE(manual.find(fmt::format("| {} | {} |", refusal.mix, refusal.why)), std::string::npos) << refusal.mix;
  SmoothingTask task;
  task.input = sample("tetrahedra", 60);
  for (const MethodInfo& method : method_table()) {
    task.method = method.name;
    const auto refused = std::ranges::count_if(refusals(), [&](const Refusal& refusal) { return refusal.applies(task); });
    EXPECT_EQ(refused, method.name == "angle-based" ? 1 : 0) << method.name;
  }
}

/// The place on the line through a vertex is as good as the best of ten thousand places.
TEST(Dvr, ComesNearTheBestPlaceOnTheLineByAnyMetric) {
  const auto mesh = input(lattice(6, 0.3, 8));
  Progress progress;
  for (const MetricInfo& entry : metric_table()) {
    if (!defined_for_all(entry.metric, mesh->mesh)) continue;
    dmoscope::Run run = make_run(mesh, {.method = "dvr", .metric = entry.metric});
    const Index v = run.colouring().order[0];
    const Vec2<double> d = dvr_direction(run.parameters().options, 0);
    std::vector<Vec3> positions = mesh->mesh.positions;
    const Vec3 here = positions[v];
    double best = 0.0;
    for (int i = -5000; i <= 5000; ++i) {
      positions[v] = here + (i / 5000.0 * 0.2) * Vec3{d.x, d.y, 0.0};
      const StarState state = star_state(*mesh, positions, entry.metric, v);
      if (state.jacobian > 0.0) best = std::max(best, state.quality);
    }
    run.step(StepUnit::Vertex, progress);
    const Vec3 way = run.positions()[v] - here;
    EXPECT_NEAR(way.x * d.y - way.y * d.x, 0.0, 1e-12) << entry.name;
    EXPECT_GE(star_state(*mesh, run.positions(), entry.metric, v).quality, best - 1e-3) << entry.name;
  }
}

/// A hub in a ring of six.
Mesh wheel_mesh(testing::Random& random) {
  Mesh mesh;
  const auto around = [&](double reach) { return Vec3{random(-reach, reach), random(-reach, reach), 0}; };
  mesh.positions.push_back(around(0.3));
  for (int k = 0; k < 6; ++k) mesh.positions.push_back(Vec3{std::cos(k * M_PI / 3), std::sin(k * M_PI / 3), 0.0} + around(0.25));
  for (Index k = 0; k < 6; ++k) testing::add(mesh, {0, k + 1, (k + 1) % 6 + 1});
  return mesh;
}
/// The least metric of the elements with the hub at its best place, found by a search everywhere, finer and finer around the best so far.
double best_of_wheel(const InputMesh& mesh, Metric metric) {
  std::vector<Vec3> positions = mesh.mesh.positions;
  Vec3 best = positions[0];
  double most = -1e9;
  for (double width = 2.0; width > 1e-5; width *= 0.3) {
    const Vec3 centre = best;
    for (int i = -30; i <= 30; ++i)
      for (int k = -30; k <= 30; ++k) {
        positions[0] = centre + Vec3{i * width / 30, k * width / 30, 0.0};
        const Statistics found = compute_statistics(mesh.quality_context(), positions, metric, std::span<const Index>(), nullptr);
        if (found.inverted == 0 && found.minimum > most) most = found.minimum, best = positions[0];
      }
  }
  return most;
}

/// The built-in metric and its formula.
TEST(ActiveSet, ReachesTheBestPlaceOfAStar) {
  testing::Random random(5);
  Progress progress;
  for (const Metric metric : {Metric::MeanRatio, Metric::MinAngle, Metric::ScaledJacobian}) {
    const Metric typed = parse_metric("formula:" + std::string(formula_of(metric)));
    int reached = 0, all = 0;
    for (int trial = 0; trial < 12; ++trial) {
      const auto mesh = input(wheel_mesh(random));
      const double best = best_of_wheel(*mesh, metric);
      for (const Metric by : {metric, typed}) {
        auto run = make_run(mesh, {.method = "active-set", .metric = by});
        run.iterate(5, progress);
        EXPECT_LT(run.statistics().minimum, best + 1e-6);
        reached += run.statistics().minimum > best - 2e-3 ? 1 : 0;
        ++all;
      }
    }
    EXPECT_GT(reached, 0.8 * all) << info(metric).name;
  }
}

/// Expects the change of the least with the vertex, by two neighbouring places, to agree with its pieces' derivatives.
template <class Frame>
void expect_slopes(const InputMesh& mesh, Metric metric, int& compared) {
  const StarJudge<Frame> judge(mesh, single_objective(metric));
  const std::vector<Vec3>& positions = mesh.mesh.positions;
  JudgedStar<Frame> star;
  std::vector<StarPiece<Frame>> pieces;
  for (Index v = 0; v < positions.size(); ++v) {
    if (mesh.topology.boundary()[v] != 0 || mesh.topology.star(v).empty()) continue;
    judge.gather(positions, v, star);
    if (judge.is_tangled(star)) continue;
    const auto score = judge.score_of(star, positions, v, false);
    pieces.clear();
    score.append_pieces({}, pieces);
    double least = HUGE_VAL, next = HUGE_VAL;
    const StarPiece<Frame>* lowest = nullptr;
    for (const StarPiece<Frame>& piece : pieces) {
      if (piece.value < least)
        next = least, least = piece.value, lowest = &piece;
      else
        next = std::min(next, piece.value);
    }
    if (lowest == nullptr || next - least < 1e-3) continue;  // both sides differ at a kink
    const double here = score({});
    if (here > least + 1e-9) continue;  // a corner elsewhere is the least
    EXPECT_NEAR(here, least, 1e-9);
    constexpr double kStep = 1e-6;
    const auto slope = [&](Vec3 way) {
      CandidateList two;
      two.add(kStep * way), two.add(-kStep * way);
      using Offset = OffsetIn<Frame, double>;
      return (score(two.get<Offset>(0)) - score(two.get<Offset>(1))) / (2 * kStep);
    };
    const auto gradient = [&] {
      if constexpr (std::is_same_v<Frame, Plane>)
        return Vec3{lowest->gradient.x, lowest->gradient.y, 0.0};
      else
        return lowest->gradient;
    }();
    for (const Vec3 way : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.3, -0.8, std::is_same_v<Frame, Plane> ? 0.0 : 0.5}})
      EXPECT_NEAR(slope(way), dot(way, gradient), 2e-4 * (1.0 + length(gradient))) << info(metric).name << ", vertex " << v;
    ++compared;
  }
}
TEST(StarPieces, RiseAsTheyTell) {
  const auto hilly = [](Vec3 p) { return Vec3{p.x, p.y, 0.1 * std::sin(4 * p.x) * std::cos(3 * p.y)}; };
  const Metric formulas[] = {Metric::MeanRatio, Metric::ScaledJacobian, Metric::MinAngle, parse_metric("formula:2*det/norm^2"),
                             parse_metric("mean-ratio@input:2")};
  int flat = 0, curved = 0, solid = 0;
  for (const Metric metric : formulas) {
    const auto plane = input(lattice(7, 0.35, 47));
    expect_slopes<Plane>(*plane, metric, flat);
    expect_slopes<Curved>(*input(mapped(plane->mesh, hilly)), metric, curved);
    if (info(metric).defined_for(ElementKind::Tetrahedron))
      expect_slopes<Space>(*input(test::volume_grid(3, test::Fill::Tetrahedra, 0.25)), metric, solid);
  }
  EXPECT_GT(flat, 50);
  EXPECT_GT(curved, 50);
  EXPECT_GT(solid, 10);
}

}  // namespace
}  // namespace dmoscope::testing
