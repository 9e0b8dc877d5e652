// Traces of visits on a surface: they end as the run does, candidates lie on the input, and none counts beyond a feature edge.

#include "core/inspect/surface_trace.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/reference/domain.h"
#include "core/run/run.h"
#include "tests/support/meshes.h"
#include "tests/support/plain_surface.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

SmoothingTask task_of(const dmoscope::Run& run) {
  SmoothingTask task;
  task.input = run.shared_input();
  task.metric = run.parameters().metric;
  task.search = run.parameters().search;
  task.slides = run.parameters().standing().slides();
  task.domain = run.domain();
  task.max_deviation = run.parameters().max_deviation * run.input().geometry.size;
  return task;
}

Mesh wavy(bool surface) {
  Mesh volume = test::volume_grid(5, test::Fill::Hexahedra, 0.25, 4);
  for (Vec3& p : volume.positions) {
    p.x += 0.1 * std::sin(3.14159265 * p.x) * std::sin(5 * p.y + 2 * p.z);
    p.z += 0.06 * std::sin(5 * p.x) * std::cos(4 * p.y);
  }
  if (!surface) return volume;
  Mesh mesh;
  mesh.positions = volume.positions;
  for (const auto& face : testing::boundary_faces(volume)) mesh.elements.add(ElementKind::Quadrilateral, face);
  return mesh;
}

TEST(SurfaceTrace, EndsAsTheRunDoesAndLiesOnTheInput) {
  for (const bool surface : {false, true}) {
    RunParameters parameters;
    if (!surface) parameters.boundary = BoundaryRule::Slide;
    parameters.max_deviation = 4e-3;
    parameters.search.omega = 1.4;
    Progress progress;
    dmoscope::Run run(testing::input(wavy(surface)), parameters, std::make_shared<ThreadPool>(1), std::size_t{1} << 24U);
    run.step(StepUnit::Class, progress);
    const std::vector<Vec3> before(run.positions().begin(), run.positions().end());
    const auto facets = testing::triangles_of(testing::surface_faces(run.input().mesh), run.input().mesh.positions);
    std::size_t seen = 0, moved = 0, deviate = 0, beyond = 0;
    for (Index v = 0; v < before.size(); v += 3) {
      if (!run.domain()->on_surface(v)) continue;
      const SurfaceVisit visit = trace_surface_visit(task_of(run), before, v, run.sweep());
      ++seen;
      ASSERT_EQ(visit.trace.levels.size(), 3U);
      for (std::size_t k = 0; k < 3; ++k) {
        const SurfaceGrid::Level& level = visit.grid.levels[k];
        for (std::size_t i = 0; i < level.places.size(); ++i) {
          const Vec2<double> flat = visit.grid.plane.project(level.places[i]), offset = visit.trace.levels[k].offsets[i];
          EXPECT_NEAR(flat.x, offset.x, 1e-9) << "straight above or below";
          EXPECT_NEAR(flat.y, offset.y, 1e-9);
          const bool counts = level.fates[i] == CandidateFate::Counts || level.fates[i] == CandidateFate::Deviates ||
                              level.fates[i] == CandidateFate::Leans;
          if (counts && k == 0) {
            EXPECT_LE(testing::distance_to(before[v] + level.places[i], run.input().mesh.positions, facets), 1e-9);
          }
          EXPECT_EQ(counts, std::isfinite(visit.trace.levels[k].values[i]));
          deviate += level.fates[i] == CandidateFate::Deviates ? 1 : 0;
          beyond += level.fates[i] == CandidateFate::Feature ? 1 : 0;
        }
      }
      (void)run.visit_vertices(std::span(&v, 1), progress);
      EXPECT_EQ(run.positions()[v], visit.trace.to) << "vertex " << v;
      EXPECT_EQ(visit.trace.end == VisitEnd::Moved, !(visit.trace.to == before[v]));
      moved += visit.trace.end == VisitEnd::Moved ? 1 : 0;
      run.back(StepUnit::Vertex, progress);
      ASSERT_EQ(run.positions()[v], before[v]);
    }
    EXPECT_GT(seen, 10U);
    EXPECT_GT(moved, 0U);
    EXPECT_GT(deviate, 0U);
    EXPECT_GT(beyond, 0U) << "of vertices beside an edge of the block";
  }
}

