#include "core/mesh/generate.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/input/input_mesh.h"
#include "core/quality/quality.h"
#include "tests/support/sanitized.h"

namespace dmoscope {
namespace {

Mesh generated(std::string_view name, std::size_t size, std::uint64_t seed) {
  Progress progress;
  return generate_mesh(name, size, seed, progress);
}

bool same(const Mesh& a, const Mesh& b) {
  return a.positions == b.positions && std::ranges::equal(a.elements.all_corners(), b.elements.all_corners()) &&
         std::ranges::equal(a.elements.kinds(), b.elements.kinds());
}

void expect_valid(const Mesh& mesh, bool tangled) {
  Progress progress;
  const auto input = prepare_input(mesh, {}, Need::Smoothing, progress);
  if (!input->in_space()) {
    EXPECT_EQ(input->geometry.plane.normal, (Vec3{0, 0, 1}));
  }
  const MeshReport& report = input->report;
  EXPECT_EQ(report.flipped_elements, 0U);
  EXPECT_TRUE(report.unused_vertices.empty());
  EXPECT_TRUE(report.duplicate_elements.empty());
  EXPECT_TRUE(report.degenerate_elements.empty());
  EXPECT_EQ(report.non_manifold_edges, 0U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.inverted_elements.empty(), !tangled);
}

TEST(Generate, EveryKindIsValidForSeveralSizesAndSeeds) {
  for (const GeneratorInfo& kind : generator_table()) {
    for (const std::size_t size : {std::size_t{300}, std::size_t{1500}, std::size_t{0}}) {
      if (testing::kSanitized && size != 300) continue;
      for (const std::uint64_t seed : {0U, 1U, 77U}) {
        SCOPED_TRACE(std::string(kind.name) + " " + std::to_string(size) + " seed " + std::to_string(seed));
        const Mesh mesh = generated(kind.name, size, seed);
        expect_valid(mesh, kind.name.starts_with("tangled"));
        const auto wanted = static_cast<double>(size == 0 ? kind.default_size : size);
        EXPECT_GT(mesh.vertex_count(), 0.5 * wanted);
        EXPECT_LT(mesh.vertex_count(), 2.0 * wanted);
      }
    }
  }
}

TEST(Generate, SmallestSizesWork) {
  for (const auto& [name, size] : {std::pair{"block", 50},
                                   {"annulus", 50},
                                   {"random", 3},
                                   {"quads", 9},
                                   {"mixed", 50},
                                   {"tangled", 25},
                                   {"grid", 9},
                                   {"tetrahedra", 27},
                                   {"hexahedra", 27},
                                   {"solids", 27},
                                   {"tangled-solids", 125},
                                   {"screw", 63},
                                   {"elbow", 63},
                                   {"can", 50},
                                   {"nested", 25},
                                   {"nested-solids", 64},
                                   {"biased", 27}}) {
    SCOPED_TRACE(name);
    expect_valid(generated(name, static_cast<std::size_t>(size), 5), std::string_view(name).starts_with("tangled"));
  }
}

TEST(Generate, SameSeedSameMeshOtherSeedOtherMesh) {
  for (const GeneratorInfo& kind : generator_table()) {
    const Mesh mesh = generated(kind.name, 400, 9);
    EXPECT_TRUE(same(mesh, generated(kind.name, 400, 9))) << kind.name;
    EXPECT_FALSE(same(mesh, generated(kind.name, 400, 10))) << kind.name;
  }
}

TEST(Generate, ThereIsRoomForImprovement) {
  for (const GeneratorInfo& kind : generator_table()) {
    const Mesh mesh = generated(kind.name, 0, 1);
    Progress progress;
    const auto input = prepare_input(mesh, {}, Need::Smoothing, progress);
    const auto s = compute_statistics(input->quality_context(), mesh.positions, Metric::MeanRatio, input->topology.boundary(), nullptr);
    // Vertices of a lattice's cells have less room before something is inverted.
    EXPECT_LT(s.minimum, kind.name == "solids" || kind.name == "hexahedra" || kind.name == "biased" ? 0.5 : 0.35) << kind.name;
    EXPECT_GT(s.ceiling, s.movable_minimum) << kind.name;
  }
}

/// The elements at the minimum of swept rods touch the surface: at a line where a square's corner lies on a smooth curve.
TEST(Generate, TheWorstOfRodsTouchesTheSurface) {
  for (const char* name : {"screw", "elbow"}) {
    const Mesh mesh = generated(name, 0, 2);
    Progress progress;
    const auto input = prepare_input(mesh, {}, Need::Smoothing, progress);
    std::vector<double> qualities(mesh.elements.size());
    element_qualities(input->quality_context(), mesh.positions, Metric::MeanRatio, nullptr, qualities);
    const auto worst = static_cast<Index>(std::ranges::min_element(qualities) - qualities.begin());
    const auto corners = mesh.elements.corners(worst);
    EXPECT_TRUE(std::ranges::any_of(corners, [&](Index v) { return input->topology.boundary()[v] != 0; })) << name;
  }
}

TEST(Generate, RandomHasExactlyTheVerticesAskedForAndEmptyCircles) {
  const Mesh mesh = generated("random", 300, 4);
  ASSERT_EQ(mesh.vertex_count(), 300U);
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto c = mesh.elements.corners(e);
    // Centre from the two perpendicular bisectors, relative to the first corner.
    const Vec3 b = mesh.positions[c[1]] - mesh.positions[c[0]];
    const Vec3 d = mesh.positions[c[2]] - mesh.positions[c[0]];
    const double twice = 2 * (b.x * d.y - b.y * d.x);
    const Vec3 centre{(d.y * dot(b, b) - b.y * dot(d, d)) / twice, (b.x * dot(d, d) - d.x * dot(b, b)) / twice, 0};
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      if (std::ranges::find(c, v) != c.end()) continue;
      EXPECT_GT(length(mesh.positions[v] - mesh.positions[c[0]] - centre), length(centre) * (1 - 1e-6));
    }
  }
}

