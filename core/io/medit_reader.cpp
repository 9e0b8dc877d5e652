// Reads MEDIT's ASCII format: a keyword, a count, and so many lines, in any order; every thing with a reference number.
// https://www.ljll.fr/frey/publications/RT-0253.pdf, and what mmg and tetgen add to it.

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/io/cell_table.h"
#include "core/io/medit.h"
#include "core/io/tokenizer.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kSyntax{.comment = '#', .comma_is_blank = false, .backslash_joins_lines = false, .free_form = true};

struct CellSection {
  std::string_view keyword;
  CellShape shape;
};
constexpr std::array kCellSections{
    CellSection{"Edges", CellShape::Line},
    CellSection{"Triangles", CellShape::Triangle},
    CellSection{"Quadrilaterals", CellShape::Quadrilateral},
    CellSection{"Tetrahedra", CellShape::Tetrahedron},
    CellSection{"Hexahedra", CellShape::Hexahedron},
    CellSection{"Hexaedra", CellShape::Hexahedron},  // as old files spell it
    CellSection{"Prisms", CellShape::Wedge},
    CellSection{"Pentahedra", CellShape::Wedge},
    CellSection{"Pyramids", CellShape::Pyramid},
};

bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// TrianglesP2, HexahedraQ2, ...: elements with nodes beyond their corners.
bool is_higher_order(std::string_view keyword) {
  if (keyword.size() < 3) return false;
  const char family = keyword[keyword.size() - 2];
  const char order = keyword.back();
  const std::string_view linear = keyword.substr(0, keyword.size() - 2);
  return (family == 'P' || family == 'Q') && order >= '2' && order <= '9' &&
         std::any_of(kCellSections.begin(), kCellSections.end(),
                     [&](const CellSection& s) { return equal_ignoring_case(s.keyword, linear); });
}

/// Bytes that begin the binary variant: the number 1 in either byte order, then a version of 1 to 4.
bool is_binary(std::string_view bytes) {
  constexpr std::string_view kLittle("\x01\0\0\0", 4);
  constexpr std::string_view kBig("\0\0\0\x01", 4);
  if (bytes.size() < 8) return false;
  const auto version = static_cast<unsigned char>(bytes.starts_with(kLittle) ? bytes[4] : bytes[7]);
  return (bytes.starts_with(kLittle) || bytes.starts_with(kBig)) && version >= 1 && version <= 4;
}

class MeditReader {
 public:
  MeditReader(SourceFile& source, Progress& progress)
      : source_(source), progress_(progress), tokens_(source.bytes(), source.path().string(), kSyntax, progress) {}

  Mesh read() {
    if (is_binary(source_.bytes())) {
      tokens_.fail_at(0, "binary MEDIT files (.meshb) are not read: save the mesh as ASCII .mesh");
    }
    const std::string_view first = tokens_.token();
    if (!equal_ignoring_case(first, kMeditSignature)) {
      tokens_.fail(fmt::format("a MEDIT file begins with {}, this one with {}", kMeditSignature, quote_token(first)));
    }
    const std::int64_t version = tokens_.read_integer("version after MeshVersionFormatted");
    if (version < 1 || version > 4) tokens_.fail(fmt::format("MeshVersionFormatted {}: versions 1 to 4 are read", version));
    while (!tokens_.at_end()) {
      const std::string_view keyword = tokens_.token();
      if (equal_ignoring_case(keyword, "End")) break;
      section(keyword);
    }
    finish();
    return std::move(mesh_);
  }

 private:
  void section(std::string_view keyword) {
    if (!is_letter(keyword.front()))
      tokens_.fail(fmt::format("expected a keyword, got {} (more lines than the count says?)", quote_token(keyword)));
    const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    const auto cells = std::find_if(kCellSections.begin(), kCellSections.end(), [&](const CellSection& s) { return is(s.keyword); });
    if (!is_known(keyword)) return skip(keyword);
    if (std::ranges::any_of(met_, is)) tokens_.fail(fmt::format("{} a second time", keyword));
    met_.emplace_back(keyword);
    if (is("Dimension")) {
      dimension();
    } else if (is("Vertices")) {
      vertices();
    } else if (cells != kCellSections.end()) {
      read_cells(*cells);
    } else {
      marks(keyword);
    }
  }

  [[nodiscard]] bool is_known(std::string_view keyword) const {
    if (is_higher_order(keyword)) {
      tokens_.fail(fmt::format("{} are elements of higher order, of which only the linear ones are read: export linear elements", keyword));
    }
    const auto same = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    return same("Dimension") || same("Vertices") || std::any_of(kMeditMarks.begin(), kMeditMarks.end(), same) ||
           std::any_of(kCellSections.begin(), kCellSections.end(), [&](const CellSection& s) { return same(s.keyword); });
  }

