// Pattern search against its definition: poll one step along each axis, in both directions, shorter by 0.9 while that inverts an element;
// the best becomes the place and the step grows by 1.5, or else shrinks; first a quarter of the mean edge, last a thousandth.

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/mesh/generate.h"
#include "tests/smooth/promises.h"

namespace dmoscope {
namespace {

using testing::input;

/// The ends of the edges that leave a corner of an element, in the file format's numbering (VTK).
std::vector<Index> neighbours(std::size_t corners, bool volume, Index corner) {
  const auto n = static_cast<Index>(corners);
  if (!volume) return {(corner + 1) % n, (corner + n - 1) % n};
  if (n == 4) return {(corner + 1) % 4, (corner + 2) % 4, (corner + 3) % 4};
  if (n == 5) return corner == 4 ? std::vector<Index>{0, 1, 2, 3} : std::vector<Index>{(corner + 1) % 4, (corner + 3) % 4, 4};
  const Index side = n / 2, base = corner / side * side;  // two rings, one above the other
  return {base + (corner + 1) % side, base + (corner + side - 1) % side, (corner + side) % n};
}

double mean_edge(const InputMesh& mesh, std::span<const Vec3> positions, Index vertex) {
  double sum = 0.0, count = 0.0;
  for (const Incidence& at : mesh.topology.star(vertex)) {
    const auto corners = mesh.mesh.elements.corners(at.element);
    for (const Index other : neighbours(corners.size(), mesh.is_volume(), at.corner)) {
      sum += length(positions[corners[other]] - positions[vertex]);
      count += 1.0;
    }
  }
  return sum / count;
}

/// The best place for a vertex without inverted elements.
Vec3 best_by_definition(const InputMesh& mesh, std::vector<Vec3> positions, Index vertex) {
  const auto worth = [&](const Vec3& place) {
    positions[vertex] = place;
    const StarState state = star_state(mesh, positions, Metric::MeanRatio, vertex);
    return state.jacobian > 0.0 ? state.quality : -1.0;
  };
  const Vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  const double edge = mean_edge(mesh, positions, vertex), last = 1e-3 * edge;
  Vec3 best = positions[vertex];
  double most = worth(best), step = 0.25 * edge;
  for (int poll = 0; poll < 100 && step > last; ++poll) {
    const Vec3 centre = best;
    const double before = most;
    for (int i = 0; i < (mesh.is_volume() ? 6 : 4); ++i) {
      double reach = step, value = worth(centre + reach * axes[i]);
      for (; value <= 0.0 && reach > last; value = worth(centre + reach * axes[i])) reach *= 0.9;
      if (value > most) most = value, best = centre + reach * axes[i];
    }
    step *= most > before ? 1.5 : 0.25;
  }
  return best;
}

void expect_as_defined(const Mesh& mesh, const std::string& name) {
  const auto prepared = input(mesh);
  dmoscope::Run run = testing::make_run(prepared, {.method = "pattern-search"});
  Progress progress;
  std::size_t looked_at = 0, moved = 0, others = 0;
  for (const Index vertex : std::vector<Index>(run.colouring().order)) {
    const std::vector<Vec3> old(run.positions().begin(), run.positions().end());
    run.visit_vertices(std::array{vertex}, progress);  // a step of a tangled mesh would move them together
    if (!(star_state(*prepared, old, Metric::MeanRatio, vertex).jacobian > 0.0)) continue;
    const Vec3 expected = best_by_definition(*prepared, old, vertex);
    others += length(run.positions()[vertex] - expected) < 1e-9 ? 0U : 1U;
    ++looked_at;
    moved += expected == old[vertex] ? 0U : 1U;
  }
  EXPECT_LE(others, looked_at / 100) << name << ": where two places are worth the same but for rounding";
  EXPECT_GT(looked_at, 5U) << name;
  EXPECT_GT(moved, looked_at / 2) << name;
}

TEST(PatternSearch, IsAsDefinedInEveryKindOfElement) {
  using testing::Cells;
  for (const auto& [cells, name] :
       {std::pair{Cells::Triangles, "triangles"}, {Cells::Quadrilaterals, "quadrilaterals"}, {Cells::Mixed, "mixed"}}) {
    Mesh mesh = testing::lattice(12, 0.42, 22, cells);
    for (Vec3& p : mesh.positions) p.x *= 0.1;  // so narrow that the first steps along x leave the ring
    expect_as_defined(mesh, name);
  }
  Progress progress;
  for (const char* kind : {"tetrahedra", "hexahedra", "solids"}) expect_as_defined(generate_mesh(kind, 125, 5, progress), kind);
}

TEST(PatternSearch, AStepOutOfTheRingIsTakenBackAsFarAsItMust) {
  Mesh mesh;  // a strip that a quarter of an edge leaves
  mesh.positions = {{0.005, 0.1, 0}, {0, -1, 0}, {0.2, -1, 0}, {0.2, 1, 0}, {0, 1, 0}};
  for (Index i = 1; i <= 4; ++i) testing::add(mesh, {0, i, i % 4 + 1});
  const auto strip = input(mesh);
  dmoscope::Run run = testing::make_run(strip, {.method = "pattern-search"});
  Progress progress;
  run.step(StepUnit::Vertex, progress);
  EXPECT_LT(length(run.positions()[0] - best_by_definition(*strip, mesh.positions, 0)), 1e-12);
}

}  // namespace
}  // namespace dmoscope
