// Every verb once, and wrong usage.

#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Help, NamesEveryVerb) {
  const Output help = run({"--help"});
  EXPECT_EQ(help.code, 0);
  for (const char* verb : {"smooth", "quality", "render", "convert", "generate", "script", "bench", "info"}) {
    EXPECT_THAT(help.out, HasSubstr(verb));
    const Output more = run({verb, "--help"});
    EXPECT_EQ(more.code, 0);
    EXPECT_THAT(more.out, HasSubstr("--help"));
  }
  EXPECT_EQ(run({"--version"}).code, 0);
}

TEST(Help, ManPageHoldsEveryOptionMetricAndCommand) {
  const Output man = run({"--man"});
  EXPECT_EQ(man.code, 0);
  EXPECT_THAT(man.out, ::testing::StartsWith(".TH DMOSCOPE 1"));
  for (const char* word : {"until\\-converged", "scaled\\-jacobian", "fort.14", "add\\-run", "coast", "EXIT STATUS"}) {
    EXPECT_THAT(man.out, HasSubstr(word));
  }
}

TEST(Window, WithNoDisplaySaysSoAndNamesTheVerbs) {
  const Output output = run(std::vector<std::string>{});
  EXPECT_EQ(output.code, 2);
  EXPECT_THAT(output.out, IsEmpty());
  EXPECT_THAT(output.err, AllOf(HasSubstr("smooth"), HasSubstr("script"), HasSubstr("render")));
}

TEST(Usage, IsRefusedWithTwo) {
  const Folder folder;
  const std::string in = sample("coast.14"), out = folder / "out.14";
  const std::vector<std::vector<std::string>> wrong{
      {"smooth"},
      {"smooth", in},
      {"smooth", in, "-o", out, "--no-such-option"},
      {"smooth", in, "-o", out, "--iterations", "many"},
      {"smooth", in, "-o", out, "--iterations", "-3"},
      {"smooth", in, "-o", out, "--threads", "-1"},
      {"smooth", in, "-o", out, "--iterations", "3", "--until-converged"},
      {"smooth", in, "-o", out, "--patience", "3"},
      {"smooth", in, "-o", out, "--metric", "beauty"},
      {"smooth", in, "-o", out, "--metric", "scaled-jacobian", "extra"},
      {"smooth", in, "-o", out, "--method", "magic"},
      {"smooth", in, "-o", out, "--method", "laplace", "--combine", "mean-ratio:0.5:min-angle"},
      {"smooth", in, "-o", out, "--method", "laplace", "--backend", "cuda"},
      {"smooth", in, "-o", out, "--method", "laplace", "--relaxation", "1.5"},
      {"smooth", in, "-o", out, "--method", "dvr", "--directions", "up"},
      {"smooth", in, "-o", out, "--method", "dvr", "--seed", "-1"},
      {"smooth", in, "-o", out, "--backend", "abacus"},
      {"smooth", in, "-o", out, "--simd", "mmx"},
      {"smooth", in, "-o", out, "--backend", "cuda", "--precision", "double"},
      {"script", in, "--backend", "abacus"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:1:density"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:beauty"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:min-angle", "--metric", "mean-ratio"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:min-angle", "--size-function", "h1:0,0"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:density", "--size-function", "h1:0"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:density", "--size-function", "field:salt"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:density", "--then", "mean"},
      {"smooth", in, "-o", out, "--combine", "mean-ratio:0.7:density", "--backend", "cuda"},
      {"smooth", in, "-o", out, "--size-function", "constant"},
      {"smooth", in, "-o", out, "--then", "bed"},
      {"smooth", in, "-o", out, "--grid", "1"},
      {"smooth", in, "-o", out, "--levels", "0"},
      {"smooth", in, "-o", out, "--order", "random"},
      {"smooth", in, "-o", out, "--fix", "1,x"},
      {"smooth", in, "-o", out, "--fix", "no such group"},
      {"smooth", in, "-o", out, "--fix", "4000000000"},
      {"smooth", in, "-o", folder / "out.unknown"},
      {"smooth", in, "-o", folder / "out"},
      {"quality", in, "--metric", "beauty"},
      {"convert", in, folder / "out.unknown"},
      {"generate", "castle", "-o", out},
      {"generate", "grid", "-o", out, "--size", "99999999999999"},
      {"render", in, "-o", folder / "out.png", "--size", "big"},
      {"render", in, "-o", folder / "out.png", "--range", "1:0"},
      {"render", in, "-o", folder / "out.png", "--zoom", "0"},
      {"render", in, "-o", folder / "out.png", "--zoom", "nan"},
      {"render", in, "-o", folder / "out.png", "--at", "1"},
      {"render", in, "-o", folder / "out.png", "--at", "1,2,3,4"},
      {"render", in, "-o", folder / "out.png", "--at", "1,b"},
      {"render", in, "-o", folder / "out.png", "--range", "some"},
      {"render", in, "-o", folder / "out.png", "--range", "percentile:2"},
      {"render", in, "-o", folder / "out.png", "--range", "percentile:2:101"},
      {"render", in, "-o", folder / "out.png", "--range", "percentiles"},
      {"render", in, "-o", folder / "out.jpeg"},
      {"render", in, "-o", folder / "out.png", "--clip", "w"},
      {"render", in, "-o", folder / "out.png", "--clip", "x:1.5"},
      {"render", in, "-o", folder / "out.png", "--clip", "0,0,0:1"},
      {"render", in, "-o", folder / "out.png", "--clip-mode", "cut"},
      {"render", in, "-o", folder / "out.png", "--clip", "x", "--clip-mode", "saw"},
      {"render", in, "-o", folder / "out.png", "--isolate", "0.5:0.2"},
      {"render", in, "-o", folder / "out.png", "--shrink", "0"},
      {"render", in, "-o", folder / "out.png", "--worst", "-1"},
      {"render", in, "-o", folder / "out.png", "--view", "+w"},
      {"render", in, "-o", folder / "out.png", "--peel", "1"},  // a planar mesh has no inside
      {"script"},
  };
  for (const auto& arguments : wrong) {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 2) << ::testing::PrintToString(arguments) << output.err;
    EXPECT_THAT(output.err, ::testing::Not(IsEmpty())) << ::testing::PrintToString(arguments);
    EXPECT_FALSE(exists(out)) << ::testing::PrintToString(arguments);
  }
}

