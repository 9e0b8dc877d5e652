// The table of docs/user/formats.md: each cell of each row is checked with files of that row.

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/io/format.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/text_writer.h"
#include "tests/fuzz/memory_files.h"
#include "tests/fuzz/samples.h"

namespace dmoscope::testing {
namespace {

using ::testing::HasSubstr;

/// The cells of a row; an empty cell repeats that of the row before.
struct DocumentedRow {
  std::string format, variant, read, again, anew, elements, groups, fields, coordinates;
};

std::string without_blanks(const std::string& text) {
  const std::size_t from = text.find_first_not_of(' ');
  return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(' ') - from + 1);
}

std::vector<DocumentedRow> documented_rows() {
  std::vector<DocumentedRow> rows;
  std::ifstream file(std::string(DMOSCOPE_SOURCE_DIR) + "/docs/user/formats.md");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("| ") || line.starts_with("| format |")) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(1));
    for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(without_blanks(cell));
    if (cells.size() < 9) continue;
    if (cells[0].empty() && !rows.empty()) cells[0] = rows.back().format;
    rows.push_back({cells[0], cells[2], cells[3], cells[4], cells[5], cells[6], cells[7], cells[8], cells.size() > 9 ? cells[9] : ""});
  }
  return rows;
}

/// The samples of a row: its format and variant in the table, the program's name of the format, the samples' names.
struct Backing {
  std::string format, variant, name;
  std::vector<std::string> samples;
  friend void PrintTo(const Backing& backing, std::ostream* out) { *out << backing.format << ", " << backing.variant; }
};
const std::vector<Backing> kBackings{
    {"OFF", "ASCII (also COFF, NOFF, STOFF)", "off", {"ascii"}},
    {"OFF", "binary", "off", {"binary"}},
    {"Wavefront OBJ", "ASCII", "obj", {"groups"}},
    {"PLY", "ASCII", "ply", {"ascii"}},
    {"PLY", "binary, either byte order", "ply", {"little", "big"}},
    {"STL", "ASCII", "stl", {"ascii"}},
    {"STL", "binary", "stl", {"binary"}},
    {"VTK legacy", "UNSTRUCTURED_GRID and POLYDATA, ASCII", "vtk", {"ascii", "poly", "volume"}},
    {"VTK legacy", "the same, binary, versions to 4.2 and 5", "vtk", {"binary", "offsets"}},
    {"VTK legacy", "STRUCTURED_GRID, ASCII and binary", "vtk", {"structured"}},
    {"VTK legacy", "RECTILINEAR_GRID, STRUCTURED_POINTS, ASCII and binary", "vtk", {"rectilinear", "image"}},
    {"VTU",
     "ASCII, base64, raw; uncompressed or zlib; either byte order",
     "vtu",
     {"ascii", "base64", "base64_zlib", "raw", "raw_zlib", "appended_base64", "appended_base64_zlib", "pieces_ascii", "pieces_raw",
      "pieces_zlib"}},
    {"VTK XML", "structured grids of one piece", "vtu", {"structured", "structured_base64", "rectilinear", "image"}},
    {"VTP",
     "ASCII, base64, raw; uncompressed or zlib; either byte order",
     "vtp",
     {"ascii", "base64", "base64_zlib", "raw", "raw_zlib", "appended_base64_zlib"}},
    {"ADCIRC fort.14", "ASCII", "fort14", {"depth"}},
    {"SU2", "ASCII, one zone", "su2", {"marker", "faces"}},
    {"Gmsh", "2.x and 4.1, ASCII", "gmsh", {"2_ascii", "4_ascii"}},
    {"Gmsh", "2.x and 4.1, binary, either byte order", "gmsh", {"2_little", "2_big", "4_little", "4_big"}},
    {"Gmsh", "partitioned 4.1", "gmsh", {"4_partitioned"}},
    {"MEDIT", "ASCII, versions 1 to 4", "medit", {"volume", "planar"}},
    {"MEDIT", "binary, versions 1 to 4, either byte order", "meshb", {"1_little", "2_big", "3_little", "4_big"}},
    {"Triangle, TetGen", "ASCII, both files", "tetgen", {"triangle", "tetgen"}},
    {"Abaqus", "ASCII, one part, with or without an assembly", "abaqus", {"volume", "planar"}},
    {"SMS 2dm", "ASCII", "2dm", {"strings"}},
    {"Nastran", "bulk data in free, small and large fields", "nastran", {"volume", "planar"}},
    {"Universal (I-deas)", "datasets 2411 or 781, and 2412", "unv", {"volume"}},
    {"Universal (I-deas)", "datasets 15 and 2412", "unv", {"planar"}},
    {"MIKE", "ASCII, with and without the unit of the levels", "mike", {"mixed"}},
    {"TELEMAC SELAFIN", "planar, either byte order", "selafin", {"single_big", "double_little"}},
    {"XDMF", "one uniform grid, numbers in the XML", "xdmf", {"mixed", "planar"}},
};

