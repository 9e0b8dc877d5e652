// VTU: every encoding gives the same mesh and is kept, and errors are reported with their places. The samples were made by Python's struct,
// base64 and zlib (tests/fuzz/vtu_samples.py).

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/base64.h"
#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/gzip.h"
#include "tests/fuzz/check_reader.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::testing {
namespace {

using test::corners;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string sample(std::string_view name) {
  for (const auto& [own, bytes] : vtu_samples()) {
    if (own == name) return std::string(bytes);
  }
  throw std::logic_error("no such sample");
}

bool in_pieces(std::string_view name) { return name.starts_with("pieces"); }

/// Replaces the first `from` in `text`.
std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the sample: " + std::string(from));
  return text.replace(at, from.size(), to);
}

void expect_refused(std::string_view bytes, std::size_t line, std::string_view says) {
  try {
    (void)read_bytes("vtu", bytes);
    ADD_FAILURE() << "read, but should be refused for: " << says;
  } catch (const InputError& error) {
    if (line != 0) {
      EXPECT_EQ(error.line(), line) << error.what();
    }
    EXPECT_THAT(error.what(), HasSubstr(std::string(says)));
  }
}

TEST(Vtu, EveryEncodingGivesTheSameMesh) {
  int seen = 0;
  for (const auto& [name, bytes] : vtu_samples()) {
    if (in_pieces(name)) continue;
    SCOPED_TRACE(name);
    ++seen;
    const Mesh mesh = read_bytes("vtu", bytes);
    ASSERT_EQ(mesh.positions.size(), 10U);
    EXPECT_EQ(mesh.positions[6], (Vec3{1, 1, 1}));
    EXPECT_EQ(mesh.positions[8], (Vec3{0.5, 0.5, 2}));
    EXPECT_EQ(mesh.positions[9], (Vec3{2, 0.25, 0.5}));
    EXPECT_THAT(
        std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
        ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid, ElementKind::Tetrahedron, ElementKind::Hexahedron, ElementKind::Wedge));
    EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_THAT(corners(mesh, 1), ElementsAre(4, 5, 6, 7, 8));
    EXPECT_THAT(corners(mesh, 2), ElementsAre(1, 2, 5, 9));
    EXPECT_THAT(corners(mesh, 3), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7)) << "a voxel";
    EXPECT_THAT(corners(mesh, 4), ElementsAre(0, 2, 1, 4, 6, 5)) << "a wedge, in our order";
    ASSERT_EQ(mesh.fields.size(), 3U);
    EXPECT_EQ(mesh.fields[0].name, "depth");
    EXPECT_EQ(mesh.fields[0].type, "Float32");
    EXPECT_EQ(mesh.fields[0].role, "SCALARS");
    EXPECT_THAT(mesh.fields[0].values, ElementsAre(0, 0.5, 1, 1.5, 2, 2.5, 3, 3.5, 4, 4.5));
    EXPECT_EQ(mesh.fields[1].role, "VECTORS");
    EXPECT_EQ(mesh.fields[1].components, 3);
    EXPECT_EQ(mesh.fields[1].values[29], 6.25);
    EXPECT_EQ(mesh.fields[2].type, "Int32");
    EXPECT_THAT(mesh.fields[2].values, ElementsAre(7, 9, 11, 12, 2147483647)) << "without the rows of the line and the face";
    EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("1 lines"), HasSubstr("1 faces of the volume")));
    EXPECT_THAT(mesh.source->only_in_file(), ElementsAre("data of cells that are no elements"));
    ASSERT_EQ(mesh.groups.size(), 2U);
    EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 1)) << "the line";
    EXPECT_EQ(mesh.groups[0].dimension, 1);
    EXPECT_THAT(std::vector<Index>(mesh.groups[1].faces.all_corners().begin(), mesh.groups[1].faces.all_corners().end()),
                ElementsAre(0, 1, 2, 3));
    EXPECT_TRUE(mesh.source->not_patchable().empty());
  }
  EXPECT_EQ(seen, 7);
}

