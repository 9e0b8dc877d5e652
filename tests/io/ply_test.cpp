// PLY: every encoding, any order of properties, errors with their line.

#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/fuzz/check_reader.h"
#include "tests/fuzz/samples.h"

namespace dmoscope::testing {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Ply, AsciiWithPropertiesInAnyOrder) {
  const Mesh mesh = read_bytes("ply", ply_ascii());
  EXPECT_EQ(mesh.title, "a small mesh");
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[1], (Vec3{1, 0, 0}));
  EXPECT_EQ(mesh.positions[5], (Vec3{2, 1, -0.5}));
  ASSERT_EQ(mesh.elements.size(), 3U);
  EXPECT_EQ(mesh.elements.kind(2), ElementKind::Quadrilateral);
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0].name, "red");
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(255, 0, 1, 2, 3, 4));
  EXPECT_EQ(mesh.fields[1].on, Field::On::Elements);
  EXPECT_TRUE(std::isnan(mesh.fields[1].values[1]));
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("edge")));
}

TEST(Ply, BinaryOfBothByteOrdersWithFacesFirst) {
  for (const bool big : {false, true}) {
    const Mesh mesh = read_bytes("ply", ply_binary(big));
    ASSERT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.positions[2], (Vec3{1, 1.25, 0.2}));
    ASSERT_EQ(mesh.elements.size(), 2U);
    EXPECT_THAT(mesh.elements.corners(1), ElementsAre(0, 2, 3));
    ASSERT_EQ(mesh.fields.size(), 1U);
    EXPECT_THAT(mesh.fields[0].values, ElementsAre(-7, -7));
  }
}

TEST(Ply, UnmovedVerticesKeepTheirCharacters) {
  const Mesh mesh = read_bytes("ply", ply_ascii());
  std::vector<Vec3> positions = mesh.positions;
  positions[1].x = 1.25;  // written "1.0" after y = "0"
  std::string expected = ply_ascii();
  expected.replace(expected.find("0 0 1.0 0\n"), 10, "0 0 1.25 0\n");
  EXPECT_EQ(write_again(mesh, positions).bytes, expected);
}

TEST(Ply, BinaryReplacesOnlyTheCoordinatesThatMoved) {
  for (const bool big : {false, true}) {
    const Mesh mesh = read_bytes("ply", ply_binary(big));
    std::vector<Vec3> positions = mesh.positions;
    positions[3] = {0.1, 0.1, -1e300};  // x and z are doubles in this file, y is a float
    const Written written = write_again(mesh, positions);
    EXPECT_THAT(written.notes, ElementsAre(HasSubstr("32-bit")));
    const Mesh again = read_bytes("ply", written.bytes);
    EXPECT_EQ(again.positions[3], (Vec3{0.1, static_cast<double>(0.1F), -1e300}));
    std::size_t changed = 0;
    for (std::size_t i = 0; i < written.bytes.size(); ++i) changed += written.bytes[i] != mesh.source->bytes()[i] ? 1U : 0U;
    EXPECT_LE(changed, 20U);
    EXPECT_EQ(written.bytes.size(), mesh.source->bytes().size());
  }
}

