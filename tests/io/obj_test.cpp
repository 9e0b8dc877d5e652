#include <algorithm>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::string_view kAll =
    "# a comment\n"
    "mtllib my file.mtl\n"
    "o Thing\n"
    "v 0 0 0\n"
    "v 1.0 0 0 1.0\n"
    "v 1 1 0 0.5 0.5 0.5\n"
    "vt 0 0\n"
    "vt 1 0\n"
    "vn 0 0 1\n"
    "v 0 \\\n  1 0\n"
    "usemtl a#b\n"
    "g left right\n"
    "s off\n"
    "f 1/1 2/2 3/1 4/2\n"
    "v 2 0 0\n"
    "f 2//1 5//1 3//1\n"
    "f -5/1/1 -4/2/1 \\\r\n -1/1/1\n"
    "l 1 2\n"
    "p 1\n"
    "f 6 1 2\n"
    "v 9 9 9\n";

TEST(Obj, AllThatRealFilesHold) {
  const Mesh mesh = read_bytes("a.obj", kAll);
  ASSERT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.positions[3], (Vec3{0, 1, 0}));
  ASSERT_EQ(mesh.elements.size(), 4U);
  EXPECT_THAT(corners(mesh, 0), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(corners(mesh, 1), ElementsAre(1, 4, 2));
  EXPECT_THAT(corners(mesh, 2), ElementsAre(0, 1, 4));
  EXPECT_THAT(corners(mesh, 3), ElementsAre(5, 0, 1));  // the face names a vertex of a later line
  EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("1 line elements"), HasSubstr("1 point elements")));
  std::vector<std::string> notes;
  (void)written("a.off", mesh, mesh.positions, &notes);
  for (const char* thing : {"texture coordinates", "normals", "materials", "object names", "group names", "smoothing groups", "comments",
                            "line elements", "point elements", "vertex colours"}) {
    EXPECT_THAT(notes, testing::Contains(HasSubstr(thing)));
  }
}

TEST(Obj, EveryByteButTheMovedStays) {
  expect_patched("a.obj", kAll, true);
  std::string crlf;
  for (const char c : std::string_view("v 0 0 0\nv 1 0 0 # c\n\nv 0 1 0\nf 1 2 3\n")) crlf += c == '\n' ? "\r\n" : std::string(1, c);
  expect_patched("a.obj", crlf, true);
  expect_patched("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3", true);  // no line end at the end
}

TEST(Obj, UnknownStatementsAreNamedOnce) {
  const Mesh mesh = read_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nfoo 1\nfoo 2\nbar\nf 1 2 3\n");
  EXPECT_THAT(mesh.source->notes(), ElementsAre(HasSubstr("\"foo\" (line 4)"), HasSubstr("\"bar\" (line 6)")));
}

TEST(Obj, Malformed) {
  const std::string four = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const struct {
    std::string text;
    std::size_t line;
    const char* words;
  } table[] = {
      {"v 0 0\n", 1, "z coordinate, but the line ends"},
      {"v 0 0 0\nv 0 inf 0\n", 2, "y coordinate is not a finite number"},
      {"v 0 0 zero\n", 1, "expected z coordinate, got \"zero\""},
      {four + "f 1 2\n", 5, "face with 2 corners"},
      {four + "\nf 1 2 3 4 1\n", 6, "face with 5 corners"},
      {four + "f 0 1 2\n", 5, "vertex index 0 out of range"},
      {four + "f 1 2 9\n", 5, "vertex index 9 out of range (the file has 4 vertices)"},
      {four + "f 1 2 -5\n", 5, "vertex index -5 out of range (4 vertices come before it)"},
      {four + "f 1 2 5000000000\n", 5, "vertex index 5000000000 out of range"},
      {four + "f 1 2 3/x\n", 5, "texture coordinate index"},
      {four + "f 1 2 3/1/y\n", 5, "normal index"},
      {four + "f 1 2 3/1/1/1\n", 5, "expected v, v/vt, v//vn or v/vt/vn"},
      {four + "f 1 2 /3\n", 5, "expected vertex index"},
      {four + "f 1 \\\n2 \\\nx\n", 7, "expected vertex index, got \"x\""},
      {four + "\x01\x02 3\n", 5, "no OBJ file"},
  };
  for (const auto& bad : table) expect_refused("a.obj", bad.text, bad.line, bad.words);
}

TEST(Obj, EveryBeginning) { expect_truncation_safe("a.obj", kAll); }

TEST(Obj, RealFiles) {
  const auto files = shared_meshes(".obj");
  if (files.empty()) GTEST_SKIP() << "the shared meshes are not here";
  Progress progress;
  for (const auto& file : files) {
    expect_patched("a.obj", get(file), true);
    const Mesh mesh = read_mesh(file, progress);
    if (file.filename() == "pmp_suzanne.obj") {
      EXPECT_EQ(mesh.positions.size(), 507U);
      EXPECT_EQ(mesh.elements.size(), 500U);
      EXPECT_EQ(std::count(mesh.elements.kinds().begin(), mesh.elements.kinds().end(), ElementKind::Triangle), 32);
    }
  }
}

}  // namespace
}  // namespace dmoscope::test
