// VTK legacy: reading, refusals with their places, and notes about written files.

#include <bit>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "tests/fuzz/check_reader.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::testing {
namespace {

using test::corners;

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Field& field(const Mesh& mesh, std::string_view name) {
  for (const Field& f : mesh.fields) {
    if (f.name == name) return f;
  }
  throw std::logic_error("no such field");
}

TEST(Vtk, AsciiUnstructuredGrid) {
  const Mesh mesh = read_bytes("vtk", vtk_ascii());
  EXPECT_EQ(mesh.title, "three elements");
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  ASSERT_EQ(mesh.elements.size(), 3U);
  EXPECT_EQ(mesh.elements.kind(2), ElementKind::Quadrilateral);
  EXPECT_THAT(corners(mesh, 1), ElementsAre(0, 2, 3));
  EXPECT_THAT(corners(mesh, 2), ElementsAre(1, 4, 5, 2));
  EXPECT_THAT(field(mesh, "depth").values, ElementsAre(1, 2, 3, 4, 5, 6.25));
  EXPECT_EQ(field(mesh, "depth").type, "float");
  EXPECT_EQ(field(mesh, "flow").components, 3);
  EXPECT_EQ(field(mesh, "flow").role, "VECTORS");
}

TEST(Vtk, CellDataLoseTheRowsOfSkippedCells) {
  const Mesh mesh = read_bytes("vtk", vtk_ascii());
  // The third cell is a line.
  EXPECT_THAT(field(mesh, "id").values, ElementsAre(7, 8, 10));
  EXPECT_THAT(field(mesh, "pair of").values, ElementsAre(1, 2, 3, 4, 7, 8));
  EXPECT_THAT(mesh.source->notes(), ElementsAre("Cells that are no elements here: 1 lines."));
  EXPECT_THAT(mesh.source->only_in_file(), ElementsAre("data of cells that are no elements"));
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_EQ(mesh.groups[0].dimension, 1);
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1));
}

TEST(Vtk, VerticesAndChainsOfLinesArePutIntoGroups) {
  const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET ";
  const std::string points = "POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\n";
  for (const std::string& text :
       {head + "UNSTRUCTURED_GRID\n" + points + "CELLS 6 21\n3 0 1 2\n3 0 2 1\n4 3 2 0 1\n2 1 3\n2 2 0\n1 3\nCELL_TYPES 6\n5 0 4 3 2 1\n",
        head + "POLYDATA\n" + points + "VERTICES 2 5\n2 2 0\n1 3\nLINES 2 8\n4 3 2 0 1\n2 1 3\nPOLYGONS 1 4\n3 0 1 2\n"}) {
    const Mesh mesh = read_bytes("vtk", text);
    ASSERT_EQ(mesh.groups.size(), 2U);
    EXPECT_EQ(mesh.elements.size(), 1U);
    EXPECT_EQ(mesh.groups[0].name, "vertex cells");
    EXPECT_EQ(mesh.groups[0].dimension, 0);
    EXPECT_THAT(mesh.groups[0].members, ElementsAre(2, 0, 3));
    EXPECT_EQ(mesh.groups[1].name, "line cells");
    EXPECT_EQ(mesh.groups[1].dimension, 1);
    EXPECT_THAT(mesh.groups[1].members, ElementsAre(3, 2, 2, 0, 0, 1, 1, 3));
  }
}

std::string with_cell_data(const std::string& data) {
  return "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nCELLS 2 8\n3 0 1 2\n"
         "3 0 2 3\nCELL_TYPES 2\n5 5\nCELL_DATA 2\n" +
         data;
}

/// FreeFem writes "int1", type and number of components in one word.
TEST(Vtk, TypeAndComponentsInOneWord) {
  const Mesh mesh =
      read_bytes("vtk", with_cell_data("Scalars  Label int1\nLOOKUP_TABLE FreeFempp_table\n4\n7\n"
                                       "LOOKUP_TABLE FreeFempp_table 2\n0.0 0.0 1.0 0.0\n1 0 0 1\nSCALARS v float2\n1 2 3 4\n"));
  EXPECT_THAT(field(mesh, "Label").values, ElementsAre(4, 7));
  EXPECT_EQ(field(mesh, "Label").type, "int");
  EXPECT_EQ(field(mesh, "v").components, 2);
  EXPECT_THAT(mesh.source->notes(), ::testing::Contains(HasSubstr("\"int1\" of field \"Label\" was read as int 1")));
}

