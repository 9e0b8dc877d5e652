#include <algorithm>
#include <array>
#include <filesystem>
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

const std::string kHead = "MeshVersionFormatted 2\nDimension 3\n";
const std::string kVertices = "Vertices\n5\n0 0 0 1\n1.0 0 0 0\n0 1 0 0\n0 0 1 0\n1 1 1 2\n";
const std::string kTetrahedra = "Tetrahedra\n2\n1 2 3 4 3\n2 3 4 5 0\n";
const std::string kTriangles = "Triangles\n3\n1 3 2 7\n2 3 5 8\n1 2 4 7\n";
const std::string kEdges = "Edges\n2\n1 2 0\n2 3 4\n";
const std::string kMarks = "Corners\n2\n1\n5\nRidges\n1\n2\nRequiredVertices\n1\n3\n";

const Group* group(const Mesh& mesh, std::string_view name, int dimension) {
  for (const Group& g : mesh.groups) {
    if (g.name == name && g.dimension == dimension) return &g;
  }
  return nullptr;
}

void expect_the_mesh(const Mesh& mesh) {
  expect_consistent(mesh);
  ASSERT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.positions[1], (Vec3{1, 0, 0}));
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Tetrahedron, ElementKind::Tetrahedron));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 3, 1, 2, 3, 4));
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(1, 0, 0, 0, 2));
  EXPECT_EQ(mesh.groups.size(), 8U);
  const auto faces = [&](std::string_view name) {
    for (const Group& g : mesh.groups) {
      if (g.name == name && g.faces.size() > 0) return std::vector<Index>(g.faces.all_corners().begin(), g.faces.all_corners().end());
    }
    return std::vector<Index>();
  };
  EXPECT_THAT(faces("reference 7"), ElementsAre(0, 2, 1, 0, 1, 3));
  EXPECT_THAT(faces("reference 8"), ElementsAre(1, 2, 4));
  ASSERT_NE(group(mesh, "reference 3", 2), nullptr);
  EXPECT_THAT(group(mesh, "reference 3", 2)->members, ElementsAre(0));
  EXPECT_EQ(group(mesh, "reference 3", 2)->code, 3);
  ASSERT_NE(group(mesh, "reference 0", 1), nullptr);
  EXPECT_THAT(group(mesh, "reference 0", 1)->members, ElementsAre(0, 1));
  ASSERT_NE(group(mesh, "reference 4", 1), nullptr);
  EXPECT_THAT(group(mesh, "reference 4", 1)->members, ElementsAre(1, 2));
  ASSERT_NE(group(mesh, "Ridges", 1), nullptr);
  EXPECT_THAT(group(mesh, "Ridges", 1)->members, ElementsAre(1, 2));
  ASSERT_NE(group(mesh, "Corners", 0), nullptr);
  EXPECT_THAT(group(mesh, "Corners", 0)->members, ElementsAre(0, 4));
  ASSERT_NE(group(mesh, "RequiredVertices", 0), nullptr);
  EXPECT_THAT(group(mesh, "RequiredVertices", 0)->members, ElementsAre(2));
}

TEST(Medit, SectionsInAnyOrder) {
  std::array<std::string, 5> sections{kVertices, kTetrahedra, kTriangles, kEdges, kMarks};
  std::sort(sections.begin(), sections.end());
  do {
    const std::string text = kHead + sections[0] + "# comment\n" + sections[1] + sections[2] + "\n" + sections[3] + sections[4] + "End\n";
    expect_the_mesh(read_bytes("a.mesh", text));
  } while (std::next_permutation(sections.begin(), sections.end()));
}

