#include <algorithm>
#include <array>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string kElements = "NELEM= 2\n9 0 1 2 3 0\n5 1 4 2 1\n";
const std::string kSu2Points = "NPOIN= 5 5\n0 0 0\n1.0 0 1\n1 1 2\n0 1 3\n2 0.5 4\n";
const std::string kMarkers = "NMARK= 2\nMARKER_TAG= wall\nMARKER_ELEMS= 2\n3 0 1\n3 1 4 0\nMARKER_TAG= far\nMARKER_ELEMS= 1\n3 4 2\n";

void expect_the_su2_mesh(const Mesh& mesh) {
  ASSERT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.positions[4], (Vec3{2, 0.5, 0}));
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Quadrilateral, ElementKind::Triangle));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()), ElementsAre(0, 1, 2, 3, 1, 4, 2));
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.groups[0].name, "wall");
  EXPECT_EQ(mesh.groups[0].role, "marker");
  EXPECT_EQ(mesh.groups[0].dimension, 1);
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1, 1, 4));
  EXPECT_EQ(mesh.groups[1].name, "far");
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(4, 2));
}

TEST(Su2, SectionsInAnyOrder) {
  std::array<std::string, 4> sections{"NDIME= 2\n", kElements, kSu2Points, kMarkers};
  std::sort(sections.begin(), sections.end());
  do {
    expect_the_su2_mesh(read_bytes("a.su2", sections[0] + "% comment\n" + sections[1] + sections[2] + "\n" + sections[3]));
  } while (std::next_permutation(sections.begin(), sections.end()));
}

TEST(Su2, KeysWithAndWithoutBlanks) {
  std::string text = "NDIME =2\n" + kElements + kSu2Points + kMarkers;
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"NELEM= ", "NELEM="},
                                 {"NPOIN= ", "  NPOIN\t=\t"},
                                 {"NMARK= ", "NMARK = "},
                                 {"MARKER_TAG= wall", "MARKER_TAG=wall % name"}}) {
    text.replace(text.find(from), from.size(), to);
  }
  expect_the_su2_mesh(read_bytes("a.su2", text));
  expect_patched("a.su2", text, false);
}

TEST(Su2, PlanarPointsMayHaveAThirdCoordinateOfZero) {
  const std::string head = "NDIME=2\nNELEM=1\n5 0 1 2\nNPOIN=3\n";
  for (const std::string points : {"0 0 0 0\n1 0 0 1\n0.5 1 0 2\n", "0 0 0.0\n1 0 0.0\n0.5 1 0e0\n", "0 0 0.000\n1 0 0\n0.5 1 0\n"}) {
    const Mesh mesh = read_bytes("a.su2", head + points);
    EXPECT_EQ(mesh.positions[2], (Vec3{0.5, 1, 0}));
    expect_patched("a.su2", head + points, false);
  }
  expect_refused("a.su2", head + "0 0 0 0\n1 0 0.5 1\n0 1 0 2\n", 6, "z coordinate 0.5 where 0");
  expect_refused("a.su2", head + "0 0 0 0\n1 0 1\n0 1 0 2\n", 6, "z coordinate 1");  // a number for the vertex, and no z
  expect_refused("a.su2", head + "0 0 0\n1 0 0 1\n0 1 2\n", 6, "");
  expect_refused("a.su2", head + "0 0 0 0 0\n1 0 0 0 1\n0 1 0 0 2\n", 5, "");
}

TEST(Su2, IndicesAtTheEndMayBeLeftOut) {
  const Mesh mesh = read_bytes("a.su2", "NDIME=2\nNELEM=1\n5 0 1 2\nNPOIN=3\n0 0\n1 0\n0 1\n");
  EXPECT_EQ(mesh.positions[1], (Vec3{1, 0, 0}));
  EXPECT_TRUE(mesh.groups.empty());
}

void expect_the_marker_low(const Mesh& mesh) {
  ASSERT_EQ(mesh.groups.size(), 1U);
  const Group& low = mesh.groups[0];
  EXPECT_EQ(low.name, "low");
  EXPECT_EQ(low.dimension, 2);
  EXPECT_FALSE(low.of_elements());
  EXPECT_TRUE(low.members.empty());
  ASSERT_EQ(low.faces.size(), 2U);
  EXPECT_EQ(low.faces.kind(0), ElementKind::Quadrilateral);
  EXPECT_EQ(low.faces.kind(1), ElementKind::Triangle);
  EXPECT_THAT(std::vector<Index>(low.vertices().begin(), low.vertices().end()), ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(Su2, Volumes) {
  const std::string text =
      "NDIME= 3\nNELEM= 4\n10 0 1 2 4\n12 0 1 2 3 4 5 6 7\n13 0 1 3 4 5 7\n14 0 1 2 3 4\n"
      "NPOIN= 8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nNMARK= 1\nMARKER_TAG= low\nMARKER_ELEMS= 2\n9 0 1 2 3\n5 4 5 6\n";
  const Mesh mesh = read_bytes("a.su2", text);
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Tetrahedron, ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Pyramid));
  EXPECT_EQ(mesh.positions[6], (Vec3{1, 1, 1}));
  expect_the_marker_low(mesh);
  EXPECT_TRUE(mesh.source->only_in_file().empty());
  expect_patched("a.su2", text, true);
  Mesh anew = mesh;
  anew.source.reset();
  const Mesh again = read_bytes("b.su2", written("b.su2", anew));
  expect_same_elements(mesh, again);
  expect_same_positions(mesh.positions, again.positions);
  expect_the_marker_low(again);
}