TEST(Vtk, DataOfAnUnknownTypeArePassedOver) {
  const Mesh mesh = read_bytes("vtk", with_cell_data("SCALARS odd complex 2\nLOOKUP_TABLE default\n1 2 3 4\nSCALARS id int\nLOOKUP_TABLE "
                                                     "default\n5 6\nFIELD f 2\nquad 1 2 float128\n1 2\nb 1 2 int\n8 9\nVECTORS w half\n"
                                                     "1 2 3 4 5 6\n"));
  EXPECT_EQ(mesh.fields.size(), 2U);
  EXPECT_THAT(field(mesh, "id").values, ElementsAre(5, 6));
  EXPECT_THAT(field(mesh, "b").values, ElementsAre(8, 9));
  EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("\"odd\" was passed over"), HasSubstr("\"quad\""), HasSubstr("\"w\"")));
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains("field \"odd\""));
  // In a binary file their end is unknown.
  std::string binary = with_cell_data("SCALARS odd complex\nLOOKUP_TABLE default\n");
  binary.replace(binary.find("ASCII"), 5, "BINARY");
  binary.erase(binary.find("0 0 0 1"));
  put<float>(binary, true, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  binary += "\nCELLS 2 8\n";
  put<std::int32_t>(binary, true, {3, 0, 1, 2, 3, 0, 2, 3});
  binary += "\nCELL_TYPES 2\n";
  put<std::int32_t>(binary, true, {5, 5});
  try {
    (void)read_bytes("vtk", binary + "\nCELL_DATA 2\nSCALARS odd complex\nLOOKUP_TABLE default\n" + std::string(32, 'x'));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("nobody can tell where it ends"));
  }
}

