#pragma once
// Contents of MEDIT's text and binary files, and the mesh made of them.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/io/cell_table.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

/// A section with cells: its keyword, and its number in binary files.
struct MeditCells {
  std::string_view keyword;
  int code;
  CellShape shape;
};
inline constexpr std::array kMeditCells{
    MeditCells{"Edges", 5, CellShape::Line},
    MeditCells{"Triangles", 6, CellShape::Triangle},
    MeditCells{"Quadrilaterals", 7, CellShape::Quadrilateral},
    MeditCells{"Tetrahedra", 8, CellShape::Tetrahedron},
    MeditCells{"Hexahedra", 10, CellShape::Hexahedron},
    MeditCells{"Hexaedra", 10, CellShape::Hexahedron},  // the spelling of old files
    MeditCells{"Prisms", 9, CellShape::Wedge},
    MeditCells{"Pentahedra", 9, CellShape::Wedge},
    MeditCells{"Pyramids", 49, CellShape::Pyramid},
};

/// Marks such as Corners or Ridges: numbers of vertices, edges or faces, which may precede the latter.
struct MeditMarks {
  std::string keyword;
  std::vector<std::int64_t> numbers;  // numbers from 1
  std::vector<std::size_t> lines;     // line of each; empty in a binary file
};

/// Contents of a file. Positions go into mesh.positions, with a reference each; finish() makes elements, groups and fields of the rest.
class MeditContents {
 public:
  explicit MeditContents(SourceFile& source) : source_(source) {}

  void reserve_cells(CellShape shape, std::size_t count);
  void add_cell(CellShape shape, const Index* corners, int reference);
  void add_marks(MeditMarks marks) { marks_.push_back(std::move(marks)); }
  /// Makes the mesh. Throws InputError (a mark of a vertex, edge or face that does not exist).
  [[nodiscard]] Mesh finish();

  Mesh mesh;
  std::vector<int> references;  // references of the vertices

 private:
  std::uint32_t origin_of(int reference);
  void make_group(const MeditMarks& marks);
  void make_face_group(const MeditMarks& marks, CellShape shape);
  [[noreturn]] void fail_mark(const MeditMarks& marks, std::size_t i, std::size_t things, std::string_view what) const;
  void add_field(Field::On on, std::vector<double> values);
  void split();

  SourceFile& source_;
  CellTable cells_;
  std::vector<Index> edges_;  // two vertices each
  std::vector<Index> rows_;   // cell of each element; empty: every cell is one
  std::vector<OriginLabels> labels_;
  std::unordered_map<int, std::uint32_t> origins_;  // origins by reference
  std::uint32_t last_origin_ = 0;
  std::vector<MeditMarks> marks_;
};

}  // namespace dmoscope
