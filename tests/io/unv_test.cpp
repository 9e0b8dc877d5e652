// Universal files: what is read, what comes out again, and what is refused and where.

#include <algorithm>
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

TEST(Unv, NodesElementsAndGroups) {
  const Mesh mesh = read_bytes("a.unv", testing::unv_volume());
  expect_consistent(mesh);
  EXPECT_THAT(mesh.positions, ElementsAre(Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1.5, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{1, 0, 1},
                                          Vec3{1, 1, 1}, Vec3{0, 1, 1}, Vec3{.5, .5, 2}));
  EXPECT_THAT(std::vector<ElementKind>(mesh.elements.kinds().begin(), mesh.elements.kinds().end()),
              ElementsAre(ElementKind::Hexahedron, ElementKind::Pyramid));
  EXPECT_THAT(std::vector<Index>(mesh.elements.all_corners().begin(), mesh.elements.all_corners().end()),
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 4, 5, 6, 7, 8));
  const auto group = [&](std::string_view name, int dimension) {
    const auto found = std::ranges::find_if(mesh.groups, [&](const Group& g) { return g.name == name && g.dimension == dimension; });
    EXPECT_NE(found, mesh.groups.end()) << name;
    return found == mesh.groups.end() ? Group{} : *found;
  };
  EXPECT_THAT(group("rock", 2).members, ElementsAre(0, 1));
  EXPECT_EQ(group("rock", 2).code, 1);
  EXPECT_THAT(group("skin and a node", 2).faces.all_corners(), ElementsAre(0, 3, 2, 1));
  EXPECT_THAT(group("skin and a node", 1).members, ElementsAre(2, 3)) << "the beam, behind its orientation";
  EXPECT_THAT(group("skin and a node", 0).members, ElementsAre(2));
  EXPECT_THAT(group("property 7", 2).members, ElementsAre(0, 1));
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("dataset 164")));
  EXPECT_THAT(mesh.source->only_in_file(), Contains(HasSubstr("springs")));
}

TEST(Unv, OnOneLineAndUnderAnyName) {
  const Mesh mesh = read_bytes("a.unknown", testing::unv_planar());
  expect_consistent(mesh);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
  EXPECT_THAT(corners(mesh, 1), ElementsAre(1, 4, 2));
}

/// Numbers end in the columns of those that they replace.
TEST(Unv, WrittenAgainOnlyWhatMovedChanges) {
  for (const std::string& bytes : {testing::unv_volume(), testing::unv_planar()}) {
    const Mesh mesh = read_bytes("a.unv", bytes);
    EXPECT_EQ(written("b.unv", mesh), bytes);
    const bool narrow = mesh.positions.size() == 5;
    std::vector<Vec3> moved = mesh.positions;
    moved[1] = {narrow ? -0.12345678901234567 : -0.1, moved[1].y, 1.0 / 1024.0};
    std::vector<std::string> notes;
    const std::string again = written("b.unv", mesh, moved, &notes);
    EXPECT_EQ(again.size(), bytes.size());
    std::string wanted = bytes;
    const std::string before = narrow ? "  1.00000E+00  0.00000E+00  0.00000E+00\n"
                                      : "   1.0000000000000000D+00   0.0000000000000000D+00   0.0000000000000000D+00\n";
    const std::string after = narrow ? " -.1234567890  0.00000E+00  .0009765625\n"
                                     : "  -1.0000000000000001D-01   0.0000000000000000D+00   9.7656250000000000D-04\n";
    wanted.replace(wanted.find(before), before.size(), after);
    if (!narrow) {
      EXPECT_EQ(again, wanted);
      EXPECT_THAT(notes, ElementsAre());
      expect_same_positions(read_bytes("a.unv", again).positions, moved);
    } else {
      EXPECT_THAT(notes, ElementsAre(HasSubstr("rounded to the 12 characters")));
      EXPECT_NEAR(read_bytes("a.unv", again).positions[1].x, moved[1].x, 1e-9);
    }
  }
}

TEST(Unv, IsNotMadeAnew) {
  EXPECT_THROW((void)written("b.unv", read_bytes("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")), OutputError);
}

TEST(Unv, WrongFilesAreRefusedWithTheirLine) {
  const auto refusal = [](const std::string& bytes) -> std::string {
    try {
      (void)read_bytes("a.unv", bytes);
    } catch (const InputError& error) {
      return error.what();
    }
    return "read";
  };
  const std::string planar = testing::unv_planar();
  const auto with = [&planar](std::string_view old, std::string_view now) {
    std::string bytes = planar;
    bytes.replace(bytes.find(old), old.size(), now);
    return bytes;
  };
  EXPECT_THAT(refusal(with("        44         1         1         7         4", "        45         1         1         7         8")),
              HasSubstr("a.unv:11: an element of kind 45 with 8 nodes"));
  EXPECT_THAT(refusal(with("         2         5         3\n", "         2         9         3\n")), HasSubstr("a.unv:13: "));
  EXPECT_THAT(refusal(with("  2.00000E+00  5.00000E-01", "  2.00000E+00")), HasSubstr("a.unv:7: a node has 3 coordinates, not 2"));
  EXPECT_THAT(refusal(planar.substr(0, planar.size() - 7)), HasSubstr("ends within a dataset"));
  EXPECT_THAT(refusal("    -1\n   164\n    -1\n"), HasSubstr("has no nodes"));
  expect_truncation_safe("a.unv", planar);
}

}  // namespace
}  // namespace dmoscope::test
