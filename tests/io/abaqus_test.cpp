#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/text_writer.h"
#include "core/mesh/faces.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Group* group(const Mesh& mesh, std::string_view name, std::string_view role, int dimension = -1) {
  for (const Group& g : mesh.groups) {
    if (g.name == name && g.role == role && (dimension < 0 || g.dimension == dimension)) return &g;
  }
  return nullptr;
}

std::vector<Index> faces(const Group& group) { return {group.faces.all_corners().begin(), group.faces.all_corners().end()}; }

TEST(Abaqus, SolidsWithTheirSets) {
  const Mesh mesh = read_bytes("a.inp", testing::abaqus_volume());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "two solids");
  ASSERT_EQ(mesh.positions.size(), 9U);
  EXPECT_EQ(mesh.positions[2], (Vec3{1, 1.5, 0}));
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8));
  ASSERT_NE(group(mesh, "All", "node set"), nullptr);
  EXPECT_EQ(group(mesh, "All", "node set")->members.size(), 9U);
  EXPECT_THAT(group(mesh, "Tip", "node set")->members, ElementsAre(8, 2));
  EXPECT_THAT(group(mesh, "Root", "node set")->members, ElementsAre(0, 1));
  EXPECT_THAT(group(mesh, "Box", "element set")->members, ElementsAre(0));
  EXPECT_THAT(faces(*group(mesh, "skin", "element set")), ElementsAre(0, 3, 2, 1));
  EXPECT_THAT(group(mesh, "More", "element set")->members, ElementsAre(0, 1));
  EXPECT_THAT(group(mesh, "MASS", "element type")->members, ElementsAre(8));
  // Sides, seen from outside: S3 of a brick has its nodes 1, 5, 6, 2, S2 of a pyramid 1, 5, 2.
  EXPECT_THAT(faces(*group(mesh, "Top", "surface")), ElementsAre(0, 1, 5, 4, 4, 5, 8));
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains("*MATERIAL"));
}

/// CalculiX' elements of fluids have the nodes of those of solids.
TEST(Abaqus, FluidElementsAreSolids) {
  const std::string nodes = "*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n";
  const Mesh mesh = read_bytes("a.inp", nodes + "*ELEMENT, TYPE=F3D8, ELSET=Eall\n1,1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=F3D6\n2,1,2,4,5,6,8\n" +
                                            "*ELEMENT, TYPE=F3D4\n3,1,2,4,5\n");
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Tetrahedron));
}

/// Nodes of the faces of an element, from Abaqus' manual.
TEST(Abaqus, FacesAreNumberedAsInTheManual) {
  struct Solid {
    std::string type;
    std::vector<std::vector<Index>> faces;  // nodes from 1
  };
  const std::array<Solid, 4> solids{Solid{"C3D4", {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}},
                                    Solid{"C3D5", {{1, 2, 3, 4}, {1, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}}},
                                    Solid{"C3D6", {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}}},
                                    Solid{"C3D8", {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}}};
  for (const Solid& solid : solids) {
    std::string nodes = "*NODE\n", element = "*ELEMENT, TYPE=" + solid.type + "\n1", surfaces;
    for (int n = 1; n <= solid.type.back() - '0'; ++n) {
      nodes += std::to_string(n) + ", 0, 0, " + std::to_string(n) + "\n";
      element += ", " + std::to_string(n);
    }
    for (std::size_t f = 1; f <= solid.faces.size(); ++f) {
      surfaces += "*SURFACE, NAME=F" + std::to_string(f) + "\n1, S" + std::to_string(f) + "\n";
    }
    const Mesh mesh = read_bytes("a.inp", nodes + element + "\n" + surfaces);
    ASSERT_EQ(mesh.groups.size(), solid.faces.size()) << solid.type;
    for (std::size_t f = 0; f < solid.faces.size(); ++f) {
      std::vector<Index> found = faces(mesh.groups[f]);
      std::vector<Index> expected = solid.faces[f];
      for (Index& v : expected) --v;
      std::ranges::reverse(expected);  // the manual looks from inside
      const auto first = std::ranges::find(found, expected.front());
      ASSERT_NE(first, found.end()) << solid.type << " S" << f + 1;
      std::rotate(found.begin(), first, found.end());
      EXPECT_EQ(found, expected) << solid.type << " S" << f + 1;
    }
  }
}

