// VTP: every encoding gives the same surface and is kept, and errors are reported with their places. The samples were made by Python's
// struct, base64 and zlib (tests/fuzz/vtp_samples.py).

#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string vtp_sample(std::string_view name) {
  for (const auto& [own, bytes] : testing::vtp_samples())
    if (own == name) return std::string(bytes);
  throw std::logic_error("no such sample");
}

std::string with_other(std::string text, std::string_view from, std::string_view to) {
  return text.replace(text.find(from), from.size(), to);
}

class Vtp : public ::testing::Test {
 protected:
  void SetUp() override {
    if (format_by_extension(".vtp") == nullptr) GTEST_SKIP() << "this build lacks zlib or pugixml";
  }
};

TEST_F(Vtp, EveryEncodingGivesTheSameSurface) {
  for (const auto& [name, bytes] : testing::vtp_samples()) {
    SCOPED_TRACE(name);
    const Mesh mesh = read_bytes("a.vtp", bytes);
    EXPECT_EQ(mesh.source->format(), "vtp");
    ASSERT_EQ(mesh.positions.size(), 5U);
    EXPECT_EQ(mesh.positions[4], (Vec3{2, 0.5, 0}));
    ASSERT_EQ(mesh.elements.size(), 2U);
    EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(corners(mesh, 1), ElementsAre(1, 4, 2));
    ASSERT_EQ(mesh.fields.size(), 2U);
    EXPECT_THAT(mesh.fields[0].values, ElementsAre(0, 0.5, 1, 1.5, 2));
    EXPECT_THAT(mesh.fields[1].values, ElementsAre(9, 2147483647)) << "the rows of points and lines come first";
    ASSERT_EQ(mesh.groups.size(), 2U);
    EXPECT_THAT(mesh.groups[0].members, ElementsAre(4));
    EXPECT_THAT(mesh.groups[1].members, ElementsAre(0, 1, 1, 2));
    EXPECT_EQ(written("b.vtp", mesh), bytes);
    std::vector<Vec3> moved = mesh.positions;
    moved[4] = {2.5, 0.25, 0};
    const Mesh again = read_bytes("b.vtp", written("b.vtp", mesh, moved));
    EXPECT_EQ(again.positions[4], moved[4]);
    EXPECT_EQ(again.positions[3], mesh.positions[3]);
    EXPECT_EQ(again.fields[1].values, mesh.fields[1].values);
  }
}

TEST_F(Vtp, IsKnownByItsContent) {
  EXPECT_EQ(read_bytes("a.vtu", vtp_sample("ascii")).source->format(), "vtp");
  EXPECT_EQ(read_bytes("a.xml", vtp_sample("raw")).elements.size(), 2U);
}

TEST_F(Vtp, WhatIsWrongIsRefusedWhereItStands) {
  const std::string good = vtp_sample("ascii");
  expect_refused("a.vtp", with_other(good, "NumberOfStrips=\"0\"", "NumberOfStrips=\"1\""), 4, "triangle strips are not read");
  expect_refused("a.vtp", with_other(good, "NumberOfPolys=\"2\"", "NumberOfPolys=\"3\""), 48, "");
  expect_refused("a.vtp", with_other(good, "type=\"PolyData\"", "type=\"PPolyData\""), 2, "PVTP");
  expect_refused("a.vtp", with_other(good, "0 1 2 3 1 4 2", "0 1 2 3 1 9 2"), 45, "names point 9");
  expect_refused("a.vtp", with_other(good, "\n4 7\n", "\n2 7\n"), 45, "a polygon of 2 corners");
  EXPECT_THROW((void)written("a.vtp", read_bytes("a.vtk", testing::vtk_volume())), OutputError);
  expect_truncation_safe("a.vtp", good);
}

/// Files read by VTK, if Python has it.
TEST_F(Vtp, VtkReadsWhatIsMadeAnew) {
  const Mesh mesh = read_bytes("a.vtk", testing::vtk_poly_ascii());
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.vtp", script = folder.path() / "read.py", told = folder.path() / "told";
  put(path, written("a.vtp", mesh));
  put(script,
      "import sys\ntry:\n  from vtkmodules.vtkIOXML import vtkXMLPolyDataReader\nexcept ImportError:\n  sys.exit(0)\n"
      "r = vtkXMLPolyDataReader()\nr.SetFileName(sys.argv[1])\nr.Update()\nd = r.GetOutput()\n"
      "with open(sys.argv[2], 'w') as f:\n"
      "  for i in range(d.GetNumberOfPoints()): print(*d.GetPoint(i), file=f)\n"
      "  for c in range(d.GetNumberOfCells()):\n    p = d.GetCell(c).GetPointIds()\n    print(*(p.GetId(i) for i in "
      "range(p.GetNumberOfIds())), file=f)\n");
  const std::string command = "/usr/bin/env python3 '" + script.string() + "' '" + path.string() + "' '" + told.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  if (!std::filesystem::exists(told)) GTEST_SKIP() << "python3-vtk9 is not here";
  std::ifstream file(told);
  for (const Vec3& p : mesh.positions) {
    Vec3 read{};
    file >> read.x >> read.y >> read.z;
    EXPECT_EQ(read, p);
  }
  for (Index e = 0; e < mesh.elements.size(); ++e)
    for (const Index corner : mesh.elements.corners(e)) {
      Index read = kNoIndex;
      file >> read;
      EXPECT_EQ(read, corner);
    }
  std::string more;
  EXPECT_FALSE(file >> more) << more;
}

}  // namespace
}  // namespace dmoscope::test
