// A trace of a visit of a volume shows the smoother's result, bit for bit, and its values hold against the judges of whole meshes.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/inspect/visit_trace.h"
#include "core/mesh/generate.h"
#include "core/mesh/random.h"
#include "core/run/run.h"
#include "core/run/sweep_after.h"
#include "tests/smooth/promises.h"
#include "tests/smooth/zoo.h"
#include "tests/support/inside.h"
#include "tests/support/moving_quality.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

/// The least quality of the changed elements with the vertex at `place`; and whether an element is inverted by the judges of whole meshes.
std::pair<double, bool> judged(const InputMesh& input, std::vector<Vec3>& positions, Metric metric, Index vertex, Vec3 place) {
  const Vec3 before = std::exchange(positions[vertex], place);
  const double quality = testing::moving_quality(input, positions, metric, vertex);
  double jacobian = 1e300;
  for (const Incidence& at : input.topology.star(vertex))
    jacobian = std::min(jacobian, smallest_jacobian(input.quality_context(), positions, at.element));
  positions[vertex] = before;
  return {quality, jacobian <= 0.0};
}

Vec3 box_of(const InputMesh& input, const std::vector<Vec3>& positions, Index vertex) {
  Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const Incidence& at : input.topology.star(vertex))
    for (const Index corner : input.mesh.elements.corners(at.element)) {
      if (corner == vertex) continue;
      const Vec3 p = positions[corner] - positions[vertex];
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  return high - low;
}

/// Rounds to floats.
Vec3 rounded(Vec3 p) {
  for (double* x : {&p.x, &p.y, &p.z}) {
    const volatile auto single = static_cast<float>(*x);
    *x = static_cast<double>(single);
  }
  return p;
}

struct Wish {
  Metric metric = Metric::MeanRatio;
  SearchParameters search{};
  std::optional<Metric> second{};  // second metric of a combination
};

/// Stride of the traced visits: traces of a cube of candidates cost most of the time with a sanitizer.
constexpr std::size_t kEvery = testing::kSanitized ? 3 : 1;

/// Follows a run vertex by vertex, and traces visits before they are made.
class VolumeFollower {
 public:
  VolumeFollower(std::shared_ptr<const InputMesh> input, const Wish& wish)
      : wish_(wish), run_(testing::make_run(std::move(input), parameters_of(wish))) {}

  void follow(int iterations) {
    std::vector<Vec3> positions(run_.positions().begin(), run_.positions().end());
    for (int i = 0; i < iterations; ++i)
      for (const Index vertex : run_.colouring().order) {
        if (made_++ % kEvery != 0) {
          visit(vertex);
          positions[vertex] = run_.positions()[vertex];
          continue;
        }
        const VolumeTrace trace = look(positions, vertex);
        const bool repair = run_.sweep().untangling.repair;
        const std::uint64_t steps = visit(vertex);
        expect_as_stored(trace, steps, positions[vertex]);
        if (trace.end == VisitEnd::Waits) {
          EXPECT_TRUE(repair && trace.before.jacobian > 0.0 && trace.levels.empty());
          continue;
        }
        expect_true_levels(trace, positions);
        expect_true_elements(trace, positions);
        if (::testing::Test::HasFailure()) {
          ADD_FAILURE() << info(wish_.metric).name << ", vertex " << vertex << ", iteration " << i << ": " << trace.sentence();
          return;
        }
        positions[vertex] = run_.positions()[vertex];
        untangling += trace.untangling ? 1U : 0U;
        halved += trace.halvings > 0 && trace.end == VisitEnd::Moved ? 1U : 0U;
        if (repair) continue;  // most stars are left alone
        ++visits;
        moved += steps;
        fast += trace.fast ? 1U : 0U;
      }
  }

  [[nodiscard]] std::uint64_t free() const { return run_.visits_per_iteration(); }
  std::uint64_t visits = 0, moved = 0, fast = 0, untangling = 0, halved = 0;

