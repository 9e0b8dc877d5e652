// dmoscope smooth on real meshes and on the samples: its results, the content that it keeps, and its messages.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

/// Content of a fort.14, read by this test: the words of its lines, and the vertices on no boundary edge.
struct Fort14 {
  std::vector<std::string> lines;
  std::size_t elements = 0, vertices = 0;
  std::vector<bool> free;

  explicit Fort14(const std::string& path) : lines(lines_of(read_file(path))) {
    std::istringstream(lines.at(1)) >> elements >> vertices;
    std::map<std::pair<std::size_t, std::size_t>, int> edges;
    for (std::size_t e = 0; e < elements; ++e) {
      std::istringstream line(lines.at(2 + vertices + e));
      std::size_t id = 0, count = 0;
      line >> id >> count;
      std::vector<std::size_t> corners(count);
      for (std::size_t& corner : corners) line >> corner;
      for (std::size_t i = 0; i < count; ++i) ++edges[std::minmax(corners[i], corners[(i + 1) % count])];
    }
    free.assign(vertices + 1, false);
    for (const auto& [edge, uses] : edges) free[edge.first] = free[edge.second] = true;
    for (const auto& [edge, uses] : edges) {
      if (uses != 2) free[edge.first] = free[edge.second] = false;
    }
  }
  [[nodiscard]] std::vector<std::string> words(std::size_t line) const {
    std::istringstream stream(lines.at(line));
    std::vector<std::string> list;
    for (std::string word; stream >> word;) list.push_back(word);
    return list;
  }
};

/// The line without its second and third word, with its blanks.
std::string without_coordinates(const std::string& line) {
  std::string kept;
  std::size_t word = 0;
  bool inside = false;
  for (const char c : line) {
    const bool blank = c == ' ' || c == '\t' || c == '\r';
    if (!blank && !inside) ++word;
    inside = !blank;
    if (blank || (word != 2 && word != 3)) kept += c;
  }
  return kept;
}

/// Expects the output to equal the input but for x and y of free vertices; returns how many lines differ.
std::size_t expect_only_free_coordinates_differ(const std::string& input, const std::string& output) {
  const Fort14 before(input), after(output);
  EXPECT_EQ(before.lines.size(), after.lines.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < std::min(before.lines.size(), after.lines.size()); ++i) {
    if (before.lines[i] == after.lines[i]) continue;
    ++differing;
    const bool vertex = i >= 2 && i < 2 + before.vertices;
    EXPECT_TRUE(vertex && before.free[std::stoul(before.words(i).at(0))]) << "line " << i + 1;
    EXPECT_EQ(without_coordinates(before.lines[i]), without_coordinates(after.lines[i])) << "line " << i + 1;
  }
  return differing;
}

/// Expects one row of statistics per iteration, and a minimum that never falls.
void expect_rising(const std::string& stats, std::size_t iterations) {
  const Table table = read_table(stats);
  const std::vector<std::string> documented{"run", "iteration", "min_quality", "mean_quality", "inverted", "moved", "seconds"};
  ASSERT_GE(table.header.size(), documented.size());
  EXPECT_TRUE(std::equal(documented.begin(), documented.end(), table.header.begin()));
  ASSERT_EQ(table.rows.size(), iterations + 1);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    EXPECT_EQ(table.number(i, "iteration"), static_cast<double>(i));
    if (i == 0) continue;
    EXPECT_LE(table.number(i, "inverted"), table.number(i - 1, "inverted"));
    if (table.number(i - 1, "inverted") == 0) {
      EXPECT_GE(table.number(i, "min_quality"), table.number(i - 1, "min_quality"));
    }
  }
}

#define REQUIRE_SHARED(path, name)            \
  const std::string path = shared_mesh(name); \
  if (path.empty()) GTEST_SKIP() << "the shared meshes are not here"

