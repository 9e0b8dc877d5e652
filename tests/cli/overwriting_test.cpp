// No output takes the place of a file that the mesh is read from, and no file is read without end.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/io/mesh_io.h"
#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {
namespace overwriting {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kSquare = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

TEST(EndlessInput, IsRefused) {
  const Folder folder;
  const std::string mesh = folder.file("a.off", kSquare), fifo = folder / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& file : {std::string("/dev/zero"), fifo}) {
    const Output output = run({"quality", mesh, "--metric", "formula:@" + file});
    EXPECT_NE(output.code, 0);
    EXPECT_THAT(output.err, HasSubstr(file + ": a " + (file == fifo ? "pipe" : "device") + " is no file that can be read"));
  }
  const Output output = run({"quality", mesh, "--metric", "formula:@" + folder.file("long.txt", std::string(20001, '1'))});
  EXPECT_THAT(output.err, HasSubstr("long.txt: too large: at most 20000 bytes"));
  EXPECT_THAT(run({"script", "/dev/zero"}).err, HasSubstr("a device is no file"));
  Call endless;
  endless.arguments = {"script", "-"};
  endless.input = std::string((std::size_t{1} << 26U) + 1, '#');
  EXPECT_THAT(run(endless).err, HasSubstr("standard input: too large"));
}

TEST(Convert, RefusesWhatCannotBeComputedWithInTheWordsOfQuality) {
  const Folder folder;
  const std::string mesh = folder.file("a.off", "OFF\n3 1 0\n0 0 0\n1e308 0 0\n0 1e308 0\n3 0 1 2\n"), out = folder / "out.vtk";
  const Output converted = run({"convert", mesh, out}), judged = run({"quality", mesh});
  EXPECT_EQ(converted.code, 3);
  EXPECT_EQ(converted.err, judged.err);
  EXPECT_THAT(converted.err, HasSubstr("units large"));
  EXPECT_FALSE(exists(out));
}

TEST(MetricField, ThatIsNoneNamesItsFileAndVertex) {
  const Folder folder;
  const std::string mesh = folder.file(
      "a.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nTriangles 2\n1 2 3 0\n1 3 4 0\nEnd\n");
  const std::string sol =
      folder.file("a.sol", "MeshVersionFormatted 2\nDimension 2\nSolAtVertices 4\n1 3\n1 0 1\n1 0 1\n1 2 1\n1 0 1\nEnd\n");
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"quality", mesh, "--metric", "mean-ratio@field"},
        {"smooth", mesh, "-o", folder / "o.mesh", "--metric", "mean-ratio@field", "--iterations", "1"}}) {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 3) << output.err;
    EXPECT_THAT(output.err, HasSubstr(sol + ": the metric 'metric' is not positive definite at vertex 2"));
  }
}

}  // namespace overwriting
}  // namespace
}  // namespace dmoscope::test
