// PVTU: a mesh is restored from its pieces, and pieces that do not fit are refused.

#include "core/io/pvtu/pvtu.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "tests/fuzz/check_reader.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope::testing {
namespace {

using ::testing::HasSubstr;

Notes write_pieces(const std::filesystem::path& path, const Mesh& mesh, std::size_t pieces) {
  Progress unwatched;
  IoContext context(unwatched);
  context.pieces = pieces;
  return write_mesh(path, mesh, mesh.positions, context);
}

Mesh read(const std::filesystem::path& path) {
  Progress unwatched;
  return read_mesh(path, unwatched);
}

void write_text(const std::filesystem::path& path, std::string_view text) { std::ofstream(path, std::ios::binary) << text; }

/// The message of the InputError of reading.
std::string refusal(const std::filesystem::path& path) {
  try {
    (void)read(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "read";
}

TEST(Pvtu, EverySampleComesBackFromAnyNumberOfPieces) {
  const test::TemporaryFolder folder;
  for (const Sample& sample : samples()) {
    const Mesh mesh = read_bytes(sample.format, sample.bytes);
    for (const std::size_t pieces : {1U, 2U, 3U, 100U}) {
      SCOPED_TRACE(sample.format + " " + sample.name + " in " + std::to_string(pieces));
      const Notes notes = write_pieces(folder / "a.pvtu", mesh, pieces);
      const Mesh again = read(folder / "a.pvtu");
      EXPECT_NO_THROW(check_same(mesh, mesh.positions, again, true, true));
      for (const Field& field : mesh.fields) {
        const auto same = [&](const Field& other) {
          return other.name == field.name && other.on == field.on &&
                 std::equal(other.values.begin(), other.values.end(), field.values.begin(), field.values.end(),
                            [](double a, double b) { return same_values(a, b); });
        };
        const bool named =
            std::any_of(notes.begin(), notes.end(), [&](const std::string& note) { return note.find(field.name) != std::string::npos; });
        EXPECT_TRUE(named || std::any_of(again.fields.begin(), again.fields.end(), same)) << field.name;
      }
    }
  }
}

TEST(Pvtu, ElementsAndVerticesKeepTheirOrder) {
  const test::TemporaryFolder folder;
  Progress unwatched;
  for (const char* name : {"coast", "solids", "tangled"}) {
    const Mesh mesh = generate_mesh(name, 500, 1, unwatched);
    write_pieces(folder / "a.pvtu", mesh, 7);
    const Mesh again = read(folder / "a.pvtu");
    EXPECT_EQ(again.positions, mesh.positions);
    EXPECT_TRUE(std::ranges::equal(again.elements.all_corners(), mesh.elements.all_corners()));
    EXPECT_TRUE(std::ranges::equal(again.elements.kinds(), mesh.elements.kinds()));
    EXPECT_TRUE(again.fields.empty() || again.fields.size() == mesh.fields.size());  // the ids are not among them
  }
}

TEST(Pvtu, VerticesOfNoElementStay) {
  const test::TemporaryFolder folder;
  Mesh mesh = read_bytes("off", "OFF\n5 1 0\n9 9 0\n0 0 0\n1 0 0\n0 1 0\n7 7 0\n3 1 2 3\n");
  write_pieces(folder / "a.pvtu", mesh, 1);
  EXPECT_EQ(read(folder / "a.pvtu").positions, mesh.positions);
}

TEST(Pvtu, NoPieceTakesThePlaceOfWhatWasRead) {
  const test::TemporaryFolder folder;
  Progress unwatched;
  const Mesh made = generate_mesh("coast", 300, 1, unwatched);
  write_mesh(folder / "a_0.vtu", made, made.positions, unwatched);
  const Mesh mesh = read(folder / "a_0.vtu");
  EXPECT_THROW(write_pieces(folder / "a.pvtu", mesh, 2), OutputError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.pvtu"));
  write_pieces(folder / "b.pvtu", mesh, 2);
  const Mesh pieces = read(folder / "b.pvtu");
  write_pieces(folder / "b.pvtu", pieces, 3);  // overwrites the file itself
  std::filesystem::copy_file(folder / "b.pvtu", folder / "c.pvtu");
  EXPECT_THROW(write_pieces(folder / "b.pvtu", read(folder / "c.pvtu"), 2), OutputError);
}

/// Two triangles on an edge; `ids`: arrays of the second piece.
std::string piece(const char* points, const char* cells, const std::string& point_data, const std::string& cell_data) {
  return std::string("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><PointData>") +
         point_data + "</PointData><CellData>" + cell_data +
         "</CellData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" + points +
         "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">" + cells +
         "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
         "format=\"ascii\">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}
std::string array(const char* name, const char* values) {
  return std::string("<DataArray type=\"Int64\" Name=\"") + name + "\" format=\"ascii\">" + values + "</DataArray>";
}
constexpr const char* kFirst = "0 0 0 1 0 0 1 1 0";
constexpr const char* kSecond = "0 0 0 1 1 0 0 1 0";
constexpr const char* kTwo =
    "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"p.vtu\"/><Piece "
    "Source=\"q.vtu\"/></PUnstructuredGrid></VTKFile>";

TEST(Pvtu, WithoutIdsVerticesAreJoinedByTheirPlaces) {
  const test::TemporaryFolder folder;
  write_text(folder / "a.pvtu", kTwo);
  write_text(folder / "p.vtu", piece(kFirst, "0 1 2", "", ""));
  write_text(folder / "q.vtu", piece(kSecond, "0 1 2", "", ""));
  const Mesh mesh = read(folder / "a.pvtu");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_THAT(mesh.elements.all_corners(), ::testing::ElementsAre(0, 1, 2, 0, 2, 3));
}

TEST(Pvtu, IdsGiveTheOrderAndGhostsAreLeftOut) {
  const test::TemporaryFolder folder;
  write_text(folder / "a.pvtu", kTwo);
  write_text(folder / "p.vtu",
             piece(kFirst, "0 1 2", array("GlobalNodeIds", "30 20 10"), array("GlobalCellIds", "8") + array("vtkGhostType", "0")));
  write_text(folder / "q.vtu",
             piece(kSecond, "0 1 2", array("GlobalNodeIds", "30 10 40"), array("GlobalCellIds", "3") + array("vtkGhostType", "0")));
  Mesh mesh = read(folder / "a.pvtu");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3>{{1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}}));
  EXPECT_THAT(mesh.elements.all_corners(), ::testing::ElementsAre(2, 0, 3, 2, 1, 0));
  write_text(folder / "q.vtu",
             piece(kSecond, "0 1 2", array("GlobalNodeIds", "30 10 40"), array("GlobalCellIds", "3") + array("vtkGhostType", "1")));
  mesh = read(folder / "a.pvtu");
  EXPECT_EQ(mesh.elements.size(), 1U);
}

TEST(Pvtu, WhatDoesNotFitIsRefused) {
  const test::TemporaryFolder folder;
  const auto path = folder / "a.pvtu";
  write_text(path, kTwo);
  write_text(folder / "p.vtu", piece(kFirst, "0 1 2", array("GlobalNodeIds", "0 1 2"), ""));
  EXPECT_THAT(refusal(path), HasSubstr("q.vtu"));
  write_text(folder / "q.vtu", piece("0 0 0 1 1.5 0 0 1 0", "0 1 2", array("GlobalNodeIds", "0 2 3"), ""));
  EXPECT_THAT(refusal(path), HasSubstr("pieces disagree on where vertex 2 stands"));
  write_text(folder / "q.vtu", piece(kSecond, "0 1 2", array("GlobalNodeIds", "0 2 -3"), ""));
  EXPECT_THAT(refusal(path), HasSubstr("ids are whole numbers from 0 on"));
  write_text(folder / "q.vtu", "no file at all");
  EXPECT_THAT(refusal(path), HasSubstr("q.vtu"));
  write_text(path, "<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n</PUnstructuredGrid></VTKFile>");
  EXPECT_THAT(refusal(path), HasSubstr("it names no pieces"));
  write_text(path, "<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n<Piece/></PUnstructuredGrid></VTKFile>");
  EXPECT_THAT(refusal(path), HasSubstr("a.pvtu:3: a Piece without a Source"));
  write_text(path, "<VTKFile type=\"PUnstructuredGrid\">\n<PUnstructuredGrid>\n<Piece Source=");
  EXPECT_THAT(refusal(path), HasSubstr("not well-formed"));
  // A piece that names the file itself must not be followed for ever.
  write_text(path, "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid><Piece Source=\"a.pvtu\"/></PUnstructuredGrid></VTKFile>");
  EXPECT_THAT(refusal(path), HasSubstr("is no .vtu"));
}

}  // namespace
}  // namespace dmoscope::testing