 private:
  /// Visits the vertex that is next. A step of a tangled mesh would move the vertices around inverted elements together.
  std::uint64_t visit(Index vertex) {
    const bool together =
        run_.moment().visits == 0 && untangles_jointly(run_.history().records(), run_.moment().iteration, run_.input().has_strays);
    return together ? run_.visit_vertices(std::array{vertex}, progress_) : run_.step(StepUnit::Vertex, progress_);
  }
  static RunParameters parameters_of(const Wish& wish) {
    RunParameters parameters{.metric = wish.metric, .search = wish.search, .backend = Backend::Cpu};
    if (wish.second) parameters.combination = CompositeTerms{.threshold = 0.4, .second = *wish.second};
    return parameters;
  }
  [[nodiscard]] VolumeTrace look(const std::vector<Vec3>& positions, Index vertex) const {
    std::optional<CompositeObjective> composite;
    if (wish_.second) composite = CompositeObjective{wish_.metric, 0.4, *wish_.second};
    return trace_volume_visit(run_.input(), positions, run_.fixed(), wish_.metric, wish_.search, vertex, composite, run_.sweep().untangling,
                              run_.guard());
  }

  void expect_as_stored(const VolumeTrace& trace, std::uint64_t moved_now, Vec3 before) {
    EXPECT_TRUE(same_bits(std::vector{trace.from}, std::vector{before}));
    EXPECT_TRUE(same_bits(std::vector{trace.to}, std::vector{run_.positions()[trace.vertex]}));
    EXPECT_EQ(trace.end == VisitEnd::Moved, moved_now == 1);
    EXPECT_NE(static_cast<int>(trace.end), static_cast<int>(VisitEnd::Fixed));
    EXPECT_TRUE(trace.step == trace.to - trace.from);
  }

  void expect_true_levels(const VolumeTrace& trace, std::vector<Vec3>& positions) {
    const SearchParameters& s = wish_.search;
    const Vec3 box = box_of(run_.input(), positions, trace.vertex);
    const double rounding = (trace.fast ? 1e-6 : 1e-14) * (box.x + box.y + box.z);
    ASSERT_EQ(trace.levels.size(), static_cast<std::size_t>(s.levels));
    EXPECT_GE(trace.value_at_start, trace.value_here);
    EXPECT_TRUE(trace.start == Vec3{} || trace.untangling);
    Vec3 reached = trace.start;
    double worth = trace.value_at_start, omega = s.omega;
    for (const VolumeLevel& level : trace.levels) {
      const int n = s.grid_points;
      ASSERT_EQ(level.points, n);
      for (const std::size_t size : {level.values.size(), level.quality.size(), level.offsets.size()})
        ASSERT_EQ(size, static_cast<std::size_t>(n * n * n));
      EXPECT_TRUE(level.centre == reached) << "on the best place so far";
      EXPECT_LE(length(level.size - omega * box), rounding);
      for (int index = 0; index < n * n * n; ++index) {
        const auto part = [n](int i) { return static_cast<double>(i) / (n - 1) - 0.5; };
        const Vec3 expected =
            level.centre + Vec3{part(index / (n * n)) * level.size.x, part(index / n % n) * level.size.y, part(index % n) * level.size.z};
        ASSERT_LE(length(level.at(index) - expected), rounding) << index;
        if (index % 11 == 0 || level.best == index) expect_true_candidate(trace, level, index, positions);
      }
      expect_true_choice(trace, level, reached, worth);
      omega *= 2.0 / (n - 1);
    }
    EXPECT_TRUE(trace.found == reached);
    EXPECT_EQ(trace.end == VisitEnd::NothingFound, trace.found == Vec3{});
  }

