// The fast search against targets: the values of its forms against the statistics' own formulas, its choice against a search of every
// candidate, and the program's promises.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/inspect/single_vertex_task.h"
#include "core/inspect/visit_trace.h"
#include "core/mesh/generate.h"
#include "core/quality/defined_metric.h"
#include "core/smooth/defined_state.h"
#include "core/smooth/kernels/targets/star_targets.h"
#include "core/smooth/kernels/targets/target_star.h"
#include "core/smooth/kernels/targets/target_visit.h"
#include "core/smooth/kernels/targets/tetrahedron_targets.h"
#include "core/smooth/methods/grid.h"
#include "core/smooth/methods/star_kernels.h"
#include "core/smooth/methods/target_composite_kernel.h"
#include "core/smooth/methods/volume_star_search.h"
#include "core/smooth/visit/visit.h"
#include "tests/smooth/promises.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {
namespace {

/// Targets of the input, with averages and with a tolerance, which makes them steep; and along a direction, which makes them crossed.
constexpr std::array kPlanar{"mean-ratio@input", "mean-ratio@input:2", "mean-ratio@input:1:20%", "mean-ratio@aspect:3:30"};
constexpr std::array kSolid{"mean-ratio@input:2", "mean-ratio@input:1:20%", "mean-ratio@aspect:2:1:2:3"};

std::vector<Specimen> planar_specimens() {
  std::vector<Specimen> all;
  const auto add = [&all](std::string name, Mesh mesh) { all.push_back({std::move(name), std::move(mesh)}); };
  add("triangles", lattice(9, 0.35, 121));
  add("quadrilaterals", lattice(9, 0.35, 122, Cells::Quadrilaterals));
  add("mixed", lattice(9, 0.35, 123, Cells::Mixed));
  add("tangled", lattice(9, 0.8, 124, Cells::Mixed));
  add("stretched", mapped(lattice(9, 0.3, 125, Cells::Mixed), [](Vec3 p) { return Vec3{300.0 * p.x + 3e4, p.y, 0.0}; }));
  add("far away", mapped(lattice(9, 0.3, 126), [](Vec3 p) { return Vec3{p.x + 4e6, p.y - 7e6, 0.0}; }));
  add("tiny", mapped(lattice(7, 0.35, 127, Cells::Mixed), [](Vec3 p) { return 1e-9 * p; }));
  add("stars", mixed_stars());
  return all;
}
/// Meshes stretched so far that only the statistics' formulas tell a gain.
std::vector<Specimen> needles() {
  std::vector<Specimen> all;
  for (const double stretch : {1e5, 1e7, 1e8})
    for (const std::uint64_t seed : {15U, 24U})
      all.push_back({fmt::format("needles {:g}", stretch), mapped(lattice(5, 0.3, seed), [stretch](Vec3 p) {
                       return Vec3{stretch * p.x, p.y, 0.0};
                     })});
  return all;
}
std::vector<Specimen> solid_specimens() {
  std::vector<Specimen> all;
  const auto add = [&all](std::string name, Mesh mesh) { all.push_back({std::move(name), std::move(mesh)}); };
  add("tetrahedra", test::volume_grid(3, test::Fill::Tetrahedra, 0.35, 131));
  add("mixed", test::volume_grid(3, test::Fill::Mixed, 0.3, 132));
  add("stretched", mapped(test::volume_grid(3, test::Fill::Tetrahedra, 0.3, 133), [](Vec3 p) { return Vec3{50.0 * p.x, p.y, p.z}; }));
  add("tangled", test::volume_grid(3, test::Fill::Tetrahedra, 0.8, 134));
  return all;
}

/// Tetrahedra stretched as far, along no axis.
std::vector<Specimen> solid_needles() {
  std::vector<Specimen> all;
  const Vec3 u{0.36, 0.48, 0.8}, v{-0.8, 0.6, 0.0}, w{-0.48, -0.64, 0.6};
  for (const double stretch : {1e3, 1e4, 1e5, 1e6})
    for (const unsigned seed : {135U, 136U})
      all.push_back({fmt::format("needles {:g}", stretch), mapped(test::volume_grid(3, test::Fill::Tetrahedra, 0.3, seed),
                                                                  [&](Vec3 p) { return (stretch * p.x) * u + p.y * v + p.z * w; })});
  return all;
}

std::shared_ptr<const InputMesh> generated(const std::string& words) {
  Progress progress;
  return generate_input(words, progress);
}

/// Compares the forms' values of the star of a vertex at a few places, as the lanes judge it, with the statistics.
template <bool Crossed>
void expect_star_quality(const InputMesh& mesh, const DefinedJudge& judge, Index vertex, std::mt19937& random) {
  std::vector<Index> others;
  std::vector<double> numbers;
  const StarShape shape = star_shape(mesh.mesh, mesh.topology, vertex, others);
  if (shape.kind == StarShape::Kind::Alone) return;
  append_star_targets(judge.targets(), Crossed, mesh.mesh, mesh.topology, vertex, shape, others, numbers);
  const auto star_judge = defined_star_judge<Plane>(mesh, judge);
  const Vec3 here = mesh.mesh.positions[vertex];
  std::vector<StarTriangle<double>> triangles;
  std::vector<StarQuadrilateral<double>> quadrilaterals;
  const auto at = [&](std::size_t i) { return star_judge.mesh.frame.offset(mesh.mesh.positions[others[i]], here); };
  const std::size_t n = shape.triangles;
  const bool fan = shape.kind == StarShape::Kind::Fan;
  for (std::size_t i = 0; i < n; ++i)
    triangles.push_back(fan ? StarTriangle<double>{at(i), at((i + 1) % n), 1.0} : StarTriangle<double>{at(2 * i), at(2 * i + 1), 1.0});
  for (std::size_t i = 0; i < shape.quadrilaterals; ++i)
    quadrilaterals.push_back({at(2 * n + 3 * i), at(2 * n + 3 * i + 1), at(2 * n + 3 * i + 2), 1.0});
  const StarView<double> star(triangles.data(), n, quadrilaterals.data(), quadrilaterals.size());
  const auto target = [&](std::size_t i) {
    return corner_target<Crossed, double>([&](std::size_t number) { return numbers[target_numbers(Crossed) * i + number]; });
  };
  double reach = 0.0, room = 0.0;
  for (std::size_t i = 0; i < numbers.size() / target_numbers(Crossed); ++i) room = std::max(room, target_star::doubt(target(i)));
  for (std::size_t i = 0; i < others.size(); ++i) reach = std::max(reach, std::sqrt(dot(at(i), at(i))));
  std::uniform_real_distribution<double> part(-0.3, 0.3);
  for (int k = 0; k < 5; ++k) {
    const Vec2<double> wished = k == 0 ? Vec2<double>{} : Vec2<double>{reach * part(random), reach * part(random)};
    const Vec3 there = here + star_judge.mesh.frame.lift(wished);
    const Vec2<double> p = star_judge.mesh.frame.offset(there, here);  // the stored place
    const StarState state = defined_star_state(star_judge, mesh.mesh.positions, vertex, there);
    const double got = target_star::quality<Crossed>(star, p, target);
    if (state.jacobian > 0.0 && state.quality > 0.0 && state.quality < 1e-8) continue;  // practically inverted for the search
    if (state.jacobian > 0.0) {
      EXPECT_NEAR(got, state.quality, room) << "vertex " << vertex;  // the accuracy that the search relies on
    } else {
      EXPECT_LT(got, -1e20) << "vertex " << vertex;
    }
  }
}

TEST(TargetKernels, JudgeStarsAsTheStatisticsDo) {
  std::mt19937 random(7);
  std::vector<Specimen> all = planar_specimens();
  std::ranges::copy(needles(), std::back_inserter(all));
  for (const Specimen& specimen : all)
    for (const char* metric : {kPlanar[0], kPlanar[1], kPlanar[2], kPlanar[3], "mean-ratio@aspect:1e5:30"}) {
      SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
      const auto mesh = input(specimen.mesh);
      const auto judge = mesh->quality_context().judge(parse_metric(metric));
      const bool crossed = has_crossed_targets(judge->targets(), static_cast<Index>(mesh->mesh.elements.size()));
      EXPECT_EQ(crossed, std::string(metric).find("aspect:") != std::string::npos);
      for (Index v = 0; v < mesh->mesh.vertex_count(); v += 3) {
        if (mesh->topology.boundary()[v] != 0 || mesh->topology.star(v).empty()) continue;
        if (crossed)
          expect_star_quality<true>(*mesh, *judge, v, random);
        else
          expect_star_quality<false>(*mesh, *judge, v, random);
        if (HasFailure()) return;
      }
    }
}

TEST(TargetKernels, JudgeTetrahedraAsTheStatisticsDo) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> part(-0.2, 0.2);
  for (const Specimen& specimen : solid_specimens())
    for (const char* metric : {kSolid[0], kSolid[2]}) {
      SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
      const auto mesh = input(specimen.mesh);
      const auto judge = mesh->quality_context().judge(parse_metric(metric));
      const auto star_judge = defined_star_judge<Space>(*mesh, *judge);
      const TetrahedronTargets targets(judge->targets(), mesh->mesh);
      const VolumeStarSearch search({}, targets.crossed());
      for (const SimdLevel level : supported_simd_levels()) {
        const VolumeKernel kernel = kernels(level).target_volume(targets.crossed());
        for (Index v = 0; v < mesh->mesh.vertex_count(); ++v) {
          const auto incidences = mesh->topology.star(v);
          if (mesh->topology.boundary()[v] != 0 || !targets.fit(incidences)) continue;
          const IndexedStars stars(*mesh, Colouring{{v}, {0, 1}}, nullptr);
          const IndexedStars::Star star = stars.of(v);
          std::vector<Vec3> others;
          for (const Index other : star.vertices) others.push_back(mesh->mesh.positions[other]);
          const Vec3 here = mesh->mesh.positions[v];
          const double reach = length(others[0] - here);
          const Vec3 there = here + reach * Vec3{part(random), part(random), part(random)};
          const BeforeAndAfter rank =
              kernel.least_ranks({star.elements, others.data(), here, there, {incidences.data(), targets.numbers()}});
          for (const auto& [place, got] : {std::pair(here, rank.before), std::pair(there, rank.after)}) {
            const StarState state = defined_star_state(star_judge, mesh->mesh.positions, v, place);
            if (state.jacobian > 0.0) {
              EXPECT_NEAR(std::cbrt(got), state.quality, 1e-9) << "vertex " << v;
            }
            EXPECT_EQ(got > 0.0, state.jacobian > 0.0) << "vertex " << v;
          }
        }
      }
    }
}

