// dmoscope bench: its measurements, output and refusals, whatever the time.

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAreArray;

/// Runs `dmoscope bench` with little work; `options` are added.
Output bench(std::vector<std::string> options) {
  options.insert(options.begin(), "bench");
  for (const auto& [option, value] : {std::pair{"--repeats", "1"}, {"--iterations", "1"}, {"--backend", "cpu"}}) {
    if (std::find(options.begin(), options.end(), option) == options.end()) options.insert(options.end(), {option, value});
  }
  return run(options);
}

Json bench_json(std::vector<std::string> options) {
  options.emplace_back("--json");
  return json_of(bench(std::move(options)));
}

std::string name_of(const Json& figure) {
  return figure["mesh"].get<std::string>() + ' ' + figure["metric"].get<std::string>() + ' ' + figure["simd"].get<std::string>() + ' ' +
         figure["precision"].get<std::string>() + ' ' + std::to_string(figure["threads"].get<int>());
}

std::vector<std::string> names_of(const Json& bench) {
  std::vector<std::string> names;
  for (const Json& figure : bench["figures"]) names.push_back(name_of(figure));
  return names;
}

/// Expects that every number of a figure that follows from others does so; `reference`: the one before, which it is compared with.
void expect_consistent(const Json& figure, const Json& reference) {
  const Json& seconds = figure["seconds"];
  EXPECT_GT(seconds["lowest"], 0.0);
  EXPECT_LE(seconds["lowest"], seconds["median"]);
  EXPECT_LE(seconds["median"], seconds["highest"]);
  const double visits = figure["free"].get<double>() * figure["iterations"].get<double>();
  EXPECT_DOUBLE_EQ(figure["vertices_per_second"], visits / seconds["median"].get<double>());
  EXPECT_DOUBLE_EQ(figure["ns_per_visit"], 1e9 * seconds["median"].get<double>() / visits);
  const double iterations = figure["iterations"], step = figure["step_seconds"]["median"], prepare = figure["prepare_seconds"]["median"];
  EXPECT_GT(prepare, 0.0);
  EXPECT_DOUBLE_EQ(figure["iterations_per_second"], iterations / seconds["median"].get<double>());
  EXPECT_DOUBLE_EQ(figure["prepare_share"], prepare / (prepare + iterations * step));
  EXPECT_EQ(figure["reference_vertices_per_second"], reference["vertices_per_second"]);
  const double plain =
      reference["seconds"]["median"].get<double>() / (reference["free"].get<double>() * reference["iterations"].get<double>());
  EXPECT_DOUBLE_EQ(figure["ratio"], plain / (seconds["median"].get<double>() / visits));
}

TEST(Bench, JsonTellsTheMachineTheBuildAndEveryFigure) {
  const Json all = bench_json({"--sizes", "200,1e3", "--repeats", "3", "--iterations", "2", "--threads", "1,2"});
  for (const char* key : {"version", "commit", "date", "machine", "build", "cuda", "simd", "repeats", "reference", "figures"}) {
    EXPECT_TRUE(all.contains(key)) << key;
  }
  for (const char* key : {"processor", "cores", "memory"}) EXPECT_TRUE(all["machine"].contains(key)) << key;
  for (const char* key : {"compiler", "type", "flags"}) EXPECT_TRUE(all["build"].contains(key)) << key;
  EXPECT_THAT(all["build"]["flags"].get<std::string>(), HasSubstr("-ffp-contract=off"));
  EXPECT_THAT(all["commit"].get<std::string>(), Not(IsEmpty()));
  EXPECT_EQ(all["repeats"], 3);

  const std::string best = all["simd"]["used"];
  ASSERT_THAT(names_of(all), ElementsAre("grid 200 mean-ratio scalar double 1", "grid 200 mean-ratio " + best + " float 1",
                                         "grid 200 mean-ratio " + best + " float 2", "grid 1000 mean-ratio scalar double 1",
                                         "grid 1000 mean-ratio " + best + " float 1", "grid 1000 mean-ratio " + best + " float 2"));
  for (std::size_t i = 0; i < all["figures"].size(); ++i) {
    const Json& figure = all["figures"][i];
    EXPECT_EQ(figure["reference"], i % 3 == 0);
    EXPECT_EQ(figure["elements"], "triangles");
    EXPECT_EQ(figure["method"], "dmo");
    EXPECT_EQ(figure["iterations"], 2);
    // Lattices of 14 x 14 and 32 x 31 vertices, whose rims are fixed.
    EXPECT_EQ(figure["vertices"], i < 3 ? 196 : 992);
    EXPECT_EQ(figure["free"], i < 3 ? 12 * 12 : 30 * 29);
    EXPECT_FALSE(figure.contains("settling"));
    expect_consistent(figure, all["figures"][i / 3 * 3]);
  }
}

