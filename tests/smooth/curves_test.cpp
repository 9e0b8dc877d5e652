// Curves of the boundary that vertices slide along, and places on them: against shapes with known answers.

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/reference/domain.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::Cells;
using ::testing::ElementsAre;
using testing::input;
using ::testing::IsEmpty;
using testing::lattice;

constexpr StandingRule kSlide{InterfaceRule::Fixed, BoundaryRule::Slide, 20.0};

/// A fan around its middle: a regular polygon.
Mesh polygon(Index sides) {
  Mesh mesh;
  mesh.positions.push_back({0.1, 0.05, 0});
  for (Index i = 0; i < sides; ++i) mesh.positions.push_back({std::cos(2 * M_PI * i / sides), std::sin(2 * M_PI * i / sides), 0});
  for (Index i = 0; i < sides; ++i) testing::add(mesh, {0, 1 + i, 1 + (i + 1) % sides});
  return mesh;
}

std::set<Index> sliding(const InputMesh& mesh, double corner_angle = 20.0, InterfaceRule interfaces = InterfaceRule::Fixed) {
  const Domain domain(mesh, {interfaces, BoundaryRule::Slide, corner_angle});
  std::set<Index> found;
  for (Index v = 0; v < mesh.mesh.vertex_count(); ++v)
    if (domain.slides(v)) found.insert(v);
  EXPECT_EQ(domain.count(), found.size());
  return found;
}
/// Vertex (i, j) of a lattice of n x n squares.
Index at(Index n, Index i, Index j) { return i + j * (n + 1); }

Group of_lines(std::string name, std::vector<Index> ends) {
  return {.name = std::move(name), .role = "physical group", .code = 0, .dimension = 1, .members = std::move(ends)};
}

TEST(Curves, OfASquareAreItsSidesWithoutTheCorners) {
  const auto mesh = input(lattice(4, 0.2, 1));
  const Domain domain(*mesh, kSlide);
  const Curves& curves = domain.curves();
  EXPECT_EQ(domain.count(), 12U);
  EXPECT_EQ(domain.corners(), 4U);
  EXPECT_EQ(curves.curve_count(), 4U);
  for (const Index corner : {at(4, 0, 0), at(4, 4, 0), at(4, 0, 4), at(4, 4, 4)}) EXPECT_FALSE(curves.slides(corner));
  for (const Index v : {at(4, 1, 0), at(4, 2, 0), at(4, 3, 0)}) {
    const Vec3 p = mesh->mesh.positions[v];
    const auto place = curves.place(v, p);
    ASSERT_TRUE(place);
    EXPECT_NEAR(std::min(*place, 1.0 - *place), std::min(p.x, 1.0 - p.x), 1e-15) << "length along the side, from one end or the other";
    EXPECT_EQ(curves.at(v, *place), p) << "the input's points keep their bits";
  }
}

TEST(Curves, CornersAreWhereTheBoundaryTurnsByMore) {
  EXPECT_EQ(sliding(*input(polygon(19)), 18.9).size(), 0U) << "each turns by 18.95 degrees";
  EXPECT_EQ(sliding(*input(polygon(19)), 19.0).size(), 19U);
  EXPECT_EQ(sliding(*input(lattice(3, 0.0, 1)), 91.0).size(), 12U) << "a square without corners";
}

/// A closed curve without a corner has no ends: its places go round.
TEST(Curves, AClosedCurveGoesAround) {
  constexpr Index kSides = 40;
  const auto mesh = input(polygon(kSides));
  const Domain domain(*mesh, kSlide);
  const Curves& curves = domain.curves();
  ASSERT_EQ(curves.curve_count(), 1U);
  const double side = 2 * std::sin(M_PI / kSides);
  for (Index v = 1; v <= kSides; ++v) {
    const auto place = curves.place(v, mesh->mesh.positions[v]);
    ASSERT_TRUE(place);
    const auto beside = curves.neighbours(v, *place, mesh->mesh.positions);
    ASSERT_TRUE(beside) << v;
    EXPECT_NEAR(*place - beside->place_before, side, 1e-13);
    EXPECT_NEAR(beside->place_after - *place, side, 1e-13);
    for (const double step : {-0.7, -0.25, 0.25, 0.7}) {
      const Vec3 p = curves.at(v, *place + step * side);
      const auto found = curves.place(v, p);
      ASSERT_TRUE(found);
      const double way = std::remainder(*found - *place, kSides * side);
      EXPECT_NEAR(way, step * side, 1e-13);
    }
    // Two sides as one edge: the corner between them is as far away as the height of that triangle.
    const Vec3 before = mesh->mesh.positions[beside->before], after = mesh->mesh.positions[beside->after];
    EXPECT_NEAR(curves.deviation(v, beside->place_before, beside->place_after, before, after), side * std::sin(M_PI / kSides), 1e-13);
    EXPECT_EQ(curves.deviation(v, beside->place_before, *place, before, mesh->mesh.positions[v]), 0.0);
  }
}

