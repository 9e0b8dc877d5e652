#pragma once
// Interfaces that the reader and the writer of MEDIT files share.

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/base/progress.h"
#include "core/io/cell_table.h"
#include "core/io/format.h"
#include "core/io/reading/io_context.h"
#include "core/io/reading/source_file.h"
#include "core/mesh/mesh.h"

namespace dmoscope {

inline constexpr std::string_view kMeditSignature = "MeshVersionFormatted";
/// A section that lists vertices, edges, triangles or quadrilaterals by their numbers, and becomes a group of that name.
struct MeditMark {
  std::string_view keyword;
  int code;  // code in binary files
  CellShape of;
};
inline constexpr std::array kMeditMarks{MeditMark{"Corners", 13, CellShape::Point},
                                        MeditMark{"Ridges", 14, CellShape::Line},
                                        MeditMark{"RequiredVertices", 15, CellShape::Point},
                                        MeditMark{"RequiredEdges", 16, CellShape::Line},
                                        MeditMark{"RequiredTriangles", 17, CellShape::Triangle},
                                        MeditMark{"RequiredQuadrilaterals", 18, CellShape::Quadrilateral}};
inline constexpr std::string_view kMeditMark = "mark";            // role of these groups
inline constexpr std::string_view kMeditReference = "reference";  // role of the groups and of the field of references
inline constexpr std::string_view kMeditField = "medit:ref";      // the vertices' references, named as by other tools

/// The mark of this name, in whatever case; null for any other.
[[nodiscard]] const MeditMark* medit_mark(std::string_view keyword) noexcept;

/// Writer, see FormatHandler::write. Elements are sorted by their kinds. Throws OutputError, Cancelled.
Notes write_medit(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context);

// Contents of MEDIT's text and binary files, and the mesh made of them.

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

// MEDIT's solution files, .sol: numbers at a mesh's vertices, above all metrics, which mmg and others write beside it.

/// Reads the solutions at vertices as fields of the mesh: "sol" (a number), "sol-vector", "metric" (a symmetric tensor: 3 components in the
/// plane, 6 in space, in mmg's order), with a number behind the name if there are several of a kind. Returns the keywords that were
/// skipped, with their numbers: those that do not concern vertices. Throws InputError (file and line), Cancelled.
std::vector<std::string> read_solutions(const std::filesystem::path& file, Mesh& mesh, Progress& progress);

/// Reads the solutions in "part.sol", if the mesh is "part.mesh" or "part.mesh.gz" and such a file is beside it; a note says so, or why it
/// was not read.
void read_solutions_beside(SourceFile& source, Mesh& mesh, Progress& progress);
/// The solution file beside a mesh, if there is one.
[[nodiscard]] std::vector<std::filesystem::path> solutions_beside(const SourceFile& source, const IoContext& context);

}  // namespace dmoscope
