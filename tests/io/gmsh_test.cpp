#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <class Range>
std::vector<Index> list(const Range& range) {
  return {range.begin(), range.end()};
}

const Group& group(const Mesh& mesh, std::string_view name) {
  static const Group none;
  for (const Group& g : mesh.groups) {
    if (g.name == name) return g;
  }
  ADD_FAILURE() << "no group " << name;
  return none;
}

Mesh stripped(Mesh mesh) {
  mesh.source.reset();
  return mesh;
}

/// Old files name numbers without a dimension; saved again by Gmsh such names have the dimension -1. No blank need stand before a quote.
TEST(Gmsh, NamesWithoutADimensionAreOfWhateverHasTheNumber) {
  const std::vector<std::pair<std::string, std::string>> ways{{"", " "}, {"-1 ", " "}, {"", ""}, {"-1 ", ""}, {"", "\t"}};
  for (const auto& [d, blank] : ways) {
    const Mesh mesh = read_bytes("a.msh", "$MeshFormat\n2.0 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n" + d + "1" + blank +
                                              "\"left wall\"\n" + d + "2" + blank + "\"steel\"\n2 3" + blank +
                                              "\"glass\"\n$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n"
                                              "$EndNodes\n$Elements\n3\n1 1 2 1 1 4 1\n2 2 2 2 1 1 2 3\n3 2 2 3 1 1 3 4\n$EndElements\n");
    EXPECT_EQ(group(mesh, "left wall").dimension, 1);
    EXPECT_THAT(group(mesh, "left wall").members, ElementsAre(3, 0));
    EXPECT_THAT(group(mesh, "steel").members, ElementsAre(0));
    EXPECT_EQ(group(mesh, "steel").code, 2);
    EXPECT_THAT(group(mesh, "glass").members, ElementsAre(1));
  }
}

/// Two squares side by side whose left and right ends are one, in either version; the transformation is passed over.
TEST(Gmsh, PeriodicVerticesArePaired) {
  const std::string version2 =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 2 1 0\n5 1 1 0\n6 0 1 0\n$EndNodes\n"
      "$Elements\n2\n1 3 2 1 1 1 2 5 6\n2 3 2 1 1 2 3 4 5\n$EndElements\n";
  const std::string affine = "Affine 1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1\n";
  for (const std::string& with : {std::string(), affine}) {
    const Mesh mesh = read_bytes("a.msh", version2 + "$Periodic\n1\n1 2 4\n" + with + "2\n3 1\n4 6\n$EndPeriodic\n");
    ASSERT_EQ(mesh.periodic.size(), 2U);
    EXPECT_THAT(mesh.periodic[0], ElementsAre(2, 0));
    EXPECT_THAT(mesh.periodic[1], ElementsAre(3, 5));
  }
  const Mesh mesh = read_bytes("b.msh",
                               "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 2 1 0 0 0\n$EndEntities\n"
                               "$Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0 0 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n0 1 0\n$EndNodes\n"
                               "$Elements\n1 2 1 2\n2 1 3 2\n1 1 2 5 6\n2 2 3 4 5\n$EndElements\n"
                               "$Periodic\n1\n1 2 4\n16 1 0 0 2 0 1 0 0 0 0 1 0 0 0 0 1\n2\n3 1\n4 6\n$EndPeriodic\n");
  ASSERT_EQ(mesh.periodic.size(), 2U);
  EXPECT_THAT(mesh.periodic[1], ElementsAre(3, 5));
  try {
    (void)read_bytes("c.msh", version2 + "$Periodic\n1\n1 2 4\n1\n3 9\n$EndPeriodic\n");
    FAIL() << "there is no node 9";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("pairs node 3 with 9"));
    EXPECT_THAT(error.what(), HasSubstr(":22"));
  }
}

