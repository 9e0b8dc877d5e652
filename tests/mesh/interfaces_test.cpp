// Vertices inside a mesh that interfaces hold, and the reasons: against the answers known for the lattices below.

#include "core/mesh/interfaces.h"

#include <cmath>
#include <functional>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/generate.h"
#include "core/mesh/materials.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::set<Index> held(const InputMesh& input) {
  std::set<Index> found;
  for (Index v = 0; v < input.mesh.vertex_count(); ++v)
    if (input.interfaces.holds(v)) found.insert(v);
  return found;
}

/// n x n quadrilaterals; vertex (i, j) is i + j (n + 1), element (i, j) is i + j n.
Mesh squares(Index n) { return testing::lattice(n, 0.0, 1, testing::Cells::Quadrilaterals); }

Group of_elements(std::string name, const Mesh& mesh, const std::function<bool(Index)>& has) {
  Group group{.name = std::move(name), .role = "physical group", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < mesh.elements.size(); ++e)
    if (has(e)) group.members.push_back(e);
  return group;
}

Group of_lines(std::string name, std::vector<Index> ends, std::string role = "physical group") {
  return {.name = std::move(name), .role = std::move(role), .code = 0, .dimension = 1, .members = std::move(ends)};
}

Field of_cells(std::string name, const Mesh& mesh, const std::function<double(Index)>& value) {
  Field field{.name = std::move(name), .on = Field::On::Elements, .components = 1, .type = "int", .role = "", .values = {}};
  for (Index e = 0; e < mesh.elements.size(); ++e) field.values.push_back(value(e));
  return field;
}

/// Every edge of the lattice of n x n squares.
std::vector<Index> all_edges(Index n) {
  std::vector<Index> ends;
  for (Index j = 0; j <= n; ++j)
    for (Index i = 0; i < n; ++i) {
      ends.insert(ends.end(), {i + j * (n + 1), i + 1 + j * (n + 1)});
      ends.insert(ends.end(), {j + i * (n + 1), j + (i + 1) * (n + 1)});
    }
  return ends;
}

TEST(Interfaces, AMeshWithoutGroupsHasNone) {
  const auto input = testing::input(squares(4));
  EXPECT_FALSE(input->interfaces.any());
  EXPECT_EQ(input->interfaces.count(), 0U);
  EXPECT_EQ(input->interfaces.sentence("x"), "");
  EXPECT_EQ(input->interfaces.why(6), "");
}

TEST(Interfaces, BetweenGroupsAndTheRest) {
  Mesh mesh = squares(4);
  mesh.groups.push_back(of_elements("left", mesh, [](Index e) { return e % 4 < 2; }));
  const auto input = testing::input(mesh);
  EXPECT_THAT(held(*input), ElementsAre(7, 12, 17));  // the middle line without its ends, which lie on the boundary
  EXPECT_EQ(input->interfaces.why(12), "it lies on the interface between \"left\" and the rest, which stays");
  EXPECT_EQ(input->interfaces.count(HeldBy::Groups), 3U);
  EXPECT_EQ(input->interfaces.sentence("--interfaces free"),
            "3 vertices on the interface between groups stay (--interfaces free moves them)");
}

TEST(Interfaces, GroupsMayOverlapAndOneOfAllTellsNothing) {
  Mesh mesh = squares(4);
  mesh.groups.push_back(of_elements("all", mesh, [](Index) { return true; }));
  EXPECT_FALSE(testing::input(mesh)->interfaces.any());
  mesh.groups.push_back(of_elements("left", mesh, [](Index e) { return e % 4 < 2; }));
  mesh.groups.push_back(of_elements("right", mesh, [](Index e) { return e % 4 >= 2; }));
  mesh.groups.push_back(of_elements("low", mesh, [](Index e) { return e < 8; }));
  const auto input = testing::input(mesh);
  EXPECT_THAT(held(*input), ElementsAre(7, 11, 12, 13, 17));
  EXPECT_EQ(input->interfaces.why(17), "it lies on the interface between \"left\" and \"right\", which stays");
  EXPECT_EQ(input->interfaces.why(11), "it lies on the interface between \"low\" and the rest, which stays");
  EXPECT_THAT(input->interfaces.sentence("x"), HasSubstr("on 4 interfaces between groups"));  // four quarters
}

TEST(Interfaces, ManyGroupsInOnePointAreNamedInPart) {
  Mesh mesh = squares(2);
  for (Index k = 0; k < 4; ++k) mesh.groups.push_back(of_elements("g" + std::to_string(k), mesh, [k](Index e) { return e == k; }));
  const auto input = testing::input(mesh);
  EXPECT_EQ(input->interfaces.why(4), "it lies on the interface between \"g0\", \"g1\", \"g2\" and \"g3\", which stays");
  EXPECT_EQ(input->interfaces.sentence("x"), "1 vertex on the interface between groups stays (x moves it); no vertex is left to move");
}

