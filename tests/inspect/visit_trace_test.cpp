// A trace of a visit shows the smoother's result, bit for bit, and its values hold against separate formulas.

#include "core/inspect/visit_trace.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/mesh/generate.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "tests/smooth/zoo.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

std::shared_ptr<const InputMesh> generated(std::string_view kind, std::size_t size) {
  Progress progress;
  return testing::input(generate_mesh(kind, size, 3, progress));
}

/// Quality of the star of `vertex` at `place`, by the judges of whole meshes.
double quality_at(const InputMesh& input, std::vector<Vec3>& positions, Metric metric, Index vertex, Vec3 place) {
  const Vec3 before = std::exchange(positions[vertex], place);
  double quality = 1e300, jacobian = 1e300;
  for (const Incidence& at : input.topology.star(vertex)) {
    quality = std::min(quality, element_quality(input.quality_context(), positions, metric, at.element));
    jacobian = std::min(jacobian, smallest_jacobian(input.quality_context(), positions, at.element) / input.reference_measure[at.element]);
  }
  positions[vertex] = before;
  return jacobian > 0.0 ? quality : jacobian;
}

/// The bounding box of the other vertices of the star, in the plane; and the place in space of an offset in the plane.
Vec2<double> plane_box_of(const InputMesh& input, const std::vector<Vec3>& positions, Index vertex) {
  const Plane& plane = input.geometry.plane;
  Vec2<double> low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Incidence& at : input.topology.star(vertex))
    for (const Index corner : input.mesh.elements.corners(at.element)) {
      if (corner == vertex) continue;
      const Vec2<double> p = plane.project(positions[corner] - positions[vertex]);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  return high - low;
}

/// The mean of the star's other corners, counted as often as they occur.
Vec2<double> middle_of(const InputMesh& input, const std::vector<Vec3>& positions, Index vertex) {
  Vec3 sum{};
  double count = 0.0;
  for (const Incidence& at : input.topology.star(vertex))
    for (const Index corner : input.mesh.elements.corners(at.element)) {
      if (corner == vertex) continue;
      sum = sum + (positions[corner] - positions[vertex]);
      count += 1.0;
    }
  return input.geometry.plane.project(1.0 / count * sum);
}

/// Follows a run vertex by vertex, and traces one visit of `stride` before it is made.
class Follower {
 public:
  Follower(std::shared_ptr<const InputMesh> input, Metric metric, SearchParameters search, std::size_t stride = 1)
      : run_(std::move(input), {.metric = metric, .search = search, .backend = Backend::Cpu}, std::make_shared<ThreadPool>(1),
             std::size_t{1} << 28U),
        stride_(stride) {}

  void follow(int iterations) {
    const std::vector<Index> order = run_.colouring().order;
    for (int i = 0; i < iterations && !::testing::Test::HasFailure(); ++i) {
      // A step of a tangled mesh would move the vertices around inverted elements together.
      const bool together =
          run_.moment().visits == 0 && untangles_jointly(run_.history().records(), run_.moment().iteration, run_.input().has_strays);
      const std::uint64_t iteration = run_.moment().iteration + (run_.moment().visits > 0 ? 1 : 0);
      for (std::size_t k = static_cast<std::size_t>(i) % stride_; k < order.size(); k += stride_) {
        const Index vertex = order[k];
        if (!together) run_.seek({iteration, k}, progress_);
        std::vector<Vec3> positions(run_.positions().begin(), run_.positions().end());
        const VisitTrace trace =
            trace_visit(run_.input(), positions, run_.fixed(), metric(), search(), vertex, {}, run_.sweep().untangling, run_.guard());
        const bool repair = run_.sweep().untangling.repair;
        const std::uint64_t moved = together ? run_.visit_vertices(std::array{vertex}, progress_) : run_.step(StepUnit::Vertex, progress_);
        expect_as_stored(trace, vertex, moved, positions[vertex]);
        if (trace.end == VisitEnd::Waits) {
          EXPECT_TRUE(repair && trace.before.jacobian > 0.0 && trace.levels.empty());
          continue;
        }
        expect_true_levels(trace, positions);
        expect_true_elements(trace, positions);
        if (::testing::Test::HasFailure()) {
          ADD_FAILURE() << info(metric()).name << ", vertex " << vertex << ", iteration " << i << ": " << trace.sentence();
          return;
        }
        if (repair) continue;  // most stars are left alone
        ++visits_;
        moved_ += moved;
        fast_ += trace.fast ? 1U : 0U;
        not_first_ += not_first_of_this_;
      }
    }
  }