TEST(Ply, WholeNumberCoordinatesAreMadeAnew) {
  const Mesh mesh = read_bytes("ply",
                               "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\nelement face 1\n"
                               "property list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_THAT(mesh.source->not_patchable(), HasSubstr("whole numbers"));
}

TEST(Ply, NewFileKeepsRandomDoublesBitwise) {
  std::mt19937_64 random(11);
  Mesh mesh;
  mesh.title = "random";
  for (int i = 0; i < 400; ++i) {
    std::array<double, 3> p{};
    for (double& c : p) {
      do c = std::bit_cast<double>(random());
      while (!std::isfinite(c));
    }
    mesh.positions.push_back({p[0], p[1], p[2]});
  }
  for (Index e = 0; e < 100; ++e) mesh.elements.add(ElementKind::Quadrilateral, std::vector<Index>{4 * e, 4 * e + 1, 4 * e + 2, 4 * e + 3});
  const Mesh again = read_bytes("ply", write_anew("ply", mesh, mesh.positions).bytes);
  EXPECT_NO_THROW(check_same(mesh, mesh.positions, again, true, true));
  EXPECT_EQ(again.title, "random");
}

TEST(Ply, NewFileNamesWhatItDropsAndRenames) {
  Mesh mesh = read_bytes("vtk", vtk_ascii());
  mesh.fields[0].name = "x";
  const Written written = write_anew("ply", mesh, mesh.positions);
  EXPECT_THAT(written.notes, Contains(HasSubstr("\"x_\"")));
  EXPECT_THAT(written.notes, Contains(HasSubstr("flow")));
  const Mesh again = read_bytes("ply", written.bytes);
  ASSERT_EQ(again.fields.size(), 2U);  // x_ and id; fields of several components are dropped
  EXPECT_EQ(again.fields[0].values, mesh.fields[0].values);
  EXPECT_EQ(again.fields[1].type, "int");
}

TEST(Ply, RefusesVolumeElements) {
  const Mesh mesh = read_bytes("vtk", vtk_volume());
  EXPECT_THROW(write_anew("ply", mesh, mesh.positions), OutputError);
}

TEST(Ply, RefusesMalformedFilesWithTheLine) {
  struct Malformed {
    std::string from, to;
    std::size_t line;
    std::string says;
  };
  const std::vector<Malformed> cases{
      {"ply\n", "plx\n", 1, "ply"},
      {"format ascii 1.0", "format ascii 2.0", 2, "2.0"},
      {"format ascii 1.0", "format text 1.0", 2, "text"},
      {"format ascii 1.0\n", "", 14, "format"},
      {"element vertex 6", "element vertex", 4, "line ends"},
      {"element vertex 6", "element vertex -6", 4, "negative"},
      {"element vertex 6", "element vertices 6", 15, "vertex"},
      {"element vertex 6", "element vertex 5", 21, "-0.5"},
      {"property double y", "property dubble y", 6, "dubble"},
      {"property double y", "property double w", 4, "\"y\""},
      {"property double y", "property double x", 7, "second property"},
      {"list uchar int", "list float int", 10, "whole numbers"},
      {"vertex_indices", "corners", 9, "vertex_indices"},
      {"1 1 1 0\n", "1 1 1\n", 18, "line ends"},
      {"1 1 1 0\n", "1 1 1 0 0\n", 18, "more numbers"},
      {"1 1 1 0\n", "1 1 nan 0\n", 18, "finite"},
      {"1 1 1 0\n", "1 1 a 0\n", 18, "\"a\""},
      {"3 0 2 3 nan", "3 0 2 6 nan", 23, "vertex 6"},
      {"3 0 2 3 nan", "3 0 2 -1 nan", 23, "vertex -1"},
      {"3 0 2 3 nan", "2 0 2 nan", 23, "2 corners"},
      {"4 1 4 5 2 1", "5 1 4 5 2 3 1", 24, "5 corners"},
      {"4 1 4 5 2 1", "-4 1 4 5 2 1", 24, "negative"},
      {"\n0 1\n", "\n", 12, "edge"},
      {"\n0 1\n", "\n0 1\n0 1\n", 26, "goes on"},
  };
  for (const Malformed& one : cases) {
    std::string bytes = ply_ascii();
    const std::size_t at = bytes.find(one.from);
    ASSERT_NE(at, std::string::npos) << one.from;
    bytes.replace(at, one.from.size(), one.to);
    try {
      read_bytes("ply", bytes);
      ADD_FAILURE() << one.to << " was read";
    } catch (const InputError& error) {
      EXPECT_EQ(error.line(), one.line) << one.to << ": " << error.what();
      EXPECT_THAT(error.what(), HasSubstr(one.says)) << one.to;
    }
  }
}

TEST(Ply, TruncatedBinarySaysWhere) {
  const std::string bytes = ply_binary(true);
  try {
    read_bytes("ply", bytes.substr(0, bytes.size() - 3));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), 0U);
    EXPECT_THAT(error.what(), HasSubstr("byte"));
  }
}

}  // namespace
}  // namespace dmoscope::testing
