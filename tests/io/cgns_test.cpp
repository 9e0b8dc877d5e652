// CGNS. The files are made by h5py, by the SIDS' HDF5 mapping (tests/fuzz/array_samples.py, which asks cgnscheck); their content is
// repeated here.

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

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Group& group_of(const Mesh& mesh, std::string_view role, std::string_view name) {
  for (const Group& group : mesh.groups) {
    if (group.name == name && group.role == role) return group;
  }
  throw std::out_of_range("no " + std::string(role) + " " + std::string(name));
}

std::vector<Index> all_of(std::span<const Index> some) { return {some.begin(), some.end()}; }

TEST(Cgns, SolidsOfAnUnstructuredZone) {
  const Mesh mesh = read_bytes("a.cgns", testing::cgns_solids());
  expect_consistent(mesh);
  ASSERT_EQ(mesh.positions.size(), 23U);
  EXPECT_EQ(mesh.positions[22], (Vec3{6.5, 0.5, 1}));
  std::vector<double> volumes;
  for (Index e = 0; e < mesh.elements.size(); ++e) volumes.push_back(signed_volume(mesh, e));
  EXPECT_THAT(volumes, ElementsAre(DoubleEq(0.5), DoubleEq(1.0), DoubleEq(1.0 / 6.0), DoubleEq(1.0 / 3.0)));
  EXPECT_THAT(group_of(mesh, "section", "Inside").members, ElementsAre(0, 1, 2)) << "both sections hold what may be a pyramid";
  EXPECT_THAT(group_of(mesh, "section", "Tip").members, ElementsAre(3));
  EXPECT_THAT(all_of(group_of(mesh, "boundary patch", "ground").faces.all_corners()), ElementsAre(0, 2, 1, 14, 16, 15));
  EXPECT_EQ(group_of(mesh, "family", "Hull").faces.size(), 2U);
  EXPECT_THAT(all_of(group_of(mesh, "section", "Roof").faces.all_corners()), ElementsAre(10, 11, 12, 13)) << "no condition is on it";
  EXPECT_THAT(group_of(mesh, "boundary patch", "peak").members, ElementsAre(22, 17));
  EXPECT_EQ(mesh.groups.size(), 6U);
  ASSERT_EQ(mesh.fields.size(), 1U);
  EXPECT_EQ(mesh.fields[0].name, "Pressure");
  EXPECT_THAT(mesh.fields[0].values, ElementsAre(1.5, 2.5, 3.5, 4.5));
}

TEST(Cgns, StructuredZonesAreJoinedWhereTheyTouch) {
  const Mesh mesh = read_bytes("a.cgns", testing::cgns_zones());
  expect_consistent(mesh);
  ASSERT_EQ(mesh.positions.size(), 8U) << "3 x 2 points and 2 x 2, two of which are the same";
  EXPECT_EQ(mesh.source->layout().components, 2);
  EXPECT_THAT(all_of(mesh.elements.all_corners()), ElementsAre(0, 1, 4, 3, 1, 2, 5, 4, 2, 6, 7, 5));
  EXPECT_EQ(mesh.positions[6], (Vec3{3, 0, 0}));
  EXPECT_EQ(mesh.positions[7], (Vec3{3, 1, 0}));
  EXPECT_THAT(group_of(mesh, "zone", "Right").members, ElementsAre(2));
  EXPECT_THAT(group_of(mesh, "boundary patch", "south").members, ElementsAre(0, 1, 1, 2, 2, 6));
  EXPECT_THAT(mesh.fields.at(0).values, ElementsAre(0, 1, 2, 10, 11, 12, 3, 13));
  EXPECT_THAT(mesh.source->notes(), Contains(HasSubstr("2 zones were read as one mesh; 2 points")));
}

TEST(Cgns, PointsThatAConnectionSaysAreOneArePaired) {
  const Mesh blocks = read_bytes("a.cgns", testing::cgns_periodic());
  expect_consistent(blocks);
  ASSERT_EQ(blocks.positions.size(), 8U);
  ASSERT_EQ(blocks.periodic.size(), 2U) << "both zones tell them";
  for (const auto& [one, other] : blocks.periodic) {
    EXPECT_EQ(blocks.positions[one].x, 0.0);
    EXPECT_EQ(blocks.positions[other], blocks.positions[one] + (Vec3{3, 0, 0}));
  }
  EXPECT_THAT(blocks.periodic[0], ElementsAre(0, 7)) << "the second index of the right zone runs downwards";
  EXPECT_THAT(read_bytes("a.cgns", testing::cgns_periodic_lists()).periodic, ElementsAre(ElementsAre(0, 2), ElementsAre(3, 5)));
  EXPECT_THAT(read_bytes("a.cgns", testing::cgns_zones()).periodic, ElementsAre());
}

TEST(Cgns, WrittenAgainItHoldsTheSameWithOtherPositions) {
  for (const std::string& bytes : {testing::cgns_solids(), testing::cgns_zones()}) {
    const Mesh mesh = read_bytes("a.cgns", bytes);
    EXPECT_EQ(written("a.cgns", mesh), bytes);
    std::vector<Vec3> positions = mesh.positions;
    for (Vec3& p : positions) p = {p.x * 0.5 + 0.25, 3.0 - p.y, p.z * 2.0};  // exact in floats
    std::vector<std::string> notes;
    const Mesh again = read_bytes("a.cgns", written("a.cgns", mesh, positions, &notes));
    EXPECT_THAT(notes, ElementsAre());
    expect_same_positions(positions, again.positions);  // also in both zones, or they would not be joined
    expect_same_elements(mesh, again);
    ASSERT_EQ(again.groups.size(), mesh.groups.size());
    for (std::size_t i = 0; i < mesh.groups.size(); ++i) EXPECT_EQ(again.groups[i].members, mesh.groups[i].members);
    EXPECT_EQ(again.fields[0].values, mesh.fields[0].values);
  }
}