  [[nodiscard]] std::uint64_t visits() const { return visits_; }
  [[nodiscard]] std::uint64_t moved() const { return moved_; }
  [[nodiscard]] std::uint64_t fast() const { return fast_; }
  /// Levels whose winner is not the first of the largest values.
  [[nodiscard]] std::uint64_t not_first() const { return not_first_; }

 private:
  [[nodiscard]] Metric metric() const { return run_.parameters().metric; }
  [[nodiscard]] const SearchParameters& search() const { return run_.parameters().search; }
  /// Whether threshold rounds find the winner without the others' values.
  [[nodiscard]] bool by_rounds(const VisitTrace& trace) const {
    return trace.fast && search().grid_points == 8 && (metric() == Metric::MeanRatio || metric() == Metric::MeanRatioArea);
  }

  void expect_as_stored(const VisitTrace& trace, Index vertex, std::uint64_t moved, Vec3 before) {
    EXPECT_EQ(trace.vertex, vertex);
    EXPECT_TRUE(same_bits(trace.from, before));
    EXPECT_TRUE(same_bits(trace.to, run_.positions()[vertex]));
    EXPECT_EQ(trace.end == VisitEnd::Moved, moved == 1);
    EXPECT_NE(static_cast<int>(trace.end), static_cast<int>(VisitEnd::Fixed));
    const Vec2<double> step = run_.input().geometry.plane.project(trace.to - trace.from);
    EXPECT_TRUE(same_bits(trace.step.x, step.x) && same_bits(trace.step.y, step.y));
  }

  void expect_true_levels(const VisitTrace& trace, std::vector<Vec3>& positions) {
    const SearchParameters& s = search();
    const Vec2<double> box = plane_box_of(run_.input(), positions, trace.vertex);
    // Rounding of a float, relative to the largest number.
    const double rounding = (trace.fast ? 1e-6 : 1e-14) * (std::fabs(box.x) + std::fabs(box.y));
    const auto close = [rounding](Vec2<double> a, Vec2<double> b) {
      return std::fabs(a.x - b.x) <= rounding && std::fabs(a.y - b.y) <= rounding;
    };
    not_first_of_this_ = 0;
    ASSERT_EQ(trace.levels.size(), static_cast<std::size_t>(s.levels));
    EXPECT_GE(trace.value_at_start, trace.value_here);
    if (!(trace.start == Vec2<double>{})) {
      EXPECT_TRUE(trace.untangling);
      EXPECT_TRUE(close(trace.start, middle_of(run_.input(), positions, trace.vertex)));
    }
    Vec2<double> best_offset = trace.start;
    double best_value = trace.value_at_start, omega = s.omega;
    for (const TracedLevel& level : trace.levels) {
      const int n = s.grid_points;
      ASSERT_EQ(level.points, n);
      ASSERT_EQ(level.values.size(), static_cast<std::size_t>(n * n));
      ASSERT_EQ(level.quality.size(), level.values.size());
      ASSERT_EQ(level.offsets.size(), level.values.size());
      EXPECT_TRUE(same_bits(level.centre.x, best_offset.x) && same_bits(level.centre.y, best_offset.y)) << "on the best place so far";
      EXPECT_TRUE(close(level.size, {omega * box.x, omega * box.y}));
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const Vec2<double> expected{level.centre.x + (static_cast<double>(i) / (n - 1) - 0.5) * level.size.x,
                                      level.centre.y + (static_cast<double>(j) / (n - 1) - 0.5) * level.size.y};
          EXPECT_TRUE(close(level.at(i * n + j), expected)) << i << ' ' << j;
          const Vec2<double> at = level.at(i * n + j);
          const Vec3 place = place_of(trace, at);
          EXPECT_NEAR(level.quality[static_cast<std::size_t>(i * n + j)],
                      quality_at(run_.input(), positions, metric(), trace.vertex, place), 1e-12);
        }
      const auto largest = std::ranges::max_element(level.values);
      if (level.best) {
        const double chosen = level.values[static_cast<std::size_t>(*level.best)];
        if (by_rounds(trace)) {
          EXPECT_GE(chosen, *largest - 2e-6);
          not_first_of_this_ += *level.best == largest - level.values.begin() ? 0U : 1U;
        } else {
          EXPECT_EQ(*level.best, largest - level.values.begin());
        }
        EXPECT_GT(chosen, best_value - (by_rounds(trace) ? 2e-6 : 0.0));
        best_value = std::max(best_value, chosen);
        best_offset = level.at(*level.best);
      } else {
        EXPECT_LE(*largest, best_value + (by_rounds(trace) ? 2e-6 : 0.0));
      }
      omega *= 2.0 / (n - 1);
    }
    EXPECT_TRUE(same_bits(trace.found.x, best_offset.x) && same_bits(trace.found.y, best_offset.y));
    const bool found = trace.found.x != 0.0 || trace.found.y != 0.0;
    EXPECT_EQ(trace.end == VisitEnd::NothingFound, !found);
    if (trace.end == VisitEnd::Moved) {
      EXPECT_TRUE(same_bits(place_of(trace, trace.found), trace.to));
    }
  }

  /// The stored place of the vertex for an offset in the plane.
  [[nodiscard]] Vec3 place_of(const VisitTrace& trace, Vec2<double> offset) const {
    const Plane& plane = run_.input().geometry.plane;
    const auto sum = [&](double at, double u, double v) {
      const double step = offset.x * u + offset.y * v;
      const double to = step == 0.0 ? at : at + step;
      if (!run_.input().mesh.single_precision || step == 0.0) return to;
      const volatile auto rounded = static_cast<float>(to);
      return static_cast<double>(rounded);
    };
    return {sum(trace.from.x, plane.u.x, plane.v.x), sum(trace.from.y, plane.u.y, plane.v.y), sum(trace.from.z, plane.u.z, plane.v.z)};
  }

  void expect_true_elements(const VisitTrace& trace, std::vector<Vec3>& positions) {
    const auto star = run_.input().topology.star(trace.vertex);
    ASSERT_EQ(trace.elements.size(), star.size());
    const QualityContext context = run_.input().quality_context();
    for (std::size_t i = 0; i < star.size(); ++i) {
      const ElementChange& change = trace.elements[i];
      EXPECT_EQ(change.element, star[i].element);
      EXPECT_TRUE(same_bits(change.before, element_quality(context, positions, metric(), change.element)));
      EXPECT_EQ(change.inverted_before, smallest_jacobian(context, positions, change.element) <= 0.0);
      EXPECT_TRUE(same_bits(change.after, element_quality(context, run_.positions(), metric(), change.element)));
      EXPECT_EQ(change.inverted_after, smallest_jacobian(context, run_.positions(), change.element) <= 0.0);
    }
    EXPECT_TRUE(same_bits(quality_of(trace.before), quality_at(run_.input(), positions, metric(), trace.vertex, trace.from)));
    EXPECT_TRUE(same_bits(quality_of(trace.after), quality_at(run_.input(), positions, metric(), trace.vertex, trace.to)));
  }

  Progress progress_;
  Run run_;
  std::size_t stride_;
  std::uint64_t visits_ = 0, moved_ = 0, fast_ = 0, not_first_ = 0, not_first_of_this_ = 0;
};

