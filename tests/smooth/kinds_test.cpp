// Corners and feature edges that the user sets: the promises hold with any of them, and they have their effect.

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>

#include "core/base/error.h"
#include "core/numeric/simd.h"
#include "core/reference/edge_words.h"
#include "core/reference/kind_facts.h"
#include "tests/smooth/surface_judge.h"
#include "tests/support/sanitized.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// The surface of a shaken cube of n x n x n cells, of quadrilaterals or of triangles, with the vertices of the volume's numbers.
Mesh cube_skin(Index n, Cells cells, std::uint64_t seed) {
  const Mesh volume = shaken(test::volume_grid(n, test::Fill::Hexahedra), 0.3 / n, seed);
  Mesh mesh;
  mesh.positions = volume.positions;
  for (const auto& f : boundary_faces(volume)) {
    if (cells == Cells::Quadrilaterals) {
      testing::add(mesh, {f[0], f[1], f[2], f[3]});
    } else {
      testing::add(mesh, {f[0], f[1], f[2]});
      testing::add(mesh, {f[0], f[2], f[3]});
    }
  }
  return mesh;
}
Index cube_vertex(Index n, Index i, Index j, Index k) { return (k * (n + 1) + j) * (n + 1) + i; }

std::vector<EdgeEnds> all_edges(const InputMesh& mesh) {
  std::vector<EdgeEnds> edges;
  for (Index v = 0; v < mesh.mesh.vertex_count(); ++v)
    for (const Index other : edges_at(mesh, v))
      if (v < other) edges.push_back({v, other});
  return edges;
}

/// Random kinds of all vertices and edges; `share`: of each.
Kinds random_kinds(const InputMesh& mesh, double share, std::uint64_t seed) {
  dmoscope::testing::Random random(seed);
  Kinds kinds;
  for (Index v = 0; v < mesh.mesh.vertex_count(); ++v) {
    const double x = random(0.0, 1.0);
    if (x < share / 2) say_corners(kinds, std::span(&v, 1), Saying::Is);
    if (x > 1.0 - 3 * share) say_corners(kinds, std::span(&v, 1), Saying::IsNot);
  }
  for (const EdgeEnds& edge : all_edges(mesh)) {
    const double x = random(0.0, 1.0);
    if (x < share / 2) say_features(kinds, std::span(&edge, 1), Saying::Is);
    if (x > 1.0 - 3 * share) say_features(kinds, std::span(&edge, 1), Saying::IsNot);
  }
  return kinds;
}

/// Expects corners to keep their bits, and vertices on a feature edge to stay on it.
void expect_as_said(const Specimen& specimen, const dmoscope::Run& run) {
  const Kinds& kinds = run.parameters().kinds;
  const Domain& domain = *run.domain();
  const auto stands = [&](Index v) {
    return same_bits(run.positions().subspan(v, 1), std::span(run.input().mesh.positions).subspan(v, 1));
  };
  for (const Index v : kinds.corners) {
    if (domain.held_on(v) == HeldOn::Nothing) continue;
    ASSERT_TRUE(stands(v)) << specimen.name << ": corner " << v;
  }
  for (const EdgeEnds& edge : kinds.features) {
    if (!domain.is_feature(edge[0], edge[1])) continue;  // inside a volume
    for (const Index v : edge) {
      ASSERT_FALSE(domain.on_surface(v)) << specimen.name << ": vertex " << v << " of a feature edge may leave it";
      ASSERT_TRUE(domain.on_curve(v) || stands(v)) << specimen.name << ": vertex " << v;
    }
  }
}