  void expect_true_candidate(const VolumeTrace& trace, const VolumeLevel& level, int index, std::vector<Vec3>& positions) const {
    const auto slot = static_cast<std::size_t>(index);
    Vec3 place = trace.from + level.at(index);
    if (run_.input().mesh.single_precision) place = rounded(place);
    const auto [quality, inverted] = judged(run_.input(), positions, wish_.metric, trace.vertex, place);
    if (level.quality[slot] > 0.0) {
      EXPECT_NEAR(level.quality[slot], quality, 1e-12) << index;
      // The compared value is the same but for rounding of the place, and below 0 if the star is inverted inside.
      if (!trace.combined && !(trace.untangling && level.values[slot] < 0.0)) {
        EXPECT_NEAR(level.values[slot], quality, run_.input().mesh.single_precision ? 1e-4 : 1e-7) << index;
      }
    } else {
      EXPECT_TRUE(inverted) << index;
    }
  }

  /// Expects the largest value to be chosen; by the fast search up to a float's rounding.
  void expect_true_choice(const VolumeTrace& trace, const VolumeLevel& level, Vec3& reached, double& worth) const {
    const double rounding = trace.fast ? 1e-4 : 0.0;
    const auto largest = std::ranges::max_element(level.values);
    if (!level.best) {
      EXPECT_LE(*largest, worth + rounding);
      return;
    }
    const double chosen = level.values[static_cast<std::size_t>(*level.best)];
    if (trace.fast) {
      EXPECT_GE(chosen, *largest - rounding);
    } else {
      EXPECT_EQ(*level.best, largest - level.values.begin());
    }
    EXPECT_GT(chosen, worth - rounding);
    worth = std::max(worth, chosen);
    reached = level.at(*level.best);
  }

  void expect_true_elements(const VolumeTrace& trace, const std::vector<Vec3>& positions) const {
    const auto star = run_.input().topology.star(trace.vertex);
    ASSERT_EQ(trace.elements.size(), star.size());
    const QualityContext context = run_.input().quality_context();
    for (std::size_t i = 0; i < star.size(); ++i) {
      const ElementChange& change = trace.elements[i];
      EXPECT_EQ(change.element, star[i].element);
      EXPECT_DOUBLE_EQ(change.before, element_quality(context, positions, wish_.metric, change.element));
      EXPECT_DOUBLE_EQ(change.after, element_quality(context, run_.positions(), wish_.metric, change.element));
      EXPECT_EQ(change.inverted_before, smallest_jacobian(context, positions, change.element) <= 0.0);
      EXPECT_EQ(change.inverted_after, smallest_jacobian(context, run_.positions(), change.element) <= 0.0);
    }
  }

  Wish wish_;
  std::size_t made_ = 0;
  Progress progress_;
  dmoscope::Run run_;
};

Mesh generated(const char* kind) {
  Progress progress;
  return generate_mesh(kind, 125, 5, progress);
}

Mesh tangled(Mesh mesh) {
  dmoscope::Random random(6);
  const auto sound = testing::input(mesh);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    if (sound->topology.boundary()[v] == 0 && random.below(4) == 0)
      mesh.positions[v] = mesh.positions[v] + Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  return mesh;
}

const char* name_of(Precision precision) { return precision == Precision::Float ? ", float" : ", double"; }

class VolumeTraces : public ::testing::TestWithParam<const char*> {};

TEST_P(VolumeTraces, OfSoundStarsByEveryMetric) {
  const auto input = testing::input(generated(GetParam()));
  for (const MetricInfo& entry : metric_table()) {
    if (!testing::defined_for_all(entry.metric, input->mesh)) continue;
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      SCOPED_TRACE(std::string(entry.name) + name_of(precision));
      VolumeFollower follower(input, {.metric = entry.metric, .search = {.precision = precision}});
      follower.follow(1);
      if (HasFailure()) return;
      EXPECT_GT(follower.moved, follower.visits / 3) << "or there is little to follow";
      EXPECT_EQ(follower.untangling, 0U);
      EXPECT_EQ(follower.fast, precision == Precision::Float ? follower.visits : 0U);
    }
  }
}

