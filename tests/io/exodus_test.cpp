// Exodus II. The files are made by netCDF4 (tests/fuzz/array_samples.py); their content is repeated here.

#include "core/io/exodus/exodus.h"

#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/orientation.h"
#include "tests/fuzz/array_samples.h"
#include "tests/io/files.h"
#include "tests/io/meshio.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<Index> corners_of_face(const Group& group, Index face) {
  const auto corners = group.faces.corners(face);
  return {corners.begin(), corners.end()};
}

const Group& group_named(const Mesh& mesh, std::string_view name) {
  for (const Group& group : mesh.groups) {
    if (group.name == name) return group;
  }
  throw std::out_of_range("no group " + std::string(name));
}

bool has_hdf5() { return format_by_extension(".cgns") != nullptr; }

TEST(Exodus, ClassicSolidsWithBlocksSetsAndTheLastTimeStep) {
  const Mesh mesh = read_bytes("a.e", testing::exodus_solids());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "");
  ASSERT_EQ(mesh.positions.size(), 23U);
  EXPECT_EQ(mesh.positions[22], (Vec3{6.5, 0.5, 1}));
  std::vector<double> volumes;
  for (Index e = 0; e < mesh.elements.size(); ++e) volumes.push_back(signed_volume(mesh, e));
  EXPECT_THAT(volumes, ElementsAre(DoubleEq(0.5), DoubleEq(1.0), DoubleEq(1.0 / 6.0), DoubleEq(1.0 / 3.0)));

  EXPECT_EQ(group_named(mesh, "wood").role, "element block");
  EXPECT_EQ(group_named(mesh, "wood").code, 7);
  EXPECT_THAT(group_named(mesh, "wood").members, ElementsAre(0));
  EXPECT_THAT(group_named(mesh, "element block 9").members, ElementsAre(1)) << "it has no name of its own";
  EXPECT_THAT(group_named(mesh, "rods").members, ElementsAre(1, 6, 7, 14)) << "two lines";
  EXPECT_THAT(group_named(mesh, "corners").members, ElementsAre(0, 22));
  EXPECT_EQ(group_named(mesh, "corners").dimension, 0);

  ASSERT_EQ(mesh.fields.size(), 3U);
  EXPECT_EQ(mesh.fields[0].name, "depth");
  EXPECT_EQ(mesh.fields[0].values[5], 2105.0);  // the third step
  EXPECT_EQ(mesh.fields[1].values[22], 2222.0);
  EXPECT_EQ(mesh.fields[2].name, "stress");
  EXPECT_EQ(mesh.fields[2].values[0], 20.25);
  EXPECT_TRUE(std::isnan(mesh.fields[2].values[1])) << "the other blocks have none";
  EXPECT_THAT(mesh.source->notes(), Contains(HasSubstr("the last of 3 time steps")));
}

/// Sides by the manual's numbers: 4 and 5 of a wedge are its triangles, 1 of a hexahedron is 1 2 6 5, 3 of a tetrahedron 1 4 3, 5 of a
/// pyramid its base; all are seen from outside.
TEST(Exodus, SidesOfEveryKindByTheManualsNumbers) {
  const Mesh mesh = read_bytes("a.e", testing::exodus_solids());
  const Group& skin = group_named(mesh, "skin");
  EXPECT_EQ(skin.role, "side set");
  ASSERT_EQ(skin.faces.size(), 5U);
  EXPECT_THAT(corners_of_face(skin, 0), ElementsAre(0, 2, 1));
  EXPECT_THAT(corners_of_face(skin, 1), ElementsAre(3, 4, 5));
  EXPECT_THAT(corners_of_face(skin, 2), ElementsAre(6, 7, 11, 10));
  EXPECT_THAT(corners_of_face(skin, 3), ElementsAre(14, 17, 16));
  EXPECT_THAT(corners_of_face(skin, 4), ElementsAre(18, 21, 20, 19));
  EXPECT_THAT(corners_of_face(group_named(mesh, "side set 6"), 0), ElementsAre(10, 11, 12, 13));
}

/// Every side of a convex element looks away from its middle.
TEST(Exodus, EverySideLooksOutward) {
  const Mesh mesh = read_bytes("a.e", testing::exodus_solids());
  int sides = 0;
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    Vec3 middle{};
    for (const Index c : corners) middle = middle + (1.0 / static_cast<double>(corners.size())) * mesh.positions[c];
    for (std::int64_t s = 1; s < 9; ++s) {
      const auto side = exodus_side(shape_of(mesh.elements.kind(e)), false, s);
      if (side.empty()) continue;
      ++sides;
      const Vec3 a = mesh.positions[corners[side[0]]], b = mesh.positions[corners[side[1]]], c = mesh.positions[corners[side[2]]];
      EXPECT_GT(dot(cross(b - a, c - a), a - middle), 0.0) << e << " side " << s;
    }
  }
  EXPECT_EQ(sides, 5 + 6 + 4 + 5);
}