TEST(Interfaces, ValuesThatNameMaterials) {
  Mesh mesh = squares(4);
  mesh.fields.push_back(of_cells("mat_id", mesh, [](Index e) { return e % 4 < 2 ? 1.0 : 7.0; }));
  const auto input = testing::input(mesh);
  EXPECT_THAT(held(*input), ElementsAre(7, 12, 17));
  EXPECT_EQ(input->interfaces.why(7), "it lies on the interface between mat_id 1 and 7, which stays");
  EXPECT_EQ(input->interfaces.sentence("x"), "3 vertices on the interface between values of mat_id stay (x moves them)");
}

TEST(Interfaces, ResultsAndNumberingsNameNothing) {
  Mesh mesh = squares(4);
  for (const char* name : {"mat_id", "Material Ids", "MaterialIds", "gmsh:physical", "REGION", "medit:ref", "attribute 1"}) {
    EXPECT_EQ(naming_of(of_cells(name, mesh, [](Index e) { return e % 2; })), Naming::Materials) << name;
    EXPECT_EQ(naming_of(of_cells(name, mesh, [](Index e) { return e; })), Naming::Nothing) << name << " numbers the elements";
    EXPECT_EQ(naming_of(of_cells(name, mesh, [](Index e) { return 0.5 * (e % 2); })), Naming::Nothing) << name << " is no whole number";
  }
  for (const char* name : {"pressure", "temperature", "partition", "vtkGhostType", "quality", "process id", "materials model error"})
    EXPECT_EQ(naming_of(of_cells(name, mesh, [](Index e) { return e % 2; })), Naming::Nothing) << name;
  Field of_points = of_cells("mat_id", mesh, [](Index e) { return e % 2; });
  of_points.on = Field::On::Vertices;
  EXPECT_EQ(naming_of(of_points), Naming::Nothing);
}

TEST(Interfaces, NamesThatOtherProgramsWrite) {
  const Mesh mesh = squares(4);
  for (const char* name : {"avsucd:material", "tag", "Tags", "label", "Labels", "tissue", "ElementBlockIds", "PhysicalIds", "tetgen:ref",
                           "flac3d:group", "ansys_material_type", "nastran:ref"})
    EXPECT_EQ(naming_of(of_cells(name, mesh, [](Index e) { return e % 2; })), Naming::Materials) << name;
  EXPECT_EQ(naming_of(of_cells("GeometryIds", mesh, [](Index e) { return e % 2; })), Naming::Geometry);
}

TEST(Interfaces, AnyCellDataCanBeNamed) {
  Mesh mesh = squares(4);
  mesh.fields.push_back(of_cells("zoning", mesh, [](Index e) { return e % 4 < 2 ? 0.25 : 0.5; }));
  mesh.fields.push_back(of_cells("rows", mesh, [](Index e) { return e / 4; }));
  EXPECT_FALSE(testing::input(mesh)->interfaces.any());
  const auto by_zoning = with_materials(*testing::input(mesh), std::vector<std::string>{"zoning"});
  EXPECT_THAT(held(*by_zoning), ElementsAre(7, 12, 17)) << "no whole numbers";
  EXPECT_EQ(by_zoning->interfaces.why(7), "it lies on the interface between zoning 0.25 and 0.5, which stays");
  EXPECT_TRUE(by_zoning->interfaces.between(1, 2));
  const auto by_both = with_materials(*by_zoning, std::vector<std::string>{"rows", "zoning"});
  EXPECT_THAT(held(*by_both), ElementsAre(6, 7, 8, 11, 12, 13, 16, 17, 18));
  EXPECT_THAT(said_materials(by_both->mesh), ElementsAre("zoning", "rows"));
  EXPECT_FALSE(with_materials(*by_both, {})->interfaces.any()) << "by the names alone again";
}

TEST(Interfaces, WhatCannotNameMaterialsIsRefused) {
  Mesh mesh = squares(4);
  mesh.fields.push_back(of_cells("zoning", mesh, [](Index e) { return e % 2; }));
  mesh.fields.push_back(of_cells("no number", mesh, [](Index e) { return e == 3 ? std::nan("") : 1.0; }));
  mesh.fields.push_back(
      {.name = "depth", .on = Field::On::Vertices, .components = 1, .type = "int", .role = "", .values = std::vector<double>(25, 1.0)});
  mesh.fields.push_back(
      {.name = "flow", .on = Field::On::Elements, .components = 2, .type = "int", .role = "", .values = std::vector<double>(32, 1.0)});
  const auto refused = [&](const std::string& name) -> std::string {
    try {
      name_materials(mesh, std::vector{name});
    } catch (const UsageError& error) {
      return error.what();
    }
    return "taken";
  };
  for (const char* name : {"zonin", "depth", "flow"})
    EXPECT_THAT(refused(name), ::testing::AllOf(HasSubstr(name), HasSubstr("known are zoning, no number"))) << name;
  EXPECT_THAT(refused("no number"), HasSubstr("no finite numbers"));
  EXPECT_THAT(said_materials(mesh), IsEmpty());
  EXPECT_EQ(refused("zoning"), "taken");
  Mesh bare = squares(4);
  EXPECT_THROW(name_materials(bare, std::vector<std::string>{"zoning"}), UsageError);
}

