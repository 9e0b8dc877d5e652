// A surplus number on a line of a mesh shifts the ones after it, so that the file is refused there.

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

TEST(SurplusColumns, Su2) {
  const std::string head = "NDIME= 2\nNELEM= 1\n5 0 1 2 0\nNPOIN= 3\n";
  EXPECT_EQ(read_bytes("a.su2", head + "0 0 0\n1 0 1 % the second\n0 1 2\n").positions.size(), 3U);
  EXPECT_EQ(read_bytes("a.su2", head + "0 0\n1 0\n0 1\n").positions.size(), 3U) << "the numbers may be left out";
  expect_refused("a.su2", head + "0 0 0\n1 1 0 1\n0 1 2\n", 6, "too many");
  expect_refused("a.su2", head + "0 0\n1.5 1.5 0\n0 1\n", 6, "with a number of its own");
  expect_refused("a.su2", head + "0 0 0\n1 1\n0 1 2\n", 6, "number too few");
  expect_refused("a.su2", head + "0 0 0.5\n1 0 1\n0 1 2\n", 5, "number of a point");
  expect_refused("a.su2", "NDIME= 2\nNELEM= 1\n5 0 1 2 0 7\nNPOIN= 3\n0 0\n1 0\n0 1\n", 3, "too many");
  const std::string marker = "0 0\n1 0\n0 1\nNMARK= 1\nMARKER_TAG= m\nMARKER_ELEMS= 1\n";
  expect_refused("a.su2", head + marker + "3 0 1 2 2\n", 11, "too many");
}

TEST(SurplusColumns, Fort14) {
  const auto grid = [](const std::string& node, const std::string& element) {
    return "title\n1 3\n1 0 0 5\n" + node + "\n3 0 1 5\n" + element + "\n1 = boundaries\n2\n2 0 = nodes\n1\n2 = a remark\n0\n0\n";
  };
  EXPECT_EQ(read_bytes("a.14", grid("2 1 0 5 ! depth 5", "1 3 1 2 3 = first")).positions.size(), 3U);
  expect_refused("a.14", grid("2 1 1 0 5", "1 3 1 2 3"), 4, "too many");
  expect_refused("a.14", grid("2 1 0 5", "1 3 1 2 3 3"), 6, "too many");
  std::string boundary = grid("2 1 0 5", "1 3 1 2 3");
  expect_refused("a.14", boundary.replace(boundary.find("\n2 = a"), 3, "\n2 3 "), 11, "too many");
}

TEST(SurplusColumns, Tetgen) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& node, const std::string& element) {
    put(folder / "a.node", "3 2 1 0\n1 0 0 0.5\n" + node + "\n3 0 1 0.5 # last\n");
    put(folder / "a.ele", "1 3 0\n" + element + "\n");
    try {
      Progress progress;
      (void)read_mesh(folder / "a.node", progress);
    } catch (const InputError& error) {
      return error.file().substr(error.file().size() - 4) + ":" + std::to_string(error.line());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("2 1 0 0.5", "1 1 2 3"), "");
  EXPECT_EQ(refusal("2 1 1 0 0.5", "1 1 2 3"), "node:3");
  EXPECT_EQ(refusal("2 1 0 0.5", "1 1 2 3 3"), ".ele:2");
}

}  // namespace
}  // namespace dmoscope::test
