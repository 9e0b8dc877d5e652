// Files are replaced as a whole, with their companions, and litter of killed processes is removed.

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include "core/base/error.h"
#include "core/io/format.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
namespace fs = std::filesystem;

constexpr std::string_view kOneTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

TEST(AtomicFile, CleansWhatDeadProcessesLeftAndNothingElse) {
  const TemporaryFolder folder;
  put(folder / ".dmoscope-7-0.tmp", "half");
  put(folder / ".dmoscope-7-12.tmp", "half");
  const std::vector<std::string> others{".dmoscope-7-.tmp", ".dmoscope-7.tmp", ".dmoscope-a-1.tmp", ".dmoscope-7-1.tmp.bak", "x.tmp"};
  for (const std::string& other : others) put(folder / other, "mine");
  fs::create_directory(folder / ".dmoscope-7-3.tmp");
  put(folder / ".dmoscope-7-4.tmp", "of a process that writes it just now");
  const int locked = ::open((folder / ".dmoscope-7-4.tmp").c_str(), O_WRONLY);
  ASSERT_EQ(::flock(locked, LOCK_EX | LOCK_NB), 0);
  AtomicFile under_way(folder / "slow.txt");
  under_way.write("slow");
  write_file_atomically(folder / "new.txt", "new");
  ::close(locked);
  under_way.commit();
  std::vector<std::string> expected = others;
  for (const char* name : {".dmoscope-7-3.tmp", ".dmoscope-7-4.tmp", "new.txt", "slow.txt"}) expected.emplace_back(name);
  std::ranges::sort(expected);
  EXPECT_EQ(names_in(folder.path()), expected);
  EXPECT_EQ(get(folder / "slow.txt"), "slow");
  EXPECT_TRUE(is_litter_name(litter_name(123, 4)));
}

TEST(AtomicFile, IsNotTakenForLitterByThoseWhoCleanUpMeanwhile) {
  const TemporaryFolder folder;
  std::atomic<bool> over{false};
  const auto clean = [&] {
    while (!over) remove_litter(folder.path());
  };
  std::jthread first(clean), second(clean);
  int lost = 0;
  for (int i = 0; i < 8000; ++i) {
    const AtomicFile file(folder / "a.txt");
    if (fs::is_empty(folder.path())) ++lost;
  }
  over = true;
  EXPECT_EQ(lost, 0);
}

TEST(AtomicFile, RefusesALoopOfLinks) {
  const TemporaryFolder folder;
  fs::create_symlink("b.txt", folder / "a.txt");
  fs::create_symlink("a.txt", folder / "b.txt");
  EXPECT_THROW(write_file_atomically(folder / "a.txt", "x"), OutputError);
  EXPECT_TRUE(fs::is_symlink(folder / "a.txt"));
  EXPECT_TRUE(fs::is_symlink(folder / "b.txt"));
}

TEST(AtomicFile, KeepsExtendedAttributes) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  put(path, "old");
  if (::setxattr(path.c_str(), "user.origin", "survey", 6, 0) != 0) GTEST_SKIP() << "this file system has no extended attributes";
  write_file_atomically(path, "new");
  std::string value(16, '\0');
  const ssize_t size = ::getxattr(path.c_str(), "user.origin", value.data(), value.size());
  ASSERT_EQ(size, 6);
  EXPECT_EQ(value.substr(0, 6), "survey");
}

TEST(AtomicFile, KeepsOwnerAndGroupWhereItMay) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root gives files away";
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  ASSERT_EQ(::chown((folder / "a.txt").c_str(), 1234, 2345), 0);
  write_file_atomically(folder / "a.txt", "new");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "a.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 1234U);
  EXPECT_EQ(status.st_gid, 2345U);
}

TEST(AtomicFiles, NoneIsReplacedWhereOneCannotBeWritten) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  {
    AtomicFiles files;
    files.add(folder / "a.txt", "new");
    EXPECT_THROW(files.add("/dev/full", "new"), OutputError);
  }
  EXPECT_EQ(get(folder / "a.txt"), "old");
  EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.txt"});
}

TEST(WriteMesh, SaysThatOtherNamesOfAFileKeepTheOldOne) {
  const TemporaryFolder folder;
  put(folder / "a.off", kOneTriangle);
  fs::create_hard_link(folder / "a.off", folder / "b.off");
  Progress progress;
  const Mesh mesh = read_mesh(folder / "a.off", progress);
  std::vector<Vec3> moved = mesh.positions;
  moved[0].x = 0.25;
  EXPECT_THAT(write_mesh(folder / "a.off", mesh, moved, progress), Contains(HasSubstr("2 names (hard links)")));
  EXPECT_EQ(get(folder / "b.off"), kOneTriangle);
  EXPECT_THAT(write_mesh(folder / "a.off", mesh, moved, progress), Not(Contains(HasSubstr("names"))));
}