/// Expects the chosen candidate of each level to be as good as the best, by the statistics' values, but for floats.
template <class Frame, class Trace>
void expect_best_of_levels(const InputMesh& mesh, const Trace& trace) {
  const auto judge = mesh.quality_context().judge(trace.metric);
  const auto star_judge = defined_star_judge<Frame>(mesh, *judge);
  const auto worth = [&](const auto& offset) {
    const Vec3 there = trace.from + star_judge.mesh.frame.lift(offset);
    const StarState state = defined_star_state(star_judge, mesh.mesh.positions, trace.vertex, there);
    return state.jacobian > 0.0 ? state.quality : -std::numeric_limits<double>::infinity();
  };
  double best = trace.before.quality;
  const double room = 2e-3 * std::max(1.0, std::abs(best));
  for (const auto& level : trace.levels) {
    if (level.best) best = worth(level.at(*level.best));
    for (int i = 0; i < static_cast<int>(level.offsets.size()); ++i)
      ASSERT_GE(best, worth(level.at(i)) - room) << "vertex " << trace.vertex << ", candidate " << i;
  }
}

/// Whether the vertex's star belongs to the kernel, and not to the formula.
bool is_of_lanes(const InputMesh& mesh, Metric metric, Index vertex) {
  const SingleVertexTask task(mesh, mesh.mesh.positions, {}, vertex);
  if (task.shapes->kind == StarShape::Kind::Alone) return false;
  const auto judge = mesh.quality_context().judge(metric);
  const bool crossed = has_crossed_targets(judge->targets(), static_cast<Index>(mesh.mesh.elements.size()));
  std::vector<Index> others;
  std::vector<double> numbers;
  const StarShape shape = star_shape(mesh.mesh, mesh.topology, vertex, others);
  append_star_targets(judge->targets(), crossed, mesh.mesh, mesh.topology, vertex, shape, others, numbers);
  NoTrace trace;
  return crossed ? TargetVisit<true, SingleVertexTask>(task, 0, numbers.data()).run(trace).ready
                 : TargetVisit<false, SingleVertexTask>(task, 0, numbers.data()).run(trace).ready;
}
bool is_of_volume_kernel(const InputMesh& mesh, const TetrahedronTargets& targets, Index vertex) {
  const auto star = mesh.topology.star(vertex);
  if (!targets.fit(star)) return false;
  const IndexedStars stars(mesh, Colouring{{vertex}, {0, 1}}, nullptr);
  VolumeStarSearch::Points points;
  return VolumeStarSearch({}, targets.crossed())
      .find(stars.of(vertex), mesh.mesh.positions, vertex, 0, points, {star.data(), targets.numbers()})
      .ready;
}

