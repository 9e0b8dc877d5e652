// The visible part of a volume mesh, against a search over every face of every cell, and against closed skins.
#include <algorithm>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/clipping/clipping.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using test::Fill;
using test::volume_grid;

std::vector<float> random_quality(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<float> quality(count);
  for (float& q : quality) q = static_cast<float>(random() % 1000) / 1000.0F;
  return quality;
}

/// A mesh with all that looking inside needs.
struct Block {
  explicit Block(Mesh m, unsigned seed = 1)
      : mesh(std::move(m)), neighbours(mesh), quality(random_quality(mesh.elements.size(), seed)), inverted(mesh.elements.size(), 0) {
    inverted[mesh.elements.size() / 2] = 1;
    quality[mesh.elements.size() / 3] = std::nanf("");
  }
  [[nodiscard]] CellState state() const { return {mesh.positions, quality, inverted, serial}; }
  Mesh mesh;
  FaceNeighbours neighbours;
  std::vector<float> quality;
  std::vector<std::uint8_t> inverted;
  std::uint64_t serial = 1;
};

/// The vertices of a face as a set.
std::set<Index> vertex_set(const Mesh& mesh, ElementFace face) {
  std::set<Index> vertices;
  for (const Index v : vertices_of(mesh.elements, face)) {
    if (v != kNoIndex) vertices.insert(v);
  }
  return vertices;
}

/// Layers, found by comparing all pairs of faces again and again.
std::vector<Index> slow_layers(const Mesh& mesh) {
  std::map<std::set<Index>, std::vector<Index>> owners;
  const auto for_faces = [&](auto&& visit) {
    for (Index e = 0; e < mesh.elements.size(); ++e) {
      for (Index f = 0; f < faces_of(mesh.elements.kind(e)).size(); ++f) visit(ElementFace{e, f});
    }
  };
  for_faces([&](ElementFace f) { owners[vertex_set(mesh, f)].push_back(f.element); });
  std::vector<Index> layers(mesh.elements.size(), kNoIndex);
  for (const auto& [key, of] : owners) {
    if (of.size() == 1) layers[of[0]] = 0;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [key, of] : owners) {
      if (of.size() != 2) continue;
      for (const std::size_t side : {0U, 1U}) {
        const Index from = layers[of[side]];
        if (from == kNoIndex || layers[of[1 - side]] <= from + 1) continue;
        layers[of[1 - side]] = from + 1;
        changed = true;
      }
    }
  }
  return layers;
}

std::vector<bool> slow_visible(const Block& block, const ClippingView& view) {
  const Mesh& mesh = block.mesh;
  const std::vector<Index> layers = slow_layers(mesh);
  std::vector<std::pair<double, Index>> ranks;  // all qualities are at most 10
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    if (block.inverted[e] != 0)
      ranks.emplace_back(std::isnan(block.quality[e]) ? -1e9 : block.quality[e] - 1e6, e);
    else if (!std::isnan(block.quality[e]))
      ranks.emplace_back(block.quality[e], e);
  }
  std::ranges::sort(ranks);
  ranks.resize(std::min(ranks.size(), view.worst));
  std::vector<bool> visible(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    bool seen = true;
    if (view.clip.on) {
      seen = std::ranges::any_of(mesh.elements.corners(e), [&](Index v) { return view.clip.beyond(mesh.positions[v]) < 0.0; });
    }
    if (layers[e] < view.peel) seen = false;
    const bool inverted = block.inverted[e] != 0;
    if (view.peel_quality && !inverted && block.quality[e] > *view.peel_quality) seen = false;
    if (view.isolate) {
      const bool within =
          inverted ? view.isolate->first <= 0 : block.quality[e] >= view.isolate->first && block.quality[e] <= view.isolate->second;
      seen = seen && within;
    }
    if (view.worst > 0 && std::ranges::none_of(ranks, [&](const auto& r) { return r.second == e; })) seen = false;
    visible[e] = seen;
  }
  return visible;
}

std::vector<ElementFace> slow_faces(const Mesh& mesh, const std::vector<bool>& visible, bool all) {
  std::map<std::set<Index>, int> seen_by;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    for (Index f = 0; visible[e] && f < faces_of(mesh.elements.kind(e)).size(); ++f) ++seen_by[vertex_set(mesh, {e, f})];
  }
  std::vector<ElementFace> faces;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    for (Index f = 0; visible[e] && f < faces_of(mesh.elements.kind(e)).size(); ++f) {
      if (all || seen_by[vertex_set(mesh, {e, f})] == 1) faces.push_back({e, f});
    }
  }
  return faces;
}