TEST(Usage, CountsAreWholeNumbersInTheirRange) {
  const Folder folder;
  const std::string in = sample("coast.14"), out = folder / "out.14";
  const std::vector<std::vector<std::string>> wrong{
      {"smooth", in, "-o", out, "--iterations", "99999999999999999999"},
      {"smooth", in, "-o", out, "--iterations", "1000000001"},
      {"smooth", in, "-o", out, "--iterations", "0x10"},
      {"smooth", in, "-o", out, "--iterations", ""},
      {"smooth", in, "-o", out, "--until-converged", "--max-iterations", "1000000001"},
      {"smooth", in, "-o", out, "--until-converged", "--patience", "0"},
      {"smooth", in, "-o", out, "--threads", "4294967297"},
      {"smooth", in, "-o", out, "--threads", "1025"},
      {"smooth", in, "-o", out, "--grid", "1e3"},
      {"smooth", in, "-o", out, "--levels", "17"},
      {"quality", in, "--worst", "1e3"},
      {"quality", in, "--worst", "-1"},
      {"generate", "grid", "-o", out, "--size", "1e3"},
      {"generate", "grid", "-o", out, "--seed", "18446744073709551616"},
  };
  for (const auto& arguments : wrong) {
    const Output output = run(arguments);
    EXPECT_EQ(output.code, 2) << ::testing::PrintToString(arguments) << output.err;
    EXPECT_THAT(output.err, ::testing::StartsWith("dmoscope: " + arguments[arguments.size() - 2] + ": expected a whole number from "));
    EXPECT_FALSE(exists(out));
  }
  EXPECT_EQ(run({"generate", "grid", "-o", out, "--size", "100", "--seed", "18446744073709551615"}).code, 0);
  // Leading zeros do not change a number.
  EXPECT_EQ(json_of(run({"smooth", in, "-o", out, "--iterations", "010", "--json"}))["iterations"], 10);
}

TEST(Usage, SaysWhatThereIs) {
  const Folder folder;
  EXPECT_THAT(run({"quality", sample("coast.14"), "--metric", "beauty"}).err, AllOf(HasSubstr("beauty"), HasSubstr("mean-ratio")));
  EXPECT_THAT(run({"smooth", sample("coast.14"), "-o", folder / "o.14", "--method", "magic"}).err,
              AllOf(HasSubstr("magic"), HasSubstr("dmo"), HasSubstr("smart-laplace")));
  EXPECT_THAT(run({"smooth", sample("coast.14"), "-o", folder / "o.xyz"}).err, AllOf(HasSubstr(".xyz"), HasSubstr(".vtk")));
}

