#include <algorithm>
#include <array>
#include <string>
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

void expect_the_solids(const Mesh& mesh) {
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "two solids");
  EXPECT_THAT(mesh.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1.5, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 1},
                                          Vec3{1, 1, 1}, Vec3{0, 1, 1}, Vec3{.5, .5, 2}));
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8));
  ASSERT_GE(mesh.groups.size(), 4U);
  const auto find = [&](std::string_view name) { return std::ranges::find(mesh.groups, name, &Group::name); };
  ASSERT_NE(find("rock"), mesh.groups.end());
  EXPECT_EQ(find("rock")->code, 7);
  EXPECT_THAT(find("rock")->members, ElementsAre(0, 1));
  ASSERT_NE(find("property 9"), mesh.groups.end());
  EXPECT_THAT(std::vector<Index>(find("property 9")->faces.all_corners().begin(), find("property 9")->faces.all_corners().end()),
              ElementsAre(0, 3, 2, 1));
  ASSERT_NE(find("property 3"), mesh.groups.end());
  EXPECT_THAT(find("property 3")->members, ElementsAre(0, 1));
  ASSERT_NE(find("PLOTEL"), mesh.groups.end());
  EXPECT_THAT(find("PLOTEL")->members, ElementsAre(2, 3));
}

TEST(Nastran, FreeSmallAndLargeFields) { expect_the_solids(read_bytes("a.bdf", testing::nastran_volume())); }

TEST(Nastran, BulkDataAlone) {
  for (const char* name : {"a.nas", "a.dat", "a.unknown"}) {
    const Mesh mesh = read_bytes(name, testing::nastran_planar());
    expect_consistent(mesh);
    EXPECT_EQ(mesh.positions[5], (Vec3{2, 1, 0.25}));
    EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
                ElementsAre(0, 1, 2, 0, 2, 3, 1, 4, 5, 2));
    ASSERT_EQ(mesh.groups.size(), 2U);
    EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1));
    EXPECT_THAT(mesh.groups[1].members, ElementsAre(0, 1));
  }
}

/// Real numbers by the Quick Reference Guide: 7.0, .7E1, 0.7+1, 70.-1.
TEST(Nastran, NumbersAsNastranWritesThem) {
  const std::string head = "GRID,1,,7.0,.7E1,0.7+1\nGRID,2,,70.-1,-.7+1,7.D0\nGRID           3            -7.0+7.00000    7.\n";
  const Mesh mesh = read_bytes("a.bdf", head + "CTRIA3,1,1,1,2,3\n");
  EXPECT_THAT(mesh.positions, ElementsAre(Vec3{7, 7, 7}, Vec3{7, -7, 7}, Vec3{-7, 7, 7}));
}

TEST(Nastran, WrittenAgainOnlyWhatMovedChanges) {
  for (const std::string& bytes : {testing::nastran_volume(), testing::nastran_planar()}) {
    const Mesh mesh = read_bytes("a.bdf", bytes);
    EXPECT_EQ(written("a.bdf", mesh), bytes);
    std::vector<std::string> notes;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      std::vector<Vec3> positions = mesh.positions;
      positions[v] = {-0.125, positions[v].y, 1234567.25};
      const std::string patched = written("a.bdf", mesh, positions, &notes);
      EXPECT_THAT(notes, ElementsAre());
      const Mesh again = read_bytes("a.bdf", patched);
      expect_same_positions(positions, again.positions);
      expect_same_elements(mesh, again);
      EXPECT_EQ(again.groups.size(), mesh.groups.size());
      // The lines before and after the card are unchanged.
      const std::size_t place = static_cast<std::size_t>(mesh.source->place(v));
      EXPECT_EQ(patched.substr(0, place), bytes.substr(0, place));
      const std::size_t next =
          v + 1 < mesh.positions.size() ? static_cast<std::size_t>(mesh.source->place(v + 1)) : bytes.find("\nC", place) + 1;
      EXPECT_TRUE(patched.ends_with(bytes.substr(next)));
    }
  }
  // The other fields of the card are kept.
  const Mesh mesh = read_bytes("a.bdf", testing::nastran_volume());
  std::vector<Vec3> positions = mesh.positions;
  positions[1].x = 0.25;
  EXPECT_THAT(written("a.bdf", mesh, positions), HasSubstr("\nGRID*                  2               0            0.25              0.\n"
                                                           "*                     0.               0             123\n"));
}

TEST(Nastran, NumbersFitTheirField) {
  Mesh mesh = read_bytes("a.bdf", testing::nastran_planar());
  std::vector<Vec3> positions = mesh.positions;
  positions[0] = {-1.0 / 3.0, 1e-10 / 3.0, 0.0};
  std::vector<std::string> notes;
  const std::string patched = written("a.bdf", mesh, positions, &notes);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("2 coordinates were rounded to the 16 characters")));
  EXPECT_THAT(patched, HasSubstr("-.333333333333333.33333333333-11\r\n"));
  mesh.source.reset();
  notes.clear();
  EXPECT_THAT(written("b.bdf", mesh, positions, &notes), HasSubstr("-.333333333333333.33333333333-11\n"));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("2 coordinates were rounded to the 16 characters")));
}

TEST(Nastran, MadeAnewItHoldsTheSame) {
  Mesh mesh = read_bytes("a.bdf", testing::nastran_volume());
  mesh.source.reset();
  std::vector<std::string> notes;
  expect_the_solids(read_bytes("b.bdf", written("b.bdf", mesh, mesh.positions, &notes)));
  EXPECT_THAT(notes, ElementsAre());
}

TEST(Nastran, Refused) {
  const std::string nodes = "GRID,1\nGRID,2,,1.\nGRID,3,,,1.\n";
  struct Bad {
    std::string text;
    std::size_t line;
    std::string words;
  };
  const std::array<Bad, 14> table{{
      {nodes + "CTRIA6,1,1,1,2,3,1,2,3\n", 4, "CTRIA6 is an element of higher order"},
      {nodes + "CTETRA,1,1,1,2,3,1,2,3\n,1,2,3,1\n", 4, "CTETRA 1 has more than 4 nodes"},
      {nodes + "CTRIA3,1,1,1,2\n", 4, "a CTRIA3 without the number of a node"},
      {nodes + "CTRIA3,1,1,1,2,4\n", 4, "element 1 names node 4, which the file does not have"},
      {nodes + "CTRIA3,1,1,1,2,3\nCQUAD4,1,1,1,2,3,1\n", 5, "element 1 a second time"},
      {nodes + "GRID,2\n", 4, "node 2 a second time"},
      {"GRID,1,3,0.,0.,0.\n", 1, "node 1 names a coordinate system"},
      {"GRDSET,,3\n", 1, "GRDSET names a coordinate system"},
      {"GRID,1,,0.,x\n", 1, "expected y coordinate, got \"x\""},
      {"GRID,1.5\n", 1, "expected the number of a node, got \"1.5\""},
      {"GRID,1\nINCLUDE 'a.bdf'\n", 2, "put all into one"},
      {"+A      1\n", 1, "there is none before it"},
      {"BEGIN BULK\nGRID,1\n=,*(1)\n", 3, "expected a card such as GRID"},
      {"PSOLID,1\n", 0, "has no GRID card"},
  }};
  for (const auto& bad : table) expect_refused("a.bdf", bad.text, bad.line, bad.words);
}

}  // namespace
}  // namespace dmoscope::test