/// Arrays that are not packed are replaced where they are: nothing else changes.
TEST(Cgns, WrittenAgainOnlyTheCoordinatesDiffer) {
  const std::string bytes = testing::cgns_solids();
  const Mesh mesh = read_bytes("a.cgns", bytes);
  std::vector<Vec3> positions = mesh.positions;
  positions[22].y = 0.75;
  const std::string again = written("a.cgns", mesh, positions);
  ASSERT_EQ(again.size(), bytes.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) differ += bytes[i] != again[i] ? 1U : 0U;
  EXPECT_EQ(differ, 1U) << "0.5 and 0.75 differ in one byte";
}

std::string with_bytes(std::string bytes, std::string_view what, std::string_view by) {
  const std::size_t at = bytes.find(what);
  if (at == std::string::npos || what.size() != by.size()) throw std::out_of_range("not there");
  return bytes.replace(at, what.size(), by);
}

/// The numbers' bytes in the file.
std::string whole_numbers(std::initializer_list<std::int32_t> numbers) {
  std::string bytes;
  for (const std::int32_t number : numbers) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  return bytes;
}

TEST(Cgns, ConnectionsThatCannotBeAreRefused) {
  const std::string blocks = testing::cgns_periodic(), lists = testing::cgns_periodic_lists();
  expect_refused("a.cgns", with_bytes(blocks, whole_numbers({1, 1, 1, 2}), whole_numbers({1, 1, 1, 3})), 0,
                 "\"/Base/Left/ZoneGridConnectivity/around\": PointRange leaves the zone \"Left\"");
  expect_refused("a.cgns", with_bytes(blocks, whole_numbers({2, 2, 2, 1}), whole_numbers({2, 1, 2, 1})), 0, "it leaves the zone \"Right\"");
  expect_refused("a.cgns", with_bytes(blocks, whole_numbers({1, -2}), whole_numbers({1, -1})), 0, "its Transform is none");
  expect_refused("a.cgns", with_bytes(blocks, "Base/Right", "Base/Wrong"), 0, "the zone \"Base/Wrong\", which is not there");
  expect_refused("a.cgns", with_bytes(lists, whole_numbers({1, 4}), whole_numbers({1, 7})), 0, "it leaves the zone \"Zone\"");
}

TEST(Cgns, Refused) {
  const std::string solids = testing::cgns_solids();
  expect_refused("a.cgns", with_bytes(solids, whole_numbers({12, 0}), whole_numbers({13, 0})), 0,
                 "\"/Base/Zone/Tip\": elements PYRA_14 are not read");
  expect_refused("a.cgns", with_bytes(solids, whole_numbers({12, 0}), whole_numbers({22, 0})), 0, "elements NGON_n are not read: convert");
  expect_refused("a.cgns", with_bytes(solids, whole_numbers({17, 7, 8}), whole_numbers({18, 7, 8})), 0, "element 2: HEXA_20 is not read");
  expect_refused("a.cgns", with_bytes(solids, whole_numbers({19, 20, 21}), whole_numbers({19, 24, 21})), 0,
                 "element 4: point 24 out of range (the zone has 23)");
  std::string range = solids;  // the last 5 and 6 are those of the condition
  range.replace(range.rfind(whole_numbers({5, 6})), 8, whole_numbers({5, 9}));
  expect_refused("a.cgns", range, 0, "boundary condition \"ground\": the zone has no element 8");
  expect_refused("a.cgns", with_bytes(solids, "Unstructured", "UserDefined "), 0, "a zone of type");
  expect_refused("a.cgns", solids.substr(0, solids.size() / 2), 0, "");
  expect_refused("a.cgns", "@(#)ADF Database Version B02012>", 0, "of the older kind (ADF), which is not read: convert it with adf2hdf");
  expect_refused("a.cgns", testing::xdmf_numbers(), 0, "this is an HDF5 file");
}

/// Links to other files are not followed, and omitted content is reported.
TEST(Cgns, LinksIntoOtherFilesAreRefused) {
  const TemporaryFolder folder;
  put(folder / "solids.cgns", testing::cgns_solids());
  put(folder / "linked.cgns", testing::cgns_linked());
  Progress progress;
  try {
    (void)read_mesh(folder / "linked.cgns", progress);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"/Base/Zone\": damaged, or a link into another file"));
  }
}

/// A file declares its size: arrays larger than it can be must not take all memory.
TEST(Cgns, ABudgetBoundsWhatIsUnpacked) {
  const TemporaryFolder folder;
  put(folder / "a.cgns", testing::cgns_solids());
  Progress progress;
  EXPECT_NO_THROW((void)read_mesh(folder / "a.cgns", IoContext(progress, nullptr, 100000)));
  try {
    (void)read_mesh(folder / "a.cgns", IoContext(progress, nullptr, 500));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("--max-memory"));
  }
}

TEST(Cgns, IsNotMadeAnew) {
  Mesh mesh = read_bytes("a.cgns", testing::cgns_solids());
  mesh.source.reset();
  const TemporaryFolder folder;
  Progress progress;
  try {
    (void)write_mesh(folder / "b.cgns", mesh, mesh.positions, progress);
    ADD_FAILURE();
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("write it as .vtu"));
  }
}

}  // namespace
}  // namespace dmoscope::test