TEST(Backend, CudaIsUsedOrRefusedWithTheReasonThatInfoGives) {
  const Folder folder;
  const auto info = json_of(run({"info", "--json"}));
  const auto& cuda = info["backends"][1];
  ASSERT_EQ(cuda["name"], "cuda");
  const std::vector<std::string> smooth{"smooth", sample("coast.14"), "-o", folder / "o.14", "--iterations", "1", "--json", "--backend"};
  const auto with = [&](const std::string& backend) {
    std::vector<std::string> words = smooth;
    words.push_back(backend);
    return run(words);
  };
  EXPECT_EQ(json_of(with("cpu"))["backend"], "cpu");
  EXPECT_EQ(json_of(with("cpu"))["backend_reason"], "");
  const auto automatic = json_of(with("auto"));
  const Output by_name = with("cuda");
  const Output script = run(Call{.arguments = {"script", "-", "--backend", "cuda"}, .input = "generate grid 500"});
  if (cuda["usable"] == true) {
    EXPECT_EQ(automatic["backend"], "cuda");
    EXPECT_EQ(automatic["backend_reason"], cuda["description"]);
    EXPECT_EQ(json_of(by_name)["backend"], "cuda");
    EXPECT_EQ(script.code, 0);
    return;
  }
  const std::string reason = cuda["reason"];
  EXPECT_EQ(automatic["backend"], "cpu");
  EXPECT_EQ(automatic["backend_reason"], "no cuda: " + reason);
  for (const Output& refused : {by_name, script}) {
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.out, IsEmpty());
    EXPECT_THAT(refused.err, HasSubstr(reason));
  }
  EXPECT_EQ(info["drawing"]["path"], "cpu");
  EXPECT_EQ(info["drawing"]["reason"], "no cuda: " + reason);
}

TEST(Backend, IsACommandOfScripts) {
  EXPECT_THAT(run(Call{.arguments = {"script", "-"}, .input = "generate grid 500\nbackend cpu\nrun 1"}).out, HasSubstr("cpu, "));
  const Output refused = run(Call{.arguments = {"script", "-", "--backend", "cpu"}, .input = "generate grid 500\nbackend cuda"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("standard input:2"), HasSubstr("--backend cpu")));
}

TEST(Info, JsonListsEverything) {
  const auto info = json_of(run({"info", "--json"}));
  for (const char* key : {"version", "build", "compiler", "threads", "backends", "simd", "opengl", "drawing", "formats", "metrics",
                          "methods", "generators"}) {
    EXPECT_TRUE(info.contains(key)) << key;
  }
  EXPECT_EQ(info["metrics"].size(), 9U);
  EXPECT_EQ(info["backends"][0]["name"], "cpu");
  EXPECT_EQ(info["simd"]["levels"][0], "baseline");
  EXPECT_EQ(info["simd"]["levels"].back(), info["simd"]["used"]);
  EXPECT_TRUE(info["backends"][1]["usable"] == true || !info["backends"][1]["reason"].get<std::string>().empty());
  EXPECT_THAT(run({"info"}).out, AllOf(HasSubstr("mean-ratio"), HasSubstr("cuda"), HasSubstr(".14")));
}

TEST(Generate, MakesEveryKindTheSameAgain) {
  const Folder folder;
  const auto info = json_of(run({"info", "--json"}));
  ASSERT_GE(info["generators"].size(), 8U);
  for (const auto& generator : info["generators"]) {
    const std::string kind = generator["name"];
    for (const char* name : {"a.vtk", "b.vtk"}) {
      const Output output = run({"generate", kind, "-o", folder / name, "--size", "400", "--seed", "7"});
      EXPECT_EQ(output.code, 0) << kind << output.err;
    }
    EXPECT_TRUE(read_file(folder / "a.vtk") == read_file(folder / "b.vtk")) << kind;
    const auto quality = json_of(run({"quality", folder / "a.vtk", "--json"}));
    EXPECT_GT(quality["vertices"], 50) << kind;
    EXPECT_LT(quality["vertices"], 1600) << kind;
  }
}