/// Partitions as Gmsh writes them: two of one surface, with a line between them that is no line of the mesh.
TEST(Gmsh, PartitionsArePutTogether) {
  const std::string text = dmoscope::testing::gmsh_4_partitioned();
  const Mesh mesh = read_bytes("a.msh", text);
  expect_consistent(mesh);
  EXPECT_THAT(list(mesh.elements.all_corners()), ElementsAre(0, 1, 2, 0, 2, 3));
  ASSERT_EQ(mesh.groups.size(), 2U) << "no group for what lies between the partitions";
  EXPECT_THAT(group(mesh, "plate").members, ElementsAre(0, 1));
  EXPECT_EQ(group(mesh, "plate").code, 5);
  EXPECT_THAT(group(mesh, "entity 7").members, ElementsAre(0, 1));
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::IsSupersetOf(std::vector<std::string>{
                                               "the partitions of its elements", "the interfaces of its partitions", "$GhostElements"}));
  EXPECT_EQ(written("a.msh", mesh), text);
  expect_truncation_safe("a.msh", text);
}

TEST(Gmsh, Version2WithGapsInItsNumbers) {
  const Mesh mesh = read_bytes("a.msh", dmoscope::testing::gmsh_2_ascii());
  expect_consistent(mesh);
  ASSERT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.positions[2], (Vec3{0, 1.5, 0}));
  EXPECT_THAT(list(mesh.elements.all_corners()), ElementsAre(0, 1, 2, 3, 1, 2, 3, 4));
  EXPECT_TRUE(std::ranges::all_of(mesh.elements.kinds(), [](ElementKind kind) { return kind == ElementKind::Tetrahedron; }));
  ASSERT_EQ(mesh.groups.size(), 4U);
  EXPECT_EQ(group(mesh, "physical 4").dimension, 0);
  EXPECT_EQ(group(mesh, "physical 4").role, "physical group");
  EXPECT_EQ(group(mesh, "physical 4").code, 4);
  EXPECT_THAT(group(mesh, "physical 4").members, ElementsAre(0));
  EXPECT_EQ(group(mesh, "entity 2").role, "entity");
  EXPECT_EQ(group(mesh, "entity 2").dimension, 1);
  EXPECT_THAT(group(mesh, "entity 2").members, ElementsAre(0, 1));
  EXPECT_EQ(group(mesh, "outer wall").code, 7);
  EXPECT_THAT(list(group(mesh, "outer wall").faces.all_corners()), ElementsAre(0, 2, 1));
  EXPECT_EQ(group(mesh, "rock").dimension, 2);
  EXPECT_THAT(group(mesh, "rock").members, ElementsAre(0, 1));
  ASSERT_EQ(mesh.fields.size(), 3U);
  EXPECT_EQ(mesh.fields[0].name, "gmsh:geometrical");
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(1, 2));
  EXPECT_EQ(mesh.fields[1].name, "depth");
  EXPECT_THAT(mesh.fields[1].values, ElementsAre(2, 1, 4, 5, 3));
  EXPECT_EQ(mesh.fields[2].components, 3);
  EXPECT_THAT(mesh.fields[2].values, ElementsAre(1, 2, 3, 0, 0, ::testing::NanSensitiveDoubleEq(std::nan(""))));
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::IsSupersetOf({"$Periodic", "the numbers of its nodes", "the numbers of its elements",
                                                                    "the partitions of its elements"}));
  expect_patched("a.msh", dmoscope::testing::gmsh_2_ascii(), true);
}

void expect_binary_2(const Mesh& mesh) {
  expect_consistent(mesh);
  ASSERT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.positions[2], (Vec3{0, 1.5, 0}));
  EXPECT_EQ(mesh.positions[4], (Vec3{1, 1, 1}));
  EXPECT_THAT(list(mesh.elements.all_corners()), ElementsAre(0, 1, 2, 3, 1, 2, 3, 4));
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_THAT(list(group(mesh, "physical 7").faces.all_corners()), ElementsAre(0, 2, 1));
  EXPECT_THAT(group(mesh, "physical 1").members, ElementsAre(0, 1));
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].values[0], 0.5);
  EXPECT_EQ(mesh.fields[0].values[1], 0.75);
  EXPECT_TRUE(std::isnan(mesh.fields[0].values[2]));
  EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("no value on 3 of 5 vertices")));
}

TEST(Gmsh, Version2BinaryOfEitherByteOrder) {
  for (const bool big : {false, true}) expect_binary_2(read_bytes("a.msh", dmoscope::testing::gmsh_2_binary(big)));
}

