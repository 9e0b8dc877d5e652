// Fields written again, in all formats that hold numbers of vertices: changed numbers change, and nothing else.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/mesh_io.h"
#include "tests/fuzz/array_samples.h"
#include "tests/io/files.h"

namespace dmoscope::test {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string with(std::string text, std::string_view what, std::string_view by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::out_of_range(std::string(what));
  return text.replace(at, what.size(), by);
}

std::string written_with(std::string_view name, const Mesh& mesh, std::span<const Vec3> positions, std::span<const FieldValues> fields,
                         std::vector<std::string>* notes = nullptr) {
  const TemporaryFolder folder;
  Progress progress;
  std::vector<std::string> said = write_mesh(folder / std::string(name), mesh, {positions, fields}, progress);
  if (notes != nullptr) *notes = std::move(said);
  return get(folder / std::string(name));
}

/// Vertex 4 in the middle of a square of four others.
Mesh square() {
  Mesh mesh;
  mesh.name = "square";
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  for (Index v = 0; v < 4; ++v) mesh.elements.add(ElementKind::Triangle, std::vector<Index>{v, (v + 1) % 4, 4});
  Field depth;
  depth.name = "depth";
  depth.values = {1.25, 2.5, 3.75, 4.5, 5.125};
  mesh.fields.push_back(std::move(depth));
  return mesh;
}

/// Writes a file again with vertex 4 elsewhere and another number there; returns its bytes.
std::string with_another_depth(std::string_view name, const std::string& bytes, double depth = 2.0625) {
  const Mesh mesh = read_bytes(name, bytes);
  std::vector<Vec3> positions = mesh.positions;
  positions[4] = {0.375, 0.625, 0.0};
  const auto is_depth = [](const Field& field) {
    return field.on == Field::On::Vertices && field.components == 1 && field.values[4] == 5.125;
  };
  const auto found = std::ranges::find_if(mesh.fields, is_depth);
  if (found == mesh.fields.end()) throw std::out_of_range("no depth");
  FieldValues changed{static_cast<std::size_t>(found - mesh.fields.begin()), found->values};
  changed.values[4] = depth;
  std::vector<std::string> notes;
  std::string again = written_with(name, mesh, positions, {&changed, 1}, &notes);
  EXPECT_THAT(notes, IsEmpty()) << name;
  const Mesh read = read_bytes(name, again);
  expect_same_positions(positions, read.positions);
  EXPECT_EQ(read.fields[changed.field].values, changed.values) << name;
  EXPECT_EQ(read.fields.size(), mesh.fields.size());
  return again;
}

TEST(FieldPatch, Fort14) {
  const std::string text =
      "square\n4 5\n1 0 0 1.25\n2 1 0 2.5\n3 1 1 3.75\n4 0 1 4.5\n5 0.5 0.5   5.1250d0 a remark\n1 3 1 2 5\n2 3 2 3 5\n3 3 3 4 5\n4 3 4 1 "
      "5\n";
  EXPECT_EQ(with_another_depth("a.14", text), with(text, "0.5 0.5   5.1250d0 a", "0.375 0.625   2.0625 a"));
}

TEST(FieldPatch, Sms2dm) {
  const std::string text =
      "MESH2D\nE3T 1 1 2 5 1\nE3T 2 2 3 5 1\nE3T 3 3 4 5 1\nE3T 4 4 1 5 1\n"
      "ND 1 0 0 1.25\nND 2 1 0 2.5\nND 3 1 1 3.75\nND 4 0 1 4.5\nND 5 0.5 0.5 5.125\n";
  EXPECT_EQ(with_another_depth("a.2dm", text), with(text, "0.5 0.5 5.125", "0.375 0.625 2.0625"));
}

TEST(FieldPatch, TetgenAttributesButNotMarkers) {
  const TemporaryFolder folder;
  Progress progress;
  const std::string nodes = "5 2 2 1\n0 0 0 7 1.25 1\n1 1 0 7 2.5 1\n2 1 1 7 3.75 1\n3 0 1 7 4.5 1\n4 0.5 0.5 7 5.125 0 # inner\n";
  put(folder / "a.node", nodes);
  put(folder / "a.ele", "4 3 0\n0 0 1 4\n1 1 2 4\n2 2 3 4\n3 3 0 4\n");
  const Mesh mesh = read_mesh(folder / "a.node", progress);
  std::vector<Vec3> positions = mesh.positions;
  positions[4].x = 0.25;
  FieldValues changed{1, mesh.fields[1].values};
  changed.values[4] = 2.0625;
  (void)write_mesh(folder / "b.node", mesh, {positions, std::span(&changed, 1)}, progress);
  EXPECT_EQ(get(folder / "b.node"), with(nodes, "0.5 0.5 7 5.125 0 #", "0.25 0.5 7 2.0625 0 #"));
}

TEST(FieldPatch, PlyInTextAndBytes) {
  const std::string head = "ply\nformat ascii 1.0\nelement vertex 5\nproperty double x\nproperty double y\n",
                    tail = "property double z\nproperty float depth\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n",
                    faces = "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n";
  const std::string text = head + tail + "0 0 0 1.25\n1 0 0 2.5\n1 1 0 3.75\n0 1 0 4.5\n0.5 0.5 0 5.125\n" + faces;
  EXPECT_EQ(with_another_depth("a.ply", text), with(text, "0.5 0.5 0 5.125", "0.375 0.625 0 2.0625"));
  const auto bytes_of = [](auto number) { return std::string(reinterpret_cast<const char*>(&number), sizeof number); };
  const auto binary = [&](double x, double y, float last) {
    std::string bytes = with(head, "ascii", "binary_little_endian") + tail;
    const std::array<std::array<double, 2>, 5> places{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {x, y}}};
    const std::array<float, 5> depths{1.25F, 2.5F, 3.75F, 4.5F, last};
    for (std::size_t v = 0; v < 5; ++v) bytes += bytes_of(places[v][0]) + bytes_of(places[v][1]) + bytes_of(0.0) + bytes_of(depths[v]);
    for (std::int32_t v = 0; v < 4; ++v) bytes += '\3' + bytes_of(v) + bytes_of((v + 1) % 4) + bytes_of(4);
    return bytes;
  };
  EXPECT_EQ(with_another_depth("b.ply", binary(0.5, 0.5, 5.125F)), binary(0.375, 0.625, 2.0625F));
}

