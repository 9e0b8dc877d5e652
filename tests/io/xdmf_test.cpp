#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string grid(const std::string& inside) { return "<Xdmf><Domain><Grid>\n" + inside + "</Grid></Domain></Xdmf>\n"; }
const std::string kGeometry = "<Geometry GeometryType=\"XYZ\"><DataItem>0 0 0 1 0 0 0 1 0</DataItem></Geometry>\n";
const std::string kTriangle = "<Topology TopologyType=\"Triangle\"><DataItem>0 1 2</DataItem></Topology>\n";

TEST(Xdmf, MixedWithAttributesAndSets) {
  const Mesh mesh = read_bytes("a.xdmf", testing::xdmf_mixed());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "two & more");
  ASSERT_EQ(mesh.positions.size(), 9U);
  EXPECT_EQ(mesh.positions[6], (Vec3{1, 1, 1.5}));
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8));
  ASSERT_EQ(mesh.fields.size(), 2U);
  EXPECT_EQ(mesh.fields[0].name, "depth");
  EXPECT_TRUE(std::isnan(mesh.fields[0].values[7]));
  EXPECT_EQ(mesh.fields[1].components, 2);
  EXPECT_THAT(mesh.fields[1].values, ElementsAre(1, 2, 7, 8));  // values of the two volume elements among four cells
  ASSERT_EQ(mesh.groups.size(), 2U);
  EXPECT_EQ(mesh.groups[0].name, "top");
  EXPECT_THAT(mesh.groups[0].members, ElementsAre(8, 7));
  EXPECT_THAT(mesh.groups[1].members, ElementsAre(1));
  EXPECT_THAT(mesh.source->only_in_file(), ::testing::Contains("2 cells of fewer dimensions"));
}

TEST(Xdmf, PlanarInACollectionOfOne) {
  const Mesh mesh = read_bytes("a.xmf", testing::xdmf_planar());
  EXPECT_EQ(mesh.source->layout().components, 2);
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()), ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
}

TEST(Xdmf, WrittenAgainOnlyWhatMovedChanges) {
  for (const std::string& bytes : {testing::xdmf_mixed(), testing::xdmf_planar()}) {
    const Mesh mesh = read_bytes("a.xdmf", bytes);
    EXPECT_EQ(written("a.xdmf", mesh), bytes);
    const std::vector<Vec3> positions = moved(mesh, 3, mesh.source->layout().components == 3, 5);
    const std::string patched = written("a.xdmf", mesh, positions);
    expect_same_positions(positions, read_bytes("a.xdmf", patched).positions);
    const std::size_t end = bytes.find("</DataItem></Geometry>");
    EXPECT_TRUE(patched.ends_with(bytes.substr(end)));
  }
}

TEST(Xdmf, MadeAnewItHoldsTheSame) {
  for (const std::string& bytes : {testing::xdmf_mixed(), testing::xdmf_planar()}) {
    Mesh mesh = read_bytes("a.xdmf", bytes);
    mesh.source.reset();
    mesh.positions = moved(mesh, 2, true, 3);
    std::vector<std::string> notes;
    const Mesh again = read_bytes("b.xdmf", written("b.xdmf", mesh, mesh.positions, &notes));
    EXPECT_THAT(notes, ElementsAre());
    expect_same_positions(mesh.positions, again.positions);
    expect_same_elements(mesh, again);
    ASSERT_EQ(again.fields.size(), mesh.fields.size());
    for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
      EXPECT_EQ(again.fields[i].name, mesh.fields[i].name);
      EXPECT_EQ(again.fields[i].components, mesh.fields[i].components);
      EXPECT_EQ(again.fields[i].values.front(), mesh.fields[i].values.front());
    }
    ASSERT_EQ(again.groups.size(), mesh.groups.size());
    for (std::size_t i = 0; i < mesh.groups.size(); ++i) EXPECT_EQ(again.groups[i].members, mesh.groups[i].members);
  }
}

TEST(Xdmf, Refused) {
  struct Bad {
    std::string text;
    std::size_t line;
    std::string words;
  };
  const std::array<Bad, 14> table{{
      {"<Xdmf><Domain></Xdmf>", 1, "not well-formed XML"},
      {"<Xdmf>\n</Xdmf>", 1, "no Domain"},
      {"<Xdmf><Domain>\n<Grid/><Grid/></Domain></Xdmf>", 1, "2 grids"},
      {grid(kGeometry), 1, "no Topology"},
      {grid(kGeometry + "<Topology TopologyType=\"Tri_6\"><DataItem>0 1 2 0 1 2</DataItem></Topology>"), 3, "of higher order"},
      {grid(kGeometry + "<Topology TopologyType=\"2DSMesh\"><DataItem>0</DataItem></Topology>"), 3,
       "is not read: save the mesh as unstructured"},
      {grid(kGeometry + "<Topology TopologyType=\"Triangle\"><DataItem>0 1 3</DataItem></Topology>"), 3, "point 3 out of range"},
      {grid(kGeometry + "<Topology TopologyType=\"Triangle\"><DataItem>0 1</DataItem></Topology>"), 3, "2 numbers are no elements"},
      {grid(kGeometry + "<Topology TopologyType=\"Mixed\"><DataItem>36 0 1 2 0 1 2</DataItem></Topology>"), 3,
       "type 36 is of higher order"},
      {grid(kGeometry + "<Topology TopologyType=\"Mixed\"><DataItem>4 0 1</DataItem></Topology>"), 3, "cut off"},
      {grid("<Geometry GeometryType=\"XYZ\"><DataItem Format=\"HDF\">a.h5</DataItem></Geometry>" + kTriangle), 2,
       "is no place in an HDF5 file"},
      {grid("<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"4 3\">0 0 0</DataItem></Geometry>" + kTriangle), 2, "3 numbers, but"},
      {grid("<Geometry GeometryType=\"XYZ\"><DataItem>0 0 x</DataItem></Geometry>" + kTriangle), 2, "expected a number, got \"x\""},
      {grid(kGeometry + kTriangle + "<Attribute Name=\"a\"><DataItem>1 2</DataItem></Attribute>"), 4, "2 numbers for 3 points"},
  }};
  for (const auto& bad : table) expect_refused("a.xdmf", bad.text, bad.line, bad.words);
}

}  // namespace
}  // namespace dmoscope::test