TEST(Interfaces, DataThatMayMeanMaterialsAreSaid) {
  Mesh mesh = squares(4);
  mesh.fields.push_back(of_cells("my zones", mesh, [](Index e) { return e % 4; }));
  mesh.fields.push_back(of_cells("pressure", mesh, [](Index e) { return 0.5 * (e % 4); }));
  mesh.fields.push_back(of_cells("partition", mesh, [](Index e) { return e % 4; }));
  mesh.fields.push_back(of_cells("steady", mesh, [](Index) { return 3; }));
  mesh.fields.push_back(of_cells("number", mesh, [](Index e) { return e; }));
  const auto input = testing::input(mesh);
  EXPECT_THAT(input->interfaces.offers("--materials"),
              ElementsAre("cell data \"my zones\" has 4 values: --materials \"my zones\" keeps their interfaces"));
  EXPECT_FALSE(input->interfaces.any());
  // A field whose vertices are all held already adds nothing.
  mesh.fields.push_back(of_cells("mat", mesh, [](Index e) { return e % 4; }));
  EXPECT_THAT(testing::input(mesh)->interfaces.offers("x"), IsEmpty());
  EXPECT_THAT(with_materials(*input, std::vector<std::string>{"my zones", "steady"})->interfaces.offers("x"),
              ElementsAre("cell data \"steady\" has the same value everywhere: it makes no interface"));
}

TEST(Interfaces, PartsOfTheGeometryCountOnlyWhereNothingElseTellsElementsApart) {
  Mesh mesh = squares(4);
  mesh.fields.push_back(of_cells("gmsh:geometrical", mesh, [](Index e) { return e < 8 ? 1 : 2; }));
  EXPECT_THAT(held(*testing::input(mesh)), ElementsAre(11, 12, 13));
  mesh.groups.push_back(of_elements("left", mesh, [](Index e) { return e % 4 < 2; }));
  EXPECT_THAT(held(*testing::input(mesh)), ElementsAre(7, 12, 17));
}

TEST(Interfaces, NamedLinesHoldAlsoWhereTheyCross) {
  Mesh mesh = squares(4);
  mesh.groups.push_back(of_lines("down", {2, 7, 7, 12, 12, 17, 17, 22}));
  mesh.groups.push_back(of_lines("across", {10, 11, 11, 12, 12, 13, 13, 14}));
  const auto input = testing::input(mesh);
  EXPECT_THAT(held(*input), ElementsAre(7, 11, 12, 13, 17));  // at 12 all four edges are named
  EXPECT_EQ(input->interfaces.why(7), "it lies on the line \"down\", which stays");
  EXPECT_EQ(input->interfaces.why(13), "it lies on the line \"across\", which stays");
  EXPECT_EQ(input->interfaces.count(HeldBy::Lines), 5U);
}

TEST(Interfaces, AListOfAllEdgesHoldsNothingAndThatIsSaid) {
  Mesh mesh = squares(6);
  mesh.groups.push_back(of_lines("edges", all_edges(6)));
  const auto input = testing::input(mesh);
  EXPECT_FALSE(input->interfaces.any());
  EXPECT_EQ(input->interfaces.sentence("x"),
            "25 vertices are named only in lists of all lines, faces or points there are; such lists hold nothing");
  mesh.groups.back() = of_lines("RequiredEdges", all_edges(6), "mark");
  const auto required = testing::input(mesh);
  EXPECT_EQ(required->interfaces.count(), 25U);
  EXPECT_THAT(required->interfaces.sentence("x"), HasSubstr("no vertex is left to move"));
}

TEST(Interfaces, PointsHoldButNotInsideSetsThatFillTheMesh) {
  Mesh mesh = squares(6);
  mesh.groups.push_back({.name = "Corners", .role = "mark", .code = 0, .dimension = 0, .members = {0, 6, 24}});
  const auto one = testing::input(mesh);
  EXPECT_THAT(held(*one), ElementsAre(24));
  EXPECT_EQ(one->interfaces.why(24), "it is one of the points \"Corners\", which stay");
  std::vector<Index> all(mesh.positions.size());
  for (Index v = 0; v < all.size(); ++v) all[v] = v;
  mesh.groups = {{.name = "nodes", .role = "", .code = 0, .dimension = 0, .members = all}};
  EXPECT_FALSE(testing::input(mesh)->interfaces.any());
  mesh.groups = {{.name = "RequiredVertices", .role = "mark", .code = 0, .dimension = 0, .members = all}};
  EXPECT_EQ(testing::input(mesh)->interfaces.count(HeldBy::Points), 25U);
}

