// Nodal fields at new positions: linear ones stay linear, in every kind of element.

#include "core/transfer/moved_fields.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/same_bits.h"
#include "core/base/thread_pool.h"
#include "tests/support/meshes.h"
#include "tests/support/volume_grids.h"

namespace dmoscope::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double plane_at(Vec3 p) { return 3.0 + 2.0 * p.x - 5.0 * p.y + 0.5 * p.z; }

template <class Function>
Field field_of(const Mesh& mesh, std::string name, const Function& function) {
  Field field;
  field.name = std::move(name);
  for (const Vec3 p : mesh.positions) field.values.push_back(function(p));
  return field;
}

MovedFields moved_by(const InputMesh& input, const std::vector<Vec3>& positions, const FieldRules& rules = {}) {
  Progress progress;
  return move_fields(input, rules, positions, nullptr, progress);
}

/// The field's values at new positions.
std::vector<double> values_at(const InputMesh& input, const std::vector<Vec3>& positions, std::size_t field = 0) {
  for (FieldValues& one : moved_by(input, positions).values)
    if (one.field == field) return std::move(one.values);
  return input.mesh.fields[field].values;
}

bool is_inside(Vec3 p, bool solid) {
  const auto within = [](double x) { return x > 0.0 && x < 1.0; };
  return within(p.x) && within(p.y) && (!solid || within(p.z));
}

/// Moves two thirds of the vertices off the boundary to places anywhere in the unit square or cube, far beyond their stars.
void expect_linear(Mesh mesh, bool solid) {
  mesh.fields.push_back(field_of(mesh, "plane", plane_at));
  const auto prepared = input(std::move(mesh));
  Random random(7);
  std::vector<Vec3> positions = prepared->mesh.positions;
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (v % 3 != 0 && is_inside(positions[v], solid)) positions[v] = {random(), random(), solid ? random() : 0.0};
  const std::vector<double> found = values_at(*prepared, positions);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    EXPECT_NEAR(found[v], plane_at(positions[v]), 1e-11) << v;
    if (same_bits(positions[v], prepared->mesh.positions[v])) {
      EXPECT_TRUE(same_bits(found[v], prepared->mesh.fields[0].values[v])) << v;
    }
  }
}

TEST(MovedFields, WhatIsLinearInThePlaneStaysSo) {
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) expect_linear(lattice(12, 0.3, 5, cells), false);
}

TEST(MovedFields, WhatIsLinearInSpaceStaysSo) {
  for (const test::Fill fill : {test::Fill::Tetrahedra, test::Fill::Hexahedra, test::Fill::Mixed})
    expect_linear(test::volume_grid(5, fill, 0.1, 3), true);
}

/// Elements on both sides of a face split it in one way: on a quadrilateral face the field is the same from both.
TEST(MovedFields, IsContinuousAcrossFaces) {
  Mesh mesh = test::volume_grid(2, test::Fill::Hexahedra);
  Random random(11);
  mesh.fields.push_back(field_of(mesh, "rough", [&](Vec3) { return random(-1.0, 1.0) + 1e-3; }));
  const auto prepared = input(std::move(mesh));
  constexpr Index kMiddle = 13;
  for (int i = 0; i < 40; ++i) {
    const double y = random(0.05, 0.95), z = random(0.05, 0.95);
    const auto at = [&](double x) {
      std::vector<Vec3> positions = prepared->mesh.positions;
      positions[kMiddle] = {x, y, z};
      return values_at(*prepared, positions)[kMiddle];
    };
    EXPECT_NEAR(at(0.5 - 1e-9), at(0.5 + 1e-9), 1e-7) << y << ' ' << z;
  }
}

TEST(MovedFields, BeyondTheMeshTheNearestPlaceCounts) {
  Mesh mesh = lattice(4, 0.0, 1);
  mesh.fields.push_back(field_of(mesh, "plane", plane_at));
  const auto prepared = input(std::move(mesh));
  std::vector<Vec3> positions = prepared->mesh.positions;
  positions[2] = {0.4, -0.2, 0.0};   // below the square
  positions[24] = {1.5, 1.25, 0.0};  // beyond its corner
  const std::vector<double> found = values_at(*prepared, positions);
  EXPECT_NEAR(found[2], plane_at({0.4, 0.0, 0.0}), 1e-12);
  EXPECT_NEAR(found[24], plane_at({1.0, 1.0, 0.0}), 1e-12);
}