TEST(Generate, KindsAreWhatTheirNamesSay) {
  const Mesh quads = generated("quads", 200, 1);
  EXPECT_TRUE(std::ranges::all_of(quads.elements.kinds(), [](ElementKind k) { return k == ElementKind::Quadrilateral; }));
  for (const char* name : {"mixed", "tangled"}) {
    const Mesh mesh = generated(name, 200, 1);
    const auto quadrilaterals = std::ranges::count(mesh.elements.kinds(), ElementKind::Quadrilateral);
    EXPECT_GT(quadrilaterals, 0) << name;
    EXPECT_LT(quadrilaterals, static_cast<std::ptrdiff_t>(mesh.elements.size())) << name;
  }
  Progress progress;
  const auto ring = prepare_input(generated("annulus", 500, 1), {}, Need::Smoothing, progress);
  EXPECT_EQ(ring->report.boundary_loops, 2U);
}

TEST(Generate, TangledSolidsKeepTheCubeAndAreOfAllFourKinds) {
  const Mesh mesh = generated("tangled-solids", 0, 3);
  for (const ElementKind kind : {ElementKind::Tetrahedron, ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Pyramid})
    EXPECT_GT(std::ranges::count(mesh.elements.kinds(), kind), 0) << static_cast<int>(kind);
  // Ten vertices an edge of the cube; one of twenty inner ones is thrown, and a throw turns less than its whole star over.
  for (const Vec3& p : mesh.positions) {
    for (const double x : {p.x, p.y, p.z}) {
      EXPECT_GE(x, 0.0);
      EXPECT_LE(x, 9.0);
    }
  }
  Progress progress;
  const auto inverted = prepare_input(mesh, {}, Need::Smoothing, progress)->report.inverted_elements.size();
  EXPECT_GT(inverted, 25U);
  EXPECT_LT(inverted, mesh.elements.size() / 8);
}

TEST(Generate, CoastHasBoundaryStringsAndDepth) {
  const Mesh mesh = generated("coast", 0, 0);
  Progress progress;
  const auto input = prepare_input(mesh, {}, Need::Smoothing, progress);
  EXPECT_GE(input->report.boundary_loops, 4U) << "several islands";
  std::size_t open = 0;
  std::size_t islands = 0;
  std::set<Index> on_strings;
  for (const Group& group : mesh.groups) {
    open += group.role == "open boundary" ? 1 : 0;
    islands += group.role == "land boundary" && group.code == 1 ? 1 : 0;
    on_strings.insert(group.members.begin(), group.members.end());
    for (std::size_t i = 1; i < group.members.size(); ++i) {
      // Neighbours on a string share exactly one element: they form an edge of the boundary.
      int shared = 0;
      for (const Incidence& incidence : input->topology.star(group.members[i])) {
        shared += std::ranges::count(mesh.elements.corners(incidence.element), group.members[i - 1]) > 0 ? 1 : 0;
      }
      EXPECT_EQ(shared, 1);
    }
  }
  EXPECT_EQ(open, 1U);
  EXPECT_EQ(islands + 1, input->report.boundary_loops);
  std::set<Index> boundary;
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    if (input->topology.boundary()[v] != 0) boundary.insert(v);
  }
  EXPECT_EQ(on_strings, boundary);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "depth");
  ASSERT_EQ(mesh.fields[0].values.size(), mesh.positions.size());
  EXPECT_GT(*std::ranges::min_element(mesh.fields[0].values), 0.0);
  double shore = 0;
  double sea = 0;
  for (Index v = 0; v < mesh.vertex_count(); ++v) (boundary.contains(v) ? shore : sea) += mesh.fields[0].values[v];
  EXPECT_LT(shore / static_cast<double>(boundary.size()), sea / static_cast<double>(mesh.vertex_count() - boundary.size()));
}

TEST(Generate, UnknownNamesAndSizesOutOfRangeAreRefused) {
  try {
    (void)generated("cube", 0, 0);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("coast, block, annulus, random, quads, mixed, tangled, grid"), std::string::npos);
  }
  try {
    (void)generated("grid", 10000001, 0);
    FAIL();
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("9 to 10000000"), std::string::npos);
  }
  EXPECT_THROW((void)generated("coast", 10, 0), UsageError);
}

TEST(Generate, CanBeCancelled) {
  for (const GeneratorInfo& kind : generator_table()) {
    Progress progress;
    progress.request_cancel();
    EXPECT_THROW((void)generate_mesh(kind.name, 0, 0, progress), Cancelled) << kind.name;
  }
}

}  // namespace
}  // namespace dmoscope
