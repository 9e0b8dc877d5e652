// Repair moves a vertex that is far from its neighbours first, and they wait for it.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "tests/smooth/promises.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using test::Fill;
using test::volume_grid;
using testing::Cells;
using testing::input;
using testing::lattice;
using testing::make_run;

std::vector<Mesh> sound_meshes() {
  return {lattice(6, 0.2, 71),
          lattice(6, 0.2, 72, Cells::Quadrilaterals),
          lattice(6, 0.2, 73, Cells::Mixed),
          volume_grid(3, Fill::Tetrahedra, 0.1),
          volume_grid(3, Fill::Hexahedra, 0.1),
          volume_grid(3, Fill::Mixed, 0.1)};
}

/// Distances from a wrong digit to a lost decimal point.
constexpr double kDistances[] = {1.5, 40.0, 1e3, 1e6};

Mesh with_stray(Mesh mesh, Index vertex, double distance) {
  const bool volume = info(mesh.elements.kind(0)).dimension == 3;
  mesh.positions[vertex] = mesh.positions[vertex] + distance * Vec3{0.6, -0.64, volume ? 0.48 : 0.0};
  return mesh;
}

/// Does the first iteration of a run. Returns whether the mesh was tangled and is sound now.
bool expect_it_alone_goes_home(const std::shared_ptr<const InputMesh>& mesh, const RunParameters& parameters, Index stray,
                               const std::string& what) {
  dmoscope::Run run = make_run(mesh, parameters);
  if (run.statistics().inverted == 0) return false;
  EXPECT_TRUE(mesh->has_strays) << what;
  Progress progress;
  run.step(StepUnit::Iteration, progress);
  std::vector<Vec3> expected = mesh->mesh.positions;
  expected[stray] = run.positions()[stray];
  EXPECT_TRUE(same_bits(run.positions(), expected)) << what;
  return run.statistics().inverted == 0;
}

TEST(Strays, GoHomeInTheFirstIterationAndNoOtherVertexMoves) {
  for (const RunParameters& parameters : {RunParameters{}, RunParameters{.search = {.precision = Precision::Double}},
                                          RunParameters{.combination = CompositeTerms{.threshold = 0.3, .second = Metric::MinAngle}},
                                          RunParameters{.method = "active-set"}}) {
    std::size_t tried = 0, home = 0;
    for (const Mesh& mesh : sound_meshes()) {
      if (parameters.combination && !testing::defined_for_all(Metric::MinAngle, mesh)) continue;
      const std::vector<Index> free = make_run(input(mesh), {}).colouring().order;
      for (const Index stray : free)
        for (const double distance : kDistances) {
          const auto spoilt = input(with_stray(mesh, stray, distance));
          if (spoilt->report.inverted_elements.empty()) continue;
          ++tried;
          home +=
              expect_it_alone_goes_home(spoilt, parameters, stray, fmt::format("{}, {}, {}", parameters.method, stray, distance)) ? 1 : 0;
          if (HasFailure()) return;
        }
    }
    EXPECT_GT(tried, 80U);
    // Active-set ascends from the vertex's place, and may end at a ridge.
    EXPECT_GE(home, parameters.method == "dmo" ? tried : tried * 3 / 4) << parameters.method;
  }
}

TEST(Strays, AreLookedForWhereAnElementIsInvertedAndTheVertexIsFree) {
  const Mesh sound = lattice(6, 0.2, 71);
  EXPECT_FALSE(input(sound)->has_strays);
  const auto mesh = input(sound);
  for (Index v = 0; v < sound.vertex_count(); ++v)
    EXPECT_EQ(input(with_stray(sound, v, 40.0))->has_strays, mesh->topology.boundary()[v] == 0) << v;
}

TEST(Strays, TheNeighboursOfOneThatMayNotMoveGoOnInTheSecondIteration) {
  const Mesh sound = lattice(6, 0.2, 71);
  const Index stray = make_run(input(sound), {}).colouring().order[0];
  dmoscope::Run run = make_run(input(with_stray(sound, stray, 40.0)), {.fixed = {stray}});
  Progress progress;
  EXPECT_EQ(run.step(StepUnit::Iteration, progress), 0U);
  EXPECT_FALSE(run.sweep().untangling.repair);
  EXPECT_GT(run.step(StepUnit::Iteration, progress), 0U);
}

}  // namespace
}  // namespace dmoscope