class EveryMetric : public ::testing::TestWithParam<Metric> {};

void expect_true_traces(const std::shared_ptr<const InputMesh>& input, Metric metric, SearchParameters search, int iterations = 2,
                        std::size_t stride = 1) {
  if (!testing::defined_for_all(metric, input->mesh)) return;
  Follower follower(input, metric, search, stride);
  follower.follow(iterations + (input->has_strays ? 1 : 0));  // the first is a repair
  EXPECT_GT(follower.moved(), follower.visits() / 20);
  if (search.precision == Precision::Double) {
    EXPECT_EQ(follower.fast(), 0U);
  } else {
    EXPECT_GT(follower.fast(), follower.visits() / 4);
  }
  EXPECT_LE(follower.not_first(), follower.visits() / 20) << "of equals within rounding the rounds may choose any";
}

TEST_P(EveryMetric, OfGeneratedMeshes) {
  for (const char* kind : {"mixed", "quads", "tangled", "coast"})
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      SCOPED_TRACE(std::string(kind) + (precision == Precision::Float ? ", float" : ", double"));
      expect_true_traces(generated(kind, 300), GetParam(), {.precision = precision});
      if (HasFailure()) return;
    }
}

TEST_P(EveryMetric, OfStarsOfEveryForm) {
  for (const auto& mesh : {testing::wheels(1), testing::two_layers(), testing::mixed_stars(), testing::graded()}) {
    SCOPED_TRACE(mesh.name);
    expect_true_traces(testing::input(mesh), GetParam(), {}, 1);
    if (HasFailure()) return;
  }
}