TEST(FieldPatch, VtkInTextAndBytes) {
  const std::string text =
      "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n0 0 0 1 0 0 1 1 0 0 1 0 0.5 0.5 0\n"
      "CELLS 4 16\n3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\nCELL_TYPES 4\n5 5 5 5\n"
      "POINT_DATA 5\nSCALARS id int 1\nLOOKUP_TABLE default\n0 1 2 3\n4\nSCALARS depth float 1\nLOOKUP_TABLE default\n1.25 2.5 3.75 "
      "4.5\n5.125\n"
      "VECTORS v double\n0 0 0 1 1 1 2 2 2 3 3 3 4 4 4\n";
  EXPECT_EQ(with_another_depth("a.vtk", text), with(with(text, "0.5 0.5 0\n", "0.375 0.625 0\n"), "\n5.125\n", "\n2.0625\n"));
  const Mesh mesh = read_bytes("a.vtk", text);
  // A float in a text is written with the fewest digits of a float.
  FieldValues depth{1, mesh.fields[1].values};
  depth.values[4] = static_cast<double>(10.04F);
  EXPECT_EQ(written_with("a.vtk", mesh, mesh.positions, {&depth, 1}), with(text, "\n5.125\n", "\n10.04\n"));
  FieldValues changed{2, mesh.fields[2].values};
  changed.values[13] = 0.1;
  EXPECT_EQ(written_with("a.vtk", mesh, mesh.positions, {&changed, 1}), with(text, " 4 4 4\n", " 4 0.1 4\n"));
}

/// Eight bytes each, most significant first.
std::string big_endian(std::initializer_list<double> numbers) {
  std::string bytes;
  for (const double number : numbers) {
    const auto* const first = reinterpret_cast<const char*>(&number);
    for (std::size_t i = sizeof number; i > 0; --i) bytes += first[i - 1];
  }
  return bytes;
}