TEST(Vtu, PiecesBecomeOneMesh) {
  int seen = 0;
  for (const auto& [name, bytes] : vtu_samples()) {
    if (!in_pieces(name)) continue;
    SCOPED_TRACE(name);
    ++seen;
    const Mesh mesh = read_bytes("vtu", bytes);
    ASSERT_EQ(mesh.positions.size(), 7U);
    EXPECT_EQ(mesh.positions[6], (Vec3{2, 1, 0}));
    ASSERT_EQ(mesh.elements.size(), 3U);
    EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2));
    EXPECT_THAT(corners(mesh, 2), ElementsAre(3, 6, 4));
    EXPECT_THAT(mesh.fields[0].values, ElementsAre(1, 2, 3, 5, 6, 7, 8));
    EXPECT_THAT(mesh.fields[2].values, ElementsAre(4, 5, 6));
    EXPECT_THAT(mesh.source->notes(), Contains(HasSubstr("3 pieces")));
  }
  EXPECT_EQ(seen, 3);
}

/// The tags of a file, without the values of offset="...".
std::string tags(std::string_view bytes) {
  std::string result;
  const std::size_t end = bytes.find("<AppendedData");
  bool inside = false;
  for (std::size_t i = 0; i < std::min(end, bytes.size()); ++i) {
    if (bytes[i] == '<') inside = true;
    if (inside) result += bytes[i];
    if (bytes[i] == '>') inside = false;
    if (inside && result.ends_with("offset=\"")) {
      while (bytes[i + 1] != '"') ++i;
    }
  }
  if (end != std::string_view::npos) result += bytes.substr(end, bytes.find('_', end) - end);
  return result;
}

TEST(Vtu, MovedPointsAreWrittenInTheFilesOwnEncoding) {
  for (const auto& [name, bytes] : vtu_samples()) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_bytes("vtu", bytes);
    EXPECT_EQ(write_again(mesh, mesh.positions).bytes, bytes);
    std::vector<Vec3> positions = mesh.positions;
    positions.back() = {1.75, 0.125, -3.0};
    const Written written = write_again(mesh, positions);
    EXPECT_TRUE(written.notes.empty());
    EXPECT_NE(written.bytes, bytes);
    EXPECT_EQ(tags(written.bytes), tags(bytes));
    const Mesh again = read_bytes("vtu", written.bytes);
    EXPECT_EQ(again.positions, positions);
    EXPECT_NO_THROW(check_same_data(mesh, again));
    EXPECT_NO_THROW(check_same(mesh, positions, again, true, true));
    // After moving back only the points could differ, and by their compression alone.
    if (name.find("zlib") == std::string_view::npos && name.find("ascii") == std::string_view::npos) {
      EXPECT_EQ(write_again(again, mesh.positions).bytes, bytes);
      EXPECT_EQ(written.bytes.size(), bytes.size());
    }
  }
}

TEST(Vtu, AsciiChangesNothingButTheMovedNumbers) {
  const std::string bytes = sample("ascii");
  const Mesh mesh = read_bytes("vtu", bytes);
  std::vector<Vec3> positions = mesh.positions;
  positions[9].y = 0.1;
  EXPECT_EQ(write_again(mesh, positions).bytes, with(bytes, "2.0 2.0 0.25 0.5\n", "2.0 2.0 0.1 0.5\n"));
}

std::string structured(const std::string& type, const std::string& grid, const std::string& piece) {
  return "<VTKFile type=\"" + type + "\" byte_order=\"LittleEndian\"><" + type + " " + grid + "><Piece " + piece + "</Piece></" + type +
         "></VTKFile>";
}

