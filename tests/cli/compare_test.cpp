// dmoscope compare: its numbers against runs of dmoscope smooth, its files, and its refusals.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/markup.h"
#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using Json = nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Runs `dmoscope compare` on the CPU.
Output compare(std::vector<std::string> options) {
  options.insert(options.begin(), "compare");
  options.insert(options.end(), {"--backend", "cpu"});
  return run(options);
}

Json compare_json(std::vector<std::string> options) {
  options.emplace_back("--json");
  const Output output = compare(std::move(options));
  EXPECT_EQ(output.code, 0) << output.err;
  return json_of(output);
}

/// The qualities of a smoothed mesh by a metric, ascending, as another process reports them.
std::vector<double> smoothed(const std::string& in, const std::vector<std::string>& how, const std::string& metric) {
  const Folder folder;
  std::vector<std::string> arguments{"smooth", in, "-o", folder / "out.vtk", "--backend", "cpu"};
  arguments.insert(arguments.end(), how.begin(), how.end());
  EXPECT_EQ(run(arguments).code, 0);
  EXPECT_EQ(run({"quality", folder / "out.vtk", "--metric", metric, "--elements", folder / "elements.csv"}).code, 0);
  const Table table = read_table(folder / "elements.csv");
  std::vector<double> qualities;
  for (std::size_t i = 0; i < table.rows.size(); ++i) qualities.push_back(table.number(i, metric));
  std::sort(qualities.begin(), qualities.end());
  return qualities;
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

TEST(Compare, RowsAreThoseOfSmoothJudgedByOneMetric) {
  const std::string in = sample("annulus.off");
  const Json all = compare_json({in, "--run", "dmo:radius-ratio", "--run", "dmo:min-angle", "--judge", "mean-ratio", "--iterations", "4"});
  EXPECT_EQ(all["judged_by"], "mean-ratio");
  ASSERT_EQ(all["runs"].size(), 2U);
  for (const auto& [row, metric] : {std::pair{0, "radius-ratio"}, {1, "min-angle"}}) {
    const Json& figure = all["runs"][static_cast<std::size_t>(row)];
    const std::vector<double> qualities = smoothed(in, {"--metric", metric, "--iterations", "4"}, "mean-ratio");
    const auto count = static_cast<double>(qualities.size());
    EXPECT_EQ(figure["run"], std::string("dmo:") + metric);
    EXPECT_EQ(figure["iterations"], 4);
    EXPECT_NEAR(figure["min_quality"], qualities.front(), 1e-12);
    EXPECT_NEAR(figure["mean_quality"], mean(qualities), 1e-9);
    EXPECT_NEAR(figure["p5"], qualities[static_cast<std::size_t>(std::ceil(0.05 * count)) - 1], 1e-12);
    EXPECT_EQ(figure["inverted"], 0);
    EXPECT_NEAR(figure["vertices_per_second"].get<double>() * figure["seconds"].get<double>(), 4.0 * all["free"].get<double>(), 1e-3);
  }
}

TEST(Compare, EachRunIsJudgedAsAWhole) {
  const Folder folder;
  const std::string in = sample("annulus.off");
  const std::vector<std::string> how{in, "--run", "dmo", "--run", "laplace", "--iterations", "4"};
  const Json all = compare_json(how);
  for (const auto& [row, method] : {std::pair{0, "dmo"}, {1, "laplace"}}) {
    const std::vector<double> before = smoothed(in, {"--iterations", "0"}, "mean-ratio");
    const std::vector<double> after = smoothed(in, {"--method", method, "--iterations", "4"}, "mean-ratio");
    const Json& card = all["runs"][static_cast<std::size_t>(row)]["report_card"];
    std::size_t known = 0;
    for (const Json& figure : card["figures"]) {
      const std::string name = figure["name"];
      if (figure["of"] != "mean ratio" || (name != "least" && name != "mean" && name != "below 0.3")) continue;
      const auto of = [&](const std::vector<double>& all_of) {
        if (name == "least") return all_of.front();
        return name == "mean" ? mean(all_of) : static_cast<double>(std::ranges::count_if(all_of, [](double q) { return q < 0.3; }));
      };
      EXPECT_NEAR(figure["before"], of(before), 1e-9) << method << name;
      EXPECT_NEAR(figure["after"], of(after), 1e-9) << method << name;
      ++known;
    }
    EXPECT_EQ(known, 3U) << card;
  }
  std::vector<std::string> with_report = how;
  with_report.insert(with_report.end(), {"--report", folder / "report.html"});
  const Output told = compare(with_report);
  ASSERT_EQ(told.code, 0) << told.err;
  const std::string page = read_file(folder / "report.html");
  EXPECT_EQ(markup_fault(page), "");
  for (const auto& [row, method] : {std::pair{0, "dmo"}, {1, "laplace"}}) {
    const Json& card = all["runs"][static_cast<std::size_t>(row)]["report_card"];
    EXPECT_THAT(told.out, HasSubstr(fmt::format("{}:mean-ratio: {}\n", method, card["sentence"].get<std::string>())));
    for (const Json& figure : card["figures"])
      if (figure["verdict"] == "worse") {
        EXPECT_THAT(page, HasSubstr(fmt::format("\"number bad\" data-key=\"{}\"", figure["after"].get<double>())));
      }
  }
}

TEST(Compare, TheJudgeIsTheFirstRunsMetricUnlessNamed) {
  EXPECT_EQ(compare_json({sample("annulus.off"), "--run", "dmo:max-angle", "--run", "dmo", "--iterations", "1"})["judged_by"], "max-angle");
  EXPECT_EQ(compare_json({sample("annulus.off"), "--run", "dmo", "--metric", "min-angle", "--iterations", "1"})["runs"][0]["metric"],
            "min-angle")
      << "--metric is what a SPEC leaves open";
}

TEST(Compare, FilesHaveEveryRunAndIteration) {
  const Folder folder;
  const Output output =
      compare({sample("annulus.off"), "--run", "dmo", "--run", "dmo:min-angle", "--judge", "mean-ratio", "--iterations", "3", "--shuffles",
               "1", "--stats", folder / "stats.csv", "--table", folder / "table.csv", "--plot", folder / "plot.svg"});
  ASSERT_EQ(output.code, 0) << output.err;
  const Table stats = read_table(folder / "stats.csv");
  EXPECT_EQ(stats.rows.size(), 4U * 4U) << "input and three iterations, of two runs in two orders";
  for (std::size_t i = 0; i < stats.rows.size(); ++i) {
    EXPECT_EQ(stats.number(i, "iteration"), static_cast<double>(i % 4));
    EXPECT_EQ(stats.number(i - i % 4, "min_quality"), stats.number(0, "min_quality")) << "all judged alike from one input";
  }
  const Table table = read_table(folder / "table.csv");
  ASSERT_EQ(table.rows.size(), 5U);
  std::vector<std::string> names;
  for (const auto& row : table.rows) names.push_back(row.at(0));
  EXPECT_THAT(names, ElementsAre("input", "dmo:mean-ratio", "dmo:min-angle", "dmo:mean-ratio shuffle:1", "dmo:min-angle shuffle:1"));
  EXPECT_EQ(table.number(0, "min_quality"), stats.number(0, "min_quality"));
  EXPECT_EQ(table.number(2, "min_quality"), stats.number(7, "min_quality")) << "the last iteration of the second run";
  const std::string svg = read_file(folder / "plot.svg");
  EXPECT_EQ(markup_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("dmo:min-angle, 2 orders"));
}

TEST(Compare, ANameWithACommaIsOneCell) {
  const Folder folder;
  const Output output = compare({sample("annulus.off"), "--run", "dmo", "--then", "mean", "--iterations", "1", "--stats",
                                 folder / "stats.csv", "--table", folder / "table.csv"});
  ASSERT_EQ(output.code, 0) << output.err;
  for (const char* file : {"stats.csv", "table.csv"})
    EXPECT_THAT(lines_of(read_file(folder / file)).at(file == std::string("table.csv") ? 2 : 1),
                ::testing::StartsWith("\"dmo:mean-ratio, then mean\","))
        << file;
}

TEST(Compare, TheReportSaysWhatWasSearched) {
  const Folder folder;
  const auto settings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> options{"--run", "dmo", "--iterations", "1", "--report", folder / "report.html"};
    options.insert(options.begin(), more.begin(), more.end());
    EXPECT_EQ(compare(options).code, 0);
    return read_file(folder / "report.html");
  };
  EXPECT_THAT(settings({sample("annulus.off")}), HasSubstr("8 x 8 candidates, 3 levels, first grid 0.5 of the star&#39;s box, in float"));
  EXPECT_THAT(settings({sample("annulus.off"), "--combine", "mean-ratio:0.5:density"}), HasSubstr("box, in double"));
  ASSERT_EQ(run({"generate", "tetrahedra", "--size", "64", "-o", folder / "v.vtk"}).code, 0);
  EXPECT_THAT(settings({folder / "v.vtk"}), HasSubstr("8 x 8 x 8 candidates"));
}