TEST(Vtk, StructuredGridsBecomeHexahedraAndQuadrilaterals) {
  const Mesh grid = read_bytes("vtk", vtk_structured_grid());
  ASSERT_EQ(grid.elements.size(), 2U);
  EXPECT_EQ(grid.elements.kind(0), ElementKind::Hexahedron);
  // Points run along x, then y, then z.
  EXPECT_THAT(corners(grid, 0), ElementsAre(0, 1, 4, 3, 6, 7, 10, 9));
  EXPECT_THAT(corners(grid, 1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10));
  EXPECT_EQ(grid.positions[4], (Vec3{1, 1.5, 0}));
  EXPECT_THAT(field(grid, "id").values, ElementsAre(4, 7));
  EXPECT_EQ(field(grid, "depth").values.size(), 12U);
  EXPECT_EQ(write_again(grid, grid.positions).bytes, vtk_structured_grid()) << "its points are listed: they are replaced in place";

  const Mesh upright = read_bytes("vtk", vtk_rectilinear());
  EXPECT_THAT(upright.positions, ElementsAre(Vec3{0, 5, 0}, Vec3{1, 5, 0}, Vec3{3, 5, 0}, Vec3{0, 5, 2}, Vec3{1, 5, 2}, Vec3{3, 5, 2}));
  ASSERT_EQ(upright.elements.size(), 2U);
  EXPECT_THAT(corners(upright, 1), ElementsAre(1, 2, 5, 4));
  EXPECT_THAT(field(upright, "mark").values, ElementsAre('a', 'b', 'c', 'd', 'e', 'f'));
  EXPECT_THAT(upright.source->not_patchable(), HasSubstr("regular grid"));

  const Mesh image = read_bytes("vtk", vtk_image());
  ASSERT_EQ(image.elements.size(), 4U);
  EXPECT_EQ(image.positions[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(image.positions[8], (Vec3{2, 4, 3}));
  EXPECT_THAT(corners(image, 2), ElementsAre(3, 4, 7, 6));
  EXPECT_THAT(field(image, "id").values, ElementsAre(4, 7, 8, 9));
}

TEST(Vtk, StructuredGridsThatAreNoneAreRefused) {
  const auto refusal = [](std::string bytes, const std::string& from, const std::string& to) -> std::string {
    bytes.replace(bytes.find(from), from.size(), to);
    try {
      (void)read_bytes("vtk", bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "was read";
  };
  EXPECT_THAT(refusal(vtk_image(), "3 3 1", "9 1 1"), HasSubstr("no cells of two or three dimensions"));
  EXPECT_THAT(refusal(vtk_image(), "3 3 1", "3 0 1"), HasSubstr("without points"));
  EXPECT_THAT(refusal(vtk_image(), "3 3 1", "100000 100000 100"), HasSubstr("more than its file can be about"));
  EXPECT_THAT(refusal(vtk_image(), "3 3 1", "4294967295 4294967295 2"), HasSubstr("can hold"));
  EXPECT_THAT(refusal(vtk_image(), "3 3 1", "4 3 1"), HasSubstr("CELL_DATA 4"));
  EXPECT_THAT(refusal(vtk_structured_grid(), "3 2 2", "3 2 3"), HasSubstr("there are 4 cells"));
  EXPECT_THAT(refusal(vtk_structured_grid(), "DIMENSIONS 3 2 2\n", ""), HasSubstr("there are 0 cells"));
  EXPECT_THAT(refusal(vtk_rectilinear(), "Z_COORDINATES 2", "Z_COORDINATES 1"), HasSubstr("1 coordinates"));
  EXPECT_THAT(refusal(vtk_rectilinear(), "DIMENSIONS 3 1 2", "DIMENSIONS 3 2 2"), HasSubstr("1 coordinates"));
}

TEST(Vtk, PolydataInTheLayoutOfVersion5) {
  const Mesh mesh = read_bytes("vtk", vtk_poly_ascii());
  ASSERT_EQ(mesh.elements.size(), 3U);
  EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2));
  EXPECT_THAT(corners(mesh, 2), ElementsAre(1, 4, 5, 2));
  // The row of the vertex is the first, and is dropped.
  EXPECT_THAT(field(mesh, "rgb").values, ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_EQ(field(mesh, "n").role, "NORMALS");
}

TEST(Vtk, BinaryOfBothLayouts) {
  for (const bool offsets : {false, true}) {
    const Mesh mesh = read_bytes("vtk", vtk_binary(offsets));
    ASSERT_EQ(mesh.elements.size(), 3U);
    EXPECT_EQ(mesh.positions[5], (Vec3{2, 1, 0.5}));
    // The last cell of the old layout is a pixel, 1 4 2 5 row by row.
    EXPECT_THAT(corners(mesh, 2), ElementsAre(1, 4, 5, 2));
    EXPECT_THAT(field(mesh, "flags").values, ElementsAre(0, 0, 1, 0, 1, 1));
    EXPECT_THAT(field(mesh, "uv").values, ElementsAre(1, -2, 3, 4, 5, -6));
  }
}

TEST(Vtk, FacesOfAVolumeMeshAreAGroup) {
  const Mesh mesh = read_bytes("vtk", vtk_volume());
  ASSERT_EQ(mesh.elements.size(), 2U);
  EXPECT_EQ(mesh.elements.kind(0), ElementKind::Hexahedron);
  EXPECT_EQ(mesh.elements.kind(1), ElementKind::Pyramid);
  EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("1 faces of the volume mesh")));
  ASSERT_EQ(mesh.groups.size(), 1U);
  EXPECT_THAT(std::vector<Index>(mesh.groups[0].faces.all_corners().begin(), mesh.groups[0].faces.all_corners().end()),
              ElementsAre(0, 1, 2, 3));
}

/// All volume cells of both layouts; the voxel, numbered row by row, is the cube that is also given as a hexahedron.
TEST(Vtk, VolumeCellsOfBothBinaryLayouts) {
  const std::vector<std::vector<std::int32_t>> cells{
      {0, 1, 3, 4}, {0, 1, 3, 2, 4, 5, 7, 6}, {0, 1, 2, 3, 4, 5, 6, 7}, {0, 1, 2, 4, 5, 6}, {4, 5, 6, 7, 8}, {0, 1, 2, 3}, {0, 1}};
  for (const bool offsets : {false, true}) {
    std::string s = std::string("# vtk DataFile Version ") + (offsets ? "5.1" : "4.2") +
                    "\nvolume\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n";
    put<double>(s, true, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.5, 0.5, 2});
    s += offsets ? "\nCELLS 8 37\nOFFSETS vtktypeint64\n" : "\nCELLS 7 44\n";
    if (offsets) {
      put<std::int64_t>(s, true, {0, 4, 12, 20, 26, 31, 35, 37});
      s += "\nCONNECTIVITY vtktypeint64\n";
    }
    for (const auto& cell : cells) {
      if (!offsets) put<std::int32_t>(s, true, {static_cast<std::int32_t>(cell.size())});
      for (const std::int32_t corner : cell) {
        if (offsets) put<std::int64_t>(s, true, {corner});
        if (!offsets) put<std::int32_t>(s, true, {corner});
      }
    }
    s += "\nCELL_TYPES 7\n";
    put<std::int32_t>(s, true, {10, 11, 12, 13, 14, 9, 3});
    s += "\n";
    const Mesh mesh = read_bytes("vtk", s);
    ASSERT_EQ(mesh.elements.size(), 5U);
    EXPECT_EQ(mesh.elements.kind(0), ElementKind::Tetrahedron);
    EXPECT_EQ(mesh.elements.kind(1), ElementKind::Hexahedron);
    EXPECT_EQ(corners(mesh, 1), corners(mesh, 2)) << "the voxel in a hexahedron's order";
    EXPECT_THAT(corners(mesh, 1), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(corners(mesh, 3), ElementsAre(0, 2, 1, 4, 6, 5)) << "a wedge, in our order";
    EXPECT_THAT(corners(mesh, 4), ElementsAre(4, 5, 6, 7, 8));
    EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("1 lines"), HasSubstr("1 faces of the volume")));
    // Written again, the voxel, the face and the line are unchanged.
    std::vector<Vec3> positions = mesh.positions;
    positions[8].z = 3.0;
    std::string expected = s;
    std::string two, three;
    put<double>(two, true, {2.0});
    put<double>(three, true, {3.0});
    expected.replace(expected.find(two, expected.find("double")), 8, three);
    EXPECT_EQ(write_again(mesh, positions).bytes, expected);
  }
}