TEST(Bench, MeasuresTwoAims) {
  const Json all = bench_json({"--sizes", "200", "--repeats", "1", "--threads", "1", "--combine", "mean-ratio:0.6:min-angle"});
  ASSERT_EQ(all["figures"].size(), 2U);
  for (const Json& figure : all["figures"]) {
    EXPECT_EQ(figure["combination"], "mean-ratio:0.6:min-angle");
    EXPECT_EQ(figure["precision"], "double");
    expect_consistent(figure, all["figures"][0]);
  }
  EXPECT_EQ(all["figures"][0]["simd"], "scalar");
  EXPECT_EQ(all["figures"][1]["simd"], all["simd"]["used"]);
}

TEST(Bench, MeasuresEveryMetricKindOfElementsAndLevelThatThereIs) {
  const Json info = json_of(run({"info", "--json"}));
  const Json all = bench_json({"--sizes", "100", "--metric", "all", "--elements", "all", "--simd", "all", "--threads", "1"});
  std::vector<std::string> expected;
  const std::pair<const char*, std::vector<const char*>> meshes[]{{"grid 100", {"triangle"}},
                                                                  {"quads 100", {"quadrilateral"}},
                                                                  {"mixed 100", {"triangle", "quadrilateral"}},
                                                                  {"tetrahedra 100", {"tetrahedron"}},
                                                                  {"hexahedra 100", {"hexahedron"}},
                                                                  {"solids 100", {"tetrahedron", "hexahedron", "wedge", "pyramid"}}};
  for (const auto& entry : meshes) {
    for (const Json& metric : info["metrics"]) {
      const auto defined_for = [&metric](const char* kind) {
        return std::ranges::find(metric["elements"], Json(kind)) != metric["elements"].end();
      };
      if (!std::ranges::all_of(entry.second, defined_for)) continue;
      const std::string start = std::string(entry.first) + ' ' + metric["name"].get<std::string>() + ' ';
      expected.push_back(start + "scalar double 1");
      for (const Json& level : info["simd"]["levels"]) expected.push_back(start + level.get<std::string>() + " float 1");
    }
  }
  EXPECT_THAT(names_of(all), UnorderedElementsAreArray(expected));
}

TEST(Bench, ListsHaveNoEntryTwiceAndPairsThatCannotBeAreLeftOut) {
  EXPECT_EQ(
      bench_json({"--sizes", "200,2e2", "--threads", "1,1", "--simd", "auto,baseline,auto", "--metric", "mean-ratio,mean-ratio"})["figures"]
          .size(),
      bench_json({"--sizes", "200", "--threads", "1"})["simd"]["levels"].size() > 1 ? 3U : 2U);
  const Json some =
      bench_json({"--sizes", "200", "--threads", "1", "--metric", "min-angle,mean-ratio", "--elements", "triangles,quadrilaterals"});
  std::set<std::string> pairs;
  for (const Json& figure : some["figures"])
    pairs.insert(figure["elements"].get<std::string>() + ' ' + figure["metric"].get<std::string>());
  EXPECT_THAT(pairs, ElementsAre("quadrilaterals mean-ratio", "triangles mean-ratio", "triangles min-angle"));
}

TEST(Bench, MeasuresTheBackendsAskedForOrRefusesThemWithTheReason) {
  const Json info = json_of(run({"info", "--json"}));
  const Json& cuda = info["backends"][1];
  const auto backends = [](const Json& all) {
    std::set<std::string> names;
    for (const Json& figure : all["figures"])
      if (figure["reference"] == false) names.insert(figure["backend"].get<std::string>());
    return names;
  };
  const Json automatic = bench_json({"--sizes", "200", "--threads", "1", "--backend", "auto"});
  const Output by_name = bench({"--sizes", "200", "--threads", "1", "--backend", "cuda", "--json"});
  EXPECT_THAT(backends(bench_json({"--sizes", "200", "--threads", "1", "--backend", "cpu"})), ElementsAre("cpu"));
  EXPECT_EQ(automatic["cuda"]["measured"], cuda["usable"]);
  if (cuda["usable"] == true) {
    EXPECT_THAT(backends(automatic), ElementsAre("cpu", "cuda"));
    EXPECT_THAT(backends(json_of(by_name)), ElementsAre("cuda"));
    return;
  }
  EXPECT_THAT(backends(automatic), ElementsAre("cpu"));
  EXPECT_EQ(automatic["cuda"]["reason"], cuda["reason"]);
  EXPECT_EQ(by_name.code, 2);
  EXPECT_THAT(by_name.out, IsEmpty());
  EXPECT_THAT(by_name.err, HasSubstr(cuda["reason"].get<std::string>()));
}