TEST(Gmsh, Version4WithEntitiesAndParametricNodes) {
  const Mesh mesh = read_bytes("a.msh", dmoscope::testing::gmsh_4_ascii());
  expect_consistent(mesh);
  ASSERT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.positions[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.positions[2], (Vec3{1, 1, 0}));
  EXPECT_EQ(mesh.positions[4], (Vec3{2, 0.5, 0}));
  EXPECT_THAT(list(mesh.elements.all_corners()), ElementsAre(0, 1, 2, 0, 2, 3, 1, 4, 2));
  ASSERT_EQ(mesh.groups.size(), 4U);
  EXPECT_EQ(group(mesh, "plate").code, 5);
  EXPECT_THAT(group(mesh, "plate").members, ElementsAre(0, 1, 2));
  EXPECT_THAT(group(mesh, "physical 8").members, ElementsAre(0, 1));
  EXPECT_THAT(group(mesh, "physical 6").members, ElementsAre(0, 1));
  EXPECT_EQ(group(mesh, "physical 6").dimension, 1);
  EXPECT_THAT(group(mesh, "entity 1").members, ElementsAre(0));
  EXPECT_TRUE(mesh.fields.empty()) << "the physical groups tell the entities already";
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains("the parametric coordinates of its nodes"));
  expect_patched("a.msh", dmoscope::testing::gmsh_4_ascii(), true);
}

TEST(Gmsh, Version4BinaryOfEitherByteOrder) {
  for (const bool big : {false, true}) {
    const Mesh mesh = read_bytes("a.msh", dmoscope::testing::gmsh_4_binary(big));
    expect_consistent(mesh);
    ASSERT_EQ(mesh.positions.size(), 5U);
    EXPECT_EQ(mesh.positions[1], (Vec3{1, 0, 0}));
    EXPECT_EQ(mesh.positions[2], (Vec3{0, 1.5, 0}));
    EXPECT_EQ(mesh.positions[4], (Vec3{1, 1, 1}));
    EXPECT_THAT(list(mesh.elements.all_corners()), ElementsAre(0, 1, 2, 3, 1, 2, 3, 4));
    ASSERT_EQ(mesh.groups.size(), 1U) << "the tetrahedra have no physical group";
    EXPECT_EQ(mesh.groups[0].code, 7);
    EXPECT_THAT(list(group(mesh, "physical 7").faces.all_corners()), ElementsAre(0, 2, 1));
  }
}

TEST(Gmsh, BinaryFilesArePatchedWhereTheCoordinatesAre) {
  for (const bool big : {false, true}) {
    for (const std::string& bytes : {dmoscope::testing::gmsh_2_binary(big), dmoscope::testing::gmsh_4_binary(big)}) {
      const Mesh mesh = read_bytes("a.msh", bytes);
      EXPECT_EQ(written("a.msh", mesh), bytes);
      std::vector<Vec3> positions = mesh.positions;
      positions[1].y = 0.1;  // a parametric node in version 4
      positions[4] = {-0.0, 1e300, 1.0 / 3.0};
      std::vector<std::string> notes;
      const std::string patched = written("a.msh", mesh, positions, &notes);
      EXPECT_THAT(notes, ElementsAre());
      ASSERT_EQ(patched.size(), bytes.size());
      std::vector<std::size_t> changed;
      for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (bytes[i] != patched[i]) changed.push_back(i);
      }
      EXPECT_LE(changed.size(), 4 * sizeof(double));
      for (const std::size_t i : changed) {
        const auto first = mesh.source->place(1), last = mesh.source->place(4);
        EXPECT_TRUE((i >= first + 8 && i < first + 16) || (i >= last && i < last + 24)) << i;
      }
      expect_same_positions(positions, read_bytes("a.msh", patched).positions);
    }
  }
}

