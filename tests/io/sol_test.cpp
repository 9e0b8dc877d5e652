// MEDIT's solution files beside a mesh: content that is read, skipped or refused.

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/medit/medit.h"
#include "core/io/reading/source_file.h"
#include "tests/io/files.h"
#include "tests/support/meshes.h"

namespace dmoscope::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SolFiles : public ::testing::Test {
 protected:
  SolFiles() {
    mesh_.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    add(mesh_, {0, 1, 2});
  }
  std::vector<std::string> read(const std::string& text) {
    mesh_.fields.clear();
    Progress progress;
    test::put(folder_ / "a.sol", text);
    return read_solutions(folder_ / "a.sol", mesh_, progress);
  }
  [[nodiscard]] std::string why(const std::string& text) {
    try {
      (void)read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "read";
  }

  test::TemporaryFolder folder_;
  Mesh mesh_;
};

constexpr const char* kTensors = "MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n3\n1 3\n4 0 1\n4 1 1\n9 0 1\n";

TEST_F(SolFiles, HaveTensorsNumbersAndVectors) {
  EXPECT_THAT(read(std::string(kTensors) + "End\n"), ElementsAre());
  ASSERT_EQ(mesh_.fields.size(), 1U);
  EXPECT_EQ(mesh_.fields[0].name, "metric");
  EXPECT_THAT(mesh_.fields[0].values, ElementsAre(4, 0, 1, 4, 1, 1, 9, 0, 1));
  (void)read("MeshVersionFormatted 2 Dimension 2 SolAtVertices 3 2 1 2  7 1 2  8 3 4  9 5 6");
  ASSERT_EQ(mesh_.fields.size(), 2U);
  EXPECT_THAT(mesh_.fields[0].values, ElementsAre(7, 8, 9));
  EXPECT_THAT(mesh_.fields[1].values, ElementsAre(1, 2, 3, 4, 5, 6));
}

/// Files as solvers append them, with data of elements.
TEST_F(SolFiles, WhatSaysNothingOfVerticesIsPassedOverAndTold) {
  EXPECT_THAT(read(std::string(kTensors) + " Time\n 0.0E+00\n Iterations\n 0\n CFL\n 1.9E-004\n Residu\n 0.1 nan -inf\n"
                                           "SolAtTriangles 1 1 1 5\nEnd\n"),
              ElementsAre("Time", "Iterations", "CFL", "Residu", "SolAtTriangles"));
  ASSERT_EQ(mesh_.fields.size(), 1U);
  EXPECT_EQ(mesh_.fields[0].values.size(), 9U);
  EXPECT_THAT(read("MeshVersionFormatted 2\nTime 3\nDimension 2\nSolAtVertices 3 1 1 1 2 3"), ElementsAre("Time"));
  EXPECT_EQ(mesh_.fields.size(), 1U);
}

TEST_F(SolFiles, AreRefusedWithTheirLine) {
  EXPECT_THAT(why("Vertices 3"), HasSubstr("a.sol:1: a solution file begins with MeshVersionFormatted"));
  EXPECT_THAT(why("MeshVersionFormatted 2\n5 5\n"), HasSubstr("a.sol:2: expected a keyword"));
  EXPECT_THAT(why("MeshVersionFormatted 2\nSolAtVertices 3\n"), HasSubstr("a.sol:2: SolAtVertices before Dimension"));
  EXPECT_THAT(why("MeshVersionFormatted 2\nDimension 4\n"), HasSubstr("a.sol:2: Dimension 4"));
  EXPECT_THAT(why("MeshVersionFormatted 2\nDimension 2\nSolAtVertices\n4\n1 1\n1 2 3 4\n"), HasSubstr("a.sol:4: solutions at 4 vertices"));
  EXPECT_THAT(why("MeshVersionFormatted 2\nDimension 2\nSolAtVertices 3\n1 7\n"), HasSubstr("a.sol:4: a solution of type 7"));
  EXPECT_THAT(why("MeshVersionFormatted 2\nDimension 2\nSolAtVertices 3\n1 1\n1\ntwo\n3\n"), HasSubstr("a.sol:6: "));
}

TEST_F(SolFiles, ANoteTellsWhatIsThere) {
  const auto notes_on = [&](const std::string& text) {
    test::put(folder_ / "part.sol", text);
    test::put(folder_ / "part.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices\n3\n0 0 0\n1 0 0\n0 1 0\nTriangles\n1\n1 2 3 0\nEnd\n");
    Progress progress;
    std::string all;
    const Mesh mesh = read_mesh(folder_ / "part.mesh", progress);
    for (const std::string& note : mesh.source->notes()) all += note + "\n";
    return all;
  };
  EXPECT_THAT(notes_on(std::string(kTensors) + "End\n"), HasSubstr("fields read from part.sol beside it\n"));
  EXPECT_THAT(notes_on("MeshVersionFormatted 2\nDimension 2\nSolAtVertice 3\n1 1\n1 2 3\nTime 1\nTime 2\nEnd\n"),
              HasSubstr("part.sol beside it has no solutions at vertices, where this was passed over: SolAtVertice, Time\n"));
  std::string many = kTensors;
  for (int i = 0; i < 50; ++i) many += "Word" + std::string(1, static_cast<char>('A' + i % 26)) + std::to_string(i) + " 1\n";
  EXPECT_LT(notes_on(many).size(), 300U);
}

/// A truncated file gives whole fields, or none.
TEST_F(SolFiles, TruncatedAnywhereHaveWholeFieldsOrAreRefused) {
  const std::string whole = std::string(kTensors) + "Time 0.5\nEnd\n";
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const std::string why_not = why(whole.substr(0, n));
    for (const Field& field : mesh_.fields) EXPECT_EQ(field.values.size(), 9U) << n;
    if (why_not != "read") {
      EXPECT_THAT(why_not, HasSubstr("a.sol:")) << n;
    }
  }
}

}  // namespace
}  // namespace dmoscope::testing
