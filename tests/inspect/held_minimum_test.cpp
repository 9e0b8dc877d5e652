// Hold of a minimum: on meshes with one possible cause, and against whole runs with the switch that is named.

#include "core/inspect/held_minimum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/run/hints.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using ::testing::HasSubstr;
using testing::input;
using testing::lattice;

constexpr Index kCells = 6;
Index vertex_at(Index i, Index j) { return j * (kCells + 1) + i; }

/// A lattice of squares in which one vertex stands so near its left neighbour that it spoils the elements between them.
Mesh spoiled(Index i, Index j) {
  Mesh mesh = lattice(kCells, 0.0, 1, testing::Cells::Quadrilaterals);
  mesh.positions[vertex_at(i, j)].x -= 0.9 / kCells;
  return mesh;
}

dmoscope::Run run_of(Mesh mesh, const RunParameters& parameters = {}, std::uint64_t iterations = 40) {
  dmoscope::Run run(input(std::move(mesh)), parameters, std::make_shared<ThreadPool>(1), 0);
  Progress progress;
  run.iterate(iterations, progress);
  return run;
}

HeldMinimum held_of(const dmoscope::Run& run) {
  Progress progress;
  auto found = what_holds(run, nullptr, progress);
  EXPECT_TRUE(found);
  return *found;
}

Holding holding_of(const HeldMinimum& held, Index vertex) {
  for (const HeldVertex& one : held.vertices)
    if (one.vertex == vertex) return one.by;
  ADD_FAILURE() << "vertex " << vertex << " is none of element " << held.element;
  return Holding::Nothing;
}

/// The minimum of a whole run with other parameters, from the input on.
double minimum_with(Mesh mesh, const RunParameters& parameters) { return run_of(std::move(mesh), parameters, 60).statistics().minimum; }

/// Expects a trial, in which all around stays, to come near the minimum of a whole run, and not above.
void expect_estimates(double trial, double whole) {
  EXPECT_LE(trial, whole + 0.01);
  EXPECT_GT(trial, whole - 0.15);
}

TEST(WhatHolds, TheBoundary) {
  const dmoscope::Run run = run_of(spoiled(3, 0));
  const HeldMinimum held = held_of(run);
  EXPECT_EQ(held.element, run.statistics().worst_element);
  EXPECT_DOUBLE_EQ(held.quality, run.statistics().minimum);
  EXPECT_EQ(held.by, Holding::Boundary);
  EXPECT_EQ(holding_of(held, vertex_at(3, 0)), Holding::Boundary);
  EXPECT_EQ(holding_of(held, vertex_at(2, 1)), Holding::Nothing);
  ASSERT_TRUE(held.change);
  EXPECT_EQ(held.change->command(), "boundary slide");
  RunParameters sliding;
  sliding.boundary = BoundaryRule::Slide;
  expect_estimates(held.changed, minimum_with(spoiled(3, 0), sliding));
  EXPECT_GT(held.changed, held.quality + 0.3);
  EXPECT_THAT(held.sentence(),
              HasSubstr("held by the fixed boundary (2 of its 4 vertices, 2 free): boundary slide would free it (giving "));
  EXPECT_THAT(held.sentence(true), HasSubstr("--boundary slide would free it"));
  EXPECT_THAT(held.sentence(), HasSubstr("on the whole mesh that was not tried"));
}

TEST(WhatHolds, WhatAPersonFixed) {
  RunParameters parameters;
  parameters.fixed = {vertex_at(2, 3), vertex_at(3, 3), vertex_at(5, 5)};
  const HeldMinimum held = held_of(run_of(spoiled(3, 3), parameters));
  EXPECT_EQ(held.by, Holding::Hand) << held.sentence();
  ASSERT_TRUE(held.change);
  EXPECT_EQ(held.change->command(), "unfix 23 24") << "of what is fixed, the vertices of the worst element";
  expect_estimates(held.changed, 1.0);
}