TEST(Medit, OneKindOfEveryElement) {
  const std::string text =
      "MeshVersionFormatted 1\nDimension\n3\nVertices 9\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\n.5 .5 2 "
      "0\n"
      "Hexahedra 1\n1 2 3 4 5 6 7 8 0\nPyramids 1\n5 6 7 8 9 0\nPrisms 1\n1 2 4 5 6 8 0\nTetrahedra 1\n1 2 4 5 0\n"
      "Quadrilaterals 1\n1 4 3 2 9\nEnd\n";
  const Mesh mesh = read_bytes("a.mesh", text);
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid, ElementKind::Wedge, ElementKind::Tetrahedron));
  EXPECT_THAT(std::vector<Index>(mesh.elements.corners(2).begin(), mesh.elements.corners(2).end()), ElementsAre(0, 1, 3, 4, 5, 7));
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_THAT(std::vector<Index>(mesh.groups[0].faces.corners(0).begin(), mesh.groups[0].faces.corners(0).end()), ElementsAre(0, 3, 2, 1));
  expect_patched("a.mesh", text, true);
  Mesh anew = mesh;
  anew.source.reset();
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.mesh", written("b.mesh", anew, anew.positions, &notes));
  EXPECT_THAT(notes, ElementsAre());
  expect_same_elements(mesh, again);
  expect_same_positions(mesh.positions, again.positions);
  ASSERT_EQ(again.groups.size(), 1U);
  EXPECT_EQ(again.groups[0].code, 9);
}

TEST(Medit, MadeAnewItHoldsTheSame) {
  Mesh mesh = read_bytes("a.mesh", kHead + kVertices + kEdges + kTriangles + kTetrahedra + kMarks + "End\n");
  mesh.source.reset();
  std::vector<std::string> notes;
  expect_the_mesh(read_bytes("b.mesh", written("b.mesh", mesh, mesh.positions, &notes)));
  EXPECT_THAT(notes, ElementsAre());
}

TEST(Medit, RequiredFacesAreAGroupAndWrittenAnew) {
  const std::string text = kHead + kVertices + kTetrahedra + kTriangles + "RequiredTriangles\n2\n2\n1\nEnd\n";
  Mesh mesh = read_bytes("a.mesh", text);
  const auto required = [](const Mesh& m) {
    const Group* found = group(m, "RequiredTriangles", 2);
    EXPECT_NE(found, nullptr);
    return found == nullptr ? std::vector<Index>()
                            : std::vector<Index>(found->faces.all_corners().begin(), found->faces.all_corners().end());
  };
  EXPECT_THAT(required(mesh), ElementsAre(1, 2, 4, 0, 2, 1));
  expect_patched("a.mesh", text, true);
  mesh.source.reset();
  std::vector<std::string> notes;
  const std::string anew = written("b.mesh", mesh, mesh.positions, &notes);
  EXPECT_THAT(notes, ElementsAre());
  EXPECT_THAT(anew, HasSubstr("Triangles\n3\n")) << "none a second time";
  EXPECT_THAT(required(read_bytes("b.mesh", anew)), ElementsAre(1, 2, 4, 0, 2, 1));
  mesh.groups = {*group(mesh, "RequiredTriangles", 2)};  // faces of no other group
  EXPECT_THAT(required(read_bytes("b.mesh", written("b.mesh", mesh))), ElementsAre(1, 2, 4, 0, 2, 1));
  expect_refused("a.mesh", kHead + kVertices + kTetrahedra + kTriangles + "RequiredTriangles\n1\n4\nEnd\n", 21,
                 "RequiredTriangles 4 out of range");
}

TEST(Medit, RequiredElementsOfAPlanarMeshAreAGroup) {
  const std::string text =
      "MeshVersionFormatted 2\nDimension 2\nVertices\n6\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n2 1 0\nEdges\n1\n1 2 0\nTriangles\n2\n1 2 3 "
      "1\n1 3 4 2\nQuadrilaterals 1\n2 5 6 3 1\nRequiredQuadrilaterals 1 1\nRequiredTriangles\n1\n2\nEnd\n";
  Mesh mesh = read_bytes("a.mesh", text);
  for (int pass = 0; pass < 2; ++pass) {
    ASSERT_NE(group(mesh, "RequiredTriangles", 2), nullptr);
    EXPECT_THAT(group(mesh, "RequiredTriangles", 2)->members, ElementsAre(1));
    ASSERT_NE(group(mesh, "RequiredQuadrilaterals", 2), nullptr);
    EXPECT_THAT(group(mesh, "RequiredQuadrilaterals", 2)->members, ElementsAre(2));
    ASSERT_NE(group(mesh, "reference 2", 2), nullptr);
    EXPECT_THAT(group(mesh, "reference 2", 2)->members, ElementsAre(1));
    mesh.source.reset();
    std::vector<std::string> notes;
    mesh = read_bytes("b.mesh", written("b.mesh", mesh, mesh.positions, &notes));
    EXPECT_THAT(notes, ElementsAre());
  }
}

