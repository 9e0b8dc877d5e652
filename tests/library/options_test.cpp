// Options by the library's public headers alone: the typed fields beside the program's table, wrong values, and what is selected.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dmoscope/dmoscope.h"
#include "tests/library/arrays.h"

namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;
using namespace dmoscope_test;

/// Comments of the fields in the section of SmoothOptions that has the table's parameters, by name.
std::map<std::string, std::string> documented_parameters() {
  std::ifstream file(DMOSCOPE_SOURCE_DIR "/library/include/dmoscope/options.h");
  std::map<std::string, std::string> fields;
  std::string line, comment;
  bool inside = false;
  std::smatch found;
  while (std::getline(file, line)) {
    if (line.find("// ---") != std::string::npos) inside = line.find("Parameters") != std::string::npos;
    if (!inside) continue;
    if (std::regex_match(line, found, std::regex(" *///(.*)"))) comment += found.str(1);
    if (std::regex_match(line, found, std::regex(" *[A-Za-z:_0-9<>]+ ([a-z_]+)( = .*)?;"))) {
      fields[found.str(1)] = comment;
      comment.clear();
    }
  }
  return fields;
}

TEST(LibraryOptions, HaveADocumentedFieldForEachRowOfTheTableAndNoOther) {
  std::map<std::string, std::string> fields = documented_parameters();
  const dmo::SmoothOptions usual;
  for (const dmo::Parameter& parameter : dmo::parameters()) {
    SCOPED_TRACE(parameter.name);
    std::string name = parameter.name;
    std::replace(name.begin(), name.end(), '-', '_');
    ASSERT_TRUE(fields.count(name)) << "SmoothOptions lacks it";
    const std::string comment = fields[name];
    fields.erase(name);
    EXPECT_EQ(usual.get(parameter.name), parameter.usual) << "another default";
    EXPECT_THAT(comment, HasSubstr("Default: "));
    EXPECT_THAT(comment, HasSubstr("Read by "));
    if (parameter.most && *parameter.most < 1e9) {
      EXPECT_THAT(comment, HasSubstr(parameter.open ? fmt::format("Range: above {}, up to {}.", *parameter.least, *parameter.most)
                                                    : fmt::format("Range: {} to {}.", *parameter.least, *parameter.most)));
    }
    if (parameter.most) {
      EXPECT_THAT(comment, HasSubstr("Default: " + parameter.usual));
    }
    for (const std::string& method : parameter.methods) {
      EXPECT_TRUE(comment.find(method) != std::string::npos || parameter.methods.size() == 8) << method;
    }
  }
  EXPECT_TRUE(fields.empty()) << fields.begin()->first << " is no parameter of the table";
}

TEST(LibraryOptions, SetAndGetAreInverse) {
  for (const dmo::Parameter& parameter : dmo::parameters()) {
    SCOPED_TRACE(parameter.name);
    std::vector<std::string> values = parameter.choices;
    values.push_back(parameter.usual);
    if (parameter.most) values.push_back(fmt::format("{}", std::max(*parameter.least, 0.5 * std::min(4.0, *parameter.most))));
    for (const std::string& value : values) {
      if (value == "avx512" || value == "avx2") continue;  // not every processor has them
      dmo::SmoothOptions options;
      options.set(parameter.name, value);
      EXPECT_EQ(options.get(parameter.name), value);
    }
  }
  dmo::SmoothOptions options;
  for (const auto& [name, value] : std::map<std::string, std::string>{{"guard", "min-angle:0.25"},
                                                                      {"order", "shuffle:7"},
                                                                      {"fields", "carry,depth=place"},
                                                                      {"fit", "0.5"},
                                                                      {"seed", "18446744073709551615"}}) {
    options.set(name, value);
    EXPECT_EQ(options.get(name), value);
  }
  EXPECT_EQ(options.guard->floor, 0.25);
  EXPECT_EQ(options.order, 7U);
  EXPECT_EQ(options.fields.named, (std::vector<std::pair<std::string, dmo::FieldRule>>{{"depth", dmo::FieldRule::Place}}));
  options.set("guard", "off");
  EXPECT_FALSE(options.guard);
  options.set("corner_angle", "31");
  EXPECT_EQ(options.corner_angle, 31.0) << "as the field is called";
}