TEST(Compare, OrdersLieAsFarApartAsTheirSortedQualities) {
  const std::string in = sample("random.off");
  const Json orders = compare_json({in, "--run", "dmo", "--iterations", "5", "--shuffles", "2"})["orders"];
  ASSERT_EQ(orders.size(), 1U);
  std::vector<std::vector<double>> curves;
  for (const char* order : {"natural", "shuffle:1", "shuffle:2"})
    curves.push_back(smoothed(in, {"--iterations", "5", "--order", order}, "mean-ratio"));
  double largest = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < curves[0].size(); ++i) {
    const auto [low, high] = std::minmax({curves[0][i], curves[1][i], curves[2][i]});
    largest = std::max(largest, high - low);
    sum += high - low;
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_NEAR(orders[0]["largest_difference"], largest, 1e-9);
  EXPECT_NEAR(orders[0]["mean_difference"], sum / static_cast<double>(curves[0].size()), 1e-9);
  const auto minima = std::minmax({curves[0][0], curves[1][0], curves[2][0]});
  EXPECT_NEAR(orders[0]["lowest_minimum"], minima.first, 1e-9);
  EXPECT_NEAR(orders[0]["highest_minimum"], minima.second, 1e-9);
}

TEST(Compare, EveryLeavesOutWhatCannotBeAndSaysWhy) {
  const Json all = compare_json({sample("quads.vtk"), "--every", "metric", "--iterations", "1"});
  ASSERT_GE(all["runs"].size(), 2U);
  ASSERT_GE(all["left_out"].size(), 1U);
  for (const Json& left : all["left_out"]) EXPECT_THAT(left["reason"].get<std::string>(), HasSubstr("quadrilateral"));
  const Json info = json_of(run({"info", "--json"}));
  EXPECT_EQ(all["runs"].size() + all["left_out"].size(), info["metrics"].size());
  const Json methods = compare_json({sample("annulus.off"), "--every", "method", "--iterations", "1"});
  EXPECT_EQ(methods["runs"].size() + methods["left_out"].size(), info["methods"].size());
}

