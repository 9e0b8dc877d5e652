// Files of elements with repeated corners: read as the simpler elements, written with the file's corners.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/input/input_mesh.h"
#include "core/io/mesh_io.h"
#include "core/quality/quality.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Three quadrilaterals and two with a corner twice; cell data number them.
std::string squares_and_triangles() {
  return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 9 double\n"
         "0 0 0\n1 0 0\n2 0 0\n0 1 0\n1.2 1.1 0\n2 1 0\n0 2 0\n1 2 0\n2 2 0\n"
         "CELLS 5 25\n4 0 1 4 3\n4 1 2 5 4\n4 3 4 7 6\n4 4 5 8 8\n4 4 8 7 7\nCELL_TYPES 5\n9\n9\n9\n9\n9\n"
         "CELL_DATA 5\nSCALARS id int 1\nLOOKUP_TABLE default\n10\n11\n12\n13\n14\n";
}

/// A wedge by eight nodes on a side of a cube.
std::string cube_and_wedge() {
  return "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 10 double\n"
         "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0.5 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n2 0.5 1\n"
         "CELLS 2 18\n8 0 1 2 3 5 6 7 8\n8 1 4 4 2 6 9 9 7\nCELL_TYPES 2\n12\n12\n";
}

std::string by(std::string text, std::string_view what, std::string_view with) { return text.replace(text.find(what), what.size(), with); }

TEST(CollapsedInFiles, AreJudgedAsWhatTheyAre) {
  struct Case {
    std::string collapsed, plain;
  };
  // VTK's wedge looks the other way than its hexahedron.
  const std::vector<Case> cases{
      {squares_and_triangles(),
       by(by(by(by(squares_and_triangles(), "4 4 5 8 8", "3 4 5 8"), "4 4 8 7 7", "3 4 8 7"), "9\n9\nCELL_D", "5\n5\nCELL_D"), "CELLS 5 25",
          "CELLS 5 23")},
      {cube_and_wedge(),
       by(by(by(cube_and_wedge(), "8 1 4 4 2 6 9 9 7", "6 1 2 4 6 7 9"), "12\n12\n", "12\n13\n"), "CELLS 2 18", "CELLS 2 16")}};
  for (const Case& one : cases) {
    Progress progress;
    const auto collapsed = prepare_input(read_bytes("a.vtk", one.collapsed), {}, Need::Smoothing, progress);
    const auto plain = prepare_input(read_bytes("a.vtk", one.plain), {}, Need::Smoothing, progress);
    EXPECT_THAT(collapsed->report.degenerate_elements, IsEmpty());
    EXPECT_THAT(collapsed->report.inverted_elements, IsEmpty());
    EXPECT_THAT(collapsed->report.sentences(), Contains(HasSubstr("corners twice")));
    ASSERT_EQ(collapsed->mesh.elements.size(), plain->mesh.elements.size());
    for (Index e = 0; e < plain->mesh.elements.size(); ++e) {
      EXPECT_EQ(collapsed->mesh.elements.kind(e), plain->mesh.elements.kind(e));
      for (const Metric metric : {Metric::MeanRatio, Metric::ScaledJacobian}) {
        EXPECT_NEAR(element_quality(collapsed->quality_context(), collapsed->mesh.positions, metric, e),
                    element_quality(plain->quality_context(), plain->mesh.positions, metric, e), 1e-15);
      }
    }
  }
}

TEST(CollapsedInFiles, AreWrittenAsTheyCame) {
  for (const std::string& bytes : {squares_and_triangles(), cube_and_wedge()}) {
    Mesh mesh = read_bytes("a.vtk", bytes);
    EXPECT_EQ(written("b.vtk", mesh, mesh.positions), bytes);
    std::vector<Vec3> moved = mesh.positions;
    moved[4].x += 0.25;
    const std::string again = written("b.vtk", mesh, moved);
    EXPECT_EQ(again.substr(again.find("CELLS")), bytes.substr(bytes.find("CELLS")));
    EXPECT_NE(again, bytes);
  }
}

TEST(CollapsedInFiles, GoIntoOtherFormatsAsWhatTheyAreAndThatIsSaid) {
  const Mesh mesh = read_bytes("a.vtk", squares_and_triangles());
  std::vector<std::string> notes;
  const std::string off = written("b.off", mesh, mesh.positions, &notes);
  EXPECT_THAT(notes, Contains(HasSubstr("the repeated corners of 2 quadrilaterals (written as triangles)")));
  const Mesh again = read_bytes("b.off", off);
  ASSERT_EQ(again.elements.size(), 5U);
  EXPECT_EQ(again.elements.kind(2), ElementKind::Quadrilateral);
  EXPECT_THAT(again.elements.corners(3), ElementsAre(4, 5, 8));
  EXPECT_THAT(again.elements.corners(4), ElementsAre(4, 8, 7));
}

}  // namespace
}  // namespace dmoscope::test
