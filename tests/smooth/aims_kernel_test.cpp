// The search for two aims by packs of candidates finds the bits of the plain one, by any instructions; and handles every star that it is
// meant for.

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/search/mesh_star.h"
#include "core/smooth/kernels/compiled/kernel_set.h"
#include "core/smooth/methods/composite_star_kernel.h"
#include "core/smooth/size_field.h"
#include "tests/smooth/zoo.h"
#include "tests/support/sanitized.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using testing::kSanitized;
using testing::Specimen;

/// Samples of all kinds of aims: each metric of the mesh as the first aim, and as the second one the mean, the next metric, and density.
std::vector<CompositeObjective> kinds_of_aims(const std::shared_ptr<const InputMesh>& mesh) {
  std::vector<Metric> metrics;
  for (const MetricInfo& entry : metric_table()) {
    bool defined = true;
    for (Index e = 0; defined && e < mesh->mesh.elements.size(); ++e) defined = entry.defined_for(mesh->mesh.elements.kind(e));
    if (defined) metrics.push_back(entry.metric);
  }
  std::vector<CompositeObjective> all;
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    all.push_back(raise_mean_above(metrics[i], 0.25));
    all.push_back(composite_objective(metrics[i], {0.3, metrics[(i + 1) % metrics.size()]}, nullptr));
  }
  if (!mesh->is_volume()) {
    const SizeFunction h1{SizeFunction::Kind::Distance, mesh->mesh.positions[0] + Vec3{0.2, 0.1, 0.0}, {}};
    all.push_back(composite_objective(metrics[0], CompositeTerms{0.3, h1}, std::make_shared<const SizeField>(mesh, h1)));
  }
  return all;
}

std::vector<Specimen> specimens() {
  std::vector<Specimen> all = testing::zoo();
  using test::Fill;
  for (const double jitter : {0.2, 0.6}) {
    all.push_back({"volume, tetrahedra", test::volume_grid(3, Fill::Tetrahedra, jitter), {.levels = 2}});
    all.push_back({"volume, hexahedra", test::volume_grid(2, Fill::Hexahedra, jitter), {.levels = 2}});
    all.push_back({"volume, mixed", test::volume_grid(3, Fill::Mixed, jitter), {.levels = 1}});
  }
  all.push_back({"volume, grid 3, levels 2", test::volume_grid(3, Fill::Mixed, 0.2), {.grid_points = 3, .levels = 2}});
  return all;
}

struct Count {
  int vertices = 0, moved = 0, tangled = 0, ready = 0, guarded = 0;
};

SmoothingTask task_of(const std::shared_ptr<const InputMesh>& mesh, const SearchParameters& search) {
  SmoothingTask task;
  task.input = mesh;
  task.search = search;
  std::vector<Index> inside;
  for (Index v = 0; v < mesh->mesh.vertex_count(); ++v)
    if (mesh->topology.boundary()[v] == 0 && !mesh->topology.star(v).empty()) inside.push_back(v);
  task.colouring = std::make_shared<const Colouring>(colour_vertices(mesh->mesh, mesh->topology, inside));
  return task;
}

/// The winners of the plain search, one candidate after the other, level by level.
template <class Frame>
OffsetIn<Frame, double> plain_way(const StarJudge<Frame>& judge, const StarIn<Frame, double>& star, Index v, const SmoothingTask& task) {
  const std::vector<Vec3>& positions = task.input->mesh.positions;
  const auto score = judge.score_of(star, positions, v, false);
  return times(grid_search<double>(score, star.box, task.search).offset, star.scale);
}