TEST(Curves, APlaceBesideTheCurveIsNone) {
  const auto mesh = input(lattice(4, 0.2, 1));
  const Domain domain(*mesh, kSlide);
  const Curves& curves = domain.curves();
  EXPECT_TRUE(curves.place(at(4, 2, 0), {0.4, 0.0, 0}));
  EXPECT_FALSE(curves.place(at(4, 2, 0), {0.4, 1e-9, 0}));
  EXPECT_FALSE(curves.place(at(4, 2, 0), {0.4, 1.0, 0})) << "that is another side";
}

TEST(Curves, BothSidesOfASlitStayTogetherAndItsTipsStay) {
  Mesh mesh = lattice(4, 0.0, 1, Cells::Quadrilaterals);
  // Cut along y = 1/2 between x = 1/4 and 3/4: the elements above get vertices of their own there.
  const Index twin = mesh.vertex_count(), cut = at(4, 2, 2);
  mesh.positions.push_back(mesh.positions[cut]);
  Mesh slit;
  slit.positions = mesh.positions;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    std::vector<Index> corners(mesh.elements.corners(e).begin(), mesh.elements.corners(e).end());
    if (e / 4 >= 2) std::ranges::replace(corners, cut, twin);
    slit.elements.add(ElementKind::Quadrilateral, corners);
  }
  const auto found = sliding(*input(slit));
  EXPECT_TRUE(found.contains(cut) && found.contains(twin)) << "they slide as one";
  EXPECT_FALSE(found.contains(at(4, 1, 2)) || found.contains(at(4, 3, 2))) << "the tips";
  EXPECT_EQ(found.size(), 14U);
  slit.periodic = {{cut, at(4, 2, 0)}};
  EXPECT_FALSE(sliding(*input(slit)).contains(cut)) << "the file pairs it with another one";
}

TEST(Curves, WhereTheBoundaryTouchesItselfItStays) {
  Mesh mesh;  // two squares that share a corner, each of four cells
  for (const double shift : {0.0, 1.0})
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 2; ++i)
        if (shift == 0.0 || i + j > 0) mesh.positions.push_back({shift + 0.5 * i, shift + 0.5 * j, 0});
  const auto corner = [](Index square, Index i, Index j) { return square == 0 ? i + 3 * j : i + j == 0 ? 8U : 8U + i + 3 * j; };
  for (const Index s : {0U, 1U})
    for (Index j = 0; j < 2; ++j)
      for (Index i = 0; i < 2; ++i)
        testing::add(mesh, {corner(s, i, j), corner(s, i + 1, j), corner(s, i + 1, j + 1), corner(s, i, j + 1)});
  const auto found = sliding(*input(mesh));
  EXPECT_EQ(found.size(), 8U) << "the middles of the sides";
  EXPECT_FALSE(found.contains(8));
}