TEST(Medit, PlanarFilesHoldNoZ) {
  const std::string text =
      "MeshVersionFormatted 2\nDimension 2\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 5\nEdges\n1\n1 2 3\nTriangles\n2\n1 2 3 1\n1 3 4 "
      "2\nEnd\n";
  const Mesh mesh = read_bytes("a.mesh", text);
  EXPECT_EQ(mesh.elements.size(), 2U);
  ASSERT_EQ(mesh.groups.size(), 3U);
  EXPECT_EQ(mesh.groups[1].dimension, 2);
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(0));
  expect_patched("a.mesh", text, false);
  std::vector<Vec3> lifted = mesh.positions;
  lifted[2].z = 1.0;
  EXPECT_THROW((void)written("a.mesh", mesh, lifted), OutputError);

  Mesh anew = mesh;
  anew.source.reset();
  EXPECT_THAT(written("b.mesh", anew), HasSubstr("Dimension 2\n"));
  EXPECT_THAT(written("b.mesh", anew, lifted), HasSubstr("Dimension 3\n"));
}

TEST(Medit, WhatWeDoNotKnowIsKept) {
  const std::string text = kHead + kVertices + kTetrahedra + "Normals\n2\n0 0 1\n1 0 0 # up\nNormalAtVertices 1 1 2\nEnd\nwhat follows";
  const Mesh mesh = read_bytes("a.mesh", text);
  EXPECT_THAT(mesh.source->only_in_file(), ElementsAre("Normals", "NormalAtVertices", "comments"));
  expect_patched("a.mesh", text, true);
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  expect_patched("a.mesh", crlf, true);
}

TEST(Medit, MixedKindsAreSortedAndTheNotesSaySo) {
  Mesh mesh = read_bytes("a.su2",
                         "NDIME= 2\nNELEM= 3\n5 0 1 2 0\n9 0 2 3 4 1\n5 0 1 4 2\nNPOIN= 5\n0 0\n1 0\n1 1\n0 1\n-1 0\nNMARK= 1\n"
                         "MARKER_TAG= wall\nMARKER_ELEMS= 1\n3 0 1\n");
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.mesh", written("b.mesh", mesh, mesh.positions, &notes));
  EXPECT_THAT(std::vector<Index>(again.elements.all_corners().begin(), again.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 0, 1, 4, 0, 2, 3, 4));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("sorted by their kinds")));
  EXPECT_THAT(notes, testing::Contains(HasSubstr("MEDIT holds no names: marker \"wall\" has reference 1")));
  ASSERT_EQ(again.groups.size(), 1U);
  EXPECT_THAT(again.groups[0].members, ElementsAre(0, 1));
}

TEST(Medit, ManyReferencesOfElementsAreAField) {
  constexpr int kStrip = 300;
  std::string text = "MeshVersionFormatted 2\nDimension 2\nVertices " + std::to_string(kStrip + 2) + "\n";
  for (int v = 0; v < kStrip + 2; ++v) text += std::to_string(v / 2) + " " + std::to_string(v % 2) + " 0\n";
  text += "Edges 1\n1 2 6\nTriangles " + std::to_string(kStrip) + "\n";
  for (int t = 1; t <= kStrip; ++t) {
    text += std::to_string(t) + " " + std::to_string(t + 1) + " " + std::to_string(t + 2) + " " + std::to_string(1000 - t) + "\n";
  }
  Mesh mesh = read_bytes("a.mesh", text);
  expect_consistent(mesh);
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_EQ(mesh.groups[0].code, 6);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].on, Field::On::Elements);
  EXPECT_EQ(mesh.fields[0].values.front(), 999);
  EXPECT_EQ(mesh.fields[0].values.back(), 700);
  mesh.source.reset();
  std::vector<std::string> notes;
  const Mesh again = read_bytes("b.mesh", written("b.mesh", mesh, mesh.positions, &notes));
  EXPECT_THAT(notes, ElementsAre());
  ASSERT_EQ(again.fields.size(), 1U);
  EXPECT_EQ(again.fields[0].values, mesh.fields[0].values);
}