template <class Frame>
void compare(const Specimen& specimen, const std::shared_ptr<const InputMesh>& mesh, const CompositeObjective& composite, Count& count) {
  std::vector<std::unique_ptr<CompositeStarKernel<Frame>>> searches;
  SmoothingTask task = task_of(mesh, specimen.search);
  for (const SimdLevel level : supported_simd_levels()) {
    task.search.simd = level;
    searches.push_back(std::make_unique<CompositeStarKernel<Frame>>(task, composite));
  }
  const std::vector<Vec3>& positions = mesh->mesh.positions;
  StarIn<Frame, double> star;
  const StarJudge<Frame> judge(*mesh, composite);
  for (Index v = 0; v < positions.size(); ++v) {
    if (mesh->topology.boundary()[v] != 0 || mesh->topology.star(v).empty()) continue;
    judge.gather(positions, v, star);
    const bool tangled = judge.is_tangled(star);
    const auto plain = plain_way(judge, star, v, task);
    for (std::size_t i = 0; i < searches.size(); ++i) {
      const auto fast = searches[i]->find(positions, v, {}, task.search.levels);
      const std::string_view level = name(supported_simd_levels()[i]);
      ASSERT_FALSE(tangled && fast.ready) << specimen.name << ", vertex " << v << ", " << level;
      if (!fast.ready) continue;
      const auto way = times(fast.offset, fast.scale);
      ASSERT_EQ(std::memcmp(&way, &plain, sizeof(plain)), 0) << specimen.name << ", vertex " << v << ", " << level;
      ++count.ready;
    }
    ++count.vertices;
    count.moved += plain == OffsetIn<Frame, double>{} ? 0 : 1;
    count.tangled += tangled ? 1 : 0;
  }
}

