// Properties of all formats: detection, refusals, all-or-nothing writing, notes.

#include "core/io/mesh_io.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/io/writing/atomic_file.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using testing::HasSubstr;

constexpr std::string_view kOff = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

template <class Error, class Function>
std::string message(Function&& function) {
  try {
    function();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

TEST(ReadMesh, RefusesWhatIsNoMesh) {
  const TemporaryFolder folder;
  Progress progress;
  const auto why = [&](const std::string& name) { return message<InputError>([&] { (void)read_mesh(folder / name, progress); }); };
  EXPECT_THAT(why("missing.off"), HasSubstr("No such file"));
  std::filesystem::create_directory(folder / "directory.off");
  EXPECT_THAT(why("directory.off"), HasSubstr("directory"));
  put(folder / "empty.off", "");
  EXPECT_THAT(why("empty.off"), HasSubstr("empty"));
  put(folder / "picture.png", "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(why("picture.png"), testing::AllOf(HasSubstr("unknown format"), HasSubstr("off"), HasSubstr("fort14"), HasSubstr(".grd")));
  put(folder / "no_extension", "hello");
  EXPECT_THAT(why("no_extension"), HasSubstr("unknown format"));
  std::string garbage;
  for (int i = 0; i < 4096; ++i) garbage += static_cast<char>(i * 7 + i / 256);
  for (const FormatInfo& format : format_table()) {
    const std::string name = "garbage" + std::string(format.extensions.substr(0, format.extensions.find(' ')));
    put(folder / name, garbage);
    EXPECT_THAT(why(name), HasSubstr(name));
  }
}

TEST(ReadMesh, RefusesMeshesWithNothingInThem) {
  expect_refused("a.off", "OFF\n0 0 0\n", 0, "no vertices");
  expect_refused("a.off", "OFF\n1 0 0\n0 0 0\n", 0, "no elements");
  expect_refused("a.obj", "v 0 0 0\n", 0, "no elements");
}

TEST(ReadMesh, GoesByContentWhereThatIsCertain) {
  EXPECT_EQ(read_bytes("mesh.txt", kOff).elements.size(), 2U);
  EXPECT_EQ(read_bytes("mesh.14", kOff).elements.size(), 2U);
  EXPECT_EQ(read_bytes("MESH.OFF", kOff).name, "MESH.OFF");
  // a title is no proof
  const Mesh grid = read_bytes("mesh.14", "OFF coast\n1 3\n1 0 0 5\n2 1 0 5\n3 0 1 5\n1 3 1 2 3\n");
  EXPECT_EQ(grid.title, "OFF coast");
}

TEST(ReadMesh, CanBeCancelled) {
  const TemporaryFolder folder;
  put(folder / "a.off", kOff);
  Progress progress;
  progress.request_cancel();
  EXPECT_THROW((void)read_mesh(folder / "a.off", progress), Cancelled);
}

TEST(WriteMesh, RefusesUnknownExtensions) {
  const Mesh mesh = read_bytes("a.off", kOff);
  const TemporaryFolder folder;
  Progress progress;
  EXPECT_THAT(message<UsageError>([&] { (void)write_mesh(folder / "a.xyz", mesh, mesh.positions, progress); }), HasSubstr(".xyz"));
  EXPECT_THROW((void)write_mesh(folder / "a", mesh, mesh.positions, progress), UsageError);
  EXPECT_THROW((void)write_mesh(folder / "a.off", mesh, std::span(mesh.positions).first(3), progress), UsageError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(WriteMesh, RefusesPositionsThatAreNotFinite) {
  const Mesh mesh = read_bytes("a.off", kOff);
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    std::vector<Vec3> positions = mesh.positions;
    positions[2].y = bad;
    for (const char* name : {"a.off", "a.obj"}) EXPECT_THROW((void)written(name, mesh, positions), OutputError);
  }
}

TEST(WriteMesh, KeepsTheOldFileWhenItFails) {
  Mesh mesh = read_bytes("a.off", kOff);
  mesh.positions[1].z = 1.0;  // fort.14 cannot hold it
  const TemporaryFolder folder;
  put(folder / "old.14", "old");
  Progress progress;
  EXPECT_THROW((void)write_mesh(folder / "old.14", mesh, mesh.positions, progress), OutputError);
  EXPECT_EQ(get(folder / "old.14"), "old");
  progress.request_cancel();
  EXPECT_THROW((void)write_mesh(folder / "old.14", mesh, mesh.positions, progress), Error);
  EXPECT_EQ(get(folder / "old.14"), "old");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteMesh, SaysWhyATargetCannotBeWritten) {
  const Mesh mesh = read_bytes("a.off", kOff);
  const TemporaryFolder folder;
  Progress progress;
  std::filesystem::create_directory(folder / "d.off");
  EXPECT_THAT(message<OutputError>([&] { (void)write_mesh(folder / "d.off", mesh, mesh.positions, progress); }), HasSubstr("directory"));
  EXPECT_THAT(message<OutputError>([&] { (void)write_mesh(folder / "none" / "a.off", mesh, mesh.positions, progress); }),
              HasSubstr("No such file"));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "d.off"));
}

TEST(WriteMesh, UndoesTheFlipOfFlippedElements) {
  constexpr std::string_view kObj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 3 2 1\n";
  Mesh mesh = read_bytes("a.obj", kObj);
  mesh.elements.flip(1);
  mesh.flipped = {0, 1};
  const Mesh again = read_bytes("b.off", written("b.off", mesh));
  EXPECT_THAT(std::vector<Index>(again.elements.all_corners().begin(), again.elements.all_corners().end()),
              testing::ElementsAre(0, 1, 2, 3, 2, 1, 0));
  EXPECT_EQ(written("a.obj", mesh), kObj);
}

/// A mesh with one element of each kind, volume elements and surface elements separately; corners of the cube, whose apex is vertex 8.
Mesh one_of_each_kind(int dimension) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2}};
  if (dimension == 2) {
    for (Vec3& p : mesh.positions) p.z = 0;
    mesh.elements.add(ElementKind::Triangle, std::vector<Index>{0, 1, 2});
    mesh.elements.add(ElementKind::Quadrilateral, std::vector<Index>{0, 1, 2, 3});
  } else {
    mesh.elements.add(ElementKind::Tetrahedron, std::vector<Index>{0, 1, 3, 4});
    mesh.elements.add(ElementKind::Hexahedron, std::vector<Index>{0, 1, 2, 3, 4, 5, 6, 7});
    mesh.elements.add(ElementKind::Wedge, std::vector<Index>{0, 1, 2, 4, 5, 6});
    mesh.elements.add(ElementKind::Pyramid, std::vector<Index>{4, 5, 6, 7, 8});
  }
  return mesh;
}