TEST(Bench, ComparesALateIterationWithTheFirst) {
  const Json all = bench_json({"--sizes", "200", "--threads", "1", "--iterations", "2", "--active", "5"});
  ASSERT_EQ(all["figures"].size(), 2U);
  EXPECT_FALSE(all["figures"][0].contains("settling"));
  const Json& settling = all["figures"][1]["settling"];
  EXPECT_EQ(all["figures"][1]["iterations"], 2);
  EXPECT_EQ(settling["iteration"], 5);
  EXPECT_DOUBLE_EQ(settling["ratio"], settling["first_seconds"].get<double>() / settling["seconds"].get<double>());
  // The first of the two timed iterations cannot have taken longer than both; one repeat, so these are the same clock's readings.
  EXPECT_LE(settling["first_seconds"], all["figures"][1]["seconds"]["median"]);
}

TEST(Bench, TellsTheTimeFromTheMeshToTheSmoothedOne) {
  const Json figure = bench_json({"--sizes", "2000", "--threads", "1", "--iterations", "3", "--end-to-end"})["figures"][1];
  const double prepare = figure["prepare_seconds"]["lowest"], step = figure["step_seconds"]["lowest"];
  EXPECT_GE(figure["end_to_end_seconds"]["lowest"].get<double>(), prepare + 3 * step);
  EXPECT_FALSE(bench_json({"--sizes", "2000", "--threads", "1"})["figures"][1].contains("end_to_end_seconds"));
  EXPECT_THAT(bench({"--sizes", "2000", "--threads", "1", "--end-to-end"}).out, HasSubstr("end to end"));
  for (const auto& other : {"--active", "--draw", "--seek"}) EXPECT_EQ(bench({"--end-to-end", other, "2"}).code, 2) << other;
}

TEST(Bench, TakesAMeshOfOnesOwn) {
  const Json small = bench_json({sample("annulus.off"), "--threads", "1"});
  ASSERT_EQ(small["figures"].size(), 2U);
  for (const Json& figure : small["figures"]) {
    EXPECT_EQ(figure["mesh"], "annulus.off");
    EXPECT_EQ(figure["elements"], "triangles");
    expect_consistent(figure, small["figures"][0]);
  }
  EXPECT_EQ(bench_json({sample("mixed.vtk"), "--threads", "1"})["figures"][1]["elements"], "mixed");
}

TEST(Bench, TheReferenceOfALargeMeshIsMeasuredOnASmallerOne) {
  const Folder folder;
  ASSERT_EQ(run({"generate", "grid", "-o", folder / "large.off", "--size", "22500"}).code, 0);
  const Json large = bench_json({folder / "large.off", "--threads", "1", "--iterations", "3"});
  ASSERT_EQ(large["figures"].size(), 2U);
  const Json& reference = large["figures"][0];
  EXPECT_EQ(reference["mesh"], "grid 10000");
  EXPECT_EQ(reference["free"], 98 * 98);
  EXPECT_EQ(reference["iterations"], 2);  // with 9604 visits each, at most 20000 in all
  EXPECT_EQ(large["figures"][1]["free"], 148 * 148);
  EXPECT_EQ(large["figures"][1]["iterations"], 3);
  expect_consistent(large["figures"][1], reference);
}

TEST(Bench, TheReferenceOfAVolumeIsSmallerStill) {
  const Json all = bench_json({"--sizes", "3375", "--elements", "tetrahedra", "--threads", "1", "--iterations", "2"});
  ASSERT_EQ(all["figures"].size(), 2U);
  const Json& reference = all["figures"][0];
  EXPECT_EQ(reference["mesh"], "tetrahedra 2000");
  EXPECT_EQ(reference["iterations"], 1);
  EXPECT_LT(reference["free"], 2000);
  EXPECT_EQ(all["figures"][1]["vertices"], 3375);
  EXPECT_EQ(all["figures"][1]["free"], 13 * 13 * 13);
  expect_consistent(all["figures"][1], reference);
}