TEST(Medit, Malformed) {
  const std::string good = kHead + kVertices + kTetrahedra;
  const struct {
    std::string text;
    std::size_t line;
    const char* words;
  } table[] = {
      {"Mesh 1\n", 1, "begins with MeshVersionFormatted"},
      {"MeshVersionFormatted 7\n", 1, "versions 1 to 4"},
      {"MeshVersionFormatted 2\nDimension 4\n", 2, "Dimension 4"},
      {"MeshVersionFormatted 2\nVertices 1\n0 0 0 0\n", 2, "Vertices before Dimension"},
      {kHead + kTetrahedra, 3, "no Vertices"},
      {kHead + "Vertices\n99999999\n0 0 0 0\n", 4, "but only"},
      {kHead + "Vertices\n-1\n0 0 0 0\n", 4, "negative"},
      {kHead + "Vertices\n1\n0 0 nan 0\n", 5, "not a finite number"},
      {kHead + "Vertices\n1\n0 0 0 0.5\n", 5, "expected reference"},
      {kHead + "Vertices\n2\n0 0 0 0\n0 0 0\nEnd\n", 7, "expected reference, got \"End\""},
      {kHead + kVertices + "Tetrahedra\n1\n1 2 3 6 0\n", 12, "vertex index 6 out of range (the file has 5 vertices)"},
      {kHead + kVertices + "Tetrahedra\n1\n0 2 3 4 0\n", 12, "vertex index 0 out of range"},
      {kHead + kVertices + "Tetrahedra\n99999999\n0 2 3 4 0\n", 11, "but only"},
      {kHead + kVertices + "Tetrahedra\n1\n1 2 3 4 99999999999\n", 12, "too large"},
      {kHead + kVertices + "TetrahedraP2\n1\n1 2 3 4 5 1 2 3 4 5 0\n", 10, "export linear elements"},
      {good + "1 2 3 4 0\n", 14, "expected a keyword, got \"1\""},
      {good + kTetrahedra, 14, "a second time"},
      {good + "DimensioN 2\n", 14, "DimensioN a second time"},
      {good + kEdges + "Ridges\n2\n1\n3\n", 21, "Ridges 3 out of range (the file has 2 edges)"},
      {good + "Corners\n1\n9\n", 16, "Corners 9 out of range (the file has 5 vertices)"},
      {kHead + kVertices + kEdges, 0, "no elements"},
  };
  for (const auto& bad : table) expect_refused("a.mesh", bad.text, bad.line, bad.words);
}

TEST(Medit, EveryBeginning) {
  expect_truncation_safe("a.mesh", kHead + kVertices + kEdges + kTriangles + kTetrahedra + kMarks + "End\n");
  expect_truncation_safe("a.mesh", kHead + kMarks + kTetrahedra + kEdges + kVertices);
}

TEST(Medit, SharedMeshes) {
  const auto files = shared_meshes(".mesh");
  if (files.empty()) GTEST_SKIP() << "the shared meshes are not here";
  for (const auto& file : files) {
    SCOPED_TRACE(file.string());
    const Mesh mesh = read_bytes(file.filename().string(), get(file));
    ASSERT_EQ(file.filename(), "cinolib_sphere.mesh");
    EXPECT_EQ(mesh.positions.size(), 4505U);
    EXPECT_EQ(mesh.elements.size(), 24013U);
    EXPECT_TRUE(std::ranges::all_of(mesh.elements.kinds(), [](ElementKind kind) { return kind == ElementKind::Tetrahedron; }));
    ASSERT_EQ(mesh.groups.size(), 1U);
    EXPECT_EQ(mesh.groups[0].faces.size(), 2880U);
    expect_patched("a.mesh", get(file), true);
    Mesh anew = mesh;
    anew.source.reset();
    const Mesh again = read_bytes("b.mesh", written("b.mesh", anew));
    expect_same_positions(mesh.positions, again.positions);
    expect_same_elements(mesh, again);
    ASSERT_EQ(again.groups.size(), 1U);
    EXPECT_TRUE(std::ranges::equal(again.groups[0].faces.all_corners(), mesh.groups[0].faces.all_corners()));
  }
}

}  // namespace
}  // namespace dmoscope::test