TEST(Abaqus, PlanarElementsAndTheirEdges) {
  const Mesh mesh = read_bytes("a.inp", testing::abaqus_planar());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.source->layout().components, 2);
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 0, 2, 3, 1, 4, 5, 2));
  EXPECT_THAT(group(mesh, "a set", "element set")->members, ElementsAre(0, 1));
  EXPECT_THAT(group(mesh, "right", "element set")->members, ElementsAre(2));
  EXPECT_THAT(group(mesh, "edge", "surface")->members, ElementsAre(0, 1, 4, 5));
  EXPECT_THAT(group(mesh, "n", "surface")->members, ElementsAre(4));
  EXPECT_THAT(group(mesh, "T2D2", "element type")->members, ElementsAre(0, 1));
}

TEST(Abaqus, WrittenAgainOnlyWhatMovedChanges) {
  for (const std::string& bytes : {testing::abaqus_volume(), testing::abaqus_planar()}) {
    const Mesh mesh = read_bytes("a.inp", bytes);
    EXPECT_EQ(written("a.inp", mesh), bytes);
    std::vector<Vec3> positions = mesh.positions;
    positions[1].x = 0.1;
    positions[3].y = -1.0 / 3.0;
    std::vector<std::string> notes;
    const std::string patched = written("a.inp", mesh, positions, &notes);
    EXPECT_THAT(notes, ElementsAre());
    expect_same_positions(positions, read_bytes("a.inp", patched).positions);
    EXPECT_EQ(std::ranges::count(patched, ','), std::ranges::count(bytes, ','));
    EXPECT_THAT(patched, HasSubstr("-0.3333333333333333"));
  }
}

/// Abaqus has 20 characters for a number; CalculiX cuts longer ones, exponent and all.
TEST(Abaqus, NumbersFitTheirField) {
  Mesh mesh = read_bytes("a.inp", testing::abaqus_volume());
  std::vector<Vec3> positions = mesh.positions;
  positions[0].x = -1.2345678901234567e-200;
  std::vector<std::string> notes;
  const std::string patched = written("a.inp", mesh, positions, &notes);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 moved coordinates were rounded to the 20 characters")));
  EXPECT_THAT(patched, HasSubstr("1, -1.234567890123e-200, 0., 0.\n"));
  mesh.source.reset();
  notes.clear();
  EXPECT_THAT(written("b.inp", mesh, positions, &notes), HasSubstr("1, -1.234567890123e-200, 0., 0.\n"));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("1 coordinates were rounded to the 20 characters")));
}

TEST(FieldNumber, FitsAndIsAsNearAsItCanBe) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 20000; ++i) {
    const auto value = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
    if (!std::isfinite(value)) continue;
    for (const std::size_t width : {16U, 20U}) {
      for (const ExponentStyle style : {ExponentStyle::Letter, ExponentStyle::Sign}) {
        const FieldNumber number = number_in_field(value, width, style);
        ASSERT_LE(number.text.size(), width);
        ASSERT_NE(number.text.find('.'), std::string::npos);
        ASSERT_NEAR(number.value / value, 1.0, 1e-8);
      }
    }
  }
  EXPECT_EQ(number_in_field(0.1, 16, ExponentStyle::Sign).text, "0.1");
  EXPECT_EQ(number_in_field(-0.0, 16, ExponentStyle::Sign).text, "-0.");
  EXPECT_EQ(number_in_field(100.0, 16, ExponentStyle::Sign).text, "100.");
  EXPECT_EQ(number_in_field(1e30, 16, ExponentStyle::Sign).text, "1.+30");
  EXPECT_EQ(number_in_field(-1.0 / 3.0, 16, ExponentStyle::Sign).text, "-.33333333333333");
  EXPECT_EQ(number_in_field(-0.012345678901234567, 20, ExponentStyle::Letter).text, "-.012345678901234567");
}