TEST(TargetKernels, FindTheBestCandidate) {
  std::size_t fast = 0, slow = 0, fast_solid = 0;
  const std::vector<std::uint8_t> free(10000);
  for (const Specimen& specimen : planar_specimens())
    for (const char* metric : kPlanar) {
      SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
      const auto mesh = input(specimen.mesh);
      for (Index v = 0; v < mesh->mesh.vertex_count(); v += 2) {
        if (mesh->topology.boundary()[v] != 0 || mesh->topology.star(v).empty()) continue;
        const VisitTrace trace = trace_visit(*mesh, mesh->mesh.positions, free, parse_metric(metric), {}, v);
        if (!(trace.before.jacobian > 0.0)) continue;
        const bool of_lanes = is_of_lanes(*mesh, parse_metric(metric), v);
        ++(of_lanes ? fast : slow);
        if (!of_lanes) continue;
        expect_best_of_levels<Plane>(*mesh, trace);
      }
    }
  for (const Specimen& specimen : solid_specimens())
    for (const char* metric : {kSolid[0], kSolid[2]}) {  // steep ones are left to the formula
      SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
      const auto mesh = input(specimen.mesh);
      const TetrahedronTargets targets(mesh->quality_context().judge(parse_metric(metric))->targets(), mesh->mesh);
      for (Index v = 0; v < mesh->mesh.vertex_count(); ++v) {
        if (mesh->topology.boundary()[v] != 0 || mesh->topology.star(v).empty()) continue;
        const VolumeTrace trace = trace_volume_visit(*mesh, mesh->mesh.positions, free, parse_metric(metric), {}, v);
        if (!(trace.before.jacobian > 0.0)) continue;
        const bool of_kernel = is_of_volume_kernel(*mesh, targets, v);
        if (specimen.name != "mixed" && trace.before.quality > 0.02) {
          EXPECT_TRUE(of_kernel) << "vertex " << v;
          ++fast_solid;
        }
        if (of_kernel) expect_best_of_levels<Space>(*mesh, trace);
      }
    }
  EXPECT_GT(fast, 10 * slow);  // stars that are too large for lanes
  EXPECT_GT(fast_solid, 20U);
}