TEST(LibraryOptions, OtherOptionsAreSetByName) {
  dmo::SmoothOptions options;
  for (const auto& [name, value] : std::map<std::string, std::string>{{"corner", "1"},
                                                                      {"feature", "1-2"},
                                                                      {"fix", "group:wall"},
                                                                      {"iterations", "7"},
                                                                      {"max-iterations", "70"},
                                                                      {"method", "smart-laplace"},
                                                                      {"no-corner", "2"},
                                                                      {"no-feature", "2-3"},
                                                                      {"patience", "9"},
                                                                      {"recipe", "hex"},
                                                                      {"size-function", "h1:0,0"},
                                                                      {"slide", "loop:1"},
                                                                      {"target", "input"},
                                                                      {"then", "joint,geometric-mean"},
                                                                      {"threads", "3"},
                                                                      {"until-converged", "on"}})
    options.set(name, value);
  options.set("combine", "mean-ratio:0.6:min-angle");
  EXPECT_EQ(options.corners.names, std::vector<std::string>{"1"});
  EXPECT_EQ(options.no_features.names, std::vector<std::string>{"2-3"});
  EXPECT_EQ(options.method, dmo::Method::SmartLaplace);
  EXPECT_EQ(options.recipe, dmo::Recipe::Hex);
  EXPECT_TRUE(options.then_joint);
  EXPECT_EQ(options.then_mean, dmo::MeanKind::Geometric);
  EXPECT_EQ(options.combine->threshold, 0.6);
  EXPECT_EQ(options.combine->metric, "min-angle");
  EXPECT_EQ(options.threads, 3U);
  EXPECT_THROW(options.set("metric", "min-angle"), dmo::UsageError) << "combine names both";
  EXPECT_THROW(options.set("threads", "100000"), dmo::UsageError);
  EXPECT_THROW(options.set("boundry", "slide"), dmo::UsageError);
  EXPECT_THROW((void)options.get("metrics"), dmo::UsageError);
}

TEST(LibraryOptions, EveryMethodAndRecipeHasItsName) {
  const dmo::Mesh mesh = sheet(4).mesh();
  for (const auto& [method, word] : std::vector<std::pair<dmo::Method, const char*>>{{dmo::Method::Dmo, "dmo"},
                                                                                     {dmo::Method::Laplace, "laplace"},
                                                                                     {dmo::Method::SmartLaplace, "smart-laplace"},
                                                                                     {dmo::Method::AngleBased, "angle-based"},
                                                                                     {dmo::Method::Dvr, "dvr"},
                                                                                     {dmo::Method::PatternSearch, "pattern-search"},
                                                                                     {dmo::Method::ActiveSet, "active-set"},
                                                                                     {dmo::Method::Joint, "joint"}}) {
    dmo::SmoothOptions options;
    options.set("method", word);
    EXPECT_EQ(options.method, method) << word;
    options.iterations = 1;
    EXPECT_EQ(dmo::smooth(mesh, options).history.size(), 2U) << word;
  }
  for (const auto& [recipe, word] : std::vector<std::pair<dmo::Recipe, const char*>>{{dmo::Recipe::None, "none"},
                                                                                     {dmo::Recipe::Best, "best"},
                                                                                     {dmo::Recipe::Hex, "hex"},
                                                                                     {dmo::Recipe::Minimum, "minimum"},
                                                                                     {dmo::Recipe::Mean, "mean"},
                                                                                     {dmo::Recipe::Paper, "paper"}}) {
    dmo::SmoothOptions options;
    options.set("recipe", word);
    EXPECT_EQ(options.recipe, recipe) << word;
  }
}