TEST(Vtk, CellsOfHigherOrderAreRefusedByName) {
  const std::vector<std::pair<int, std::string>> kinds{
      {21, "quadratic edge"},       {24, "quadratic tetrahedron"}, {25, "quadratic hexahedron"},
      {34, "biquadratic triangle"}, {68, "Lagrange curve"},        {71, "Lagrange tetrahedron"},
      {72, "Lagrange hexahedron"},  {75, "Bezier curve"},          {81, "Bezier pyramid"}};
  for (const auto& [type, name] : kinds) {
    std::string bytes = vtk_ascii();
    bytes.replace(bytes.find("5 5 3 9"), 7, "5\n5 " + std::to_string(type) + " 9");
    try {
      read_bytes("vtk", bytes);
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_EQ(error.line(), 19U);
      EXPECT_THAT(error.what(), HasSubstr("type " + std::to_string(type) + " (" + name + ")"));
      EXPECT_THAT(error.what(), HasSubstr("linear cells"));
    }
  }
}

TEST(Vtk, UnmovedVerticesKeepTheirCharacters) {
  const Mesh mesh = read_bytes("vtk", vtk_ascii());
  std::vector<Vec3> positions = mesh.positions;
  positions[3].y = 1.75;
  std::string expected = vtk_ascii();
  expected.replace(expected.find("1.50"), 4, "1.75");
  EXPECT_EQ(write_again(mesh, positions).bytes, expected);
}

TEST(Vtk, BinaryFloatsSayThatTheyRound) {
  const Mesh mesh = read_bytes("vtk", vtk_binary(false));
  std::vector<Vec3> positions = mesh.positions;
  positions[0].x = 0.1;
  const Written written = write_again(mesh, positions);
  EXPECT_THAT(written.notes, ElementsAre(HasSubstr("32-bit")));
  EXPECT_EQ(read_bytes("vtk", written.bytes).positions[0].x, static_cast<double>(0.1F));
}