TEST(Gmsh, EveryKindOfElement) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n9 .5 .5 2\n"
      "$EndNodes\n$Elements\n5\n1 3 2 0 1 1 4 3 2\n2 5 2 0 1 1 2 3 4 5 6 7 8\n3 7 2 0 1 5 6 7 8 9\n4 6 2 0 2 1 2 4 5 6 8\n5 4 0 1 2 4 5\n"
      "$EndElements\n";
  const Mesh mesh = read_bytes("a.msh", text);
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid, ElementKind::Wedge, ElementKind::Tetrahedron));
  EXPECT_THAT(list(mesh.elements.corners(2)), ElementsAre(0, 1, 3, 4, 5, 7));
  ASSERT_EQ(mesh.fields.size(), 1U) << "no physical group tells the entities";
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(1, 1, 2, 0));
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_THAT(list(mesh.groups[0].faces.corners(0)), ElementsAre(0, 3, 2, 1));
  const Mesh again = read_bytes("b.msh", written("b.msh", stripped(mesh)));
  expect_same_elements(mesh, again);
  expect_same_positions(mesh.positions, again.positions);
}

TEST(Gmsh, MadeAnewItHoldsTheSame) {
  const Mesh mesh = stripped(read_bytes("a.msh", dmoscope::testing::gmsh_2_ascii()));
  std::vector<std::string> notes;
  const std::string text = written("b.msh", mesh, mesh.positions, &notes);
  EXPECT_THAT(notes, ElementsAre());
  const Mesh again = read_bytes("b.msh", text);
  expect_same_elements(mesh, again);
  expect_same_positions(mesh.positions, again.positions);
  ASSERT_EQ(again.groups.size(), mesh.groups.size());
  for (const Group& g : mesh.groups) {
    SCOPED_TRACE(g.name);
    EXPECT_EQ(group(again, g.name).dimension, g.dimension);
    EXPECT_EQ(group(again, g.name).members, g.members);
    EXPECT_EQ(group(again, g.name).code, g.code);
    EXPECT_EQ(list(group(again, g.name).faces.all_corners()), list(g.faces.all_corners()));
  }
  ASSERT_EQ(again.fields.size(), 3U);
  EXPECT_EQ(again.fields[0].values, mesh.fields[0].values);
  EXPECT_EQ(again.fields[1].values, mesh.fields[1].values);
  EXPECT_EQ(again.fields[2].values[2], 3.0);
  // every node counts from 1, the boundary first
  EXPECT_THAT(text, HasSubstr("$Elements\n5\n1 15 2 4 4 1\n2 1 2 2 2 1 2\n3 2 2 7 7 1 3 2\n4 4 2 1 1 1 2 3 4\n"));
}

TEST(Gmsh, WhatCannotBeCarriedIsNamed) {
  const Mesh mesh = read_bytes("a.msh", dmoscope::testing::gmsh_4_ascii());
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.msh", written("b.msh", stripped(mesh), mesh.positions, &notes));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("\"physical 8\" lost 2 elements"))) << "version 2 has one physical group for each element";
  EXPECT_EQ(again.elements.size(), 3U);
  (void)written("b.off", mesh, mesh.positions, &notes);
  EXPECT_THAT(notes, ::testing::IsSupersetOf({HasSubstr("\"plate\""), HasSubstr("$Entities"), HasSubstr("the numbers of its nodes")}));
}

TEST(Gmsh, BoundaryStringsBecomeLines) {
  // An island of type 1 is closed, an open boundary is not.
  const Mesh grid =
      read_bytes("a.14", "t\n2 4\n1 0 0 5\n2 1 0 5\n3 1 1 5\n4 0 1 6\n1 3 1 2 3\n2 3 1 3 4\n1\n3\n3\n1\n2\n3\n1\n3\n3 1\n1\n3\n4\n");
  ASSERT_EQ(grid.groups.size(), 2U);
  for (const std::string name : {"a.msh", "a.mesh"}) {
    std::vector<std::string> notes;
    const Mesh mesh = read_bytes(name, written(name, grid, grid.positions, &notes));
    EXPECT_THAT(notes, ::testing::IsSupersetOf({HasSubstr(grid.groups[0].name), HasSubstr(grid.groups[1].name)}));
    ASSERT_EQ(mesh.groups.size(), 2U) << name;
    EXPECT_EQ(mesh.groups[0].dimension, 1);
    EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1, 1, 2));
    EXPECT_THAT(mesh.groups[1].members, ElementsAre(0, 2, 2, 3, 3, 0));
    if (name == "a.msh") {
      EXPECT_EQ(mesh.groups[0].name, grid.groups[0].name);
      ASSERT_EQ(mesh.fields.size(), 1U);
      EXPECT_EQ(mesh.fields[0].name, "depth");
      EXPECT_THAT(mesh.fields[0].values, ElementsAre(5, 5, 5, 6));
    }
  }
}

