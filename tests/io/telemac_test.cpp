// SELAFIN of TELEMAC and the meshes of MIKE: reading, writing, and refusals with their places.

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

TEST(Selafin, EitherByteOrderAndPrecision) {
  for (const bool big_endian : {true, false}) {
    for (const bool doubles : {true, false}) {
      SCOPED_TRACE(std::string(big_endian ? "big" : "little") + (doubles ? ", double" : ", single"));
      const std::string bytes = testing::selafin_sample(big_endian, doubles);
      const Mesh mesh = read_bytes("a.slf", bytes);
      EXPECT_EQ(mesh.title, "a basin");
      EXPECT_EQ(mesh.single_precision, !doubles);
      ASSERT_EQ(mesh.positions.size(), 4U);
      EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
      ASSERT_EQ(mesh.elements.size(), 2U);
      EXPECT_THAT(corners(mesh, 1), ElementsAre(0, 2, 3));
      ASSERT_EQ(mesh.fields.size(), 2U);
      EXPECT_EQ(mesh.fields[1].name, "WATER DEPTH");
      EXPECT_THAT(mesh.fields[0].values, ElementsAre(-1, -2, -3, -4));
      EXPECT_THAT(mesh.fields[1].values, ElementsAre(61, 62, 63, 64)) << "of the last step";
      EXPECT_THAT(mesh.source->notes(), Contains("Fields are those of the last of 2 time steps."));

      EXPECT_EQ(written("b.slf", mesh), bytes);
      std::vector<Vec3> moved = mesh.positions;
      moved[2] = {0.75, 1.25, 0};
      std::string wanted = bytes;
      const auto put = [&](std::size_t at, double value) {
        const std::size_t size = doubles ? 8 : 4;
        const std::size_t first = bytes.size() - 2 * (size + 8) - 4 * (4 * size + 8) - 2 * (4 * size + 8) + 4 + at;
        std::string raw;
        if (doubles) {
          const auto number = store_number(value, big_endian);
          raw.assign(number.data(), number.size());
        } else {
          const auto number = store_number(static_cast<float>(value), big_endian);
          raw.assign(number.data(), number.size());
        }
        wanted.replace(first, size, raw);
      };
      const std::size_t size = doubles ? 8 : 4;
      put(2 * size, 0.75);
      put(4 * size + 8 + 2 * size, 1.25);
      EXPECT_EQ(written("b.slf", mesh, moved), wanted);
      moved[0].z = 1.0;
      EXPECT_THROW((void)written("b.slf", mesh, moved), OutputError);
      expect_truncation_safe("a.slf", bytes);
    }
  }
  EXPECT_EQ(read_bytes("result", testing::selafin_sample(true, false)).source->format(), "selafin") << "by its content";
}

TEST(Selafin, WhatIsWrongIsRefused) {
  const std::string good = testing::selafin_sample(true, false);
  expect_refused("a.slf", "no such file", 0, "a title of 80 characters");
  const auto with_number = [&](std::size_t at, std::int32_t value) {
    std::string bytes = good;
    const auto raw = store_number(value, true);
    return bytes.replace(at, raw.size(), raw.data(), raw.size());
  };
  const std::size_t parameters = 88 + 16 + 2 * 40 + 4, sizes = parameters + 44 + 4 + 32, elements = sizes + 24;
  expect_refused("a.slf", with_number(parameters + 24, 5), 0, "TELEMAC-3D");
  expect_refused("a.slf", with_number(sizes + 8, 6), 0, "elements of 6 corners");
  expect_refused("a.slf", with_number(elements, 9), 0, "names point 9");
  expect_refused("a.slf", with_number(sizes + 4, 1 << 30), 0, "truncated");
  expect_refused("a.slf", with_number(elements + 24, 23), 0, "a record does not end where its size says");
  Mesh mesh = read_bytes("a.slf", good);
  mesh.source.reset();
  EXPECT_THROW((void)written("b.slf", mesh), OutputError);
}

const std::string kMike =
    "100079  1000  5  PROJCS[\"UTM-33\"]\n1 0 0 -5.5 1\n2 1 0 -5 1\n3 1 1 -4 0\n4 0 1.50 -3 2\n5 2 0.5 -2 1\n2 4 25\n1 1 2 3 4\n2 2 5 3 "
    "0\n";

TEST(Mike, NodesLevelsCodesAndElements) {
  for (const std::string& bytes : {kMike, "5 LONG/LAT\n" + kMike.substr(kMike.find('\n') + 1)}) {
    const Mesh mesh = read_bytes("a.mesh", bytes);
    EXPECT_EQ(mesh.source->format(), "mike");
    ASSERT_EQ(mesh.elements.size(), 2U);
    EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(corners(mesh, 1), ElementsAre(1, 4, 2));
    EXPECT_EQ(mesh.positions[3], (Vec3{0, 1.5, 0}));
    ASSERT_EQ(mesh.fields.size(), 2U);
    EXPECT_EQ(mesh.fields[0].name, "elevation");
    EXPECT_THAT(mesh.fields[0].values, ElementsAre(-5.5, -5, -4, -3, -2));
    EXPECT_THAT(mesh.fields[1].values, ElementsAre(1, 1, 0, 2, 1));
    expect_patched("a.mesh", bytes, false);
    expect_truncation_safe("a.mesh", bytes);
  }
  const Mesh triangles = read_bytes("a.mesh", "3 NON-UTM\n1 0 0 0 1\n2 1 0 0 1\n3 0 1 0 1\n1 3 21\n1 1 2 3\n");
  EXPECT_THAT(corners(triangles, 0), ElementsAre(0, 1, 2));
  std::vector<std::string> notes;
  (void)written("b.2dm", read_bytes("a.mesh", kMike), read_bytes("a.mesh", kMike).positions, &notes);
  EXPECT_THAT(notes, Contains(HasSubstr("the projection PROJCS")));
  EXPECT_THAT(notes, Contains(HasSubstr("code")));
}

TEST(Mike, WhatIsWrongIsRefusedWhereItStands) {
  const auto with = [](std::string_view from, std::string_view to) {
    std::string text = kMike;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_refused("a.mesh", with("3 1 1 -4 0", "7 1 1 -4 0"), 4, "node 3 should stand here");
  expect_refused("a.mesh", with("2 1 0 -5 1", "2 1 0 -5"), 3, "code of a node");
  expect_refused("a.mesh", with("2 4 25", "2 6 32"), 7, "elements of kind 32");
  expect_refused("a.mesh", with("2 2 5 3 0", "2 2 9 3 0"), 9, "9");
  expect_refused("a.mesh", with("2 2 5 3 0", "2 2 5"), 9, "element with 2 corners");
  expect_refused("a.mesh", kMike + "1 1 1\n", 10, "goes on");
}

}  // namespace
}  // namespace dmoscope::test