std::vector<Specimen> kinds_specimens() {
  std::vector<Specimen> all;
  all.push_back({"cube", cube_skin(4, Cells::Quadrilaterals, 5)});
  all.push_back({"cube of triangles", cube_skin(4, Cells::Triangles, 6)});
  all.push_back({"hill", mapped(lattice(8, 0.3, 7), [](Vec3 p) { return Vec3{p.x, p.y, 0.2 * std::sin(5 * p.x) * std::cos(4 * p.y)}; })});
  all.push_back({"creased", mapped(lattice(8, 0.2, 8, Cells::Mixed), [](Vec3 p) { return Vec3{p.x, p.y, std::abs(p.y - 0.5)}; })});
  all.push_back({"block", shaken(test::volume_grid(4, test::Fill::Hexahedra, 0.2, 3), 0.06, 3)});
  all.push_back({"block of tetrahedra", shaken(test::volume_grid(3, test::Fill::Tetrahedra, 0.2, 4), 0.06, 4)});
  all.push_back({"plane", lattice(8, 0.35, 9)});
  all.push_back({"plane of quadrilaterals", lattice(8, 0.35, 10, Cells::Quadrilaterals)});
  return all;
}

TEST(KindsByHand, KeepThePromisesAfterEveryIteration) {
  std::size_t moved = 0, said = 0;
  for (const Specimen& specimen : kinds_specimens()) {
    const auto mesh = input(specimen.mesh);
    for (std::uint64_t seed = 1; seed <= (kSanitized ? 2U : 8U); ++seed) {
      RunParameters parameters = sliding_by();
      if (seed % 4 == 3) parameters.boundary = BoundaryRule::Fixed;
      parameters.kinds = random_kinds(*mesh, seed % 2 == 0 ? 0.3 : 0.05, seed);
      dmoscope::Run run = make_run(mesh, parameters);
      if (!run.domain()) continue;
      const bool planar = mesh->geometry.shape == Shape::Planar;
      const bool judged = !planar && !(mesh->is_volume() && parameters.boundary == BoundaryRule::Fixed);
      const SurfaceJudge judge(specimen, *mesh, 1e-3);
      for (std::uint64_t iteration = 1; iteration <= 3; ++iteration) {
        expect_promise_one(specimen, run, iteration);
        if (judged) judge.expect_kept(run, true);
        expect_in_order(specimen, run);
        expect_fixed_stay(specimen, run);
        expect_as_said(specimen, run);
        if (::testing::Test::HasFatalFailure()) return;
      }
      moved += slid(run);
      said += parameters.kinds.size();
    }
  }
  EXPECT_GT(moved, kSanitized ? 200U : 1000U);
  EXPECT_GT(said, 1000U);
}

/// Kinds set by hand that equal those by angles give the same bits.
TEST(KindsByHand, AreWhatAnglesSay) {
  Progress progress;
  for (const Specimen& specimen : kinds_specimens()) {
    const auto mesh = input(specimen.mesh);
    if (mesh->geometry.shape == Shape::Planar) continue;
    RunParameters usual = sliding_by();
    dmoscope::Run by_angle = make_run(mesh, usual);
    by_angle.iterate(3, progress);
    RunParameters smooth = usual;
    smooth.feature_angle = smooth.corner_angle = 180.0;
    dmoscope::Run none = make_run(mesh, smooth);
    none.iterate(3, progress);
    std::vector<EdgeEnds> folded;
    std::vector<Index> all(mesh->mesh.vertex_count()), corners;
    for (Index v = 0; v < all.size(); ++v) all[v] = v;
    for (const EdgeEnds& edge : all_edges(*mesh))
      if (edge_kind(*mesh, usual.standing(), *by_angle.domain(), edge[0], edge[1]) == EdgeKind::Angle) folded.push_back(edge);
    for (const Index v : all)
      if (by_angle.domain()->held_on(v) == HeldOn::Corner) corners.push_back(v);
    RunParameters said = usual;  // no angle counts
    say_features(said.kinds, folded, Saying::IsNot);
    say_corners(said.kinds, all, Saying::IsNot);
    dmoscope::Run released = make_run(mesh, said);
    released.iterate(3, progress);
    EXPECT_TRUE(same_bits(released.positions(), none.positions())) << specimen.name;
    RunParameters told = smooth;  // the kinds that angles would give
    say_features(told.kinds, folded, Saying::Is);
    say_corners(told.kinds, corners, Saying::Is);
    dmoscope::Run held = make_run(mesh, told);
    held.iterate(3, progress);
    EXPECT_TRUE(same_bits(held.positions(), by_angle.positions())) << specimen.name;
    if (specimen.name.starts_with("cube")) {
      EXPECT_FALSE(same_bits(none.positions(), by_angle.positions()));
    }
  }
}

