// Meshes that slide on the surface of another one.

#include "core/reference/slide_on.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/inspect/element_fit.h"
#include "core/mesh/generate.h"
#include "tests/smooth/surface_judge.h"
#include "tests/smooth/surface_zoo.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

using namespace testing;
using ::testing::HasSubstr;

constexpr double kRounding = 4e-12;  // for sizes near 1

/// The place of a vertex by plain geometry against the faces of another mesh.
class Reference {
 public:
  explicit Reference(const Mesh& mesh) : positions_(mesh.positions), facets_(triangles_of(surface_faces(mesh), mesh.positions)) {}
  [[nodiscard]] double distance(Vec3 p) const { return distance_to(p, positions_, facets_); }
  [[nodiscard]] double farthest(const Mesh& mesh, std::span<const Vec3> positions) const {
    return deviation(positions, triangles_of(surface_faces(mesh), positions), positions_, facets_);
  }

 private:
  std::span<const Vec3> positions_;
  std::vector<Triangle> facets_;
};

Mesh sphere(Index n, double shake, std::uint64_t seed, Cells cells) {
  return skin(mapped(shaken(test::volume_grid(n, test::Fill::Hexahedra), shake, seed), ball), cells);
}
Mesh cube(Index n, double shake, std::uint64_t seed, Cells cells) {
  return skin(shaken(test::volume_grid(n, test::Fill::Hexahedra), shake, seed), cells);
}

/// The greatest distance of a face of the input straight above or below the reference.
double farthest_straight(const dmoscope::Run& run) {
  const ElementFit fit = element_fit(run.input(), *run.domain(), PositionView(run.input().mesh.positions));
  float most = 0.0F;
  for (const float deviation : fit.deviation) most = std::isnan(deviation) ? most : std::max(most, deviation);
  return static_cast<double>(most);
}

/// Expects moved vertices to be on the reference, and the others in their places.
void expect_on(const Reference& reference, const dmoscope::Run& run, const std::string& name) {
  const Mesh& before = run.input().mesh;
  for (Index v = 0; v < before.vertex_count(); ++v) {
    if (same_bits(run.positions().subspan(v, 1), std::span(before.positions).subspan(v, 1))) continue;
    ASSERT_TRUE(run.domain()->slides(v)) << name << ": vertex " << v;
    ASSERT_LE(reference.distance(run.positions()[v]), kRounding) << name << ": vertex " << v << " is not on the reference";
  }
}
/// Expects no face to be farther from the reference than the bound, or than any was.
void expect_near(const Reference& reference, const dmoscope::Run& run, double bound, const std::string& name) {
  const double most = std::max(bound, 1.0001 * farthest_straight(run)) + kRounding;
  ASSERT_LE(reference.farthest(run.input().mesh, run.positions()), most) << name;
}

/// A mesh slides on itself as on its own surface, with the same bits.
TEST(SlidingOnAnother, OnItselfIsTheSameBits) {
  std::size_t moved = 0;
  for (const Specimen& specimen : surfaces()) {
    if (specimen.name == "folded" || specimen.name == "three sheets") continue;  // the nearest sheet is another one there
    const auto own = input(specimen.mesh);
    const auto on = slide_on(*own, own);
    Progress progress;
    dmoscope::Run expected = make_run(own, sliding_by()), run = make_run(on, sliding_by());
    bool has_end = false;  // a crease that ends inside is none of a reference
    for (Index v = 0; v < specimen.mesh.vertex_count(); ++v) has_end = has_end || expected.domain()->held_on(v) == HeldOn::End;
    if (has_end) continue;
    for (Index v = 0; v < specimen.mesh.vertex_count(); ++v) {
      ASSERT_EQ(run.domain()->on_curve(v), expected.domain()->on_curve(v)) << specimen.name << ": vertex " << v;
      ASSERT_EQ(run.domain()->on_surface(v), expected.domain()->on_surface(v)) << specimen.name << ": vertex " << v;
    }
    expected.iterate(2, progress);
    run.iterate(2, progress);
    EXPECT_TRUE(same_bits(run.positions(), expected.positions())) << specimen.name;
    moved += slid(run);
  }
  EXPECT_GT(moved, 300U);
}