std::vector<std::string> names(const Json& all) {
  std::vector<std::string> names;
  for (const Json& figure : all["runs"]) names.push_back(figure["run"]);
  return names;
}

TEST(Compare, RunsMayHaveOtherAims) {
  const std::string in = sample("annulus.off");
  const Json composite =
      compare_json({in, "--run", "dmo", "--run", "dmo,then mean", "--run", "laplace:min-angle,then mean", "--iterations", "4"});
  EXPECT_THAT(names(composite), ElementsAre("dmo:mean-ratio", "dmo:mean-ratio, then mean", "laplace:min-angle, then mean"));
  const std::vector<std::string> combine{"--combine", "mean-ratio:0.3:density", "--size-function", "h1:0,0", "--iterations", "4"};
  std::vector<std::string> options{in, "--run", "dmo", "--run", "dmo, alone"};
  options.insert(options.end(), combine.begin(), combine.end());
  const Json combined = compare_json(options);
  EXPECT_THAT(names(combined), ElementsAre(HasSubstr("density h1"), "dmo:mean-ratio"));
  const Folder folder;
  const Json alone = json_of(run({"smooth", in, "-o", folder / "o.off", "--combine", "mean-ratio:0.3:density", "--size-function", "h1:0,0",
                                  "--iterations", "4", "--json"}))["combination"]["size_correlation"];
  EXPECT_NEAR(combined["runs"][0]["input_size_correlation"], alone["before"], 1e-12);
  EXPECT_NEAR(combined["runs"][0]["size_correlation"], alone["after"], 1e-12);
  EXPECT_TRUE(combined["runs"][1]["size_correlation"].is_null()) << "has no size function";
  EXPECT_THAT(compare(options).out, HasSubstr("size corr."));
  EXPECT_THAT(compare({in, "--run", "dmo", "--iterations", "1"}).out, Not(HasSubstr("size corr.")));
  EXPECT_NEAR(combined["runs"][1]["min_quality"], smoothed(in, {"--iterations", "4"}, "mean-ratio").front(), 1e-12);
  options = {in, "--every", "method"};
  options.insert(options.end(), combine.begin(), combine.end());
  const Json every = compare_json(options);
  EXPECT_THAT(names(every)[0], HasSubstr("density h1"));
  EXPECT_THAT(names(every), ::testing::Contains("laplace:mean-ratio"));
  EXPECT_TRUE(every["left_out"].empty());
}

