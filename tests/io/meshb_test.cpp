// MEDIT's binary format: every version and byte order gives the mesh of the text format.

#include <string>
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
using ::testing::HasSubstr;

TEST(Meshb, EveryVersionHoldsWhatTheTextHolds) {
  const Mesh text = read_bytes("a.mesh", dmoscope::testing::medit_ascii());
  for (int version = 1; version <= 4; ++version) {
    for (const bool big : {false, true}) {
      SCOPED_TRACE(::testing::Message() << "version " << version << (big ? " big" : " little"));
      const Mesh mesh = read_bytes("a.meshb", dmoscope::testing::medit_binary(version, big));
      expect_consistent(mesh);
      expect_same_positions(text.positions, mesh.positions);
      expect_same_elements(text, mesh);
      ASSERT_EQ(mesh.groups.size(), text.groups.size());
      for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        EXPECT_EQ(mesh.groups[g].name, text.groups[g].name);
        EXPECT_EQ(mesh.groups[g].members, text.groups[g].members);
        EXPECT_TRUE(std::ranges::equal(mesh.groups[g].faces.all_corners(), text.groups[g].faces.all_corners()));
      }
      ASSERT_EQ(mesh.fields.size(), 1U);
      EXPECT_EQ(mesh.fields[0].values, text.fields[0].values);
      EXPECT_EQ(mesh.single_precision, version == 1);
      EXPECT_THAT(mesh.source->only_in_file(), Contains("what stands under keyword 60"));
    }
  }
}

TEST(Meshb, MovedCoordinatesAreReplacedInPlace) {
  for (int version = 1; version <= 4; ++version) {
    SCOPED_TRACE(version);
    const std::string bytes = dmoscope::testing::medit_binary(version, version % 2 == 0);
    const Mesh mesh = read_bytes("a.meshb", bytes);
    EXPECT_EQ(written("a.meshb", mesh), bytes);
    std::vector<Vec3> positions = mesh.positions;
    positions[2].y = 1.25;
    const std::string moved = written("a.meshb", mesh, positions);
    EXPECT_EQ(moved.size(), bytes.size());
    expect_same_positions(positions, read_bytes("b.meshb", moved).positions);
  }
}

TEST(Meshb, IsNotMadeAnew) {
  Mesh mesh = read_bytes("a.mesh", dmoscope::testing::medit_ascii());
  EXPECT_THROW((void)written("b.meshb", mesh), OutputError);
  // The byte order is swapped.
  const Mesh binary = read_bytes("a.meshb", dmoscope::testing::medit_binary(2, false));
  expect_same_elements(mesh, read_bytes("c.mesh", written("c.mesh", binary)));
}

TEST(Meshb, Malformed) {
  const std::string good = dmoscope::testing::medit_binary(2, false);
  const auto with = [&](std::size_t at, std::int32_t number) {
    std::string bytes = good;
    std::string raw;
    dmoscope::testing::put<std::int32_t>(raw, false, {number});
    return bytes.replace(at, 4, raw);
  };
  // Bytes of the file: 8: Dimension, 12: place of the next keyword, 16: 3; 20: Vertices, 24: the next place, 28: their number.
  expect_refused("a.meshb", with(4, 9), 0, "version of 1 to 4");
  expect_refused("a.meshb", with(12, 4), 0, "the next one is at byte 4");
  expect_refused("a.meshb", with(12, 1 << 30), 0, "the next one is at byte");
  expect_refused("a.meshb", with(12, 24), 0, "ends at byte 20");
  expect_refused("a.meshb", with(16, 4), 0, "only 2 and 3 dimensions");
  expect_refused("a.meshb", with(20, 30), 0, "higher order");
  expect_refused("a.meshb", with(28, -1), 0, "negative");
  expect_refused("a.meshb", with(28, 1 << 30), 0, "truncated");
  expect_refused("a.meshb", with(28, 4), 0, "ends at byte");
  const std::size_t corner = good.size() - 8 - 3 * 16 - 8;
  expect_refused("a.meshb", with(corner, 6), 0, "names vertex 6");
  expect_truncation_safe("a.meshb", good);
}

}  // namespace
}  // namespace dmoscope::test
