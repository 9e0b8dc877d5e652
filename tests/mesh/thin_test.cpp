// The front of a mesh one cell thick: its side, its winding, and its groups.

#include "core/mesh/thin.h"

#include <algorithm>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/mesh/orientation.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Layers of cells upon the sheet, `step` apart; vertex v of the sheet is v in the lowest layer, v + n in the next.
Mesh stacked(const Mesh& sheet, int layers, Vec3 step) {
  Mesh mesh;
  const Index n = sheet.vertex_count();
  for (int k = 0; k <= layers; ++k)
    for (const Vec3& p : sheet.positions) mesh.positions.push_back(p + static_cast<double>(k) * step);
  for (int k = 0; k < layers; ++k)
    for (Index e = 0; e < sheet.elements.size(); ++e) {
      std::vector<Index> corners;
      for (const int side : {k, k + 1})
        for (const Index v : sheet.elements.corners(e)) corners.push_back(v + static_cast<Index>(side) * n);
      mesh.elements.add(corners.size() == 8 ? ElementKind::Hexahedron : ElementKind::Wedge, corners);
    }
  return mesh;
}

std::string taken(Mesh& mesh) {
  Progress progress;
  return take_front(mesh, progress);
}

/// Expects each element of the front to have the corners of the sheet's, the same way round.
void expect_sheet(const Mesh& sheet, const Mesh& mesh) {
  ASSERT_EQ(mesh.elements.size(), sheet.elements.size());
  for (Index e = 0; e < sheet.elements.size(); ++e) {
    std::vector<Index> own(mesh.elements.corners(e).begin(), mesh.elements.corners(e).end());
    const auto wanted = sheet.elements.corners(e);
    ASSERT_EQ(own.size(), wanted.size());
    std::rotate(own.begin(), std::ranges::find(own, wanted[0]), own.end());
    EXPECT_TRUE(std::ranges::equal(own, wanted)) << e;
  }
}

TEST(Thin, TheFrontIsTheSheetWhicheverWayTheBackLies) {
  for (const double way : {0.05, -0.05}) {
    const Mesh sheet = testing::lattice(6, 0.2, 1, testing::Cells::Mixed);
    Mesh mesh = stacked(sheet, 1, {0.01, 0.02, way});
    const ElementTable cells = mesh.elements;
    if (way < 0.0)  // else they would be inside out
      for (Index e = 0; e < mesh.elements.size(); ++e) mesh.elements.flip(e);
    ASSERT_EQ(taken(mesh), "");
    expect_sheet(sheet, mesh);
    const Index n = sheet.vertex_count();
    for (Index v = 0; v < n; ++v) {
      EXPECT_EQ(mesh.thin->back[v], v + n);
      EXPECT_EQ(mesh.thin->front[v + n], v);
      EXPECT_EQ(mesh.thin->front[v], v);
      EXPECT_EQ(mesh.thin->back[v + n], kNoIndex);
    }
    EXPECT_EQ(on_front(mesh, n + 3), 3U);
    const Mesh whole = with_cells(mesh);
    EXPECT_EQ(whole.thin, nullptr);
    for (Index e = 0; e < whole.elements.size(); ++e) EXPECT_GT(signed_volume(whole, e), 0.0);
    const auto prepared = testing::input(std::move(mesh));
    EXPECT_EQ(prepared->geometry.shape, Shape::Planar);
    EXPECT_THAT(prepared->report.sentences(), ElementsAre()) << "those of the back are not missed, and nothing is wound the other way";
  }
}

TEST(Thin, CellsThatAreInsideOutAreTakenAsTheyAreMeant) {
  const Mesh sheet = testing::lattice(5, 0.2, 1, testing::Cells::Quadrilaterals);
  Mesh mesh = stacked(sheet, 1, {0, 0, 0.1});
  mesh.elements.flip(3);
  mesh.elements.flip(11);
  ASSERT_EQ(taken(mesh), "");
  expect_sheet(sheet, mesh);
  const Mesh whole = with_cells(mesh);
  EXPECT_EQ(std::ranges::count(whole.flipped, 1), 2);
}

TEST(Thin, AStripOfCellsInSeveralWaysIsNotTaken) {
  Mesh row = stacked(testing::lattice(1, 0.0, 1, testing::Cells::Quadrilaterals), 1, {0, 0, 1});
  EXPECT_THAT(taken(row), HasSubstr("cell 0 may stand in several ways"));
  EXPECT_EQ(row.thin, nullptr);
  EXPECT_EQ(row.elements.kind(0), ElementKind::Hexahedron);
}

TEST(Thin, WhatIsThickerOrNoPrismIsNotTaken) {
  const Mesh sheet = testing::lattice(5, 0.2, 1, testing::Cells::Mixed);
  for (const int layers : {2, 3}) {
    Mesh thick = stacked(sheet, layers, {0, 0, 0.1});
    EXPECT_THAT(taken(thick), HasSubstr("no two faces across from each other on the boundary"));
    EXPECT_EQ(thick.thin, nullptr);
  }
  Mesh flat = sheet;
  EXPECT_THAT(taken(flat), HasSubstr("not all of its cells"));
}