ClippingView random_view(std::mt19937& random) {
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  ClippingView view;
  if (random() % 4 != 0) {
    view.clip.on = true;
    view.clip.normal = random() % 3 == 0 ? Vec3{0, 0, 2} : Vec3{unit() - 0.5, unit() - 0.5, unit() - 0.3};
    view.clip.offset = dot(view.clip.normal, {unit(), unit(), unit()});
    view.clip.flip = random() % 2 == 0;
    view.clip.mode = random() % 2 == 0 ? ClipPlane::Mode::Cut : ClipPlane::Mode::Crinkle;
  }
  if (random() % 3 == 0) view.peel = static_cast<Index>(random() % 3);
  if (random() % 4 == 0) view.peel_quality = static_cast<float>(unit());
  if (random() % 4 == 0) {
    const auto low = static_cast<float>(unit()) - 0.2F;
    view.isolate = std::pair{low, low + 0.5F};
  }
  if (random() % 5 == 0) view.worst = 1 + random() % 40;
  if (random() % 5 == 0) view.shrink = 0.8;
  view.ghost = random() % 2 == 0;
  return view;
}

/// The name that a failing test shows.
class OfEachFill : public testing::TestWithParam<Fill> {};
INSTANTIATE_TEST_SUITE_P(Clipping, OfEachFill, testing::Values(Fill::Hexahedra, Fill::Tetrahedra, Fill::Mixed), [](const auto& tested) {
  return std::string(tested.param == Fill::Hexahedra ? "Hexahedra" : tested.param == Fill::Tetrahedra ? "Tetrahedra" : "Mixed");
});

/// Many settings one after the other in the same object, which keeps state between them.
TEST_P(OfEachFill, IsWhatLookingAtEveryFaceFinds) {
  Block block(volume_grid(5, GetParam(), 0.2));
  Clipping inside(block.mesh.elements, block.neighbours);
  ThreadPool pool(2);
  std::mt19937 random(7);
  for (int turn = 0; turn < 60; ++turn) {
    ClippingView view = random_view(random);
    if (turn % 10 == 9) {
      block.quality = random_quality(block.quality.size(), static_cast<unsigned>(turn));
      for (Vec3& p : block.mesh.positions) p = p + Vec3{0.01, -0.005, 0.003 * p.x};
      ++block.serial;
    }
    SCOPED_TRACE(turn);
    const ClippedFaces& seen = inside.update(view, block.state(), turn % 2 == 0 ? &pool : nullptr);
    const std::vector<bool> wanted = slow_visible(block, view);
    ASSERT_THAT(inside.visible(), testing::ElementsAreArray(std::vector<std::uint8_t>(wanted.begin(), wanted.end())));
    ASSERT_THAT(seen.faces, testing::ElementsAreArray(slow_faces(block.mesh, wanted, view.shrink < 1.0)));
    EXPECT_EQ(seen.visible_cells, static_cast<std::size_t>(std::ranges::count(wanted, true)));
    std::vector<ElementFace> ghost;
    for (const ElementFace f : block.neighbours.boundary()) {
      if (view.ghost && !wanted[f.element]) ghost.push_back(f);
    }
    EXPECT_EQ(seen.ghost, ghost);
  }
}

/// A plane that moves in small steps, with an update of the changes alone.
TEST_P(OfEachFill, ADraggedPlaneLeavesNothingBehind) {
  const Block block(volume_grid(6, GetParam(), 0.2));
  Clipping inside(block.mesh.elements, block.neighbours);
  ClippingView view;
  view.clip.on = true;
  view.clip.normal = {0.3, 0.2, 1.0};
  for (int step = -2; step < 60; ++step) {
    view.clip.offset = 0.025 * (step % 2 == 0 ? step : step - 3);
    const ClippedFaces& seen = inside.update(view, block.state());
    ASSERT_EQ(seen.faces, slow_faces(block.mesh, slow_visible(block, view), false)) << step;
  }
}

/// Six times the volume under a face, as seen from the origin; of a quadrilateral by triangles about its mean.
double volume_under(const Mesh& mesh, ElementFace face) {
  const auto v = vertices_of(mesh.elements, face);
  const std::size_t n = v[3] == kNoIndex ? 3 : 4;
  Vec3 mean{};
  for (std::size_t i = 0; i < n; ++i) mean = mean + 1.0 / static_cast<double>(n) * mesh.positions[v[i]];
  double six = 0.0;
  for (std::size_t i = 0; i < n; ++i) six += dot(mean, cross(mesh.positions[v[i]], mesh.positions[v[(i + 1) % n]]));
  return six;
}

/// Every edge of the faces of a set of cells that are glued face to face has an even number of these, and they enclose the cells' volume.
TEST_P(OfEachFill, SkinsAreClosedAndEncloseTheVisibleCells) {
  const Block block(volume_grid(6, GetParam(), 0.2));
  Clipping inside(block.mesh.elements, block.neighbours);
  std::mt19937 random(3);
  for (int turn = 0; turn < 30; ++turn) {
    ClippingView view = random_view(random);
    view.shrink = 1.0;
    std::map<std::pair<Index, Index>, int> faces_at;
    double enclosed = 0.0, wanted = 0.0;
    for (const ElementFace face : inside.update(view, block.state()).faces) {
      const auto v = vertices_of(block.mesh.elements, face);
      const std::size_t n = v[3] == kNoIndex ? 3 : 4;
      for (std::size_t i = 0; i < n; ++i) ++faces_at[std::minmax(v[i], v[(i + 1) % n])];
      enclosed += volume_under(block.mesh, face);
    }
    for (const auto& [edge, count] : faces_at) ASSERT_EQ(count % 2, 0) << turn << ": " << edge.first << ' ' << edge.second;
    const std::vector<bool> visible = slow_visible(block, view);
    for (Index e = 0; e < block.mesh.elements.size(); ++e) {
      for (Index f = 0; visible[e] && f < faces_of(block.mesh.elements.kind(e)).size(); ++f) wanted += volume_under(block.mesh, {e, f});
    }
    EXPECT_NEAR(enclosed, wanted, 1e-12) << turn;
  }
}

