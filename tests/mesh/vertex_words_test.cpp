// Words that name vertices: their meaning, and their refusals.

#include "core/mesh/vertex_words.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/mesh/group_facts.h"
#include "tests/support/meshes.h"

namespace dmoscope {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// 2 x 2 squares on the unit square with groups and data of all kinds.
Mesh labelled() {
  Mesh mesh = testing::lattice(2, 0.0, 1, testing::Cells::Quadrilaterals);
  mesh.groups = {{.name = "steel", .role = "physical group", .code = 1, .dimension = 2, .members = {3}},
                 {.name = "wall", .role = "physical group", .code = 2, .dimension = 1, .members = {0, 1, 1, 2}},
                 {.name = "reference 5", .role = "reference", .code = 5, .dimension = 1, .members = {6, 7}},
                 {.name = "reference 5", .role = "reference", .code = 5, .dimension = 2, .members = {0}},
                 {.name = "open boundary 1", .role = "open boundary", .code = 20, .dimension = 0, .members = {0, 3, 6}},
                 {.name = "4", .role = "marker", .code = 0, .dimension = 1, .members = {4, 5}}};
  const auto field = [&](std::string name, Field::On on, std::vector<double> values, int components = 1) {
    mesh.fields.push_back(
        {.name = std::move(name), .on = on, .components = components, .type = "double", .role = "", .values = std::move(values)});
  };
  field("mat_id", Field::On::Elements, {1, 1, 2, 3});
  field("depth", Field::On::Vertices, {0, 0.5, 0.5, 7, 7, 7, 8, 8, 8});
  field("both", Field::On::Elements, {0, 0, 0, 1});
  field("both", Field::On::Vertices, {1, 0, 0, 0, 0, 0, 0, 0, 0});
  field("flow", Field::On::Elements, {0, 0, 0, 0, 0, 0, 0, 0}, 2);
  return mesh;
}

std::vector<Index> named(const std::string& word) { return vertices_named(labelled(), word); }

std::string refusal(const std::string& word) {
  try {
    (void)named(word);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "(not refused)";
}

TEST(VertexWords, Numbers) {
  EXPECT_THAT(named("3,7-8"), ElementsAre(3, 7, 8));
  EXPECT_THAT(named("vertices:4"), ElementsAre(4));
  EXPECT_THAT(named("vertices:8,0-1,1"), ElementsAre(0, 1, 8));
  EXPECT_THAT(refusal("9"), HasSubstr("there is no vertex 9 (the mesh has 9, counted from 0)"));
  EXPECT_THAT(refusal("3,99999999999999999999"), HasSubstr("no list of vertices"));
  EXPECT_THAT(refusal("7-3"), HasSubstr("the range 7-3 runs backwards"));
  EXPECT_THAT(refusal("vertices:1,x"), HasSubstr("no list of vertices like 3,7-9"));
  EXPECT_THAT(refusal("vertices:"), HasSubstr("no list of vertices"));
}

TEST(VertexWords, Groups) {
  EXPECT_THAT(named("steel"), ElementsAre(4, 5, 7, 8));
  EXPECT_THAT(named("group:wall"), ElementsAre(0, 1, 2));
  EXPECT_THAT(named("group:2"), ElementsAre(0, 1, 2)) << "by the number that the file gives it";
  EXPECT_THAT(named("open boundary 1"), ElementsAre(0, 3, 6));
  EXPECT_THAT(named("lines:reference 5"), ElementsAre(6, 7));
  EXPECT_THAT(named("elements:reference 5"), ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(named("group:4"), ElementsAre(4, 5));
  EXPECT_THAT(refusal("group:stel"), HasSubstr("group:stel: no such group; the mesh's groups: steel, wall, reference 5"));
  EXPECT_THAT(refusal("points:wall"), HasSubstr("the mesh's groups of points: open boundary 1"));
  EXPECT_THAT(refusal("faces:wall"), HasSubstr("the mesh has no groups of faces"));
  EXPECT_THAT(refusal("stel"), AllOf(HasSubstr("stel: neither a list"), HasSubstr("steel, wall"), HasSubstr("mat_id")));
}

TEST(VertexWords, WhatCanMeanTwoThingsIsRefusedWithTheChoices) {
  EXPECT_THAT(refusal("1"), HasSubstr("more than one thing; write 'group:steel' or 'vertices:1'"));
  EXPECT_THAT(refusal("4"), HasSubstr("write 'group:4' or 'vertices:4'")) << "by its name";
  EXPECT_THAT(refusal("reference 5"), HasSubstr("write 'lines:reference 5' or 'elements:reference 5'"));
  EXPECT_THAT(refusal("group:5"), HasSubstr("write 'lines:reference 5' or 'elements:reference 5'"));
  EXPECT_THAT(refusal("both=1"), HasSubstr("write 'point-data:both=1' or 'cell-data:both=1'"));
}

TEST(VertexWords, Data) {
  EXPECT_THAT(named("mat_id=2"), ElementsAre(3, 4, 6, 7));
  EXPECT_THAT(named("mat_id=2,3"), ElementsAre(3, 4, 5, 6, 7, 8));
  EXPECT_THAT(named("depth=0.5"), ElementsAre(1, 2));
  EXPECT_THAT(named("data:depth=0.5,8"), ElementsAre(1, 2, 6, 7, 8));
  EXPECT_THAT(named("cell-data:both=1"), ElementsAre(4, 5, 7, 8));
  EXPECT_THAT(named("point-data:both=1"), ElementsAre(0));
  EXPECT_THAT(refusal("mat_id=4"), HasSubstr("mat_id is nowhere 4; it is 1, 2, 3"));
  EXPECT_THAT(refusal("mat_id=x"), HasSubstr("'x' is no number"));
  EXPECT_THAT(refusal("mat_id="), HasSubstr("'' is no number"));
  EXPECT_THAT(refusal("data:mat=1"), HasSubstr("no such data; the file's are mat_id, depth, both"));
  EXPECT_THAT(refusal("data:mat_id"), HasSubstr("data are named as in"));
  EXPECT_THAT(refusal("flow=0"), HasSubstr("flow has 2 numbers for each"));
}

TEST(VertexWords, Boxes) {
  EXPECT_THAT(named("box:0,0,0.5,0.5"), ElementsAre(0, 1, 3, 4)) << "its sides belong to it";
  EXPECT_THAT(named("box:0.4,-inf,0.6,inf"), ElementsAre(1, 4, 7));
  EXPECT_THAT(named("box:0,0,0,1,0,0"), ElementsAre(0, 1, 2));
  EXPECT_THAT(refusal("box:0,0,1,2,1,3"), HasSubstr("no vertex lies in this box"));
  EXPECT_THAT(refusal("box:0,0,1"), HasSubstr("a box is box:X0,Y0,X1,Y1"));
  EXPECT_THAT(refusal("box:1,0,0,1"), HasSubstr("the box ends at 0 before it begins at 1"));
  EXPECT_THAT(refusal("box:0,0,1,one"), HasSubstr("'one' is no number"));
}

TEST(VertexWords, SeveralTogether) {
  const std::vector<std::string> words{"8", "wall", "vertices:1"};
  EXPECT_THAT(vertices_named(labelled(), words), ElementsAre(0, 1, 2, 8));
}

TEST(GroupFacts, TellWhatIsThere) {
  const auto facts = facts_of_groups(labelled());
  ASSERT_EQ(facts.size(), 6U);
  EXPECT_EQ(facts[0].of, "elements");
  EXPECT_EQ(facts[0].dimension, 2);
  EXPECT_EQ(facts[0].number, 1);
  EXPECT_EQ(facts[0].members, 1U);
  EXPECT_EQ(facts[0].vertices, 4U);
  EXPECT_EQ(facts[1].of, "lines");
  EXPECT_EQ(facts[1].members, 2U);
  EXPECT_EQ(facts[1].vertices, 3U);
  EXPECT_EQ(facts[4].of, "points");
  EXPECT_EQ(facts[4].number, std::nullopt);
  EXPECT_EQ(facts[4].type, 20);
  EXPECT_EQ(facts[5].number, std::nullopt);
}

}  // namespace
}  // namespace dmoscope