TEST(Vtk, NewFileKeepsRandomDoublesAndFieldsBitwise) {
  std::mt19937_64 random(7);
  Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    const auto next = [&] {
      double value = 0.0;
      do value = std::bit_cast<double>(random());
      while (!std::isfinite(value));
      return value;
    };
    mesh.positions.push_back({next(), next(), next()});
  }
  for (Index e = 0; e < 100; ++e) mesh.elements.add(ElementKind::Triangle, std::vector<Index>{3 * e, 3 * e + 1, 3 * e + 2});
  Field depth{.name = "water depth", .on = Field::On::Vertices, .components = 1, .type = "double", .role = "depth", .values = {}};
  for (const Vec3 p : mesh.positions) depth.values.push_back(p.x);
  Field flow{.name = "flow", .on = Field::On::Elements, .components = 5, .type = "float64", .role = "", .values = {}};
  for (int i = 0; i < 500; ++i) flow.values.push_back(0.1 * i);
  mesh.fields = {depth, flow};
  mesh.flipped.assign(100, 0);
  mesh.flipped[4] = 1;

  const Mesh again = read_bytes("vtk", write_anew("vtk", mesh, mesh.positions).bytes);
  for (std::size_t v = 0; v < 300; ++v) EXPECT_TRUE(testing::same_values(again.positions[v], mesh.positions[v])) << v;
  EXPECT_EQ(field(again, "water depth").values, depth.values);
  EXPECT_EQ(field(again, "flow").values, flow.values);
  EXPECT_EQ(field(again, "flow").components, 5);
  EXPECT_THAT(corners(again, 4), ElementsAre(12, 14, 13)) << "written in the file's own winding";
}

TEST(Vtk, FieldsComeThroughANewFile) {
  const Mesh mesh = read_bytes("vtk", vtk_ascii());
  const Mesh again = read_bytes("vtk", write_anew("vtk", mesh, mesh.positions).bytes);
  ASSERT_EQ(again.fields.size(), mesh.fields.size());
  for (const Field& before : mesh.fields) {
    const Field& after = field(again, before.name);
    EXPECT_EQ(after.values, before.values) << before.name;
    EXPECT_EQ(after.type, before.type) << before.name;
    EXPECT_EQ(after.role, before.role) << before.name;
    EXPECT_EQ(after.on, before.on) << before.name;
  }
}

TEST(Vtk, NewFileNamesTheGroupsThatItDrops) {
  Mesh mesh = read_bytes("vtk", vtk_ascii());
  mesh.groups.push_back({.name = "wall", .role = "marker", .code = 0, .dimension = 1, .members = {0, 1}});
  EXPECT_THAT(write_anew("vtk", mesh, mesh.positions).notes, ElementsAre(HasSubstr("\"line cells\""), HasSubstr("wall")));
}

TEST(Vtk, StringsMetadataAndFileDataArePassedOver) {
  std::string bytes = vtk_ascii();
  const std::string file_data = "FIELD FieldData 2\nTIME 1 1 double\n0.5\nnames 1 2 string\nleft side\nright\nMETADATA\nINFORMATION 0\n\n";
  bytes.insert(bytes.find("POINTS"), file_data);
  const Mesh mesh = read_bytes("vtk", bytes);
  EXPECT_EQ(mesh.fields.size(), 4U);
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains(HasSubstr("TIME")));
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains(HasSubstr("names")));
}

struct MalformedVtk {
  std::string from, to;
  std::size_t line;
  std::string says;
};

TEST(Vtk, RefusesMalformedFilesWithTheLine) {
  const std::vector<MalformedVtk> cases{
      {"# vtk DataFile", "# vkt DataFile", 1, "begins with"},
      {"Version 3.0", "Version 9.0", 1, "not known"},
      {"ASCII", "ASKII", 3, "ASKII"},
      {"UNSTRUCTURED_GRID", "RECTILINEAR_GRID", 5, "POINTS"},
      {"UNSTRUCTURED_GRID", "FIELD_GRID", 4, "FIELD_GRID"},
      {"POINTS 6", "POINTS -6", 5, "negative"},
      {"POINTS 6", "POINTS 99999999", 5, "bytes of the file are left"},
      {"POINTS 6 double", "POINTS 6 quadruple", 5, "quadruple"},
      {"1.0 1 0", "1.0 nan 0", 8, "not a finite"},
      {"1.0 1 0", "1.0 inf 0", 8, "not a finite"},
      {"1.0 1 0", "1.0 1e999 0", 8, "finite"},
      {"1.0 1 0", "1.0 one 0", 8, "one"},
      {"CELLS 4 16", "CELLS 4 15", 12, "CELLS"},
      {"CELLS 4 16", "CELLS 3 16", 12, "CELLS"},
      {"CELLS 4 16", "CELLS 5 16", 12, "CELLS"},
      {"3 0 2 3\n", "3 0 2 6\n", 14, "point 6"},
      {"3 0 2 3\n", "3 0 -1 3\n", 14, "point -1"},
      {"3 0 2 3\n", "3 0 1.5 3\n", 14, "1.5"},
      {"CELL_TYPES 4", "CELL_TYPES 3", 17, "4 cells"},
      {"5 5 3 9", "5\n5 3\n22", 20, "quadratic triangle"},
      {"5 5 3 9", "5 9 3 9", 14, "corners"},
      {"5 5 3 9", "5 5 3 77", 18, "77"},
      {"POINT_DATA 6", "POINT_DATA 5", 19, "6 points"},
      {"CELL_DATA 4", "CELL_DATA 3", 26, "4 cells"},
      {"SCALARS id int", "SCALARZ id int", 27, "SCALARZ"},
      {"5 6 7 8\n", "5 6 7\n", 32, "file ends"},
  };
  for (const MalformedVtk& one : cases) {
    std::string bytes = vtk_ascii();
    const std::size_t at = bytes.find(one.from);
    ASSERT_NE(at, std::string::npos) << one.from;
    bytes.replace(at, one.from.size(), one.to);
    try {
      read_bytes("vtk", bytes);
      ADD_FAILURE() << one.to << " was read";
    } catch (const InputError& error) {
      EXPECT_EQ(error.line(), one.line) << one.to << ": " << error.what();
      EXPECT_THAT(error.what(), HasSubstr(one.says)) << one.to;
    }
  }
}

