// Files packed by gzip: recognised by their content, written if the name asks for it, and limited in size.

#include "core/io/reading/gzip.h"

#include <cstdint>
#include <random>
#include <string>
#include <string_view>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/fuzz/check_gzip.h"
#include "tests/fuzz/samples.h"
#include "tests/io/files.h"
#include "tests/support/temporary_folder.h"

namespace dmoscope::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::string_view kPlainOff = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1.50 0\n3 0 1 2\n";
/// The bytes packed by Python's gzip.
constexpr char kPackedBytes[] =
    "\x1f\x8b\x08\x00\x00\x00\x00\x00\x02\xff\xf3\x77\x73\xe3\x32\x56\x30\x54\x30\xe0\x32\x50\x00\x42\x2e\x43\x30\x69\xa0\x60\xa8\x67\x0a"
    "\x62\x18\x03\xb9\x86\x0a\x46\x5c\x00\xcc\x8d\x0c\x6a\x27\x00\x00\x00";
constexpr std::string_view kPacked(kPackedBytes, sizeof kPackedBytes - 1);

std::string packed(std::string_view bytes) {
  std::string result;
  GzipPacker packer([&](std::string_view part) { result += part; });
  packer.add(bytes);
  packer.finish();
  return result;
}

std::string unpacked(std::string_view bytes) {
  Progress progress;
  return std::string(gunzipped("a.gz", bytes, progress).view());
}

class Gzip : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!gzip_is_here()) GTEST_SKIP() << "this build has no zlib";
  }
};

TEST_F(Gzip, IsReadWhateverTheName) {
  for (const char* name : {"a.off.gz", "a.OFF.GZ", "a.off", "a.vtk", "a.gz", "a"}) {
    const Mesh mesh = read_bytes(name, kPacked);
    EXPECT_EQ(mesh.name, name);
    EXPECT_EQ(mesh.positions[2], (Vec3{0, 1.5, 0}));
    EXPECT_EQ(mesh.elements.size(), 1U);
    EXPECT_EQ(written("b.off", mesh), kPlainOff) << "its characters are kept";
  }
  expect_refused("a.off.gz", packed("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), 4, "x");
  expect_refused("a.bdf.gz", packed("BZh"), 0, "packed by bzip2");
}

TEST_F(Gzip, IsWrittenWhereTheNameSaysSo) {
  Mesh mesh = read_bytes("a.off", kPlainOff);
  const std::string bytes = written("b.off.gz", mesh);
  EXPECT_TRUE(is_gzip(bytes));
  EXPECT_EQ(unpacked(bytes), kPlainOff);
  EXPECT_EQ(written("c.off.gz", mesh), bytes) << "no time and no name is in it";
  mesh.positions[1].x = 2;
  mesh.source.reset();
  EXPECT_EQ(read_bytes("d.vtk.gz", written("d.vtk.gz", mesh)).positions[1].x, 2.0);
}

TEST_F(Gzip, JoinedFilesAndLongOnesComeWhole) {
  EXPECT_EQ(unpacked(std::string(kPacked) + std::string(kPacked) + std::string(512, '\0')),
            std::string(kPlainOff) + std::string(kPlainOff));
  std::string text;
  for (std::uint32_t i = 0; i < 300'000; ++i) text += std::to_string(i * 2654435761U) + '\n';
  EXPECT_EQ(unpacked(packed(text)), text);
  EXPECT_EQ(unpacked(packed("")), "");
}

TEST_F(Gzip, DamagedOnesAreRefused) {
  for (std::size_t end = 3; end < kPacked.size(); ++end) {
    EXPECT_THROW((void)unpacked(kPacked.substr(0, end)), InputError) << end;
  }
  std::string damaged(kPacked);
  damaged[20] = static_cast<char>(damaged[20] ^ 0x10);
  EXPECT_THROW((void)unpacked(damaged), InputError);
  expect_refused("a.off.gz", kPacked.substr(0, 40), 0, "truncated");
  expect_refused("a.node.gz", packed("3 2 0 0\n1 0 0\n2 1 0\n3 0 1\n"), 0, "in pairs");
}

TEST_F(Gzip, TheFuzzersSamplesHold) {
  for (const bool joined : {false, true}) {
    const std::string bytes = dmoscope::testing::gzip_off(joined);
    EXPECT_TRUE(dmoscope::testing::check_gzip(bytes));
    EXPECT_EQ(unpacked(bytes), kPlainOff);
    std::mt19937_64 random(7);
    for (int i = 0; i < 1000; ++i) {
      std::string mutant = bytes;
      mutant[random() % mutant.size()] = static_cast<char>(random());
      EXPECT_NO_THROW((void)dmoscope::testing::check_gzip(mutant)) << i;
    }
  }
}

TEST_F(Gzip, BombsAreRefused) {
  const std::string bomb = packed(std::string(std::size_t{257} << 20, ' '));
  EXPECT_LT(bomb.size(), 300'000U);
  expect_refused("a.off.gz", bomb, 0, "--max-memory SIZE");
}

TEST_F(Gzip, WhatItMayUnpackToCanBeSaid) {
  const std::string blanks = packed(std::string(kPlainOff) + std::string(std::size_t{3} << 20, ' '));
  const TemporaryFolder folder;
  Progress progress;
  for (const char* name : {"a.off.gz", "a"}) {  // the format of the second is found in its content
    const auto path = folder / name;
    put(path, blanks);
    for (const std::uint64_t fine : {std::uint64_t{0}, std::uint64_t{4} << 20U}) {
      EXPECT_EQ(read_mesh(path, {progress, nullptr, fine}).elements.size(), 1U);
      EXPECT_NO_THROW(require_known_format(path, {progress, nullptr, fine}));
    }
    try {
      (void)read_mesh(path, {progress, nullptr, std::uint64_t{2} << 20U});
      ADD_FAILURE() << "3 MB are more than 2";
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(path.string()), HasSubstr("packed by gzip"), HasSubstr("--max-memory SIZE")));
    }
  }
  EXPECT_THROW(require_known_format(folder / "a", {progress, nullptr, std::uint64_t{2} << 20U}), InputError);
}

// The limit: 36 MB of zeros that gzip packs to 36 kB, and that take 8 bytes each as numbers.
TEST_F(Gzip, WhatAPackedFileBecomesIsMeasuredByTheFileItself) {
  if (format_by_extension(".vtu") == nullptr) GTEST_SKIP() << "this build has no VTU";
  constexpr std::uint32_t kBytes = 36U << 20U;
  std::string file =
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\">\n<UnstructuredGrid>\n"
      "<Piece NumberOfPoints=\"36864\" NumberOfCells=\"1\">\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
      "format=\"ascii\">";
  for (int v = 0; v < 36864; ++v) file += "0 0 0 ";
  file +=
      "</DataArray></Points>\n<Cells><DataArray type=\"Int64\" Name=\"connectivity\">0 1 2</DataArray>"
      "<DataArray type=\"Int64\" Name=\"offsets\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\">5</DataArray></Cells>\n"
      "<PointData><DataArray type=\"UInt8\" Name=\"f\" NumberOfComponents=\"1024\" format=\"appended\" offset=\"0\"/></PointData>\n"
      "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">_";
  for (unsigned shift = 0; shift < 32; shift += 8) file += static_cast<char>(kBytes >> shift & 255U);
  file += std::string(kBytes, '\0') + "</AppendedData>\n</VTKFile>\n";
  expect_refused("a.vtu.gz", packed(file), 6, "arrays unpack to more than");
}

}  // namespace
}  // namespace dmoscope::test
