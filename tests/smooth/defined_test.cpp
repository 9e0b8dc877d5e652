// Smoothing by formulas and targets keeps the program's promises for any formula, and finds the results of the built-in metrics.

#include <algorithm>
#include <array>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/inspect/quality_field.h"
#include "core/inspect/visit_trace.h"
#include "core/joint/joint_clusters.h"
#include "core/mesh/generate.h"
#include "core/quality/defined_metric.h"
#include "core/search/grid_search.h"
#include "core/smooth/defined_state.h"
#include "core/smooth/methods/defined_search.h"
#include "core/target/boundary_layers.h"
#include "tests/smooth/promises.h"
#include "tests/support/plain_surface.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {
namespace {

std::shared_ptr<const InputMesh> generated(const std::string& words) {
  Progress progress;
  return generate_input(words, progress);
}

/// Metrics of every form: by whole elements, by corners, and with targets.
constexpr std::array kMetrics{
    "formula:if(measure > 0, lmin/lmax, measure/lmax^2)",  // for all kinds; ignores inversion at a corner
    "formula:lmin/lmax",                                   // ignores inversion
    "formula:smin/smax",                                   // by corners
    "formula:min(1, size)*smin/smax",                      // by corners and sizes
    "formula:exp(-3*(smax/smin - 1))*sign(det)",
    "shape-size",
    "scaled-jacobian-inside",
    "mean-ratio@input:3",
    "mean-ratio@input:2:20%",
    "aspect@input:1",
};

std::vector<Specimen> specimens() {
  std::vector<Specimen> all;
  const auto add = [&all](std::string name, Mesh mesh) { all.push_back({std::move(name), std::move(mesh)}); };
  add("triangles", lattice(9, 0.35, 21));
  add("quadrilaterals", lattice(9, 0.35, 22, Cells::Quadrilaterals));
  add("mixed", lattice(9, 0.35, 23, Cells::Mixed));
  add("tangled", lattice(9, 0.8, 24, Cells::Mixed));
  add("stretched", mapped(lattice(9, 0.3, 25, Cells::Mixed), [](Vec3 p) { return Vec3{1e4 * p.x + 3e6, 1e-1 * p.y, 0.0}; }));
  add("tiny", mapped(lattice(7, 0.35, 26), [](Vec3 p) { return 1e-9 * p; }));
  add("tilted", mapped(lattice(7, 0.35, 27), [](Vec3 p) {
        return Vec3{0.6 * p.x - 0.3 * p.y, 0.2 * p.x + 0.9 * p.y, 0.5 * p.x - 0.1 * p.y};
      }));
  add("stars", mixed_stars());
  for (const test::Fill fill : {test::Fill::Hexahedra, test::Fill::Tetrahedra, test::Fill::Mixed})
    add("volume", test::volume_grid(3, fill, 0.35, 5));
  add("tangled volume", test::volume_grid(3, test::Fill::Hexahedra, 0.75, 6));
  return all;
}

bool possible(const char* metric, const InputMesh& mesh) {
  try {
    require_defined(parse_metric(metric), mesh);
    return true;
  } catch (const UsageError&) {
    return false;
  }
}

std::vector<Vec3> smoothed(const std::shared_ptr<const InputMesh>& mesh, RunParameters parameters, std::uint64_t iterations,
                           unsigned threads = 1) {
  auto run = make_run(mesh, std::move(parameters), threads);
  Progress progress;
  run.iterate(iterations, progress);
  return {run.positions().begin(), run.positions().end()};
}

TEST(DefinedMetrics, KeepTheFirstPromise) {
  for (const Specimen& specimen : specimens())
    for (const char* metric : kMetrics) {
      const auto mesh = input(specimen.mesh);
      ASSERT_TRUE(possible(metric, *mesh)) << metric << " on " << specimen.name;
      SCOPED_TRACE(metric);
      auto run = make_run(mesh, {.metric = parse_metric(metric)});
      expect_promise_one(specimen, run, 3);
      expect_fixed_stay(specimen, run);
      if (HasFatalFailure() || HasNonfatalFailure()) return;
    }
}

/// The least over the corners includes corners that stay, for all corners change it.
TEST(DefinedMetrics, CornersThatStayCountWhereTheirValueChanges) {
  for (const char* words : {"screw 300", "hexahedra 200", "solids 200"})
    for (const char* metric : {"formula:3*cbrt(det)*abs(cbrt(det))/norm^2 - 0.2*lsum/cbrt(mean_measure)",
                               "formula:smin/smax - measure/lmax^3", "formula:q = min_corner(det/norm^3 + length(p1 - p2)/lmax); q"}) {
      SCOPED_TRACE(metric);
      const auto mesh = generated(words);
      auto run = make_run(mesh, {.metric = parse_metric(metric)});
      expect_promise_one({words, mesh->mesh}, run, 4);
    }
}

/// Fields are in the mesh's unit, whatever the unit of the search.
TEST(DefinedMetrics, FieldsAreInTheMeshsUnit) {
  Mesh mesh = mapped(lattice(10, 0.3, 61), [](Vec3 p) { return 500.0 * p; });
  Field size;
  size.name = "h";
  size.values.assign(mesh.positions.size(), 45.0);
  mesh.fields.push_back(size);
  const auto one = input(mesh);
  const std::string by_field = "s = lmax/field(\"h\"); min(s, 1/s)*4*sqrt(3)*area/l2sum",
                    by_number = "s = lmax/45; min(s, 1/s)*4*sqrt(3)*area/l2sum";
  EXPECT_TRUE(same_bits(smoothed(one, {.metric = parse_metric("formula:" + by_field)}, 4),
                        smoothed(one, {.metric = parse_metric("formula:" + by_number)}, 4)));
}

/// A sound star does not depend on the metric's sign.
TEST(DefinedMetrics, MayBeBelowZero) {
  const auto mesh = generated("mixed 300");
  for (const char* method : {"dmo", "pattern-search", "active-set", "joint"}) {
    Progress progress;
    auto plain = make_run(mesh, {.method = method, .metric = parse_metric("formula:2*det/norm^2")});
    auto lower = make_run(mesh, {.method = method, .metric = parse_metric("formula:2*det/norm^2 - 2")});
    plain.iterate(4, progress);
    lower.iterate(4, progress);
    EXPECT_NEAR(lower.statistics().minimum + 2.0, plain.statistics().minimum, 0.02) << method;
  }
}

TEST(DefinedMetrics, OtherMethodsKeepItToo) {
  for (const char* method : {"smart-laplace", "pattern-search"})
    for (const Specimen& specimen : specimens())
      for (const char* metric : {kMetrics[0], kMetrics[6]}) {
        SCOPED_TRACE(std::string(method) + ", " + metric);
        auto run = make_run(input(specimen.mesh), {.method = method, .metric = parse_metric(metric)});
        expect_promise_one(specimen, run, 2);
      }
}

/// Active sets and joint moves use the derivatives of the metrics' pieces.
TEST(DefinedMetrics, ActiveSetsAndJointMovesKeepItToo) {
  int raised = 0;
  for (const char* method : {"active-set", "joint"})
    for (const Specimen& specimen : specimens())
      for (const char* metric : kMetrics) {
        SCOPED_TRACE(std::string(method) + ", " + metric);
        const auto mesh = input(specimen.mesh);
        if (method == std::string_view("joint") && !why_not_joint(*mesh, parse_metric(metric)).empty()) continue;
        auto run = make_run(mesh, {.method = method, .metric = parse_metric(metric)});
        const double before = run.statistics().movable_minimum;
        expect_promise_one(specimen, run, 2);
        expect_fixed_stay(specimen, run);
        raised += run.statistics().movable_minimum > before ? 1 : 0;
      }
  EXPECT_GT(raised, 100);
}

TEST(DefinedMetrics, AreTheSameForAllThreadsAndInstructions) {
  for (const char* words : {"mixed 300", "solids 200", "tangled 200"})
    for (const char* metric : {kMetrics[1], kMetrics[3], kMetrics[4]}) {
      const auto mesh = generated(words);
      for (const Precision precision : {Precision::Float, Precision::Double}) {
        RunParameters parameters{.metric = parse_metric(metric)};
        parameters.search.precision = precision;
        const auto expected = smoothed(mesh, parameters, 3);
        EXPECT_TRUE(same_bits(expected, smoothed(mesh, parameters, 3, 3))) << metric << " on " << words;
        for (const SimdLevel level : supported_simd_levels()) {
          parameters.search.simd = level;
          EXPECT_TRUE(same_bits(expected, smoothed(mesh, parameters, 3, 2))) << metric << " on " << words << ", " << name(level);
        }
      }
    }
}

/// A ceiling that no place of a vertex exceeds ends its visit: no part of a maximum is such a ceiling.
TEST(DefinedMetrics, AMaximumIsNoCeiling) {
  for (const char* words : {"quads 200", "hexahedra 60"}) {
    const auto mesh =
        input(words[0] == 'q' ? lattice(9, 0.25, 71, Cells::Quadrilaterals) : test::volume_grid(3, test::Fill::Hexahedra, 0.2, 72));
    const auto course = [&](const char* formula) { return smoothed(mesh, {.metric = parse_metric(formula)}, 3); };
    const auto plain = course("formula:smin/smax");
    EXPECT_FALSE(same_bits(plain, std::span<const Vec3>(mesh->mesh.positions)));
    EXPECT_TRUE(same_bits(plain, course("formula:max(0.01, smin/smax)"))) << "below all values";
    const auto whole = course("formula:max(0.01, min_corner(smin/smax))");  // over all corners; in space also those that stay
    EXPECT_FALSE(same_bits(whole, std::span<const Vec3>(mesh->mesh.positions)));
    if (!mesh->is_volume()) {
      EXPECT_TRUE(same_bits(plain, whole));
    }
    const auto capped = make_run(mesh, {.metric = parse_metric("formula:min(0.01, smin/smax)")}).statistics();
    EXPECT_EQ(capped.minimum, 0.01);
    EXPECT_TRUE(same_bits(course("formula:min(0.01, smin/smax)"), std::span<const Vec3>(mesh->mesh.positions))) << "nothing to gain";
  }
}

/// The course of the search is the same, and the values but for the last digits: hence also the places.
TEST(DefinedMetrics, TakeTheCourseOfTheBuiltInOnes) {
  for (const char* words : {"random 300", "quads 300", "mixed 400", "tetrahedra 200", "coast 600"}) {
    const auto mesh = generated(words);
    for (const MetricInfo& entry : metric_table()) {
      const std::string formula = fmt::format("formula:{}", formula_of(entry.metric));
      if (!possible(std::string(entry.name).c_str(), *mesh) || entry.metric == Metric::MeanRatioArea) continue;
      RunParameters built_in{.metric = entry.metric}, written{.metric = parse_metric(formula)};
      built_in.search.precision = written.search.precision = Precision::Double;
      const auto expected = smoothed(mesh, built_in, 3), got = smoothed(mesh, written, 3);
      std::size_t other = 0;
      for (std::size_t v = 0; v < got.size(); ++v) other += length(got[v] - expected[v]) > 1e-9 * mesh->geometry.size ? 1U : 0U;
      // The dihedral angle at a fixed face is the same for all candidates in the plane of another: many are equal, and rounding chooses.
      if (entry.metric == Metric::MinAngle && mesh->is_volume()) continue;
      EXPECT_LE(other, got.size() / 200) << entry.name << " on " << words << ": candidates that are equal but for rounding";
    }
  }
}

/// Finds the best candidate by looking at every one.
template <class Frame>
void expect_the_plain_search(const InputMesh& mesh, const char* metric, SearchParameters parameters) {
  parameters.precision = Precision::Double;
  const auto judge = mesh.quality_context().judge(parse_metric(metric));
  const DefinedStarJudge<Frame> star_judge = defined_star_judge<Frame>(mesh, *judge);
  const DefinedSearch<Frame> search(star_judge, parameters);
  typename DefinedSearch<Frame>::Scratch scratch;
  int looked_at = 0;
  for (Index v = 0; v < mesh.mesh.vertex_count(); ++v) {
    if (mesh.topology.boundary()[v] != 0 || mesh.topology.star(v).empty()) continue;
    if (!(defined_star_state(star_judge, mesh.mesh.positions, v, mesh.mesh.positions[v]).jacobian > 0.0)) continue;
    const DefinedStar<Frame> star(star_judge, mesh.mesh.positions, v);
    const auto found = search.find(mesh.mesh.positions, v, parameters.levels, scratch);
    const auto plain = grid_search<double>([&star](auto p) { return star.least(p); }, star.star().box, parameters);
    EXPECT_NEAR(star.least(found.offset), plain.objective, 1e-9) << metric << ", vertex " << v;
    ++looked_at;
  }
  EXPECT_GT(looked_at, 5);
}
TEST(DefinedMetrics, AreSearchedAsByALookAtEveryCandidate) {
  const auto planar = input(lattice(8, 0.3, 41, Cells::Mixed));
  const auto volume = input(test::volume_grid(3, test::Fill::Mixed, 0.3, 42));
  for (const char* metric : kMetrics)
    for (const int points : {8, 9, 3}) {
      expect_the_plain_search<Plane>(*planar, metric, {.grid_points = points});
      if (points < 9) expect_the_plain_search<Space>(*volume, metric, {.grid_points = points, .levels = 2});
    }
}

TEST(DefinedMetrics, LooksIntoVisitsShowWhatTheSmootherDoes) {
  for (const char* words : {"mixed 100", "tangled 100", "solids 60"})
    for (const char* metric : {kMetrics[1], kMetrics[3], kMetrics[6]})
      for (const Precision precision : {Precision::Float, Precision::Double}) {
        const auto mesh = generated(words);
        SCOPED_TRACE(fmt::format("{} on {}", metric, words));
        RunParameters parameters{.metric = parse_metric(metric)};
        parameters.search.precision = precision;
        auto run = make_run(mesh, parameters);
        Progress progress;
        const std::vector<Index> order = run.colouring().order;
        for (std::size_t i = 0; i < order.size(); ++i) {
          const Index v = order[i];
          Vec3 to{};
          const auto check = [&](const auto& trace) {
            to = trace.to;
            EXPECT_EQ(trace.before.quality, star_state(*mesh, run.positions(), parameters.metric, v).quality);
            if (trace.end == VisitEnd::Moved && trace.before.jacobian > 0.0) {
              EXPECT_GT(trace.after.quality, trace.before.quality);
            }
          };
          if (mesh->is_volume())
            check(trace_volume_visit(*mesh, run.positions(), run.fixed(), parameters.metric, parameters.search, v, {},
                                     run.sweep().untangling, run.guard()));
          else
            check(trace_visit(*mesh, run.positions(), run.fixed(), parameters.metric, parameters.search, v, {}, run.sweep().untangling,
                              run.guard()));
          run.visit_vertices(std::array{v}, progress);  // a step of a tangled mesh would move them together
          ASSERT_EQ(run.positions()[v], to) << "vertex " << v;
        }
      }
}

TEST(DefinedMetrics, HaveAFieldAroundAVertex) {
  const auto planar = input(lattice(6, 0.3, 51, Cells::Mixed));
  const Metric metric = parse_metric(kMetrics[2]);
  const Index v = 24;
  const QualityField field = sample_quality(*planar, planar->mesh.positions, metric, v, {-0.05, -0.05}, {0.05, 0.05}, 5, 5);
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column) {
      std::vector<Vec3> positions = planar->mesh.positions;
      positions[v] = positions[v] + Vec3{-0.04 + 0.02 * column, -0.04 + 0.02 * row, 0.0};
      EXPECT_NEAR(field.quality[static_cast<std::size_t>(5 * row + column)],
                  vertex_quality(planar->quality_context(), planar->topology, positions, metric, v), 1e-6);
    }
}