TEST(KindsByHand, AreTheSameBits) {
  Progress progress;
  for (const Specimen& specimen : kinds_specimens()) {
    const auto mesh = input(specimen.mesh);
    RunParameters parameters = sliding_by();
    parameters.kinds = random_kinds(*mesh, 0.1, 3);
    dmoscope::Run expected = make_run(mesh, parameters);
    expected.iterate(3, progress);
    for (const SimdLevel level : supported_simd_levels()) {
      RunParameters other = parameters;
      other.search.simd = level;
      dmoscope::Run run = make_run(mesh, other, 4);
      run.iterate(3, progress);
      ASSERT_TRUE(same_bits(run.positions(), expected.positions())) << specimen.name << ": " << name(level);
    }
    dmoscope::Run stepped = make_run(mesh, parameters, 2);
    stepped.seek({2, stepped.visits_per_iteration() / 3}, progress);
    stepped.seek({1, 0}, progress);
    stepped.seek({3, 0}, progress);
    ASSERT_TRUE(same_bits(stepped.positions(), expected.positions())) << specimen.name << ": seek";
  }
}

class KindsOfACube : public ::testing::Test {
 protected:
  static constexpr Index kN = 4;
  KindsOfACube() : mesh_(input(cube_skin(kN, Cells::Quadrilaterals, 5))) {}
  [[nodiscard]] static Index at(Index i, Index j, Index k) { return cube_vertex(kN, i, j, k); }
  [[nodiscard]] Domain domain() const { return {*mesh_, rule_}; }
  /// The edges along x on the lower front edge.
  [[nodiscard]] static std::vector<EdgeEnds> front() {
    std::vector<EdgeEnds> edges;
    for (Index i = 0; i < kN; ++i) edges.push_back({at(i, 0, 0), at(i + 1, 0, 0)});
    return edges;
  }
  std::shared_ptr<const InputMesh> mesh_;
  StandingRule rule_;
};

TEST_F(KindsOfACube, AnEdgeThatIsNoFeatureIsCrossed) {
  EXPECT_TRUE(domain().on_curve(at(2, 0, 0)));
  EXPECT_EQ(domain().held_on(at(0, 0, 0)), HeldOn::Junction);
  say_features(rule_.kinds, front(), Saying::IsNot);
  const Domain without = domain();
  EXPECT_TRUE(without.on_surface(at(2, 0, 0)));
  EXPECT_FALSE(without.is_feature(at(1, 0, 0), at(2, 0, 0)));
  EXPECT_EQ(without.feature_edges().size(), 11U * kN);
  EXPECT_EQ(without.held_on(at(0, 0, 0)), HeldOn::Corner) << "two edges are left, which meet at a right angle";
  const Index corner = at(0, 0, 0);
  say_corners(rule_.kinds, std::span(&corner, 1), Saying::IsNot);
  EXPECT_TRUE(domain().on_curve(corner));
  say_features(rule_.kinds, front(), Saying::Automatic);
  EXPECT_EQ(domain().feature_edges().size(), 12U * kN);
  EXPECT_EQ(domain().held_on(corner), HeldOn::Junction) << "where three meet nobody can slide along one of them";
}

TEST_F(KindsOfACube, CornersStayWhereOthersSlide) {
  for (const Index v : {at(2, 0, 0), at(2, 2, 0)}) {
    EXPECT_TRUE(domain().slides(v));
    say_corners(rule_.kinds, std::span(&v, 1), Saying::Is);
    EXPECT_FALSE(domain().slides(v));
    EXPECT_EQ(domain().held_on(v), HeldOn::Hand);
    EXPECT_THAT(std::string(domain().why_held(v)), HasSubstr("by hand"));
    EXPECT_EQ(standing_vertices(*mesh_, rule_)[v], 1);
  }
  EXPECT_EQ(rule_.kinds.corners, (std::vector{at(2, 0, 0), at(2, 2, 0)}));
}

