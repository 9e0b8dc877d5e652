// Every kind of volume element from every format that holds it to every other: each format numbers corners by its own rule, and a file that
// breaks it is inside out for its readers.

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"
#include "tests/io/files.h"
#include "tests/io/meshio.h"

namespace dmoscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A wedge, a cube, a tetrahedron and a pyramid, apart from each other, of volumes 1/2, 1, 1/6 and 1/3.
constexpr std::array<const char*, 23> kPoints{"0 0 0", "1 0 0", "0 1 0", "0 0 1", "1 0 1", "0 1 1", "2 0 0",    "3 0 0",
                                              "3 1 0", "2 1 0", "2 0 1", "3 0 1", "3 1 1", "2 1 1", "4 0 0",    "5 0 0",
                                              "4 1 0", "4 0 1", "6 0 0", "7 0 0", "7 1 0", "6 1 0", "6.5 0.5 1"};

std::string points(bool numbered) {
  std::string text;
  for (std::size_t i = 0; i < kPoints.size(); ++i) text += (numbered ? std::to_string(i + 1) + " " : "") + kPoints[i] + "\n";
  return text;
}

struct HandWritten {
  const char* name;
  std::string bytes;
  std::vector<const char*> lines;  // the elements' lines, which other formats' meshes must become in this one
};

/// Hand-written files. The normal of the first triangle of VTK's wedge (0, 1, 2), (3, 4, 5) points away from the other triangle, that of
/// Gmsh's and MEDIT's wedge towards it.
std::vector<HandWritten> files() {
  const std::string vtk_cells = "6 0 2 1 3 5 4\n8 6 7 8 9 10 11 12 13\n4 14 15 16 17\n5 18 19 20 21 22\n";
  std::vector<HandWritten> all{
      {"a.vtk",
       "# vtk DataFile Version 3.0\nsolids\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 23 double\n" + points(false) + "CELLS 4 27\n" +
           vtk_cells + "CELL_TYPES 4\n13\n12\n10\n14\n",
       {"\n6 0 2 1 3 5 4\n", "\n8 6 7 8 9 10 11 12 13\n", "\n4 14 15 16 17\n", "\n5 18 19 20 21 22\n"}},
      {"a.su2",
       "NDIME= 3\nNELEM= 4\n13 0 2 1 3 5 4\n12 6 7 8 9 10 11 12 13\n10 14 15 16 17\n14 18 19 20 21 22\nNPOIN= 23\n" + points(false),
       {"\n13 0 2 1 3 5 4 ", "\n12 6 7 8 9 10 11 12 13 ", "\n10 14 15 16 17 ", "\n14 18 19 20 21 22 "}},
      {"a.msh",
       "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n23\n" + points(true) +
           "$EndNodes\n$Elements\n4\n1 6 2 0 1 1 2 3 4 5 6\n2 5 2 0 1 7 8 9 10 11 12 13 14\n3 4 2 0 1 15 16 17 18\n"
           "4 7 2 0 1 19 20 21 22 23\n$EndElements\n",
       {" 6 2 0 1 1 2 3 4 5 6\n", " 5 2 0 1 7 8 9 10 11 12 13 14\n", " 4 2 0 1 15 16 17 18\n", " 7 2 0 1 19 20 21 22 23\n"}},
      {"a.mesh",
       "MeshVersionFormatted 2\nDimension\n3\nVertices\n23\n" +
           [] {
             std::string text;
             for (const char* p : kPoints) text += std::string(p) + " 0\n";
             return text;
           }() +
           "Prisms\n1\n1 2 3 4 5 6 0\nHexahedra\n1\n7 8 9 10 11 12 13 14 0\nTetrahedra\n1\n15 16 17 18 0\nPyramids\n1\n19 20 21 22 23 "
           "0\nEnd\n",
       {"\n1 2 3 4 5 6 0\n", "\n7 8 9 10 11 12 13 14 0\n", "\n15 16 17 18 0\n", "\n19 20 21 22 23 0\n"}}};
  if (format_by_extension(".vtu") != nullptr) {
    all.push_back(
        {"a.vtu",
         "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"23\" NumberOfCells=\"4\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">" +
             points(false) +
             "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1 3 5 4 6 7 8 9 10 "
             "11 12 13 14 15 16 17 18 19 20 21 22</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">6 14 18 "
             "23</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">13 12 10 14</DataArray></Cells></Piece>"
             "</UnstructuredGrid></VTKFile>\n",
         {}});
  }
  return all;
}