/// Message of the UsageError of smooth() with options that `change` changes.
std::string told_of(const dmo::Mesh& mesh, const std::function<void(dmo::SmoothOptions&)>& change) {
  dmo::SmoothOptions options;
  change(options);
  try {
    (void)dmo::smooth(mesh, options);
  } catch (const dmo::UsageError& error) {
    return error.what();
  }
  return "taken";
}

TEST(LibraryOptions, WrongValuesAreRefusedByName) {
  using O = dmo::SmoothOptions;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const dmo::Mesh mesh = sheet(4).mesh();
  const auto expect = [&](const char* name, const std::function<void(O&)>& change) {
    EXPECT_THAT(told_of(mesh, change), HasSubstr(name)) << name;
  };
  expect("threads: expected a whole number from 0 to 1024, not '100000'", [](O& o) { o.threads = 100000; });
  expect("iterations: expected a whole number from 0 to 1000000000", [](O& o) { o.iterations = 1ULL << 40U; });
  expect("patience: expected a whole number from 1", [](O& o) { o.patience = 0, o.until_converged = true; });
  expect("patience is for until_converged", [](O& o) { o.patience = 5; });
  expect("max_iterations is for until_converged", [](O& o) { o.max_iterations = 5; });
  expect("iterations and until_converged: only one", [](O& o) { o.iterations = 5, o.until_converged = true; });
  expect("recipe and method: only one", [](O& o) { o.recipe = dmo::Recipe::Best, o.method = dmo::Method::Dvr; });
  expect("recipe and combine: only one", [](O& o) { o.recipe = dmo::Recipe::Best, o.combine = dmo::SecondAim{0.5, "min-angle"}; });
  expect("recipe and then: only one", [](O& o) { o.recipe = dmo::Recipe::Best, o.then_joint = true; });
  expect("size_function is for combine", [](O& o) { o.size_function = "h1:0,0"; });
  expect("fit: it takes a surface", [](O& o) { o.fit = 0.1; });
  expect("surface: ", [&](O& o) { o.surface = sheet(2).mesh(); });
  expect("grid", [](O& o) { o.grid = -3; });
  expect("grid", [](O& o) { o.grid = 65; });
  expect("levels", [](O& o) { o.levels = 0; });
  for (const double wrong : {nan, -1.0, 1e9, std::numeric_limits<double>::infinity()}) {
    expect("omega", [=](O& o) { o.omega = wrong; });
    expect("relaxation", [=](O& o) { o.relaxation = wrong; });
    expect("corner_angle: ", [=](O& o) { o.corner_angle = wrong; });
    expect("feature_angle: ", [=](O& o) { o.feature_angle = wrong; });
    expect("max_deviation: ", [=](O& o) { o.max_deviation = wrong; });
    expect("joint_gap: ", [=](O& o) { o.joint_gap = wrong; });
    expect("combine: ", [=](O& o) { o.combine = dmo::SecondAim{wrong, "min-angle"}; });
  }
  expect("fit: ", [=](O& o) { o.fit = nan; });
  expect("fit: ", [=](O& o) { o.fit = -1.0; });
  expect("guard: ", [=](O& o) { o.guard = dmo::Guard{"mean-ratio", nan}; });
  expect("guard: unknown metric", [=](O& o) { o.guard = dmo::Guard{"skew", {}}; });
  expect("metric: unknown metric 'skew'", [](O& o) { o.metric = "skew"; });
  expect("combine: ", [](O& o) { o.combine = dmo::SecondAim{0.5, "skew"}; });
  expect("target: ", [](O& o) { o.target = "round"; });
  expect("fields: ", [](O& o) { o.fields.named = {{"depth", dmo::FieldRule::Carry}}; });
  expect("method: there is no value 99", [](O& o) { o.method = static_cast<dmo::Method>(99); });
  expect("recipe: there is no value 99", [](O& o) { o.recipe = static_cast<dmo::Recipe>(99); });
  expect("boundary: there is no value 7", [](O& o) { o.boundary = static_cast<dmo::Boundary>(7); });
  expect("then_mean: there is no", [](O& o) { o.then_mean = static_cast<dmo::MeanKind>(7); });
  expect("fixed: there is no vertex 25, the mesh has 25", [](O& o) { o.fixed.numbers = {3, 25}; });
  expect("fixed: group:wall: ", [](O& o) { o.fixed.names = {"group:wall"}; });
  expect("slide: there is no vertex 99", [](O& o) { o.slide.numbers = {99}; });
  expect("slide: none of these vertices is on the boundary", [](O& o) { o.slide.numbers = {12}; });
  expect("corners: there is no vertex 99", [](O& o) { o.corners.numbers = {99}; });
  expect("no_corners: there is no vertex 99", [](O& o) { o.no_corners.numbers = {99}; });
  expect("features: there is no edge 0-24", [](O& o) { o.features.ends = {{24, 0}}; });
  expect("no_features: there is no vertex 99", [](O& o) { o.no_features.ends = {{99, 0}}; });
  expect("features: ", [](O& o) { o.features.names = {"seam"}; });
  EXPECT_EQ(told_of(mesh, [](O& o) { o.iterations = 0; }), "taken");
}