TEST(Curves, WhatTheFileNamesStays) {
  constexpr Index n = 6;
  const Mesh plain = lattice(n, 0.0, 1, Cells::Quadrilaterals);
  const std::set<Index> all = sliding(*input(plain));
  const auto held = [&](const Mesh& mesh, InterfaceRule interfaces = InterfaceRule::Fixed) {
    std::vector<Index> missing;
    const auto now = sliding(*input(mesh), 20.0, interfaces);
    std::ranges::set_difference(all, now, std::back_inserter(missing));
    return missing;
  };
  Mesh mesh = plain;
  mesh.groups = {of_lines("inlet", {at(n, 1, 0), at(n, 2, 0), at(n, 2, 0), at(n, 3, 0)})};
  EXPECT_THAT(held(mesh), ElementsAre(at(n, 1, 0), at(n, 3, 0))) << "the ends of a line on the boundary";
  mesh.groups = {of_lines("weir", {at(n, 3, 0), at(n, 3, 1)})};
  EXPECT_THAT(held(mesh), ElementsAre(at(n, 3, 0))) << "an inner line ends there";
  EXPECT_THAT(held(mesh, InterfaceRule::Free), IsEmpty());
  mesh.groups = {{.name = "gauges", .role = "physical group", .code = 0, .dimension = 0, .members = {at(n, 4, 0)}}};
  EXPECT_THAT(held(mesh), ElementsAre(at(n, 4, 0)));
  EXPECT_THAT(held(mesh, InterfaceRule::Free), ElementsAre(at(n, 4, 0))) << "no interface";
  mesh.groups = {
      {.name = "open 1", .role = "open boundary", .code = 0, .dimension = 0, .members = {at(n, 2, 0), at(n, 3, 0), at(n, 4, 0)}}};
  EXPECT_THAT(held(mesh), ElementsAre(at(n, 2, 0), at(n, 4, 0))) << "the ends of a string";
  Group steel{.name = "steel", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (e % n < 2) steel.members.push_back(e);
  mesh.groups = {steel};
  EXPECT_THAT(held(mesh), ElementsAre(at(n, 2, 0), at(n, 2, n))) << "the ends of an interface";
  EXPECT_THAT(held(mesh, InterfaceRule::Free), IsEmpty());
}

/// Curves between materials go from one end or corner of the interface to the next, off the boundary.
TEST(Curves, OfInterfacesAreWhatLiesBetweenMaterials) {
  constexpr Index n = 6;
  Mesh mesh = lattice(n, 0.0, 1, Cells::Quadrilaterals);
  Group steel{.name = "steel", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (e % n < 2) steel.members.push_back(e);
  mesh.groups = {steel};
  const auto slides = [](const Mesh& each, BoundaryRule boundary) {
    const auto prepared = input(each);
    const Domain domain(*prepared, {InterfaceRule::Slide, boundary, 20.0});
    std::set<Index> inside;
    for (Index v = 0; v < each.vertex_count(); ++v)
      if (domain.slides(v) && prepared->topology.boundary()[v] == 0) inside.insert(v);
    EXPECT_EQ(inside.size(), domain.count_inside());
    EXPECT_EQ(domain.count() == domain.count_inside(), boundary == BoundaryRule::Fixed);
    return inside;
  };
  const std::set<Index> all{at(n, 2, 1), at(n, 2, 2), at(n, 2, 3), at(n, 2, 4), at(n, 2, 5)};
  EXPECT_EQ(slides(mesh, BoundaryRule::Fixed), all);
  EXPECT_EQ(slides(mesh, BoundaryRule::Slide), all);
  mesh.groups.push_back({.name = "bolt", .role = "physical group", .code = 0, .dimension = 0, .members = {at(n, 2, 3)}});
  EXPECT_EQ(slides(mesh, BoundaryRule::Fixed), (std::set<Index>{at(n, 2, 1), at(n, 2, 2), at(n, 2, 4), at(n, 2, 5)}));
  mesh.groups.back() = of_lines("weld", {at(n, 2, 4), at(n, 3, 4)});
  EXPECT_EQ(slides(mesh, BoundaryRule::Fixed), (std::set<Index>{at(n, 2, 1), at(n, 2, 2), at(n, 2, 3), at(n, 2, 5)}));
  // A square of another material has four corners, which stay.
  Group core{.name = "core", .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index j = 1; j < 4; ++j)
    for (Index i = 1; i < 4; ++i) core.members.push_back(i + j * n);
  mesh.groups = {core};
  EXPECT_EQ(slides(mesh, BoundaryRule::Fixed).size(), 8U);
  mesh.groups.clear();
  EXPECT_THAT(slides(mesh, BoundaryRule::Slide), IsEmpty());
}

/// Lists of all edges, which some mesh generators write, have no meaning.
TEST(Curves, AListOfAllEdgesHoldsNothing) {
  constexpr Index n = 5;
  Mesh mesh = lattice(n, 0.0, 1, Cells::Quadrilaterals);
  std::vector<Index> ends;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i < n; ++i) ends.insert(ends.end(), {at(n, i, j), at(n, i + 1, j), at(n, j, i), at(n, j, i + 1)});
  mesh.groups = {of_lines("edges", ends)};
  EXPECT_EQ(sliding(*input(mesh)).size(), 4U * (n - 1));
}

}  // namespace
}  // namespace dmoscope
