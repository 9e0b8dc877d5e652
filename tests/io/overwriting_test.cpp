// Files that a mesh is read from are not overwritten by another mesh; nor are unrelated files beside an output.

#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {
namespace overwriting {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::string_view kSquare = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";

std::vector<std::string> names_of_files(const std::filesystem::path& mesh) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : mesh_files(mesh)) names.push_back(file.filename().string());
  return names;
}

std::vector<std::string> write(const std::filesystem::path& path, const Mesh& mesh, std::size_t pieces = 0) {
  Progress unwatched;
  IoContext context(unwatched);
  context.pieces = pieces;
  return write_mesh(path, mesh, mesh.positions, context);
}

std::string why_not(const std::filesystem::path& path, const Mesh& mesh, std::size_t pieces = 0) {
  try {
    (void)write(path, mesh, pieces);
  } catch (const OutputError& error) {
    return error.what();
  }
  return "written";
}

Mesh read(const std::filesystem::path& path) {
  Progress unwatched;
  return read_mesh(path, unwatched);
}

TEST(MeshFiles, AreAllThatAMeshIsReadFrom) {
  const TemporaryFolder folder;
  EXPECT_THAT(names_of_files(folder / "none.off"), ElementsAre("none.off"));
  EXPECT_THAT(names_of_files(folder / "t.ele"), ElementsAre("t.ele", "t.node"));
  put(folder / "m.mesh", "MeshVersionFormatted 2\n");
  EXPECT_THAT(names_of_files(folder / "m.mesh"), ElementsAre("m.mesh"));
  put(folder / "m.sol", "");
  EXPECT_THAT(names_of_files(folder / "m.mesh"), ElementsAre("m.mesh", "m.sol"));
  put(folder / "renamed.txt", "MeshVersionFormatted 2\n");
  put(folder / "renamed.sol", "");
  EXPECT_THAT(names_of_files(folder / "renamed.txt"), ElementsAre("renamed.txt", "renamed.sol")) << "by what it holds";
  EXPECT_TRUE(same_mesh(folder / "t.ele", folder / "t.node"));
  EXPECT_FALSE(same_mesh(folder / "t.ele", folder / "u.node"));
  EXPECT_TRUE(may_write(folder / "t.ele", folder / "t.node"));
  EXPECT_FALSE(may_write(folder / "t.csv", folder / "t.node"));
  EXPECT_EQ(replaced_file(folder / "m.sol", folder / "m.mesh"), folder / "m.sol");
  EXPECT_EQ(replaced_file("", folder / "m.mesh"), "");
#ifdef DMOSCOPE_VTU
  put(folder / "x.xdmf",
      "<Xdmf><Domain><Grid><Geometry><DataItem Format=\"HDF\">n.h5:/a</DataItem></Geometry>"
      "<Topology><DataItem Format=\"HDF\">n.h5:/b</DataItem></Topology></Grid></Domain></Xdmf>");
  EXPECT_THAT(names_of_files(folder / "x.xdmf"), ElementsAre("x.xdmf", "n.h5"));
  EXPECT_TRUE(may_write(folder / "x.xdmf", folder / "x.h5"));
  EXPECT_TRUE(may_write(folder / "q.pvtu", folder / "q_12.vtu"));
  for (const char* other : {"q_.vtu", "q_1a.vtu", "r_1.vtu", "q_1.vtk"})
    EXPECT_FALSE(may_write(folder / "q.pvtu", folder / other)) << other;
#endif
}

TEST(WriteMesh, LeavesTheOtherHalfOfAPairThatIsNotThere) {
  const TemporaryFolder folder;
  const Mesh mesh = read_bytes("a.off", kSquare);
  put(folder / "t.node", "points of another program");
  EXPECT_THAT(why_not(folder / "t.ele", mesh), HasSubstr("t.node: it is no part of t.ele"));
  EXPECT_EQ(get(folder / "t.node"), "points of another program");
  EXPECT_FALSE(std::filesystem::exists(folder / "t.ele"));
  EXPECT_EQ(why_not(folder / "t.node", mesh), "written") << "what is named is replaced";
  EXPECT_EQ(why_not(folder / "t.ele", mesh), "written") << "and the pair then, by either name";
}