TEST(DefinedMetrics, ThenMeanAndTwoAims) {
  for (const char* words : {"mixed 200", "solids 60"}) {
    const auto mesh = generated(words);
    Progress progress;
    RunParameters parameters{.metric = parse_metric("formula:smin/smax")};
    parameters.then_mean.emplace();
    auto run = make_run(mesh, parameters);
    run.iterate(8, progress);
    const auto& records = run.history().records();
    for (std::size_t i = 1; i < records.size(); ++i) EXPECT_GE(records[i].statistics.minimum, records[i - 1].statistics.minimum);
    RunParameters both{.metric = parse_metric("formula:smin/smax")};
    const Metric second = parse_metric("shape-size");
    const double first = records.front().statistics.minimum, threshold = first + 0.05;
    both.combination = CompositeTerms{.threshold = threshold, .second = second};
    auto two = make_run(mesh, both);
    const auto second_mean = [&] {
      return compute_statistics(mesh->quality_context(), two.positions(), second, two.fixed(), nullptr).mean;
    };
    const double before = second_mean();
    two.iterate(3, progress);
    EXPECT_GT(two.statistics().minimum, first);
    EXPECT_GT(second_mean(), before);
    // The first aim may fall if it is met, but not below the threshold.
    both.combination->threshold = 0.5 * first;
    auto eased = make_run(mesh, both);
    eased.iterate(3, progress);
    EXPECT_GE(eased.statistics().minimum, 0.5 * first);
  }
}