TEST(SlidingOnAnother, CoarseAndFineOnesGetOnIt) {
  struct Case {
    std::string name;
    Mesh mesh, reference;
  };
  std::vector<Case> cases;
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    cases.push_back({"coarse sphere", sphere(5, 0.06, 3, cells), sphere(14, 0.01, 4, Cells::Triangles)});
    cases.push_back({"fine sphere", sphere(10, 0.03, 3, cells), sphere(9, 0.0, 4, Cells::Triangles)});
    cases.push_back({"cube", cube(5, 0.06, 3, cells), cube(7, 0.0, 5, Cells::Quadrilaterals)});
    cases.push_back(
        {"cylinder", wound(14, 6, false, false, 7, cells, on_cylinder), wound(40, 9, false, false, 8, Cells::Mixed, on_cylinder)});
    cases.push_back({"torus", wound(24, 9, true, false, 7, cells, on_torus), wound(60, 20, true, false, 8, Cells::Triangles, on_torus)});
  }
  for (const Case& one : cases) {
    const auto mesh = slide_on(*input(one.mesh), input(one.reference));
    const Reference reference(one.reference);
    const double bound = 1e-3 * mesh->geometry.size;
    dmoscope::Run run = make_run(mesh, sliding_by());
    for (std::uint64_t iteration = 1; iteration <= (kSanitized ? 1 : 4); ++iteration) {
      expect_promise_one({one.name, one.mesh}, run, iteration);
      expect_on(reference, run, one.name);
      expect_in_order({one.name, one.mesh}, run);
      if (::testing::Test::HasFatalFailure()) return;
    }
    expect_near(reference, run, bound, one.name);
    EXPECT_GT(slid(run), one.mesh.vertex_count() / (kSanitized ? 8 : 4)) << one.name;  // fewer have moved after one iteration
    EXPECT_GT(run.statistics().minimum, run.history().records().front().statistics.minimum) << one.name;
  }
}

/// Corners of the reference keep their vertices, and other vertices slide along its edges; coordinates show those of a cube.
TEST(SlidingOnAnother, CornersAndEdgesAreThoseOfTheReference) {
  const Mesh start = cube(6, 0.06, 11, Cells::Triangles);
  const auto mesh = slide_on(*input(start), input(cube(4, 0.0, 1, Cells::Quadrilaterals)));
  dmoscope::Run run = make_run(mesh, sliding_by());
  Progress progress;
  run.iterate(5, progress);
  const auto sides = [](Vec3 p) {
    return (p.x == 0 || p.x == 1 ? 1 : 0) + (p.y == 0 || p.y == 1 ? 1 : 0) + (p.z == 0 || p.z == 1 ? 1 : 0);
  };
  Index corners = 0, on_edges = 0;
  for (Index v = 0; v < start.vertex_count(); ++v) {
    const Vec3 before = start.positions[v], now = run.positions()[v];
    EXPECT_EQ(run.domain()->slides(v), sides(before) < 3) << "vertex " << v;
    EXPECT_EQ(run.domain()->on_curve(v), sides(before) == 2) << "vertex " << v;
    EXPECT_EQ(sides(now), sides(before)) << "vertex " << v;
    corners += sides(before) == 3 ? 1 : 0;
    on_edges += sides(before) == 2 && !(now == before) ? 1 : 0;
  }
  EXPECT_EQ(corners, 8U);
  EXPECT_GT(on_edges, 20U);
}

/// A sphere whose vertices were moved about on it: only the reference tells which of its triangles are inverted.
TEST(SlidingOnAnother, FoldsAreUntangled) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const Mesh sound = sphere(9, 0.0, 1, cells);
    for (std::uint64_t seed = 1; seed <= (kSanitized ? 1U : 4U); ++seed) {
      dmoscope::testing::Random random(seed);
      Mesh spoiled = sound;
      for (Vec3& p : spoiled.positions) {
        p = p + 0.08 * Vec3{random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)};
        p = (1.0 / length(p)) * p;
      }
      const Mesh finer = sphere(16, 0.0, 1, Cells::Triangles);
      const auto mesh = slide_on(*input(spoiled), input(finer));
      // By plain geometry: the triangle's middle looks inwards.
      std::size_t inwards = 0;
      for (Index e = 0; cells == Cells::Triangles && e < spoiled.elements.size(); ++e) {
        const auto c = spoiled.elements.corners(e);
        const Vec3 a = spoiled.positions[c[0]], b = spoiled.positions[c[1]], d = spoiled.positions[c[2]];
        inwards += dot(cross(b - a, d - a), a + b + d) *
                               dot(cross(sound.positions[c[1]] - sound.positions[c[0]], sound.positions[c[2]] - sound.positions[c[0]]),
                                   sound.positions[c[0]]) <
                           0.0
                       ? 1
                       : 0;
      }
      const std::size_t inverted = mesh->report.inverted_elements.size();
      ASSERT_GT(inverted, 10U);
      if (cells == Cells::Triangles) {
        EXPECT_NEAR(static_cast<double>(inverted), static_cast<double>(inwards), 4.0);  // some are nearly upright
      }
      dmoscope::Run run = make_run(mesh, sliding_by(0.02));
      Progress progress;
      std::size_t before = inverted;
      for (int iteration = 0; iteration < 40 && before > 0; ++iteration) {
        run.iterate(1, progress);
        ASSERT_LE(run.statistics().inverted, before);
        before = run.statistics().inverted;
      }
      EXPECT_EQ(before, 0U) << "of " << inverted << ", seed " << seed;
      EXPECT_GT(run.statistics().minimum, 0.0);
    }
  }
}