TEST(Exodus, PlanarInOneArrayOfFloats) {
  const Mesh mesh = read_bytes("a.exo", testing::exodus_plane());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.source->layout().components, 2);
  EXPECT_TRUE(mesh.single_precision);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 0, 2, 3, 1, 4, 5, 2));
  EXPECT_THAT(group_named(mesh, "below").members, ElementsAre(0, 1, 1, 4));
  EXPECT_EQ(group_named(mesh, "below").dimension, 1);
}

/// Edges as libMesh writes them: a triangle that is a shell, though the file is planar, has its edges behind two faces.
TEST(Exodus, EdgesOfShellsInThePlane) {
  std::string plane = testing::exodus_plane();
  const std::string sides("\0\0\0\x01\0\0\0\x01", 8);  // elements 1 and 3
  ASSERT_TRUE(plane.ends_with(sides));
  const auto with_side = [&](char side) { return plane.substr(0, plane.size() - 8) + std::string("\0\0\0", 3) + side + sides.substr(4); };
  EXPECT_THAT(group_named(read_bytes("a.exo", with_side(3)), "below").members, ElementsAre(2, 0, 1, 4)) << "the third of three";
  EXPECT_THAT(group_named(read_bytes("a.exo", with_side(4)), "below").members, ElementsAre(1, 2, 1, 4)) << "the second";
  EXPECT_THAT(group_named(read_bytes("a.exo", with_side(5)), "below").members, ElementsAre(2, 0, 1, 4)) << "the third";
  expect_refused("a.exo", with_side(6), 0, "side set 1: element 1 has no side 6");
}

TEST(Exodus, NetCdf4AndShells) {
  if (!has_hdf5()) GTEST_SKIP() << "this build has no HDF5";
  const Mesh mesh = read_bytes("a.g", testing::exodus_netcdf4());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  ASSERT_EQ(mesh.groups.size(), 4U);
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(1));
  EXPECT_THAT(mesh.groups[2].members, ElementsAre(0, 1)) << "side 3 of a shell is its first edge";
  EXPECT_THAT(mesh.groups[3].members, ElementsAre(0)) << "side 1 of a shell is itself";
  EXPECT_TRUE(mesh.groups[3].of_elements());
}

TEST(Exodus, WhereItIsNotBuiltInTheWordsSayWhatToDo) {
  if (has_hdf5()) GTEST_SKIP() << "this build has HDF5";
  expect_refused("a.e", testing::exodus_netcdf4(), 0, "made without HDF5: convert");
}

/// Bytes of moved coordinates are the only ones that differ.
TEST(Exodus, WrittenAgainAClassicFileChangesOnlyWhereVerticesMoved) {
  const std::string bytes = testing::exodus_solids();
  const Mesh mesh = read_bytes("a.e", bytes);
  EXPECT_EQ(written("a.e", mesh), bytes);
  std::vector<Vec3> positions = mesh.positions;
  positions[4] = {-1e300, 0.1, 1.0 / 3.0};
  const std::string again = written("a.e", mesh, positions);
  ASSERT_EQ(again.size(), bytes.size());
  std::vector<std::size_t> differ;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] != again[i]) differ.push_back(i);
  }
  ASSERT_FALSE(differ.empty());
  const std::size_t x = differ.front() - differ.front() % 4;  // arrays begin at multiples of four
  for (const std::size_t at : differ) EXPECT_LT((at - x) % (23 * 8), 8U) << "x, y and z of one vertex, in three arrays of 23 doubles";
  expect_same_positions(positions, read_bytes("a.e", again).positions);
}

TEST(Exodus, WrittenAgainEveryKindHoldsTheSame) {
  std::vector<std::string> all{testing::exodus_solids(), testing::exodus_plane()};
  if (has_hdf5()) all.push_back(testing::exodus_netcdf4());
  for (const std::string& bytes : all) {
    const Mesh mesh = read_bytes("a.e", bytes);
    std::vector<Vec3> positions = mesh.positions;
    for (Vec3& p : positions) p = {p.x * 0.5 + 0.25, 3.0 - p.y, p.z * 2.0};  // exact in floats
    const Mesh again = read_bytes("a.e", written("a.e", mesh, positions));
    expect_same_positions(positions, again.positions);
    expect_same_elements(mesh, again);
    ASSERT_EQ(again.groups.size(), mesh.groups.size());
    ASSERT_EQ(again.fields.size(), mesh.fields.size());
  }
}