/// The corners of the mesh's one element of this kind.
std::vector<Index> corners_of_kind(const Mesh& mesh, ElementKind kind) {
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    const auto corners = mesh.elements.corners(e);
    if (mesh.elements.kind(e) == kind) return {corners.begin(), corners.end()};
  }
  return {};
}

/// Flips are undone, except of volume elements, which are written as they are, with a note.
TEST(WriteMesh, EveryFormatUndoesTheFlipOfEveryKindOfThePlane) {
  int kinds_written = 0;
  for (const int dimension : {2, 3}) {
    const Mesh mesh = one_of_each_kind(dimension);
    Mesh turned = mesh;
    turned.flipped.assign(mesh.elements.size(), 1);
    for (Index e = 0; e < mesh.elements.size(); ++e) turned.elements.flip(e);
    for (const FormatInfo& format : format_table()) {
      if (format.name == "stl") continue;  // has triangles alone, and no vertices of its own
      SCOPED_TRACE(format.name);
      const TemporaryFolder folder;
      std::string name("a");
      name += format.extensions.substr(0, format.extensions.find(' '));
      Progress progress;
      try {
        const auto notes = write_mesh(folder / name, turned, turned.positions, progress);
        if (dimension == 3) {
          EXPECT_THAT(notes, testing::Contains(HasSubstr("4 elements that were wound inside out")));
        }
      } catch (const OutputError&) {
        continue;  // cannot hold these kinds
      }
      const Mesh again = read_mesh(folder / name, progress);
      EXPECT_EQ(again.elements.size(), mesh.elements.size());
      for (const ElementKind kind : mesh.elements.kinds()) {
        EXPECT_EQ(corners_of_kind(again, kind), corners_of_kind(dimension == 2 ? mesh : turned, kind)) << info(kind).name;
        ++kinds_written;
      }
    }
  }
  EXPECT_GE(kinds_written, 5 * 2 + 2 * 4) << "five formats of surfaces, two of volumes at least";
}

TEST(WriteMesh, FreshFilesHoldEveryDouble) {
  Mesh mesh = read_bytes("a.off", kOff);
  mesh.source.reset();
  for (const char* name : {"a.off", "a.obj"}) {
    const std::vector<Vec3> positions = moved(mesh, 1, true, 7);
    expect_same_positions(positions, read_bytes(name, written(name, mesh, positions)).positions);
  }
  for (const char* name : {"a.14", "a.su2", "a.grd"}) {
    const std::vector<Vec3> positions = moved(mesh, 1, false, 8);
    const Mesh again = read_bytes(name, written(name, mesh, positions));
    expect_same_positions(positions, again.positions);
    expect_same_elements(mesh, again);
  }
}