TEST_P(VolumeTraces, OfTangledStars) {
  const auto input = testing::input(tangled(generated(GetParam())));
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    SCOPED_TRACE(name_of(precision));
    VolumeFollower follower(input, {.search = {.precision = precision}});
    follower.follow(7);  // the first few may be repairs
    if (HasFailure()) return;
    EXPECT_GT(follower.moved, follower.visits / 4);
    EXPECT_GT(follower.untangling, follower.free() / (4 * kEvery)) << "as many as one in eight of two iterations";
  }
}

TEST_P(VolumeTraces, OfOtherGridsAndOfMeshesInHardPlaces) {
  Mesh far = generated(GetParam()), single = far;
  for (Vec3& p : far.positions) p = p + Vec3{1e6, -1e6, 1e6};
  for (Vec3& p : single.positions) p = rounded(p);
  single.single_precision = true;
  for (const Mesh& mesh : {far, single})
    for (const Precision precision : {Precision::Float, Precision::Double}) {
      SCOPED_TRACE(std::string(mesh.single_precision ? "single precision" : "far") + name_of(precision));
      const auto input = testing::input(mesh);
      VolumeFollower(input, {.search = {.grid_points = 5, .levels = 2, .omega = 0.7, .precision = precision}}).follow(1);
      VolumeFollower(input, {.search = {.precision = precision}}).follow(1);
      if (HasFailure()) return;
    }
}

TEST_P(VolumeTraces, OfTwoAims) {
  VolumeFollower follower(testing::input(generated(GetParam())), {.second = Metric::Condition});
  follower.follow(1);
  EXPECT_GT(follower.moved, follower.visits / 4);
  EXPECT_EQ(follower.fast, 0U);
}