TEST(Vtu, StructuredGridsBecomeHexahedraAndQuadrilaterals) {
  const std::string points =
      "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\">0 0 0 1 0 0 2 0 0 0 1 0 1 1.5 0 2 1 0 0 0 1 1 0 1 2 0 1 0 1 1 1 1 1 2 "
      "1 1"
      "</DataArray></Points><CellData><DataArray type=\"Int32\" Name=\"id\">4 7</DataArray></CellData>";
  const Mesh grid = read_bytes("vtu", structured("StructuredGrid", "WholeExtent=\"0 2 0 1 0 1\"", "Extent=\"0 2 0 1 0 1\">" + points));
  ASSERT_EQ(grid.elements.size(), 2U);
  EXPECT_EQ(grid.elements.kind(1), ElementKind::Hexahedron);
  EXPECT_THAT(corners(grid, 1), ElementsAre(1, 2, 5, 4, 7, 8, 11, 10));
  EXPECT_EQ(grid.positions[4], (Vec3{1, 1.5, 0}));
  EXPECT_THAT(grid.fields[0].values, ElementsAre(4, 7));
  EXPECT_THAT(grid.source->not_patchable(), HasSubstr("unstructured"));

  const std::string axes =
      "<Coordinates><DataArray type=\"Float32\">0 1 3</DataArray><DataArray type=\"Float64\">5</DataArray><DataArray type=\"Int8\">0 "
      "2</DataArray></Coordinates>";
  const Mesh upright = read_bytes("vtu", structured("RectilinearGrid", "WholeExtent=\"0 2 0 0 3 4\"", "Extent=\"0 2 0 0 3 4\">" + axes));
  EXPECT_EQ(upright.positions[5], (Vec3{3, 5, 2}));
  EXPECT_THAT(corners(upright, 1), ElementsAre(1, 2, 5, 4));

  const Mesh image = read_bytes(
      "vtu", structured("ImageData", "WholeExtent=\"1 3 0 1 0 0\" Origin=\"1 2 3\" Spacing=\"0.5 1 2\"", "Extent=\"1 3 0 1 0 0\">"));
  EXPECT_EQ(image.positions[0], (Vec3{1.5, 2, 3})) << "the extent begins at 1";
  EXPECT_EQ(image.positions[5], (Vec3{2.5, 3, 3}));
  EXPECT_EQ(image.elements.size(), 2U);

  for (const char* extent : {"0 100000 0 100000 0 9", "0 2 0 1", "0 2 0 1 0 x", "0 2 1 0 0 1", "0 2 0 0 0 0", "0 1e300 0 1 0 1"}) {
    const std::string bad = std::string("Extent=\"") + extent + "\">";
    EXPECT_THROW((void)read_bytes("vtu", structured("ImageData", "", bad)), InputError) << extent;
  }
  EXPECT_THROW((void)read_bytes("vtu", structured("StructuredGrid", "", "Extent=\"0 2 0 1 0 2\">" + points)), InputError);
}

TEST(Vtu, NumbersThatTouchTheirTagsAreReplaced) {
  const std::string bytes = with(sample("ascii"), "2.0 2.0 0.25 0.5\n<", "2.0 2.0 0.25 0.5<");
  const Mesh mesh = read_bytes("vtu", bytes);
  std::vector<Vec3> positions = mesh.positions;
  positions[9].z = 0.75;
  EXPECT_EQ(write_again(mesh, positions).bytes, with(bytes, "0.25 0.5<", "0.25 0.75<"));
}

TEST(Vtu, FloatsSayThatTheyRound) {
  for (const std::string name : {"base64", "raw_zlib", "appended_base64"}) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_bytes("vtu", sample(name));
    EXPECT_EQ(mesh.source->layout().scalar[0], CoordinateScalar::Float32);
    std::vector<Vec3> positions = mesh.positions;
    positions[0].x = 0.1;
    const Written written = write_again(mesh, positions);
    EXPECT_THAT(written.notes, ElementsAre(HasSubstr("1 moved coordinates were rounded to 32-bit")));
    EXPECT_EQ(read_bytes("vtu", written.bytes).positions[0].x, static_cast<double>(0.1F));
    positions[0].x = 1e300;
    EXPECT_THROW(write_again(mesh, positions), OutputError);
  }
}

TEST(Vtu, MadeAnewInTheDefaultEncoding) {
  const Mesh mesh = read_bytes("vtu", sample("ascii"));
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions) p = {p.x / 3, p.y / 7, p.z / 11};
  const Written written = write_anew("vtu", mesh, positions);
  EXPECT_THAT(written.notes, ElementsAre(HasSubstr("\"line cells\", \"face cells\"")));
  EXPECT_THAT(written.bytes, HasSubstr("header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\""));
  EXPECT_THAT(written.bytes, HasSubstr("<AppendedData encoding=\"raw\">"));
  EXPECT_THAT(written.bytes, HasSubstr("<PointData Scalars=\"depth\" Vectors=\"flow\">"));
  const Mesh again = read_bytes("vtu", written.bytes);
  EXPECT_NO_THROW(check_same(mesh, positions, again, true, true));
  ASSERT_EQ(again.fields.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(again.fields[i].name, mesh.fields[i].name);
    EXPECT_EQ(again.fields[i].values, mesh.fields[i].values);
    EXPECT_EQ(again.fields[i].type, mesh.fields[i].type);
    EXPECT_EQ(again.fields[i].role, mesh.fields[i].role);
  }
}