TEST(Vtk, RefusesTruncatedBinaryWithTheByte) {
  const std::string bytes = vtk_binary(true);
  try {
    read_bytes("vtk", bytes.substr(0, bytes.find("\nCONNECTIVITY") - 3));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), 0U);
    EXPECT_THAT(error.what(), HasSubstr("at byte"));
  }
}

TEST(Vtk, RefusesTriangleStrips) {
  std::string bytes = vtk_poly_ascii();
  bytes.insert(bytes.find("POLYGONS"), "TRIANGLE_STRIPS 2 4\nOFFSETS int\n0 4\nCONNECTIVITY int\n0 1 2 3\n");
  try {
    read_bytes("vtk", bytes);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), 20U) << error.what();
    EXPECT_THAT(error.what(), HasSubstr("triangle strips"));
  }
}

TEST(VtkFiles, RealMeshesReadWithTheirCountsAndComeOutAsTheyWentIn) {
  const std::filesystem::path folder = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  struct Counts {
    std::size_t vertices, elements;
  };
  const std::map<std::string, Counts> files{
      {"hex/cub_fru.vtk", {12753, 10752}},       {"hex/hex_5_tangled.vtk", {216, 125}},    {"hex/pave2.e.vtk", {3408, 2704}},
      {"mixed2d/overt_hyb_1.vtk", {5242, 5213}}, {"mixed3d/6-wedge-prism.vtk", {14, 6}},   {"mixed3d/mixed-hex-pyr-tet.vtk", {683, 940}},
      {"quad/hole_in_square.vtk", {168, 140}},   {"quad/shashkov_quad.vtk", {4225, 4096}}, {"quad/shest_grid32.vtk", {1089, 1024}},
      {"quad/tangled_quad.vtk", {36, 25}},       {"tet/cube-clip-5.vtk", {3408, 16637}},   {"tet/tet_4_tangled.vtk", {129, 408}},
      {"tet/tire.vtk", {2570, 11098}},           {"tri/bad_circle_tri.vtk", {33, 48}},     {"tri/shashkov.vtk", {4225, 8192}},
      {"tri/tangled_tri.vtk", {40, 58}}};
  for (const auto& [name, counts] : files) {
    SCOPED_TRACE(name);
    Progress progress;
    const Mesh mesh = read_mesh(folder / name, progress);
    EXPECT_EQ(mesh.positions.size(), counts.vertices);
    EXPECT_EQ(mesh.elements.size(), counts.elements);
    EXPECT_NO_THROW(check_sound(mesh));
    EXPECT_NO_THROW(check_patch("vtk", mesh));
  }
}

TEST(VtkFiles, MalformedRealMeshIsRefused) {
  const std::filesystem::path path = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes/quad/unstrquad.vtk";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  Progress progress;
  try {
    (void)read_mesh(path, progress);
    FAIL();
  } catch (const InputError& error) {
    // CELLS 30 80, but 30 quadrilaterals take 150 numbers.
    EXPECT_EQ(error.line(), 47U) << error.what();
  }
}

}  // namespace
}  // namespace dmoscope::testing