/// The best candidate would invert one of four hexahedra inside: the free vertex is the last.
TEST(VolumeTrace, OfAWayThatIsHalved) {
  Mesh mesh;
  mesh.positions = {{0.8514, 0.8539, 1.1988},   {1.2936, -0.8836, -0.7547}, {-0.7375, 1.0251, -0.9698}, {-1.1629, -1.2739, 1.0896},
                    {1.2509, -0.3208, 0.2392},  {-0.2917, 0.7289, -0.1532}, {0.0084, -0.1108, 0.6599},  {-0.3226, 0.0665, -1.3378},
                    {-0.2358, -0.7168, 0.0374}, {-1.0174, 0.2277, 0.0618},  {0.2875, 0.5104, -0.0024},  {0.5801, -0.4962, 0.2466},
                    {-0.216, 0.1922, 0.6706},   {-0.3115, -0.163, -0.6117}, {-0.1275, -0.017, -0.1595}};
  for (const auto& corners : {std::vector<Index>{0, 5, 10, 4, 6, 12, 14, 11}, std::vector<Index>{1, 4, 10, 7, 8, 11, 14, 13},
                              std::vector<Index>{2, 7, 10, 5, 9, 13, 14, 12}, std::vector<Index>{3, 6, 11, 8, 9, 12, 14, 13}})
    mesh.elements.add(ElementKind::Hexahedron, corners);
  const auto input = testing::input(mesh);
  ASSERT_EQ(test::inverted_inside(mesh, mesh.positions), 0U);
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    VolumeFollower follower(input, {.search = {.precision = precision}});
    follower.follow(1);
    EXPECT_EQ(follower.halved, testing::kSanitized ? follower.halved : 1U);
    const VolumeTrace trace =
        trace_volume_visit(*input, mesh.positions, input->topology.boundary(), Metric::MeanRatio, {.precision = precision}, 14);
    ASSERT_GT(trace.halvings, 0);
    EXPECT_NEAR(length(trace.step), length(trace.found) / (1 << trace.halvings), 1e-12);
    EXPECT_GT(trace.after.quality, trace.before.quality);
    std::vector<Vec3> all_of_it = mesh.positions, moved = mesh.positions;
    all_of_it[14] = all_of_it[14] + trace.found;
    moved[14] = trace.to;
    EXPECT_EQ(test::inverted_inside(mesh, all_of_it), 1U);
    EXPECT_EQ(test::inverted_inside(mesh, moved), 0U);
    EXPECT_NE(trace.sentence().find("of the way, since all of it would invert an element inside"), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(VisitTrace, VolumeTraces, ::testing::Values("tetrahedra", "hexahedra", "solids"));

TEST(VolumeTrace, AVertexInTheMiddleOfAnOctahedronStaysAndOneAsideGoesThere) {
  const auto octahedron = [](Vec3 hub) {
    Mesh mesh;
    mesh.positions = {hub, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (Index i = 0; i < 4; ++i) {
      const Index a = 1 + i, b = 1 + (i + 1) % 4;
      mesh.elements.add(ElementKind::Tetrahedron, std::vector<Index>{0, a, b, 5});
      mesh.elements.add(ElementKind::Tetrahedron, std::vector<Index>{0, b, a, 6});
    }
    return testing::input(std::move(mesh));
  };
  const auto look = [](const std::shared_ptr<const InputMesh>& input, Precision precision) {
    return trace_volume_visit(*input, input->mesh.positions, input->topology.boundary(), Metric::MeanRatio, {.precision = precision}, 0);
  };
  for (const Precision precision : {Precision::Float, Precision::Double}) {
    EXPECT_EQ(look(octahedron({}), precision).sentence(), "stays: no candidate is better than where it stands");
    const VolumeTrace aside = look(octahedron({0.4, -0.2, 0.3}), precision);
    EXPECT_EQ(aside.sentence().substr(0, 34), "moved: worst element of its star 0");
    EXPECT_EQ(aside.fast, precision == Precision::Float);
    EXPECT_EQ(aside.value_phrase, "mean ratio");
    EXPECT_LT(length(aside.to), 0.05);
    // The octants of a regular octahedron: 12 (3 V)^(2/3) / sum of squared edges, with V = 1/6, edges 1, 1, 1 and three of sqrt 2.
    EXPECT_NEAR(look(octahedron({}), precision).before.quality, 12 * std::pow(0.5, 2.0 / 3.0) / 9, 1e-12);
    const VolumeTrace outside = look(octahedron({1.4, 0.1, 0.05}), precision);
    EXPECT_EQ(outside.sentence().substr(0, 20), "moved: untangled its");
    EXPECT_TRUE(outside.untangling);
    EXPECT_FALSE(outside.fast);
  }
  const auto input = octahedron({});
  const VolumeTrace fixed = trace_volume_visit(*input, input->mesh.positions, input->topology.boundary(), Metric::MeanRatio, {}, 1);
  EXPECT_EQ(static_cast<int>(fixed.end), static_cast<int>(VisitEnd::Fixed));
  EXPECT_TRUE(fixed.levels.empty());
  EXPECT_EQ(fixed.elements.size(), 4U);
}

TEST(VolumeTrace, RefusesWhatCannotBeSearched) {
  const auto input = testing::input(generated("hexahedra"));
  const auto look = [](const InputMesh& mesh, Index vertex, Metric metric, SearchParameters search) {
    return trace_volume_visit(mesh, mesh.mesh.positions, mesh.topology.boundary(), metric, search, vertex);
  };
  EXPECT_THROW((void)look(*input, input->mesh.vertex_count(), Metric::MeanRatio, {}), UsageError);
  EXPECT_THROW((void)look(*input, 0, Metric::RadiusRatio, {}), UsageError) << "a tetrahedron's";
  EXPECT_THROW((void)look(*input, 0, Metric::MeanRatio, {.levels = 0}), UsageError);
  EXPECT_THROW((void)look(*testing::input(testing::lattice(4, 0.2, 1)), 5, Metric::MeanRatio, {}), UsageError) << "planar";
  EXPECT_THROW((void)trace_visit(*input, input->mesh.positions, input->topology.boundary(), Metric::MeanRatio, {}, 0), UsageError);
}

}  // namespace
}  // namespace dmoscope
