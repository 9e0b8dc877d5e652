#include <array>
#include <bit>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/same_bits.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kPlain = "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0.5 -0.0\n4 0 1 2 3\n3 1 4 2\n";

TEST(Off, Plain) {
  const Mesh mesh = read_bytes("a.off", kPlain);
  ASSERT_EQ(mesh.positions.size(), 5U);
  ASSERT_EQ(mesh.elements.size(), 2U);
  EXPECT_TRUE(same_bits(mesh.positions[4], {2.0, 0.5, -0.0}));
  EXPECT_EQ(mesh.elements.kind(0), ElementKind::Quadrilateral);
  EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(mesh.elements.kind(1), ElementKind::Triangle);
  EXPECT_THAT(corners(mesh, 1), ElementsAre(1, 4, 2));
  EXPECT_EQ(mesh.source->format(), "off");
}

TEST(Off, HeadersAndTrailingNumbersAsOthersWriteThem) {
  const std::string body = "\n0 0 0 9 9 9 9\n1 0 0 9 9 9 9\n0 1 0 9 9 9 9\n3 0 1 2 255 0 0\n";
  for (const char* header : {"OFF 3 1 0", "OFF\n3 1", "COFF\n3 1 0", "NOFF\n3 1 0", "STOFF\n3 1 0", "STCNOFF # all\n3 1 0",
                             "# before\n\nOFF # here\n# there\n3 1 0 # counts", "3 1 0"}) {
    const Mesh mesh = read_bytes("a.off", header + body);
    EXPECT_EQ(mesh.positions.size(), 3U) << header;
    EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2)) << header;
    expect_patched("a.off", header + body, true);
  }
}

TEST(Off, EveryByteButTheMovedStays) {
  expect_patched("a.off", kPlain, true);
  expect_patched("a.off", "OFF\r\n4 1 0\r\n\t0.10  00.0 +1.0 # c\r\n1 1D0 0\r\n\r\n1 1 1\r\n0 1e0 0\r\n4 0 1 2 3 0.5 0.5 0.5\r\n# end",
                 true);
  expect_patched("a.off", "OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\rmore that nobody reads\r", true);
}

TEST(Off, Malformed) {
  const struct {
    const char* text;
    std::size_t line;
    const char* words;
  } table[] = {
      {"HELLO\n", 1, "expected OFF"},
      {"4OFF\n1 1 1\n", 1, "expected OFF"},
      {"nOFF\n3\n", 1, "expected OFF"},
      {"OFF\n", 1, "number of vertices"},
      {"OFF\n3\n0 0 0\n1 0 0\n0 1 0\n", 2, "number of faces, but the line ends"},
      {"OFF\n-3 1 0\n", 2, "negative"},
      {"OFF\n1000000000 1 0\n0 0 0\n", 2, "bytes of the file are left"},
      {"OFF\n3 1000000000 0\n0 0 0\n1 0 0\n0 1 0\n", 2, "bytes of the file are left"},
      {"OFF\n4294967295 1 0\n", 2, "4294967294 at most"},
      {"OFF\n3 1 0\n0 0 0\n1 0 x\n0 1 0\n3 0 1 2\n", 4, "expected z coordinate, got \"x\""},
      {"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", 4, "z coordinate, but the line ends"},
      {"OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", 4, "y coordinate is not a finite number"},
      {"OFF\n3 1 0\n0 0 0\n1 0 1e999\n0 1 0\n3 0 1 2\n", 4, "z coordinate is not a finite number"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 6, "vertex index 3 out of range (the file has 3 vertices)"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", 6, "vertex index -1 out of range"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", 6, "vertex index, but the line ends"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n\n# c\n5 0 1 2 0 1\n", 8, "face with 5 corners"},
      {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", 6, "face with 2 corners"},
      {"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\n", 7, "the file ends"},
      {"OFF\r3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 7\r", 6, "vertex index 7"},
  };
  for (const auto& bad : table) expect_refused("a.off", bad.text, bad.line, bad.words);
}

TEST(Off, SaysThatTheFileGoesOn) {
  const Mesh mesh = read_bytes("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n");
  EXPECT_EQ(mesh.elements.size(), 1U);
  EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("line 7")));
}

TEST(Off, EveryBeginning) { expect_truncation_safe("a.off", kPlain); }

// --- binary ---