TEST(Gmsh, DataOfTheBoundaryIsNoField) {
  std::string text = dmoscope::testing::gmsh_2_ascii();
  const std::string before = "3\n2\n4 1 2 3\n9 0 0 nan\n";
  text.replace(text.find(before), before.size(), "3\n1\n3 1 2 3\n");
  const Mesh mesh = read_bytes("a.msh", text);
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[1].name, "depth");
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains(HasSubstr("values \"flow\"")));
}

TEST(Gmsh, LineEndsOfAllKinds) {
  for (const std::string& text : {dmoscope::testing::gmsh_2_ascii(), dmoscope::testing::gmsh_4_ascii()}) {
    std::string crlf;
    for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
    expect_patched("a.msh", crlf, true);
    EXPECT_EQ(read_bytes("a.msh", crlf).groups.size(), 4U);
  }
}

TEST(Gmsh, Malformed) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
  const std::string four = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  const std::string nodes_4 = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";
  const struct {
    std::string text;
    std::size_t line;
    const char* words;
  } table[] = {
      {"$NOD\n1\n", 1, "MSH version 1 is not read"},
      {"$MeshFormat\n4 0 8\n", 2, "MSH version \"4\" is not read: save the mesh in version 2.2 or 4.1"},
      {"$MeshFormat\n2.2 2 8\n", 2, "file type 2"},
      {"$MeshFormat\n2.2 0 4\n", 2, "numbers of 8 bytes"},
      {"$MeshFormat\n2.2 0 8\n$Nodes\n", 3, "expected $EndMeshFormat"},
      {"$MeshFormat\n2.2 1 8\nabcdefgh", 0, "byte order"},
      {head, 3, "no $Nodes"},
      {head + nodes, 9, "no elements of two or three dimensions"},
      {head + "$Elements\n1\n", 4, "$Elements before $Nodes"},
      {head + nodes + nodes, 10, "a second $Nodes"},
      {head + "$Nodes\n99999999\n1 0 0 0\n", 5, "but only"},
      {head + "$Nodes\n-1\n1 0 0 0\n", 5, "negative"},
      {head + "$Nodes\n1\n1 0 0 inf\n", 6, "not a finite number"},
      {head + "$Nodes\n2\n1 0 0 0\n1 0 0 1\n$EndNodes\n", 7, "node 2 of $Nodes is taken"},
      {head + "$Nodes\n2\n1 0 0 0\n2 0 0\n$EndNodes\n", 8, "got \"$EndNodes\""},
      {head + "$Nodes\n1\n1 0 0 0\n2 0 0 0\n$EndNodes\n", 7, "expected $EndNodes"},
      {head + nodes + "$Elements\n1\n1 2 2 0 1 1 2 4\n$EndElements\n", 12, "names node 4, which the file does not have"},
      {head + nodes + "$Elements\n1\n7 9 2 0 1 1 2 3 1 2 3\n$EndElements\n", 12, "a triangle of higher order (element type 9)"},
      {head + nodes + "$Elements\n1\n7 11 2 0 1 1 2 3 1 2 3\n$EndElements\n", 12, "gmsh.model.mesh.setOrder(1)"},
      {head + nodes + "$Elements\n1\n7 34 2 0 1 1 2 3 1 2 3\n$EndElements\n", 12, "elements of type 34 are not read"},
      {head + nodes + "$Elements\n1\n7 2 -2 0 1 1 2 3\n$EndElements\n", 12, "-2 tags"},
      {head + nodes + "$Elements\n1\n7 2 99999999999 0 1 1 2 3\n$EndElements\n", 13, "expected a tag of an element"},
      {head + nodes + "$Elements\n88888888\n7 2 2 0 1 1 2 3\n$EndElements\n", 11, "but only"},
      {head + nodes + "$Elements\n1\n1 1 2 0 1 1 2\n$EndElements\n", 13, "no elements of two or three dimensions"},
      {head + nodes + "junk\n", 10, "expected a section such as $Nodes, got \"junk\""},
      {head + nodes + "$Notes\njunk\n", 11, "$EndNotes"},
      {head + "$PhysicalNames\n1\n-2 1 \"a\"\n$EndPhysicalNames\n", 6, "a physical group of -2 dimensions"},
      {head + "$PhysicalNames\n1\n4 1 \"a\"\n$EndPhysicalNames\n", 6, "a physical group of 4 dimensions"},
      {head + "$PhysicalNames\n1\n\"a\"\n$EndPhysicalNames\n", 6, "the dimension of a physical group"},
      {head + "$PhysicalNames\n1\n1x\"a\"\n$EndPhysicalNames\n", 6, "got \"1x\""},
      {head + nodes + "$NodeData\n1\n\"a\"\n1\n0\n2\n0\n1\n", 15, "3 integer tags"},
      {head + nodes + "$NodeData\n1\n\"a\"\n1\n0\n3\n0\n1\n1\n9 1\n$EndNodeData\n", 19, "values of node 9, which"},
      {head + nodes + "$NodeData\n1\n\"a\"\n1\n0\n3\n0\n99999\n1\n1 1\n$EndNodeData\n", 17, "99999 components"},
      {head + nodes + "$ElementData\n1\n\"a\"\n1\n0\n3\n0\n1\n0\n$EndElementData\n", 10, "$ElementData before $Elements"},
      {four + "$PartitionedEntities\n2\n", 5, "the file ends"},
      {four + "$Nodes\n1 1 1 3\n4 1 0 1\n1\n0 0 0\n", 6, "an entity of 4 dimensions"},
      {four + "$Nodes\n1 3 1 3\n2 1 0 9\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n", 6, "but only"},
      {four + "$Nodes\n1 3 1 3\n2 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n", 10, "2 nodes in the blocks, but $Nodes says 3"},
      {four + "$Nodes\n1 1 1 3\n2 1 0 2\n1\n2\n0 0 0\n1 0 0\n$EndNodes\n", 6, "more nodes in the blocks"},
      {four + nodes_4 + "$Elements\n1 1 1 1\n1 1 2 1\n1 1 2 3\n$EndElements\n", 16, "elements of type 2 in an entity of 1 dimensions"},
      {four + nodes_4 + "$Elements\n1 1 1 1\n3 1 11 1\n1 1 2 3\n$EndElements\n", 16, "a tetrahedron of higher order"},
      {four + nodes_4 + "$Elements\n1 2 1 2\n2 1 2 1\n1 1 2 3\n$EndElements\n", 17, "1 elements in the blocks, but $Elements says 2"},
  };
  for (const auto& bad : table) expect_refused("a.msh", bad.text, bad.line, bad.words);
}