TEST(Quality, TableAndJsonAgree) {
  const Output table = run({"quality", sample("coast.14"), "--worst", "3"});
  EXPECT_EQ(table.code, 0);
  EXPECT_THAT(table.out, AllOf(HasSubstr("mean-ratio"), HasSubstr("acceptable"), HasSubstr("worst of")));
  const auto json = json_of(run({"quality", sample("coast.14"), "--worst", "3", "--json"}));
  for (const char* key : {"input", "vertices", "elements", "inverted", "metrics", "warnings"}) EXPECT_TRUE(json.contains(key)) << key;
  const auto& first = json["metrics"][0];
  EXPECT_EQ(first["metric"], "mean-ratio");
  for (const char* key : {"minimum", "mean", "percentile_1", "percentile_5", "percentile_50", "acceptable", "below_acceptable"}) {
    EXPECT_TRUE(first.contains(key)) << key;
  }
  ASSERT_EQ(first["worst"].size(), 3U);
  EXPECT_EQ(first["worst"][0]["quality"], first["minimum"]);
  EXPECT_LE(first["worst"][0]["quality"], first["worst"][1]["quality"]);
  EXPECT_LE(first["minimum"], first["percentile_1"]);
  EXPECT_LE(first["percentile_5"], first["percentile_50"]);
}

/// The words of the first row below "worst of".
std::vector<std::string> worst_row(const std::string& mesh) {
  const Output output = run({"quality", mesh, "--metric", "mean-ratio", "--worst", "1"});
  const auto lines = lines_of(output.out);
  for (std::size_t i = 0; i + 2 < lines.size(); ++i) {
    if (!lines[i].starts_with("worst of")) continue;
    std::istringstream row(lines[i + 2]);
    return {std::istream_iterator<std::string>(row), {}};
  }
  return {};
}

TEST(Quality, PlacesOfTheWorstHaveSixDigitsOfTheMeshAndJsonAll) {
  using ::testing::ElementsAre;
  const Folder folder;
  const std::string flat = folder.file("flat.off", "OFF\n4 2 0\n0 0 0.1\n1 0 0.1\n1 1 0.1\n0.25 1 0.1\n3 0 1 2\n3 0 2 3\n");
  EXPECT_THAT(worst_row(flat), ElementsAre("1", "triangle", "0.716711", "0.41667", "0.66667")) << "z is the same everywhere";
  const auto json = json_of(run({"quality", flat, "--worst", "1", "--json"}));
  EXPECT_NEAR(json["metrics"][0]["worst"][0]["centroid"][0].get<double>(), 1.25 / 3, 1e-15);
  EXPECT_NEAR(json["metrics"][0]["worst"][0]["centroid"][2].get<double>(), 0.1, 1e-15);
  const std::string far = folder.file("far.off", "OFF\n3 1 0\n4000000 0 0\n4000100 0 0\n4000000 100 0\n3 0 1 2\n");
  EXPECT_THAT(worst_row(far), ElementsAre("0", "triangle", ::testing::_, "4000033.333", "33.333")) << "six digits would be 4.00003e+06";
  const std::string upright = folder.file("upright.off", "OFF\n3 1 0\n0 0 0\n0 1 0\n0 0 1\n3 0 1 2\n");
  EXPECT_THAT(worst_row(upright), ElementsAre("0", "triangle", ::testing::_, "0.00000", "0.33333", "0.33333")) << "another plane";
  const std::string tiny = folder.file("tiny.off", "OFF\n3 1 0\n0 0 0\n3e-12 0 0\n0 3e-12 0\n3 0 1 2\n");
  EXPECT_THAT(worst_row(tiny), ElementsAre("0", "triangle", ::testing::_, "1e-12", "1e-12"));
}

TEST(Quality, ElementsFileHasOneRowAnElementAndBlanksWhereUndefined) {
  const Folder folder;
  ASSERT_EQ(run({"quality", sample("mixed.vtk"), "--elements", folder / "q.csv"}).code, 0);
  const auto json = json_of(run({"quality", sample("mixed.vtk"), "--json"}));
  const Table table = read_table(folder / "q.csv");
  ASSERT_EQ(table.rows.size(), json["elements"]);
  double least = INFINITY;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.rows[i][table.column("element")], std::to_string(i));
    const bool quadrilateral = table.rows[i][table.column("kind")] == "quadrilateral";
    EXPECT_EQ(table.rows[i][table.column("radius-ratio")].empty(), quadrilateral);
    least = std::min(least, table.number(i, "mean-ratio"));
  }
  EXPECT_EQ(least, json["metrics"][0]["minimum"]);
}