/// A belt of quadrilaterals around the Earth, from -180 to 170 degrees.
TEST(MovedFields, GoesRoundInLongitude) {
  Mesh mesh;
  constexpr Index kAround = 36;
  for (const double y : {-10.0, 0.0, 10.0})
    for (Index i = 0; i < kAround; ++i) mesh.positions.push_back({-180.0 + 10.0 * i, y, 0.0});
  for (Index j = 0; j < 2; ++j)
    for (Index i = 0; i < kAround; ++i) {
      const Index a = j * kAround + i, b = j * kAround + (i + 1) % kAround;
      add(mesh, {a, b, b + kAround, a + kAround});
    }
  mesh.fields.push_back(field_of(mesh, "tent", [](Vec3 p) { return 0.5 + std::abs(p.x) + p.y; }));  // 180.5 at the seam
  const auto prepared = input(std::move(mesh));
  ASSERT_GT(prepared->geometry.plane.period, 0.0);
  std::vector<Vec3> positions = prepared->mesh.positions;
  positions[kAround] = {176.0, 2.0, 0.0};            // from the seam to the west of it
  positions[2 * kAround - 1] = {-177.0, -1.0, 0.0};  // from 170 across it
  const std::vector<double> found = values_at(*prepared, positions);
  EXPECT_NEAR(found[kAround], 0.5 + 176.0 + 2.0, 1e-9);
  EXPECT_NEAR(found[2 * kAround - 1], 0.5 + 177.0 - 1.0, 1e-9);
}

/// A roof: a point off its faces has the value of the nearest of them.
TEST(MovedFields, OnASurfaceTheNearestFacetCounts) {
  Mesh mesh;
  for (Index j = 0; j <= 2; ++j)
    for (const Vec3 p : {Vec3{-1, 0, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 0}}) mesh.positions.push_back({p.x, static_cast<double>(j), p.z});
  for (Index j = 0; j < 2; ++j)
    for (Index i = 0; i < 2; ++i) add(mesh, {3 * j + i, 3 * j + i + 1, 3 * j + i + 4, 3 * j + i + 3});
  mesh.fields.push_back(field_of(mesh, "plane", plane_at));
  const auto prepared = input(std::move(mesh));
  ASSERT_TRUE(prepared->is_surface());
  std::vector<Vec3> positions = prepared->mesh.positions;
  positions[4] = {0.6, 1.3, 0.6};  // above the side x + z = 1, whose nearest place is (0.5, 1.3, 0.5)
  EXPECT_NEAR(values_at(*prepared, positions)[4], plane_at({0.5, 1.3, 0.5}), 1e-12);
}

/// Tensors diag(exp(a), exp(b)) with linear a and b are kept by the mean of logarithms.
TEST(MovedFields, MetricTensorsAreInterpolatedByTheirLogarithms) {
  for (const int components : {3, 9}) {
    Mesh mesh = lattice(6, 0.2, 3);
    Field metric;
    metric.name = "metric";
    metric.components = components;
    const auto tensor = [&](Vec3 p) {
      const double a = std::exp(4.0 * p.x - p.y), d = std::exp(1.0 - 3.0 * p.y), c = std::cos(0.5), s = std::sin(0.5);
      const double xx = c * c * a + s * s * d, xy = c * s * (a - d), yy = s * s * a + c * c * d;
      return components == 3 ? std::vector<double>{xx, xy, yy} : std::vector<double>{xx, xy, 0, xy, yy, 0, 0, 0, 1};
    };
    for (const Vec3 p : mesh.positions)
      for (const double number : tensor(p)) metric.values.push_back(number);
    mesh.fields.push_back(metric);
    const auto prepared = input(std::move(mesh));
    std::vector<Vec3> positions = prepared->mesh.positions;
    constexpr std::size_t kMoved = 24;
    positions[kMoved] = {0.31, 0.77, 0.0};
    const std::vector<double> found = values_at(*prepared, positions), wanted = tensor(positions[kMoved]);
    for (std::size_t k = 0; k < wanted.size(); ++k)
      EXPECT_NEAR(found[kMoved * wanted.size() + k], wanted[k], 1e-12 * std::exp(4.0)) << components << ' ' << k;
  }
}

TEST(MovedFields, TensorsOfSpaceStayPositiveDefinite) {
  Mesh mesh = test::volume_grid(3, test::Fill::Hexahedra, 0.1);
  Field metric;
  metric.name = "metric";
  metric.components = 6;
  Random random(3);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    std::array<std::array<double, 3>, 3> l{};  // L L^T, from 1e-6 to 1e6
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) l[i][j] = i == j ? std::pow(10.0, random(-3.0, 3.0)) : random(-1.0, 1.0);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) sum += l[i][k] * l[j][k];
        metric.values.push_back(sum);  // 11 12 22 13 23 33
      }
  }
  mesh.fields.push_back(metric);
  const auto prepared = input(std::move(mesh));
  std::vector<Vec3> positions = prepared->mesh.positions;
  for (Vec3& p : positions)
    if (is_inside(p, true)) p = {random(), random(), random()};
  const std::vector<double> found = values_at(*prepared, positions);
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const double* m = found.data() + 6 * v;
    EXPECT_GT(m[0], 0.0);
    EXPECT_GT(m[0] * m[2] - m[1] * m[1], 0.0);
    EXPECT_GT(m[0] * (m[2] * m[5] - m[4] * m[4]) - m[1] * (m[1] * m[5] - m[4] * m[3]) + m[3] * (m[1] * m[4] - m[2] * m[3]), 0.0);
  }
}