TEST(Thin, ABackOfAnotherShapeIsNotTaken) {
  const Mesh sheet = testing::lattice(5, 0.2, 1, testing::Cells::Quadrilaterals);
  Mesh mesh = stacked(sheet, 1, {0, 0, 0.1});
  mesh.positions[sheet.vertex_count() + 14].x += 0.08;
  EXPECT_THAT(taken(mesh), HasSubstr("has another shape than its front"));
}

/// Two sheets beside each other, one of them numbered from behind.
TEST(Thin, PartsHaveTheirFrontsOnTheSameSide) {
  const Mesh sheet = testing::lattice(4, 0.2, 1, testing::Cells::Quadrilaterals);
  Mesh mesh = stacked(sheet, 1, {0, 0, 0.1});
  const Index n = sheet.vertex_count(), first = 2 * n;
  const Mesh other = stacked(sheet, 1, {0, 0, -0.1});
  for (const Vec3 p : other.positions) mesh.positions.push_back({p.x + 2.0, p.y, p.z + 0.1});
  for (Index e = 0; e < other.elements.size(); ++e) {
    std::vector<Index> corners(other.elements.corners(e).begin(), other.elements.corners(e).end());
    for (Index& v : corners) v += first;
    mesh.elements.add(ElementKind::Hexahedron, corners);
  }
  ASSERT_EQ(taken(mesh), "");
  for (const Index v : mesh.elements.all_corners()) EXPECT_EQ(mesh.positions[v].z, 0.0);
}

TEST(Thin, GroupsAreThoseOfTheFront) {
  const Mesh sheet = testing::lattice(2, 0.0, 1, testing::Cells::Quadrilaterals);  // 3 x 3 vertices, 4 cells
  Mesh mesh = stacked(sheet, 1, {0, 0, 0.1});
  const auto faces = [](std::initializer_list<std::array<Index, 4>> all) {
    ElementTable table;
    for (const auto& one : all) table.add(ElementKind::Quadrilateral, one);
    return table;
  };
  mesh.groups.push_back({"inlet", "marker", 1, 2, {}, faces({{0, 3, 12, 9}, {3, 6, 15, 12}})});
  mesh.groups.push_back({"front", "marker", 2, 2, {}, faces({{0, 3, 4, 1}, {1, 4, 5, 2}, {3, 6, 7, 4}, {4, 7, 8, 5}})});
  mesh.groups.push_back({"lower back", "marker", 3, 2, {}, faces({{9, 10, 13, 12}, {10, 11, 14, 13}})});
  mesh.groups.push_back({"corner", "marker", 4, 2, {}, faces({{0, 1, 10, 9}, {0, 3, 4, 1}})});
  mesh.groups.push_back({"ridge", "lines", 5, 1, {1, 10, 9, 10, 0, 1}});
  mesh.groups.push_back({"points", "nodes", 6, 0, {13, 4, 8}});
  mesh.groups.push_back({"steel", "material", 7, 2, {2, 3}});
  mesh.periodic = {{0, 9}, {0, 2}, {9, 11}, {3, 5}};
  const std::vector<Group> before = mesh.groups;
  ASSERT_EQ(taken(mesh), "");
  ASSERT_EQ(mesh.groups.size(), 7U);
  EXPECT_EQ(mesh.groups[0].dimension, 1);
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(0, 3, 3, 6));
  EXPECT_TRUE(mesh.groups[1].of_elements());
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(0, 1, 2, 3));
  EXPECT_TRUE(mesh.groups[2].of_elements());
  EXPECT_THAT(mesh.groups[2].members, ElementsAre(0, 1));
  EXPECT_EQ(mesh.groups[3].dimension, 0);
  EXPECT_THAT(mesh.groups[3].members, ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(mesh.groups[4].members, ElementsAre(0, 1));
  EXPECT_THAT(mesh.groups[5].members, ElementsAre(4, 8));
  EXPECT_THAT(mesh.groups[6].members, ElementsAre(2, 3));
  EXPECT_THAT(mesh.periodic, ElementsAre(ElementsAre(0, 2), ElementsAre(3, 5)));
  const Mesh whole = with_cells(std::move(mesh));
  ASSERT_EQ(whole.groups.size(), before.size());
  for (std::size_t g = 0; g < before.size(); ++g) EXPECT_TRUE(std::ranges::equal(whole.groups[g].vertices(), before[g].vertices()));
  EXPECT_EQ(whole.periodic.size(), 4U);
}

TEST(Thin, WordsForTheChoice) {
  for (const char* word : {"off", "on", "auto"}) EXPECT_EQ(name(parse_thin(word)), word);
  EXPECT_THROW((void)parse_thin("yes"), UsageError);
}

}  // namespace
}  // namespace dmoscope