TEST(FieldPatch, BinaryVtk) {
  const std::string depth = big_endian({1.25, 2.5, 3.75, 4.5, 5.125});
  std::string cells;
  for (const int v : {3, 0, 1, 4, 3, 1, 2, 4, 3, 2, 3, 4, 3, 3, 0, 4}) cells += std::string(3, '\0') + static_cast<char>(v);
  std::string types;
  for (int i = 0; i < 4; ++i) types += std::string(3, '\0') + '\5';
  const std::string bytes = "# vtk DataFile Version 3.0\nsquare\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 double\n" +
                            big_endian({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, 0}) + "\nCELLS 4 16\n" + cells + "\nCELL_TYPES 4\n" +
                            types + "\nPOINT_DATA 5\nSCALARS depth double 1\nLOOKUP_TABLE default\n" + depth + "\n";
  EXPECT_EQ(with_another_depth("a.vtk", bytes),
            with(with(bytes, big_endian({0.5, 0.5, 0}), big_endian({0.375, 0.625, 0})), depth, big_endian({1.25, 2.5, 3.75, 4.5, 2.0625})));
}

/// Node numbers in any order, and not all of them.
TEST(FieldPatch, Gmsh) {
  const std::string text =
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n10 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n7 0.5 0.5 0\n$EndNodes\n"
      "$Elements\n4\n1 2 2 0 1 10 2 7\n2 2 2 0 1 2 3 7\n3 2 2 0 1 3 4 7\n4 2 2 0 1 4 10 7\n$EndElements\n"
      "$NodeData\n1\n\"depth\"\n1\n0.0\n3\n0\n1\n4\n2 2.5\n7 5.125\n10 1.25\n4 4.5\n$EndNodeData\n";
  const Mesh mesh = read_bytes("a.msh", text);
  FieldValues changed{0, mesh.fields.at(0).values};
  ASSERT_EQ(mesh.fields[0].name, "depth");
  changed.values[4] = 2.0625;
  changed.values[0] = 8.5;
  EXPECT_EQ(written_with("a.msh", mesh, mesh.positions, {&changed, 1}), with(with(text, "7 5.125", "7 2.0625"), "10 1.25", "10 8.5"));
  // A file of version 4.1, as the program writes it.
  (void)with_another_depth("b.msh", written("b.msh", square()));
}

TEST(FieldPatch, VtuInEveryEncoding) {
  if (format_by_extension(".vtu") == nullptr) GTEST_SKIP() << "this build reads no VTU";
  (void)with_another_depth("a.vtu", written("a.vtu", square()));  // appended, raw and packed
  const auto file = [](const std::string& points, const std::string& depth) {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n"
           "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">\n<PointData>\n" +
           depth + "</PointData>\n<Points>\n" + points +
           "</Points>\n<Cells>\n<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 4 1 2 4 2 3 4 3 0 4</DataArray>\n"
           "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3 6 9 12</DataArray>\n"
           "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">5 5 5 5</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  };
  const std::string points =
      "<DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 1 1 0 0 1 0 0.5 0.5 0</DataArray>\n";
  const std::string text = file(points,
                                "<DataArray type=\"Int32\" Name=\"id\" format=\"ascii\">0 1 2 3 4</DataArray>\n"
                                "<DataArray type=\"Float64\" Name=\"depth\" format=\"ascii\">1.25 2.5\n 3.75 4.5 5.125 </DataArray>\n") +
                           "</VTKFile>\n";
  EXPECT_EQ(with_another_depth("b.vtu", text), with(with(text, "0.5 0.5 0<", "0.375 0.625 0<"), "5.125 <", "2.0625 <"));
  const auto raw = [](double last) {
    std::string bytes;
    const std::uint64_t size = 40;
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    for (const double number : {1.25, 2.5, 3.75, 4.5, last}) bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    return bytes;
  };
  const std::string head = file(points, "<DataArray type=\"Float64\" Name=\"depth\" format=\"appended\" offset=\"0\"/>\n");
  const auto appended = [&](const std::string& before, double last) {
    return before + "<AppendedData encoding=\"raw\">_" + raw(last) + "</AppendedData>\n</VTKFile>\n";
  };
  EXPECT_EQ(with_another_depth("c.vtu", appended(head, 5.125)), appended(with(head, "0.5 0.5 0<", "0.375 0.625 0<"), 2.0625));
}

