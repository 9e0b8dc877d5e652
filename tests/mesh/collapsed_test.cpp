// Elements with repeated corners, against volumes by a separate formula and the patterns that other programs write.

#include "core/mesh/collapsed.h"

#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mesh/faces.h"
#include "core/mesh/orientation.h"

namespace dmoscope {
namespace {

using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

using Corners = std::vector<Index>;

struct Left {
  std::optional<ElementKind> kind;
  Corners corners;
};

Left left_of(ElementKind kind, const Corners& corners) {
  const auto simpler = simpler_element(kind, corner_pattern(std::span(corners)));
  if (!simpler) return {};
  Left left{simpler->kind, {}};
  for (Index i = 0; i < info(simpler->kind).corners; ++i) left.corners.push_back(corners[simpler->corners[i]]);
  return left;
}

void expect(ElementKind kind, const Corners& corners, ElementKind wanted, const Corners& wanted_corners) {
  SCOPED_TRACE(::testing::PrintToString(corners));
  const Left left = left_of(kind, corners);
  ASSERT_TRUE(left.kind.has_value());
  EXPECT_EQ(*left.kind, wanted);
  EXPECT_THAT(left.corners, ElementsAreArray(wanted_corners));
}

/// Six times the volume inside the faces, each taken as the mean of its two triangulations (Gauss).
double enclosed(ElementKind kind, const Corners& corners, const std::vector<Vec3>& points) {
  const auto cone = [&](Index a, Index b, Index c) { return dot(points[corners[a]], cross(points[corners[b]], points[corners[c]])); };
  double sum = 0.0;
  for (const LocalFace& face : faces_of(kind)) {
    const auto& c = face.corners;
    sum += face.count == 3 ? cone(c[0], c[1], c[2])
                           : 0.5 * (cone(c[0], c[1], c[2]) + cone(c[0], c[2], c[3]) + cone(c[0], c[1], c[3]) + cone(c[1], c[2], c[3]));
  }
  return sum;
}

TEST(Collapsed, PatternsThatProgramsWrite) {
  using enum ElementKind;
  // ANSYS, Nemoh, FVCOM: triangles by quadrilaterals, with any corner repeated.
  expect(Quadrilateral, {7, 8, 9, 9}, Triangle, {7, 8, 9});
  expect(Quadrilateral, {7, 8, 8, 9}, Triangle, {7, 8, 9});
  expect(Quadrilateral, {7, 7, 8, 9}, Triangle, {7, 8, 9});
  expect(Quadrilateral, {7, 8, 9, 7}, Triangle, {7, 8, 9});
  // The manual of ANSYS, SOLID185: prism, pyramid and tetrahedron by eight nodes.
  expect(Hexahedron, {10, 11, 12, 12, 14, 15, 16, 16}, Wedge, {10, 11, 12, 14, 15, 16});
  expect(Hexahedron, {10, 11, 12, 13, 14, 14, 14, 14}, Pyramid, {10, 11, 12, 13, 14});
  expect(Hexahedron, {10, 11, 12, 12, 14, 14, 14, 14}, Tetrahedron, {10, 11, 12, 14});
  expect(Wedge, {10, 11, 12, 13, 13, 13}, Tetrahedron, {10, 11, 12, 13});
  expect(Pyramid, {10, 11, 12, 12, 14}, Tetrahedron, {10, 11, 12, 14});
}

TEST(Collapsed, WhatMakesNoKindStays) {
  using enum ElementKind;
  EXPECT_FALSE(left_of(Triangle, {1, 2, 2}).kind);
  EXPECT_FALSE(left_of(Quadrilateral, {1, 2, 1, 3}).kind) << "opposite corners";
  EXPECT_FALSE(left_of(Quadrilateral, {1, 1, 1, 1}).kind);
  EXPECT_FALSE(left_of(Quadrilateral, {1, 1, 2, 2}).kind);
  EXPECT_FALSE(left_of(Hexahedron, {0, 1, 2, 2, 4, 5, 6, 7}).kind) << "seven corners";
  EXPECT_FALSE(left_of(Hexahedron, {0, 1, 2, 3, 0, 1, 2, 3}).kind) << "flat";
  EXPECT_FALSE(left_of(Hexahedron, {0, 1, 2, 3, 4, 5, 0, 7}).kind) << "ends of a diagonal";
  EXPECT_FALSE(left_of(Wedge, {0, 1, 1, 3, 4, 5}).kind);
  EXPECT_FALSE(left_of(Pyramid, {0, 1, 2, 3, 0}).kind) << "its tip on its base";
  EXPECT_FALSE(left_of(Hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}).kind);
}

/// All ways in which edges may shrink to points: the rest encloses the same volume, the right way round.
TEST(Collapsed, EveryPatternKeepsItsVolume) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  std::array<std::array<int, kElementKindCount>, kElementKindCount> found{};
  for (const ElementKind kind : {ElementKind::Hexahedron, ElementKind::Wedge, ElementKind::Pyramid}) {
    std::vector<std::array<Index, 2>> edges;
    for (const LocalFace& face : faces_of(kind))
      for (Index i = 0; i < face.count; ++i)
        if (const Index a = face.corners[i], b = face.corners[(i + 1) % face.count]; a < b) edges.push_back({a, b});
    for (std::uint32_t shrunk = 1; shrunk < (1U << edges.size()); ++shrunk) {
      Corners corners(info(kind).corners);
      for (Index i = 0; i < corners.size(); ++i) corners[i] = i;
      for (std::size_t e = 0; e < edges.size(); ++e) {
        if ((shrunk >> e & 1U) == 0) continue;
        const Index keeps = std::min(corners[edges[e][0]], corners[edges[e][1]]),
                    goes = std::max(corners[edges[e][0]], corners[edges[e][1]]);
        std::ranges::replace(corners, goes, keeps);
      }
      const Left left = left_of(kind, corners);
      if (!left.kind) continue;
      ++found[static_cast<std::size_t>(kind)][static_cast<std::size_t>(*left.kind)];
      std::vector<Vec3> points(corners.size());
      for (Vec3& p : points) p = {place(random), place(random), place(random)};
      ASSERT_NEAR(enclosed(*left.kind, left.corners, points), enclosed(kind, corners, points), 1e-12) << ::testing::PrintToString(corners);
    }
  }
  for (const ElementKind to : {ElementKind::Tetrahedron, ElementKind::Pyramid, ElementKind::Wedge})
    EXPECT_GT(found[static_cast<std::size_t>(ElementKind::Hexahedron)][static_cast<std::size_t>(to)], 0);
  for (const ElementKind to : {ElementKind::Tetrahedron, ElementKind::Pyramid})
    EXPECT_GT(found[static_cast<std::size_t>(ElementKind::Wedge)][static_cast<std::size_t>(to)], 0);
}

TEST(Collapsed, AMeshKeepsTheNumbersOfItsElements) {
  Mesh mesh;
  mesh.positions.resize(9);
  const auto add = [&](const std::array<Index, 4>& corners) { mesh.elements.add(ElementKind::Quadrilateral, corners); };
  add({0, 1, 4, 3});
  add({4, 5, 8, 8});
  add({4, 5, 4, 8});
  add({4, 8, 7, 7});
  const CollapsedKinds collapsed = take_simpler_kinds(mesh);
  ASSERT_EQ(mesh.elements.size(), 4U);
  EXPECT_THAT(mesh.elements.corners(1), ElementsAre(4, 5, 8));
  EXPECT_THAT(mesh.elements.corners(2), ElementsAre(4, 5, 4, 8));
  EXPECT_THAT(mesh.elements.corners(3), ElementsAre(4, 8, 7));
  EXPECT_THAT(collapsed.sentences(), ElementsAre("2 quadrilaterals that have corners twice are taken as the triangles that they are"));
  EXPECT_FALSE(take_simpler_kinds(mesh).any());
}

}  // namespace
}  // namespace dmoscope