TEST(WriteMesh, AFileOfAnUnusualNameStaysOfItsFormat) {
  const TemporaryFolder folder;
  constexpr std::string_view kCalculix =
      "*NODE, NSET=Nall\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n*ELEMENT, TYPE=CPS4, ELSET=Eall\n1,1,2,3,4\n";
  put(folder / "c.msh", kCalculix);
  const Mesh mesh = read(folder / "c.msh");
  EXPECT_EQ(written_format("other.msh", mesh)->name, "abaqus");
  EXPECT_EQ(written_format("other.inp", mesh)->name, "abaqus");
  EXPECT_EQ(written_format("other.off", mesh)->name, "off");
  EXPECT_EQ(written_format("other.zzz", mesh), nullptr);
  for (const char* name : {"c.msh", "copy.MSH"}) {
    EXPECT_THAT(write(folder / name, mesh), Contains("Written as Abaqus, which c.msh is."));
    EXPECT_EQ(get(folder / name), kCalculix);
  }
}

#ifdef DMOSCOPE_VTU
TEST(WriteMesh, ReplacesNoPieceThatTheMeshWasReadFrom) {
  const TemporaryFolder folder;
  (void)write(folder / "q.pvtu", read_bytes("a.off", kSquare), 2);
  EXPECT_THAT(names_of_files(folder / "q.pvtu"), ElementsAre("q.pvtu", "q_0.vtu", "q_1.vtu"));
  const std::string piece = get(folder / "q_1.vtu");
  const Mesh mesh = read(folder / "q.pvtu");
  EXPECT_THAT(why_not(folder / "q_1.vtu", mesh), HasSubstr("q_1.vtu, which would be replaced"));
  std::filesystem::copy_file(folder / "q.pvtu", folder / "other.pvtu");
  EXPECT_THAT(why_not(folder / "q.pvtu", read(folder / "other.pvtu"), 1), HasSubstr("which would be replaced"));
  EXPECT_THAT(why_not(folder / "q.pvtu", read(folder / "q_1.vtu"), 1), HasSubstr("which would be replaced"));
  EXPECT_EQ(get(folder / "q_1.vtu"), piece);
  EXPECT_EQ(why_not(folder / "q.pvtu", mesh, 2), "written") << "to where it was";
}

TEST(WriteMesh, PiecesOfOthersStayAndOldOnesGo) {
  const TemporaryFolder folder;
  const Mesh mesh = read_bytes("a.off", kSquare);
  put(folder / "q_1.vtu", "of somebody else");
  EXPECT_THAT(why_not(folder / "q.pvtu", mesh, 2), HasSubstr("q_1.vtu: it is no part of q.pvtu"));
  EXPECT_EQ(get(folder / "q_1.vtu"), "of somebody else");
  EXPECT_FALSE(std::filesystem::exists(folder / "q_0.vtu"));
  EXPECT_THAT(write(folder / "q.pvtu", mesh, 1), IsEmpty()) << "it is not in the way";
  EXPECT_EQ(get(folder / "q_1.vtu"), "of somebody else");
  std::filesystem::remove(folder / "q_1.vtu");
  (void)write(folder / "q.pvtu", mesh, 2);
  EXPECT_THAT(write(folder / "q.pvtu", mesh, 1), Contains("Removed: q_1.vtu, of the mesh that was replaced."));
  EXPECT_FALSE(std::filesystem::exists(folder / "q_1.vtu"));
  EXPECT_EQ(read(folder / "q.pvtu").elements.size(), 2U);
  std::filesystem::rename(folder / "q_0.vtu", folder / "part.vtu");
  std::string text = get(folder / "q.pvtu");
  text.replace(text.find("q_0"), 3, "part");
  put(folder / "q.pvtu", text);
  EXPECT_THAT(write(folder / "q.pvtu", mesh, 1), Contains("Left: part.vtu, of the mesh that was replaced."));
  EXPECT_TRUE(std::filesystem::exists(folder / "part.vtu"));
}
#endif

}  // namespace overwriting
}  // namespace
}  // namespace dmoscope::test