TEST(MovedFields, WholeNumbersAreCarriedUnlessTheyAreADepth) {
  Mesh mesh = lattice(4, 0.0, 1);
  mesh.fields.push_back(field_of(mesh, "flag", [](Vec3 p) { return p.x > 0.4 ? 2.0 : 1.0; }));
  mesh.fields.push_back(field_of(mesh, "depth", [](Vec3 p) { return std::floor(4.0 * p.x); }));
  mesh.fields.back().role = "depth";
  mesh.fields.push_back(field_of(mesh, "id", [](Vec3 p) { return p.x + 0.25; }));
  mesh.fields.back().type = "int";
  mesh.fields.push_back(field_of(mesh, "temp", plane_at));
  const auto prepared = input(std::move(mesh));
  std::vector<Vec3> positions = prepared->mesh.positions;
  positions[12] = {0.4, 0.5, 0.0};
  const MovedFields usual = moved_by(*prepared, positions);
  EXPECT_THAT(usual.placed, ElementsAre("depth", "temp"));
  EXPECT_THAT(usual.whole, ElementsAre("flag", "id"));
  ASSERT_EQ(usual.values.size(), 2U);
  EXPECT_NEAR(usual.values[0].values[12], 1.6, 1e-12);
  EXPECT_EQ(usual.sentence(),
            "depth, temp were taken anew at the new places (linear in the input's elements); flag, id were carried (whole numbers)");
  const MovedFields other = moved_by(*prepared, positions, parse_field_rules("flag=place,temp=carry"));
  EXPECT_THAT(other.placed, ElementsAre("flag", "depth"));
  EXPECT_THAT(other.carried, ElementsAre("temp"));
  EXPECT_TRUE(moved_by(*prepared, positions, parse_field_rules("carry")).values.empty());
  EXPECT_THAT(moved_by(*prepared, positions, parse_field_rules("carry,temp=place")).placed, ElementsAre("temp"));
  EXPECT_THROW((void)moved_by(*prepared, positions, parse_field_rules("tmp=place")), UsageError);
}

TEST(MovedFields, RulesAreReadAndWritten) {
  for (const char* text : {"place", "carry", "depth=carry,temp=place", "carry,depth=place"})
    EXPECT_EQ(to_text(parse_field_rules(text)), text);
  for (const char* text : {"", "up", "depth", "depth=up", "=place", "depth=carry,depth=place", "depth=carry,place", "place,"})
    EXPECT_THROW((void)parse_field_rules(text), UsageError) << text;
}

/// Values of an integer type are rounded; none comes without a value, and next to a gap a vertex keeps its own.
TEST(MovedFields, TypesAndGaps) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Mesh mesh = lattice(4, 0.0, 1);
  mesh.fields.push_back(field_of(mesh, "float", plane_at));
  mesh.fields.back().type = "float";
  mesh.fields.push_back(field_of(mesh, "gaps", [](Vec3 p) { return p.x + 0.5; }));
  mesh.fields.back().values[6] = nan;
  const auto prepared = input(std::move(mesh));
  std::vector<Vec3> positions = prepared->mesh.positions;
  positions[6] = {0.8, 0.8, 0.0};    // without a value
  positions[12] = {0.3, 0.28, 0.0};  // beside vertex 6, which has no value
  positions[13] = {0.8, 0.6, 0.0};
  const std::vector<double> floats = values_at(*prepared, positions), gaps = values_at(*prepared, positions, 1);
  EXPECT_EQ(floats[13], static_cast<double>(static_cast<float>(floats[13])));
  EXPECT_NEAR(floats[13], plane_at(positions[13]), 1e-6);
  EXPECT_TRUE(std::isnan(gaps[6]));
  EXPECT_EQ(gaps[12], prepared->mesh.fields[1].values[12]);
  EXPECT_NEAR(gaps[13], 1.3, 1e-12);
}

TEST(MovedFields, AreTheSameForAnyNumberOfThreads) {
  Mesh mesh = lattice(100, 0.3, 2, Cells::Mixed);
  mesh.fields.push_back(field_of(mesh, "wave", [](Vec3 p) { return std::sin(9.0 * p.x) * std::cos(7.0 * p.y); }));
  const auto prepared = input(std::move(mesh));
  std::vector<Vec3> positions = prepared->mesh.positions;
  Random random(5);
  for (Vec3& p : positions) p = {p.x + random(-0.05, 0.05), p.y + random(-0.05, 0.05), 0.0};
  Progress progress;
  ThreadPool pool(4);
  const MovedFields one = moved_by(*prepared, positions), four = move_fields(*prepared, {}, positions, &pool, progress);
  ASSERT_EQ(one.values.size(), 1U);
  EXPECT_EQ(one.values[0].values, four.values[0].values);
}

}  // namespace
}  // namespace dmoscope::testing