TEST_F(KindsOfACube, AFeatureAcrossASideIsNotCrossed) {
  std::vector<EdgeEnds> across;
  for (Index i = 0; i < kN; ++i) across.push_back({at(i, 2, 0), at(i + 1, 2, 0)});
  say_features(rule_.kinds, across, Saying::Is);
  rule_.corner_angle = 179.0;  // the cube is shaken
  const Domain with = domain();
  for (Index i = 1; i < kN; ++i) EXPECT_TRUE(with.on_curve(at(i, 2, 0)));
  EXPECT_EQ(with.held_on(at(0, 2, 0)), HeldOn::Junction);
  EXPECT_EQ(edge_kind(*mesh_, rule_, with, at(1, 2, 0), at(2, 2, 0)), EdgeKind::Hand);
  EXPECT_EQ(edge_kind(*mesh_, rule_, with, at(1, 0, 0), at(2, 0, 0)), EdgeKind::Angle);
  EXPECT_EQ(edge_kind(*mesh_, rule_, with, at(1, 1, 0), at(2, 1, 0)), EdgeKind::Smooth);
  EXPECT_NEAR(*fold_of(*mesh_, with, at(1, 0, 0), at(2, 0, 0)), 90.0, 1e-6);
}

TEST_F(KindsOfACube, ChainsEndAtCorners) {
  const auto named = [&](const std::string& word) {
    const Domain now = domain();
    return edges_named(*mesh_, rule_, &now, std::span(&word, 1));
  };
  EXPECT_EQ(named("chain:1-2"), front());
  const Index middle = at(2, 0, 0);
  say_corners(rule_.kinds, std::span(&middle, 1), Saying::Is);
  EXPECT_EQ(named("chain:1-2").size(), 2U);
  say_corners(rule_.kinds, std::span(&middle, 1), Saying::Automatic);
  say_features(rule_.kinds, front(), Saying::IsNot);
  EXPECT_EQ(named("chain:2-1"), front()) << "what was a chain is one for the way back";
  EXPECT_EQ(named("0-1-2,4-3"), (std::vector<EdgeEnds>{{0, 1}, {1, 2}, {3, 4}}));
  EXPECT_EQ(named("edges:1-0"), (std::vector<EdgeEnds>{{0, 1}}));
  for (const auto& [word, why] : {std::pair("0-2", "there is no edge 0-2: those of 0 lead to 1, 5, 25"),
                                  {"0-999", "there is no vertex 999 (the mesh has 125, counted from 0)"},
                                  {"chain:31-32", "no edge"},
                                  {"chain:6-7", "no feature edge"},
                                  {"edges:3", "no list of edges like"},
                                  {"rim", "the mesh has no groups"}}) {
    try {
      (void)named(word);
      ADD_FAILURE() << word;
    } catch (const UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why)) << word;
    }
  }
}

TEST_F(KindsOfACube, WhatDoesNotComeTrueIsSaid) {
  const auto why = [&](const Kinds& said) {
    const Domain now = domain();
    const auto all = unmet(*mesh_, rule_, &now, said);
    return all.empty() ? std::string() : all.front().what;
  };
  const Index junction = at(0, 0, 0), side = at(2, 2, 0), inside = at(2, 2, 2);
  const auto corner = [](Index v, Saying saying) { return only_corners(std::span(&v, 1), saying); };
  EXPECT_EQ(why(corner(junction, Saying::IsNot)), "vertex 0 stays: feature edges meet there");
  EXPECT_EQ(why(corner(side, Saying::IsNot)), "");
  EXPECT_THAT(why(corner(inside, Saying::Is)), HasSubstr("lies on no boundary, interface or surface"));
  Kinds nowhere;
  nowhere.features = {{0, 2}};
  EXPECT_THROW(require_there(*mesh_, nowhere), UsageError);
  rule_.kinds = nowhere;
  EXPECT_THROW((void)domain_for(*mesh_, rule_), UsageError);
  RunParameters parameters;
  parameters.kinds.corners = {1000};
  EXPECT_THROW((void)make_run(mesh_, parameters), UsageError);
}

