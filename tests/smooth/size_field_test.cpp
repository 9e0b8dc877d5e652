// Target sizes of elements: fields between their vertices and outside, size functions, and their correlation.

#include "core/smooth/size_field.h"

#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using testing::Cells;
using ::testing::HasSubstr;
using testing::input;
using testing::lattice;
using testing::Random;

template <class Value>
Mesh with_field(Mesh mesh, Value value) {
  Field field;
  field.name = "depth";
  for (const Vec3& p : mesh.positions) field.values.push_back(value(p));
  mesh.fields.push_back(std::move(field));
  return mesh;
}

SizeField depth_of(const std::shared_ptr<const InputMesh>& mesh) { return {mesh, {SizeFunction::Kind::Field, {}, "depth"}}; }

TEST(SizeField, ALinearFieldIsExactBetweenTheVertices) {
  const auto linear = [](Vec3 p) { return 5.0 + 2.0 * p.x - 3.0 * p.y; };
  for (const Cells cells : {Cells::Triangles, Cells::Quadrilaterals, Cells::Mixed}) {
    const auto mesh = input(with_field(lattice(11, 0.3, 3, cells), linear));
    const SizeField size = depth_of(mesh);
    Random random(4);
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p{random(), random(), 0.0};
      const auto near = static_cast<Index>(random() * mesh->mesh.vertex_count());
      EXPECT_NEAR(size.at(near, p), linear(p), 1e-9);
    }
  }
}

TEST(SizeField, DoesNotAskWhichVertexStandsThere) {
  const auto mesh = input(with_field(lattice(9, 0.3, 5), [](Vec3 p) { return 1.0 + p.x * p.x + std::sin(5 * p.y); }));
  const SizeField size = depth_of(mesh);
  Random random(6);
  for (int k = 0; k < 300; ++k) {
    const Vec3 p{random(), random(), 0.0};
    for (Index near = 0; near < mesh->mesh.vertex_count(); near += 7) EXPECT_NEAR(size.at(near, p), size.at(0, p), 1e-12);
  }
}

TEST(SizeField, OutsideItIsTheNearestVertexs) {
  Mesh hole = lattice(10, 0.2, 7);  // without the elements in the middle
  Mesh mesh;
  mesh.positions = hole.positions;
  for (Index e = 0; e < hole.elements.size(); ++e) {
    const auto c = hole.elements.corners(e);
    const Vec3 p = hole.positions[c[0]];
    if (std::hypot(p.x - 0.5, p.y - 0.5) > 0.3) mesh.elements.add(ElementKind::Triangle, c);
  }
  Random values(8);
  const auto ring = input(with_field(std::move(mesh), [&](Vec3) { return values(1.0, 2.0); }));
  const SizeField size = depth_of(ring);
  const auto& positions = ring->mesh.positions;
  const auto& depth = ring->mesh.fields[0].values;
  Random random(9);
  int outside = 0;
  for (int k = 0; k < 500; ++k) {
    const bool in_hole = k % 2 == 0;
    const double angle = random(0, 2 * M_PI), radius = in_hole ? random(0, 0.15) : random(0.8, 5.0);
    const Vec3 p{0.5 + radius * std::cos(angle), 0.5 + radius * std::sin(angle), 0.0};
    Index nearest = kNoIndex;
    double least = INFINITY;
    for (Index v = 0; v < positions.size(); ++v) {
      const double d = std::hypot(positions[v].x - p.x, positions[v].y - p.y);
      if (ring->topology.star(v).empty() || d >= least) continue;
      least = d;
      nearest = v;
    }
    EXPECT_EQ(size.at(0, p), depth[nearest]) << p.x << ' ' << p.y;
    ++outside;
  }
  EXPECT_EQ(outside, 500);
}

// Every element of a fan is as long as the fan's radius: a list of all cells that each touches would have more than 2^32 entries.
TEST(SizeField, AFanOfManyElementsIsSearched) {
  constexpr Index kElements = 300000;
  const auto linear = [](Vec3 p) { return 5.0 + 2.0 * p.x - 3.0 * p.y; };
  Mesh fan;
  fan.positions.push_back({0.0, 0.0, 0.0});
  for (Index i = 0; i < kElements; ++i) {
    const double angle = 2.0 * M_PI * i / kElements;
    fan.positions.push_back({std::cos(angle), std::sin(angle), 0.0});
    fan.elements.add(ElementKind::Triangle, std::array<Index, 3>{0, i + 1, (i + 1) % kElements + 1});
  }
  const auto mesh = input(with_field(std::move(fan), linear));
  const SizeField size = depth_of(mesh);
  Random random(3);
  for (int k = 0; k < 50; ++k) {
    const double angle = random(0, 2 * M_PI), radius = random(0.05, 0.999);
    const Vec3 p{radius * std::cos(angle), radius * std::sin(angle), 0.0};
    EXPECT_NEAR(size.at(1, p), linear(p), 1e-9);
  }
}