TEST(TargetKernels, KeepTheFirstPromise) {
  int moved = 0;
  const auto keep = [&moved](const Specimen& specimen, const char* metric) {
    SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
    const auto mesh = input(specimen.mesh);
    ASSERT_TRUE(has_target_kernel(*mesh, parse_metric(metric), {}));
    auto run = make_run(mesh, {.metric = parse_metric(metric)});
    expect_promise_one(specimen, run, 3);
    expect_fixed_stay(specimen, run);
    moved += !same_bits(run.positions(), std::span<const Vec3>(mesh->mesh.positions)) ? 1 : 0;
  };
  for (const Specimen& specimen : planar_specimens())
    for (const char* metric : kPlanar) keep(specimen, metric);
  EXPECT_GT(moved, 20);
  for (const Specimen& specimen : solid_specimens())
    for (const char* metric : kSolid) keep(specimen, metric);
}

/// If a target stretches so far that rounding exceeds the gain of a visit, the statistics decide. Fine grids find small gains.
TEST(TargetKernels, KeepTheFirstPromiseOfNeedles) {
  for (const Specimen& specimen : needles())
    for (const char* metric : {"mean-ratio@input:3", "mean-ratio@aspect:1e6:30"}) {
      SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
      RunParameters parameters{.metric = parse_metric(metric)};
      parameters.search.levels = 16;
      auto run = make_run(input(specimen.mesh), parameters);
      expect_promise_one(specimen, run, 12);
      if (HasFailure()) return;
    }
}