TEST_P(EveryMetric, OfOtherGridsAndOfMeshesInHardPlaces) {
  const Mesh base = testing::lattice(7, 0.4, 45, testing::Cells::Mixed);
  for (const int points : {5, 9}) {
    SCOPED_TRACE(points);
    for (const Precision precision : {Precision::Float, Precision::Double})
      expect_true_traces(testing::input(base), GetParam(), {.grid_points = points, .levels = 2, .omega = 0.7, .precision = precision}, 1);
    if (HasFailure()) return;
  }
  Mesh single = base, tilted = testing::lattice(7, 0.4, 45);
  single.single_precision = true;
  for (Vec3& p : single.positions) p = {static_cast<float>(p.x + 1e4), static_cast<float>(p.y + 1e4), 0};
  for (Vec3& p : tilted.positions) p = {0.6 * p.x + 7, p.y - 3, 0.8 * p.x + 2};
  for (const Mesh& mesh : {single, tilted})
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      SCOPED_TRACE(mesh.single_precision ? "single precision" : "tilted");
      expect_true_traces(testing::input(mesh), GetParam(), {.precision = precision}, 1);
      if (HasFailure()) return;
    }
}

TEST_P(EveryMetric, OfEast14) {
  const std::filesystem::path file = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes/ocean/east.14";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no shared meshes here";
  Progress progress;
  const auto input = load_input(file, Need::Smoothing, progress);
  // Only some visits are traced: the mesh has 10147 vertices, and a trace costs a hundred times the visit. The second iteration's are the
  // vertices next to the first's.
  constexpr std::size_t kStride = testing::kSanitized ? 509 : 37;
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    SCOPED_TRACE(precision == Precision::Float ? "float" : "double");
    expect_true_traces(input, GetParam(), {.precision = precision}, 2, kStride);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(VisitTrace, EveryMetric, ::testing::ValuesIn([] {
                           std::vector<Metric> all;
                           for (const MetricInfo& entry : metric_table()) all.push_back(entry.metric);
                           return all;
                         }()),
                         [](const auto& tested) {
                           std::string name(dmoscope::info(tested.param).name);
                           std::erase(name, '-');
                           return name;
                         });

TEST(VisitTrace, OfAFixedVertexHasNoLevels) {
  const auto input = testing::input(testing::lattice(4, 0.2, 1));
  const auto boundary = input->topology.boundary();
  const VisitTrace trace = trace_visit(*input, input->mesh.positions, boundary, Metric::MeanRatio, {}, 1);
  EXPECT_EQ(static_cast<int>(trace.end), static_cast<int>(VisitEnd::Fixed));
  EXPECT_TRUE(trace.levels.empty());
  EXPECT_EQ(trace.elements.size(), input->topology.star(1).size());
  EXPECT_TRUE(same_bits(trace.from, trace.to));
  EXPECT_EQ(trace.sentence(), "fixed: it is not searched");
}

TEST(VisitTrace, SaysWhatCameOfIt) {
  const auto hexagon = [](Vec3 hub) {
    Mesh mesh;
    mesh.positions.push_back(hub);
    for (int i = 0; i < 6; ++i) mesh.positions.push_back({std::cos(i * M_PI / 3), std::sin(i * M_PI / 3), 0});
    for (Index i = 0; i < 6; ++i) testing::add(mesh, {0, 1 + i, 1 + (i + 1) % 6});
    return testing::input(std::move(mesh));
  };
  const auto look = [](const std::shared_ptr<const InputMesh>& input) {
    return trace_visit(*input, input->mesh.positions, input->topology.boundary(), Metric::MeanRatio, {}, 0);
  };
  EXPECT_EQ(look(hexagon({})).sentence(), "stays: no candidate is better than where it stands");
  const VisitTrace aside = look(hexagon({0.5, 0.1, 0}));
  EXPECT_EQ(aside.sentence().substr(0, 34), "moved: worst element of its star 0");
  EXPECT_TRUE(aside.fast);
  EXPECT_EQ(aside.value_phrase, "mean ratio");
  EXPECT_LT(std::hypot(aside.to.x, aside.to.y), 0.02);
  const VisitTrace outside = look(hexagon({1.5, 0.1, 0}));
  EXPECT_EQ(outside.sentence().substr(0, 20), "moved: untangled its");
  EXPECT_TRUE(outside.untangling);
  EXPECT_FALSE(outside.fast);
}

TEST(VisitTrace, RefusesWhatCannotBeSearched) {
  const auto input = testing::input(testing::lattice(4, 0.2, 1, testing::Cells::Mixed));
  const auto look = [&](Index vertex, Metric metric, SearchParameters search) {
    return trace_visit(*input, input->mesh.positions, input->topology.boundary(), metric, search, vertex);
  };
  EXPECT_THROW((void)look(input->mesh.vertex_count(), Metric::MeanRatio, {}), UsageError);
  EXPECT_THROW((void)look(6, Metric::MinAngle, {}), UsageError) << "a quadrilateral's";
  EXPECT_NO_THROW((void)look(8, Metric::MinAngle, {})) << "only triangles around";
  EXPECT_THROW((void)look(8, Metric::MinAngle, {.levels = 0}), UsageError);
}

}  // namespace
}  // namespace dmoscope