TEST(Clipping, LayersOfABlockAreItsOnionSkins) {
  const Mesh mesh = volume_grid(7, Fill::Hexahedra);
  const std::vector<Index> layers = layers_of(mesh.elements, FaceNeighbours(mesh));
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const Index i = e % 7, j = e / 7 % 7, k = e / 49;
    ASSERT_EQ(layers[e], std::min({i, j, k, 6 - i, 6 - j, 6 - k}));
  }
}

TEST(Clipping, PeeledByTwoLayersABlockIsSmallerByFourCells) {
  const Block block(volume_grid(7, Fill::Hexahedra));
  Clipping inside(block.mesh.elements, block.neighbours);
  ClippingView view;
  view.peel = 2;
  EXPECT_EQ(inside.update(view, block.state()).visible_cells, 27U);
  EXPECT_EQ(inside.faces().faces.size(), 54U);
  view.peel = 100;
  EXPECT_EQ(inside.update(view, block.state()).visible_cells, 0U);
  EXPECT_TRUE(inside.faces().faces.empty());
}

TEST(Clipping, TheWorstAreTheInvertedThenTheLowest) {
  Block block(volume_grid(3, Fill::Hexahedra));
  std::ranges::fill(block.quality, 0.9F);
  block.quality[4] = 0.5F;
  block.quality[20] = 0.1F;
  block.inverted[13] = 1;
  block.quality[13] = 0.95F;
  ClippingView view;
  const auto seen = [&](std::size_t count) {
    Clipping inside(block.mesh.elements, block.neighbours);
    view.worst = count;
    inside.update(view, block.state());
    std::vector<Index> cells;
    for (Index e = 0; e < 27; ++e) {
      if (inside.visible()[e] != 0) cells.push_back(e);
    }
    return cells;
  };
  EXPECT_THAT(seen(1), testing::ElementsAre(13));
  EXPECT_THAT(seen(2), testing::ElementsAre(13, 20));
  EXPECT_THAT(seen(4), testing::ElementsAre(0, 4, 13, 20));  // the first among equals
  EXPECT_EQ(seen(1000).size(), 27U);                         // all are defined
  block.inverted[25] = 1;
  block.quality[25] = -0.5F;
  EXPECT_THAT(seen(1), testing::ElementsAre(25));  // the lowest of the inverted ones
  EXPECT_THAT(seen(3), testing::ElementsAre(13, 20, 25));
  block.quality[13] = std::nanf("");  // inverted, whatever its metric
  EXPECT_THAT(seen(1), testing::ElementsAre(13));
}

TEST(Clipping, AViewThatMeansNothingIsRefusedAndChangesNothing) {
  const Block block(volume_grid(3, Fill::Hexahedra));
  Clipping inside(block.mesh.elements, block.neighbours);
  inside.update({}, block.state());
  const auto refused = [&](auto&& change) {
    ClippingView view;
    change(view);
    EXPECT_THROW(inside.update(view, block.state()), UsageError);
    EXPECT_EQ(inside.faces().faces.size(), 54U);
  };
  refused([](ClippingView& v) { v.clip.on = true, v.clip.normal = {0, 0, 0}; });
  refused([](ClippingView& v) { v.clip.on = true, v.clip.normal.y = std::nan(""); });
  refused([](ClippingView& v) { v.clip.on = true, v.clip.offset = HUGE_VAL; });
  refused([](ClippingView& v) { v.shrink = 0.0; });
  refused([](ClippingView& v) { v.shrink = 1.5; });
  refused([](ClippingView& v) { v.peel_quality = std::nanf(""); });
  refused([](ClippingView& v) { v.isolate = std::pair{0.5F, 0.2F}; });
  ClippingView view;
  view.worst = 3;
  CellState bare = block.state();
  bare.quality = {};
  EXPECT_THROW(inside.update(view, bare), UsageError);
}

TEST(Clipping, NothingIsDoneTwice) {
  const Block block(volume_grid(3, Fill::Hexahedra));
  Clipping inside(block.mesh.elements, block.neighbours);
  ClippingView view;
  view.clip.on = true;
  view.clip.offset = 0.4;
  const std::uint64_t revision = inside.update(view, block.state()).faces_revision;
  EXPECT_EQ(inside.update(view, block.state()).faces_revision, revision);
  view.clip.offset = 0.45;  // between the same vertices
  EXPECT_EQ(inside.update(view, block.state()).faces_revision, revision);
  view.clip.offset = 0.7;
  EXPECT_GT(inside.update(view, block.state()).faces_revision, revision);
}

}  // namespace
}  // namespace dmoscope