std::vector<double> volumes(const Mesh& mesh) {
  std::vector<double> of_all;
  for (Index e = 0; e < mesh.elements.size(); ++e) of_all.push_back(signed_volume(mesh, e));
  return of_all;
}

TEST(VolumeElements, ArePositiveHereAndByTheRuleOfEveryFormat) {
  const auto all = files();
  for (const HandWritten& from : all) {
    SCOPED_TRACE(from.name);
    const Mesh mesh = read_bytes(from.name, from.bytes);
    EXPECT_THAT(volumes(mesh),
                ElementsAre(testing::DoubleEq(0.5), testing::DoubleEq(1.0), testing::DoubleEq(1.0 / 6.0), testing::DoubleEq(1.0 / 3.0)));
    EXPECT_EQ(written(from.name, mesh), from.bytes) << "its own format keeps it";
    for (const HandWritten& to : all) {
      if (to.name == std::string(from.name)) continue;
      SCOPED_TRACE(std::string("to ") + to.name);
      const std::string bytes = written(to.name, mesh);
      for (const char* line : to.lines) EXPECT_THAT(bytes, HasSubstr(line));
      EXPECT_EQ(volumes(read_bytes(to.name, bytes)), volumes(mesh));
    }
  }
}

TEST(VolumeElements, AnIndependentReaderFindsThemWoundAsEachFormatSays) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths;
  for (const HandWritten& from : files()) {
    const Mesh mesh = read_bytes(from.name, from.bytes);
    for (const HandWritten& to : files()) {
      paths.push_back(folder / (std::string(from.name).substr(2) + "-" + to.name));
      put(paths.back(), written(to.name, mesh));
    }
  }
  const auto found = read_by_meshio(paths);
  if (!found) GTEST_SKIP() << "python3-meshio is not here";
  for (std::size_t i = 0; i < paths.size(); ++i) {
    SCOPED_TRACE(paths[i].filename().string());
    const std::string extension = paths[i].extension().string();
    auto sizes = (*found)[i].sizes;
    EXPECT_EQ((*found)[i].points, 23U);
    // meshio converts wedges of VTK's files to Gmsh's order, as we do; those of SU2's it leaves in VTK's, which is inside out there.
    EXPECT_NEAR(sizes["wedge"], extension == ".su2" ? -0.5 : 0.5, 1e-12);
    EXPECT_NEAR(sizes["hexahedron"], 1.0, 1e-12);
    EXPECT_NEAR(sizes["tetra"], 1.0 / 6.0, 1e-12);
    EXPECT_NEAR(sizes["pyramid"], 1.0 / 3.0, 1e-12);
  }
}

/// A cube of two wedges: in VTK's own order nothing is inside out; in Gmsh's, which many programs write, both are, and only then the
/// program says so.
TEST(VolumeElements, AreInsideOutOnlyWhereTheyAre) {
  const std::string head = "NDIME= 3\nNPOIN= 8\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nNELEM= 2\n";
  const auto flipped = [&](const std::string& elements) {
    Mesh mesh = read_bytes("a.su2", head + elements);
    return normalise_orientation(mesh, FaceNeighbours(mesh)).flipped;
  };
  EXPECT_EQ(flipped("13 0 2 1 4 6 5\n13 0 3 2 4 7 6\n"), 0U);
  EXPECT_EQ(flipped("13 0 1 2 4 5 6\n13 0 2 3 4 6 7\n"), 2U);
}

}  // namespace
}  // namespace dmoscope::test
