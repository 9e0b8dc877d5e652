// The .node and .ele files of Triangle (2D) and TetGen (3D): vertices with attributes and boundary markers in the one, elements in the
// other. https://www.cs.cmu.edu/~quake/triangle.html, https://wias-berlin.de/software/tetgen/fformats.html

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/io/mesh_writer.h"
#include "core/io/reading/tokenizer.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr TextSyntax kTetgenSyntax{.comment = '#'};
constexpr std::string_view kMarker = "boundary marker";
constexpr std::string_view kAttribute = "attribute";
constexpr std::int64_t kMostAttributes = 1024;

/// Makes fields of columns of numbers; `before`: number of numbers before them in a row.
std::vector<Field> fields_of(Field::On on, std::size_t attributes, bool marker, std::size_t rows, std::size_t before) {
  std::vector<Field> fields;
  const auto add = [&](std::string name, std::string_view type, std::string_view role) {
    fields.push_back({.name = std::move(name),
                      .on = on,
                      .type = std::string(type),
                      .role = std::string(role),
                      .place = {.with_positions = on == Field::On::Vertices, .at = static_cast<std::uint32_t>(before + fields.size())}});
    fields.back().values.reserve(rows);
  };
  for (std::size_t k = 1; k <= attributes; ++k) add(fmt::format("{} {}", kAttribute, k), "double", kAttribute);
  if (marker) add(std::string(kMarker), "int", kMarker);
  return fields;
}

class TetgenReader {
 public:
  TetgenReader(SourceFile& source, const IoContext& context) : source_(source), progress_(context.progress) {}

  Mesh read() {
    if (source_.companion() == nullptr) throw InputError(source_.path().string(), 0, "the file with the elements (.ele) is missing");
    nodes();
    elements(*source_.companion());
    return std::move(mesh_);
  }

 private:
  /// Reads a line's first number: they count up from the first one's, which is 0 or 1.
  static void number(Tokenizer& tokens, std::size_t i, std::int64_t& first, std::string_view thing) {
    const std::int64_t found = tokens.read_integer(fmt::format("number of a {}", thing));
    if (i == 0) {
      if (found != 0 && found != 1) tokens.fail(fmt::format("the first {} has the number {}: they count from 0 or from 1", thing, found));
      first = found;
    } else if (found != first + static_cast<std::int64_t>(i)) {
      tokens.fail(
          fmt::format("{} {} follows {} {}: they must come in order", thing, found, thing, first + static_cast<std::int64_t>(i) - 1));
    }
  }

  /// Number of attributes: the next number of a header, which may be missing.
  static std::size_t attributes(Tokenizer& tokens) {
    if (!tokens.more_on_line()) return 0;
    const std::int64_t n = tokens.read_integer("number of attributes");
    if (n < 0 || n > kMostAttributes) tokens.fail(fmt::format("{} attributes: 0 to {} are possible", n, kMostAttributes));
    return static_cast<std::size_t>(n);
  }

  static void end_of_file(Tokenizer& tokens, std::string_view things) {
    if (!tokens.at_end()) tokens.fail(fmt::format("more lines than the number of {} says", things));
  }

  void nodes() {
    Tokenizer tokens(source_.bytes(), source_.path().string(), kTetgenSyntax, progress_);
    if (tokens.at_end()) tokens.fail_at_end("the number of vertices");
    const std::int64_t declared = tokens.read_integer("number of vertices");
    dimension_ = tokens.more_on_line() ? static_cast<int>(tokens.read_integer("dimension")) : 3;
    if (dimension_ != 2 && dimension_ != 3) tokens.fail(fmt::format("dimension {}: only 2 and 3 dimensions are read", dimension_));
    const std::size_t columns = attributes(tokens);
    const std::int64_t markers = tokens.more_on_line() ? tokens.read_integer("number of boundary markers") : 0;
    if (markers != 0 && markers != 1) tokens.fail(fmt::format("{} boundary markers: 0 or 1 are possible", markers));
    const std::size_t shortest = 2 * (1 + static_cast<std::size_t>(dimension_) + columns + static_cast<std::size_t>(markers));
    const std::size_t count = tokens.check_count(declared, "number of vertices", shortest);
    tokens.end_line();
    source_.set_layout({.components = dimension_, .syntax = kTetgenSyntax});
    reserve_large(mesh_.positions, count);
    source_.reserve_places(count);
    std::vector<Field> fields = fields_of(Field::On::Vertices, columns, markers == 1, count, static_cast<std::size_t>(dimension_));
    for (std::size_t v = 0; v < count; ++v) {
      if (tokens.at_end()) tokens.fail_at_end(fmt::format("vertex {} of {}", v + 1, count));
      number(tokens, v, first_, "vertex");
      std::size_t place = 0;
      mesh_.positions.push_back(tokens.read_point(dimension_, place));
      source_.add_place(place);
      for (Field& field : fields) field.values.push_back(value(tokens, field));
      tokens.end_line_of("a vertex");
    }
    end_of_file(tokens, "vertices");
    take(std::move(fields));
  }