/// The winding of a mesh, or of some of its elements, does not matter.
TEST(SlidingOnAnother, WindingSaysNothing) {
  const Mesh start = sphere(6, 0.05, 3, Cells::Mixed);
  Mesh turned = start, some = start, finer = sphere(13, 0.0, 1, Cells::Triangles);
  for (Index e = 0; e < turned.elements.size(); ++e) turned.elements.flip(e);
  for (Index e = 0; e < some.elements.size(); e += 3) some.elements.flip(e);
  for (const bool flip : {false, true}) {
    if (flip)
      for (Index e = 0; e < finer.elements.size(); ++e) finer.elements.flip(e);
    const auto reference = input(finer);
    for (const Mesh* mesh : std::array<const Mesh*, 3>{&start, &turned, &some}) {
      const auto on = slide_on(*input(*mesh), reference);
      EXPECT_THAT(on->report.inverted_elements, ::testing::IsEmpty());
      dmoscope::Run run = make_run(on, sliding_by());
      Progress progress;
      run.iterate(2, progress);
      EXPECT_GT(slid(run), start.vertex_count() / 3);
    }
  }
}

/// Boundary and inside of a volume move in one iteration, the boundary on a finer mesh's.
TEST(SlidingOnAnother, VolumesSlideOnASurface) {
  for (const bool round : {true, false}) {
    for (const test::Fill fill : {test::Fill::Hexahedra, test::Fill::Tetrahedra}) {
      const auto shape = [&](Mesh mesh) { return round ? mapped(std::move(mesh), ball) : mesh; };
      const Mesh start = shape(shaken(test::volume_grid(5, fill), 0.05, 4));
      const Mesh fine = skin(shape(test::volume_grid(11, test::Fill::Hexahedra)), Cells::Triangles);
      const auto mesh = slide_on(*input(start), input(fine));
      const Reference reference(fine);
      const Specimen specimen{round ? "ball" : "cube", start};
      dmoscope::Run run = make_run(mesh, sliding_by());
      for (std::uint64_t iteration = 1; iteration <= 2; ++iteration) {
        expect_promise_one(specimen, run, iteration);
        for (Index v = 0; v < start.vertex_count(); ++v)
          if (mesh->topology.boundary()[v] != 0 && !(run.positions()[v] == start.positions[v])) {
            ASSERT_LE(reference.distance(run.positions()[v]), kRounding) << specimen.name << ": vertex " << v;
          }
        if (::testing::Test::HasFatalFailure()) return;
      }
      EXPECT_GT(slid(run), 20U) << specimen.name;
    }
  }
}

/// Vertices too far away stay, with a warning.
TEST(SlidingOnAnother, WhatIsTooFarAwayStays) {
  Mesh start = sphere(6, 0.04, 3, Cells::Triangles);
  const Index far = 17;
  start.positions[far] = 1.3 * start.positions[far];
  const auto mesh = slide_on(*input(start), input(sphere(13, 0.0, 1, Cells::Triangles)));
  dmoscope::Run run = make_run(mesh, sliding_by());
  Progress progress;
  run.iterate(3, progress);
  EXPECT_FALSE(run.domain()->slides(far));
  EXPECT_EQ(run.domain()->held_on(far), HeldOn::Unmatched);
  EXPECT_EQ(run.positions()[far], start.positions[far]);
  EXPECT_THAT(run.domain()->sentence(), HasSubstr("too far away"));
  EXPECT_GT(slid(run), 30U);
}

TEST(SlidingOnAnother, IsTheSameBits) {
  const Mesh finer = sphere(14, 0.01, 4, Cells::Triangles);
  Mesh spoiled = sphere(9, 0.0, 1, Cells::Mixed);
  dmoscope::testing::Random random(5);
  for (Vec3& p : spoiled.positions) p = p + 0.12 * Vec3{random(-1.0, 1.0), random(-1.0, 1.0), random(-1.0, 1.0)};
  for (Vec3& p : spoiled.positions) p = (1.0 / length(p)) * p;
  for (const Mesh* start : std::array<const Mesh*, 1>{&spoiled}) {
    const auto mesh = slide_on(*input(*start), input(finer));
    Progress progress;
    dmoscope::Run expected = make_run(mesh, sliding_by());
    expected.iterate(4, progress);
    for (const unsigned threads : {2U, 8U}) {
      dmoscope::Run run = make_run(mesh, sliding_by(), threads);
      run.iterate(4, progress);
      EXPECT_TRUE(same_bits(run.positions(), expected.positions())) << threads;
    }
    dmoscope::Run stepped = make_run(mesh, sliding_by(), 2);
    stepped.seek({2, stepped.visits_per_iteration() / 3}, progress);
    stepped.seek({1, 0}, progress);
    stepped.seek({4, 0}, progress);
    EXPECT_TRUE(same_bits(stepped.positions(), expected.positions()));
  }
}

TEST(SlidingOnAnother, PlanesAreRefused) {
  const auto flat = input(lattice(4, 0.2, 1, Cells::Triangles)), round = input(sphere(4, 0.0, 1, Cells::Triangles));
  EXPECT_THROW((void)slide_on(*flat, round), UsageError);
  EXPECT_THROW((void)slide_on(*round, flat), UsageError);
  EXPECT_EQ(slide_on(*slide_on(*round, round), nullptr)->surface, nullptr);
}

}  // namespace
}  // namespace dmoscope
