// MED. The files are made by meshio and h5py (tests/fuzz/array_samples.py); their content is repeated here.

#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
using ::testing::UnorderedElementsAre;

std::map<std::string, const Group*> groups_of(const Mesh& mesh) {
  std::map<std::string, const Group*> groups;
  for (const Group& group : mesh.groups) groups[group.name] = &group;
  return groups;
}

const Field& field_of(const Mesh& mesh, std::string_view name) {
  for (const Field& field : mesh.fields)
    if (field.name == name) return field;
  throw std::out_of_range("no " + std::string(name));
}

TEST(Med, SolidsGroupsAndFields) {
  const Mesh mesh = read_bytes("a.med", testing::med_solids());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "mesh");
  ASSERT_EQ(mesh.positions.size(), 23U);
  EXPECT_EQ(mesh.positions[22], (Vec3{6.5, 0.5, 1}));
  std::vector<double> volumes;
  for (Index e = 0; e < mesh.elements.size(); ++e) volumes.push_back(signed_volume(mesh, e));
  EXPECT_THAT(volumes, UnorderedElementsAre(DoubleEq(0.5), DoubleEq(1.0), DoubleEq(1.0 / 6.0), DoubleEq(1.0 / 3.0)));
  const auto groups = groups_of(mesh);
  ASSERT_TRUE(groups.contains("left") && groups.contains("all") && groups.contains("ground"));
  ASSERT_EQ(groups.at("left")->members.size(), 1U);
  EXPECT_EQ(mesh.elements.kind(groups.at("left")->members[0]), ElementKind::Wedge);
  EXPECT_EQ(groups.at("all")->members.size(), 3U) << "two families have it";
  const auto ground = groups.at("ground")->faces.all_corners();
  EXPECT_THAT(std::vector<Index>(ground.begin(), ground.end()), ElementsAre(0, 2, 1));
  EXPECT_THAT(groups.at("peak")->members, ElementsAre(0, 22));
  EXPECT_THAT(groups.at("corners")->members, ElementsAre(0));
  EXPECT_EQ(field_of(mesh, "heat").values[22], 22.0);
  ASSERT_EQ(mesh.fields.size(), 4U) << "two components of way";
  for (const Field& field : mesh.fields) {
    if (!field.name.starts_with("way.")) continue;
    EXPECT_THAT(field.values[7], ::testing::AnyOf(7.0, 107.0)) << field.name;
    EXPECT_EQ(field.values[22] - field.values[7], 15.0) << field.name;
  }
  const Field& stress = field_of(mesh, "stress");
  ASSERT_EQ(stress.on, Field::On::Elements);
  for (Index e = 0; e < 4; ++e) {
    const std::map<ElementKind, double> expected{
        {ElementKind::Wedge, 1.5}, {ElementKind::Hexahedron, 2.5}, {ElementKind::Tetrahedron, 3.5}, {ElementKind::Pyramid, 4.5}};
    EXPECT_EQ(stress.values[e], expected.at(mesh.elements.kind(e)));
  }
}

TEST(Med, APlaneWithoutTimeSteps) {
  const Mesh mesh = read_bytes("a.med", testing::med_plane());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.title, "plate");
  EXPECT_EQ(mesh.source->layout().components, 2);
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  EXPECT_EQ(mesh.elements.size(), 3U);
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("1 other meshes")));
}

TEST(Med, WrittenAgainOnlyWhatMovedIsOther) {
  for (const std::string& bytes : {testing::med_solids(), testing::med_plane()}) {
    const Mesh mesh = read_bytes("a.med", bytes);
    EXPECT_EQ(written("a.med", mesh, mesh.positions), bytes);
    std::vector<Vec3> moved = mesh.positions;
    moved[3] = moved[3] + Vec3{0.125, -0.25, 0.0};
    const std::string other = written("a.med", mesh, moved);
    const Mesh again = read_bytes("a.med", other);
    EXPECT_EQ(again.positions, moved);
    ASSERT_EQ(other.size(), bytes.size());
    std::size_t changed = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) changed += other[i] != bytes[i] ? 1 : 0;
    EXPECT_LE(changed, 16U) << "two doubles";
  }
}

TEST(Med, Refused) {
  std::string quadratic = testing::med_plane();
  for (std::size_t at = quadratic.find("TR3"); at != std::string::npos; at = quadratic.find("TR3", at)) quadratic.replace(at, 3, "TR6");
  expect_refused("a.med", quadratic, 0, "elements of type \"TR6\"");
  expect_refused("a.med", "ENS_MAA" + testing::med_plane(), 0, "no HDF5 file");
}

}  // namespace
}  // namespace dmoscope::test