  static double value(Tokenizer& tokens, const Field& field) {
    return field.role == kMarker ? static_cast<double>(tokens.read_integer(field.name)) : tokens.read_double(field.name);
  }

  void take(std::vector<Field> fields) {
    for (Field& field : fields) mesh_.fields.push_back(std::move(field));
  }

  void elements(const SourceFile& file) {
    Tokenizer tokens(file.bytes(), file.path().string(), kTetgenSyntax, progress_);
    if (tokens.at_end()) tokens.fail_at_end("the number of elements");
    const std::int64_t declared = tokens.read_integer("number of elements");
    const ElementKind kind = dimension_ == 2 ? ElementKind::Triangle : ElementKind::Tetrahedron;
    const std::int64_t corners = tokens.more_on_line() ? tokens.read_integer("corners of an element") : std::int64_t{info(kind).corners};
    if (corners == (dimension_ == 2 ? 6 : 10)) {
      tokens.fail(fmt::format("{} of {} nodes are of higher order, of which only the linear ones are read: make them without -o2",
                              info(kind).plural, corners));
    }
    if (corners != info(kind).corners) {
      tokens.fail(fmt::format("elements of {} corners in {} dimensions: only {} are read", corners, dimension_, info(kind).plural));
    }
    const std::size_t columns = attributes(tokens);
    const std::size_t count = tokens.check_count(declared, "number of elements", 2 * (1 + std::size_t{info(kind).corners} + columns));
    tokens.end_line();
    mesh_.elements.reserve(count, count * info(kind).corners);
    std::vector<Field> fields = fields_of(Field::On::Elements, columns, false, count, 0);
    std::int64_t first = 0;
    for (std::size_t e = 0; e < count; ++e) {
      if (tokens.at_end()) tokens.fail_at_end(fmt::format("element {} of {}", e + 1, count));
      number(tokens, e, first, "element");
      std::array<Index, 4> of_element{};
      const std::span<Index> used(of_element.data(), info(kind).corners);
      for (Index& c : used) c = tokens.read_index("vertex index", mesh_.positions.size(), "vertices", first_);
      add_element(mesh_, kind, used, file);
      for (Field& field : fields) field.values.push_back(value(tokens, field));
      tokens.end_line_of("an element");
    }
    end_of_file(tokens, "elements");
    take(std::move(fields));
    for (const std::string_view bytes : {source_.bytes(), file.bytes()}) {
      if (bytes.find('#') != std::string_view::npos) source_.add_only_in_file("comments");
    }
  }

  SourceFile& source_;
  Progress& progress_;
  Mesh mesh_;
  int dimension_ = 3;
  std::int64_t first_ = 1;  // number of the first vertex
};

// --- Writing new files: everything counts from 1 ---

/// A column of an attribute: values[row * stride] from `first` on.
struct ValueColumn {
  const Field* field;
  std::size_t component;
  [[nodiscard]] double at(std::size_t row) const { return field->values[row * static_cast<std::size_t>(field->components) + component]; }
};

struct Columns {
  std::vector<ValueColumn> attributes;
  const Field* marker = nullptr;
  std::vector<std::size_t> kept;  // indices of the fields
};

bool is_marker(const Field& field) {
  return field.on == Field::On::Vertices && field.role == kMarker && field.components == 1 && whole_values(field);
}