TEST(Vtu, FieldsWhoseTypeCannotHoldThemAreWrittenAsDoubles) {
  Mesh mesh = read_bytes("vtu", sample("ascii"));
  mesh.fields[0].values[3] = 0.1;  // "Float32"
  mesh.fields[2].values[0] = 2.5;  // "Int32"
  mesh.fields[1].name = "a \"quoted\" <name> & more";
  const Mesh again = read_bytes("vtu", write_anew("vtu", mesh, mesh.positions).bytes);
  EXPECT_EQ(again.fields[0].type, "Float64");
  EXPECT_EQ(again.fields[0].values, mesh.fields[0].values);
  EXPECT_EQ(again.fields[2].values, mesh.fields[2].values);
  EXPECT_EQ(again.fields[1].name, mesh.fields[1].name);
  EXPECT_EQ(again.fields[1].role, "VECTORS");
}

TEST(Vtu, WhatIsNotReadIsNamed) {
  std::string bytes = sample("ascii");
  bytes = with(bytes, "<UnstructuredGrid>\n",
               "<UnstructuredGrid>\n<!-- hello -->\n<FieldData><DataArray type=\"Float64\" Name=\"TIME\" NumberOfTuples=\"1\" "
               "format=\"ascii\">1.5</DataArray></FieldData>\n");
  bytes = with(bytes, "<CellData>\n", "<CellData>\n<Array type=\"String\" Name=\"names\" format=\"ascii\">65 0</Array>\n");
  bytes =
      with(bytes, "Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n",
           "Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\">\n<InformationKey name=\"L2_NORM_RANGE\" location=\"vtkDataArray\" "
           "length=\"2\"><Value index=\"0\">0</Value></InformationKey>\n");
  bytes = with(bytes, "</Cells>\n", "</Cells>\n<Extra/>\n");
  const Mesh mesh = read_bytes("vtu", bytes);
  EXPECT_EQ(mesh.positions[9], (Vec3{2, 0.25, 0.5}));
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("Extra")));
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("TIME")));
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("\"names\"")));
  EXPECT_THAT(mesh.source->only_in_file(), Contains("comments"));
  EXPECT_NO_THROW(check_patch("vtu", mesh));
}

TEST(Vtu, PointsThatCannotBeReplacedAreMadeAnewAndSaySo) {
  const Mesh whole = read_bytes("vtu", with(sample("ascii"), "Float64\" Name=\"Points", "Int32\" Name=\"Points"));
  EXPECT_THAT(whole.source->not_patchable(), HasSubstr("whole numbers"));
  const Mesh mixed = read_bytes("vtu", with(sample("pieces_ascii"), "Float32\" Name=\"Points", "Int32\" Name=\"Points"));
  EXPECT_THAT(mixed.source->not_patchable(), HasSubstr("different ways"));
  for (const std::string name : {"raw", "raw_zlib", "appended_base64_zlib"}) {
    std::string bytes = sample(name);
    const std::size_t points = bytes.find("offset=\"", bytes.find("Name=\"Points\"")) + 8;
    const std::string offset = bytes.substr(points, bytes.find('"', points) - points);
    bytes = with(bytes, "<CellData>", "<CellData><Array type=\"String\" Name=\"s\" format=\"appended\" offset=\"" + offset + "\"/>");
    const Mesh shared = read_bytes("vtu", bytes);
    EXPECT_THAT(shared.source->not_patchable(), HasSubstr("share")) << name;
    EXPECT_THAT(shared.source->only_in_file(), Contains(HasSubstr("\"s\"")));
  }
}

TEST(Vtu, HigherOrderCellsAreRefusedByNameWithTheCell) {
  for (const auto& [type, name] : std::vector<std::pair<std::string, std::string>>{
           {"24", "quadratic tetrahedron"}, {"71", "Lagrange tetrahedron"}, {"79", "Bezier hexahedron"}}) {
    expect_refused(with(sample("ascii"), "12 3 14 9 10", "12 3 14 9 " + type), 30, "cell 4: cells of type " + type + " (" + name + ")");
  }
  expect_refused(with(sample("ascii"), "12 3 14 9 10", "12 3 14 9 42"), 30, "polyhedron");
}