/// Feature edges of the file, or of the mesh itself, cannot be removed.
TEST(KindsByHand, DoNotFreeWhatTheFileAndTheMeshHold) {
  Mesh start = mapped(lattice(6, 0.0, 3), [](Vec3 p) { return Vec3{p.x, p.y, 0.2 * p.x * p.x}; });
  Group left{.name = "left", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < start.elements.size() / 2; ++e) left.members.push_back(e);
  Group line{.name = "weld", .role = "physical group", .code = 0, .dimension = 1, .members = {8, 9, 9, 10}};
  start.groups = {left, line};
  const auto mesh = input(start);
  StandingRule rule{InterfaceRule::Slide, BoundaryRule::Slide};
  rule.kinds.no_features = all_edges(*mesh);
  for (Index v = 0; v < start.vertex_count(); ++v) rule.kinds.no_corners.push_back(v);
  const Domain domain(*mesh, rule);
  EXPECT_EQ(edge_kind(*mesh, rule, domain, 0, 1), EdgeKind::Border);
  EXPECT_EQ(edge_kind(*mesh, rule, domain, 8, 9), EdgeKind::File) << "a line that the file names";
  EXPECT_EQ(edge_kind(*mesh, rule, domain, 22, 23), EdgeKind::File) << "between materials";
  EXPECT_EQ(edge_kind(*mesh, rule, domain, 15, 16), EdgeKind::Smooth);
  EXPECT_TRUE(domain.on_curve(9)) << "of the line";
  EXPECT_FALSE(domain.slides(8)) << "its end";
  EXPECT_FALSE(domain.slides(21)) << "the interface ends at the boundary";
  EXPECT_TRUE(domain.on_curve(0)) << "a corner of the sheet by its angle alone";
  const auto not_met = unmet(*mesh, rule, &domain, only_features(std::vector<EdgeEnds>{{8, 9}}, Saying::IsNot));
  ASSERT_EQ(not_met.size(), 1U);
  EXPECT_EQ(not_met[0].what, "edge 8-9 stays a feature: the file names it, or parts materials there");
  EXPECT_TRUE(not_met[0].for_good);
  const std::vector<std::string> words{"lines:weld"}, border{"left"}, points{"9-10"};
  EXPECT_EQ(edges_named(*mesh, rule, &domain, words), (std::vector<EdgeEnds>{{8, 9}, {9, 10}}));
  EXPECT_EQ(edges_named(*mesh, rule, &domain, border).size(), 6U + 6 + 3 + 3);
}

TEST(KindsByHand, InAPlaneVerticesSlideAlongALineThatAPersonDraws) {
  constexpr Index n = 6;
  Mesh start = lattice(n, 0.0, 3);
  const auto at = [](Index i, Index j) { return j * (n + 1) + i; };
  const auto mesh = input(start);
  StandingRule rule;
  EXPECT_EQ(domain_for(*mesh, rule), nullptr);
  std::vector<EdgeEnds> row;
  for (Index i = 0; i + 1 < n; ++i) row.push_back({at(i, 3), at(i + 1, 3)});
  say_features(rule.kinds, row, Saying::Is);
  const auto domain = domain_for(*mesh, rule);
  ASSERT_NE(domain, nullptr);
  const auto standing = standing_vertices(*mesh, rule);
  EXPECT_EQ(standing[at(0, 3)], 1) << "on the boundary, which stays";
  EXPECT_EQ(standing[at(n - 1, 3)], 1) << "the line ends there";
  for (Index i = 1; i + 1 < n; ++i) EXPECT_TRUE(domain->on_curve(at(i, 3)) && standing[at(i, 3)] == 0) << i;
  EXPECT_EQ(standing[at(2, 2)], 0);
  EXPECT_EQ(std::vector<EdgeEnds>(domain->feature_edges().begin(), domain->feature_edges().end()), row);
  RunParameters parameters;
  parameters.kinds = rule.kinds;
  dmoscope::Run run = make_run(mesh, parameters);
  Progress progress;
  run.iterate(5, progress);
  for (Index i = 0; i < n; ++i) EXPECT_EQ(run.positions()[at(i, 3)].y, start.positions[at(i, 3)].y);
  EXPECT_THAT(run.title(), HasSubstr("5 feature edges by hand"));
  parameters.method = "active-set";
  dmoscope::Run other = make_run(mesh, parameters);
  other.iterate(5, progress);
  for (Index i = 0; i < n; ++i) EXPECT_EQ(other.positions()[at(i, 3)].y, start.positions[at(i, 3)].y);
}