TEST(Smooth, MethodsHaveTheirOptions) {
  const Folder folder;
  const auto minimum = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words{"--iterations", "3", "--json"};
    words.insert(words.end(), options.begin(), options.end());
    return smooth(sample("coast.14"), folder / "out.14", words)["after"]["minimum"].get<double>();
  };
  const double dvr = minimum({"--method", "dvr"});
  EXPECT_EQ(minimum({"--method", "dvr", "--seed", "1"}), dvr);
  EXPECT_NE(minimum({"--method", "dvr", "--seed", "2"}), dvr);
  EXPECT_NE(minimum({"--method", "dvr", "--directions", "axes"}), dvr);
  EXPECT_NE(minimum({"--method", "laplace", "--relaxation", "0.5"}), minimum({"--method", "laplace"}));
  const auto json = smooth(sample("coast.14"), folder / "out.14", {"--iterations", "1", "--method", "laplace", "--relaxation", "0.25"});
  EXPECT_EQ(json["method"], "laplace");
  EXPECT_EQ(json["simd"], "scalar");
  EXPECT_EQ(json["parameters"]["relaxation"], 0.25);
  EXPECT_EQ(json["parameters"]["directions"], "random");
  EXPECT_EQ(json["parameters"]["seed"], 1);
}

TEST(Smooth, JsonHasTheDocumentedKeys) {
  const Folder folder;
  const auto json = smooth(sample("coast.14"), folder / "out.14", {"--iterations", "2", "--threads", "2", "--backend", "cpu"});
  for (const char* key : {"input", "output", "vertices", "elements", "free", "method", "metric", "backend", "backend_reason", "threads",
                          "simd", "parameters", "iterations", "stopped", "last_rise", "before", "after", "seconds", "warnings"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  for (const char* when : {"before", "after"}) {
    for (const char* key : {"minimum", "mean", "movable_minimum", "ceiling", "inverted"}) EXPECT_TRUE(json[when].contains(key)) << key;
  }
  EXPECT_EQ(json["method"], "dmo");
  EXPECT_EQ(json["metric"], "mean-ratio");
  EXPECT_EQ(json["backend"], "cpu");
  EXPECT_EQ(json["threads"], 2);
  EXPECT_EQ(json["simd"], json_of(run({"info", "--json"}))["simd"]["used"]);
  const auto baseline = smooth(sample("coast.14"), folder / "out.14", {"--iterations", "2", "--simd", "baseline"});
  EXPECT_EQ(baseline["simd"], "baseline");
  EXPECT_EQ(smooth(sample("coast.14"), folder / "d.14", {"--iterations", "1", "--precision", "double"})["simd"], "scalar");
  EXPECT_EQ(json["iterations"], 2);
  EXPECT_GE(json["after"]["minimum"], json["before"]["minimum"]);
  // The report about the output holds when the output is judged anew.
  const auto judged = json_of(run({"quality", folder / "out.14", "--metric", "mean-ratio", "--json"}));
  EXPECT_EQ(judged["metrics"][0]["minimum"], json["after"]["minimum"]);
}

TEST(Smooth, AcrossTheMeridianElementsAreJudgedUnwrappedAndReadAgainTheSame) {
  const Folder folder;
  for (const auto& [kind, extension] : {std::pair{"wrapped", ".14"}, {"globe", ".vtk"}})
    for (const char* metric : {"mean-ratio", std::string_view(kind) == "globe" ? "scaled-jacobian" : "min-angle"}) {
      const std::string in = folder / (std::string("in") + extension), out = folder / (std::string("out") + extension);
      ASSERT_EQ(run({"generate", kind, "-o", in, "--size", "600", "--seed", "4"}).code, 0);
      const auto json = smooth(in, out, {"--iterations", "5", "--metric", metric});
      EXPECT_EQ(json["before"]["inverted"], 0) << kind;
      EXPECT_EQ(json["after"]["inverted"], 0) << kind;
      EXPECT_GT(json["after"]["minimum"], json["before"]["minimum"]) << kind;
      EXPECT_THAT(json["warnings"].dump(), HasSubstr("elements cross the meridian of 180 degrees and are judged unwrapped"));
      const auto judged = json_of(run({"quality", out, "--metric", metric, "--json"}));
      EXPECT_EQ(judged["inverted"], 0) << kind;
      EXPECT_EQ(judged["metrics"][0]["minimum"], json["after"]["minimum"]) << kind;
      EXPECT_NEAR(judged["metrics"][0]["mean"].get<double>(), json["after"]["mean"].get<double>(), 1e-12) << kind;
      // All elements near 0 are the piece's: others have their middles elsewhere.
      const auto all = json_of(run({"quality", in, "--metric", metric, "--worst", "10000", "--json"}))["metrics"][0]["worst"];
      for (const auto& element : all) {
        const double x = element["centroid"][0];
        EXPECT_LE(std::abs(x), 180.0) << kind;
        EXPECT_TRUE(std::abs(x) > 150.0 || std::string_view(kind) == "globe") << element["element"];
      }
    }
}

TEST(Smooth, SummaryForAPersonNamesWhatCounts) {
  const Folder folder;
  const Output output = run({"smooth", sample("coast.14"), "-o", folder / "out.14", "--iterations", "1"});
  for (const char* word : {"minimum", "movable minimum", "ceiling", "mean", "inverted", "vertices/s", "last rose"}) {
    EXPECT_THAT(output.out, HasSubstr(word));
  }
}

TEST(Smooth, SampleChangesOnlyFreeCoordinates) {
  const Folder folder;
  smooth(sample("coast.14"), folder / "out.14", {"--iterations", "3", "--stats", folder / "s.csv", "--fields", "carry"});
  EXPECT_GT(expect_only_free_coordinates_differ(sample("coast.14"), folder / "out.14"), 0U);
  expect_rising(folder / "s.csv", 3);
}

TEST(Smooth, InPlaceGivesTheSameFile) {
  const Folder folder;
  smooth(sample("coast.14"), folder / "out.14", {"--iterations", "2"});
  const std::string copy = folder.file("copy.14", read_file(sample("coast.14")));
  smooth(copy, copy, {"--iterations", "2"});
  EXPECT_TRUE(read_file(copy) == read_file(folder / "out.14"));
}

TEST(Smooth, ThreadsAndRepetitionDoNotMatter) {
  const Folder folder;
  std::set<std::string> results;
  for (const char* threads : {"1", "2", "1", "3"}) {
    smooth(sample("coast.14"), folder / "out.14", {"--iterations", "3", "--threads", threads});
    results.insert(read_file(folder / "out.14"));
  }
  EXPECT_EQ(results.size(), 1U);
  smooth(sample("coast.14"), folder / "out.14", {"--iterations", "3", "--order", "shuffle:5"});
  EXPECT_FALSE(results.contains(read_file(folder / "out.14")));
}

TEST(Smooth, FixedVerticesAndGroupsStay) {
  const Folder folder;
  const std::size_t vertices = json_of(run({"quality", sample("coast.14"), "--json"}))["vertices"];
  smooth(sample("coast.14"), folder / "out.14", {"--iterations", "2", "--fix", "0-" + std::to_string(vertices - 1)});
  EXPECT_TRUE(read_file(folder / "out.14") == read_file(sample("coast.14")));
  const auto all = smooth(sample("coast.14"), folder / "out.14", {"--iterations", "1"});
  const auto some = smooth(sample("coast.14"), folder / "out.14", {"--iterations", "1", "--fix", "10,20-25"});
  EXPECT_LE(some["free"], all["free"]);
  const std::string grid =
      "OFF\n9 4 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1.3 1.2 0\n2 1 0\n0 2 0\n1 2 0\n2 2 0\n4 0 1 4 3\n4 1 2 5 4\n4 3 4 7 6\n4 4 5 8 7\n";
  const std::string file = folder.file("grid.off", grid);
  smooth(file, folder / "kept.off", {"--fix", "4"});
  EXPECT_TRUE(read_file(folder / "kept.off") == grid);
  smooth(file, folder / "moved.off", {});
  EXPECT_NE(read_file(folder / "moved.off"), grid);
}

TEST(Smooth, SaysWhyItDidNotConverge) {
  const Folder folder;
  const Output output =
      run({"smooth", sample("coast.14"), "-o", folder / "out.14", "--until-converged", "--max-iterations", "1", "--json"});
  EXPECT_EQ(output.code, 1) << output.err;
  EXPECT_EQ(json_of(output)["stopped"], "iteration-limit");
  EXPECT_TRUE(exists(folder / "out.14"));
  EXPECT_THAT(output.err, HasSubstr("not converged"));
}

/// The minimum rises no more, and the mean falls: the iteration with the greatest mean is written.
TEST(Smooth, UntilConvergedWritesTheBestByMinimumThenMean) {
  const Folder folder;
  const auto best = smooth(sample("random.off"), folder / "best.off", {"--until-converged", "--stats", folder / "s.csv"});
  const auto last = smooth(sample("random.off"), folder / "last.off", {"--until-converged", "--write", "last"});
  const Table table = read_table(folder / "s.csv");
  const std::size_t written = best["written_iteration"], ended = best["iterations"];
  ASSERT_LT(written, ended) << "else this test shows nothing";
  EXPECT_EQ(last["written_iteration"], ended);
  EXPECT_GT(best["after"]["minimum"].get<double>(), last["after"]["minimum"].get<double>() - 1e-6);
  EXPECT_GT(best["after"]["mean"], last["after"]["mean"]);
  for (std::size_t i = best["last_rise"]; i < table.rows.size(); ++i)
    EXPECT_LE(table.number(i, "mean_quality"), best["after"]["mean"].get<double>()) << i;
  EXPECT_NE(read_file(folder / "best.off"), read_file(folder / "last.off"));
  // A given number of iterations is done; and those iterations are the same.
  const auto counted = smooth(sample("random.off"), folder / "counted.off", {"--iterations", std::to_string(written)});
  EXPECT_EQ(read_file(folder / "counted.off"), read_file(folder / "best.off"));
  smooth(sample("random.off"), folder / "all.off", {"--iterations", std::to_string(ended)});
  EXPECT_EQ(read_file(folder / "all.off"), read_file(folder / "last.off"));
}

TEST(Smooth, CurvedSurfaces) {
  const Folder folder;
  // Four squares around the origin, bent along the x axis, with a misplaced middle.
  const std::string bent = folder.file("bent.off",
                                       "OFF\n9 4 0\n-1 -1 0.2\n0 -1 0.2\n1 -1 0.2\n-1 0 0\n0.4 0 0\n1 0 0\n-1 1 0.2\n0 1 0.2\n1 1 0.2\n"
                                       "4 0 1 4 3\n4 1 2 5 4\n4 3 4 7 6\n4 4 5 8 7\n");
  const auto json = smooth(bent, folder / "out.off", {"--iterations", "5"});
  EXPECT_EQ(json["sliding"], 1);
  EXPECT_GT(json["after"]["minimum"], json["before"]["minimum"]);
  // Places as near to the surface exist along the fold alone: dvr moves by the axes.
  for (const char* method : {"active-set", "dvr", "pattern-search"}) {
    const auto other = smooth(bent, folder / "other.off", {"--iterations", "5", "--method", method, "--directions", "axes"});
    EXPECT_GT(other["after"]["minimum"], other["before"]["minimum"]) << method;
  }
}

/// Without a projection, as in the paper.
TEST(Smooth, EastCoast) {
  REQUIRE_SHARED(east, "ocean/east.14");
  const Folder folder;
  const auto json =
      smooth(east, folder / "E.14", {"--geographic", "off", "--iterations", "4", "--stats", folder / "E.csv", "--fields", "carry"});
  EXPECT_NEAR(json["before"]["minimum"].get<double>(), 0.6528, 1e-4);
  EXPECT_GE(json["after"]["minimum"], 0.812);
  EXPECT_EQ(json["free"], 8429);
  expect_rising(folder / "E.csv", 4);
  EXPECT_GT(expect_only_free_coordinates_differ(east, folder / "E.14"), 0U);

  smooth(east, folder / "one.14", {"--geographic", "off", "--iterations", "4", "--threads", "1"});
  smooth(east, folder / "two.14", {"--geographic", "off", "--iterations", "4", "--threads", "2"});
  EXPECT_TRUE(read_file(folder / "one.14") == read_file(folder / "two.14"));
  smooth(east, folder / "carried.14", {"--geographic", "off", "--iterations", "4", "--threads", "1", "--fields", "carry"});
  EXPECT_TRUE(read_file(folder / "carried.14") == read_file(folder / "E.14"));
}

TEST(Smooth, FarFromTheOriginIsNoWorse) {
  REQUIRE_SHARED(east, "ocean/east.14");
  const Fort14 mesh(east);
  std::ostringstream shifted;
  shifted.precision(17);
  for (std::size_t i = 0; i < mesh.lines.size(); ++i) {
    if (i < 2 || i >= 2 + mesh.vertices) {
      shifted << mesh.lines[i] << '\n';
      continue;
    }
    const auto words = mesh.words(i);
    shifted << words.at(0) << ' ' << std::stod(words.at(1)) + 1e6 << ' ' << std::stod(words.at(2)) + 1e6 << ' ' << words.at(3) << '\n';
  }
  const Folder folder;
  const auto here = smooth(east, folder / "a.14", {"--iterations", "4", "--geographic", "off"});
  const auto there = smooth(folder.file("shifted.14", shifted.str()), folder / "b.14", {"--iterations", "4"});
  EXPECT_NEAR(here["after"]["minimum"].get<double>(), there["after"]["minimum"].get<double>(), 1e-4);
}

TEST(Smooth, Bahamas) {
  REQUIRE_SHARED(bahamas, "ocean/bahamas.14");
  const Folder folder;
  const auto json = smooth(bahamas, folder / "out.14", {"--iterations", "50", "--stats", folder / "s.csv"});
  EXPECT_GE(json["after"]["minimum"], 0.765);
  expect_rising(folder / "s.csv", 50);
}

TEST(Smooth, ShashkovUntilConverged) {
  REQUIRE_SHARED(shashkov, "tri/shashkov.vtk");
  const Folder folder;
  const auto json = smooth(shashkov, folder / "out.vtk", {"--until-converged"});
  EXPECT_GE(json["after"]["minimum"], 0.190);
  EXPECT_LE(json["iterations"], 2000);
  EXPECT_TRUE(json["stopped"] == "no-rise" || json["stopped"] == "nothing-moved") << json["stopped"];
  EXPECT_GT(json["last_rise"], 0);
}

TEST(Smooth, OvertHybridNeverInverts) {
  REQUIRE_SHARED(overt, "mixed2d/overt_hyb_1.vtk");
  const Folder folder;
  const auto json = smooth(overt, folder / "out.vtk", {"--iterations", "20", "--stats", folder / "s.csv"});
  EXPECT_NEAR(json["before"]["minimum"].get<double>(), 0.193, 1e-3);
  EXPECT_GE(json["after"]["minimum"], 0.60);
  const Table table = read_table(folder / "s.csv");
  for (std::size_t i = 0; i < table.rows.size(); ++i) EXPECT_EQ(table.number(i, "inverted"), 0.0);
}

TEST(Smooth, TangledMeshesUntangle) {
  for (const char* name : {"tri/tangled_tri.vtk", "quad/tangled_quad.vtk"}) {
    REQUIRE_SHARED(tangled, name);
    const Folder folder;
    const auto json = smooth(tangled, folder / "out.vtk", {"--iterations", "20"});
    EXPECT_GT(json["before"]["inverted"], 0) << name;
    EXPECT_EQ(json["after"]["inverted"], 0) << name;
  }
}

}  // namespace
}  // namespace dmoscope::test
