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

void expect_the_2dm_mesh(const Mesh& mesh) {
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "a square");
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 0, 2, 3, 1, 4, 5, 2));
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "elevation");
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(-10.5, -11, 12, 13, 0, 0));
}

TEST(Sms2dm, MaterialsAndNodestrings) {
  const Mesh mesh = read_bytes("a.2dm", testing::sms_2dm());
  expect_the_2dm_mesh(mesh);
  ASSERT_EQ(mesh.groups.size(), 6U);
  EXPECT_EQ(mesh.groups[0].name, "material 1");
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 2));
  EXPECT_EQ(mesh.groups[1].name, "reed bed");
  EXPECT_EQ(mesh.groups[1].code, 2);
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(1));
  EXPECT_EQ(mesh.groups[2].dimension, 1);  // E2L
  EXPECT_THAT(mesh.groups[2].members, ElementsAre(0, 1));
  EXPECT_EQ(mesh.groups[3].name, "sea side");
  EXPECT_EQ(mesh.groups[3].code, 3);
  EXPECT_THAT(mesh.groups[3].members, ElementsAre(0, 1, 1, 4));
  EXPECT_EQ(mesh.groups[4].name, "nodestring 1");
  EXPECT_THAT(mesh.groups[4].members, ElementsAre(3, 2, 2, 5));
  EXPECT_EQ(mesh.groups[5].dimension, 0);
  EXPECT_THAT(mesh.groups[5].members, ElementsAre(5));
}

TEST(Sms2dm, WrittenAgainOnlyWhatMovedChanges) { expect_patched("a.2dm", testing::sms_2dm(), false); }

TEST(Sms2dm, MadeAnewItHoldsTheSame) {
  Mesh mesh = read_bytes("a.2dm", testing::sms_2dm());
  mesh.source.reset();
  mesh.groups[3].members = {0, 1, 1, 4, 3, 2};  // in two pieces
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.2dm", written("b.2dm", mesh, mesh.positions, &notes));
  EXPECT_THAT(notes, ElementsAre());
  expect_the_2dm_mesh(again);
  ASSERT_EQ(again.groups.size(), mesh.groups.size());
  for (const Group& group : mesh.groups) {
    const auto same = [&](const Group& other) { return other.dimension == group.dimension && other.members == group.members; };
    EXPECT_TRUE(std::ranges::any_of(again.groups, same)) << group.name;
  }
}

TEST(Sms2dm, DepthCountsDownwards) {
  const std::string depth = "grid\n1 3\n1 0 0 10.5\n2 1 0 -2\n3 0 1 0\n1 3 1 2 3\n0\n0\n0\n0\n";
  const Mesh mesh = read_bytes("a.14", depth);
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.2dm", written("b.2dm", mesh, mesh.positions, &notes));
  EXPECT_THAT(notes, ElementsAre(HasSubstr("\"depth\" was written as the elevation, with its sign turned")));
  EXPECT_THAT(again.fields[0].values, ElementsAre(-10.5, 2, 0));
  const Mesh back = read_bytes("c.14", written("c.14", again, again.positions, &notes));
  EXPECT_THAT(notes, ::testing::Contains(HasSubstr("\"elevation\" was written as the depth, with its sign turned")));
  EXPECT_EQ(back.fields[0].values, mesh.fields[0].values);
}

TEST(Sms2dm, Refused) {
  const std::string nodes = "MESH2D\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\n";
  struct Bad {
    std::string text;
    std::size_t line;
    std::string words;
  };
  const std::array<Bad, 12> table{{
      {"ND 1 0 0 0\n", 1, "begins with MESH2D"},
      {nodes + "E6T 1 1 2 3 1 2 3 1\n", 5, "E6T is an element of higher order"},
      {nodes + "E8H 1 1 2 3 1 2 3 1 1\n", 5, "E8H is a volume element"},
      {nodes + "E3T 1 1 2 4 1\n", 5, "element 1 names node 4, which the file does not have"},
      {nodes + "E3T 1 1 2\n", 5, "expected the number of a node, but the line ends"},
      {nodes + "E3T 1 1 2 3 1\nE3T 1 1 2 3 1\n", 6, "element 1 a second time"},
      {nodes + "ND 2 1 1 1\n", 5, "node 2 a second time"},
      {nodes + "ND 4 1 1 1 1\n", 5, "there is more on this line"},
      {nodes + "ND 4 1 1\n", 5, "expected elevation of a node, but the line ends"},
      {nodes + "E3T 1 1 2 3\nNS 1 2\nND 4 1 1 0\n", 6, "a nodestring without an end"},
      {nodes + "E3T 1 1 2 3\nNS 1 -7\n", 6, "a nodestring names node 7"},
      {"MESH2D\nNUM_MATERIALS_PER_ELEM 1\nE3T 1 1 2 3 1 2\n", 3, "an element has 1 materials"},
  }};
  for (const auto& bad : table) expect_refused("a.2dm", bad.text, bad.line, bad.words);
}

}  // namespace
}  // namespace dmoscope::test