TEST(WhatHolds, AnInterfaceBetweenMaterials) {
  Mesh mesh = spoiled(3, 3);
  for (const bool upper : {false, true}) {
    Group group;
    group.name = upper ? "upper" : "lower";
    group.dimension = 2;
    for (Index e = 0; e < mesh.elements.size(); ++e)
      if ((e >= mesh.elements.size() / 2) == upper) group.members.push_back(e);
    mesh.groups.push_back(std::move(group));
  }
  const HeldMinimum held = held_of(run_of(std::move(mesh)));
  EXPECT_EQ(held.by, Holding::Interface);
  ASSERT_TRUE(held.change);
  EXPECT_EQ(held.change->option(), "--interfaces slide");
  EXPECT_GT(held.changed, held.quality + 0.3);
}

/// The boundary turns at the vertex by some 31 degrees.
TEST(WhatHolds, ACornerAndTheAngleThatItIsNot) {
  Mesh mesh = spoiled(3, 0);
  mesh.positions[vertex_at(3, 0)].y -= 0.01;
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  parameters.corner_angle = 20.0;
  parameters.max_deviation = 0.05;
  const HeldMinimum held = held_of(run_of(std::move(mesh), parameters));
  EXPECT_EQ(holding_of(held, vertex_at(3, 0)), Holding::Corner) << held.sentence();

  ASSERT_TRUE(held.change);
  EXPECT_EQ(held.change->name, "corner-angle");
  const double turn = (std::atan2(0.01, 0.1 / kCells) + std::atan2(0.01, 1.9 / kCells)) * 180.0 / 3.14159265358979;
  EXPECT_GT(std::stod(held.change->value), turn);
  EXPECT_LT(std::stod(held.change->value), turn + 7.0);
}

/// Vertices along the bottom lie by turns above and below: chords between those that slid would leave it.
Mesh spoiled_and_jagged() {
  Mesh mesh = spoiled(3, 0);
  for (Index i = 1; i < kCells; ++i) mesh.positions[vertex_at(i, 0)].y += i % 2 == 0 ? 0.004 : -0.004;
  return mesh;
}

TEST(WhatHolds, TheBoundOfDeviation) {
  const Mesh mesh = spoiled_and_jagged();
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  parameters.corner_angle = 80.0;
  parameters.max_deviation = 1e-3;
  const HeldMinimum held = held_of(run_of(mesh, parameters));
  EXPECT_EQ(held.by, Holding::Deviation) << held.sentence();
  ASSERT_TRUE(held.change);
  EXPECT_EQ(held.change->command(), "max-deviation 0.01");
  parameters.max_deviation = 1e-2;
  expect_estimates(held.changed, minimum_with(mesh, parameters));
}

/// The spoiled vertices are corners by their angles: neither switch gains alone.
TEST(WhatHolds, TwoThingsAtOnce) {
  const Mesh mesh = spoiled_and_jagged();
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  parameters.corner_angle = 20.0;
  parameters.max_deviation = 1e-3;
  parameters.fixed = {vertex_at(1, 0), vertex_at(4, 0)};  // so that nothing else moves
  const HeldMinimum held = held_of(run_of(mesh, parameters));
  EXPECT_EQ(held.by, Holding::Corner) << held.sentence();
  ASSERT_TRUE(held.change && held.also) << held.sentence();
  EXPECT_EQ(held.also->command(), "max-deviation 0.01");
  EXPECT_EQ(held.options(), "--" + held.commands()[0] + " --max-deviation 0.01");
  parameters.corner_angle = std::stod(held.change->value);
  EXPECT_LT(minimum_with(mesh, parameters), held.quality + 0.02) << "the corners alone";
  parameters.max_deviation = 1e-2;
  expect_estimates(held.changed, minimum_with(mesh, parameters));
  parameters.corner_angle = 20.0;
  EXPECT_LT(minimum_with(mesh, parameters), held.quality + 0.02) << "the bound alone";
}

