// Meshes by the library's public headers alone: read, moved, and written in all formats.

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "dmoscope/dmoscope.h"
#include "tests/library/arrays.h"

namespace {

using namespace dmoscope_test;

TEST(Library, FilesAreReadAndWritten) {
  const std::string path = ::testing::TempDir() + "/library_test.vtk", wrong = ::testing::TempDir() + "/library_test_wrong.off";
  const dmo::Mesh mesh = solids().mesh();
  EXPECT_TRUE(mesh.write(path).empty());
  const dmo::Mesh again = dmo::Mesh::read(path);
  EXPECT_EQ(std::memcmp(again.positions(), mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
  EXPECT_EQ(std::vector(again.cells().connectivity, again.cells().connectivity + 36),
            std::vector(mesh.cells().connectivity, mesh.cells().connectivity + 36));
  EXPECT_THROW(mesh.write(::testing::TempDir() + "/no/such/folder.vtk"), dmo::OutputError);
  EXPECT_THROW(mesh.write(path + ".nothing"), dmo::UsageError);
  std::ofstream(wrong) << "OFF\n3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n";
  try {
    (void)dmo::Mesh::read(wrong);
    ADD_FAILURE();
  } catch (const dmo::InputError& error) {
    EXPECT_EQ(error.file(), wrong);
    EXPECT_EQ(error.line(), 5U);
  }
}

/// Triangles whose coordinates every format holds exactly: multiples of 1/64.
Arrays coarse_sheet(dmo::Index n) {
  const Arrays from = sheet(n);
  Arrays arrays;
  for (std::size_t i = 0; i < from.positions.size(); ++i)
    arrays.positions.push_back(i % 3 == 2 ? 0.0 : std::round(from.positions[i] * 64) / 64);
  for (std::size_t c = 0; c < from.kinds.size(); ++c) {
    const dmo::Index* at = from.connectivity.data() + from.offsets[c];
    arrays.add(dmo::CellKind::Triangle, {at[0], at[1], at[2]});
    if (from.kinds[c] == dmo::CellKind::Quadrilateral) arrays.add(dmo::CellKind::Triangle, {at[0], at[2], at[3]});
  }
  return arrays;
}

TEST(Library, NewPlacesAreWrittenInTheFilesOwnFormat) {
  const Arrays arrays = coarse_sheet(8);
  const std::string folder = ::testing::TempDir() + "/library_places";
  for (const std::string extension :
       {".off", ".obj", ".ply", ".stl", ".vtk", ".vtu", ".xdmf", ".14", ".su2", ".msh", ".mesh", ".node", ".inp", ".2dm", ".bdf"}) {
    SCOPED_TRACE(extension);
    (void)sheet_with_data(arrays).write(folder + extension);
    const dmo::Mesh read = dmo::Mesh::read(folder + extension);
    const std::size_t bytes = 3 * read.vertex_count() * sizeof(double);
    std::vector<double> places(read.positions(), read.positions() + 3 * read.vertex_count());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = i % 3 == 2 ? 0.0 : 2.0 * places[i] + 0.5;
    places[3 * 30] = read.positions()[3 * 30];  // one vertex that stays
    const dmo::Mesh moved = read.with_positions(places.data());
    const dmo::Smoothed smoothed = dmo::smooth(moved);
    EXPECT_NE(std::memcmp(smoothed.mesh.positions(), places.data(), bytes), 0);
    for (const dmo::Mesh& mesh :
         {moved, smoothed.mesh, dmo::Mesh::from_bytes(moved.to_bytes()), smoothed.mesh.with_positions(places.data())}) {
      const std::vector<std::string> told = mesh.write(folder + "_new" + extension);
      const dmo::Mesh written = dmo::Mesh::read(folder + "_new" + extension);
      ASSERT_EQ(written.vertex_count(), read.vertex_count());
      const bool rounded = !told.empty() && told[0].find("rounded") != std::string::npos;  // only by formats with few digits
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < places.size(); ++i)
        wrong += std::abs(written.positions()[i] - mesh.positions()[i]) <= (rounded ? 1e-5 : 0.0) ? 0 : 1;
      EXPECT_EQ(wrong, 0U);
      EXPECT_TRUE(!rounded || extension == ".bdf");
      ASSERT_EQ(written.cell_data().size(), read.cell_data().size());
      for (std::size_t k = 0; k < read.cell_data().size(); ++k) EXPECT_EQ(written.cell_data()[k].values, read.cell_data()[k].values);
      ASSERT_EQ(written.point_data().size(), read.point_data().size());
      ASSERT_EQ(written.groups().size(), read.groups().size());
      for (std::size_t k = 0; k < read.groups().size(); ++k) EXPECT_EQ(written.groups()[k].cells, read.groups()[k].cells);
    }
  }
}

/// A CalculiX text named .msh is written in its own format.
TEST(Library, NewPlacesAreWrittenUnderAnotherFormatsExtension) {
  const std::string folder = ::testing::TempDir() + "/library_other";
  (void)sheet_with_data(coarse_sheet(8)).write(folder + ".inp");
  std::filesystem::rename(folder + ".inp", folder + ".msh");
  const dmo::Mesh read = dmo::Mesh::read(folder + ".msh");
  std::vector<double> places(read.positions(), read.positions() + 3 * read.vertex_count());
  for (double& x : places) x = 2.0 * x;
  (void)read.with_positions(places.data()).write(folder + "_new.msh");
  const dmo::Mesh written = dmo::Mesh::read(folder + "_new.msh");
  ASSERT_EQ(written.vertex_count(), read.vertex_count());
  EXPECT_EQ(std::memcmp(written.positions(), places.data(), places.size() * sizeof(double)), 0);
}

}  // namespace