/// Candidates of a vertex on a side of the cube count if they are on the side, and nowhere else.
TEST(SurfaceTrace, OfAFlatSideCountsWhatIsOnIt) {
  RunParameters parameters;
  parameters.boundary = BoundaryRule::Slide;
  dmoscope::Run run(testing::input(test::volume_grid(4, test::Fill::Hexahedra)), parameters, std::make_shared<ThreadPool>(1), 0);
  std::size_t outside = 0;
  SmoothingTask task = task_of(run);
  task.search.omega = 1.5;
  for (Index v = 0; v < run.positions().size(); ++v) {
    if (!run.domain()->on_surface(v)) continue;
    const SurfaceVisit visit = trace_surface_visit(task, run.positions(), v, {});
    for (std::size_t k = 0; k < visit.grid.levels.size(); ++k) {
      for (std::size_t i = 0; i < visit.grid.levels[k].places.size(); ++i) {
        const Vec3 p = run.positions()[v] + visit.grid.levels[k].places[i];
        double beyond = -1.0;
        for (const double x : {p.x, p.y, p.z}) beyond = std::max({beyond, -x, x - 1.0});
        if (std::abs(beyond) < 1e-9 && beyond > 0.0) continue;
        EXPECT_EQ(visit.grid.levels[k].fates[i] == CandidateFate::Feature, beyond > 1e-9) << p.x << ' ' << p.y << ' ' << p.z;
        outside += beyond > 1e-9 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(outside, 0U);
  EXPECT_THROW((void)trace_surface_visit(task, run.positions(), 0, {}), UsageError) << "a corner";
}

/// A floor and a steep slope, without a feature edge between them: a vertex that would go up the slope would tilt faces of the floor.
TEST(SurfaceTrace, FacesThatWouldLeanAreTold) {
  Mesh mesh = testing::lattice(6, 0.2, 3);
  const double slope = 75.0 * 3.14159265358979 / 180.0;
  const auto folded = [&](Vec3 p) {
    return p.x <= 0.5 ? p : Vec3{0.5 + (p.x - 0.5) * std::cos(slope), p.y, (p.x - 0.5) * std::sin(slope)};
  };
  for (Vec3& p : mesh.positions) p = folded(p);
  RunParameters parameters;
  parameters.feature_angle = 180.0;
  parameters.max_deviation = 1.0;
  parameters.search.omega = 1.5;
  dmoscope::Run run(testing::input(mesh), parameters, std::make_shared<ThreadPool>(1), 0);
  const SmoothingTask task = task_of(run);
  std::size_t leaning = 0, flat = 0, up = 0;
  for (Index v = 0; v < run.positions().size(); ++v) {
    if (!run.domain()->on_surface(v)) continue;
    const Vec3 here = run.positions()[v];
    const auto star = run.input().topology.star(v);
    const bool all_on_floor = std::ranges::all_of(star, [&](const Incidence& at) {
      return std::ranges::all_of(mesh.elements.corners(at.element), [&](Index w) { return mesh.positions[w].z == 0.0; });
    });
    if (here.z > 0.0) continue;
    const SurfaceVisit visit = trace_surface_visit(task, run.positions(), v, {});
    for (std::size_t k = 0; k < visit.grid.levels.size(); ++k)
      for (std::size_t i = 0; i < visit.grid.levels[k].places.size(); ++i) {
        const CandidateFate fate = visit.grid.levels[k].fates[i];
        const Vec3 there = here + visit.grid.levels[k].places[i];
        const bool turns = std::ranges::any_of(star, [&](const Incidence& at) {
          std::array<Vec3, 3> c{};
          std::ranges::transform(mesh.elements.corners(at.element), c.begin(), [&](Index w) { return w == v ? there : mesh.positions[w]; });
          return cross(c[1] - c[0], c[2] - c[0]).z < 1e-9;
        });
        if (fate == CandidateFate::Leans) {
          ++leaning;
          up += there.z > 0.0 && !turns ? 1 : 0;
          EXPECT_TRUE(!all_on_floor || there.z > 0.0 || turns) << "on the floor nothing leans that looks up";
        } else if (there.z == 0.0 && there.x < 0.5 && fate == CandidateFate::Counts) {
          ++flat;
        }
        EXPECT_NE(fate, CandidateFate::Deviates) << "the bound is the whole mesh";
      }
  }
  EXPECT_GT(flat, 0U);
  EXPECT_GT(leaning, 0U);
  EXPECT_GT(up, 0U) << "some of them up the slope, with no face turned";
}

}  // namespace
}  // namespace dmoscope
