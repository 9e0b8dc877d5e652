// STL: equal corners become one vertex, a moved vertex is written to all its places, normals follow.

#include "core/io/polygons/stl.h"

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

TEST(Stl, EqualCornersAreOneVertex) {
  for (const std::string& bytes : {stl_ascii(), stl_binary()}) {
    const Mesh mesh = read_bytes("stl", bytes);
    EXPECT_EQ(mesh.positions.size(), 4U) << "-0.0 and 0.0 are the same";
    ASSERT_EQ(mesh.elements.size(), 2U);
    EXPECT_THAT(mesh.elements.corners(0), ElementsAre(0, 1, 2));
    EXPECT_THAT(mesh.elements.corners(1), ElementsAre(0, 2, 3));
  }
  EXPECT_EQ(read_bytes("stl", stl_ascii()).title, "two facets");
  EXPECT_EQ(read_bytes("stl", stl_binary()).title, "solid that is binary");
}

TEST(Stl, BinaryIsKnownBySizeNotByItsFirstWord) {
  EXPECT_TRUE(is_binary_stl(stl_binary()));
  EXPECT_FALSE(is_binary_stl(stl_ascii()));
  EXPECT_TRUE(recognises_stl(stl_binary()));
  EXPECT_TRUE(recognises_stl(stl_ascii()));
  EXPECT_FALSE(recognises_stl("solid ground\n2 4\n"));
}

TEST(Stl, AttributesAreAField) {
  const Mesh mesh = read_bytes("stl", stl_binary());
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(0, 31));
}

TEST(Stl, AMovedVertexMovesInAllItsFacets) {
  const Mesh mesh = read_bytes("stl", stl_ascii());
  std::vector<Vec3> positions = mesh.positions;
  positions[2] = {1.25, 1, 0};
  const std::string expected =
      "solid two facets\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 1.25 1 0\n  endloop\n endfacet\n"
      " FACET NORMAL 0 0 1\n  OUTER LOOP\n   VERTEX -0.0 0 0\n   VERTEX 1.25 1 0\n   VERTEX 0 1e0 0\n  ENDLOOP\n ENDFACET\nendsolid two "
      "facets\n";
  EXPECT_EQ(write_again(mesh, positions).bytes, expected);
}

TEST(Stl, FacetsThatDidNotMoveKeepTheirBytes) {
  const Mesh mesh = read_bytes("stl", stl_binary());
  std::vector<Vec3> positions = mesh.positions;
  positions[3] = {0.1, 2, 0};  // only in the second facet
  const Written written = write_again(mesh, positions);
  EXPECT_EQ(written.bytes.substr(0, 134), stl_binary().substr(0, 134));
  EXPECT_THAT(written.notes, Contains(HasSubstr("32-bit")));
  const Mesh again = read_bytes("stl", written.bytes);
  EXPECT_EQ(again.positions[3], (Vec3{static_cast<double>(0.1F), 2, 0}));
  // The normal of the triangle (0 0 0), (1 1 0.5), (0.1 2 0): -1 0.05 1.9 over its length.
  const double size = std::sqrt(1.0 + 0.05 * 0.05 + 1.9 * 1.9);
  EXPECT_FLOAT_EQ(load_number<float>(written.bytes.data() + 134, false), static_cast<float>(-1.0 / size));
  EXPECT_FLOAT_EQ(load_number<float>(written.bytes.data() + 138, false), static_cast<float>(0.05 / size));
  EXPECT_FLOAT_EQ(load_number<float>(written.bytes.data() + 142, false), static_cast<float>(1.9 / size));
}

TEST(Stl, VerticesThatFallTogetherAreNamed) {
  const Mesh mesh = read_bytes("stl", stl_binary());
  std::vector<Vec3> positions = mesh.positions;
  positions[3] = {1.0 + 1e-12, 1, 0.5};  // equal to vertex 2 in floats
  EXPECT_THAT(write_again(mesh, positions).notes, Contains(HasSubstr("1 vertices lie exactly where another one does")));
}

TEST(Stl, QuadrilateralsAreRefused) {
  const Mesh mesh = read_bytes("vtk", vtk_ascii());
  try {
    write_anew("stl", mesh, mesh.positions);
    FAIL();
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("quadrilaterals"));
    EXPECT_THAT(error.what(), HasSubstr("PLY"));
  }
}

TEST(Stl, NewFileNamesUnusedVerticesAndOrder) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {9, 9, 9}, {1, 0, 0}, {0, 1, 0}};
  mesh.elements.add(ElementKind::Triangle, std::vector<Index>{0, 3, 2});
  const Written written = write_anew("stl", mesh, mesh.positions);
  EXPECT_THAT(written.notes, ElementsAre(HasSubstr("1 vertices that no element uses"), HasSubstr("order of the vertices")));
  EXPECT_NO_THROW(check_same(mesh, mesh.positions, read_bytes("stl", written.bytes), false, true));
}

TEST(Stl, NewFileKeepsRandomDoublesBitwise) {
  std::mt19937_64 random(3);
  Mesh mesh;
  for (Index i = 0; i < 300; ++i) {
    std::array<double, 3> p{};
    for (double& c : p) {
      do c = std::bit_cast<double>(random());
      while (!std::isfinite(c));
    }
    mesh.positions.push_back({p[0], p[1], p[2]});
    if (i % 3 == 2) mesh.elements.add(ElementKind::Triangle, std::vector<Index>{i - 2, i - 1, i});
  }
  const Written written = write_anew("stl", mesh, mesh.positions);
  EXPECT_TRUE(written.notes.empty());
  EXPECT_NO_THROW(check_same(mesh, mesh.positions, read_bytes("stl", written.bytes), true, true));
}

TEST(Stl, RefusesMalformedFilesWithTheLine) {
  struct Malformed {
    std::string from, to;
    std::size_t line;
    std::string says;
  };
  const std::vector<Malformed> cases{
      {"outer loop", "inner loop", 3, "inner"},
      {"vertex 1 1 0\n", "vertex 1 1\n", 7, "endloop"},
      {"vertex 1 1 0\n", "vertex 1 nan 0\n", 6, "finite"},
      {"vertex 1 1 0\n", "vertex 1 1 0\n vertex 1 1 0\n", 7, "more than three"},
      {"   vertex 1 1 0\n", "", 6, "endloop"},
      {"endsolid two facets\n", "", 15, "file ends"},
      {"solid two facets\n", "solid two facets\n facet", 2, "normal"},
  };
  for (const Malformed& one : cases) {
    std::string bytes = stl_ascii();
    bytes.replace(bytes.find(one.from), one.from.size(), one.to);
    try {
      read_bytes("stl", bytes);
      ADD_FAILURE() << one.to << " was read";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(one.says)) << one.to;
      EXPECT_EQ(error.line(), one.line) << one.to << ": " << error.what();
    }
  }
}

TEST(Stl, RefusesTruncatedBinary) {
  for (const std::size_t cut : {std::size_t{1}, std::size_t{50}, std::size_t{100}}) {
    try {
      read_bytes("stl", stl_binary().substr(0, stl_binary().size() - cut));
      FAIL() << cut;
    } catch (const InputError& error) {
      EXPECT_EQ(error.line(), 0U);
      EXPECT_THAT(error.what(), HasSubstr("truncated"));
    }
  }
}

}  // namespace
}  // namespace dmoscope::testing