TEST(ReadMesh, RefusesPipesAndDevicesByName) {
  const TemporaryFolder folder;
  const fs::path pipe = folder / "pipe.off";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  Progress progress;
  const auto why = [&](const fs::path& path) {
    try {
      (void)read_mesh(path, progress);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(why(pipe), HasSubstr("pipe.off: a pipe is no file"));
  EXPECT_THAT(why("/dev/zero"), HasSubstr("/dev/zero: a device is no file"));
}

TEST(SourceFile, AddsAThingOnceInOrder) {
  SourceFile source("a.ply", FileBytes("x"));
  for (int round = 0; round < 2; ++round)
    for (int i = 0; i < 50000; ++i) source.add_only_in_file("element " + std::to_string(i));  // takes hours if each is compared with all
  ASSERT_EQ(source.only_in_file().size(), 50000U);
  EXPECT_EQ(source.only_in_file()[49999], "element 49999");
}

/// A square with one field on its vertices, one of whose values is not a number.
Mesh with_gap(double gap) {
  Mesh mesh = read_bytes("a.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  mesh.source.reset();
  mesh.fields.push_back(
      {.name = "depth", .on = Field::On::Vertices, .components = 1, .type = "double", .role = "", .values = {1, gap, 3, 4}});
  return mesh;
}

TEST(WriteMesh, FieldsWithoutANumberAreRefusedDroppedInWordsOrReadBack) {
  for (const double gap : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const Mesh mesh = with_gap(gap);
    for (const FormatInfo& format : format_table()) {
      if (!is_made_anew(format)) continue;
      const std::string name = "a" + std::string(format.extensions.substr(0, format.extensions.find(' ')));
      SCOPED_TRACE(name);
      const TemporaryFolder folder;
      Progress progress;
      std::vector<std::string> notes;
      try {
        notes = write_mesh(folder / name, mesh, mesh.positions, progress);
      } catch (const OutputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("depth"));
        continue;
      }
      Mesh again;
      ASSERT_NO_THROW(again = read_mesh(folder / name, progress));
      if (again.fields.empty()) {
        EXPECT_THAT(notes, Contains(HasSubstr("depth")));
      } else {
        const double value = again.fields[0].values.at(1);
        const bool told =
            std::ranges::any_of(notes, [](const std::string& note) { return note.find("is no number") != std::string::npos; });
        EXPECT_TRUE(value == gap || (std::isnan(value) && std::isnan(gap)) || told) << value;
      }
    }
  }
}

TEST(WriteMesh, TitlesThatNoFileHasAreReadBack) {
  Mesh mesh = read_bytes("a.off", kOneTriangle);
  mesh.source.reset();
  mesh.title = std::string("solid\0\r\n\x1b[31m", 13);
  mesh.name = "a\nb.off";
  for (const FormatInfo& format : format_table()) {
    if (!is_made_anew(format)) continue;
    const std::string name = "a" + std::string(format.extensions.substr(0, format.extensions.find(' ')));
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    Progress progress;
    (void)write_mesh(folder / name, mesh, mesh.positions, progress);
    Mesh again;
    EXPECT_NO_THROW(again = read_mesh(folder / name, progress));
    EXPECT_EQ(again.elements.size(), 1U);
    mesh.title.clear();
    (void)write_mesh(folder / name, mesh, mesh.positions, progress);
    EXPECT_NO_THROW(again = read_mesh(folder / name, progress));
    mesh.title = std::string("solid\0\r\n\x1b[31m", 13);
  }
}

TEST(WriteMesh, ACommentStandsWhereAFormatHasThemAndIsReadOver) {
  const Mesh original = read_bytes("a.off", kOneTriangle);
  for (const FormatHandler* const handler : format_handlers()) {
    const FormatInfo& format = handler->info;
    if (!is_made_anew(format)) continue;
    const std::string name = "a" + std::string(format.extensions.substr(0, format.extensions.find(' ')));
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    Progress progress;
    Mesh mesh = original;
    mesh.source.reset();
    for (int round = 1; round <= 2; ++round) {  // a new file, then the same file
      const auto notes = write_commented_mesh(folder / name, mesh, mesh.positions, progress, "made--by a\ntest $End");
      const bool has = !handler->comment.begin.empty();
      const std::string bytes = get(folder / name);
      EXPECT_EQ(has, notes.empty() || notes.back().find("Provenance was not written") == std::string::npos);
      std::size_t found = 0;
      for (std::size_t at = bytes.find("by a test"); at != std::string::npos; at = bytes.find("by a test", at + 1)) ++found;
      EXPECT_EQ(found, has ? static_cast<std::size_t>(round) : 0U);
      ASSERT_NO_THROW(mesh = read_mesh(folder / name, progress));
      EXPECT_EQ(mesh.elements.size(), 1U);
      expect_same_positions(original.positions, mesh.positions);
    }
  }
}

TEST(UnpackBudget, GrowsWithTheFileUnlessSomebodySaysHowMuch) {
  UnpackBudget small(1000, 0);
  EXPECT_TRUE(small.take(256U << 20U));
  EXPECT_FALSE(small.take(1));
  UnpackBudget large(std::size_t{100} << 20U, 0);
  EXPECT_TRUE(large.take(std::uint64_t{100} * 100 << 20U));
  EXPECT_FALSE(large.take(1));
  UnpackBudget said(1000, 5000);
  EXPECT_FALSE(said.take(5001));
  EXPECT_TRUE(said.take(5000));
}

}  // namespace
}  // namespace dmoscope::test