/// "as above" stands for the row before.
const DocumentedRow* row_of(const Backing& backing) {
  static const std::vector<DocumentedRow> rows = [] {
    std::vector<DocumentedRow> all = documented_rows();
    for (std::size_t i = 1; i < all.size(); ++i) {
      for (std::string DocumentedRow::*cell : {&DocumentedRow::elements, &DocumentedRow::groups, &DocumentedRow::fields})
        if (all[i].*cell == "as above") all[i].*cell = all[i - 1].*cell;
    }
    return all;
  }();
  const auto found =
      std::ranges::find_if(rows, [&](const DocumentedRow& r) { return r.format == backing.format && r.variant == backing.variant; });
  return found == rows.end() ? nullptr : &*found;
}

bool begins(const std::string& cell, std::string_view word) { return cell.starts_with(word); }

/// Whether it is a text file of numbers: printable characters and line ends alone.
bool is_text(std::string_view bytes) {
  return std::ranges::all_of(bytes,
                             [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\r' || c == '\t' || c == kBetweenFiles; });
}

class FormatTable : public ::testing::TestWithParam<Backing> {
 protected:
  void SetUp() override {
    row_ = row_of(GetParam());
    ASSERT_NE(row_, nullptr) << "no such row in docs/user/formats.md: " << GetParam().format << ", " << GetParam().variant;
    if (std::ranges::none_of(format_table(), [](const FormatInfo& f) { return f.name == GetParam().name; }))
      GTEST_SKIP() << "this build lacks the format";
  }
  /// Calls `act` with every sample of the row.
  template <class Do>
  static void for_samples(const Do& work) {
    std::size_t seen = 0;
    for (const Sample& sample : samples()) {
      if (sample.format != GetParam().name || std::ranges::find(GetParam().samples, sample.name) == GetParam().samples.end()) continue;
      SCOPED_TRACE(sample.format + " " + sample.name);
      ++seen;
      work(sample);
    }
    EXPECT_EQ(seen, GetParam().samples.size()) << "samples that there are not";
  }
  [[nodiscard]] bool is_written_again() const { return begins(row_->again, "yes"); }
  /// Writes a file of another variant.
  [[nodiscard]] std::string made_anew(const Mesh& mesh, Notes* notes = nullptr) const {
    Written written = write_anew(GetParam().name, mesh, mesh.positions);
    if (notes != nullptr) *notes = std::move(written.notes);
    return written.bytes;
  }
  /// The coordinate after it was written again, by the last cell.
  [[nodiscard]] double kept(double value, const Mesh& mesh, std::size_t axis) const {
    const std::string& cell = row_->coordinates;
    const auto as_float = static_cast<double>(static_cast<float>(value));
    if (begins(cell, "exact") || cell == "doubles") return value;
    if (cell == "32-bit floats") return as_float;
    if (begins(cell, "20 characters")) return number_in_field(value, 20, ExponentStyle::Letter).value;
    if (begins(cell, "16 characters")) return number_in_field(value, 16, ExponentStyle::Sign).value;
    if (begins(cell, "12 characters")) return number_in_field(value, 12, ExponentStyle::Letter).value;
    EXPECT_TRUE(begins(cell, "as its")) << "a word that this test does not know: " << cell;
    const CoordinateLayout& layout = mesh.source->layout();
    return layout.binary && layout.scalar[axis] == CoordinateScalar::Float32 ? as_float : value;
  }

  const DocumentedRow* row_ = nullptr;
};

TEST_P(FormatTable, IsRead) {
  ASSERT_TRUE(begins(row_->read, "yes"));
  for_samples([](const Sample& sample) {
    const Mesh mesh = read_bytes(sample.format, sample.bytes);
    EXPECT_GT(mesh.elements.size(), 0U);
    EXPECT_GT(mesh.positions.size(), 2U);
    for (const Index v : mesh.elements.all_corners()) EXPECT_LT(v, mesh.positions.size());
  });
}

TEST_P(FormatTable, IsWrittenAgainWithNothingButTheMovedChanged) {
  for_samples([&](const Sample& sample) {
    const Mesh mesh = read_bytes(sample.format, sample.bytes);
    if (!is_written_again()) {
      EXPECT_TRUE(begins(row_->again, "no: ")) << row_->again;
      EXPECT_NE(mesh.source->not_patchable(), "");
      return;
    }
    ASSERT_EQ(mesh.source->not_patchable(), "");
    EXPECT_EQ(write_again(mesh, mesh.positions).bytes, sample.bytes);
    std::vector<Vec3> moved = mesh.positions;
    moved[1].x += 1.0 / 3.0;
    moved[2].y -= 1.0 / 7.0;
    const Mesh again = read_bytes(sample.format, write_again(mesh, moved).bytes);
    ASSERT_EQ(again.fields.size(), mesh.fields.size());
    for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
      EXPECT_EQ(again.fields[i].name, mesh.fields[i].name);
      EXPECT_TRUE(std::ranges::equal(again.fields[i].values, mesh.fields[i].values,
                                     [](double a, double b) { return a == b || (a != a && b != b); }));
    }
    ASSERT_EQ(again.groups.size(), mesh.groups.size());
    for (std::size_t i = 0; i < mesh.groups.size(); ++i) EXPECT_EQ(again.groups[i].members, mesh.groups[i].members);
  });
}

TEST_P(FormatTable, KeepsAsManyDigitsAsItSays) {
  if (!is_written_again()) return;
  for_samples([&](const Sample& sample) {
    const Mesh mesh = read_bytes(sample.format, sample.bytes);
    std::vector<Vec3> moved = mesh.positions;
    // Numbers with more digits than a float, or 16 or 20 characters, can hold.
    moved[1] = {1.0 / 3.0, -1.234567890123456789e-7, moved[1].z};
    const bool has_z = mesh.source->layout().components == 3 && row_->coordinates.find("x and y") == std::string::npos;
    if (has_z) moved[1].z = 1e10 / 7.0;
    const Mesh again = read_bytes(sample.format, write_again(mesh, moved).bytes);
    const auto is_there = [&](Vec3 wanted) { return std::ranges::find(again.positions, wanted) != again.positions.end(); };
    EXPECT_TRUE(is_there({kept(moved[1].x, mesh, 0), kept(moved[1].y, mesh, 1), has_z ? kept(moved[1].z, mesh, 2) : moved[1].z}));
    if (row_->coordinates.find("x and y") != std::string::npos) {
      EXPECT_EQ(mesh.source->layout().components, 2);
    }
  });
}

TEST_P(FormatTable, IsMadeAnewAsItSays) {
  for_samples([&](const Sample& sample) {
    Mesh mesh = read_bytes(sample.format, sample.bytes);
    mesh.source.reset();
    if (begins(row_->anew, "no: .mesh") || begins(row_->anew, "no: .2dm") || begins(row_->anew, "no: .msh")) {
      EXPECT_THROW((void)made_anew(mesh), OutputError);
      return;
    }
    const std::string bytes = made_anew(mesh);
    const Mesh again = read_bytes(GetParam().name, bytes);
    EXPECT_EQ(again.elements.size(), mesh.elements.size());
    const std::string cell = row_->anew.empty() ? row_->again : row_->anew;  // for formats that are never written again
    if (cell == "yes: raw, zlib" || cell == "no: as .vtu") {
      EXPECT_THAT(bytes, HasSubstr("encoding=\"raw\""));
      EXPECT_THAT(bytes, HasSubstr("vtkZLibDataCompressor"));
      return;
    }
    EXPECT_TRUE(is_text(bytes)) << cell;
    if (cell.find("2.2") != std::string::npos) {
      EXPECT_THAT(bytes, HasSubstr("$MeshFormat\n2.2 0 8\n"));
    }
    if (cell == "no: as UNSTRUCTURED_GRID") {
      EXPECT_THAT(bytes, HasSubstr("DATASET UNSTRUCTURED_GRID"));
    }
    if (cell == "yes: large fields") {
      EXPECT_THAT(bytes, HasSubstr("GRID*"));
    }
  });
}

/// A square of two triangles, two quadrilaterals, or a tetrahedron, with a group and fields of every kind.
Mesh small_mesh(ElementKind kind) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  if (info(kind).dimension == 3) {
    for (Index v = 4; v < 8; ++v) mesh.positions[v] = {mesh.positions[v - 4].x, mesh.positions[v - 4].y, 1};
  }
  switch (kind) {
    case ElementKind::Triangle:
      mesh.positions.resize(4);
      mesh.elements.add(kind, std::array<Index, 3>{0, 1, 2});
      mesh.elements.add(kind, std::array<Index, 3>{0, 2, 3});
      break;
    case ElementKind::Quadrilateral:
      mesh.positions.resize(4);
      mesh.elements.add(kind, std::array<Index, 4>{0, 1, 2, 3});
      break;
    case ElementKind::Tetrahedron:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      mesh.elements.add(kind, std::array<Index, 4>{0, 1, 2, 3});
      break;
    case ElementKind::Hexahedron:
      mesh.elements.add(kind, std::array<Index, 8>{0, 1, 2, 3, 4, 5, 6, 7});
      break;
    case ElementKind::Wedge:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
      mesh.elements.add(kind, std::array<Index, 6>{0, 1, 2, 3, 4, 5});
      break;
    case ElementKind::Pyramid:
      mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}};
      mesh.elements.add(kind, std::array<Index, 5>{0, 1, 2, 3, 4});
      break;
  }
  return mesh;
}