bool same_places(const dmo::Mesh& a, const dmo::Mesh& b) {
  return std::memcmp(a.positions(), b.positions(), 3 * a.vertex_count() * sizeof(double)) == 0;
}

TEST(LibraryOptions, VerticesAreSelectedByNumberAndByName) {
  const dmo::Mesh mesh = sheet(8).mesh();
  dmo::SmoothOptions by_name, by_number, by_both;
  by_name.fixed.names = {"box:0,0,3.5,8", "40"};
  by_number.fixed.numbers = mesh.vertices("box:0,0,3.5,8");
  ASSERT_GT(by_number.fixed.numbers.size(), 27U);
  by_both.fixed = by_number.fixed;
  by_number.fixed.numbers.push_back(40);
  by_both.fixed.names = {"40"};
  const dmo::Mesh smoothed = dmo::smooth(mesh, by_name).mesh;
  EXPECT_FALSE(same_places(smoothed, dmo::smooth(mesh).mesh));
  EXPECT_TRUE(same_places(smoothed, dmo::smooth(mesh, by_number).mesh));
  EXPECT_TRUE(same_places(smoothed, dmo::smooth(mesh, by_both).mesh));
  for (const dmo::Index v : by_number.fixed.numbers)
    EXPECT_EQ(std::memcmp(smoothed.positions() + 3 * v, mesh.positions() + 3 * v, 3 * sizeof(double)), 0);
  EXPECT_THROW((void)mesh.vertices("loop:2"), dmo::UsageError);
}

TEST(LibraryOptions, CornersStayWhereOthersSlide) {
  const dmo::Index middle = 4;  // on the lower side, which turns there by a degree
  Arrays arrays = sheet(8);
  arrays.positions[3 * middle + 1] -= 0.01;
  const dmo::Mesh mesh = arrays.mesh();
  dmo::SmoothOptions options;
  options.boundary = dmo::Boundary::Slide;
  const auto moves = [&](const dmo::SmoothOptions& by, dmo::Index v) {
    return std::memcmp(dmo::smooth(mesh, by).mesh.positions() + 3 * v, mesh.positions() + 3 * v, 3 * sizeof(double)) != 0;
  };
  EXPECT_TRUE(moves(options, middle));
  options.corners.numbers = {middle};
  EXPECT_FALSE(moves(options, middle));
  options.corners = {};
  options.corner_angle = 1.0;
  EXPECT_FALSE(moves(options, middle));
  options.no_corners.names = {"4"};
  EXPECT_TRUE(moves(options, middle));
}