TEST(KindsByHand, InAPlaneCornersOfTheBoundaryAreSaid) {
  const auto mesh = input(lattice(6, 0.0, 3));
  StandingRule rule{InterfaceRule::Fixed, BoundaryRule::Slide};
  const auto slides = [&](Index v) { return domain_for(*mesh, rule)->slides(v); };
  EXPECT_FALSE(slides(0));
  EXPECT_TRUE(slides(2));
  rule.kinds.no_corners = {0};
  rule.kinds.corners = {2, 24};  // the latter is inside
  EXPECT_TRUE(slides(0)) << "round the square's corner";
  EXPECT_FALSE(slides(2));
  const auto standing = standing_vertices(*mesh, rule);
  EXPECT_EQ(standing[0], 0);
  EXPECT_EQ(standing[2], 1);
  EXPECT_EQ(standing[24], 0) << "what is free inside is fixed by another word";
  RunParameters parameters = sliding_by();
  parameters.kinds = rule.kinds;
  const Specimen specimen{"square", mesh->mesh};
  dmoscope::Run run = make_run(mesh, parameters);
  for (std::uint64_t iteration = 1; iteration <= 3; ++iteration) {
    expect_promise_one(specimen, run, iteration);
    expect_in_order(specimen, run);
    expect_fixed_stay(specimen, run);
  }
}

/// A line that the user draws across an interface does not free vertices of the interface.
TEST(KindsByHand, InAPlaneInterfacesStay) {
  constexpr Index n = 6;
  Mesh start = lattice(n, 0.0, 3, Cells::Quadrilaterals);
  Group low{.name = "low", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < start.elements.size() / 2; ++e) low.members.push_back(e);
  start.groups = {low};
  const auto mesh = input(start);
  const auto at = [](Index i, Index j) { return j * (n + 1) + i; };
  for (const InterfaceRule interfaces : {InterfaceRule::Fixed, InterfaceRule::Slide, InterfaceRule::Free}) {
    StandingRule rule{interfaces};
    std::vector<EdgeEnds> column;
    for (Index j = 0; j < n; ++j) column.push_back({at(2, j), at(2, j + 1)});
    say_features(rule.kinds, column, Saying::Is);
    const auto standing = standing_vertices(*mesh, rule);
    EXPECT_EQ(standing[at(2, 3)], interfaces == InterfaceRule::Free ? 0 : 1) << "where they cross";
    EXPECT_EQ(standing[at(2, 2)], 0);
    EXPECT_EQ(standing[at(3, 3)], interfaces == InterfaceRule::Fixed ? 1 : 0);
  }
}

TEST(KindsByHand, AreNormalised) {
  Kinds kinds;
  say_corners(kinds, std::vector<Index>{5, 3, 5}, Saying::Is);
  say_corners(kinds, std::vector<Index>{3}, Saying::IsNot);
  say_features(kinds, std::vector<EdgeEnds>{{4, 2}, {2, 4}, {1, 2}}, Saying::IsNot);
  say_features(kinds, std::vector<EdgeEnds>{{2, 1}}, Saying::Is);
  EXPECT_EQ(kinds.corners, std::vector<Index>{5});
  EXPECT_EQ(kinds.no_corners, std::vector<Index>{3});
  EXPECT_EQ(kinds.features, (std::vector<EdgeEnds>{{1, 2}}));
  EXPECT_EQ(kinds.no_features, (std::vector<EdgeEnds>{{2, 4}}));
  EXPECT_EQ(phrase(kinds), "1 corner, 1 no corner, 1 feature edge and 1 smooth edge by hand");
  say_corners(kinds, std::vector<Index>{3, 5}, Saying::Automatic);
  say_features(kinds, std::vector<EdgeEnds>{{1, 2}, {2, 4}}, Saying::Automatic);
  EXPECT_TRUE(kinds.empty());
  EXPECT_EQ(phrase(kinds), "");
}

}  // namespace
}  // namespace dmoscope