TEST(CompositeKernel, FindsWhatThePlainSearchFinds) {
  Count count;
  std::size_t turn = 0;
  const std::size_t every = kSanitized ? 4 : 2;
  for (Specimen& specimen : specimens()) {
    ++turn;
    if (kSanitized && turn % 5 != 0 && specimen.name.find("volume") == std::string::npos) continue;
    const auto mesh = testing::input(specimen.mesh);
    const std::vector<CompositeObjective> all = kinds_of_aims(mesh);
    for (std::size_t i = 0; i < all.size(); ++i) {
      if ((i + turn) % every != 0) continue;  // each kind of aims on some of the meshes
      if (mesh->is_volume())
        compare<Space>(specimen, mesh, all[i], count);
      else
        compare<Plane>(specimen, mesh, all[i], count);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(count.moved, count.vertices / 2);
  EXPECT_GT(count.tangled, 0);
  EXPECT_GT(count.ready, 0.9 * (count.vertices - count.tangled) * static_cast<double>(supported_simd_levels().size()));
}

/// Regular polygons around a hub beside their middle on one of their axes: candidates on both sides of it are equally good but for
/// rounding.
Mesh symmetric_wheels() {
  Mesh mesh;
  for (Index i = 0; i < 60; ++i) {
    const Index spokes = 3 + i % 8;
    const double angle = 0.1 * (i / 8), away = 0.05 * (1 + i % 5), x = 4.0 * i;
    const auto hub = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back({x + away * std::cos(angle), away * std::sin(angle), 0.0});
    for (Index k = 0; k < spokes; ++k) {
      const double at = angle + 2 * M_PI * k / spokes;
      mesh.positions.push_back({x + std::cos(at), std::sin(at), 0.0});
      testing::add(mesh, {hub, hub + 1 + k, hub + 1 + (k + 1) % spokes});
    }
  }
  return mesh;
}

TEST(CompositeKernel, CutsLeaveWhatThePlainSearchFinds) {
  Count count;
  std::vector<Specimen> all = testing::zoo();
  all.push_back({"symmetric wheels", symmetric_wheels(), {}});
  all.push_back({"lattice", testing::lattice(12, 0.0, 1), {}});
  for (const int points : {2, 3, 5, 8})
    for (const double omega : {0.3, 1.0})
      all.push_back({fmt::format("symmetric wheels, {} points", points), symmetric_wheels(), {.grid_points = points, .omega = omega}});
  std::size_t turn = 0;
  for (Specimen& specimen : all) {
    const auto mesh = testing::input(specimen.mesh);
    const SizeFunction h1{SizeFunction::Kind::Distance, mesh->mesh.positions[0] + Vec3{0.2, 0.1, 0.0}, {}};
    const auto size = std::make_shared<const SizeField>(mesh, h1);
    for (const double threshold : {0.0, 0.3, 0.7, 0.95}) {
      if (kSanitized && ++turn % 3 != 0) continue;
      for (const Metric second : {Metric::MinAngle, Metric::ScaledJacobian}) {
        compare<Plane>(specimen, mesh, composite_objective(Metric::MeanRatio, {threshold, second}, nullptr), count);
        if (HasFatalFailure()) return;
      }
      compare<Plane>(specimen, mesh, composite_objective(Metric::MeanRatio, {threshold, h1}, size), count);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(count.moved, count.vertices / 2);
}

/// The first of the best among candidates anywhere is chosen, with any instructions, as by a plain loop.
template <class Frame>
void compare_lists(const std::shared_ptr<const InputMesh>& mesh, const CompositeObjective& composite, testing::Random& random,
                   Count& count) {
  using Offset = OffsetIn<Frame, double>;
  StarJudge<Frame> judge(*mesh, composite);
  const std::vector<Vec3>& positions = mesh->mesh.positions;
  JudgedStar<Frame> star;
  CandidateList candidates;
  for (Index v = 0; v < positions.size(); ++v) {
    if (mesh->topology.boundary()[v] != 0 || mesh->topology.star(v).empty()) continue;
    judge.gather(positions, v, star);
    if (judge.is_tangled(star)) continue;
    const auto score = judge.score_of(star, positions, v, false);
    candidates.clear();
    for (Index i = 0; i < v % 20; ++i) {  // none, less than a pack, and more; some twice
      const Vec3 p{random(-0.5, 0.5), random(-0.5, 0.5), std::is_same_v<Frame, Plane> ? 0.0 : random(-0.3, 0.3)};
      for (Index times = 0; times < 1 + i % 2; ++times) candidates.add(p);
    }
    const double here = score({});
    double best = here;
    std::size_t first = candidates.size();
    for (std::size_t i = 0; i < candidates.size(); ++i)
      if (const double value = score(candidates.get<Offset>(i)); value > best) best = value, first = i;
    CompositeSearch<Frame> task = search_for<Frame>(composite, {});
    task.star = lists_of(star);
    for (const SimdLevel level : supported_simd_levels()) {
      const CompositeBest found = kernels(level).in<Frame>().composite_list(composite.first)(task, candidates.view(), here);
      ASSERT_TRUE(found.ready);
      ASSERT_EQ(found.index, first) << "vertex " << v << ", " << name(level);
      ASSERT_EQ(found.worth, best) << "vertex " << v << ", " << name(level);
    }
    ++count.vertices;
    count.moved += first < candidates.size() ? 1 : 0;
    if (first == candidates.size()) continue;
    for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian}) {
      CompositeObjective guarded = composite;
      guarded.guard = Guard{metric, 1.0};  // no place is allowed where the metric is less than here
      const StarJudge<Frame> one_by_one(*mesh, guarded);
      const auto allowed = one_by_one.score_of(star, positions, v, false, true);
      double best_allowed = here;
      std::size_t first_allowed = candidates.size();
      for (std::size_t i = 0; i < candidates.size(); ++i)
        if (const double value = allowed(candidates.get<Offset>(i)); value > best_allowed) best_allowed = value, first_allowed = i;
      for (const SimdLevel level : supported_simd_levels()) {
        double found = here;
        const StarJudge<Frame> by_packs(*mesh, guarded, level);
        ASSERT_EQ(by_packs.score_of(star, positions, v, false, true).first_best(candidates, found), first_allowed) << "vertex " << v;
        ASSERT_EQ(found, best_allowed) << "vertex " << v << ", " << name(level);
      }
      count.guarded += first_allowed != first ? 1 : 0;
    }
  }
}

TEST(CompositeKernel, FindsTheFirstBestOfAList) {
  using testing::Cells;
  testing::Random random(8);
  Count flat, curved, solid;
  const auto hilly = [](Vec3 p) { return Vec3{p.x, p.y, 0.1 * std::sin(4 * p.x) * std::cos(3 * p.y)}; };
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals}) {
    const auto plane = testing::input(testing::lattice(7, 0.4, 47, cells)), hills = testing::input(testing::mapped(plane->mesh, hilly));
    for (const CompositeObjective& aims : kinds_of_aims(hills)) {
      if (std::holds_alternative<std::shared_ptr<const PlaceAim>>(aims.second)) continue;
      compare_lists<Plane>(plane, aims, random, flat);
      compare_lists<Curved>(hills, aims, random, curved);
    }
  }
  for (const test::Fill fill : {test::Fill::Tetrahedra, test::Fill::Mixed}) {
    const auto volume = testing::input(test::volume_grid(3, fill, 0.2));
    for (const CompositeObjective& aims : kinds_of_aims(volume)) compare_lists<Space>(volume, aims, random, solid);
  }
  for (const Count& count : {flat, curved, solid}) {
    EXPECT_GT(count.moved, 20);
    EXPECT_GT(count.guarded, 5) << "else no guard was in the way";
  }
}