TEST(LibraryOptions, VerticesSlideAlongFeatures) {
  const dmo::Mesh mesh = sheet(8).mesh();
  constexpr std::size_t kInner = 4 * 9 + 4;
  const auto beside = [&](const dmo::SmoothOptions& options) {
    const dmo::Mesh smoothed = dmo::smooth(mesh, options).mesh;
    const double *a = mesh.positions() + 3 * (kInner - 1), *b = a + 3, *c = b + 3, *to = smoothed.positions() + 3 * kInner;
    const auto distance = [to](const double* from, const double* end) {
      const double x = end[0] - from[0], y = end[1] - from[1];
      return std::abs(x * (to[1] - from[1]) - y * (to[0] - from[0])) / std::hypot(x, y);
    };
    return std::min(distance(a, b), distance(b, c));
  };
  dmo::SmoothOptions options;
  EXPECT_GT(beside(options), 1e-3);
  options.corner_angle = 120.0;
  options.features.ends = {{kInner, kInner + 1}, {kInner, kInner - 1}};
  EXPECT_LT(beside(options), 1e-9);
  options.features.ends = {};
  options.features.names = {"39-40-41"};
  EXPECT_LT(beside(options), 1e-9);
}

TEST(LibraryOptions, TheGuardAndTheLaterPhasesAreReached) {
  const dmo::Mesh mesh = sheet(8).mesh();
  dmo::SmoothOptions options;
  options.guard.reset();
  EXPECT_EQ(options.get("guard"), "off");
  options.metric = "scaled-jacobian";
  const double free = dmo::statistics(dmo::smooth(mesh, options).mesh).minimum;
  options.guard = dmo::Guard{"mean-ratio", free + 0.005};
  EXPECT_GE(dmo::statistics(dmo::smooth(mesh, options).mesh).minimum, free + 0.005) << "the guard's floor";
  dmo::SmoothOptions alone, then;
  alone.until_converged = then.until_converged = true;
  then.then_joint = true;
  then.then_mean = dmo::MeanKind::Arithmetic;
  const dmo::Mesh first = dmo::smooth(mesh, alone).mesh, last = dmo::smooth(mesh, then).mesh;
  EXPECT_GE(dmo::statistics(last).minimum, dmo::statistics(first).minimum - 1e-9);
  EXPECT_GT(dmo::statistics(last).mean, dmo::statistics(first).mean);
}

TEST(LibraryOptions, WhatHoldsTheMinimumIsExplained) {
  Arrays arrays;  // a corner with a sharp angle that the boundary holds, and a vertex that moves
  arrays.positions = {0, 0, 0, 4, 0, 0, 4, 0.5, 0, 0, 4, 0, 2, 1, 0};
  arrays.add(dmo::CellKind::Triangle, {0, 1, 4});
  arrays.add(dmo::CellKind::Triangle, {1, 2, 4});
  arrays.add(dmo::CellKind::Triangle, {2, 3, 4});
  arrays.add(dmo::CellKind::Triangle, {3, 0, 4});
  dmo::SmoothOptions options;
  options.until_converged = true;
  EXPECT_FALSE(dmo::smooth(arrays.mesh(), options).held);
  options.explain = true;
  const dmo::Smoothed result = dmo::smooth(arrays.mesh(), options);
  ASSERT_TRUE(result.held);
  EXPECT_EQ(result.held->cell, dmo::statistics(result.mesh).worst_cell);
  EXPECT_NEAR(result.held->quality, dmo::statistics(result.mesh).minimum, 1e-12);
  EXPECT_EQ(result.held->vertices.size(), 3U);
  EXPECT_EQ(result.held->reasons.size(), 3U);
  EXPECT_THAT(result.held->reasons, ::testing::Contains("boundary"));
  EXPECT_FALSE(result.held->sentence.empty());
}

