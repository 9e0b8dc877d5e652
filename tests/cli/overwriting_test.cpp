// No output replaces a file that the mesh is read from, and no file is read without end.

#include <string>
#include <vector>

#include <fmt/format.h>
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

/// Expects that no output of any subcommand, and no command of a script, can be `file`, from which `mesh` is read.
void expect_kept(const Folder& folder, const std::string& mesh, const std::string& file) {
  std::vector<std::vector<std::string>> calls{{"smooth", mesh, "-o", folder / "o.off", "--iterations", "1", "--stats", file},
                                              {"smooth", mesh, "-o", folder / "o.off", "--iterations", "1", "--checkpoint", file},
                                              {"quality", mesh, "--elements", file},
                                              {"compare", mesh, "--run", "dmo", "--iterations", "1", "--stats", file},
                                              {"compare", mesh, "--run", "dmo", "--iterations", "1", "--table", file}};
  for (const std::string command : {"stats", "elements", "save-state", "export", "save-report"})
    calls.push_back({"script", folder.file(command + ".txt", "open \"" + mesh + "\"\n" + command + " \"" + file + "\"\n")});
  // Unknown before the script runs: the mesh exists only then.
  const std::string copy = folder / "late.off";
  calls.push_back({"script", folder.file("late.txt", "open-beside \"" + mesh + "\"\nexport \"" + copy + "\"\nstats \"" + file + "\"\n")});
  const std::string before = read_file(file);
  for (const std::vector<std::string>& arguments : calls) {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 2) << ::testing::PrintToString(arguments) << output.err;
    EXPECT_THAT(output.err, HasSubstr("overwrit")) << ::testing::PrintToString(arguments);
    EXPECT_EQ(read_file(file), before) << ::testing::PrintToString(arguments);
  }
}

TEST(Overwriting, TheOtherHalfOfAPairIsKept) {
  const Folder folder;
  ASSERT_EQ(run({"convert", folder.file("a.off", kSquare), folder / "t.ele"}).code, 0);
  expect_kept(folder, folder / "t.ele", folder / "t.node");
  const Output output = run({"smooth", folder / "a.off", "-o", folder / "u.ele", "--stats", folder / "u.node"});
  EXPECT_EQ(output.code, 2);
  EXPECT_THAT(output.err, AllOf(HasSubstr("u.node"), HasSubstr("overwritten")));
}

TEST(Overwriting, PiecesAndNumbersAreKept) {
  if (format_by_extension(".pvtu") == nullptr) GTEST_SKIP() << "this build reads no VTU";
  const Folder folder;
  ASSERT_EQ(run({"convert", folder.file("a.off", kSquare), folder / "q.pvtu", "--pieces", "2"}).code, 0);
  expect_kept(folder, folder / "q.pvtu", folder / "q_1.vtu");
  const Output beside = run({"smooth", folder / "a.off", "-o", folder / "new.pvtu", "--stats", folder / "new_0.vtu"});
  EXPECT_EQ(beside.code, 2);
  EXPECT_THAT(beside.err, HasSubstr("this is a file beside " + (folder / "new.pvtu") + ", which is written with it"));
  const std::string before = read_file(folder / "q_1.vtu");
  for (const char* subcommand : {"smooth", "convert"}) {
    std::vector<std::string> arguments{subcommand, folder / "q.pvtu", folder / "q_1.vtu"};
    if (arguments[0] == "smooth") arguments.insert(arguments.begin() + 2, "-o");
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 2) << output.err;
    EXPECT_THAT(output.err, AllOf(HasSubstr("q_1.vtu"), HasSubstr("overwritten")));
  }
  const Output over =
      run({"script", folder.file("over.txt", "open \"" + (folder / "q.pvtu") + "\"\nexport-over \"" + (folder / "q.pvtu") + "\"\n")});
  EXPECT_EQ(over.code, 2) << "no copy of the pieces would be kept";
  EXPECT_THAT(over.err, HasSubstr("is read together with q_1.vtu"));
  EXPECT_EQ(read_file(folder / "q_1.vtu"), before);
}

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

TEST(MetricField, ThatIsNoneNamesItsFileLineAndVertex) {
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
    EXPECT_THAT(output.err, HasSubstr(sol + ":7: the metric 'metric' is not positive definite at vertex 2"));
  }
}

