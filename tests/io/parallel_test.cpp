// Reading and writing with threads gives the meshes, bytes, notes and errors of one thread.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/line_chunks.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/generate.h"
#include "core/mesh/random.h"
#include "tests/io/files.h"
#include "tests/support/sanitized.h"

namespace dmoscope::test {
namespace {

using testing::HasSubstr;

/// Some hundred thousand lines: many chunks of any kind.
constexpr std::size_t kLarge = testing::kSanitized ? 25000 : 60000;
const Mesh& large() {
  static const Mesh mesh = [] {
    Progress progress;
    return generate_mesh("mixed", kLarge, 3, progress);
  }();
  return mesh;
}

std::vector<Vec3> shaken(const Mesh& mesh) {
  std::vector<Vec3> positions = mesh.positions;
  Random random(5);
  for (Vec3& p : positions) {
    if (random.below(3) > 0) p = {p.x + 0.01 * random.unit(), p.y - 0.01 * random.unit(), p.z};
  }
  return positions;
}

std::string off_text(const Mesh& mesh) { return written("a.off", mesh, shaken(mesh)); }

/// The text with its n-th line (from 1) replaced.
std::string with_line(const std::string& text, std::size_t n, std::string_view line) {
  std::size_t begin = 0;
  for (std::size_t i = 1; i < n; ++i) begin = text.find('\n', begin) + 1;
  return std::string(text).replace(begin, text.find('\n', begin) - begin, line);
}

void expect_same_meshes(const Mesh& expected, const Mesh& found) {
  expect_same_positions(expected.positions, found.positions);
  expect_same_elements(expected, found);
  ASSERT_EQ(found.source->place_count(), expected.source->place_count());
  for (std::size_t i = 0; i < expected.source->place_count(); ++i) ASSERT_EQ(found.source->place(i), expected.source->place(i));
  EXPECT_EQ(found.source->notes(), expected.source->notes());
  EXPECT_EQ(found.source->only_in_file(), expected.source->only_in_file());
}

TEST(Threads, WriteTheSameBytes) {
  const TemporaryFolder folder;
  Progress progress;
  ThreadPool pool(3);
  Mesh mesh = large();
  for (const std::string name : {"a.off", "a.obj", "a.14", "a.su2", "a.vtk", "a.ply", "a.msh", "a.mesh"}) {
    const std::string alone = written(name, mesh, shaken(mesh));
    write_mesh(folder / name, mesh, shaken(mesh), {progress, &pool});
    EXPECT_TRUE(get(folder / name) == alone) << name << " made anew";

    const Mesh from_file = read_bytes(name, alone);
    const std::vector<Vec3> positions = shaken(from_file);
    write_mesh(folder / name, from_file, positions, {progress, &pool});
    EXPECT_TRUE(get(folder / name) == written(name, from_file, positions)) << name << " patched";
  }
}

TEST(Threads, NameTheFirstWrongVertexAndKeepTheOldFile) {
  const Mesh mesh = read_bytes("a.14", written("a.14", large()));
  const TemporaryFolder folder;
  put(folder / "a.14", "old");
  std::vector<Vec3> positions = mesh.positions;
  positions[kLarge - 1000].z = positions[22000].z = positions[20001].z = 1.0;
  Progress progress;
  for (const unsigned threads : {1U, 2U, 5U}) {
    ThreadPool pool(threads);
    try {
      write_mesh(folder / "a.14", mesh, positions, {progress, &pool});
      ADD_FAILURE() << "nothing was thrown";
    } catch (const OutputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("vertex 20001 has z = 1"));
    }
    EXPECT_EQ(get(folder / "a.14"), "old");
  }
  progress.request_cancel();
  ThreadPool pool(3);
  EXPECT_THROW((void)write_mesh(folder / "a.14", mesh, mesh.positions, {progress, &pool}), Cancelled);
  EXPECT_EQ(get(folder / "a.14"), "old");
}

TEST(Threads, ReadTheSameMesh) {
  const TemporaryFolder folder;
  Progress progress;
  const std::string plain = off_text(large());
  std::string commented;  // with comments, empty lines, more numbers, and other line ends
  Random random(9);
  for (std::size_t begin = 0; begin < plain.size();) {
    const std::size_t end = plain.find('\n', begin);
    commented.append(plain, begin, end - begin);
    if (begin > 100 && random.below(50) == 0) commented += " 0.5 # a colour";
    if (random.below(50) == 0) commented += "\n\n# nothing here";
    commented += random.below(2) == 0 ? "\r\n" : "\n";
    begin = end + 1;
  }
  for (const std::string& text : {plain, commented, plain + "3 0 1 2\n", plain.substr(0, plain.size() - 1)}) {
    put(folder / "a.off", text);
    const Mesh alone = read_mesh(folder / "a.off", progress);
    for (const unsigned threads : {1U, 2U, 5U}) {
      ThreadPool pool(threads);
      expect_same_meshes(alone, read_mesh(folder / "a.off", {progress, &pool}));
    }
  }
}

TEST(Threads, FindTheFirstErrorOfTheFile) {
  const TemporaryFolder folder;
  Progress progress;
  ThreadPool pool(3);
  const std::string text = off_text(large());
  const auto complaint = [&](const IoContext& context) -> std::string {
    try {
      (void)read_mesh(folder / "a.off", context);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const auto vertices = large().positions.size();
  for (const std::size_t line : {std::size_t{5}, vertices / 2, vertices, vertices + 20, vertices + kLarge / 2}) {
    put(folder / "a.off", with_line(with_line(text, line, "0 x 1"), line + 30, "3 0"));
    EXPECT_THAT(complaint({progress, &pool}), HasSubstr("a.off:" + std::to_string(line) + ": ")) << line;
    EXPECT_EQ(complaint({progress, &pool}), complaint(progress));
  }
  put(folder / "a.off", text.substr(0, text.size() - 100));
  EXPECT_THAT(complaint({progress, &pool}), HasSubstr(complaint(progress)));
  progress.request_cancel();
  EXPECT_THROW((void)read_mesh(folder / "a.off", {progress, &pool}), Cancelled);
}

TEST(LineChunks, EndAfterLineFeeds) {
  const std::string text = "ab\ncdef\n\nghij\nklmnopqrstuvwxyz";
  const std::vector<LineChunk> chunks = next_chunks(text, 0, 4, 10);
  ASSERT_EQ(chunks.size(), 2U);
  EXPECT_EQ(text.substr(chunks[0].begin, chunks[0].end - chunks[0].begin), "ab\ncdef\n");
  EXPECT_EQ(text.substr(chunks[1].begin, chunks[1].end - chunks[1].begin), "\nghij\n");
  EXPECT_EQ(next_chunks(text, 0, 4, 1).size(), 1U);
  EXPECT_TRUE(next_chunks(text, 0, 1000, 10).empty());
  EXPECT_TRUE(next_chunks("0 0 0\r1 0 0\r", 0, 4, 10).empty());
}

}  // namespace
}  // namespace dmoscope::test