TEST(TargetKernels, KeepTheFirstPromiseOfSolidNeedles) {
  for (const Specimen& specimen : solid_needles())
    for (const char* metric : {"mean-ratio@input:1", "mean-ratio@aspect:1e4:0.36:0.48:0.8"}) {
      SCOPED_TRACE(std::string(metric) + " on " + specimen.name);
      RunParameters parameters{.metric = parse_metric(metric)};
      parameters.search.levels = 12;
      auto run = make_run(input(specimen.mesh), parameters);
      expect_promise_one(specimen, run, 8);
      if (HasFailure()) return;
    }
}

/// Meshes far stretched along no axis, for which the search in floats found next to nothing: as good as in double.
TEST(TargetKernels, SmoothSolidNeedlesAsInDouble) {
  for (const Specimen& specimen : solid_needles()) {
    SCOPED_TRACE(specimen.name);
    const auto mesh = input(specimen.mesh);
    const auto minimum_in = [&](Precision precision) {
      RunParameters parameters{.metric = parse_metric("mean-ratio@input:1")};
      parameters.search.levels = 12;
      parameters.search.precision = precision;
      auto run = make_run(mesh, parameters);
      Progress progress;
      run.iterate(10, progress);
      return run.statistics().movable_minimum;
    };
    EXPECT_GT(minimum_in(Precision::Float), minimum_in(Precision::Double) - 0.01);
  }
}

/// Meshes far stretched along a direction: as good as by the formula of the same metric, which has no forms.
TEST(TargetKernels, SmoothFarStretchedMeshesLikeTheFormula) {
  for (const double stretch : {1e2, 1e4, 1e6})
    for (const double degrees : {0.0, 30.0, 45.0}) {
      const double c = std::cos(degrees * std::numbers::pi / 180.0), s = std::sin(degrees * std::numbers::pi / 180.0);
      const auto mesh = input(mapped(lattice(9, 0.3, 5, Cells::Quadrilaterals), [&](Vec3 p) {
        return Vec3{stretch * c * p.x - s * p.y, stretch * s * p.x + c * p.y, 0.0};
      }));
      const auto minimum_by = [&](const std::string& name) {
        auto run = make_run(mesh, {.metric = parse_metric(fmt::format("{}@aspect:{:.0f}:{:.0f}", name, stretch, degrees))});
        Progress progress;
        run.iterate(8, progress);
        return run.statistics().minimum;
      };
      EXPECT_GT(minimum_by("mean-ratio"), minimum_by("formula:2*det/norm^2") - 0.02) << stretch << ' ' << degrees;
    }
}