TEST(DefinedMetrics, VerticesSlide) {
  const auto mesh = generated("mixed 300");
  RunParameters parameters{.metric = parse_metric("formula:smin/smax")};
  parameters.boundary = BoundaryRule::Slide;
  Specimen specimen{"slide", mesh->mesh};
  auto run = make_run(mesh, parameters);
  expect_promise_one(specimen, run, 3);
  const auto can = generated("can 300");
  RunParameters on_can{.metric = parse_metric("formula:lmin/lmax")};
  auto surface = make_run(can, on_can);
  const double before = surface.statistics().minimum;
  Progress progress;
  surface.iterate(3, progress);
  EXPECT_GT(surface.statistics().minimum, before);
}

/// Use of targets: a metric field is followed.
TEST(DefinedMetrics, AMetricFieldIsFollowed) {
  const auto mesh = generated("anisotropic 1200");
  Progress progress;
  auto run = make_run(mesh, {.metric = parse_metric("mean-ratio@field")});
  const Statistics before = run.statistics();
  run.iterate(10, progress);
  EXPECT_GT(run.statistics().minimum, 1.5 * before.minimum);
  EXPECT_GT(run.statistics().mean, before.mean);
}

TEST(DefinedMetrics, LayersAreKeptAndTheRestIsImproved) {
  const auto mesh = generated("mixed 2000");
  const Metric kept = parse_metric("mean-ratio@layers:input");
  const auto judge = mesh->quality_context().judge(kept);
  std::vector<Index> layers;
  for (Index e = 0; e < mesh->mesh.elements.size(); ++e)
    if (judge->targets().of(e).space == FormulaSpace::Target) layers.push_back(e);
  ASSERT_GT(layers.size(), 50U);
  const auto positions = smoothed(mesh, {.metric = kept}, 20);
  const Metric aspect = parse_metric("aspect@layers:input:0%");
  double changed = 0.0;
  for (const Index e : layers) changed += 1.0 - element_quality(mesh->quality_context(), positions, aspect, e);
  EXPECT_LT(changed / static_cast<double>(layers.size()), 0.02);
  double before = 1.0, after = 1.0;
  for (Index e = 0; e < mesh->mesh.elements.size(); ++e) {
    if (std::ranges::find(layers, e) != layers.end()) continue;
    before = std::min(before, element_quality(mesh->quality_context(), mesh->mesh.positions, Metric::MeanRatio, e));
    after = std::min(after, element_quality(mesh->quality_context(), positions, Metric::MeanRatio, e));
  }
  EXPECT_GT(after, before);
}