/// The kinds of elements that a cell names.
std::vector<ElementKind> kinds_of(const std::string& cell) {
  using enum ElementKind;
  if (begins(cell, "all")) return {Triangle, Quadrilateral, Tetrahedron, Hexahedron, Wedge, Pyramid};
  if (begins(cell, "planar")) return {Triangle, Quadrilateral};
  if (cell == "triangles") return {Triangle};
  if (cell == "triangles or tetrahedra") return {Triangle, Tetrahedron};
  EXPECT_EQ(cell, "quadrilaterals or hexahedra");
  return {Quadrilateral, Hexahedron};
}

TEST_P(FormatTable, HoldsTheElementsThatItSaysAndRefusesOthers) {
  if (row_->anew.empty() || begins(row_->anew, "no: .") || begins(row_->elements, "quad")) {
    // Formats that are read alone: the samples' elements must be of these kinds.
    for_samples([&](const Sample& sample) {
      const Mesh mesh = read_bytes(sample.format, sample.bytes);
      const std::vector<ElementKind> said = kinds_of(row_->elements);
      for (const ElementKind kind : mesh.elements.kinds()) EXPECT_NE(std::ranges::find(said, kind), said.end()) << info(kind).name;
    });
    return;
  }
  const std::vector<ElementKind> said = kinds_of(row_->elements);
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    const auto kind = static_cast<ElementKind>(k);
    SCOPED_TRACE(info(kind).name);
    const Mesh mesh = small_mesh(kind);
    if (std::ranges::find(said, kind) == said.end()) {
      EXPECT_THROW((void)made_anew(mesh), OutputError);
      continue;
    }
    const Mesh again = read_bytes(GetParam().name, made_anew(mesh));
    ASSERT_EQ(again.elements.size(), mesh.elements.size());
    EXPECT_EQ(again.elements.kind(0), kind);
    for (std::size_t i = 0; i < mesh.elements.corners(0).size(); ++i)
      EXPECT_EQ(again.positions[again.elements.corners(0)[i]], mesh.positions[mesh.elements.corners(0)[i]]) << "corner " << i;
  }
}