TEST(SizeField, LandHasTheLeastPositiveDepth) {
  const auto mesh = input(with_field(lattice(4, 0.0, 1), [](Vec3 p) { return p.x < 0.3 ? -2.0 : p.x; }));
  const SizeField size = depth_of(mesh);
  EXPECT_THAT(size.note(), HasSubstr("10 vertices"));
  EXPECT_THAT(size.note(), HasSubstr("0.5"));
  EXPECT_DOUBLE_EQ(size.at(0, {0.0, 0.0, 0.0}), 0.5);
  EXPECT_DOUBLE_EQ(size.at(0, {1.0, 1.0, 0.0}), 1.0);
  EXPECT_TRUE(depth_of(input(with_field(lattice(4, 0.0, 1), [](Vec3) { return 1.0; }))).note().empty());
}

TEST(SizeField, SaysWhatIsWrongWithAField) {
  const auto trouble = [](Mesh mesh) -> std::string {
    try {
      (void)depth_of(input(std::move(mesh)));
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(trouble(lattice(3, 0.0, 1)), HasSubstr("no nodal field 'depth'"));
  Mesh other = with_field(lattice(3, 0.0, 1), [](Vec3) { return 1.0; });
  other.fields[0].name = "salt";
  EXPECT_THAT(trouble(other), HasSubstr("salt"));
  EXPECT_THAT(trouble(with_field(lattice(3, 0.0, 1), [](Vec3 p) { return p.x > 0.9 ? NAN : 1.0; })), HasSubstr("vertex 3"));
  EXPECT_THAT(trouble(with_field(lattice(3, 0.0, 1), [](Vec3 p) { return -p.x; })), HasSubstr("positive at no vertex"));
}

TEST(SizeField, OfAPoint) {
  const auto mesh = input(lattice(3, 0.0, 1));
  const SizeField near(mesh, {SizeFunction::Kind::Distance, {1.0, 1.0, 0.0}, {}});
  const SizeField far(mesh, {SizeFunction::Kind::InverseDistance, {1.0, 1.0, 0.0}, {}});
  EXPECT_DOUBLE_EQ(near.at(0, {4.0, 5.0, 0.0}), 5.0);
  EXPECT_DOUBLE_EQ(far.at(0, {4.0, 5.0, 0.0}), 0.2);
  EXPECT_GT(near.at(0, {1.0, 1.0, 0.0}), 0.0);
  EXPECT_LT(far.at(0, {1.0, 1.0, 0.0}), std::numeric_limits<double>::infinity());
  EXPECT_EQ(SizeField(mesh, {}).at(0, {4.0, 5.0, 0.0}), 1.0);
}

TEST(PlaceAims, EachIsWrittenAndMadeByItsRow) {
  const auto mesh = input(lattice(3, 0.0, 1));
  for (const PlaceAimInfo& row : place_aims()) {
    const std::string text = fmt::format("mean-ratio:0.5:{}", row.name);
    const auto [first, terms] = parse_composite(text, row.sized ? "h1:1,2" : "");
    EXPECT_EQ(to_text(first, terms), text);
    EXPECT_EQ(terms.size_text(), row.sized ? "h1:1,2" : "");
    ASSERT_NE(terms.size(), nullptr);
    EXPECT_EQ(row.make(mesh, *terms.size())->name(), row.name);
  }
  EXPECT_EQ(find_place_aim("mean-ratio"), nullptr);
}

TEST(SizeCorrelation, IsPearsons) {
  Mesh mesh;  // hubs of hexagons of radius 1, 2, 3
  const double sizes[] = {1.0, 2.0, 4.0};
  Field field;
  field.name = "depth";
  for (int star = 0; star < 3; ++star) {
    const auto hub = static_cast<Index>(mesh.positions.size());
    mesh.positions.push_back({10.0 * star, 0.0, 0.0});
    for (int k = 0; k < 6; ++k)
      mesh.positions.push_back({10.0 * star + (star + 1) * std::cos(k * M_PI / 3), (star + 1) * std::sin(k * M_PI / 3), 0.0});
    for (Index k = 0; k < 6; ++k) testing::add(mesh, {hub, hub + 1 + k, hub + 1 + (k + 1) % 6});
    for (int k = 0; k < 7; ++k) field.values.push_back(sizes[star]);
  }
  mesh.fields.push_back(field);
  const auto three = input(std::move(mesh));
  const std::vector<Index> hubs{0, 7, 14};
  const SizeCorrelation found = size_correlation(depth_of(three), *three, three->mesh.positions, hubs);
  EXPECT_NEAR(found.sizes, 3.0 / std::sqrt(2.0 * 14.0 / 3.0), 1e-12);  // deviations -1 0 1 and -4/3 -1/3 5/3
  const double a[] = {0.0, std::log(2.0), std::log(3.0)}, mean = (a[1] + a[2]) / 3;
  const double aa = mean * mean + (a[1] - mean) * (a[1] - mean) + (a[2] - mean) * (a[2] - mean);
  EXPECT_NEAR(found.logarithms, (a[2] - a[0]) / std::sqrt(2.0 * aa), 1e-12);  // the sizes' logarithms deviate by -1 0 1 times log 2
  const SizeCorrelation none = size_correlation(SizeField(three, {}), *three, three->mesh.positions, hubs);
  EXPECT_TRUE(std::isnan(none.sizes) && std::isnan(none.logarithms));
}

}  // namespace
}  // namespace dmoscope