/// Aspect of a layer's quadrilateral, width along the wall over height, from its sides; and the least mean ratio of all other elements.
struct LayersAndRest {
  double mean_aspect = 0.0, mean_spacing = 0.0, worst_of_rest = 1.0;
};
LayersAndRest layers_and_rest(const InputMesh& mesh, const BoundaryLayers& layers, std::span<const Vec3> positions) {
  LayersAndRest out;
  const auto side = [&](Index a, Index b) { return length(positions[b] - positions[a]); };
  const auto input_side = [&](Index a, Index b) { return length(mesh.mesh.positions[b] - mesh.mesh.positions[a]); };
  double at_wall = 0.0;
  for (std::size_t i = 0; i < layers.elements.size(); ++i) {
    const auto c = mesh.mesh.elements.corners(layers.elements[i]);
    const bool flat = input_side(c[0], c[1]) + input_side(c[2], c[3]) > input_side(c[1], c[2]) + input_side(c[3], c[0]);
    const double one = side(c[0], c[1]) + side(c[2], c[3]), other = side(c[1], c[2]) + side(c[3], c[0]);
    out.mean_aspect += (flat ? one / other : other / one) / static_cast<double>(layers.elements.size());
    if (layers.heights[i] != 1) continue;
    out.mean_spacing += (flat ? other : one) / 2.0;
    at_wall += 1.0;
  }
  out.mean_spacing /= at_wall;
  for (Index e = 0; e < mesh.mesh.elements.size(); ++e)
    if (!std::binary_search(layers.elements.begin(), layers.elements.end(), e))
      out.worst_of_rest = std::min(out.worst_of_rest, element_quality(mesh.quality_context(), positions, Metric::MeanRatio, e));
  return out;
}
constexpr const char* kMeanOverCorners = "formula:triangle { 4*sqrt(3)*area/l2sum } quadrilateral { 1/mean_corner(norm^2/(2*det)) }";