TEST(Vtu, RefusesMalformedFilesWithTheLine) {
  struct Malformed {
    std::string from, to;
    std::size_t line;
    std::string says;
  };
  const std::vector<Malformed> cases{
      {"<VTKFile type=\"UnstructuredGrid\"", "<VTKFile type=\"PolyData\"", 2, "PolyData"},
      {"<VTKFile type=\"UnstructuredGrid\"", "<VTKFile type=\"PUnstructuredGrid\"", 2, "pieces"},
      {"LittleEndian", "MiddleEndian", 2, "MiddleEndian"},
      {"header_type=\"UInt64\"", "header_type=\"UInt16\"", 2, "UInt16"},
      {"NumberOfPoints=\"10\"", "NumberOfPoints=\"-10\"", 4, "-10"},
      {"NumberOfPoints=\"10\"", "NumberOfPoints=\"99999999999\"", 4, "99999999999"},
      {"NumberOfPoints=\"10\"", "NumberOfPoints=\"4000000000\"", 19, "do not fit"},
      {"NumberOfPoints=\"10\"", "NumberOfPoints=\"11\"", 19, "30 numbers, not 33"},
      {"NumberOfPoints=\"10\"", "NumberOfPoints=\"9\"", 20, "more than the 27 numbers"},
      {"NumberOfCells=\"7\"", "NumberOfCells=\"8\"", 27, "7 numbers, not 8"},
      {"Name=\"Points\" NumberOfComponents=\"3\"", "Name=\"Points\" NumberOfComponents=\"2\"", 19, "3 coordinates, not 2"},
      {"Float64\" Name=\"Points\"", "Float63\" Name=\"Points\"", 19, "Float63"},
      {"2.0 0.25 0.5\n</", "2.0 nan 0.5\n</", 19, "coordinate of point 9"},
      {"2.0 0.25 0.5\n</", "2.0 zero 0.5\n</", 20, "zero"},
      {"2.0 0.25 0.5\n</", "2.0 <!-- --> 0.25 0.5\n</", 19, "several parts"},
      {"4 5 6 7 8", "4 5 6 7 10", 24, "point 10, but there are 10 points"},
      {"4 5 6 7 8", "4 5 6 7 -1", 24, "point -1"},
      {"4 5 6 7 8", "4 5 6 7 8.5", 25, "8.5"},
      {"Name=\"types\"", "Name=\"kinds\"", 23, "need connectivity, offsets and types"},
      {"Int32\" Name=\"offsets\"", "Float32\" Name=\"offsets\"", 27, "whole-number"},
      {"8 10 15 19", "8 10 9 19", 27, "do not fall"},
      {"12 3 14", "12 3 13", 24, "cell 2: a cell of type 13"},
      {"12 3 14", "12 3 99", 30, "type 99"},
      {"7 8 9 10 11 12", "7 8 9 10 11", 14, "6 numbers, not 7"},
      {"format=\"ascii\"", "format=\"hex\"", 6, "hex"},
      {"</Cells>", "</Cell>", 33, "XML"},
  };
  for (const Malformed& one : cases) {
    SCOPED_TRACE(one.to);
    expect_refused(with(sample("ascii"), one.from, one.to), one.line, one.says);
  }
}

TEST(Vtu, RefusesWrongDataOfTheOtherEncodings) {
  expect_refused(with(sample("raw_zlib"), "vtkZLibDataCompressor", "vtkLZ4DataCompressor"), 0, "compressed by vtkLZ4DataCompressor");
  expect_refused(with(sample("base64_zlib"), "vtkZLibDataCompressor", "vtkLZMADataCompressor"), 0, "compressed by vtkLZMADataCompressor");
  expect_refused(with(sample("raw"), "encoding=\"raw\"", "encoding=\"hex\""), 0, "hex");
  expect_refused(with(sample("raw"), "   _", "   -"), 0, "underscore");
  expect_refused(with(sample("raw"), "offset=\"0\"", "offset=\"123456\""), 6, "beyond the appended data");
  expect_refused(with(sample("raw"), "offset=\"0\"", "offset=\"1\""), 6, "bytes, but its numbers take 40");
  expect_refused(with(sample("raw"), "UInt32", "UInt64"), 17, "numbers take 28");
  expect_refused(with(sample("raw"), "NumberOfPoints=\"10\"", "NumberOfPoints=\"4000000000\""), 13,
                 "240 bytes, but its numbers take 96000000000");
  expect_refused(with(sample("base64"), "format=\"binary\">\n  ", "format=\"binary\">\n  *"), 6, "base64");
  const std::string raw = sample("raw");
  expect_refused(raw.substr(0, raw.find("   _") + 400), 13, "the data end");
  // Appended data is missing.
  expect_refused(with(with(sample("raw"), "<AppendedData", "<AppendedDatum"), "</AppendedData", "</AppendedDatum"), 0, "");
}