TEST(Su2, EdgesAndPointsBesideTheFacesOfAMarkerAreNamed) {
  const std::string text =
      "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
      "MARKER_TAG= m\nMARKER_ELEMS= 3\n3 0 1\n5 0 2 1\n1 3\n";
  const Mesh mesh = read_bytes("a.su2", text);
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_THAT(std::vector<Index>(mesh.groups[0].vertices().begin(), mesh.groups[0].vertices().end()), ElementsAre(0, 2, 1));
  EXPECT_THAT(mesh.source->only_in_file(), ElementsAre("edges of marker \"m\"", "points of marker \"m\""));
  expect_patched("a.su2", text, true);
}

TEST(Su2, WhatWeDoNotKnowIsKept) {
  const std::string text = "NZONE= 1\nNDIME= 2\n" + kElements + kSu2Points +
                           "NMARK= 1\nMARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 2\nSEND_RECV= -1\n1 3 0\n1 4 0\n"
                           "NPERIODIC= 1\nPERIODIC_INDEX= 0\nPERIODIC_CENTER= 0 0 0\nFFD_NBOX= 1\n0.0 1.0\nfree text\n";
  const Mesh mesh = read_bytes("a.su2", text);
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_EQ(mesh.groups[0].dimension, 0);
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(3, 4));
  EXPECT_THAT(mesh.source->only_in_file(), testing::Contains("FFD_NBOX="));
  expect_patched("a.su2", text, false);
}

TEST(Su2, EveryByteButTheMovedStays) {
  const std::string text = "% c\nNDIME= 2\n" + kSu2Points + kElements + kMarkers + "% end";
  expect_patched("a.su2", text, false);
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  expect_patched("a.su2", crlf, false);
}