/// Kinds of fields that a cell names: of points and of elements, in any words.
struct Keeps {
  bool points = false, elements = false;
};
Keeps fields_in(const std::string& cell) {
  const auto has = [&](const char* word) { return cell.find(word) != std::string::npos; };
  Keeps keeps;
  keeps.points = has("points") || has("nodes") || has("depth") || has("elevation") || has("one number") || cell == "attributes";
  keeps.elements = has("cells") || has("points, elements") || has("one number") || cell == "attributes";
  return keeps;
}

TEST_P(FormatTable, KeepsTheFieldsThatItSaysAndNamesOthersAsDropped) {
  if (row_->anew.empty() || begins(row_->anew, "no")) return;  // see the row of files that are made anew
  Mesh mesh = small_mesh(ElementKind::Triangle);
  mesh.fields.push_back(
      {.name = "heat", .on = Field::On::Vertices, .components = 1, .type = "double", .role = "", .values = {0.25, 2, 3, 4}});
  mesh.fields.push_back({.name = "load", .on = Field::On::Elements, .components = 1, .type = "double", .role = "", .values = {0.5, 6}});
  if (row_->fields == "elevation") mesh.fields[0].name = mesh.fields[0].role = row_->fields;  // the format holds that field alone
  Notes notes;
  const Mesh again = read_bytes(GetParam().name, made_anew(mesh, &notes));
  Keeps keeps = fields_in(row_->fields);
  // References of MEDIT are whole numbers, and STL's attributes are in binary files alone.
  if (row_->fields == "references of vertices") keeps = {};
  const std::string said = ::testing::PrintToString(notes);
  for (const Field& field : mesh.fields) {
    const bool should = field.on == Field::On::Vertices ? keeps.points : keeps.elements;
    const bool is = std::ranges::any_of(again.fields, [&](const Field& f) {
      std::vector<double> values = f.values;
      if (f.role == "elevation")
        return f.on == field.on &&
               (values == field.values || (std::ranges::for_each(values, [](double& v) { v = -v; }), values == field.values));
      return f.on == field.on && f.values == field.values;
    });
    EXPECT_EQ(is, should) << field.name << ": " << row_->fields << said;
    if (!should) {
      EXPECT_THAT(said, HasSubstr(field.name)) << "dropped without a word";
    }
  }
}