TEST(Abaqus, MadeAnewItHoldsTheSame) {
  for (const std::string& bytes : {testing::abaqus_volume(), testing::abaqus_planar()}) {
    Mesh mesh = read_bytes("a.inp", bytes);
    mesh.source.reset();
    std::vector<std::string> notes;
    const Mesh again = read_bytes("b.inp", written("b.inp", mesh, mesh.positions, &notes));
    expect_same_positions(mesh.positions, again.positions);
    expect_same_elements(mesh, again);
    for (const Group& g : mesh.groups) {
      const std::string name = g.name == "a set" ? "a_set" : g.name;
      const auto same = [&](const Group& other) {
        return other.name == name && other.members == g.members && std::ranges::equal(other.faces.all_corners(), g.faces.all_corners());
      };
      EXPECT_TRUE(std::ranges::any_of(again.groups, same)) << g.name;
    }
  }
}

TEST(Abaqus, Refused) {
  const std::string nodes = "*NODE\n1,0,0\n2,1,0\n3,0,1\n";
  struct Bad {
    std::string text;
    std::size_t line;
    std::string words;
  };
  const std::array<Bad, 17> table{{
      {nodes + "*ELEMENT, TYPE=CPS6\n1,1,2,3,1,2,3\n", 5, "only linear elements"},
      {nodes + "*ELEMENT, TYPE=C3D10M\n", 5, "\"C3D10M\" have nodes beyond their corners"},
      {nodes + "*ELEMENT, TYPE=S3\n1,1,2\n*NSET,NSET=A\n1\n", 6, "element 1 has 2 nodes, but a \"S3\" has 3"},
      {nodes + "*ELEMENT, TYPE=S3\n1,1,2,3,3\n", 6, "element 1 has 4 nodes"},
      {nodes + "*ELEMENT, TYPE=S3\n1,1,2,9\n", 6, "element 1 names node 9, which the file does not have"},
      {nodes + "*ELEMENT, TYPE=S3\n1,1,2,3\n1,1,2,3\n", 7, "element 1 a second time"},
      {nodes + "3,1,1\n", 5, "node 3 a second time"},
      {"*NODE\n1,0\n", 2, "node 1 has no y coordinate"},
      {"*NODE\n1,0,x\n", 2, "expected y coordinate, got \"x\""},
      {"*NODE\n1,,0\n", 2, "a coordinate of node 1 is left out"},
      {"*NODE, SYSTEM=C\n", 1, "only rectangular coordinates"},
      {"*HEADING\n*INCLUDE, INPUT=a\n", 2, "put all into one"},
      {"*NODE\n1,0,0\n*NGEN\n", 3, "*NGEN: only nodes and elements that the file lists"},
      {nodes + "*ELSET, ELSET=A\nB\n", 6, "there is no set \"B\" before this"},
      {"*PART\n" + nodes + "*END PART\n*PART\n*NODE\n1,0,0\n", 8, "second *PART"},
      {"*PART\n" + nodes + "*END PART\n*INSTANCE\n*END INSTANCE\n*INSTANCE\n", 9, "second *INSTANCE"},
  }};
  for (const auto& bad : table) expect_refused("a.inp", bad.text, bad.line, bad.words);
}

/// A few bytes that name every element many times must not take much memory.
TEST(Abaqus, SetsOfEverythingOverAndOver) {
  std::string text = "*NODE\n1,0,0\n2,1,0\n3,0,1\n*ELEMENT, TYPE=S3\n";
  for (int e = 1; e <= 2000; ++e) text += std::to_string(e) + ",1,2,3\n";
  for (int s = 0; s < 3000; ++s) text += "*ELSET,ELSET=S" + std::to_string(s) + ",GENERATE\n1,2000000000\n";
  const Mesh mesh = read_bytes("a.inp", text);
  std::size_t members = 0;
  for (const Group& g : mesh.groups) members += g.members.size();
  EXPECT_LT(members, 32 * text.size());
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains(HasSubstr("far more members")));
}

}  // namespace
}  // namespace dmoscope::test
