// XDMF with numbers in an HDF5 file, made by h5py (tests/fuzz/array_samples.py).

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/orientation.h"
#include "tests/fuzz/array_samples.h"
#include "tests/io/files.h"
#include "tests/io/meshio.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string item(const std::string& dimensions, const std::string& place, const std::string& type = "Float\" Precision=\"8") {
  return "<DataItem Dimensions=\"" + dimensions + "\" NumberType=\"" + type + "\" Format=\"HDF\">\n  " + place + "\n</DataItem>";
}

const std::string kSolids = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain><Grid><Geometry GeometryType=\"XYZ\">" +
                            item("23 3", "numbers.h5:/points") + "</Geometry>\n<Topology TopologyType=\"Mixed\" NumberOfElements=\"2\">" +
                            item("16", "numbers.h5:/mesh/cells", "Int\" Precision=\"4") + "</Topology></Grid></Domain></Xdmf>\n";
const std::string kFlat = "<Xdmf Version=\"3.0\"><Domain><Grid><Geometry GeometryType=\"XY\">" + item("4 2", "numbers.h5:/flat") +
                          "</Geometry>\n<Topology TopologyType=\"Triangle\">" + item("2 3", "numbers.h5:/triangles") +
                          "</Topology><Attribute Name=\"depth\" Center=\"Node\">" + item("4", "numbers.h5:/depth") +
                          "</Attribute></Grid></Domain></Xdmf>\n";

/// An XML and its numbers in a folder.
class XdmfHdf5 : public ::testing::Test {
 protected:
  Mesh read(const std::string& xml) {
    put(folder_ / "a.xdmf", xml);
    put(folder_ / "numbers.h5", testing::xdmf_numbers());
    return read_mesh(folder_ / "a.xdmf", progress_);
  }
  void expect_error(const std::string& xml, std::string_view words) {
    try {
      (void)read(xml);
      ADD_FAILURE() << words;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(std::string(words)));
    }
  }
  TemporaryFolder folder_;
  Progress progress_;
};

TEST_F(XdmfHdf5, MixedSolids) {
  const Mesh mesh = read(kSolids);
  expect_consistent(mesh);
  ASSERT_EQ(mesh.elements.size(), 2U);
  EXPECT_THAT(signed_volume(mesh, 0), DoubleEq(0.5));
  EXPECT_THAT(signed_volume(mesh, 1), DoubleEq(1.0));
  EXPECT_EQ(mesh.positions[22], (Vec3{6.5, 0.5, 1}));
}

TEST_F(XdmfHdf5, PackedFloatsOfThePlane) {
  const Mesh mesh = read(kFlat);
  expect_consistent(mesh);
  EXPECT_TRUE(mesh.single_precision);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()), ElementsAre(0, 1, 2, 0, 2, 3));
  EXPECT_THAT(mesh.fields.at(0).values, ElementsAre(1, 2, 3, 4.5));
}

/// Checkpoints of FEniCS: no slash, and attributes of several items.
TEST_F(XdmfHdf5, PlacesWithoutASlashAndFiniteElementFunctions) {
  std::string xml = kFlat;
  xml.replace(xml.find("numbers.h5:/flat"), 16, "numbers.h5:flat");
  xml.insert(xml.find("</Attribute>"), item("4", "numbers.h5:depth"));
  const Mesh mesh = read(xml);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  EXPECT_TRUE(mesh.fields.empty());
  EXPECT_THAT(mesh.source->only_in_file(), Contains("further attributes"));
  (void)write_mesh(folder_ / "b.xdmf", mesh, mesh.positions, progress_);
  EXPECT_THAT(get(folder_ / "b.xdmf"), HasSubstr("b.h5:flat"));
}

TEST_F(XdmfHdf5, WrittenAgainUnderItsOwnNameBothFilesAreReplaced) {
  for (const std::string& xml : {kSolids, kFlat}) {
    const Mesh mesh = read(xml);
    std::vector<Vec3> positions = mesh.positions;
    for (Vec3& p : positions) p = {p.x * 0.5 + 0.25, 3.0 - p.y, p.z * 2.0};
    const auto notes = write_mesh(folder_ / "a.xdmf", mesh, positions, progress_);
    EXPECT_THAT(notes, ElementsAre(HasSubstr("numbers.h5, which was written, too")));
    EXPECT_EQ(get(folder_ / "a.xdmf"), xml);
    const Mesh again = read_mesh(folder_ / "a.xdmf", progress_);
    expect_same_positions(positions, again.positions);
    expect_same_elements(mesh, again);
  }
}