void expect_kept_layers(const std::shared_ptr<const InputMesh>& mesh, const std::string& metric) {
  const BoundaryLayers layers = find_boundary_layers(mesh->mesh, mesh->geometry);
  ASSERT_FALSE(layers.empty());
  const LayersAndRest before = layers_and_rest(*mesh, layers, mesh->mesh.positions);
  Progress progress;
  const auto after_with = [&](const std::string& name) {
    RunParameters parameters{.metric = parse_metric(name), .layers = LayerRule::Free};
    parameters.boundary = BoundaryRule::Slide;
    auto run = make_run(mesh, parameters);
    run.iterate(20, progress);
    return layers_and_rest(*mesh, layers, run.positions());
  };
  const LayersAndRest kept = after_with(metric + "@layers:input");
  EXPECT_NEAR(kept.mean_aspect / before.mean_aspect, 1.0, 0.02);
  EXPECT_NEAR(kept.mean_spacing / before.mean_spacing, 1.0, 0.01);
  EXPECT_GT(kept.worst_of_rest, 1.2 * before.worst_of_rest);
  if (metric == kMeanOverCorners) {  // the least over the corners keeps rectangles in any case
    EXPECT_LT(after_with(metric).mean_aspect, 0.9 * before.mean_aspect) << "without the target";
  }
}