TEST_P(FormatTable, ReadsFieldsAndGroupsWhereItSaysSo) {
  std::size_t of_points = 0, of_elements = 0, groups = 0;
  for_samples([&](const Sample& sample) {
    const Mesh mesh = read_bytes(sample.format, sample.bytes);
    for (const Field& field : mesh.fields) ++(field.on == Field::On::Vertices ? of_points : of_elements);
    groups += mesh.groups.size();
  });
  const Keeps keeps = fields_in(row_->fields);
  // The samples of these two rows have groups alone; data are read by the code of the ASCII row (Gmsh.*).
  const bool groups_alone = GetParam().name == "gmsh" && GetParam().samples.front() != "2_ascii";
  if (!groups_alone) {
    EXPECT_EQ(of_points + of_elements > 0, row_->fields != "no") << row_->fields;
  }
  if (!groups_alone && row_->fields.find(',') != std::string::npos) {
    EXPECT_EQ(of_points > 0, keeps.points) << row_->fields;
    EXPECT_EQ(of_elements > 0, keeps.elements) << row_->fields;
  }
  if (row_->groups == "no") {
    EXPECT_EQ(groups, 0U);
  } else if (row_->groups.find("not anew") == std::string::npos && row_->groups != "boundary markers, as fields") {
    EXPECT_GT(groups, 0U) << row_->groups;
  }
}

/// Dimensions of the groups that come back: 0 vertices, 1 edges, 2 elements; "boundary strings" are a role of their own.
std::vector<int> groups_in(const std::string& cell) {
  static const std::map<std::string, std::vector<int>> kept{
      {"no", {}},
      {"cells of fewer dimensions; not anew", {}},
      {"open and land boundaries", {}},  // tested below
      {"markers", {1}},
      {"physical groups, entities", {0, 1, 2}},
      {"references, corners, ridges, required", {1, 2}},  // vertices' as marks alone, tested below
      {"boundary markers, as fields", {}},
      {"node sets, element sets, surfaces", {0, 1, 2}},
      {"materials, nodestrings", {1, 2}},
      {"properties, also of shells and bars beside volume elements", {1, 2}},
      {"sets of nodes and cells", {0, 2}},
      {"groups, properties; not anew", {}},
  };
  const auto found = kept.find(cell);
  EXPECT_NE(found, kept.end()) << "a word that this test does not know: " << cell;
  return found == kept.end() ? std::vector<int>() : found->second;
}

