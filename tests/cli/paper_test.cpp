// dmoscope paper: its table against runs of dmoscope smooth, its rows about missing meshes, its files, and its refusals.

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/markup.h"
#include "tests/cli/program.h"

namespace dmoscope::test {
namespace {

using ::testing::HasSubstr;

/// Cells of a CSV's line, some of them in quotes.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

struct Row {
  std::string figure, mesh, what, paper, ours, difference, tolerance, verdict, why;
};

std::vector<Row> rows_of(const std::string& path) {
  std::vector<Row> rows;
  for (const std::string& line : lines_of(read_file(path))) {
    const std::vector<std::string> c = cells_of(line);
    EXPECT_EQ(c.size(), 9U) << line;
    if (c.size() == 9) rows.push_back({c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8]});
  }
  EXPECT_EQ(rows.front().figure, "figure") << "the head";
  rows.erase(rows.begin());
  return rows;
}

Output paper(const Folder& folder, std::vector<std::string> options) {
  options.insert(options.begin(), {"paper", "-o", folder / "out", "--quick", "--backend", "cpu"});
  return run(options);
}

TEST(Paper, ARowIsWhatSmoothSays) {
  const Folder folder;
  std::filesystem::create_directories(folder / "meshes");
  const std::string mesh = folder / "meshes/bahamas.14", annulus = folder / "annulus.vtk";
  ASSERT_EQ(run({"generate", "block", "--size", "600", "--seed", "1", "-o", mesh}).code, 0);
  ASSERT_EQ(run({"generate", "annulus", "--size", "2500", "--seed", "1", "-o", annulus}).code, 0);
  const auto smoothed = [&](const std::string& input, const char* method, const char* iterations) {
    return smooth(input, folder / "s.vtk",
                  {"--method", method, "--iterations", iterations, "--backend", "cpu", "--write", "last"})["after"];
  };
  // One mesh that is read and one that is generated; the first is not the paper's, so that its claims need not hold.
  ASSERT_LE(paper(folder, {"--only", "methods", "--only", "mean", "--meshes", folder / "meshes"}).code, 1);
  std::size_t compared = 0;
  for (const Row& row : rows_of(folder / "out/table.csv")) {
    for (const char* method : {"dmo", "smart-laplace", "laplace", "angle-based", "dvr"}) {
      if (row.what != std::string(method) + ": minimum after 50 iterations") continue;
      EXPECT_DOUBLE_EQ(std::stod(row.ours), smoothed(mesh, method, "50")["minimum"].get<double>()) << method;
      ++compared;
    }
    if (row.what != "mean without the second phase" || row.mesh.find("annulus") == std::string::npos) continue;
    EXPECT_DOUBLE_EQ(std::stod(row.ours), smoothed(annulus, "dmo", "100")["mean"].get<double>());
    ++compared;
  }
  EXPECT_EQ(compared, 6U);
}

TEST(Paper, WhatIsMissingIsSaid) {
  const Folder folder;
  std::filesystem::create_directory(folder / "empty");
  const Output output = paper(folder, {"--only", "4a", "--only", "8", "--meshes", folder / "empty"});
  ASSERT_EQ(output.code, 0) << output.err;
  const std::vector<Row> rows = rows_of(folder / "out/table.csv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].verdict, "no mesh");
  EXPECT_THAT(rows[0].why, HasSubstr("east.14"));
  EXPECT_EQ(rows[1].verdict, "no mesh");
  EXPECT_THAT(rows[1].why, HasSubstr("tire.vtk"));
  EXPECT_THAT(output.out, HasSubstr("no mesh"));
}

TEST(Paper, MeshesAreFoundByNameBelowTheFolder) {
  const Folder folder;
  std::filesystem::create_directories(folder / "meshes/deep/er");
  std::filesystem::copy_file(sample("coast.14"), folder / "meshes/deep/er/east.14");
  // Another mesh of that name, for which the paper's claims do not hold: the output and the exit code tell so.
  const Output output = paper(folder, {"--only", "4a", "--meshes", folder / "meshes"});
  EXPECT_EQ(output.code, 1);
  EXPECT_THAT(output.err, HasSubstr("figure 4a"));
  std::set<std::string> verdicts;
  for (const Row& row : rows_of(folder / "out/table.csv")) verdicts.insert(row.verdict);
  EXPECT_TRUE(verdicts.contains("differs"));
  EXPECT_FALSE(verdicts.contains("no mesh"));
}

/// The bounds of "at least 0.812", "at most 1400" or "0.56 to 0.6".
std::pair<double, double> bounds_of(const std::string& tolerance) {
  if (tolerance.starts_with("at least ")) return {std::stod(tolerance.substr(9)), INFINITY};
  if (tolerance.starts_with("at most ")) return {-INFINITY, std::stod(tolerance.substr(8))};
  const std::size_t to = tolerance.find(" to ");
  EXPECT_NE(to, std::string::npos) << tolerance;
  return {std::stod(tolerance.substr(0, to)), std::stod(tolerance.substr(to + 4))};
}

TEST(Paper, VerdictsFollowFromTheirTolerances) {
  const Folder folder;
  std::filesystem::create_directories(folder / "meshes");
  for (const char* name : {"bahamas.14", "east.14"})
    std::filesystem::copy_file(sample("coast.14"), folder / (std::string("meshes/") + name));
  ASSERT_EQ(paper(folder, {"--only", "4a", "--only", "methods", "--meshes", folder / "meshes"}).code, 1);
  std::map<std::string, int> seen;
  for (const Row& row : rows_of(folder / "out/table.csv")) {
    ++seen[row.verdict];
    if (row.verdict == "told") {
      EXPECT_EQ(row.tolerance, "") << row.what;
      continue;
    }
    const auto [low, high] = bounds_of(row.tolerance);
    const double ours = std::stod(row.ours);
    EXPECT_EQ(row.verdict, ours >= low && ours <= high ? "holds" : "differs") << row.what;
    if (row.paper == "0.82") {
      EXPECT_DOUBLE_EQ(std::stod(row.difference), ours - 0.82);
    }
  }
  EXPECT_GT(seen["holds"], 1);
  EXPECT_GT(seen["differs"], 1);
  EXPECT_GT(seen["told"], 0);
}

/// The lines of a plot's CSV, by name, in the order of x.
std::map<std::string, std::vector<double>> courses_of(const std::string& path) {
  std::map<std::string, std::vector<double>> courses;
  for (const std::string& line : lines_of(read_file(path))) {
    const std::vector<std::string> c = cells_of(line);
    if (c.at(0) != "series") courses[c.at(0)].push_back(std::stod(c.at(2)));
  }
  return courses;
}

double ours(const std::vector<Row>& rows, const std::string& what) {
  const auto found = std::ranges::find_if(rows, [&](const Row& row) { return row.what.find(what) != std::string::npos; });
  EXPECT_NE(found, rows.end()) << what;
  return found == rows.end() || found->ours.empty() ? NAN : std::stod(found->ours);
}

TEST(Paper, WhatIsSaidOfCoursesFollowsFromTheirPlots) {
  const Folder folder;
  std::filesystem::create_directories(folder / "meshes");
  ASSERT_EQ(run({"generate", "block", "--size", "400", "--seed", "1", "-o", folder / "meshes/shashkov.vtk"}).code, 0);
  ASSERT_EQ(run({"generate", "block", "--size", "600", "--seed", "2", "-o", folder / "meshes/east.14"}).code, 0);
  ASSERT_LE(paper(folder, {"--only", "4a", "--only", "4c", "--only", "5.2-east", "--meshes", folder / "meshes"}).code, 1);
  const std::vector<Row> rows = rows_of(folder / "out/table.csv");
  const auto first = [](const std::vector<double>& course, double goal) {
    return static_cast<double>(std::ranges::find_if(course, [&](double q) { return q >= goal; }) - course.begin());
  };
  auto courses = courses_of(folder / "out/4c/convergence.csv");
  const std::vector<double>&dmo = courses["dmo"], &dvr = courses["dvr"];
  ASSERT_EQ(dmo.size(), 301U);
  const double goal = std::min(dvr.back(), dmo.back() - 1e-3), sooner = first(dmo, goal);
  EXPECT_GT(sooner, 1.0);
  EXPECT_DOUBLE_EQ(ours(rows, "iterations of dvr over those of dmo"), first(dvr, goal) / sooner);
  EXPECT_DOUBLE_EQ(ours(rows, "over dmo's"), dvr.back() / dmo.back());
  // The iteration at which a minimum has converged is the first near its last value; minima of dmo do not fall.
  const std::vector<double> east = courses_of(folder / "out/4a/convergence.csv")["dmo"];
  ASSERT_EQ(east.size(), 21U);
  EXPECT_DOUBLE_EQ(ours(rows, "dmo: iterations until converged"), first(east, east.back() - 1e-3));
  EXPECT_DOUBLE_EQ(ours(rows, "dmo: minimum after 10 iterations"), east[10]);
  EXPECT_DOUBLE_EQ(ours(rows, "seconds of dvr over those of dmo"),
                   ours(rows, "dvr: seconds to the same minimum") / ours(rows, "dmo: seconds on the cpu"));
}

TEST(Paper, OrdersAreAllDifferent) {
  const Folder folder;
  ASSERT_EQ(paper(folder, {"--only", "11", "--only", "12"}).code, 0);
  const auto courses = courses_of(folder / "out/11/random.csv");
  EXPECT_EQ(courses.size(), 6U);
  for (const auto& [name, course] : courses)
    for (const auto& [other_name, other] : courses) EXPECT_EQ(course == other, name == other_name) << name << ", " << other_name;
  const std::vector<Row> rows = rows_of(folder / "out/table.csv");
  double low = INFINITY, high = -INFINITY;
  for (const auto& [name, course] : courses) {
    low = std::min(low, course.front());
    high = std::max(high, course.front());
  }
  EXPECT_NEAR(ours(rows, "lowest minimum of 6"), low, 1e-7) << "the plot is in float";
  EXPECT_NEAR(ours(rows, "highest minimum of 6"), high, 1e-7);
  EXPECT_GT(ours(rows, "mean distance of their vertices"), 0.01);
}

TEST(Paper, AVolumeIsAnExperiment) {
  const Folder folder;
  std::filesystem::create_directories(folder / "meshes");
  ASSERT_EQ(run({"generate", "tetrahedra", "--size", "216", "--seed", "1", "-o", folder / "meshes/tire.vtk"}).code, 0);
  // Not the paper's mesh, so that the claims need not hold.
  ASSERT_LE(paper(folder, {"--only", "8", "--meshes", folder / "meshes"}).code, 1);
  std::size_t compared = 0;
  for (const Row& row : rows_of(folder / "out/table.csv")) {
    EXPECT_NE(row.verdict, "not possible") << row.what;
    for (const char* method : {"dmo", "dvr", "smart-laplace", "active-set"}) {
      if (row.what != std::string(method) + ": minimum after 10 iterations, movable elements") continue;
      const auto smooth = json_of(run({"smooth", folder / "meshes/tire.vtk", "-o", folder / "s.vtk", "--method", method, "--iterations",
                                       "10", "--backend", "cpu", "--json"}));
      EXPECT_DOUBLE_EQ(std::stod(row.ours), smooth["after"]["movable_minimum"].get<double>()) << method;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 4U);
  EXPECT_EQ(read_table(folder / "out/8/convergence.csv").rows.size(), 5U * 11U) << "five lines, the input and 10 iterations";
}

TEST(Paper, FilesAreWhole) {
  const Folder folder;
  ASSERT_EQ(paper(folder, {"--only", "7", "--only", "11"}).code, 0);
  const std::string page = read_file(folder / "out/index.html");
  EXPECT_EQ(markup_fault(page), "");
  EXPECT_THAT(page, HasSubstr("<svg"));
  EXPECT_EQ(markup_fault(read_file(folder / "out/7/convergence.svg")), "");
  const Table plot = read_table(folder / "out/7/convergence.csv");
  EXPECT_EQ(plot.rows.size(), 2U * 51U) << "two metrics, the input and 50 iterations";
  const bool pictures = exists(folder / "out/7/picture-1.png");
  EXPECT_EQ(pictures, page.find("data:image/png;base64,iVBOR") != std::string::npos);
  // The page and the table have the same number of rows.
  std::size_t rows = 0;
  for (std::size_t at = page.find("<tr>"); at != std::string::npos; at = page.find("<tr>", at + 1)) ++rows;
  EXPECT_EQ(rows, rows_of(folder / "out/table.csv").size() + 1);
}

TEST(Paper, RefusesWhatThereIsNot) {
  const Folder folder;
  EXPECT_EQ(paper(folder, {"--only", "13"}).code, 2);
  EXPECT_EQ(paper(folder, {"--full"}).code, 2) << "quick and full";
  EXPECT_EQ(run({"paper"}).code, 2);
  EXPECT_EQ(paper(folder, {"--only", "8", "--meshes", folder / "nowhere"}).code, 3);
  EXPECT_FALSE(exists(folder / "out"));
  const std::string file = folder.file("file", "");
  EXPECT_EQ(run({"paper", "-o", file, "--only", "8"}).code, 3);
  std::filesystem::create_directory(folder / "out");
  (void)folder.file("out/7", "");
  EXPECT_EQ(paper(folder, {"--only", "7"}).code, 3);
  EXPECT_FALSE(exists(folder / "out/table.csv")) << "refused before the runs";
}

}  // namespace
}  // namespace dmoscope::test