/// A compressed array that declares 240 MB in a few bytes: nothing may be allocated for it.
TEST(Vtu, DeclaredSizesAreCheckedBeforeTheyAreBelieved) {
  const auto file = [](std::uint64_t points, const std::string& blob) {
    return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n"
           "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
           std::to_string(points) +
           "\" NumberOfCells=\"0\">\n<Points>\n<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"appended\" "
           "offset=\"0\"/>\n</Points>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">_" +
           blob;
  };
  const auto blob = [](std::initializer_list<std::uint64_t> sizes) {
    std::string bytes;
    put<std::uint64_t>(bytes, false, sizes);
    return bytes + zlib_packed(std::string(1000, '\0'));
  };
  const std::uint64_t huge = 4'000'000'000;
  expect_refused(file(huge, blob({1, huge * 24, 0, 17})), 5, "does not unpack");
  expect_refused(file(huge, blob({huge * 24, 1, 0, 17})), 5, "more than the file holds");
  expect_refused(file(huge, blob({1, huge * 24, 0, ~0ULL})), 5, "more than the file holds");
  expect_refused(file(huge, blob({~0ULL, ~0ULL, 1})), 5, "numbers take");
  expect_refused(file(huge, blob({0, 0, 0})), 5, "numbers take");
  expect_refused(file(1, blob({1, 24, 0, 17})), 5, "does not unpack");
}

TEST(ZlibBlocks, GivesExactlyWhatIsAskedOrNothing) {
  std::vector<char> out{'x'};
  const std::string packed = zlib_packed("hello, hello, hello");
  EXPECT_FALSE(zlib_unpack(packed, 18, out));
  EXPECT_FALSE(zlib_unpack(packed, 20, out));
  EXPECT_FALSE(zlib_unpack(packed + "!", 19, out));
  EXPECT_FALSE(zlib_unpack(packed.substr(0, packed.size() - 1), 19, out));
  EXPECT_FALSE(zlib_unpack(packed, std::size_t{1} << 60, out));
  EXPECT_THAT(out, ElementsAre('x'));
  ASSERT_TRUE(zlib_unpack(packed, 19, out));
  EXPECT_EQ(std::string(out.begin(), out.end()), "xhello, hello, hello");
}

TEST(Vtu, ArraysThatShareTheirDataTakeNoMoreMemoryThanIsFine) {
  // 3072 bytes of data, that 40 arrays have in common: 983,040 bytes of numbers.
  std::string text =
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
      "0 0 0 1 0 0 0 1 0</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\">0 1 2</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\">3</DataArray><DataArray type=\"UInt8\" "
      "Name=\"types\">5</DataArray></Cells>\n<PointData>\n";
  for (int i = 0; i < 40; ++i)
    text +=
        "<DataArray type=\"UInt8\" Name=\"f" + std::to_string(i) + "\" NumberOfComponents=\"1024\" format=\"appended\" offset=\"0\"/>\n";
  text += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">_";
  put<std::uint32_t>(text, false, {3072});
  text += std::string(3072, '\7') + "</AppendedData>\n</VTKFile>\n";
  Progress progress;
  const auto read = [&](std::uint64_t most) {
    SourceFile source("a.vtu", FileBytes(text));
    return handler_of("vtu").read(source, {progress, nullptr, most});
  };
  EXPECT_EQ(read(983040).fields.size(), 40U);
  EXPECT_EQ(read(0).fields.size(), 40U) << "a hundred times as large is fine, and 256 MiB always";
  try {
    (void)read(983039);
    ADD_FAILURE() << "more than was said to be fine";
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), 46U);
    EXPECT_THAT(error.what(), HasSubstr("--max-memory"));
  }
}

TEST(Base64Reader, ReadsRunsOneAfterAnother) {
  // "a", "bcd" and "ef" (RFC 4648), each in a run of its own, with blanks within.
  Base64Reader reader("YQ==\n Ym\tNk ZWY=");
  std::vector<char> out;
  EXPECT_TRUE(reader.read(2, out));
  EXPECT_EQ(std::string(out.begin(), out.end()), "ab");
  EXPECT_FALSE(reader.read(5, out));
  EXPECT_EQ(out.size(), 2U);
}

TEST(Base64Reader, RefusesWhatIsNoBase64) {
  for (const std::string_view text : {"YQ=", "Y===", "=YQ=", "Y*==", "YQ=a", "YQ", ""}) {
    Base64Reader reader(text);
    std::vector<char> out;
    EXPECT_FALSE(reader.read(1, out)) << text;
    EXPECT_TRUE(out.empty());
  }
}

}  // namespace
}  // namespace dmoscope::testing