TEST(FieldPatch, Xdmf) {
  if (format_by_extension(".xdmf") == nullptr) GTEST_SKIP() << "this build reads no XDMF";
  (void)with_another_depth("a.xdmf", written("a.xdmf", square()));
}

/// The last of two time steps is read; it alone changes, and the other is named.
TEST(FieldPatch, ExodusAndCgns) {
  const std::string bytes = testing::exodus_solids();
  const Mesh mesh = read_bytes("a.e", bytes);
  const auto field = std::ranges::find(mesh.fields, "heat", &Field::name);
  ASSERT_NE(field, mesh.fields.end());
  FieldValues changed{static_cast<std::size_t>(field - mesh.fields.begin()), field->values};
  changed.values[3] += 0.25;
  std::vector<std::string> notes;
  const std::string written_again = written_with("a.e", mesh, mesh.positions, {&changed, 1}, &notes);
  const Mesh again = read_bytes("a.e", written_again);
  EXPECT_THAT(notes, Contains(HasSubstr("earlier time steps were carried")));
  for (std::size_t f = 0; f < mesh.fields.size() && mesh.fields[f].on == Field::On::Vertices; ++f)
    EXPECT_EQ(again.fields[f].values, f == changed.field ? changed.values : mesh.fields[f].values) << mesh.fields[f].name;
  std::size_t differ = 0;
  ASSERT_EQ(written_again.size(), bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) differ += bytes[i] != written_again[i] ? 1U : 0U;
  EXPECT_LE(differ, 8U) << "one number";

  if (format_by_extension(".cgns") == nullptr) return;  // this build has no HDF5
  const std::string zones = testing::cgns_zones();
  const Mesh joined = read_bytes("a.cgns", zones);
  FieldValues at_both{0, joined.fields.at(0).values};
  for (double& value : at_both.values) value = 0.5 * value + 0.25;
  const Mesh other = read_bytes("a.cgns", written_with("a.cgns", joined, joined.positions, {&at_both, 1}));
  EXPECT_EQ(other.fields.at(0).values, at_both.values);
}

/// Each component of a vector stands behind the one before; it alone changes.
TEST(FieldPatch, Med) {
  if (format_by_extension(".med") == nullptr) GTEST_SKIP() << "this build has no HDF5";
  const Mesh mesh = read_bytes("a.med", testing::med_solids());
  std::size_t tried = 0;
  for (std::size_t f = 0; f < mesh.fields.size(); ++f) {
    if (mesh.fields[f].on != Field::On::Vertices) continue;
    FieldValues changed{f, mesh.fields[f].values};
    changed.values[5] = -3.25;
    const Mesh again = read_bytes("a.med", written_with("a.med", mesh, mesh.positions, {&changed, 1}));
    for (std::size_t other = 0; other < mesh.fields.size(); ++other) {
      if (mesh.fields[other].on != Field::On::Vertices) continue;
      EXPECT_EQ(again.fields[other].values, other == f ? changed.values : mesh.fields[other].values) << mesh.fields[other].name;
    }
    ++tried;
  }
  EXPECT_EQ(tried, 3U) << "heat and two components of way";
}

/// Another format than that of the input keeps the numbers, too.
TEST(FieldPatch, MadeAnew) {
  const Mesh mesh = square();
  FieldValues changed{0, mesh.fields[0].values};
  changed.values[4] = 2.0625;
  for (const char* name : {"a.14", "a.2dm", "a.vtk", "a.ply", "a.msh"}) {
    const Mesh again = read_bytes(name, written_with(name, mesh, mesh.positions, {&changed, 1}));
    EXPECT_TRUE(std::ranges::any_of(again.fields, [&](const Field& field) {
      return field.on == Field::On::Vertices && field.values.size() == 5 && std::abs(field.values[4]) == 2.0625;
    })) << name;
  }
}

}  // namespace
}  // namespace dmoscope::test