/// The floor of the phase that raises the mean is mostly the least of some star: that star is not below it.
TEST(CompositeKernel, AStarAtTheFloorIsBeyondIt) {
  const auto mesh = testing::input(testing::lattice(9, 0.35, 46));
  int moved = 0;
  Star<double> star;
  for (Index v = 0; v < mesh->mesh.vertex_count(); ++v) {
    if (mesh->topology.boundary()[v] != 0) continue;
    gather_star(MeshStar(mesh->view<Plane>(), mesh->mesh.positions, v), star);
    const double least = metric_functions<Plane>(Metric::MeanRatio).least_at(star, {}, -1.0);
    if (!(least > 0.0)) continue;
    const CompositeObjective aims = raise_mean_above(Metric::MeanRatio, least);
    const SmoothingTask task = task_of(mesh, {});
    const auto fast = CompositeStarKernel<Plane>(task, aims).search(star, mesh->mesh.positions, v, task.search.levels);
    const Vec2<double> way = times(fast.offset, star.scale), plain = plain_way(StarJudge<Plane>(*mesh, aims), star, v, task);
    EXPECT_TRUE(fast.ready) << v;
    EXPECT_EQ(std::memcmp(&way, &plain, sizeof(plain)), 0) << v;
    moved += plain == Vec2<double>{} ? 0 : 1;
  }
  EXPECT_GT(moved, 20);
}

/// A hub in the middle of a regular polygon, a little to one side.
Star<double> wheel(int spokes) {
  Star<double> star;
  const auto corner = [&](int i) {
    const double angle = 2 * M_PI * i / spokes;
    return Vec2<double>{std::cos(angle) - 0.1, std::sin(angle)};
  };
  for (int i = 0; i < spokes; ++i) star.triangles.push_back({corner(i), corner(i + 1), 1.0});
  star.box = {2.0, 2.0};
  return star;
}

TEST(CompositeKernel, SpeaksForSoundStarsUpToItsLimits) {
  for (const SimdLevel level : supported_simd_levels()) {
    const auto kernel = kernels(level).in<Plane>().composite(Metric::MeanRatio);
    const auto ready = [&](const Star<double>& star, int points) {
      CompositeSearch<Plane> task;
      task.star = lists_of(star);
      task.box = star.box;
      task.points = points;
      task.threshold = 0.01;
      task.inclusive = true;
      return kernel(task).ready;
    };
    const auto most = static_cast<int>(kMaxSimplices);
    for (const int spokes : {3, 6, most}) EXPECT_TRUE(ready(wheel(spokes), 8)) << spokes;
    EXPECT_FALSE(ready(wheel(most + 1), 8));
    for (const int points : {2, 3, kMaxCompositePoints}) EXPECT_TRUE(ready(wheel(6), points)) << points;
    EXPECT_FALSE(ready(wheel(6), kMaxCompositePoints + 1));
    Star<double> inverted = wheel(6);
    std::swap(inverted.triangles[2].b, inverted.triangles[2].c);
    EXPECT_FALSE(ready(inverted, 8));
  }
}

}  // namespace
}  // namespace dmoscope
