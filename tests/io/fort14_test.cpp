#include <array>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kGrid =
    " my grid  ! remark\n"
    "2 4 ! NE NP\n"
    "1 0.0 0.0 10.5 ! first\n"
    "2 1.0D0 0.0 -3\n"
    "3 1.0 1.0 0\n"
    "4 0.0 1.0 7\n"
    "1 3 1 2 3 ! element\n"
    "2 3 1 3 4\n";
const std::string kOpen = "1 = open\n2\n2 0 remark\n1 ! v\n2\n";
const std::string kLand = "2 ! land\n5\n3 20 = n\n2\n3\n4\n2 24\n4 1 1.5 1.0 1.0\n1 4 1.5 1 1\n";

TEST(Fort14, GridDepthAndBoundaries) {
  const Mesh mesh = read_bytes("a.14", kGrid + kOpen + kLand);
  EXPECT_EQ(mesh.title, "my grid  ! remark");
  ASSERT_EQ(mesh.positions.size(), 4U);
  EXPECT_TRUE(same_bits(mesh.positions[1], {1, 0, 0}));
  ASSERT_EQ(mesh.elements.size(), 2U);
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()), ElementsAre(0, 1, 2, 0, 2, 3));
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "depth");
  EXPECT_EQ(mesh.fields[0].role, "depth");
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(10.5, -3, 0, 7));
  ASSERT_EQ(mesh.groups.size(), 4U);
  EXPECT_EQ(mesh.groups[0].role, "open boundary");
  EXPECT_EQ(mesh.groups[0].code, 0);
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1));
  EXPECT_EQ(mesh.groups[1].role, "land boundary");
  EXPECT_EQ(mesh.groups[1].code, 20);
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(1, 2, 3));
  EXPECT_EQ(mesh.groups[2].code, 24);
  EXPECT_THAT(mesh.groups[2].members, ElementsAre(3, 0));
  EXPECT_EQ(mesh.groups[3].name, "land boundary 2, far side");
  EXPECT_THAT(mesh.groups[3].members, ElementsAre(0, 3));
}

