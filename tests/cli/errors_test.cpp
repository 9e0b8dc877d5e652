// Bad input and output: exit code 3, "file:line: what", no partial result.

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

constexpr const char* kTriangles = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

/// Expects smoothing and judging `input` to fail with 3, to tell the place, and to write nothing.
void expect_refused(const std::string& input, bool with_line) {
  const Folder folder;
  const std::string output = folder / "out.14";
  const Output smoothed = run({"smooth", input, "-o", output, "--stats", folder / "s.csv", "--json"});
  EXPECT_EQ(smoothed.code, 3) << input << "\n" << smoothed.out << smoothed.err;
  EXPECT_EQ(smoothed.out, "") << input;
  EXPECT_THAT(smoothed.err, HasSubstr(with_line ? input + ":" : input)) << input;
  if (with_line) {
    EXPECT_THAT(smoothed.err, ::testing::ContainsRegex(":[0-9]+: ")) << input;
  }
  EXPECT_FALSE(exists(output)) << input;
  EXPECT_FALSE(exists(folder / "s.csv")) << input;
  EXPECT_EQ(run({"quality", input}).code, 3) << input;
}

template <class Number>
void append(std::string& bytes, Number number) {
  char raw[sizeof number];
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

std::string binary_ply() {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (const double c : {0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.}) append(bytes, c);
  for (const auto& face : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
    append(bytes, std::uint8_t{3});
    for (const std::int32_t corner : face) append(bytes, corner);
  }
  return bytes;
}

std::string binary_vtk_header() { return "# vtk DataFile Version 3.0\nsquare\nBINARY\nDATASET POLYDATA\nPOINTS 4 double\n"; }

TEST(BadInput, MissingEmptyOrAFolder) {
  const Folder folder;
  expect_refused(folder / "none.14", false);
  expect_refused(folder / "", false);
  for (const char* name : {"e.14", "e.vtk", "e.obj", "e.off", "e.ply", "e.stl", "e.su2", "e.msh", "e.mesh", "e.node"})
    expect_refused(folder.file(name, ""), false);
}

TEST(BadInput, UnknownFormat) {
  const Folder folder;
  expect_refused(folder.file("letter.txt", "Dear mesh,\n"), false);
}

/// An input whose extension is kept is to blame, not the output.
TEST(BadInput, UnknownFormatIsNotBlamedOnTheOutput) {
  const Folder folder;
  const std::string in = folder.file("a.gmv", "gmvinput ascii\nnodev 3\n"), out = folder / "b.gmv";
  for (const auto& arguments : {std::vector<std::string>{"smooth", in, "-o", out}, {"convert", in, out}}) {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 3);
    EXPECT_THAT(output.err, HasSubstr(in + ": this is a GMV file"));
    EXPECT_THAT(output.err, ::testing::Not(HasSubstr(out)));
  }
  const Output output = run({"convert", folder.file("good.off", kTriangles), out});
  EXPECT_EQ(output.code, 2);
  EXPECT_THAT(output.err, HasSubstr(out));
}

TEST(BadInput, MalformedRealFiles) {
  for (const char* name : {"ocean/admesh_Mixed_Test.14", "quad/unstrquad.vtk"}) {
    const std::string path = shared_mesh(name);
    if (path.empty()) GTEST_SKIP() << "the shared meshes are not here";
    expect_refused(path, true);
  }
}

TEST(BadInput, WrongNumbersAndIndices) {
  const Folder folder;
  const std::string good = folder.file("good.off", kTriangles);
  EXPECT_EQ(run({"quality", good}).code, 0);
  expect_refused(folder.file("nan.off", "OFF\n4 2 0\n0 0 0\n1 nan 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"), true);
  expect_refused(folder.file("inf.obj", "v 0 0 0\nv inf 0 0\nv 1 1 0\nf 1 2 3\n"), true);
  expect_refused(folder.file("range.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 4\n"), true);
  expect_refused(folder.file("negative.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 -1\n"), true);
  expect_refused(folder.file("range.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\n"), true);
  expect_refused(folder.file("short.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n"), true);
  expect_refused(folder.file("huge.off", "OFF\n4000000000 4000000000 0\n0 0 0\n"), true);
  expect_refused(folder.file("word.14", "title\n1 3\n1 0 0 1\n2 one 0 1\n3 0 1 1\n1 3 1 2 3\n0\n0\n0\n0\n"), true);
}

TEST(BadInput, TruncatedBinaries) {
  const Folder folder;
  const std::string ply = binary_ply();
  EXPECT_EQ(run({"quality", folder.file("good.ply", ply)}).code, 0);
  for (const std::size_t left : {ply.size() - 1, ply.size() - 20, ply.size() - 80}) {
    expect_refused(folder.file("cut.ply", ply.substr(0, left)), false);
  }
  expect_refused(folder.file("cut.vtk", binary_vtk_header() + std::string(40, '\0')), false);
}