TEST(Bench, TableHasARowForEveryFigure) {
  const Output table = bench({"--sizes", "200,300", "--threads", "1", "--active", "2"});
  EXPECT_EQ(table.code, 0);
  std::size_t rows = 0;
  for (const std::string& line : lines_of(table.out)) rows += line.starts_with("grid ") ? 1U : 0U;
  EXPECT_EQ(rows, 4U);
  EXPECT_THAT(table.out, AllOf(HasSubstr("plain scalar search in double"), HasSubstr("grid 300"), HasSubstr("iteration 2 against 1")));
}

TEST(Bench, RefusesWhatItCannotMeasure) {
  const Folder folder;
  const std::string in = sample("coast.14");
  const std::string triangle = folder.file("one.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  std::vector<std::vector<std::string>> wrong{
      {"--sizes", "many"},
      {"--sizes", "1e4,"},
      {"--sizes", "99"},
      {"--sizes", "1e8"},
      {"--sizes", "-1000"},
      {"--sizes", "1000.5"},
      {"--sizes", "nan"},
      {"--sizes", "1e7", "--elements", "quadrilaterals"},
      {"--sizes", "200", "--metric", "beauty"},
      {"--sizes", "200", "--metric", "mean-ratio,"},
      {"--sizes", "200", "--metric", "min-angle", "--elements", "quadrilaterals"},
      {"--sizes", "200", "--metric", "min-angle", "--elements", "triangles,mixed"},
      {"--sizes", "200", "--elements", "dodecahedra"},
      {"--sizes", "200", "--combine", "mean-ratio:0.7"},
      {"--sizes", "200", "--combine", "mean-ratio:0.7:min-angle", "--metric", "mean-ratio"},
      {"--sizes", "200", "--combine", "mean-ratio:0.7:min-angle", "--elements", "quadrilaterals"},
      {"--sizes", "200", "--combine", "mean-ratio:0.7:density", "--elements", "hexahedra"},
      {"--sizes", "200", "--metric", "min-angle", "--elements", "hexahedra"},
      {"--sizes", "200", "--simd", "mmx"},
      {"--sizes", "200", "--backend", "abacus"},
      {"--sizes", "200", "--backend", "cpu,"},
      {"--sizes", "200", "--simd", "all,baseline"},
      {"--sizes", "200", "--threads", "-1"},
      {"--sizes", "200", "--threads", "1025"},
      {"--sizes", "200", "--repeats", "0"},
      {"--sizes", "200", "--iterations", "0"},
      {"--sizes", "200", "--active", "1"},
      {"--sizes", "200", "--plot", folder / "plot.jpeg"},
      {in, "--sizes", "200"},
      {in, "--full"},
      {in, "--elements", "triangles"},
      {in, "--plot", in},
      {sample("mixed.vtk"), "--metric", "min-angle"},
      {triangle},
  };
  const Json levels = json_of(run({"info", "--json"}))["simd"]["levels"];
  for (const char* level : {"avx2", "avx512"}) {
    if (std::find(levels.begin(), levels.end(), level) == levels.end()) wrong.push_back({"--sizes", "200", "--simd", level});
  }
  for (const auto& options : wrong) {
    const Output output = bench(options);
    EXPECT_EQ(output.code, 2) << ::testing::PrintToString(options) << output.err;
    EXPECT_THAT(output.out, IsEmpty()) << ::testing::PrintToString(options);
    EXPECT_THAT(output.err, StartsWith("dmoscope: ")) << ::testing::PrintToString(options);
  }
  EXPECT_EQ(bench({"--sizes", "200", "--plot", folder / "missing/plot.svg"}).code, 3);
  EXPECT_EQ(bench({folder / "missing.off"}).code, 3);
}

TEST(Bench, StopsAtCtrlC) {
  const Folder folder;
  Call call;
  call.arguments = {"bench", "--sizes", "1e5", "--repeats", "1000", "--json", "--plot", folder / "plot.svg"};
  call.interrupt = std::chrono::milliseconds(1500);
  const Output output = run(call);
  EXPECT_EQ(output.code, 1) << output.err;
  EXPECT_THAT(output.out, IsEmpty());
  EXPECT_THAT(output.err, HasSubstr("cancelled"));
  EXPECT_FALSE(exists(folder / "plot.svg"));
}