TEST(Interfaces, BoundaryStringsInsideHold) {
  Mesh mesh = squares(4);
  mesh.groups.push_back({.name = "land boundary 1", .role = "land boundary", .code = 24, .dimension = 0, .members = {2, 7, 12}});
  const auto input = testing::input(mesh);
  EXPECT_THAT(held(*input), ElementsAre(7, 12));
  EXPECT_EQ(input->interfaces.why(7), "it lies on \"land boundary 1\", which stays");
}

/// Faces of hexahedra, each once or twice: all, or only those whose four corners satisfy `has`.
Group faces_of_block(const Mesh& mesh, const std::function<bool(Index)>& has) {
  Group group{.name = "wall", .role = "marker", .code = 0, .dimension = 2, .members = {}};
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto c = mesh.elements.corners(e);
    for (const auto& f : {std::array{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
      std::array<Index, 4> face{};
      for (std::size_t k = 0; k < 4; ++k) face[k] = c[static_cast<std::size_t>(f[k])];
      if (std::ranges::all_of(face, has)) group.faces.add(ElementKind::Quadrilateral, face);
    }
  }
  return group;
}

TEST(Interfaces, NamedFacesAndLinesOfAVolume) {
  Mesh mesh = test::volume_grid(6, test::Fill::Hexahedra);
  const auto line = [](Index v, Index axis) { return axis == 0 ? v % 7 : axis == 1 ? v / 7 % 7 : v / 49; };
  mesh.groups.push_back(faces_of_block(mesh, [&](Index v) { return line(v, 0) == 3; }));
  const auto wall = testing::input(mesh);
  EXPECT_EQ(wall->interfaces.count(HeldBy::Faces), 25U);
  for (const Index v : held(*wall)) EXPECT_EQ(line(v, 0), 3U);
  EXPECT_EQ(wall->interfaces.why(3 + 7 * 3 + 49 * 3), "it lies on a face of \"wall\", which stays");
  // Three walls that cross name all twelve faces of the middle vertex.
  mesh.groups.back() = faces_of_block(mesh, [&](Index v) { return line(v, 0) == 3; });
  for (const Index axis : {1U, 2U}) {
    const Group more = faces_of_block(mesh, [&](Index v) { return line(v, axis) == 3; });
    mesh.groups.back().faces.append(more.faces);
  }
  EXPECT_EQ(testing::input(mesh)->interfaces.count(HeldBy::Faces), 125U - 64U);
  mesh.groups = {faces_of_block(mesh, [](Index) { return true; })};
  const auto all = testing::input(mesh);
  EXPECT_FALSE(all->interfaces.any());
  EXPECT_THAT(all->interfaces.sentence("x"), HasSubstr("125 vertices are named only in lists"));
  const Index middle = 3 + 7 * 3 + 49 * 3;
  mesh.groups = {of_lines("wire", {middle - 1, middle, middle, middle + 1})};
  EXPECT_THAT(held(*testing::input(mesh)), ElementsAre(middle - 1, middle, middle + 1));
}

TEST(Interfaces, OfNestedMaterialsAreWhatLiesBetweenThem) {
  Progress progress;
  const auto square = testing::input(generate_mesh("nested", 100, 3, progress));
  std::set<Index> expected;  // 10 x 10 lines, the inner square from line 2 to 7
  for (Index v = 0; v < 100; ++v) {
    const Index i = v % 10, j = v / 10;
    if (i >= 2 && i <= 7 && j >= 2 && j <= 7 && (i == 2 || i == 7 || j == 2 || j == 7)) expected.insert(v);
  }
  EXPECT_EQ(held(*square), expected);
  EXPECT_EQ(expected.size(), 20U);
  const auto cube = testing::input(generate_mesh("nested-solids", 216, 3, progress));
  EXPECT_EQ(cube->interfaces.count(HeldBy::Groups), 56U);  // 4^3 - 2^3
  EXPECT_EQ(cube->interfaces.count(), 56U);
}

TEST(Interfaces, RulesHaveNames) {
  EXPECT_EQ(parse_interface_rule("fixed"), InterfaceRule::Fixed);
  EXPECT_EQ(parse_interface_rule(name(InterfaceRule::Free)), InterfaceRule::Free);
  EXPECT_EQ(parse_interface_rule(name(InterfaceRule::Slide)), InterfaceRule::Slide);
  EXPECT_THROW((void)parse_interface_rule("sliding"), UsageError);
}

}  // namespace
}  // namespace dmoscope