TEST(Exodus, WhatTheFileCannotHoldIsSaid) {
  const Mesh mesh = read_bytes("a.e", testing::exodus_plane());
  std::vector<Vec3> positions = mesh.positions;
  positions[0].x = 0.1;
  std::vector<std::string> notes;
  EXPECT_EQ(read_bytes("a.e", written("a.e", mesh, positions, &notes)).positions[0].x, static_cast<double>(0.1F));
  EXPECT_THAT(notes, Contains(HasSubstr("1 moved coordinates were rounded to 32-bit floats")));
  const TemporaryFolder folder;
  Progress progress;
  positions[0].z = 1.0;
  EXPECT_THROW((void)write_mesh(folder / "a.e", mesh, positions, progress), OutputError);
  positions[0] = {1e300, 0, 0};
  EXPECT_THROW((void)write_mesh(folder / "a.e", mesh, positions, progress), OutputError);
  Mesh other = mesh;
  other.source.reset();
  try {
    (void)write_mesh(folder / "a.e", other, mesh.positions, progress);
    ADD_FAILURE();
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("write it as .vtu"));
  }
}

std::string replaced_text(std::string bytes, std::string_view what, std::string_view by) {
  const std::size_t at = bytes.find(what);
  if (at == std::string::npos || what.size() != by.size()) throw std::out_of_range("not there: " + std::string(what));
  return bytes.replace(at, what.size(), by);
}

TEST(Exodus, Refused) {
  const std::string solids = testing::exodus_solids();
  expect_refused("a.e", replaced_text(solids, "HEX", "HXX"), 0, "element block 2 (\"element block 9\"): elements \"HXX\" with 8 nodes");
  expect_refused("a.e", replaced_text(solids, "PYRAMID", "NFACED1"), 0, "polyhedra");
  expect_refused("a.e", replaced_text(solids, "TETRA", "HEX20"), 0, "\"HEX20\" with 4 nodes are not read");
  expect_refused("a.e", replaced_text(solids, "num_dim", "num_dIm"), 0, "no Exodus file");
  expect_refused("a.e", replaced_text(solids, "coordz", "coordZ"), 0, "no array \"coordz\"");
  expect_refused("a.e", solids.substr(0, solids.size() - 400), 0, "truncated");
  // The connectivity of the tetrahedron: 15, 16, 17, 18.
  const std::string four("\0\0\0\x0f\0\0\0\x10\0\0\0\x11\0\0\0\x12", 16), bad("\0\0\0\x0f\0\0\0\x10\0\0\0\x11\0\0\0\x18", 16);
  expect_refused("a.e", replaced_text(solids, four, bad), 0, "node 24 out of range (the file has 23 nodes)");
  // Sides 4, 5, 1, 3, 5 of the side set: replaced by 9, which a pyramid lacks.
  const std::string sides("\0\0\0\x01\0\0\0\x03\0\0\0\x05", 12), nine("\0\0\0\x01\0\0\0\x03\0\0\0\x09", 12);
  expect_refused("a.e", replaced_text(solids, sides, nine), 0, "side set 1: element 4 has no side 9");
  expect_refused("a.e", "CDF\x01", 0, "this is a NetCDF file");
  expect_refused("a.e", "hello", 0, "no netCDF file");
}

TEST(Exodus, AnIndependentReaderFindsWhatWasWrittenAgain) {
  const TemporaryFolder folder;
  std::vector<std::filesystem::path> paths{folder / "a.e"};
  // Results of some blocks alone, which meshio cannot hold: they get unknown names.
  std::string bytes = replaced_text(testing::exodus_solids(), "name_elem_var", "nobodys_thing");
  bytes = replaced_text(bytes, "vals_elem_var1eb1", "nobodys_numbers_1");
  const Mesh mesh = read_bytes("a.e", bytes);
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions) p = {2.0 * p.x, 2.0 * p.y, 2.0 * p.z};
  put(paths[0], written("a.e", mesh, positions));
  if (has_hdf5()) {
    const Mesh shell = read_bytes("a.e", testing::exodus_netcdf4());
    positions = shell.positions;
    for (Vec3& p : positions) p = {2.0 * p.x, 2.0 * p.y, 0.0};
    paths.push_back(folder / "b.e");
    put(paths[1], written("b.e", shell, positions));
  }
  const auto found = read_by_meshio(paths);
  if (!found || (*found)[0].points == 0) GTEST_SKIP() << "python3-meshio or python3-netcdf4 is not here";
  auto sizes = (*found)[0].sizes;
  EXPECT_EQ((*found)[0].points, 23U);
  EXPECT_NEAR(sizes["wedge"], 8 * 0.5, 1e-12);
  EXPECT_NEAR(sizes["hexahedron"], 8 * 1.0, 1e-12);
  EXPECT_NEAR(sizes["tetra"], 8 / 6.0, 1e-12);
  EXPECT_NEAR(sizes["pyramid"], 8 / 3.0, 1e-12);
  if (has_hdf5()) {
    EXPECT_NEAR((*found)[1].sizes.at("quad"), 4 * 1.25, 1e-12);
  }
}

}  // namespace
}  // namespace dmoscope::test