TEST(BadOutput, IsFoundBeforeTheWork) {
  const Folder folder;
  const std::string in = folder.file("in.off", kTriangles);
  std::filesystem::create_directory(folder / "folder.off");
  for (const std::string& target : {folder / "folder.off", folder / "none/out.off", std::string("/dev/null.d/out.off")}) {
    for (const auto& arguments :
         {std::vector<std::string>{"smooth", in, "-o", target}, {"convert", in, target}, {"generate", "grid", "-o", target}}) {
      const Output output = run(arguments);
      EXPECT_EQ(output.code, 3) << ::testing::PrintToString(arguments) << output.err;
      EXPECT_THAT(output.err, HasSubstr(target));
    }
  }
  // Neither the statistics' nor the mesh's target may be left half done.
  const Output stats = run({"smooth", in, "-o", folder / "out.off", "--stats", folder / "none/s.csv"});
  EXPECT_EQ(stats.code, 3);
  EXPECT_FALSE(exists(folder / "out.off"));
}

TEST(BadOutput, LeavesTheOldFile) {
  const Folder folder;
  const std::string old = folder.file("out.off", "precious");
  EXPECT_EQ(run({"smooth", folder / "none.off", "-o", old}).code, 3);
  EXPECT_EQ(run({"convert", folder.file("bad.off", "OFF\n1 1 0\n"), old}).code, 3);
  EXPECT_EQ(read_file(old), "precious");
}

TEST(BadOutput, IsNeverAnotherFileOfTheSameCall) {
  const Folder folder;
  const std::string in = folder.file("in.off", kTriangles);
  const std::string link = folder / "link.csv", dangling = folder / "dangling.csv";
  std::filesystem::create_symlink(in, link);
  std::filesystem::create_symlink("out.off", dangling);
  const std::string out = folder / "out.off", roundabout = folder / "./out.off";
  const std::vector<std::vector<std::string>> wrong{
      {"smooth", in, "-o", out, "--stats", in},           {"smooth", in, "-o", out, "--stats", link},
      {"smooth", in, "-o", out, "--stats", out},          {"smooth", in, "-o", out, "--stats", roundabout},
      {"smooth", in, "-o", out, "--stats", dangling},     {"quality", in, "--elements", in},
      {"quality", in, "--elements", folder / "./in.off"}, {"quality", in, "--elements", link},
  };
  for (const auto& arguments : wrong) {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 2) << ::testing::PrintToString(arguments) << output.err;
    EXPECT_THAT(output.err, HasSubstr("the same file")) << ::testing::PrintToString(arguments);
    EXPECT_EQ(read_file(in), kTriangles);
    EXPECT_FALSE(exists(out));
  }
  const std::string picture = folder.file("in.png", kTriangles);
  EXPECT_EQ(run({"render", picture, "-o", picture}).code, 2);
  EXPECT_EQ(read_file(picture), kTriangles);
}

TEST(BadOutput, AFullStandardOutputIsToldAndCounts) {
  const Folder folder;
  const std::string in = folder.file("in.off", kTriangles);
  if (!exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  for (const auto& arguments : {std::vector<std::string>{"quality", in},
                                {"quality", in, "--json"},
                                {"smooth", in, "-o", folder / "out.off"},
                                {"info"},
                                {"--version"},
                                {"--help"},
                                {"--man"},
                                {"script", folder.file("s.txt", "say one\nsay two\n")}}) {
    Call call;
    call.arguments = arguments;
    call.output = "/dev/full";
    const Output output = run(call);
    EXPECT_EQ(output.code, 3) << ::testing::PrintToString(arguments);
    EXPECT_EQ(output.err, "dmoscope: standard output: No space left on device\n") << ::testing::PrintToString(arguments);
  }
}

TEST(Interrupt, StopsAScriptWithOne) {
  const Folder folder;
  Call call;
  call.arguments = {"script", "-"};
  call.input = "open \"" + sample("coast.14") + "\"\nsay begun\nrun 1000000000\nsay never\nexport \"" + (folder / "out.14") + "\"\n";
  call.interrupt = std::chrono::milliseconds(500);
  call.interrupt_when = "begun";
  const Output output = run(call);
  EXPECT_EQ(output.code, 1) << output.out << output.err;
  EXPECT_THAT(output.out, HasSubstr("begun"));
  EXPECT_THAT(output.out, ::testing::Not(HasSubstr("never")));
  EXPECT_THAT(output.err, HasSubstr("standard input:3: cancelled"));
  EXPECT_FALSE(exists(folder / "out.14"));
}

TEST(Interrupt, EndsWithOneAndWritesNothing) {
  const Folder folder;
  Call call;
  // --iterations goes on when nothing moves any more, so this would take for ever.
  call.arguments = {"smooth", sample("coast.14"), "-o", folder / "out.14", "--stats", folder / "s.csv", "--iterations", "1000000000"};
  call.interrupt = std::chrono::milliseconds(1500);
  const Output output = run(call);
  EXPECT_EQ(output.code, 1) << output.out << output.err;
  EXPECT_THAT(output.err, HasSubstr("cancelled"));
  EXPECT_FALSE(exists(folder / "out.14"));
  EXPECT_FALSE(exists(folder / "s.csv"));
}

}  // namespace
}  // namespace dmoscope::test