/// A quadrilateral with a corner of nearly 180 degrees between three vertices that stay: its fourth gains nothing, and the certificate of
/// joint moves is that of the next element.
TEST(WhatHolds, ACornerThatStaysAndACertificateOfTheNext) {
  Mesh mesh = lattice(kCells, 0.0, 1, testing::Cells::Quadrilaterals);
  mesh.positions[vertex_at(0, 0)] = {0.48 / kCells, 0.48 / kCells, 0.0};
  mesh.positions[vertex_at(3, 0)].x -= 0.5 / kCells;
  const dmoscope::Run run = run_of(mesh, {}, 200);
  const HeldMinimum held = held_of(run);
  EXPECT_EQ(held.element, 0U);
  ASSERT_TRUE(held.joint);
  EXPECT_TRUE(held.is_of_another());
  EXPECT_TRUE(held.joint->worst_element == 2U || held.joint->worst_element == 3U) << "those at the vertex that was put elsewhere";
  EXPECT_GT(held.joint->before, held.quality);
  if (!held.change) {
    EXPECT_THAT(held.sentence(), HasSubstr("Of those that moves can change, element"));
  }
}

TEST(WhatHolds, NothingAtAnOptimumOrOnTheWay) {
  const Mesh mesh = spoiled(3, 3);
  const HeldMinimum still = held_of(run_of(mesh, {}, 0));
  EXPECT_TRUE(still.rises());
  EXPECT_FALSE(still.change);
  EXPECT_THAT(still.sentence(), HasSubstr("nothing holds it: more iterations raise it."));
  const HeldMinimum there = held_of(run_of(lattice(kCells, 0.3, 5), {}, 500));
  EXPECT_FALSE(there.rises());
}

/// A corner of the square cut off by one triangle, none of whose vertices moves, whatever slides.
TEST(WhatHolds, WhatNoSwitchFreesIsSaidOfTheNext) {
  Mesh mesh = spoiled(3, 0);
  const auto first = static_cast<Index>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {{5, 0, 0}, {6, 0, 0}, {6, 0.01, 0}});
  testing::add(mesh, {first, first + 1, first + 2});
  const HeldMinimum held = held_of(run_of(std::move(mesh)));
  ASSERT_TRUE(held.ceiling);
  EXPECT_EQ(held.ceiling->first, kCells * kCells);
  EXPECT_THAT(held.sentence(), ::testing::StartsWith("Element 36 at 0.0"));
  ASSERT_TRUE(held.change);
  EXPECT_EQ(held.change->command(), "boundary slide");
}

TEST(WhatHolds, TheSurfaceOfAVolume) {
  Mesh mesh = test::volume_grid(4, test::Fill::Hexahedra);
  const Index middle = 2 * 25 + 0 * 5 + 2;  // the middle of a side
  mesh.positions[middle].x -= 0.22;
  const HeldMinimum held = held_of(run_of(mesh));
  EXPECT_EQ(held.by, Holding::Boundary);
  ASSERT_TRUE(held.change);
  RunParameters sliding;
  sliding.boundary = BoundaryRule::Slide;
  expect_estimates(held.changed, minimum_with(mesh, sliding));
}

TEST(WhatHolds, AnyMethodIsOfferedToSlide) {
  RunParameters parameters;
  parameters.method = "active-set";
  const HeldMinimum held = held_of(run_of(spoiled(3, 0), parameters));
  EXPECT_EQ(held.by, Holding::Boundary);
  EXPECT_TRUE(held.change);
}

/// A run by two aims that has just begun: the worst element is below the threshold, and more iterations raise it.
TEST(WhatHolds, BelowTheThresholdOfTwoAimsMoreIterationsRaiseIt) {
  for (const char* method : {"dmo", "dvr", "active-set"}) {
    RunParameters parameters;
    parameters.method = method;
    parameters.combination = CompositeTerms{0.75, Metric::MinAngle};
    const dmoscope::Run run = run_of(lattice(8, 0.45, 3), parameters, 1);
    const HeldMinimum held = held_of(run);
    ASSERT_LT(held.quality, 0.75) << method;
    EXPECT_TRUE(held.rises()) << method;
    EXPECT_NE(held.by, Holding::Threshold) << method;
  }
}

}  // namespace
}  // namespace dmoscope
