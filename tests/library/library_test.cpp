// The library by its public headers alone: arrays in and out, the same positions as the program's own run, errors, cancelling.

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dmoscope/dmoscope.h"
#include "tests/library/arrays.h"

namespace {

using ::testing::HasSubstr;
using namespace dmoscope_test;

TEST(Library, ArraysComeBackAsTheyWentIn) {
  for (const Arrays& arrays : {sheet(6), solids()}) {
    const dmo::Mesh mesh = arrays.mesh();
    ASSERT_EQ(mesh.vertex_count(), arrays.positions.size() / 3);
    EXPECT_EQ(std::memcmp(mesh.positions(), arrays.positions.data(), arrays.positions.size() * sizeof(double)), 0);
    const dmo::Cells cells = mesh.cells();
    ASSERT_EQ(cells.count, arrays.kinds.size());
    EXPECT_EQ(std::vector(cells.kinds, cells.kinds + cells.count), arrays.kinds);
    EXPECT_EQ(std::vector(cells.offsets, cells.offsets + cells.count + 1), arrays.offsets);
    EXPECT_EQ(std::vector(cells.connectivity, cells.connectivity + arrays.connectivity.size()), arrays.connectivity);
  }
  EXPECT_FALSE(sheet(3).mesh().is_volume());
  EXPECT_TRUE(solids().mesh().is_volume());
}

TEST(Library, BoundaryLoopsPartsAndRings) {
  const Arrays arrays = sheet(6);
  const dmo::Mesh mesh = arrays.mesh();
  const std::vector<dmo::BoundaryLoop> loops = mesh.boundary_loops();
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_TRUE(loops[0].outer);
  EXPECT_EQ(loops[0].vertices.size(), 24U);
  EXPECT_DOUBLE_EQ(loops[0].length, 24);
  EXPECT_DOUBLE_EQ(loops[0].area, 36);
  ASSERT_EQ(mesh.parts().size(), 1U);
  EXPECT_EQ(mesh.parts()[0].size(), arrays.kinds.size());
  EXPECT_EQ(mesh.ring(0), (std::vector<dmo::Index>{1, 7})) << "a corner whose cell is a quadrilateral, from edge to edge";
  EXPECT_THROW((void)mesh.ring(49), dmo::UsageError);
  std::vector<double> twice = arrays.positions;
  for (double& x : twice) x *= 2;
  EXPECT_DOUBLE_EQ(mesh.with_positions(twice.data()).boundary_loops()[0].length, 48) << "of the mesh as it stands";
  EXPECT_TRUE(solids().mesh().boundary_loops().empty());
  EXPECT_TRUE(solids().mesh().parts().empty());
  EXPECT_TRUE(solids().mesh().ring(0).empty());
  dmo::SmoothOptions options;
  options.set("slide", "loop:1");
  const dmo::Smoothed slid = dmo::smooth(mesh, options);
  options = {};
  options.boundary = dmo::Boundary::Slide;
  const dmo::Smoothed all = dmo::smooth(mesh, options);
  EXPECT_EQ(std::memcmp(slid.mesh.positions(), all.mesh.positions(), arrays.positions.size() * sizeof(double)), 0);
  options = {};
  options.slide.names = {"loop:2"};
  EXPECT_THROW((void)dmo::smooth(mesh, options), dmo::UsageError);
}

TEST(Library, ClockwiseTrianglesStayClockwise) {
  Arrays arrays = sheet(4);
  std::swap(arrays.connectivity[1], arrays.connectivity[3]);  // a quadrilateral that is wound the other way than all others
  const dmo::Mesh mesh = arrays.mesh();
  const dmo::Cells cells = mesh.cells();
  EXPECT_EQ(std::vector(cells.connectivity, cells.connectivity + arrays.connectivity.size()), arrays.connectivity);
}

TEST(Library, NullArraysAreRefusedByName) {
  const Arrays arrays = sheet(2);
  const std::size_t vertices = arrays.positions.size() / 3;
  const dmo::Cells whole = arrays.cells();
  const auto told = [&](const double* positions, const dmo::Cells& cells) -> std::string {
    try {
      (void)dmo::Mesh(positions, vertices, cells);
    } catch (const dmo::InputError& error) {
      return error.what();
    }
    return "taken";
  };
  EXPECT_THAT(told(nullptr, whole), HasSubstr("positions is null, but there are 9 vertices"));
  for (const char* name : {"kinds", "offsets", "connectivity"}) {
    dmo::Cells cells = whole;
    if (name[0] == 'k') cells.kinds = nullptr;
    if (name[0] == 'o') cells.offsets = nullptr;
    if (name[0] == 'c') cells.connectivity = nullptr;
    EXPECT_THAT(told(arrays.positions.data(), cells), HasSubstr(std::string(name) + " is null"));
  }
  EXPECT_THROW((void)arrays.mesh().with_positions(nullptr), dmo::InputError);
}

TEST(Library, DataComeBackAsTheyWentIn) {
  const Arrays arrays = sheet(4);
  const dmo::Mesh mesh = sheet_with_data(arrays);
  ASSERT_EQ(mesh.cell_data().size(), 1U);
  EXPECT_EQ(mesh.cell_data()[0].name, "material");
  EXPECT_TRUE(mesh.cell_data()[0].whole);
  EXPECT_EQ(mesh.cell_data()[0].values.back(), 2.0);
  ASSERT_EQ(mesh.point_data().size(), 1U);
  EXPECT_EQ(mesh.point_data()[0].components, 3U);
  EXPECT_EQ(mesh.point_data()[0].values[3 * 24 + 1], 24.0);
  EXPECT_TRUE(mesh.groups().empty());
  EXPECT_THROW((void)dmo::Mesh(arrays.positions.data(), 25, arrays.cells(), {}, {{"wind", {1.0, 2.0}, 3}}), dmo::InputError);
}

/// The file after smooth() and write() in the file's own format.
std::string smoothed_file(const dmo::Mesh& mesh, const std::string& path) {
  (void)dmo::smooth(mesh).mesh.write(path);
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Library, BytesHoldAllOfAMesh) {
  const std::string path = ::testing::TempDir() + "/library_bytes.vtk", out = ::testing::TempDir() + "/library_bytes_out.vtk";
  (void)sheet_with_data(sheet(6)).write(path);
  std::ofstream(path, std::ios::app) << "FIELD more 1\nunread 1 1 string\nwords\n";  // content that the file alone holds
  const dmo::Mesh read = dmo::Mesh::read(path), moved = dmo::smooth(read, {}).mesh;
  std::vector<double> places(read.positions(), read.positions() + 3 * read.vertex_count());
  for (double& x : places) x *= 2.0;
  for (const dmo::Mesh& mesh : {sheet_with_data(sheet(6)), solids().mesh(), read, moved, read.with_positions(places.data()),
                                dmo::smooth(read.with_positions(places.data())).mesh}) {
    const std::string bytes = mesh.to_bytes();
    const dmo::Mesh again = dmo::Mesh::from_bytes(bytes);
    EXPECT_EQ(again.to_bytes(), bytes);
    EXPECT_EQ(std::memcmp(again.positions(), mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
    const std::string file = smoothed_file(mesh, out);
    EXPECT_EQ(smoothed_file(again, out), file);
    EXPECT_FALSE(file.empty());
  }
  std::string damaged = read.to_bytes();
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  for (const std::string& bytes : {std::string(), damaged, read.to_bytes().substr(0, 1000)})
    EXPECT_THROW((void)dmo::Mesh::from_bytes(bytes), dmo::InputError);
}

TEST(Library, QualityIsWhatTheFormulaSays) {
  Arrays arrays;  // an equilateral triangle, and one with a right angle and equal legs: mean ratio 4 sqrt(3) A / sum of squares
  arrays.positions = {0, 0, 0, 1, 0, 0, 0.5, std::sqrt(0.75), 0, 1, -1, 0};
  arrays.add(dmo::CellKind::Triangle, {0, 1, 2});
  arrays.add(dmo::CellKind::Triangle, {0, 3, 1});
  const std::vector<double> q = dmo::quality(arrays.mesh());
  ASSERT_EQ(q.size(), 2U);
  EXPECT_NEAR(q[0], 1.0, 1e-15);
  EXPECT_NEAR(q[1], 4 * std::sqrt(3.0) * 0.5 / (1 + 1 + 2), 1e-15);
  EXPECT_DOUBLE_EQ(dmo::statistics(arrays.mesh()).minimum, q[1]);
  EXPECT_EQ(dmo::statistics(arrays.mesh()).worst_cell, 1U);
  EXPECT_EQ(dmo::metrics().front().name, "mean-ratio");
  for (const dmo::Metric& metric : dmo::metrics()) {
    EXPECT_EQ(dmo::quality(arrays.mesh(), metric.name).size(), 2U) << metric.name;
    EXPECT_FALSE(metric.title.empty() || metric.formula.empty() || metric.doc.empty()) << metric.name;
  }
  EXPECT_EQ(dmo::metrics().size(), 13U);
  EXPECT_THROW((void)dmo::quality(arrays.mesh(), "no-metric"), dmo::UsageError);
}

TEST(Library, SmoothingRaisesTheMinimumAndKeepsWhatStays) {
  for (const Arrays& arrays : {sheet(8), solids()}) {
    const dmo::Mesh mesh = arrays.mesh();
    const dmo::Smoothed one = dmo::smooth(mesh), other = [&] {
      dmo::SmoothOptions options;
      options.threads = 3;
      return dmo::smooth(mesh, options);
    }();
    EXPECT_GT(dmo::statistics(one.mesh).minimum, dmo::statistics(mesh).minimum + 0.02);
    ASSERT_FALSE(one.history.empty());
    EXPECT_DOUBLE_EQ(one.history.front().statistics.minimum, dmo::statistics(mesh).minimum);
    EXPECT_DOUBLE_EQ(one.history.back().statistics.minimum, dmo::statistics(one.mesh).minimum);
    const std::size_t bytes = 3 * mesh.vertex_count() * sizeof(double);
    EXPECT_EQ(std::memcmp(one.mesh.positions(), other.mesh.positions(), bytes), 0) << "another number of threads";
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      if (mesh.boundary()[v] != 0) {
        EXPECT_EQ(std::memcmp(one.mesh.positions() + 3 * v, mesh.positions() + 3 * v, 3 * sizeof(double)), 0) << v;
      }
  }
}

TEST(Library, FixedVerticesAndOptionsAreHeard) {
  const dmo::Mesh mesh = sheet(8).mesh();
  dmo::SmoothOptions options;
  options.iterations = 3;
  for (dmo::Index v = 0; v < mesh.vertex_count(); ++v)
    if (v != 40) options.fixed.numbers.push_back(v);
  const dmo::Smoothed one = dmo::smooth(mesh, options);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    EXPECT_EQ(std::memcmp(one.mesh.positions() + 3 * v, mesh.positions() + 3 * v, 3 * sizeof(double)) == 0, v != 40) << v;
  options.fixed.numbers = {99999};
  EXPECT_THROW((void)dmo::smooth(mesh, options), dmo::UsageError);
  options = {};
  for (const auto& [name, value, told] : std::vector<std::array<std::string, 3>>{{"methode", "dmo", "method"},
                                                                                 {"metric", "mean", "mean-ratio"},
                                                                                 {"grid", "1", "grid"},
                                                                                 {"grid", "many", "many"},
                                                                                 {"then", "peace", "mean"},
                                                                                 {"size-function", "h1:0,0", "combine"},
                                                                                 {"target", "round", "target"}}) {
    options = {};
    try {
      options.set(name, value);
      (void)dmo::smooth(mesh, options);
      ADD_FAILURE() << name << "=" << value << " was taken";
    } catch (const dmo::UsageError& error) {
      EXPECT_THAT(error.what(), HasSubstr(told));
    }
  }
}

TEST(Library, MoreThreadsThanTheProgramAllowsAreRefused) {
  const dmo::Mesh mesh = sheet(2).mesh();
  const auto told = [](const auto& work) -> std::string {
    try {
      work();
    } catch (const dmo::UsageError& error) {
      return error.what();
    }
    return "taken";
  };
  dmo::SmoothOptions options;
  options.threads = 1025;
  EXPECT_THAT(told([&] { (void)dmo::smooth(mesh, options); }), HasSubstr("threads: expected a whole number from 0 to 1024, not '1025'"));
  EXPECT_THAT(told([&] { (void)dmo::quality(mesh, "mean-ratio", 1025); }), HasSubstr("1024"));
  EXPECT_THAT(told([&] { (void)dmo::statistics(mesh, "mean-ratio", 1025); }), HasSubstr("1024"));
}

TEST(Library, ATargetIsOneOfTheMetric) {
  const dmo::Mesh mesh = sheet(6).mesh();
  dmo::SmoothOptions option, metric;
  option.target = "input";
  metric.metric = "mean-ratio@input";
  const dmo::Smoothed one = dmo::smooth(mesh, option), other = dmo::smooth(mesh, metric);
  EXPECT_EQ(std::memcmp(one.mesh.positions(), other.mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
  EXPECT_NEAR(one.history.front().statistics.minimum, 1.0, 1e-12) << "as it was, each cell is its own target";
}

TEST(Library, ARecipeGoesOnUntilItHasConverged) {
  const dmo::Mesh mesh = sheet(6).mesh();
  dmo::SmoothOptions options, spelled;
  options.recipe = dmo::Recipe::Mean;
  spelled.then_mean = dmo::MeanKind::Harmonic;
  spelled.until_converged = true;
  const dmo::Smoothed one = dmo::smooth(mesh, options), other = dmo::smooth(mesh, spelled);
  EXPECT_TRUE(one.converged);
  EXPECT_EQ(std::memcmp(one.mesh.positions(), other.mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
  options.iterations = 3;
  EXPECT_EQ(dmo::smooth(mesh, options).iteration, 3U);
}

TEST(Library, AGapThatIsSaidCountsMoreThanTheRecipes) {
  const dmo::Mesh mesh = sheet(6).mesh();
  dmo::SmoothOptions options, spelled;
  options.recipe = dmo::Recipe::Best;
  spelled.set("then", "joint,mean");
  options.joint_gap = spelled.joint_gap = 0.2;
  spelled.until_converged = true;
  const dmo::Smoothed one = dmo::smooth(mesh, options), other = dmo::smooth(mesh, spelled);
  EXPECT_EQ(std::memcmp(one.mesh.positions(), other.mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
  options.joint_gap = dmo::SmoothOptions{}.joint_gap;
  EXPECT_NE(std::memcmp(dmo::smooth(mesh, options).mesh.positions(), one.mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
}

TEST(Library, ACallbackEndsARunAndTheMeshIsKept) {
  const dmo::Mesh mesh = sheet(30).mesh();
  dmo::SmoothOptions options;
  options.iterations = 50;
  std::vector<std::uint64_t> heard;
  options.after_iteration = [&heard](const dmo::Iteration& at) {
    heard.push_back(at.number);
    return at.number < 2;
  };
  const dmo::Smoothed cut = dmo::smooth(mesh, options);
  EXPECT_TRUE(cut.cancelled);
  EXPECT_EQ(heard, (std::vector<std::uint64_t>{1, 2}));
  heard.clear();
  EXPECT_EQ(dmo::smooth(mesh, options).iteration, 2U) << "the same options again";
  EXPECT_EQ(heard.size(), 2U);
  options = {};
  options.iterations = 2;
  const dmo::Smoothed two = dmo::smooth(mesh, options);
  EXPECT_EQ(std::memcmp(cut.mesh.positions(), two.mesh.positions(), 3 * mesh.vertex_count() * sizeof(double)), 0);
}

TEST(Library, ACancelAtOnceGivesTheMeshBack) {
  const dmo::Mesh moved = dmo::smooth(sheet(30).mesh()).mesh;
  dmo::SmoothOptions options;
  options.progress.request_cancel();
  const dmo::Smoothed none = dmo::smooth(moved, options);
  EXPECT_TRUE(none.cancelled);
  EXPECT_EQ(std::memcmp(none.mesh.positions(), moved.positions(), 3 * moved.vertex_count() * sizeof(double)), 0);
  EXPECT_THROW((void)dmo::Mesh::read("/nothing", options.progress), dmo::Error);
}

TEST(Library, MaterialsHoldTheirInterface) {
  const Arrays arrays = sheet(6);
  std::vector<double> material;
  for (std::size_t c = 0; c < arrays.kinds.size(); ++c) material.push_back(c < arrays.kinds.size() / 2 ? 1.0 : 2.0);
  const dmo::Mesh plain = arrays.mesh();
  const dmo::Mesh sorted(arrays.positions.data(), arrays.positions.size() / 3, arrays.cells(), {{"material", material}});
  const auto moved = [](const dmo::Mesh& mesh) {
    const dmo::Smoothed smoothed = dmo::smooth(mesh);
    std::size_t count = 0;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      count += std::memcmp(smoothed.mesh.positions() + 3 * v, mesh.positions() + 3 * v, 3 * sizeof(double)) != 0 ? 1 : 0;
    return count;
  };
  EXPECT_GT(moved(sorted), 0U);
  EXPECT_LT(moved(sorted) + 3, moved(plain));
}

TEST(Library, AResultCanBeSmoothedOn) {
  const dmo::Mesh mesh = sheet(10).mesh();
  dmo::SmoothOptions two, four;
  two.iterations = 2;
  four.iterations = 4;
  const dmo::Smoothed on = dmo::smooth(dmo::smooth(mesh, two).mesh, two), once = dmo::smooth(mesh, four);
  EXPECT_NEAR(dmo::statistics(on.mesh).minimum, dmo::statistics(once.mesh).minimum, 0.05);
  EXPECT_GE(dmo::statistics(on.mesh).minimum, on.history.front().statistics.minimum);
}

/// A depth of 10 x stays one at any positions; flags move with the vertices.
TEST(Library, PointDataBelongToPlaces) {
  const Arrays arrays = sheet(8);
  dmo::PointData depth, flag;
  depth.name = "depth";
  flag.name = "flag";
  for (std::size_t v = 0; v < arrays.positions.size() / 3; ++v) {
    depth.values.push_back(10.0 * arrays.positions[3 * v] + 0.25);
    flag.values.push_back(static_cast<double>(v % 3));
  }
  const dmo::Mesh mesh(arrays.positions.data(), arrays.positions.size() / 3, arrays.cells(), {}, {depth, flag});
  const auto expect_depth = [&](const dmo::Mesh& moved) {
    const auto data = moved.point_data();
    ASSERT_EQ(data.size(), 2U);
    for (std::size_t v = 0; v < moved.vertex_count(); ++v) EXPECT_NEAR(data[0].values[v], 10.0 * moved.positions()[3 * v] + 0.25, 1e-12);
    EXPECT_EQ(data[1].values, flag.values);
  };
  const dmo::Smoothed once = dmo::smooth(mesh);
  EXPECT_NE(once.mesh.point_data()[0].values, depth.values);
  EXPECT_EQ(once.fields, "depth was taken anew at the new places (linear in the input's elements); flag was carried (whole numbers)");
  expect_depth(once.mesh);
  expect_depth(dmo::smooth(once.mesh).mesh);
  expect_depth(dmo::Mesh::from_bytes(once.mesh.to_bytes()));
  dmo::SmoothOptions carry;
  carry.fields.all = dmo::FieldRule::Carry;
  EXPECT_EQ(dmo::smooth(mesh, carry).mesh.point_data()[0].values, depth.values);
  // After a move by hand fields are carried, from the last positions.
  const dmo::Mesh elsewhere = once.mesh.with_positions(arrays.positions.data());
  EXPECT_EQ(elsewhere.point_data()[0].values, once.mesh.point_data()[0].values);
  EXPECT_EQ(once.mesh.with_materials({}).point_data()[0].values, once.mesh.point_data()[0].values);

  const std::string file = (std::filesystem::temp_directory_path() / "dmoscope_library_depth.14").string();
  const auto written = [&](const dmo::Mesh& what) {
    (void)what.write(file);
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  (void)written(mesh);
  const dmo::Mesh read = dmo::Mesh::read(file);
  const dmo::Smoothed again = dmo::smooth(read);
  const std::string bytes = written(again.mesh);
  const dmo::Mesh back = dmo::Mesh::read(file);
  for (std::size_t v = 0; v < back.vertex_count(); ++v)
    EXPECT_NEAR(back.point_data()[0].values[v], 10.0 * back.positions()[3 * v] + 0.25, 1e-12);
  // Writing by way of bytes and of other positions gives the same file.
  EXPECT_EQ(written(dmo::Mesh::from_bytes(again.mesh.to_bytes())), bytes);
  EXPECT_EQ(written(again.mesh.with_positions(again.mesh.positions())), bytes);
  EXPECT_EQ(written(dmo::Mesh::from_bytes(again.mesh.with_positions(again.mesh.positions()).to_bytes())), bytes);
  std::filesystem::remove(file);
}

/// Squares of degrees at 60 degrees north are twice as high as wide.
TEST(Library, DegreesAreJudgedOnTheEarth) {
  const std::string file = (std::filesystem::temp_directory_path() / "dmoscope_library_degrees.14").string();
  {
    std::ofstream stream(file);
    stream << "in degrees\n4 9\n";
    for (int v = 0; v < 9; ++v) stream << v + 1 << ' ' << (v == 4 ? 0.012 : 0.01 * (v % 3)) << ' ' << 60.0 + 0.01 * (v / 3) << " 1\n";
    stream << "1 4 1 2 5 4\n2 4 2 3 6 5\n3 4 4 5 8 7\n4 4 5 6 9 8\n";
  }
  const dmo::Mesh mesh = dmo::Mesh::read(file);
  std::filesystem::remove(file);
  EXPECT_TRUE(mesh.in_degrees());
  EXPECT_EQ(mesh.positions()[3 * 8 + 1], 60.02);
  // A rectangle of one by two has the mean ratio 2 / (1 / 2 + 2) at its corners.
  const auto regular = [](const dmo::Mesh& at) {
    std::vector<double> positions(at.positions(), at.positions() + 3 * at.vertex_count());
    positions[3 * 4] = 0.01;
    return dmo::statistics(at.with_positions(positions.data())).minimum;
  };
  EXPECT_NEAR(regular(mesh), 0.8, 1e-3);
  EXPECT_NEAR(regular(mesh.with_degrees(false)), 1.0, 1e-12);
  const dmo::Smoothed smoothed = dmo::smooth(mesh);
  EXPECT_NEAR(smoothed.mesh.positions()[3 * 4], 0.01, 1e-5);
  EXPECT_NEAR(smoothed.mesh.positions()[3 * 4 + 1], 60.01, 1e-4);
  EXPECT_EQ(smoothed.mesh.positions()[3 * 8 + 1], 60.02);
  EXPECT_TRUE(dmo::Mesh::from_bytes(smoothed.mesh.to_bytes()).in_degrees());
  const dmo::Mesh named = smoothed.mesh.with_materials({});
  EXPECT_TRUE(named.in_degrees());
  EXPECT_EQ(dmo::statistics(named).minimum, dmo::statistics(smoothed.mesh).minimum);
}

/// Four squares, one cell thick, with a misplaced middle.
TEST(Library, OneCellThickIsSmoothedAsItsFront) {
  const std::string file = (std::filesystem::temp_directory_path() / "dmoscope_library_thin.vtk").string();
  {
    std::ofstream stream(file);
    stream << "# vtk DataFile Version 3.0\nthin\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 18 double\n";
    for (int v = 0; v < 18; ++v) stream << (v % 9 == 4 ? 1.3 : v % 3) << ' ' << v % 9 / 3 << ' ' << (v < 9 ? 0.0 : 0.125) << '\n';
    stream << "CELLS 4 36\n";
    for (const int a : {0, 1, 3, 4}) {
      stream << 8;
      for (const int side : {0, 9})
        for (const int v : {a, a + 1, a + 4, a + 3}) stream << ' ' << v + side;
      stream << '\n';
    }
    stream << "CELL_TYPES 4\n12\n12\n12\n12\n";
  }
  const dmo::Mesh mesh = dmo::Mesh::read(file);
  std::filesystem::remove(file);
  EXPECT_TRUE(mesh.thin());
  EXPECT_TRUE(mesh.is_volume());
  const dmo::Smoothed smoothed = dmo::smooth(mesh);
  const double* const at = smoothed.mesh.positions();
  for (const int v : {4, 13}) {
    EXPECT_NEAR(at[3 * v], 1.0, 0.01);
    EXPECT_NEAR(at[3 * v + 1], 1.0, 0.01);
  }
  EXPECT_EQ(at[3 * 13], at[3 * 4]);
  EXPECT_EQ(at[3 * 13 + 2], 0.125);
  EXPECT_NEAR(dmo::statistics(smoothed.mesh).minimum, 1.0, 1e-3);
  EXPECT_EQ(dmo::quality(smoothed.mesh).size(), 4U);
  EXPECT_LT(dmo::statistics(smoothed.mesh.with_thin(false)).minimum, 0.5) << "eight times as wide as thick";
  EXPECT_EQ(dmo::smooth(mesh.with_thin(false)).mesh.positions()[3 * 4], 1.3) << "all of its vertices are on the boundary";
  EXPECT_TRUE(dmo::Mesh::from_bytes(smoothed.mesh.to_bytes()).thin());
  EXPECT_TRUE(smoothed.mesh.with_materials({}).thin());
  EXPECT_THROW((void)sheet(3).mesh().with_thin(true), dmo::InputError);
  std::vector<double> apart(at, at + 54);
  apart[3 * 13] += 0.5;
  EXPECT_FALSE(smoothed.mesh.with_positions(apart.data()).thin());
}

TEST(Library, WrongArraysAreRefusedByName) {
  const auto refused = [](const Arrays& arrays, const char* told) {
    try {
      (void)arrays.mesh();
      ADD_FAILURE() << told;
    } catch (const dmo::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(told));
    }
  };
  Arrays arrays = sheet(2);
  arrays.connectivity[2] = 77;
  refused(arrays, "corner 77");
  arrays = sheet(2);
  arrays.connectivity[1] = arrays.connectivity[0];
  refused(arrays, "twice");
  arrays = sheet(2);
  arrays.kinds[0] = dmo::CellKind::Triangle;
  refused(arrays, "has 3 corners");
  arrays = sheet(2);
  arrays.kinds[0] = static_cast<dmo::CellKind>(9);
  refused(arrays, "no kind 9");
  arrays = sheet(2);
  arrays.positions[4] = std::numeric_limits<double>::quiet_NaN();
  refused(arrays, "not finite");
  refused(Arrays{{0, 0, 0}, {}, {0}, {}}, "no elements");
  arrays = sheet(2);  // offsets far beyond the corners, which then fall
  arrays.offsets[1] = 400000004;
  arrays.offsets[2] = 400000007;
  refused(arrays, "do not rise");
  arrays = sheet(2);
  arrays.offsets[0] = 1;
  refused(arrays, "first offset");
  arrays = sheet(2);
  EXPECT_THROW((void)dmo::Mesh(arrays.positions.data(), arrays.positions.size() / 3, arrays.cells(), {{"material", {1.0, 2.0}}}),
               dmo::InputError);
}

TEST(Library, ATraceEndsWhereTheFirstVisitDoes) {
  for (const Arrays& arrays : {sheet(2), solids()}) {
    const dmo::Mesh mesh = arrays.mesh();
    const dmo::Index vertex = mesh.is_volume() ? 8 : 4;
    const dmo::Trace trace = dmo::trace(mesh, vertex);
    dmo::SmoothOptions once;
    once.iterations = 1;
    const dmo::Smoothed smoothed = dmo::smooth(mesh, once);  // one free vertex
    EXPECT_EQ(std::memcmp(trace.to, smoothed.mesh.positions() + 3 * vertex, sizeof trace.to), 0);
    EXPECT_GT(trace.after, trace.before);
    ASSERT_EQ(trace.levels.size(), 3U);
    for (const dmo::TraceLevel& level : trace.levels) {
      const std::size_t count = mesh.is_volume() ? 512 : 64;
      EXPECT_EQ(level.candidates.size(), 3 * count);
      EXPECT_EQ(level.values.size(), count);
      EXPECT_EQ(level.quality.size(), count);
    }
  }
  EXPECT_THROW((void)dmo::trace(sheet(2).mesh(), 99), dmo::UsageError);
}

}  // namespace