TEST(TargetKernels, HaveTheSameBitsForAnyThreadsAndInstructions) {
  const auto expect = [](const char* words, const char* metric) {
    SCOPED_TRACE(std::string(metric) + " on " + words);
    const auto mesh = generated(words);
    const auto smoothed = [&](std::optional<SimdLevel> level, unsigned threads) {
      RunParameters parameters{.metric = parse_metric(metric)};
      parameters.search.simd = level;
      auto run = make_run(mesh, parameters, threads);
      Progress progress;
      run.iterate(3, progress);
      return std::vector<Vec3>(run.positions().begin(), run.positions().end());
    };
    const auto expected = smoothed({}, 1);
    if (std::string(metric) != "mean-ratio@input") {  // the optimum by this metric
      EXPECT_FALSE(same_bits(expected, std::span<const Vec3>(mesh->mesh.positions)));
    }
    for (const SimdLevel level : supported_simd_levels()) EXPECT_TRUE(same_bits(expected, smoothed(level, 3))) << name(level);
  };
  for (const char* metric : kPlanar)
    for (const char* words : {"mixed 900", "tangled 400"}) expect(words, metric);
  expect("anisotropic 900", "mean-ratio@field");
  for (const char* metric : kSolid) expect("tetrahedra 300", metric);
}

TEST(TargetKernels, LooksIntoVisitsShowWhatTheyDo) {
  for (const char* words : {"mixed 100", "tangled 100", "tetrahedra 60"})
    for (const char* metric : {"mean-ratio@input:1", "mean-ratio@input:1:20%", "crossed"}) {
      const auto mesh = generated(words);
      const std::string name = std::string(metric) != "crossed" ? metric : mesh->is_volume() ? kSolid[2] : kPlanar[3];
      SCOPED_TRACE(name + " on " + words);
      const RunParameters parameters{.metric = parse_metric(name)};
      auto run = make_run(mesh, parameters);
      Progress progress;
      const std::vector<Index> order = run.colouring().order;
      for (const Index v : order) {
        Vec3 to{};
        if (mesh->is_volume())
          to = trace_volume_visit(*mesh, run.positions(), run.fixed(), parameters.metric, parameters.search, v, {}, run.sweep().untangling)
                   .to;
        else
          to = trace_visit(*mesh, run.positions(), run.fixed(), parameters.metric, parameters.search, v, {}, run.sweep().untangling).to;
        run.visit_vertices(std::array{v}, progress);  // a step of a tangled mesh would move them together
        ASSERT_EQ(run.positions()[v], to) << "vertex " << v;
      }
    }
}