/// Grids of SCHISM: the grammar of fort.14, in longitude and latitude, and land boundaries that are islands (1) or not (0).
TEST(Fort14, GridsOfSchism) {
  const std::string grid =
      "hgrid of a lagoon\n2 5\n1 -70.25 43.5 10.5\n2 -70.0 43.5 -3\n3 -70.0 43.75 0\n4 -70.25 43.75 7\n5 -69.9 43.6 1\n"
      "1 4 1 2 3 4\n2 3 2 5 3\n1 = Number of open boundaries\n2 = Total number of open boundary nodes\n2 = Number of nodes for open "
      "boundary 1\n1\n4\n1 = number of land boundaries\n2 = Total number of land boundary nodes\n2 0 = Number of nodes for land boundary "
      "1\n2\n5\n";
  for (const char* name : {"hgrid.gr3", "hgrid.ll", "HGRID.GR3"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_bytes(name, grid);
    ASSERT_EQ(mesh.elements.size(), 2U);
    EXPECT_EQ(mesh.elements.kind(0), ElementKind::Quadrilateral);
    EXPECT_EQ(mesh.positions[4], (Vec3{-69.9, 43.6, 0}));
    EXPECT_THAT(mesh.fields.at(0).values, ElementsAre(10.5, -3, 0, 7, 1));
    ASSERT_EQ(mesh.groups.size(), 2U);
    EXPECT_THAT(mesh.groups[1].members, ElementsAre(1, 4));
    EXPECT_EQ(written(name, mesh), grid);
    std::vector<Vec3> moved = mesh.positions;
    moved[4].y = 43.625;
    std::string wanted = grid;
    wanted.replace(wanted.find("43.6 1"), 4, "43.625");
    EXPECT_EQ(written(name, mesh, moved), wanted);
  }
  expect_refused("hgrid.gr3", "x\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 4\n", 6, "vertex index 4");
}

TEST(Fort14, EndsWhereItMay) {
  EXPECT_EQ(read_bytes("a.14", kGrid).groups.size(), 0U);
  EXPECT_EQ(read_bytes("a.14", kGrid + "0\n").groups.size(), 0U);
  EXPECT_EQ(read_bytes("a.14", kGrid + "0\n0\n").groups.size(), 0U);
  EXPECT_EQ(read_bytes("a.14", kGrid + kOpen).groups.size(), 1U);
  EXPECT_EQ(read_bytes("a.grd", kGrid + kOpen + kLand).groups.size(), 4U);
  const Mesh more = read_bytes("a.14", kGrid + kOpen + kLand + "0 ! generic\nanything\n");
  EXPECT_THAT(more.source->notes(), ElementsAre(HasSubstr("goes on")));
}

TEST(Fort14, TypeOfAnOpenBoundary) {
  EXPECT_EQ(read_bytes("a.14", kGrid + "1\n1\n1 7\n2\n").groups[0].code, 7);
  EXPECT_EQ(read_bytes("a.14", kGrid + "1\n1\n1 = 7\n2\n").groups[0].code, 0);
  EXPECT_EQ(read_bytes("a.14", kGrid + "1\n1\n1\n2\n").groups[0].code, 0);
}

TEST(Fort14, ColumnsOfWeirs) {
  for (const char* land : {"3\n1 5.0 1.0", "13\n1 5.0 1.0 ! c", "23\n1 5.0 1.0", "4\n1 2 5.0 1.0 1.0", "24\n1 2 5 1 1",
                           "5\n1 2 5 1 1 0.5 0.1", "25\n1 2 5 1 1 0.5 0.1 2.0"}) {
    const Mesh mesh = read_bytes("a.14", kGrid + "0\n0\n1\n1\n1 " + land + "\n");
    EXPECT_THAT(mesh.groups.at(0).members, ElementsAre(0)) << land;
    const bool two_banks = std::string(land).find("\n1 2 ") != std::string::npos;
    ASSERT_EQ(mesh.groups.size(), two_banks ? 2U : 1U) << land;
    if (!two_banks) continue;
    EXPECT_EQ(mesh.groups[1].name, "land boundary 1, far side");
    EXPECT_EQ(mesh.groups[1].code, mesh.groups[0].code);
    EXPECT_THAT(mesh.groups[1].members, ElementsAre(1)) << land;
  }
}

TEST(Fort14, VerticesOfAnyNumber) {
  const std::string text = "t\n1 4\n40 0 0 1\n7 1 0 2\n-3 1 1 3\n1000000007 0 1 4\n9 4 40 7 -3 1000000007\n1\n2\n2\n-3\n7\n";
  const Mesh mesh = read_bytes("a.14", text);
  EXPECT_EQ(mesh.elements.kind(0), ElementKind::Quadrilateral);
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(mesh.groups.at(0).members, ElementsAre(2, 1));
  expect_patched("a.14", text, false);
  expect_refused("a.14", "t\n1 3\n5 0 0 0\n6 1 0 0\n7 0 1 0\n1 3 5 6 8\n", 6, "vertex index 8: no vertex has this number");
  expect_refused("a.14", "t\n1 3\n5 0 0 0\n\n6 1 0 0\n5 0 1 0\n1 3 5 6 5\n", 6, "the number of one before it");
}

TEST(Fort14, EveryByteButTheMovedStays) {
  expect_patched("a.14", kGrid + kOpen + kLand + "0 ! generic\nanything, at, all\n", false);
  std::string crlf;
  for (const char c : kGrid + kOpen) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  expect_patched("a.14", crlf, false);
  expect_patched("a.14", "t\n1,3\n1,0.0,0.0,1.0\n2, 1.0 ,0.0, 1.0\n3 0 1 1\n1,3,1,2,3", false);
}

TEST(Fort14, Malformed) {
  const struct {
    std::string text;
    std::size_t line;
    const char* words;
  } table[] = {
      {"title\n", 1, "the file ends where number of elements"},
      {"title\nx\n", 2, "expected number of elements"},
      {"title\n1\n1 0 0 0\n", 2, "number of vertices, but the line ends"},
      {"title\n1 999999999\n1 0 0 0\n", 2, "bytes of the file are left"},
      {"title\n-1 3\n", 2, "negative"},
      {"t\n1 3\n1 0 0 0\n2 1 0\n3 0 1 0\n1 3 1 2 3\n", 4, "depth, but the line ends"},
      {"t\n1 3\n1 0 0 0\n2 1 nan 0\n3 0 1 0\n1 3 1 2 3\n", 4, "y coordinate is not a finite number"},
      {"t\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 0\n", 6, "vertex index 0 out of range (the file has 3 vertices)"},
      {"t\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 4\n", 6, "vertex index 4 out of range (the file has 3 vertices)"},
      {"t\n1 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 6 1 2 3\n", 6, "element with 6 corners"},
      {"t\n2 3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n1 3 1 2 3\n", 6, "the file ends"},
      {kGrid + "many\n", 9, "number of open boundaries"},
      {kGrid + "1\n2\n2\n1\n", 12, "the file ends"},
      {kGrid + "1\n2\n2\n1\n9\n", 13, "vertex index 9 out of range (the file has 4 vertices)"},
      {kGrid + "0\n0\n1\n1\n1 x = no type\n1\n", 13, "IBTYPE"},
      {kGrid + "0\n0\n1\n1\n1 24\n1 9 1 1 1\n", 14, "vertex index 9 out of range"},
      {kGrid + "0\n0\n1\n1\n1 24\n1 2 1 1\n", 14, "height or coefficient of a weir, but the line ends"},
      {kGrid + "0\n0\n1\n1\n999999 0\n1\n", 13, "bytes of the file are left"},
  };
  for (const auto& bad : table) expect_refused("a.14", bad.text, bad.line, bad.words);
}

TEST(Fort14, ALandBoundaryMayHaveARemarkInThePlaceOfItsType) {
  const Mesh mesh = read_bytes("a.gr3", kGrid + "0 = open\n0\n1 = land\n2 = nodes\n2 = Number of nodes for land boundary 1\n2\n3\n");
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_EQ(mesh.groups[0].code, 0);
  EXPECT_EQ(mesh.groups[0].members, (std::vector<Index>{1, 2}));
  EXPECT_EQ(read_bytes("b.gr3", kGrid + "0\n0\n1\n2\n2 = nodes of island boundary 1\n2\n3\n").groups[0].code, 1);
}

TEST(Fort14, EveryBeginning) { expect_truncation_safe("a.14", kGrid + kOpen + kLand); }

TEST(Fort14, MadeAnewFromAnotherSource) {
  Mesh mesh = read_bytes("a.14", kGrid + kOpen + "1\n3\n3 20\n2\n3\n4\n");
  mesh.source.reset();
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.14", written("b.14", mesh, mesh.positions, &notes));
  EXPECT_TRUE(notes.empty());
  expect_same_positions(mesh.positions, again.positions);
  expect_same_elements(mesh, again);
  EXPECT_EQ(again.title, mesh.title);
  EXPECT_EQ(again.fields.at(0).values, mesh.fields.at(0).values);
  ASSERT_EQ(again.groups.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.groups[i].role, mesh.groups[i].role);
    EXPECT_EQ(again.groups[i].code, mesh.groups[i].code);
    EXPECT_EQ(again.groups[i].members, mesh.groups[i].members);
  }

  mesh.groups[1].code = 24;  // a weir, whose columns are missing
  mesh.fields[0].name = "h";
  mesh.fields.push_back({.name = "id", .on = Field::On::Elements, .components = 1, .type = "int", .role = "", .values = {1, 2}});
  (void)written("b.14", mesh, mesh.positions, &notes);
  EXPECT_THAT(
      notes, testing::UnorderedElementsAre(HasSubstr("\"h\" was written as the depth"), HasSubstr("\"id\""), HasSubstr("land boundary 1")));
}