/// The fields of vertices or elements that the files can hold.
Columns columns_of(const Mesh& mesh, Field::On on) {
  Columns columns;
  const std::size_t things = on == Field::On::Vertices ? mesh.positions.size() : mesh.elements.size();
  for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
    const Field& field = mesh.fields[i];
    const bool finite = std::all_of(field.values.begin(), field.values.end(), [](double v) { return std::isfinite(v); });
    if (field.on != on || field.components < 1 || !finite || field.values.size() != things * static_cast<std::size_t>(field.components))
      continue;
    const auto most = static_cast<std::size_t>(kMostAttributes);
    if (columns.marker == nullptr && is_marker(field)) {
      columns.marker = &field;
    } else if (columns.attributes.size() + static_cast<std::size_t>(field.components) <= most) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(field.components); ++k) columns.attributes.push_back({&field, k});
    } else {
      continue;
    }
    columns.kept.push_back(i);
  }
  return columns;
}

/// Notes the number of each named attribute in the file.
void note_names(const Columns& columns, Notes& notes) {
  for (std::size_t k = 0; k < columns.attributes.size(); ++k) {
    const ValueColumn& column = columns.attributes[k];
    if (column.component != 0 || column.field->name == fmt::format("{} {}", kAttribute, k + 1)) continue;
    notes.push_back(fmt::format("Field \"{}\" was written as {} {} of the {}; .node and .ele files hold no names.", column.field->name,
                                kAttribute, k + 1, column.field->on == Field::On::Vertices ? "vertices" : "elements"));
  }
}

/// The kind of all elements. Throws OutputError if there are several.
ElementKind only_kind(const AtomicFile& file, const Mesh& mesh) {
  const auto kinds = mesh.elements.kinds();
  for (const ElementKind kind : kinds) {
    if ((kind == ElementKind::Triangle || kind == ElementKind::Tetrahedron) && kind == kinds.front()) continue;
    throw OutputError(file.path().string(),
                      fmt::format("{} holds only triangles or only tetrahedra, and the mesh has {}{}", kTetgenFormat.info.title,
                                  info(kinds.front()).plural, kind == kinds.front() ? "" : fmt::format(" and {}", info(kind).plural)));
  }
  return kinds.empty() ? ElementKind::Triangle : kinds.front();
}

Notes write_nodes(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context) {
  Notes notes;
  const bool volume = only_kind(file, mesh) == ElementKind::Tetrahedron;
  if (!volume) require_constant_z(file, positions, kTetgenFormat.info.title, notes);
  const Columns columns = columns_of(mesh, Field::On::Vertices);
  const Columns of_elements = columns_of(mesh, Field::On::Elements);
  note_names(columns, notes);
  note_names(of_elements, notes);
  std::vector<std::size_t> kept = columns.kept;
  kept.insert(kept.end(), of_elements.kept.begin(), of_elements.kept.end());
  note_dropped(mesh, kept, {}, kTetgenFormat.info.title, notes);

  TextWriter out(file, context);
  out << positions.size() << ' ' << (volume ? 3 : 2) << ' ' << columns.attributes.size() << ' ' << (columns.marker != nullptr ? 1 : 0)
      << '\n';
  out.for_each(positions.size(), [&](TextBuffer& part, std::size_t v) {
    part << v + 1 << ' ' << positions[v].x << ' ' << positions[v].y;
    if (volume) part << ' ' << positions[v].z;
    for (const ValueColumn& column : columns.attributes) part << ' ' << column.at(v);
    if (columns.marker != nullptr) part << ' ' << static_cast<std::int64_t>(columns.marker->values[v]);
    part << '\n';
  });
  out.finish();
  return notes;
}

void write_elements(AtomicFile& file, const Mesh& mesh, const IoContext& context) {
  const Columns columns = columns_of(mesh, Field::On::Elements);
  TextWriter out(file, context);
  out << mesh.elements.size() << ' ' << info(only_kind(file, mesh)).corners << ' ' << columns.attributes.size() << '\n';
  out.for_each(mesh.elements.size(), [&](TextBuffer& part, std::size_t e) {
    part << e + 1;
    put_corners(part, file_corners(mesh, e), 1);
    for (const ValueColumn& column : columns.attributes) part << ' ' << column.at(e);
    part << '\n';
  });
  out.finish();
}

constexpr CompanionFile kElementFile{".node", ".ele", write_elements};

}  // namespace

constinit const FormatHandler kTetgenFormat{.info = {"tetgen", "Triangle and TetGen", ".node .ele",
                                                     "triangles or tetrahedra, attributes, boundary markers; two files, either names both"},
                                            .read = read_with<TetgenReader>,
                                            .write = write_nodes,
                                            .companion = &kElementFile,
                                            .comment = {"# ", "\n"}};

}  // namespace dmoscope