/// Number of stars on which the search for the mean was compared, and of those that it took.
struct MeanSearches {
  int stars = 0, taken = 0, moved = 0, told = 0;
};
/// Compares the search, by any instructions, with a search of all candidates by the statistics' formulas, to the bit, and its comparison of
/// two places with theirs.
template <class Frame>
void expect_plain_winner_of_mean(const std::shared_ptr<const InputMesh>& mesh, const CompositeObjective& mean, MeanSearches& count) {
  std::vector<std::unique_ptr<TargetCompositeKernel<Frame>>> searches;
  SmoothingTask task;
  task.input = mesh;
  std::vector<Index> inside;
  for (Index v = 0; v < mesh->mesh.vertex_count(); ++v)
    if (mesh->topology.boundary()[v] == 0 && !mesh->topology.star(v).empty()) inside.push_back(v);
  task.colouring = std::make_shared<const Colouring>(colour_vertices(mesh->mesh, mesh->topology, inside));
  for (const SimdLevel level : supported_simd_levels()) {
    task.search.simd = level;
    searches.push_back(std::make_unique<TargetCompositeKernel<Frame>>(task, mean));
  }
  const std::vector<Vec3>& positions = mesh->mesh.positions;
  const RuleMesh<Frame> rule(*mesh);
  const StarJudge<Frame> judge(*mesh, mean);
  JudgedStar<Frame> star;
  SearchRoom<Frame> room;
  for (const Index v : inside) {
    judge.gather(positions, v, star);
    const bool tangled = judge.is_tangled(star);
    const FreePlaces<Frame> places(rule, positions, v, star);
    const auto plain = Grid(task, mean).choose(places, judge.score_of(star, positions, v, tangled), room);
    ++count.stars;
    for (const auto& search : searches) {
      const auto fast = search->find(positions, v, {}, task.search.levels);
      EXPECT_FALSE(tangled && fast.ready) << "vertex " << v;
      if (!fast.ready) continue;
      ++count.taken;
      count.moved += plain == OffsetIn<Frame, double>{} ? 0 : 1;
      ASSERT_TRUE(times(fast.offset, fast.scale) == plain) << "vertex " << v;
      for (const double part : {1.0, 0.37, -0.2}) {
        const auto target = rule.moved(positions[v], times(plain, part));
        if (!target) continue;
        const auto gains = search->gains(positions, v, *target);
        if (!gains) continue;
        ++count.told;
        ASSERT_EQ(*gains, judge.confirm(positions, v, *target) == Confirmation::Gains) << "vertex " << v << ", " << part;
      }
    }
  }
}

TEST(TargetKernels, RaiseTheMeanAsThePlainSearchDoes) {
  const auto expect = [](const std::vector<Specimen>& specimens, std::span<const char* const> metrics, bool needle) {
    MeanSearches count;
    for (const Specimen& specimen : specimens)
      for (const char* metric : metrics)
        for (const MeanKind kind : kMeanKinds) {
          SCOPED_TRACE(fmt::format("{} of {} on {}", name(kind), metric, specimen.name));
          const auto mesh = input(specimen.mesh);
          const CompositeObjective mean = raise_mean_above(parse_metric(metric), 0.15, kind);
          if (mesh->is_volume())
            expect_plain_winner_of_mean<Space>(mesh, mean, count);
          else
            expect_plain_winner_of_mean<Plane>(mesh, mean, count);
          if (HasFailure()) return;
        }
    if (needle) return;
    const auto levels = static_cast<int>(supported_simd_levels().size());
    EXPECT_GT(count.taken, count.stars * levels / 4);
    EXPECT_GT(count.moved, count.taken / 4);
    EXPECT_GT(count.told, count.moved);
  };
  expect(planar_specimens(), kPlanar, false);
  expect(needles(), kPlanar, true);
  expect(solid_specimens(), std::array{kSolid[0], kSolid[2]}, false);
  expect(solid_needles(), std::array{kSolid[0], kSolid[2]}, true);
}

/// A target equal to the ideal element, though it goes through all of the arithmetic.
TEST(TargetKernels, TakeTheCourseOfTheIdealElementWhereThatIsTheTarget) {
  for (const auto& [words, metric] : {std::pair("random 500", "mean-ratio@aspect:1:0"), std::pair("mixed 500", "mean-ratio@aspect:1:20"),
                                      std::pair("tetrahedra 300", "mean-ratio@aspect:1:1:0:0")}) {
    SCOPED_TRACE(metric);
    const auto mesh = generated(words);
    const auto statistics = [&](const char* name) {
      auto run = make_run(mesh, {.metric = parse_metric(name)});
      Progress progress;
      run.iterate(2, progress);
      return run.statistics();
    };
    const Statistics expected = statistics("mean-ratio"), got = statistics(metric);
    EXPECT_NEAR(got.minimum, expected.minimum, 0.01);
    EXPECT_NEAR(got.mean, expected.mean, 0.002);
  }
}

}  // namespace
}  // namespace dmoscope::testing