TEST(Convert, ThereAndBackKeepsEveryCoordinate) {
  const Folder folder;
  for (const char* extension : {".obj", ".off", ".ply", ".vtk", ".su2", ".msh", ".mesh", ".node", ".ele"}) {
    const std::string there = folder / (std::string("there") + extension), back = folder / "back.14";
    ASSERT_EQ(run({"convert", sample("coast.14"), there}).code, 0) << extension;
    ASSERT_EQ(run({"convert", there, back}).code, 0) << extension;
    const auto before = lines_of(read_file(sample("coast.14"))), after = lines_of(read_file(back));
    std::istringstream counts(before.at(1));
    std::size_t elements = 0, vertices = 0;
    counts >> elements >> vertices;
    for (std::size_t i = 2; i < 2 + vertices; ++i) {
      std::istringstream a(before.at(i)), b(after.at(i));
      std::size_t id_a = 0, id_b = 0;
      double xa = 0, ya = 0, xb = 1, yb = 1;
      a >> id_a >> xa >> ya;
      b >> id_b >> xb >> yb;
      ASSERT_TRUE(xa == xb && ya == yb) << extension << ": " << before[i] << " became " << after[i];
    }
  }
}

TEST(Wrote, IsSaidByAllThatWriteAMeshOrAPicture) {
  const Folder folder;
  const std::string off = folder / "a.off", picture = folder / "a.png";
  const std::string path = folder / "a.vtk";
  EXPECT_EQ(run({"convert", folder.file("t.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), path}).out,
            "wrote " + path + " (3 vertices, 1 element)\n");
  EXPECT_THAT(run({"generate", "grid", "-o", off, "--size", "100"}).out, ::testing::StartsWith("wrote " + off + " ("));
  const Output drawn = run({"render", off, "-o", picture, "--size", "64x48"});
  if (cannot_draw(drawn)) GTEST_SKIP() << drawn.err;
  EXPECT_EQ(drawn.out, "wrote " + picture + " (64 x 48 pixels)\n");
}

TEST(Info, SaysInOneSentenceWhyCudaIsNotUsed) {
  if (json_of(run({"info", "--json"}))["backends"][1]["usable"] == true) GTEST_SKIP() << "CUDA is used here";
  const std::string text = run({"info"}).out;
  EXPECT_THAT(text, HasSubstr("path   from the processor's memory, since CUDA is not usable: "));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("no cuda")));
}

TEST(Convert, SaysWhatIsLost) {
  const Folder folder;
  const Output output = run({"convert", sample("coast.14"), folder / "coast.stl"});
  EXPECT_EQ(output.code, 0);
  EXPECT_THAT(output.err, ::testing::Not(IsEmpty()));
}

TEST(Script, RunsSessionCommandsAndStopsAtTheFirstError) {
  const Folder folder;
  const std::string good = "# smooths a little\nopen \"" + sample("coast.14") + "\"\nrun 2\nexpect iteration == 2\nexport \"" +
                           (folder / "a.14") + "\"\nsay done\n";
  const Output output = run({"script", folder.file("good.txt", good), "--headless"});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_THAT(output.out, HasSubstr("done"));
  EXPECT_TRUE(exists(folder / "a.14"));
  // Writes the mesh that the smooth verb writes.
  ASSERT_EQ(run({"smooth", sample("coast.14"), "-o", folder / "b.14", "--iterations", "2"}).code, 0);
  EXPECT_TRUE(read_file(folder / "a.14") == read_file(folder / "b.14"));

  const std::string bad = folder.file("bad.txt", "open \"" + sample("coast.14") + "\"\nexpect minimum > 2\nsay never\n");
  const Output stopped = run({"script", bad});
  EXPECT_EQ(stopped.code, 1);
  EXPECT_THAT(stopped.err, HasSubstr(bad + ":2: "));
  EXPECT_THAT(stopped.out, ::testing::Not(HasSubstr("never")));

  EXPECT_EQ(run({"script", folder.file("usage.txt", "step sideways\n")}).code, 2);
  EXPECT_EQ(run({"script", folder.file("missing.txt", "open \"" + (folder / "none.14") + "\"\n")}).code, 3);
  EXPECT_EQ(run({"script", folder / "none.txt"}).code, 3);
}

TEST(Script, ReadsStandardInput) {
  Call call;
  call.arguments = {"script", "-"};
  call.input = "say hello\nexpect minimum > 0\n";
  const Output output = run(call);
  EXPECT_EQ(output.code, 2);  // no mesh is open
  EXPECT_THAT(output.out, HasSubstr("hello"));
  EXPECT_THAT(output.err, HasSubstr("standard input:2: "));
}

TEST(Script, UnknownCommandsAreToldBeforeAnythingIsNeeded) {
  Call call;
  call.arguments = {"script", "-"};
  call.input = "say never\nbogus 3\n";
  const Output output = run(call);
  EXPECT_EQ(output.code, 2);
  EXPECT_THAT(output.out, IsEmpty());
  EXPECT_THAT(output.err, HasSubstr("standard input:2: unknown command 'bogus'"));
}

TEST(Usage, WordsThatNothingTakesAreSaidInTheirOrderWithAGuess) {
  const Output methods = run({"compare", "a.vtk", "--method", "laplace", "--method", "dmo"});
  EXPECT_EQ(methods.code, 2);
  EXPECT_THAT(methods.err, HasSubstr("not expected: --method laplace --method dmo"));
  EXPECT_THAT(run({"info", "a.vtk", "--jsno"}).err, HasSubstr("not expected: --jsno; did you mean --json?"));
  EXPECT_THAT(run({"qualty", "a.vtk"}).err, HasSubstr("did you mean quality?"));
}

TEST(Convert, TheOutputIsAWordOrAnOption) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "random", "--size", "200", "-o", folder / "a.vtk"}).code, 0);
  EXPECT_EQ(run({"convert", folder / "a.vtk", folder / "b.off"}).code, 0);
  EXPECT_EQ(run({"convert", folder / "a.vtk", "-o", folder / "c.off"}).code, 0);
  EXPECT_EQ(read_file(folder / "b.off"), read_file(folder / "c.off"));
}