TEST(BoundaryLayers, AreKeptWhileTheRestGetsBetter) {
  // Flat layers under a lattice of triangles.
  Mesh mesh = mapped(lattice(12, 0.25, 61), [](Vec3 p) { return Vec3{p.x, 0.2 + p.y, 0.0}; });
  const Index columns = 12, below = 5;
  std::vector<Index> lowest;  // the lattice's own lowest row, from left to right
  for (Index v = 0; v < mesh.positions.size(); ++v)
    if (std::abs(mesh.positions[v].y - 0.2) < 1e-9) lowest.push_back(v);
  ASSERT_EQ(lowest.size(), columns + 1U);
  std::sort(lowest.begin(), lowest.end(), [&](Index a, Index b) { return mesh.positions[a].x < mesh.positions[b].x; });
  std::vector<Index> above = lowest;
  double y = 0.2;
  const double heights[below] = {0.5, 0.26, 0.13, 0.07, 0.04};  // from the top, shares of 0.08; triangles are 0.083 wide
  for (const double height : heights) {
    y -= 0.08 * height;
    std::vector<Index> row;
    for (Index i = 0; i <= columns; ++i) {
      row.push_back(static_cast<Index>(mesh.positions.size()));
      mesh.positions.push_back({mesh.positions[lowest[i]].x, y, 0.0});
    }
    for (Index i = 0; i < columns; ++i) add(mesh, {row[i], row[i + 1], above[i + 1], above[i]});
    above = row;
  }
  for (const char* metric : {"mean-ratio", kMeanOverCorners}) expect_kept_layers(input(mesh), metric);
}

TEST(BoundaryLayers, OfRealMeshesAreKeptWhileTheRestGetsBetter) {
  const auto folder = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared meshes at " DMOSCOPE_SHARED_DIR;
  Progress progress;
  for (const char* file : {"mixed2d/su2_NACA64A010_hybrid_inv.su2", "quad/su2_primitiveVenturi.su2"}) {
    SCOPED_TRACE(file);
    expect_kept_layers(load_input(folder / file, Need::Smoothing, progress), kMeanOverCorners);
  }
}

}  // namespace
}  // namespace dmoscope::testing