TEST_P(FormatTable, KeepsTheGroupsThatItSaysAndNamesOthersAsDropped) {
  const std::vector<int> said = groups_in(row_->groups);
  if (row_->anew.empty() || begins(row_->anew, "no: .")) return;
  for (int dimension = 0; dimension <= 2; ++dimension) {
    SCOPED_TRACE(dimension);
    Mesh mesh = small_mesh(ElementKind::Triangle);
    Group group{.name = "chosen", .role = "", .code = 3, .dimension = dimension, .members = {}};
    group.members = dimension == 0 ? std::vector<Index>{2, 3} : dimension == 1 ? std::vector<Index>{0, 1} : std::vector<Index>{1};
    mesh.groups.push_back(group);
    Notes notes;
    const Mesh again = read_bytes(GetParam().name, made_anew(mesh, &notes));
    const bool is =
        std::ranges::any_of(again.groups, [&](const Group& g) { return g.dimension == dimension && g.members == group.members; });
    const bool should = std::ranges::find(said, dimension) != said.end();
    EXPECT_EQ(is, should) << row_->groups << ::testing::PrintToString(notes);
    if (!should) {
      EXPECT_THAT(::testing::PrintToString(notes), HasSubstr("chosen")) << "dropped without a word";
    }
  }
}

TEST_P(FormatTable, KeepsBoundariesAndMarks) {
  Mesh mesh = small_mesh(ElementKind::Triangle);
  if (row_->groups == "open and land boundaries") {
    mesh.groups = {{.name = "o", .role = "open boundary", .code = 0, .dimension = 0, .members = {0, 1}},
                   {.name = "l", .role = "land boundary", .code = 20, .dimension = 0, .members = {1, 2, 3}}};
  } else if (begins(row_->groups, "references") && begins(row_->anew, "yes")) {
    mesh.groups = {{.name = "Corners", .role = "mark", .code = 0, .dimension = 0, .members = {0, 2}},
                   {.name = "RequiredVertices", .role = "mark", .code = 0, .dimension = 0, .members = {3}},
                   {.name = "Ridges", .role = "mark", .code = 0, .dimension = 1, .members = {0, 1}},
                   {.name = "RequiredTriangles", .role = "mark", .code = 0, .dimension = 2, .members = {1}}};
  } else {
    return;
  }
  const Mesh again = read_bytes(GetParam().name, made_anew(mesh));
  for (const Group& group : mesh.groups) {
    const bool is = std::ranges::any_of(
        again.groups, [&](const Group& g) { return g.role == group.role && g.members == group.members && g.code == group.code; });
    EXPECT_TRUE(is) << group.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, FormatTable, ::testing::ValuesIn(kBackings), [](const auto& tested) {
  std::string name = tested.param.name + "_" + tested.param.samples.front();
  std::ranges::replace_if(
      name, [](char c) { return c == ' '; }, '_');
  return name;
});

TEST(FormatTableRows, EveryRowThatIsReadIsTried) {
  const std::vector<DocumentedRow> rows = documented_rows();
  ASSERT_GE(rows.size(), kBackings.size());
  for (const DocumentedRow& row : rows) {
    // Formats that need other libraries have tests of their own.
    if (!begins(row.read, "yes") || row.variant.find("HDF5") != std::string::npos || row.format.find("Exodus") != std::string::npos ||
        row.format.find("CGNS") != std::string::npos || row.format == "MED")
      continue;
    EXPECT_TRUE(std::ranges::any_of(kBackings, [&](const Backing& b) { return b.format == row.format && b.variant == row.variant; }))
        << row.format << ", " << row.variant;
  }
}

}  // namespace
}  // namespace dmoscope::testing