TEST_F(XdmfHdf5, WrittenUnderAnotherNameItHasNumbersOfItsOwn) {
  const Mesh mesh = read(kFlat);
  std::vector<Vec3> positions = mesh.positions;
  positions[2] = {0.75, 0.5, 0};
  (void)write_mesh(folder_ / "b.xdmf", mesh, positions, progress_);
  EXPECT_EQ(get(folder_ / "numbers.h5"), testing::xdmf_numbers()) << "what was read stays";
  EXPECT_THAT(get(folder_ / "b.xdmf"), HasSubstr("b.h5:/flat"));
  EXPECT_THAT(get(folder_ / "b.xdmf"), ::testing::Not(HasSubstr("numbers")));
  std::filesystem::remove(folder_ / "numbers.h5");
  const Mesh again = read_mesh(folder_ / "b.xdmf", progress_);
  expect_same_positions(positions, again.positions);
  EXPECT_EQ(again.fields.at(0).values, mesh.fields.at(0).values);
}

TEST_F(XdmfHdf5, WhereNumbersAreInSeveralPlacesItIsMadeAnew) {
  put(folder_ / "other.h5", testing::xdmf_numbers());
  std::string xml = kFlat;
  xml.replace(xml.find("numbers.h5:/depth"), 7, "other");
  const Mesh mesh = read(xml);
  const auto notes = write_mesh(folder_ / "a.xdmf", mesh, mesh.positions, progress_);
  EXPECT_THAT(notes, Contains(HasSubstr("its numbers are in several files")));
  std::filesystem::remove(folder_ / "other.h5");
  std::filesystem::remove(folder_ / "numbers.h5");
  EXPECT_THAT(read_mesh(folder_ / "a.xdmf", progress_).fields.at(0).values, ElementsAre(1, 2, 3, 4.5));
}

TEST_F(XdmfHdf5, Refused) {
  const auto with = [](std::string xml, const std::string& what, const std::string& by) {
    return xml.replace(xml.find(what), what.size(), by);
  };
  expect_error(with(kFlat, "numbers.h5:/flat", "absent.h5:/flat"), "absent.h5: No such file");
  expect_error(with(kFlat, "numbers.h5:/flat", "numbers.h5:/flut"), "has no array \"/flut\"");
  expect_error(with(kFlat, "numbers.h5:/triangles", "numbers.h5:/mesh"), "\"/mesh\"");
  expect_error(with(kFlat, "numbers.h5:/triangles", "numbers.h5:/points"), "does not hold whole numbers");
  expect_error(with(kFlat, "numbers.h5:/flat", "flat"), "is no place in an HDF5 file");
  expect_error(with(kFlat, "4 2", "4 3"), "8 numbers, but its Dimensions say 12");
  expect_error(with(kFlat, "Format=\"HDF\"", "Format=\"Binary\""), "in another file (\"Binary\")");
  put(folder_ / "text.h5", "none");
  expect_error(with(kFlat, "numbers.h5:/flat", "text.h5:/flat"), "text.h5: this is no HDF5 file");
}

TEST_F(XdmfHdf5, AnIndependentReaderFindsWhatWasWrittenAgain) {
  const Mesh mesh = read(kSolids);
  std::vector<Vec3> positions = mesh.positions;
  for (Vec3& p : positions) p = {2.0 * p.x, 2.0 * p.y, 2.0 * p.z};
  (void)write_mesh(folder_ / "b.xdmf", mesh, positions, progress_);
  const auto found = read_by_meshio({folder_ / "b.xdmf"});
  if (!found || (*found)[0].points == 0) GTEST_SKIP() << "python3-meshio or python3-h5py is not here";
  EXPECT_NEAR((*found)[0].sizes.at("wedge"), 8 * 0.5, 1e-12);
  EXPECT_NEAR((*found)[0].sizes.at("hexahedron"), 8 * 1.0, 1e-12);
}

}  // namespace
}  // namespace dmoscope::test