/// The texts between the tags of all elements named `wanted`; fails the test if the text is not well-formed XML without comments and CDATA.
std::vector<std::string> texts_of(const std::string& xml, const std::string& wanted) {
  std::vector<std::string> open, texts;
  std::size_t at = 0, roots = 0;
  while (at < xml.size()) {
    const std::size_t tag = xml.find('<', at);
    const std::string text = xml.substr(at, tag == std::string::npos ? tag : tag - at);
    EXPECT_EQ(text.find('>'), std::string::npos) << text;
    if (!open.empty() && open.back() == wanted) texts.push_back(text);
    if (tag == std::string::npos) break;
    const std::size_t end = xml.find('>', tag);
    if (end == std::string::npos) {
      ADD_FAILURE() << "a tag without end";
      break;
    }
    const std::string inside = xml.substr(tag + 1, end - tag - 1);
    EXPECT_EQ(std::count(inside.begin(), inside.end(), '"') % 2, 0) << inside;
    if (inside.starts_with('/')) {
      if (open.empty() || open.back() != inside.substr(1)) {
        ADD_FAILURE() << inside << " closes nothing";
        break;
      }
      open.pop_back();
    } else if (!inside.starts_with('?')) {
      roots += open.empty() ? 1U : 0U;
      if (!inside.ends_with('/')) open.push_back(inside.substr(0, inside.find(' ')));
    }
    at = end + 1;
  }
  EXPECT_THAT(open, IsEmpty());
  EXPECT_EQ(roots, 1U);
  return texts;
}

TEST(Bench, PlotHasALineASeries) {
  const Folder folder;
  const Json all = bench_json(
      {"--sizes", "200,300", "--threads", "1,2", "--simd", "baseline", "--metric", "mean-ratio,max-angle", "--plot", folder / "plot.svg"});
  const std::string svg = read_file(folder / "plot.svg");
  const std::vector<std::string> texts = texts_of(svg, "text");
  for (const char* metric : {"triangles, mean-ratio, ", "triangles, max-angle, "}) {
    for (const char* series : {"plain double", "baseline, 1 thread", "baseline, 2 threads"}) {
      EXPECT_EQ(std::count(texts.begin(), texts.end(), std::string(metric) + series), 1) << metric << series;
    }
  }
  EXPECT_THAT(texts, ::testing::IsSupersetOf({"vertices", "million vertex visits per second"}));
  // A dot for every figure, and one a series in the legend.
  std::size_t dots = 0;
  for (std::size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) ++dots;
  EXPECT_EQ(dots, all["figures"].size() + 6);
}

TEST(Bench, PlotOfASingleSizeIsAPlotToo) {
  const Folder folder;
  ASSERT_EQ(bench({sample("annulus.off"), "--threads", "1", "--plot", folder / "plot.svg"}).code, 0);
  const std::string svg = read_file(folder / "plot.svg");
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  EXPECT_GT(texts_of(svg, "text").size(), 8U);
}

TEST(Bench, PngWhereThereIsAWindow) {
  const Folder folder;
  const bool window = json_of(run({"info", "--json"}))["opengl"]["description"] != "built without OpenGL";
  const Output output = bench({"--sizes", "200", "--threads", "1", "--plot", folder / "plot.png"});
  EXPECT_EQ(output.code, window ? 0 : 2) << output.err;
  EXPECT_EQ(exists(folder / "plot.png"), window);
  if (window) {
    EXPECT_THAT(read_file(folder / "plot.png"), StartsWith("\x89PNG\r\n"));
  } else {
    EXPECT_THAT(output.err, HasSubstr(".svg"));
  }
}

TEST(Simd, ResultIsTheSameForAnyLevel) {
  const Folder folder;
  const Json levels = json_of(run({"info", "--json"}))["simd"]["levels"];
  ASSERT_EQ(run({"smooth", sample("mixed.vtk"), "-o", folder / "auto.vtk", "--iterations", "5"}).code, 0);
  for (const Json& level : levels) {
    const std::string out = folder / (level.get<std::string>() + ".vtk");
    ASSERT_EQ(run({"smooth", sample("mixed.vtk"), "-o", out, "--iterations", "5", "--simd", level}).code, 0) << level;
    EXPECT_TRUE(read_file(out) == read_file(folder / "auto.vtk")) << level;
  }
}

}  // namespace
}  // namespace dmoscope::test
