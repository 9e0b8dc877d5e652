// Volume meshes on the command line: smoothed, judged, and written with their other content.

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

double minimum(const Json& report, const char* when) { return report[when]["minimum"].get<double>(); }

/// The lines of a file after its positions: from the first that has one of the words on, to the end.
std::vector<std::string> lines_from(const std::string& path, const std::string& word) {
  const auto lines = lines_of(read_file(path));
  const auto first = std::ranges::find_if(lines, [&](const std::string& line) { return line.find(word) != std::string::npos; });
  EXPECT_NE(first, lines.end()) << path << " has no " << word;
  return {first, lines.end()};
}

TEST(Volumes, ComeOutOfEveryFormatWithTheirElementsAndBetter) {
  const Folder folder;
  const std::string source = folder / "solids.vtk";
  ASSERT_EQ(run({"generate", "solids", "-o", source, "--size", "200"}).code, 0);
  const Json whole = json_of(run({"quality", source, "--json"}));
  for (const char* format : {"vtk", "vtu", "msh", "mesh", "su2"}) {
    const std::string in = folder / (std::string("in.") + format), out = folder / (std::string("out.") + format);
    const Output converted = run({"convert", source, in});
    ASSERT_EQ(converted.code, 0) << format << converted.err;
    const Json report = smooth(in, out, {"--iterations", "3"});
    EXPECT_GT(minimum(report, "after"), minimum(report, "before")) << format;
    const Json before = json_of(run({"quality", in, "--json"})), after = json_of(run({"quality", out, "--json"}));
    EXPECT_EQ(before["elements"], whole["elements"]) << format;
    EXPECT_EQ(after["elements"], whole["elements"]) << format;
    EXPECT_EQ(after["inverted"], 0) << format;
  }
}

TEST(Volumes, WhatOnlyItsInsideInvertsIsToldWithItsPlace) {
  const Folder folder;
  const std::string in =
      folder.file("in.vtk",
                  "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n5 -6 -2 11 -6 -2 17 6 "
                  "3 7 6 1 7 -2 15 5 5 5 4 4 11 2 6 8\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\n");
  const Output smoothed = run({"smooth", in, "-o", folder / "out.vtk", "--iterations", "1", "--json"});
  EXPECT_EQ(smoothed.code, 1);
  const Json report = json_of(smoothed), &left = report["left_inverted"];
  EXPECT_EQ(report["before"]["inverted_inside_alone"], 1);
  EXPECT_EQ(report["after"]["inverted_inside_alone"], 1);
  EXPECT_EQ(left["inside_alone"], 1);
  ASSERT_EQ(left["elements"].size(), 1U);
  EXPECT_EQ(left["elements"][0]["element"], 0);
  EXPECT_EQ(left["elements"][0]["inside_alone"], true);
  const auto at = left["elements"][0]["at"].get<std::vector<double>>();
  EXPECT_EQ(json_of(run({"quality", in, "--json"}))["inverted_elements"], left["elements"]);
  const std::string said = fmt::format("1 inverted, 1 of them inside alone, where corners do not tell: element 0 at ({:.10g}, ", at[0]);
  EXPECT_THAT(run({"quality", in}).out, HasSubstr(said));
  const Output compared = run({"compare", in, "--run", "dmo", "--iterations", "1", "--report", folder / "report.html"});
  EXPECT_THAT(compared.out, HasSubstr("\ninput: " + said));
  const std::string page = read_file(folder / "report.html");
  for (const char* row : {"<p>input: ", "<p>dmo:mean-ratio: "}) EXPECT_NE(page.find(row + said), std::string::npos) << row;
}

TEST(Volumes, ElementsAreWrittenAsTheyWereWound) {
  const Folder folder;
  const std::string bytes =
      "NDIME= 3\nNELEM= 2\n10 0 1 2 3 0\n10 1 2 3 4 1\nNPOIN= 5\n0 0 0 0\n0 1 0 1\n1 0 0 2\n0 0 1 3\n1 1 1 4\nNMARK= 0\n";
  const std::string in = folder.file("in.su2", bytes), out = folder / "out.su2";
  const Output smoothed = run({"smooth", in, "-o", out, "--iterations", "2"});
  ASSERT_EQ(smoothed.code, 0) << smoothed.err;
  EXPECT_THAT(smoothed.err, HasSubstr("inside out"));
  EXPECT_EQ(read_file(out), bytes) << "no vertex of it is free";
}

TEST(Volumes, RealMixedMeshesKeepAllButTheirPositions) {
  struct Real {
    const char* file;
    const char* elements;  // the word after which there are no positions
  };
  for (const Real& real : {Real{"mixed3d/mixed-hex-pyr-tet.vtk", "CELLS"}}) {
    const std::string in = shared_mesh(real.file);
    if (in.empty()) GTEST_SKIP() << "no shared meshes beside this checkout";
    const Folder folder;
    const std::string out = folder / ("out" + in.substr(in.rfind('.')));
    const Json report = smooth(in, out, {"--iterations", "5"});
    EXPECT_GT(minimum(report, "after"), minimum(report, "before"));
    EXPECT_EQ(lines_from(in, real.elements), lines_from(out, real.elements)) << real.file;
  }
  const std::string knowles = shared_mesh("mixed3d/su2_MixElemsKnowles.su2");
  const Folder folder;
  const Json report = smooth(knowles, folder / "out.su2", {"--iterations", "1"});
  EXPECT_NEAR(minimum(report, "before"), 0.90053, 1e-5) << "wedges of two kinds of corners, all the rest perfect or 0.952";
  const auto before = lines_of(read_file(knowles)), after = lines_of(read_file(folder / "out.su2"));
  const auto points = std::ranges::find_if(before, [](const std::string& line) { return line.starts_with("NPOIN"); });
  ASSERT_EQ(before.size(), after.size());
  EXPECT_TRUE(std::equal(before.begin(), points, after.begin())) << "elements in their own winding";
}

TEST(Volumes, WhatIsNotForThemIsRefusedWithItsReason) {
  const Folder folder;
  const std::string in = folder / "t.vtk";
  ASSERT_EQ(run({"generate", "tetrahedra", "-o", in, "--size", "64"}).code, 0);
  const auto refused = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"smooth", in, "-o", folder / "out.vtk"});
    const Output output = run(more);
    EXPECT_EQ(output.code, 2) << output.err;
    EXPECT_FALSE(exists(folder / "out.vtk"));
    return output.err;
  };
  EXPECT_THAT(refused({"--method", "angle-based"}), HasSubstr("planar"));
  EXPECT_THAT(refused({"--metric", "rectangularity"}), HasSubstr("not defined for tetrahedra"));
  EXPECT_THAT(refused({"--combine", "mean-ratio:0.7:density", "--size-function", "h1:0,0"}), HasSubstr("planar"));
}

}  // namespace
}  // namespace dmoscope::test