/// A word in the place of the first number of a vertex, found nowhere else.
TEST(MetricField, ThatIsNoneNamesItsLineInEveryText) {
  const Folder folder;
  const std::string mesh = folder.file(
      "a.mesh", "MeshVersionFormatted 2\nDimension 2\nVertices 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nTriangles 2\n1 2 3 0\n1 3 4 0\nEnd\n");
  (void)folder.file("a.sol",
                    "MeshVersionFormatted 2\nDimension 2\nSolAtVertices 4\n2 3 1\n1 0 1 9\n1 0 1 9\n-7.25 2\n1 -3.5\n1 0 1 9\nEnd\n");
  for (const char* format : {"mesh", "vtk", "msh", "vtu", "14"}) {
    const std::string other = folder / (std::string("b.") + format);
    ASSERT_EQ(run({"convert", mesh, other}).code, 0) << format;
    if (std::string(format) == "mesh") std::filesystem::copy_file(folder / "a.sol", folder / "b.sol");
    const bool of_vertices = std::string(format) == "14";
    const std::string file = std::string(format) == "mesh" ? folder / "b.sol" : other;
    const auto lines = lines_of(read_file(file));
    const auto line =
        std::ranges::find_if(lines, [&](const std::string& l) { return l.find(of_vertices ? "-3.5" : "-7.25") != std::string::npos; });
    const std::string number = line == lines.end() ? "" : fmt::format("{}:", line - lines.begin() + 1);
    if (std::string(format) != "vtu") {
      EXPECT_NE(line, lines.end()) << format << " is binary";
    }
    const Output output = run({"quality", other, "--metric", of_vertices ? "mean-ratio@field:depth" : "mean-ratio@field:metric"});
    EXPECT_EQ(output.code, 3) << output.err;
    EXPECT_THAT(output.err, HasSubstr(file + ":" + number + " the "));
    EXPECT_THAT(output.err, HasSubstr(" at vertex 2"));
  }
}

/// Errors in numbers of an XML file, of nodes in another order, and of a second piece.
TEST(MetricField, ThatIsNoneNamesItsLineWhereNumbersAreElsewhereThanInOrder) {
  const Folder folder;
  const std::string xdmf = folder.file(
      "a.xdmf",
      "<Xdmf Version=\"3.0\"><Domain><Grid Name=\"g\">\n<Topology TopologyType=\"Triangle\"><DataItem Dimensions=\"2 3\" "
      "NumberType=\"Int\">0 1 2 0 2 3</DataItem></Topology>\n<Geometry GeometryType=\"XY\"><DataItem Dimensions=\"4 2\">0 0 1 0\n1 1 0 "
      "1</DataItem></Geometry>\n<Attribute Name=\"size\" Center=\"Node\"><DataItem Dimensions=\"4\">\n1 1\n-7.25\n1\n</DataItem>"
      "</Attribute></Grid></Domain></Xdmf>\n");
  const std::string gmsh =
      folder.file("a.msh",
                  "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n$Elements\n2\n1 2 2 0 1 "
                  "1 2 3\n2 2 2 "
                  "0 1 1 3 4\n$EndElements\n$NodeData\n1\n\"size\"\n1\n0.0\n3\n0\n1\n4\n4 1\n3 -7.25\n1 1\n2 1\n$EndNodeData\n");
  const auto piece = [](const char* points, const char* sizes) {
    return fmt::format(
        "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
        "format=\"ascii\">{}</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2"
        "</DataArray><DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\" "
        "format=\"ascii\">5</DataArray></Cells>\n<PointData><DataArray type=\"Float64\" Name=\"size\" format=\"ascii\">{}</DataArray>"
        "</PointData></Piece>\n",
        points, sizes);
  };
  const std::string vtu =
      folder.file("a.vtu", "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n" +
                               piece("0 0 0 1 0 0 1 1 0", "1\n1\n1") + piece("2 0 0 3 0 0 3 1 0", "1\n1\n1") +
                               piece("4 0 0 5 0 0 5 1 0", "1\n-7.25 1") + "</UnstructuredGrid></VTKFile>\n");
  for (const auto& [file, line, vertex] : {std::tuple(xdmf, 7, 2), {gmsh, 26, 2}, {vtu, 12, 7}}) {
    const Output output = run({"quality", file, "--metric", "mean-ratio@field:size"});
    EXPECT_EQ(output.code, 3);
    EXPECT_THAT(output.err, HasSubstr(fmt::format("{}:{}: the size 'size' is not above 0 at vertex {}", file, line, vertex)));
  }
}

}  // namespace overwriting
}  // namespace
}  // namespace dmoscope::test