TEST(Window, AFileThatIsNotThereIsToldBeforeTheDisplay) {
  const Output output = run({"bogus"});
  EXPECT_EQ(output.code, 3);
  EXPECT_THAT(output.err, AllOf(HasSubstr("bogus"), HasSubstr("no such file and no such subcommand"), HasSubstr("compare"),
                                HasSubstr("paper"), ::testing::Not(HasSubstr("DISPLAY"))));
}

/// Two triangles far from the origin, where floats lie 1/16 apart: a tip 1/64 beside the middle of its base is above it in floats.
TEST(Quality, TextThatDeclaresFloatsIsJudgedAsThoseWhoTakeTheWordSeeIt) {
  const Folder folder;
  const auto bytes = [](const char* type) {
    return std::string("# vtk DataFile Version 3.0\nfar\nASCII\nDATASET POLYDATA\nPOINTS 4 ") + type +
           "\n1000000 0 0\n1000001 0 0\n1000000.515625 0.5 0\n1000000.5 -0.5 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 3 1\n";
  };
  const std::string floats = folder.file("floats.vtk", bytes("float")), doubles = folder.file("doubles.vtk", bytes("double"));
  const std::string sentence = "its points are declared as float: digits beyond that were left out, which moves vertices by up to 0.0156";
  // 4 sqrt(3) times the area of 1/4, by the sum of the squared sides: 2 with the tip above the middle, 2 + 2/64^2 beside it.
  const double above = std::sqrt(3.0) / 2.0, beside = std::sqrt(3.0) / (2.0 + 2.0 / 4096.0);
  for (const auto& [mesh, expected] : {std::pair(floats, above), std::pair(doubles, beside)}) {
    const Output judged = run({"quality", mesh, "--metric", "mean-ratio", "--json"});
    EXPECT_NEAR(json_of(judged)["metrics"][0]["minimum"].get<double>(), expected, 1e-12);
    EXPECT_EQ(judged.err.find(sentence) != std::string::npos, mesh == floats) << judged.err;
  }
  const std::string out = folder / "out.vtk";
  EXPECT_THAT(run({"smooth", floats, "-o", out, "--iterations", "1"}).err, HasSubstr(sentence));
  EXPECT_EQ(read_file(out), bytes("float")) << "no vertex is free, and the characters stay";
  EXPECT_THAT(run({"quality", folder.file("huge.vtk", bytes("float").replace(bytes("float").find("1000001"), 7, "1e40"))}).err,
              HasSubstr("declared as float, which cannot hold the coordinates of vertex 1"));
}

}  // namespace
}  // namespace dmoscope::test
