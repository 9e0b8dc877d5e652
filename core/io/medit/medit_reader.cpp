// Reader of MEDIT's ASCII format: a keyword, a count, and that number of lines, in any order; everything has a reference number.
// https://www.ljll.fr/frey/publications/RT-0253.pdf, and the additions of mmg and tetgen.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/medit/medit.h"
#include "core/io/reading/tokenizer.h"

namespace dmoscope {

void MeditContents::reserve_cells(CellShape shape, std::size_t count) {
  cells_.reserve_more(count, count * corners_of(shape));
  if (shape == CellShape::Line) edges_.reserve(2 * count);
}

void MeditContents::add_cell(CellShape shape, const Index* corners, int reference) {
  cells_.add(shape, corners, origin_of(reference));
  if (shape == CellShape::Line) edges_.insert(edges_.end(), {corners[0], corners[1]});
}

std::uint32_t MeditContents::origin_of(int reference) {
  if (!labels_.empty() && labels_[last_origin_].labels.front().code == reference) return last_origin_;
  const auto [at, added] = origins_.try_emplace(reference, static_cast<std::uint32_t>(labels_.size()));
  if (added) labels_.push_back({{{fmt::format("reference {}", reference), std::string(kMeditReference), reference}}, reference != 0});
  return last_origin_ = at->second;
}

void MeditContents::fail_mark(const MeditMarks& marks, std::size_t i, std::size_t things, std::string_view what) const {
  throw InputError(source_.path().string(), marks.lines.empty() ? 0 : marks.lines[i],
                   fmt::format("{} {} out of range (the file has {} {})", marks.keyword, marks.numbers[i], things, what));
}

void MeditContents::make_group(const MeditMarks& marks) {
  const CellShape shape = medit_mark(marks.keyword)->of;
  if (shape >= CellShape::Triangle) return make_face_group(marks, shape);
  const bool of_edges = shape == CellShape::Line;
  const std::size_t things = of_edges ? edges_.size() / 2 : mesh.positions.size();
  Group group{.name = marks.keyword, .role = std::string(kMeditMark), .code = 0, .dimension = of_edges ? 1 : 0};
  for (std::size_t i = 0; i < marks.numbers.size(); ++i) {
    const std::int64_t number = marks.numbers[i];
    if (number < 1 || static_cast<std::uint64_t>(number) > things) fail_mark(marks, i, things, of_edges ? "edges" : "vertices");
    const auto at = static_cast<std::size_t>(number - 1);
    if (of_edges) {
      group.members.insert(group.members.end(), {edges_[2 * at], edges_[2 * at + 1]});
    } else {
      group.members.push_back(static_cast<Index>(at));
    }
  }
  if (!group.members.empty()) mesh.groups.push_back(std::move(group));
}

/// Makes a group of faces of a volume, or of elements if these are the mesh.
void MeditContents::make_face_group(const MeditMarks& marks, CellShape shape) {
  std::vector<Index> cells;  // those of this shape
  for (Index c = 0; c < cells_.size(); ++c)
    if (cells_.shape(c) == shape) cells.push_back(c);
  const std::vector<std::span<const Index>> corners = cells_.corners_by_cell();
  const std::vector<Index> elements = elements_of_cells(cells_, mesh, rows_);
  Group group{.name = marks.keyword, .role = std::string(kMeditMark), .code = 0, .dimension = 2};
  for (std::size_t i = 0; i < marks.numbers.size(); ++i) {
    const std::int64_t number = marks.numbers[i];
    if (number < 1 || static_cast<std::uint64_t>(number) > cells.size()) fail_mark(marks, i, cells.size(), info(*kind_of(shape)).plural);
    const Index cell = cells[static_cast<std::size_t>(number - 1)];
    if (elements[cell] == kNoIndex) {
      group.faces.add(*kind_of(shape), corners[cell]);
    } else {
      group.members.push_back(elements[cell]);
    }
  }
  if (!group.members.empty() || group.faces.size() > 0) mesh.groups.push_back(std::move(group));
}

void MeditContents::add_field(Field::On on, std::vector<double> values) {
  mesh.fields.push_back(
      {.name = std::string(kMeditField), .on = on, .type = "int", .role = std::string(kMeditReference), .values = std::move(values)});
}

/// Makes elements and groups. References of elements become groups if they are few, else a field.
void MeditContents::split() {
  constexpr std::size_t kMostGroups = 256;
  std::vector<std::uint8_t> of_element(labels_.size(), 0);  // flags by origin
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    if (dimension_of(cells_.shape(c)) == cells_.dimension()) of_element[cells_.origin(c)] = 1;
  }
  const bool many = static_cast<std::size_t>(std::count(of_element.begin(), of_element.end(), 1)) > kMostGroups;
  if (many) {
    for (OriginLabels& labels : labels_) labels.of_elements = false;
  }
  rows_ = split_cells(cells_, labels_, mesh, source_);
  if (!many) return;
  std::vector<double> values(mesh.elements.size());
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    values[e] = labels_[cells_.origin(rows_.empty() ? e : rows_[e])].labels.front().code;
  }
  add_field(Field::On::Elements, std::move(values));
}