TEST(WriteMesh, NamesWhatIsDropped) {
  std::vector<std::string> notes;
  const Mesh colours = read_bytes("a.off", "COFF # c\n3 1 0\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2 255 0 0\n");
  (void)written("a.obj", colours, colours.positions, &notes);
  EXPECT_THAT(notes, testing::UnorderedElementsAre(HasSubstr("vertex colours"), HasSubstr("face colours"), HasSubstr("comments")));

  const Mesh grid = read_bytes("a.14", "t\n1 3\n1 0 0 5\n2 1 0 5\n3 0 1 5\n1 3 1 2 3\n1\n2\n2 0\n1\n2\n0\n0\n");
  (void)written("a.off", grid, grid.positions, &notes);
  EXPECT_THAT(notes, testing::UnorderedElementsAre(HasSubstr("field \"depth\""), HasSubstr("\"open boundary 1\"")));

  const Mesh off = read_bytes("a.off", kOff);
  (void)written("a.14", off, off.positions, &notes);
  EXPECT_THAT(notes, testing::ElementsAre(HasSubstr("no depth")));
}

TEST(WriteMesh, NamesEqualKindsInOneSentence) {
  Mesh mesh = read_bytes("a.off", kOff);
  mesh.source.reset();
  for (const char* name : {"a", "b", "c", "d", "e"}) {
    mesh.groups.push_back({.name = name, .role = "land boundary", .code = 0, .dimension = 0, .members = {0}});
  }
  mesh.groups.push_back({.name = "sea", .role = "open boundary", .code = 0, .dimension = 0, .members = {0}});
  std::vector<std::string> notes;
  (void)written("a.off", mesh, mesh.positions, &notes);
  EXPECT_THAT(notes,
              testing::UnorderedElementsAre(HasSubstr("land boundary \"a\", \"b\", \"c\" and 2 more"), HasSubstr("open boundary \"sea\"")));
}

TEST(WriteMesh, FilesOfTwoCoordinatesRefuseAThird) {
  for (const auto& [name, text] : {std::pair<std::string_view, std::string_view>{"a.14", "t\n1 3\n1 0 0 5\n2 1 0 5\n3 0 1 5\n1 3 1 2 3\n"},
                                   {"a.su2", "NDIME= 2\nNELEM= 1\n5 0 1 2\nNPOIN= 3\n0 0\n1 0\n0 1\n"}}) {
    Mesh mesh = read_bytes(name, text);
    std::vector<Vec3> positions = mesh.positions;
    positions[1].z = 1e-300;
    EXPECT_THROW((void)written(name, mesh, positions), OutputError);  // written into the file's own text
    mesh.source.reset();
    EXPECT_THROW((void)written(name, mesh, positions), OutputError);  // written anew
    std::vector<std::string> notes;
    for (Vec3& p : positions) p.z = 2.5;
    (void)written(name, mesh, positions, &notes);
    EXPECT_THAT(notes, testing::Contains(HasSubstr("z = 2.5")));
  }
}

TEST(WriteMesh, SurfaceFormatsRefuseVolumes) {
  const Mesh mesh = read_bytes("a.su2", "NDIME= 3\nNELEM= 1\n10 0 1 2 3\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  for (const char* name : {"a.off", "a.obj", "a.14"}) EXPECT_THROW((void)written(name, mesh), OutputError);
}

TEST(WriteFileAtomically, KeepsPermissionsAndLinks) {
  const TemporaryFolder folder;
  put(folder / "real.txt", "old");
  ASSERT_EQ(::chmod((folder / "real.txt").c_str(), 0640), 0);
  std::filesystem::create_symlink("real.txt", folder / "link.txt");
  write_file_atomically(folder / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
  EXPECT_EQ(get(folder / "real.txt"), "new");
  struct stat status {};
  ASSERT_EQ(::stat((folder / "real.txt").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0640U);
  std::filesystem::create_symlink("later.txt", folder / "dangling.txt");
  write_file_atomically(folder / "dangling.txt", "x");
  EXPECT_EQ(get(folder / "later.txt"), "x");
  EXPECT_NO_THROW(write_file_atomically("/dev/null", "gone"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(WriteFileAtomically, TellsOfAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  EXPECT_THAT(message<OutputError>([] { write_file_atomically("/dev/full", "x"); }), HasSubstr("space"));
}

TEST(WriteFileAtomically, TakesTheLongestName) {
  const TemporaryFolder folder;
  const std::string name(255, 'n');
  write_file_atomically(folder / name, "x");
  EXPECT_EQ(get(folder / name), "x");
}

}  // namespace
}  // namespace dmoscope::test