void append(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((word >> shift) & 0xffU);
}
void append(std::string& bytes, float number) { append(bytes, std::bit_cast<std::uint32_t>(number)); }

std::string binary(std::string header, int extras, std::uint32_t corner) {
  std::string bytes = std::move(header);
  for (const std::uint32_t n : {4U, 2U, 0U}) append(bytes, n);
  const float xyz[4][3] = {{0, 0, 0}, {1, 0, 0.1F}, {1, 1, 0}, {0, 1, 0}};
  for (const auto& p : xyz) {
    for (const float x : p) append(bytes, x);
    for (int i = 0; i < extras; ++i) append(bytes, 0.25F);
  }
  for (const std::uint32_t n : {3U, 0U, 1U, 2U, 0U}) append(bytes, n);
  for (const std::uint32_t n : {4U, 0U, 1U, 2U, corner, 1U}) append(bytes, n);
  append(bytes, 0.5F);
  return bytes;
}

TEST(OffBinary, ReadsAndPatches) {
  for (const auto& [header, extras] :
       {std::pair<const char*, int>{"OFF BINARY\n", 0}, {"CNOFF BINARY\r\n", 7}, {"STOFF BINARY # c\n", 2}}) {
    const std::string bytes = binary(header, extras, 3);
    const Mesh mesh = read_bytes("a.off", bytes);
    ASSERT_EQ(mesh.positions.size(), 4U);
    EXPECT_EQ(mesh.positions[1].z, static_cast<double>(0.1F));
    EXPECT_THAT(corners(mesh, 1), ElementsAre(0, 1, 2, 3));
    EXPECT_EQ(written("a.off", mesh), bytes);

    std::vector<Vec3> positions = mesh.positions;
    positions[2] = {0.3, 1.0, -0.0};
    positions[3].x = 0.25;
    std::vector<std::string> notes;
    const std::string patched = written("a.off", mesh, positions, &notes);
    EXPECT_THAT(notes, ElementsAre(HasSubstr("1 moved coordinates were rounded")));
    ASSERT_EQ(patched.size(), bytes.size());
    positions[2].x = static_cast<double>(0.3F);
    const Mesh again = read_bytes("a.off", patched);
    expect_same_positions(positions, again.positions);
    expect_same_elements(mesh, again);

    positions[0].x = 1e300;
    EXPECT_THROW((void)written("a.off", mesh, positions), OutputError);
  }
}

TEST(OffBinary, Malformed) {
  expect_refused("a.off", binary("OFF BINARY\n", 0, 4), 0, "vertex index 4 of face 1 out of range (the file has 4 vertices)");
  expect_refused("a.off", binary("OFF BINARY\n", 0, 0xffffffffU), 0, "vertex index -1");
  std::string nan = binary("OFF BINARY\n", 0, 3);
  nan.replace(11 + 12, 4, "\x7f\xc0\x01\x01");
  expect_refused("a.off", nan, 0, "vertex 0 is not a finite number");
  std::string counts = binary("OFF BINARY\n", 0, 3);
  counts[11] = '\x7f';
  expect_refused("a.off", counts, 0, "truncated");
  expect_truncation_safe("a.off", binary("OFF BINARY\n", 0, 3));
  const std::string whole = binary("OFF BINARY\n", 0, 3);
  for (std::size_t size = 11; size < whole.size(); ++size) expect_refused("a.off", whole.substr(0, size), 0, "truncated");
}

TEST(Off, RealFiles) {
  const auto files = shared_meshes(".off");
  if (files.empty()) GTEST_SKIP() << "the shared meshes are not here";
  for (const auto& file : files) expect_patched("a.off", get(file), true);
}

TEST(Off, RealCounts) {
  const auto files = shared_meshes(".off");
  if (files.empty()) GTEST_SKIP() << "the shared meshes are not here";
  Progress progress;
  const std::map<std::string, std::array<std::size_t, 2>> counts{
      {"pmp_fandisk.off", {6475, 12946}}, {"pmp_fandisk_quads.off", {766, 764}}, {"vemesh_random_triangles.off", {100, 184}}};
  for (const auto& file : files) {
    const auto known = counts.find(file.filename());
    if (known == counts.end()) continue;
    const Mesh mesh = read_mesh(file, progress);
    EXPECT_EQ(mesh.positions.size(), known->second[0]);
    EXPECT_EQ(mesh.elements.size(), known->second[1]);
  }
}

}  // namespace
}  // namespace dmoscope::test