TEST(Compare, TheReportStandsAlone) {
  const Folder folder;
  const std::string in = folder / "a<b>&'c'.off";
  std::filesystem::copy_file(sample("annulus.off"), in);
  const Output output =
      compare({in, "--run", "dmo", "--run", "dmo:max-angle", "--iterations", "2", "--shuffles", "1", "--report", folder / "report.html"});
  ASSERT_EQ(output.code, 0) << output.err;
  const std::string page = read_file(folder / "report.html");
  EXPECT_EQ(markup_fault(page), "");
  EXPECT_THAT(page, Not(HasSubstr("a<b>")));
  EXPECT_THAT(page, HasSubstr("<tr class=\"kept\"><td data-key=\"input\">")) << "stays above the runs, however they are sorted";
  EXPECT_THAT(page, HasSubstr("a&lt;b&gt;&amp;&#39;c&#39;.off"));
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("href=")));
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(page, HasSubstr("--shuffles 1")) << "the command that made it";
  std::size_t plots = 0;
  for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++plots;
  EXPECT_EQ(plots, 3U) << "minimum, mean and sorted qualities";
  const bool pictures = page.find("src=\"data:image/png;base64,iVBOR") != std::string::npos;
  EXPECT_TRUE(pictures || page.find("No picture: ") != std::string::npos);
  // Percentiles of the input, by counting.
  ASSERT_EQ(run({"quality", in, "--metric", "mean-ratio", "--elements", folder / "elements.csv"}).code, 0);
  const Table elements = read_table(folder / "elements.csv");
  std::vector<double> qualities;
  for (std::size_t i = 0; i < elements.rows.size(); ++i) qualities.push_back(elements.number(i, "mean-ratio"));
  std::sort(qualities.begin(), qualities.end());
  const auto hundredth = static_cast<std::size_t>(std::ceil(0.01 * static_cast<double>(qualities.size()))) - 1;
  EXPECT_THAT(page, HasSubstr(fmt::format("data-key=\"{}\"", qualities[hundredth])));
  // The table and the CSV have the same figures.
  ASSERT_EQ(compare({in, "--run", "dmo", "--run", "dmo:max-angle", "--iterations", "2", "--table", folder / "table.csv"}).code, 0);
  const Table table = read_table(folder / "table.csv");
  for (const auto& row : table.rows) EXPECT_THAT(page, HasSubstr("data-key=\"" + row.at(table.column("min_quality")) + "\""));
}

/// Place of the first line of a colour in a picture.
std::size_t first_line(const std::string& svg, const std::string& colour) { return svg.find("stroke=\"" + colour + "\""); }

TEST(Compare, ThePlotShowsTheMeanAndTheFirstRunOnTop) {
  const Folder folder;
  const Output output = compare({sample("annulus.off"), "--run", "dmo", "--run", "active-set", "--then", "mean", "--iterations", "60",
                                 "--plot", folder / "plot.svg"});
  ASSERT_EQ(output.code, 0) << output.err;
  const std::string svg = read_file(folder / "plot.svg");
  EXPECT_EQ(markup_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("annulus.off: the mean of all elements"));
  EXPECT_THAT(svg, HasSubstr("raised by dmo:mean-ratio, then mean from iteration "));
  // Both start at the input and end near each other, so that the last one drawn is visible.
  const std::size_t first = first_line(svg, "#0072b2"), second = first_line(svg, "#d55e00");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_GT(first, second);
}