TEST(Su2, Malformed) {
  const std::string points = "NPOIN= 3\n0 0\n1 0\n0 1\n";
  const std::string good = "NDIME= 2\nNELEM= 1\n5 0 1 2\n" + points;
  const struct {
    std::string text;
    std::size_t line;
    const char* words;
  } table[] = {
      {"NELEM= 1\n5 0 1 2\n" + points, 0, "NDIME= is missing"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\n", 0, "NPOIN= is missing"},
      {"NDIME= 2\nNELEM= 2\n5 0 1 2\n", 2, "NELEM is 2, but only"},
      {"NDIME= 2\nNELEM= 3\n5 0 1 2 0\n5 0 1 2 1\n5 0 1", 5, "the file ends"},
      {"NDIME= 2\nNELEM= 99999999\n5 0 1 2\n", 2, "NELEM is 99999999, but only"},
      {"NDIME= 2\nNELEM= 99999999999999999999\n5 0 1 2\n" + points, 2, "too large"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 4000000000\n0 0\n1 0\n0 1\n", 4, "NPOIN is 4000000000, but only"},
      {"NDIME= 2\nNPOIN= 99999999999999999999\n0 0\nNELEM= 1\n5 0 1 2\n", 2, "too large"},
      {"NDIME= 2\n" + points, 0, "NELEM= is missing"},
      {"NDIME= 4\n" + points, 0, "NDIME= 4"},
      {"NDIME= two\n" + points, 1, "expected NDIME"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 3\n" + points, 3, "vertex index 3 out of range (the file has 3 vertices)"},
      {"NDIME= 2\nNELEM= 1\n5 0 -1 2\n" + points, 3, "vertex index -1 out of range"},
      {"NDIME= 2\nNELEM= 1\n5 0 1\n" + points, 3, "vertex index, but the line ends"},
      {"NDIME= 2\nNELEM= 1\n7 0 1 2\n" + points, 3, "element of type 7"},
      {"NDIME= 2\nNELEM= 1\n10 0 1 2 0\n" + points, 3, "element of type 10 in 2 dimensions"},
      {"NDIME= 2\nNELEM= 2\n5 0 1 2\n" + points, 4, "expected type of an element, got \"NPOIN=\""},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\n5 0 2 1\n" + points, 4, "expected KEY= value"},
      {"NDIME= 2\nNELEM= 99999999\n5 0 1 2\n" + points, 2, "bytes of the file are left"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= -3\n0 0\n", 3, "vertex index 0 out of range"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1\n0 1\n", 6, "y coordinate, but the line ends"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 nan\n0 1\n", 6, "y coordinate is not a finite number"},
      {"NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0.00 0.00\n1.00 0.00\n", 6, "the file ends"},
      {good + "NELEM= 1\n5 0 1 2\n", 8, "a second time"},
      {good + points, 8, "a second time"},
      {good + "MARKER_ELEMS= 1\n3 0 1\n", 8, "without a MARKER_TAG="},
      {good + "NMARK= 2\nMARKER_TAG= a\nMARKER_ELEMS= 1\n3 0 1\n", 11, "marker 2 of 2"},
      {good + "MARKER_TAG= a\nMARKER_ELEMS= 1\n3 0 8\n", 10, "vertex index 8 out of range (the file has 3 vertices)"},
      {good + "MARKER_TAG= a\nMARKER_ELEMS= 1\n5 0 1 2\n", 10, "element of type 5 in a marker"},
      {good + "MARKER_TAG= a\n", 8, "MARKER_ELEMS="},
      {"NZONE= 2\n" + good, 1, "several zones"},
  };
  for (const auto& bad : table) expect_refused("a.su2", bad.text, bad.line, bad.words);
}

TEST(Su2, EveryBeginning) {
  expect_truncation_safe("a.su2", "NDIME= 2\n" + kElements + kSu2Points + kMarkers);
  expect_truncation_safe("a.su2", kMarkers + kSu2Points + kElements + "NDIME= 2");
}

TEST(Su2, MadeAnewFromAnotherSource) {
  Mesh mesh = read_bytes("a.su2", "NDIME= 2\n" + kElements + kSu2Points + kMarkers);
  mesh.source.reset();
  std::vector<std::string> notes;
  expect_the_su2_mesh(read_bytes("b.su2", written("b.su2", mesh, mesh.positions, &notes)));
  EXPECT_TRUE(notes.empty());
}

TEST(Su2, BoundaryStringsBecomeMarkers) {
  const Mesh grid = read_bytes("a.14", "t\n1 3\n1 0 0 5\n2 1 0 5\n3 0 1 5\n1 3 1 2 3\n1\n2\n2\n1\n2\n1\n3\n3 1\n1\n2\n3\n");
  std::vector<std::string> notes;
  const Mesh mesh = read_bytes("a.su2", written("a.su2", grid, grid.positions, &notes));
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.groups[0].name, "open_boundary_1");
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1));
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(0, 1, 1, 2, 2, 0));  // islands are closed
  EXPECT_THAT(notes, testing::UnorderedElementsAre(HasSubstr("depth"), HasSubstr("open boundary 1"), HasSubstr("land boundary 1")));
}

/// An element turned over after reading is written the right way round, all else as in the file.
TEST(Su2, RealVolumeMadeAnewTheRightWayRound) {
  std::filesystem::path path;
  for (const auto& file : shared_meshes(".su2")) {
    if (file.filename() == "su2_MixElemsKnowles.su2") path = file;
  }
  if (path.empty()) GTEST_SKIP() << "the shared meshes are not here";
  Progress progress;
  const Mesh mesh = read_mesh(path, progress);
  Mesh turned = mesh;
  turned.source.reset();
  turned.flipped.assign(mesh.elements.size(), 0);
  Index pyramids = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.elements.kind(e) != ElementKind::Pyramid) continue;
    turned.elements.flip(e);
    turned.flipped[e] = 1;
    ++pyramids;
  }
  EXPECT_EQ(pyramids, 3936U);
  const Mesh again = read_bytes("b.su2", written("b.su2", turned));
  expect_same_elements(turned, again);
  ASSERT_EQ(again.groups.size(), 2U);
  // 82 lines lie between the two tags of the file, two of them heads.
  EXPECT_EQ(again.groups[0].faces.size(), 80U);
}

TEST(Su2, RealFiles) {
  const auto files = shared_meshes(".su2");
  if (files.empty()) GTEST_SKIP() << "the shared meshes are not here";
  Progress progress;
  const std::map<std::string, std::array<std::size_t, 3>> counts{{"su2_NACA64A010_hybrid_inv.su2", {6532, 9313, 2}},
                                                                 {"su2_MixElemsKnowles.su2", {9161, 11744, 2}},
                                                                 {"su2_primitiveVenturi.su2", {3510, 3364, 5}},
                                                                 {"su2_NACA0012_inv.su2", {5233, 10216, 2}}};
  for (const auto& file : files) {
    const Mesh mesh = read_mesh(file, progress);
    expect_patched("a.su2", get(file), info(mesh.elements.kind(0)).dimension == 3);
    const auto known = counts.find(file.filename());
    if (known == counts.end()) continue;
    EXPECT_EQ(mesh.positions.size(), known->second[0]);
    EXPECT_EQ(mesh.elements.size(), known->second[1]);
    EXPECT_EQ(mesh.groups.size(), known->second[2]);
  }
}

}  // namespace
}  // namespace dmoscope::test