TEST(Fort14, RealFiles) {
  const auto files = shared_meshes(".14");
  if (files.empty()) GTEST_SKIP() << "the shared meshes are not here";
  Progress progress;
  const std::map<std::string, std::array<std::size_t, 2>> counts{{"admesh_Lake_Erie_mesh_refined.14", {5095, 9688}},
                                                                 {"bahamas.14", {926, 1696}},
                                                                 {"east.14", {10147, 18578}},
                                                                 {"east3k.14", {2068, 3420}}};
  for (const auto& file : files) {
    if (file.filename() == "admesh_Mixed_Test.14") {
      expect_refused("a.14", get(file), 20, "vertex index 0 out of range (the file has 13 vertices)");
      continue;
    }
    expect_patched("a.14", get(file), false);
    const auto known = counts.find(file.filename());
    if (known == counts.end()) continue;
    const Mesh mesh = read_mesh(file, progress);
    EXPECT_EQ(mesh.positions.size(), known->second[0]);
    EXPECT_EQ(mesh.elements.size(), known->second[1]);
    if (file.filename() == "bahamas.14") {
      ASSERT_GE(mesh.groups.size(), 1U);
      EXPECT_EQ(mesh.groups[0].members.size(), 39U);
      EXPECT_EQ(mesh.groups[0].members[0], 925U);
    }
  }
}

}  // namespace
}  // namespace dmoscope::test