TEST(Compare, RefusesBeforeAnythingRuns) {
  const Folder folder;
  const std::string in = sample("quads.vtk");
  const std::vector<std::vector<std::string>> wrong{
      {in},
      {in, "--run", "beauty"},
      {in, "--run", "dmo:beauty"},
      {in, "--run", "dmo:mean-ratio:abacus"},
      {in, "--run", "dmo:mean-ratio:cpu:more"},
      {in, "--run", "dmo:"},
      {in, "--run", "dmo:min-angle"},
      {in, "--run", "dmo", "--judge", "min-angle"},
      {in, "--run", "dmo", "--judge", "beauty"},
      {in, "--run", "dmo", "--run", "dmo:mean-ratio"},
      {in, "--every", "thing"},
      {in, "--run", "dmo,"},
      {in, "--run", "dmo,then median"},
      {in, "--run", "dmo", "--run", "dmo,alone"},
      {in, "--run", "dmo:scaled-jacobian", "--combine", "mean-ratio:0.7:density"},
      {in, "--every", "metric", "--combine", "mean-ratio:0.7:density"},
      {in, "--run", "dmo", "--plot", folder / "plot.jpeg"},
      {in, "--run", "dmo", "--report", folder / "report.txt"},
      {in, "--run", "dmo", "--stats", folder / "same.csv", "--table", folder / "same.csv"},
      {in, "--run", "dmo", "--stats", in},
      {in, "--run", "dmo", "--until-converged", "--iterations", "3"},
  };
  for (const auto& options : wrong) {
    const Output output = compare(options);
    EXPECT_EQ(output.code, 2) << ::testing::PrintToString(options);
    EXPECT_THAT(output.out, IsEmpty());
    EXPECT_THAT(output.err, Not(IsEmpty()));
  }
  EXPECT_EQ(compare({in, "--run", "dmo", "--stats", folder / "missing/stats.csv"}).code, 3);
  EXPECT_EQ(compare({folder / "missing.vtk", "--run", "dmo"}).code, 3);
}

TEST(Compare, AnOutcomeThatIsNotReachedIsCodeOneAndToldOf) {
  const Output output = compare({sample("annulus.off"), "--run", "dmo", "--until-converged", "--max-iterations", "1"});
  EXPECT_EQ(output.code, 1);
  EXPECT_THAT(output.err, HasSubstr("dmo:mean-ratio: not converged"));
}

TEST(Compare, AnOrderThatDoesNotConvergeCountsToo) {
  const std::vector<std::string> asked{sample("random.off"), "--run", "dmo", "--shuffles", "3", "--until-converged", "--patience", "5"};
  std::vector<std::uint64_t> needed;
  const Json all = compare_json(asked);
  for (const Json& one : all["runs"]) needed.push_back(one["iterations"]);
  ASSERT_EQ(needed.size(), 4U);
  ASSERT_LT(needed[0], *std::ranges::max_element(needed)) << "or there is nothing to see here";
  std::vector<std::string> short_of = asked;
  short_of.insert(short_of.end(), {"--max-iterations", std::to_string(needed[0])});
  const Output output = compare(short_of);
  EXPECT_EQ(output.code, 1);
  EXPECT_THAT(output.err, HasSubstr("shuffle:"));
  EXPECT_THAT(output.err, Not(HasSubstr("dmo:mean-ratio: not converged")));
}

TEST(Compare, VerticesAreKeptInEveryRun) {
  const std::string in = sample("annulus.off");
  const auto smooth =
      json_of(run({"smooth", in, "-o", Folder() / "s.off", "--fix", "200-300", "--iterations", "2", "--backend", "cpu", "--json"}));
  const Json all = compare_json({in, "--run", "dmo", "--fix", "200-300", "--iterations", "2"});
  EXPECT_EQ(all["free"], smooth["free"]);
  EXPECT_EQ(all["runs"][0]["mean_quality"], smooth["after"]["mean"]);
  EXPECT_NE(compare_json({in, "--run", "dmo", "--iterations", "2"})["free"], smooth["free"]);
}

TEST(Compare, CancelledItLeavesNoFiles) {
  const Folder folder;
  Call call;
  call.arguments = {"compare", sample("coast.14"), "--run",      "dmo",      "--iterations",   "100000000", "--backend",
                    "cpu",     "--stats",          folder / "s", "--report", folder / "r.html"};
  call.interrupt = std::chrono::milliseconds(800);
  const Output output = run(call);
  EXPECT_EQ(output.code, 1) << output.err;
  EXPECT_FALSE(exists(folder / "s"));
  EXPECT_FALSE(exists(folder / "r.html"));
}

}  // namespace
}  // namespace dmoscope::test