TEST(Gmsh, HigherOrderInABinaryFile) {
  std::string bytes = dmoscope::testing::gmsh_4_binary(false);
  std::string tetrahedra, second_order;
  dmoscope::testing::put<std::int32_t>(tetrahedra, false, {3, 1, 4});
  dmoscope::testing::put<std::int32_t>(second_order, false, {3, 1, 11});
  bytes.replace(bytes.rfind(tetrahedra), tetrahedra.size(), second_order);
  expect_refused("a.msh", bytes, 0, "a tetrahedron of higher order (element type 11)");
}

TEST(Gmsh, EveryBeginning) {
  for (const std::string& bytes : {dmoscope::testing::gmsh_2_ascii(), dmoscope::testing::gmsh_4_ascii(),
                                   dmoscope::testing::gmsh_2_binary(true), dmoscope::testing::gmsh_4_binary(false)}) {
    expect_truncation_safe("a.msh", bytes);
  }
}

TEST(Gmsh, NumbersFarApart) {
  const Mesh mesh = read_bytes("a.msh",
                               "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n9000000000 0 0 0\n7 1 0 0\n-3 0 1 0\n$EndNodes\n"
                               "$Elements\n1\n1 2 0 -3 9000000000 7\n$EndElements\n");
  EXPECT_THAT(list(mesh.elements.all_corners()), ElementsAre(2, 0, 1));
}

}  // namespace
}  // namespace dmoscope::test