Mesh MeditContents::finish() {
  split();
  for (const MeditMarks& marks : marks_) make_group(marks);
  if (std::any_of(references.begin(), references.end(), [](int r) { return r != 0; })) {
    add_field(Field::On::Vertices, {references.begin(), references.end()});
  }
  return std::move(mesh);
}

namespace {

constexpr TextSyntax kMeditSyntax{.comment = '#', .comma_is_blank = false, .backslash_joins_lines = false, .free_form = true};

bool is_letter(char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Whether a section has elements of higher order, with nodes beyond their corners: TrianglesP2, HexahedraQ2, ...
bool is_higher_order(std::string_view keyword) {
  if (keyword.size() < 3) return false;
  const char family = keyword[keyword.size() - 2];
  const char order = keyword.back();
  const std::string_view linear = keyword.substr(0, keyword.size() - 2);
  return (family == 'P' || family == 'Q') && order >= '2' && order <= '9' &&
         std::any_of(kMeditCells.begin(), kMeditCells.end(), [&](const MeditCells& s) { return equal_ignoring_case(s.keyword, linear); });
}

class MeditReader {
 public:
  MeditReader(SourceFile& source, const IoContext& context)
      : source_(source),
        progress_(context.progress),
        tokens_(source.bytes(), source.path().string(), kMeditSyntax, context.progress),
        contents_(source) {}

  Mesh read() {
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
    return finish();
  }

 private:
  void section(std::string_view keyword) {
    if (!is_letter(keyword.front()))
      tokens_.fail(fmt::format("expected a keyword, got {} (more lines than the count says?)", quote_token(keyword)));
    const auto is = [&](std::string_view word) { return equal_ignoring_case(keyword, word); };
    const auto cells = std::find_if(kMeditCells.begin(), kMeditCells.end(), [&](const MeditCells& s) { return is(s.keyword); });
    if (!is_known(keyword)) return skip(keyword);
    if (std::ranges::any_of(met_, is)) tokens_.fail(fmt::format("{} a second time", keyword));
    met_.emplace_back(keyword);
    if (is("Dimension")) {
      dimension();
    } else if (is("Vertices")) {
      vertices();
    } else if (cells != kMeditCells.end()) {
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
    return same("Dimension") || same("Vertices") || medit_mark(keyword) != nullptr ||
           std::any_of(kMeditCells.begin(), kMeditCells.end(), [&](const MeditCells& s) { return same(s.keyword); });
  }

  /// Skips an unknown keyword, up to the next one.
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
    source_.set_layout({.components = dimension_, .syntax = kMeditSyntax});
  }

  int reference() {
    const std::int64_t value = tokens_.read_integer("reference");
    if (!std::in_range<int>(value)) tokens_.fail(fmt::format("reference {} is too large", value));
    return static_cast<int>(value);
  }

  void vertices() {
    if (dimension_ == 0) tokens_.fail("Vertices before Dimension");
    const std::size_t shortest = dimension_ == 2 ? 6 : 8;  // bytes of "0 0 0\n"
    const std::size_t count = tokens_.read_count("number of Vertices", shortest);
    vertex_count_ = count;
    reserve_large(contents_.mesh.positions, count);
    source_.reserve_places(count);
    contents_.references.reserve(count);
    for (std::size_t v = 0; v < count; ++v) {
      std::size_t place = 0;
      contents_.mesh.positions.push_back(tokens_.read_point(dimension_, place));
      source_.add_place(place);
      contents_.references.push_back(reference());
    }
  }

  /// Number of vertices in the file, found ahead: elements may come before them.
  std::size_t vertex_count() {
    if (vertex_count_) return *vertex_count_;
    Tokenizer ahead(source_.bytes(), source_.path().string(), kMeditSyntax, progress_);
    ahead.seek(tokens_.offset(), tokens_.line());
    while (!ahead.at_end()) {
      if (equal_ignoring_case(ahead.token(), "Vertices")) {
        vertex_count_ = ahead.read_count("number of Vertices", 6);
        return *vertex_count_;
      }
    }
    tokens_.fail("the file has no Vertices");
  }

  void read_cells(const MeditCells& section) {
    const Index corners = corners_of(section.shape);
    const std::size_t vertices = vertex_count();
    const std::size_t count = tokens_.read_count(fmt::format("number of {}", section.keyword), 2 * (std::size_t{corners} + 1));
    contents_.reserve_cells(section.shape, count);
    for (std::size_t i = 0; i < count; ++i) {
      std::array<Index, 8> of_cell{};
      for (Index k = 0; k < corners; ++k) of_cell[k] = tokens_.read_index("vertex index", vertices, "vertices", 1);
      contents_.add_cell(section.shape, of_cell.data(), reference());
    }
  }

  /// Reads marks such as Corners or Ridges: numbers of vertices, edges or faces, which may come later.
  void marks(std::string_view keyword) {
    const std::size_t count = tokens_.read_count(fmt::format("number of {}", keyword), 2);
    MeditMarks marks{std::string(keyword), {}, {}};
    marks.numbers.reserve(count);
    marks.lines.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      marks.numbers.push_back(tokens_.read_integer(fmt::format("number in {}", keyword)));
      marks.lines.push_back(tokens_.line());
    }
    contents_.add_marks(std::move(marks));
  }

  Mesh finish() {
    if (dimension_ == 0) tokens_.fail_at_end("Dimension");
    if (contents_.mesh.positions.empty()) tokens_.fail_at_end("Vertices");
    if (source_.bytes().find('#') != std::string_view::npos) source_.add_only_in_file("comments");
    Mesh mesh = contents_.finish();
    read_solutions_beside(source_, mesh, progress_);
    return mesh;
  }

  SourceFile& source_;
  Progress& progress_;
  Tokenizer tokens_;
  MeditContents contents_;
  int dimension_ = 0;
  std::optional<std::size_t> vertex_count_;
  std::vector<std::string> met_;  // sections read so far, in lower case
};

bool recognises_medit(std::string_view bytes) {
  constexpr std::size_t kLook = 65536;  // bytes within which comments end
  Progress unwatched;
  Tokenizer tokens(bytes.substr(0, kLook), {}, kMeditSyntax, unwatched);
  return equal_ignoring_case(tokens.token(), kMeditSignature);
}

}  // namespace

const MeditMark* medit_mark(std::string_view keyword) noexcept {
  const auto* const found =
      std::ranges::find_if(kMeditMarks, [&](const MeditMark& mark) { return equal_ignoring_case(mark.keyword, keyword); });
  return found == kMeditMarks.end() ? nullptr : found;
}

constinit const FormatHandler kMeditFormat{
    .info = {"medit", "MEDIT", ".mesh", "2D and 3D elements, references, corners, ridges, required vertices, edges and faces; ASCII"},
    .recognises = recognises_medit,
    .read = read_with<MeditReader>,
    .write = write_medit,
    .further = solutions_beside};

}  // namespace dmoscope