  /// What follows a keyword that we do not know, up to the next one.
  void skip(std::string_view keyword) {
    source_.add_only_in_file(keyword);
    while (!tokens_.at_end()) {
      const std::size_t offset = tokens_.offset();
      const std::size_t line = tokens_.line();
      if (!is_letter(tokens_.token().front())) continue;
      return tokens_.seek(offset, line);
    }
  }

  void dimension() {
    dimension_ = static_cast<int>(tokens_.read_integer("dimension"));
    if (dimension_ != 2 && dimension_ != 3) tokens_.fail(fmt::format("Dimension {}: only 2 and 3 dimensions are read", dimension_));
    CoordinateLayout layout;
    layout.components = dimension_;
    layout.syntax = kSyntax;
    source_.set_layout(layout);
  }

  int reference() {
    const std::int64_t value = tokens_.read_integer("reference");
    if (!std::in_range<int>(value)) tokens_.fail(fmt::format("reference {} is too large", value));
    return static_cast<int>(value);
  }

  void vertices() {
    if (dimension_ == 0) tokens_.fail("Vertices before Dimension");
    const std::size_t shortest = dimension_ == 2 ? 6 : 8;  // "0 0 0\n"
    const std::size_t count = tokens_.read_count("number of Vertices", shortest);
    vertex_count_ = count;
    reserve_large(mesh_.positions, count);
    source_.reserve_places(count);
    references_.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
      if (tokens_.at_end()) tokens_.fail_at_end("x coordinate");
      source_.add_place(tokens_.offset());
      Vec3 p;
      p.x = tokens_.read_double("x coordinate");
      p.y = tokens_.read_double("y coordinate");
      if (dimension_ == 3) p.z = tokens_.read_double("z coordinate");
      mesh_.positions.push_back(p);
      references_.push_back(reference());
    }
  }

  /// How many vertices the file has: elements may come before them.
  std::size_t vertex_count() {
    if (vertex_count_) return *vertex_count_;
    Tokenizer ahead(source_.bytes(), source_.path().string(), kSyntax, progress_);
    ahead.seek(tokens_.offset(), tokens_.line());
    while (!ahead.at_end()) {
      if (equal_ignoring_case(ahead.token(), "Vertices")) {
        vertex_count_ = ahead.read_count("number of Vertices", 6);
        return *vertex_count_;
      }
    }
    tokens_.fail("the file has no Vertices");
  }

  void read_cells(const CellSection& section) {
    const Index corners = corners_of(section.shape);
    const std::size_t vertices = vertex_count();
    const std::size_t count = tokens_.read_count(fmt::format("number of {}", section.keyword), 2 * (std::size_t{corners} + 1));
    cells_.reserve_more(count, count * corners);
    if (section.shape == CellShape::Line) edges_.reserve(2 * count);
    for (std::size_t i = 0; i < count; ++i) {
      std::array<Index, 8> of_cell{};
      for (Index k = 0; k < corners; ++k) of_cell[k] = tokens_.read_index("vertex index", vertices, "vertices", 1);
      cells_.add(section.shape, of_cell.data(), origin_of(reference()));
      if (section.shape == CellShape::Line) edges_.insert(edges_.end(), {of_cell[0], of_cell[1]});
    }
  }

  std::uint32_t origin_of(int reference) {
    if (!labels_.empty() && labels_[last_origin_].labels.front().code == reference) return last_origin_;
    const auto [at, added] = origins_.try_emplace(reference, static_cast<std::uint32_t>(labels_.size()));
    if (added) labels_.push_back({{{fmt::format("reference {}", reference), std::string(kMeditReference), reference}}, reference != 0});
    return last_origin_ = at->second;
  }

  /// Corners, Ridges, ...: numbers of vertices or edges, which may come later.
  void marks(std::string_view keyword) {
    const std::size_t count = tokens_.read_count(fmt::format("number of {}", keyword), 2);
    Marks marks{std::string(keyword), {}, {}};
    marks.numbers.reserve(count);
    marks.lines.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      marks.numbers.push_back(tokens_.read_integer(fmt::format("number in {}", keyword)));
      marks.lines.push_back(tokens_.line());
    }
    marks_.push_back(std::move(marks));
  }

  struct Marks {
    std::string keyword;
    std::vector<std::int64_t> numbers;  // from 1
    std::vector<std::size_t> lines;     // where each stands
  };

  void add_marks(const Marks& marks) {
    const bool of_edges = is_medit_edge_mark(marks.keyword);
    const std::size_t things = of_edges ? edges_.size() / 2 : mesh_.positions.size();
    Group group{.name = marks.keyword, .role = std::string(kMeditMark), .code = 0, .dimension = of_edges ? 1 : 0, .members = {}};
    for (std::size_t i = 0; i < marks.numbers.size(); ++i) {
      const std::int64_t number = marks.numbers[i];
      if (number < 1 || static_cast<std::uint64_t>(number) > things) {
        tokens_.fail_at(marks.lines[i], fmt::format("{} {} out of range (the file has {} {})", marks.keyword, number, things,
                                                    of_edges ? "edges" : "vertices"));
      }
      const auto at = static_cast<std::size_t>(number - 1);
      if (of_edges) {
        group.members.insert(group.members.end(), {edges_[2 * at], edges_[2 * at + 1]});
      } else {
        group.members.push_back(static_cast<Index>(at));
      }
    }
    if (!group.members.empty()) mesh_.groups.push_back(std::move(group));
  }

  void add_field(Field::On on, std::vector<double> values) {
    mesh_.fields.push_back({.name = std::string(kMeditField),
                            .on = on,
                            .components = 1,
                            .type = "int",
                            .role = std::string(kMeditReference),
                            .values = std::move(values)});
  }

  /// Elements and groups. References of elements are groups while these are few, else (a number for each element, say) a field.
  void add_cells() {
    constexpr std::size_t kMostGroups = 256;
    std::vector<std::uint8_t> of_element(labels_.size(), 0);  // by origin
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (dimension_of(cells_.shape(c)) == cells_.dimension()) of_element[cells_.origin(c)] = 1;
    }
    const bool many = static_cast<std::size_t>(std::count(of_element.begin(), of_element.end(), 1)) > kMostGroups;
    if (many) {
      for (OriginLabels& labels : labels_) labels.of_elements = false;
    }
    const std::vector<Index> rows = split_cells(cells_, labels_, mesh_, source_);
    if (!many) return;
    std::vector<double> values(mesh_.elements.size());
    for (Index e = 0; e < mesh_.elements.size(); ++e) {
      values[e] = labels_[cells_.origin(rows.empty() ? e : rows[e])].labels.front().code;
    }
    add_field(Field::On::Elements, std::move(values));
  }

  void finish() {
    if (dimension_ == 0) tokens_.fail_at_end("Dimension");
    if (mesh_.positions.empty()) tokens_.fail_at_end("Vertices");
    add_cells();
    for (const Marks& marks : marks_) add_marks(marks);
    if (std::any_of(references_.begin(), references_.end(), [](int r) { return r != 0; })) {
      add_field(Field::On::Vertices, {references_.begin(), references_.end()});
    }
    if (source_.bytes().find('#') != std::string_view::npos) source_.add_only_in_file("comments");
  }

  SourceFile& source_;
  Progress& progress_;
  Tokenizer tokens_;
  Mesh mesh_;
  int dimension_ = 0;
  std::optional<std::size_t> vertex_count_;
  std::vector<std::string> met_;  // sections, in whatever case they were written
  std::vector<int> references_;   // of vertices
  CellTable cells_;
  std::vector<Index> edges_;  // two vertices each
  std::vector<OriginLabels> labels_;
  std::unordered_map<int, std::uint32_t> origins_;  // by reference
  std::uint32_t last_origin_ = 0;
  std::vector<Marks> marks_;
};

bool recognises(std::string_view bytes) {
  constexpr std::size_t kLook = 65536;  // bytes in which comments end
  if (is_binary(bytes)) return true;
  Progress unwatched;
  Tokenizer tokens(bytes.substr(0, kLook), {}, kSyntax, unwatched);
  return equal_ignoring_case(tokens.token(), kMeditSignature);
}

Mesh read(SourceFile& source, const IoContext& context) { return MeditReader(source, context.progress).read(); }

}  // namespace

bool is_medit_edge_mark(std::string_view keyword) noexcept {
  return equal_ignoring_case(keyword, "Ridges") || equal_ignoring_case(keyword, "RequiredEdges");
}

const FormatHandler& medit_format() {
  static const FormatHandler handler{
      {"medit", "MEDIT", ".mesh", "2D and 3D elements, references, corners, ridges, required vertices and edges; ASCII"},
      recognises,
      read,
      write_medit};
  return handler;
}

}  // namespace dmoscope