TEST(LibraryOptions, AProgressIsUsedAgainAfterACancel) {
  const dmo::Mesh mesh = sheet(4).mesh();
  dmo::SmoothOptions options;
  options.progress.request_cancel();
  EXPECT_TRUE(dmo::smooth(mesh, options).cancelled);
  options.progress.reset();
  EXPECT_FALSE(dmo::smooth(mesh, options).cancelled);
  EXPECT_EQ(options.progress.label(), "smoothing");
}

/// A strip of an upright cylinder of radius 1 with vertices at these angles, two cells high, and its inner vertices turned by `off`.
dmo::Mesh strip(const std::vector<double>& angles, double off = 0.0) {
  Arrays arrays;
  for (int level = 0; level < 3; ++level)
    for (double angle : angles) {
      if (level == 1 && angle > angles.front() && angle < angles.back()) angle += off;
      arrays.positions.insert(arrays.positions.end(), {std::cos(angle), std::sin(angle), 0.1 * level});
    }
  const auto n = static_cast<dmo::Index>(angles.size());
  for (dmo::Index level = 0; level < 2; ++level)
    for (dmo::Index i = 0; i + 1 < n; ++i)
      arrays.add(dmo::CellKind::Quadrilateral, {i + level * n, i + 1 + level * n, i + 1 + (level + 1) * n, i + (level + 1) * n});
  return arrays.mesh();
}

TEST(LibraryOptions, VerticesSlideOnASurfaceInMemory) {
  std::vector<double> fine;
  for (int i = 0; i <= 64; ++i) fine.push_back(i / 64.0);
  const dmo::Mesh mesh = strip({0.0, 0.3, 0.5, 0.8, 1.0}, 0.12), surface = strip(fine);
  dmo::SmoothOptions options;
  options.max_deviation = 0.1;
  const auto beside = [&](const dmo::Mesh& smoothed) {
    double greatest = 0.0;
    for (std::size_t v = 0; v < smoothed.vertex_count(); ++v)
      greatest = std::max(greatest, 1.0 - std::hypot(smoothed.positions()[3 * v], smoothed.positions()[3 * v + 1]));
    return greatest;
  };
  const dmo::Mesh alone = dmo::smooth(mesh, options).mesh;
  options.surface = surface;
  const dmo::Mesh on_fine = dmo::smooth(mesh, options).mesh;
  EXPECT_FALSE(same_places(on_fine, mesh));
  EXPECT_GT(beside(alone), 1e-3) << "a chord of 0.3 lies 0.011 inside";
  EXPECT_LT(beside(on_fine), 1e-4) << "chords of 1/64 lie 3e-5 inside";
}

TEST(Library, GroupsOfAFileHaveTheirVertices) {
  const std::string path = ::testing::TempDir() + "/library_groups.inp";
  std::ofstream(path) << "*NODE\n1,0,0,0\n2,1,0,0\n3,2,0,0\n4,0,1,0\n5,1,1,0\n6,2,1,0\n*ELEMENT, TYPE=CPS4, ELSET=left\n1,1,2,5,4\n"
                         "*ELEMENT, TYPE=CPS4, ELSET=right\n2,2,3,6,5\n*NSET, NSET=wall\n1,4\n";
  const dmo::Mesh mesh = dmo::Mesh::read(path);
  std::map<std::string, dmo::Group> groups;
  for (const dmo::Group& group : mesh.groups()) groups[group.name] = group;
  EXPECT_EQ(groups.at("right").members, "cells");
  EXPECT_EQ(groups.at("right").cells, std::vector<dmo::Index>{1});
  EXPECT_EQ(groups.at("right").vertices, (std::vector<dmo::Index>{1, 2, 4, 5}));
  EXPECT_EQ(groups.at("wall").members, "points");
  EXPECT_EQ(groups.at("wall").vertices, (std::vector<dmo::Index>{0, 3}));
  EXPECT_EQ(mesh.vertices("wall"), groups.at("wall").vertices);
}

}  // namespace
