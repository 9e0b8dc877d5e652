// Files of this program, read by an independent one.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"
#include "tests/io/meshio.h"

namespace dmoscope::test {
namespace {

/// A wedge, a cube, a tetrahedron and a pyramid, apart from each other, of volumes 1/2, 1, 1/6 and 1/3.
Mesh solids(bool pyramid) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {2, 0, 0},    {3, 0, 0},
                    {3, 1, 0}, {2, 1, 0}, {2, 0, 1}, {3, 0, 1}, {3, 1, 1}, {2, 1, 1}, {4, 0, 0},    {5, 0, 0},
                    {4, 1, 0}, {4, 0, 1}, {6, 0, 0}, {7, 0, 0}, {7, 1, 0}, {6, 1, 0}, {6.5, 0.5, 1}};
  mesh.elements.add(ElementKind::Wedge, std::vector<Index>{0, 1, 2, 3, 4, 5});
  mesh.elements.add(ElementKind::Hexahedron, std::vector<Index>{6, 7, 8, 9, 10, 11, 12, 13});
  mesh.elements.add(ElementKind::Tetrahedron, std::vector<Index>{14, 15, 16, 17});
  if (pyramid) mesh.elements.add(ElementKind::Pyramid, std::vector<Index>{18, 19, 20, 21, 22});
  mesh.groups.push_back({.name = "Box", .role = "", .code = 3, .dimension = 2, .members = {1}});
  return mesh;
}

TEST(Independent, VolumesOfFormatsWithGmshsOrder) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths;
  for (const std::string name : {"a.inp", "a.bdf", "a.xdmf"}) {
    if (format_by_extension(std::filesystem::path(name).extension().string()) == nullptr) continue;
    paths.push_back(folder / name);
    put(paths.back(), written(name, solids(name != "a.inp")));  // meshio does not know C3D5
  }
  const auto found = read_by_meshio(paths);
  if (!found) GTEST_SKIP() << "python3-meshio is not here";
  for (std::size_t i = 0; i < paths.size(); ++i) {
    SCOPED_TRACE(paths[i].filename().string());
    auto sizes = (*found)[i].sizes;
    const std::string extension = paths[i].extension().string();
    if (extension == ".xdmf" && (*found)[i].points == 0) continue;  // meshio needs python3-h5py for these
    EXPECT_EQ((*found)[i].points, 23U);
    EXPECT_NEAR(sizes["wedge"], 0.5, 1e-12);
    EXPECT_NEAR(sizes["hexahedron"], 1.0, 1e-12);
    EXPECT_NEAR(sizes["tetra"], 1.0 / 6.0, 1e-12);
    EXPECT_NEAR(sizes["pyramid"], extension == ".inp" ? 0.0 : 1.0 / 3.0, 1e-12);
  }
}

/// Two triangles and a quadrilateral in every format that meshio reads.
TEST(Independent, PlanarSamples) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1.5, 0}, {2, 0, 0}, {2, 1, 0}};
  mesh.elements.add(ElementKind::Triangle, std::vector<Index>{0, 1, 2});
  mesh.elements.add(ElementKind::Triangle, std::vector<Index>{0, 2, 3});
  mesh.elements.add(ElementKind::Quadrilateral, std::vector<Index>{1, 4, 5, 2});
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths;
  for (const char* name : {"a.inp", "a.bdf", "a.xdmf", "a.vtk", "a.vtu", "a.msh", "a.mesh", "a.su2"}) {
    if (format_by_extension(std::filesystem::path(name).extension().string()) == nullptr) continue;
    paths.push_back(folder / name);
    put(paths.back(), written(name, mesh));
  }
  const auto found = read_by_meshio(paths);
  if (!found) GTEST_SKIP() << "python3-meshio is not here";
  for (std::size_t i = 0; i < paths.size(); ++i) {
    SCOPED_TRACE(paths[i].filename().string());
    auto sizes = (*found)[i].sizes;
    if (paths[i].extension() == ".xdmf" && (*found)[i].points == 0) continue;
    EXPECT_EQ((*found)[i].points, 6U);
    EXPECT_NEAR(sizes["triangle"], 1.25, 1e-12);
    EXPECT_NEAR(sizes["quad"], 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace dmoscope::test
