// Boundary layers of the input stay unless told otherwise.

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/run/hints.h"
#include "core/run/run.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::add;
using testing::input;

/// Layers of heights 0.01 growth^k on a wall, as many as there are; above them squares whose vertices are displaced.
Mesh with_layers(Index layers, double growth, double first) {
  Mesh mesh;
  constexpr Index kAlong = 8, kAbove = 5;
  constexpr double kWidth = 0.2;
  testing::Random random(3);
  double y = 0.0, height = first;
  for (Index j = 0; j <= layers + kAbove; ++j) {
    for (Index i = 0; i <= kAlong; ++i) {
      const bool moves = j > layers && j < layers + kAbove && i > 0 && i < kAlong;
      const bool leans = j > 0 && j <= layers && i > 0 && i < kAlong;
      const double dx = moves ? random(-0.08, 0.08) : leans ? random(-0.02, 0.02) : 0.0, dy = moves ? random(-0.08, 0.08) : 0.0;
      mesh.positions.push_back({kWidth * static_cast<double>(i) + dx, y + dy, 0.0});
    }
    y += j < layers ? height : kWidth;
    height *= growth;
  }
  for (Index j = 0; j < layers + kAbove; ++j)
    for (Index i = 0; i < kAlong; ++i) {
      const Index a = j * (kAlong + 1) + i;
      add(mesh, {a, a + 1, a + kAlong + 2, a + kAlong + 1});
    }
  return mesh;
}

dmoscope::Run smoothed(const std::shared_ptr<const InputMesh>& mesh, LayerRule rule) {
  RunParameters parameters{.layers = rule};
  parameters.boundary = BoundaryRule::Slide;
  dmoscope::Run run(mesh, parameters, std::make_shared<ThreadPool>(1), 0);
  Progress progress;
  run.iterate(20, progress);
  return run;
}

TEST(Layers, StayUnlessTheyAreLetGo) {
  const auto mesh = input(with_layers(5, 1.5, 0.01));
  ASSERT_EQ(mesh->layers.size(), 6U * 9U) << "the vertices of five layers of eight elements";
  const dmoscope::Run kept = smoothed(mesh, LayerRule::Keep), free = smoothed(mesh, LayerRule::Free);
  const auto stays = [&](const dmoscope::Run& run) {
    return std::ranges::all_of(mesh->layers, [&](Index v) { return run.positions()[v] == mesh->mesh.positions[v]; });
  };
  EXPECT_TRUE(stays(kept));
  EXPECT_FALSE(stays(free));
  EXPECT_FALSE(same_bits(kept.positions(), mesh->mesh.positions)) << "the rest moves";
  const Index inside = 9 + 4;  // the first row above the wall
  EXPECT_EQ(kept.why_fixed(inside), "it lies in a boundary layer, which is kept");
}

TEST(Layers, AreNamedWhereTheyHoldTheMinimum) {
  Progress progress;
  dmoscope::Run run(input(with_layers(5, 1.5, 0.01)), {}, std::make_shared<ThreadPool>(1), 0);
  run.iterate(20, progress);
  const auto held = what_holds(run, nullptr, progress);
  ASSERT_TRUE(held && held->change);
  EXPECT_EQ(held->change->command(), "layers free");
  EXPECT_EQ(held->gives_up(), "boundary layers");
  RunParameters free = run.parameters();
  free.layers = LayerRule::Free;
  dmoscope::Run let_go(run.shared_input(), free, std::make_shared<ThreadPool>(1), 0);
  let_go.iterate(20, progress);
  EXPECT_GT(let_go.statistics().minimum, run.statistics().minimum) << "what is offered raises it";
}

/// How quadrilaterals are cut into triangles: all alike, in turn, or at random.
enum class Cut { Alike, InTurn, AtRandom };
Mesh in_triangles(const Mesh& mesh, Cut cut) {
  Mesh result;
  result.positions = mesh.positions;
  testing::Random random(5);
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto c = mesh.elements.corners(e);
    const bool other = cut == Cut::AtRandom ? random() < 0.5 : cut == Cut::InTurn && e % 2 == 1;
    const std::size_t first = other ? 1 : 0;
    add(result, {c[first], c[first + 1], c[first + 2]});
    add(result, {c[first], c[first + 2], c[(first + 3) % 4]});
  }
  return result;
}

TEST(Layers, OfTrianglesAreThoseThatQuadrilateralsWereCutInto) {
  for (const Cut cut : {Cut::Alike, Cut::InTurn, Cut::AtRandom}) {
    const auto mesh = input(in_triangles(with_layers(5, 1.5, 0.01), cut));
    EXPECT_EQ(mesh->layers, input(with_layers(5, 1.5, 0.01))->layers);
    const dmoscope::Run kept = smoothed(mesh, LayerRule::Keep);
    for (const Index v : mesh->layers) EXPECT_EQ(kept.positions()[v], mesh->mesh.positions[v]);
    EXPECT_TRUE(input(in_triangles(with_layers(5, 1.0, 0.03), cut))->layers.empty()) << "they do not grow";
    EXPECT_TRUE(input(in_triangles(with_layers(5, 3.0, 0.01), cut))->layers.empty()) << "they grow too fast";
    EXPECT_TRUE(input(in_triangles(with_layers(5, 1.5, 0.1), cut))->layers.empty()) << "the first is only twice as wide as high";
    Mesh distorted = with_layers(5, 1.5, 0.01);
    for (Vec3& p : distorted.positions) p.x += 4.0 * p.y;
    EXPECT_TRUE(input(in_triangles(distorted, cut))->layers.empty());
  }
  Mesh flat = testing::lattice(12, 0.0, 1);
  EXPECT_TRUE(input(flat)->layers.empty());
  for (Vec3& p : flat.positions) p.y *= 0.1;
  EXPECT_TRUE(input(flat)->layers.empty()) << "all of a height";
}

TEST(Layers, AreNotWhatIsMerelyStretched) {
  EXPECT_TRUE(input(with_layers(5, 1.0, 0.03))->layers.empty()) << "they do not grow";
  EXPECT_TRUE(input(with_layers(5, 1.5, 0.1))->layers.empty()) << "the first is only twice as wide as high";
  EXPECT_TRUE(input(with_layers(2, 2.0, 0.01))->layers.empty()) << "two";
}

TEST(Layers, AreNotADistortedGrid) {
  Mesh mesh = with_layers(5, 1.5, 0.01);
  for (Vec3& p : mesh.positions) p.x += 4.0 * p.y;  // at 14 degrees on the wall
  EXPECT_TRUE(input(std::move(mesh))->layers.empty());
}

TEST(Layers, OfInvertedElementsAreFree) {
  Mesh mesh = with_layers(5, 1.5, 0.01);
  const Index v = 9 + 4;
  mesh.positions[v].y = 0.5;  // above its upper neighbour
  const auto tangled = input(std::move(mesh));
  EXPECT_LT(tangled->layers.size(), 6U * 9U);
  EXPECT_FALSE(std::ranges::binary_search(tangled->layers, v));
}

}  // namespace
}  // namespace dmoscope
