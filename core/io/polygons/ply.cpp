// PLY: ascii, binary_little_endian and binary_big_endian, with any properties in any order.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/io/mesh_writer.h"
#include "core/io/polygons/ply_header.h"
#include "core/io/reading/binary.h"
#include "core/io/reading/mixed_input.h"
#include "core/io/writing/text_writer.h"

namespace dmoscope {
namespace {

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
constexpr std::array<std::string_view, 2> kCorners{"vertex_indices", "vertex_index"};

/// One element of the file.
struct Row {
  std::size_t place = 0;            // byte offset of its first value
  std::vector<double> scalars;      // values of the properties; 0 for lists
  std::vector<std::size_t> places;  // offsets of the properties
  std::vector<std::int64_t> list;   // entries of the requested list
  std::vector<std::size_t> list_places;
};

class PlyReader {
 public:
  PlyReader(SourceFile& source, const IoContext& context) : source_(source), in_(source, context.progress) {}

  Mesh read() {
    header_ = read_ply_header(in_);
    mesh_.title = header_.title;
    const PlyElement& vertices = required("vertex");
    required("face");
    vertex_count_ = vertices.count;
    for (const PlyElement& element : header_.elements) {
      check_count(element);
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip(element);
      }
    }
    if (ascii() && !in_.at_end()) {
      in_.word("the end");
      in_.fail("the file goes on after the last element that its header declares");
    }
    if (!ascii() && in_.left() > 0) source_.add_note(fmt::format("{} bytes after the last element were passed over.", in_.left()));
    return std::move(mesh_);
  }

 private:
  [[nodiscard]] bool ascii() const noexcept { return header_.encoding == PlyEncoding::Ascii; }
  [[nodiscard]] bool big_endian() const noexcept { return header_.encoding == PlyEncoding::BigEndian; }

  /// Checks a count, so that a wrong one does not allocate more than the file's size justifies.
  void check_count(const PlyElement& element) const {
    const double bytes = static_cast<double>(element.count) * static_cast<double>(element.least_size(header_.encoding));
    // Allows one more byte, since the last word of a text needs no separator after it.
    if (bytes <= static_cast<double>(in_.left()) + 1.0) return;
    in_.fail_at(element.place, fmt::format("{} elements {} are declared, but only {} bytes are left for them", element.count,
                                           quote_token(element.name), in_.left()));
  }

  const PlyElement& required(std::string_view name) {
    const auto found = std::find_if(header_.elements.begin(), header_.elements.end(), [&](const PlyElement& e) { return e.name == name; });
    if (found == header_.elements.end()) in_.fail(fmt::format("the header has no element \"{}\"", name));
    return *found;
  }

  /// Reads one element; the entries of list number `list` are kept, those of others skipped.
  void read_row(const PlyElement& element, std::size_t list, Row& row) {
    row.scalars.resize(element.properties.size());
    row.places.resize(element.properties.size());
    if (ascii()) (void)in_.at_end();  // skips empty lines between elements
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (property.list) {
        const auto n = static_cast<std::size_t>(list_count(property, p == 0));
        row.places[p] = in_.token();
        if (p == list) {
          read_list(property, n, row);
        } else {
          for (std::size_t i = 0; ascii() && i < n; ++i) scalar(property, false);
          if (!ascii()) in_.block(n * size_of(property.type), "a list");
        }
      } else {
        row.scalars[p] = scalar(property, p == 0);
        row.places[p] = in_.token();
      }
    }
    if (!row.places.empty()) row.place = row.places.front();
    if (ascii() && !in_.line_over()) {
      in_.word("the end of the line");
      in_.fail(fmt::format("the line of a {} has more numbers than the header declares", element.name));
    }
  }

  double scalar(const PlyProperty& property, bool first) {
    if (ascii()) {
      same_line(property, first);
      return in_.number(property.name);
    }
    return load_scalar(in_.block(size_of(property.type), property.name).data(), property.type, big_endian());
  }

  std::int64_t whole(const PlyProperty& property, ScalarType type, bool first) {
    if (ascii()) {
      same_line(property, first);
      return in_.integer(property.name);
    }
    return load_whole(in_.block(size_of(type), property.name).data(), type, big_endian());
  }

  /// Checks that an element is on a single line in an ASCII file.
  void same_line(const PlyProperty& property, bool first) {
    if (!first && in_.line_over()) in_.fail(fmt::format("the line ends where {} is expected", quote_token(property.name)));
  }

  std::int64_t list_count(const PlyProperty& property, bool first) {
    const std::int64_t n = whole(property, property.count_type, first);
    if (n < 0) in_.fail(fmt::format("list {} has a negative count", quote_token(property.name)));
    const double bytes_each = ascii() ? 2.0 : static_cast<double>(size_of(property.type));
    if (n >= kNoIndex || static_cast<double>(n) * bytes_each > static_cast<double>(in_.left())) {
      in_.need(static_cast<std::size_t>(n), bytes_each, fmt::format("the count of list {}", quote_token(property.name)));
    }
    return n;
  }

  void read_list(const PlyProperty& property, std::size_t n, Row& row) {
    row.list.clear();
    row.list_places.clear();
    for (std::size_t i = 0; i < n; ++i) {
      row.list.push_back(whole(property, property.type, false));
      row.list_places.push_back(in_.token());
    }
  }

  void skip(const PlyElement& element) {
    if (element.count == 0) return;
    source_.add_only_in_file(fmt::format("{} elements {}", element.count, quote_token(element.name)));
    if (element.properties.empty()) return;
    Row row;
    for (std::size_t i = 0; i < element.count; ++i) read_row(element, element.properties.size(), row);
  }

  /// Adds a field for each scalar property that `known` does not have; returns the properties' indices.
  std::vector<std::size_t> add_fields(const PlyElement& element, Field::On on, std::span<const std::string_view> known) {
    std::vector<std::size_t> indices;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (std::find(known.begin(), known.end(), property.name) != known.end()) continue;
      if (property.list) {
        source_.add_only_in_file(fmt::format("lists {} of the {} elements", quote_token(property.name), quote_token(element.name)));
        continue;
      }
      Field field;
      field.name = property.name;
      field.on = on;
      field.type = property.type_word;
      field.role = "property";
      reserve_large(field.values, element.count);
      const std::optional<std::uint32_t> at = place_in_row(element, p);
      if (on == Field::On::Vertices && at) field.place = {.with_positions = true, .at = *at};
      mesh_.fields.push_back(std::move(field));
      indices.push_back(p);
    }
    return indices;
  }

  void read_vertices(const PlyElement& element) {
    std::array<std::size_t, 3> axis{};
    for (std::size_t k = 0; k < 3; ++k) {
      axis[k] = element.find(kAxes[k]);
      if (axis[k] == element.properties.size()) in_.fail_at(element.place, fmt::format("vertices have no property \"{}\"", kAxes[k]));
      if (element.properties[axis[k]].list) in_.fail_at(element.place, fmt::format("property \"{}\" of the vertices is a list", kAxes[k]));
    }
    const std::size_t first_field = mesh_.fields.size();
    const std::vector<std::size_t> others = add_fields(element, Field::On::Vertices, kAxes);
    reserve_large(mesh_.positions, element.count);
    const bool uniform = !ascii() && !element.has_list();
    if (uniform) {
      source_.set_uniform_places(in_.offset(), element.least_size(header_.encoding), element.count);
    } else {
      source_.reserve_places(element.count);
    }
    Row row;
    for (std::size_t v = 0; v < element.count; ++v) {
      read_row(element, element.properties.size(), row);
      for (const std::size_t p : axis) {
        if (!std::isfinite(row.scalars[p])) in_.fail_at(row.places[p], fmt::format("a coordinate of vertex {} is not a finite number", v));
      }
      mesh_.positions.push_back({row.scalars[axis[0]], row.scalars[axis[1]], row.scalars[axis[2]]});
      if (!uniform) source_.add_place(row.place);
      for (std::size_t i = 0; i < others.size(); ++i) mesh_.fields[first_field + i].values.push_back(row.scalars[others[i]]);
    }
    set_layout(element, axis);
  }

  /// Words, or bytes, from a row's begin to one of its properties; none if a list comes before it.
  [[nodiscard]] std::optional<std::uint32_t> place_in_row(const PlyElement& element, std::size_t property) const {
    std::size_t at = 0;
    for (std::size_t p = 0; p < property; ++p) {
      if (element.properties[p].list) return std::nullopt;
      at += ascii() ? 1 : size_of(element.properties[p].type);
    }
    return static_cast<std::uint32_t>(at);
  }

  void set_layout(const PlyElement& element, const std::array<std::size_t, 3>& axis) {
    CoordinateLayout layout;
    layout.binary = !ascii();
    layout.big_endian = big_endian();
    for (std::size_t k = 0; k < 3; ++k) {
      const ScalarType type = element.properties[axis[k]].type;
      const std::optional<std::uint32_t> at = place_in_row(element, axis[k]);
      if (!at) source_.set_not_patchable("lists come before its coordinates");
      layout.at[k] = at.value_or(0);
      layout.scalar[k] = type == ScalarType::Float32 ? CoordinateScalar::Float32 : CoordinateScalar::Float64;
      if (is_whole(type)) source_.set_not_patchable("its coordinates are whole numbers");
    }
    source_.set_layout(layout);
  }

  void read_faces(const PlyElement& element) {
    std::size_t list = element.find(kCorners[0]);
    if (list == element.properties.size()) list = element.find(kCorners[1]);
    if (list == element.properties.size()) in_.fail_at(element.place, "faces have no list \"vertex_indices\" or \"vertex_index\"");
    const PlyProperty& property = element.properties[list];
    if (!property.list || !is_whole(property.type)) {
      in_.fail_at(element.place, fmt::format("property {} of the faces is no list of whole numbers", quote_token(property.name)));
    }
    const std::size_t first_field = mesh_.fields.size();
    const std::string_view known = property.name;
    const std::vector<std::size_t> others = add_fields(element, Field::On::Elements, std::span(&known, 1));
    mesh_.elements.reserve(element.count, element.count * 3);
    Row row;
    std::array<Index, 4> corners{};
    for (std::size_t f = 0; f < element.count; ++f) {
      read_row(element, list, row);
      const std::size_t n = row.list.size();
      if (n != 3 && n != 4) in_.fail_at(row.places[list], fmt::format("face {} has {} corners: only 3 and 4 can be smoothed", f, n));
      for (std::size_t i = 0; i < n; ++i) {
        if (row.list[i] < 0 || static_cast<std::uint64_t>(row.list[i]) >= vertex_count_) {
          in_.fail_at(row.list_places[i],
                      fmt::format("face {} names vertex {}, but there are {} vertices (from 0)", f, row.list[i], vertex_count_));
        }
        corners[i] = static_cast<Index>(row.list[i]);
      }
      add_element(mesh_, n == 3 ? ElementKind::Triangle : ElementKind::Quadrilateral, std::span(corners).first(n), source_);
      for (std::size_t i = 0; i < others.size(); ++i) mesh_.fields[first_field + i].values.push_back(row.scalars[others[i]]);
    }
  }

  SourceFile& source_;
  MixedInput in_;
  PlyHeader header_;
  Mesh mesh_;
  std::size_t vertex_count_ = 0;
};

/// A field as a property of a new file.
struct Column {
  const Field* field;
  std::string name;
  ScalarType type;
};

class PlyWriter : MeshWriter {
 public:
  PlyWriter(AtomicFile& file, const Mesh& mesh, std::span<const Vec3> positions, const IoContext& context)
      : MeshWriter(file, mesh, positions, context, "PLY") {
    require_surface_elements(file, mesh, title_);
  }

  Notes write() {
    const std::vector<Column> of_vertices = columns(Field::On::Vertices, positions_.size(), kAxes);
    const std::vector<Column> of_faces = columns(Field::On::Elements, mesh_.elements.size(), kCorners);
    out_ << "ply\nformat ascii 1.0\n";
    if (!mesh_.title.empty()) out_ << "comment " << without_line_ends(mesh_.title) << '\n';
    out_ << "element vertex " << positions_.size() << "\nproperty double x\nproperty double y\nproperty double z\n";
    declare(of_vertices);
    out_ << "element face " << mesh_.elements.size() << "\nproperty list uchar uint vertex_indices\n";
    declare(of_faces);
    out_ << "end_header\n";
    out_.for_each(positions_.size(), [&](TextBuffer& part, std::size_t v) {
      part << positions_[v].x << ' ' << positions_[v].y << ' ' << positions_[v].z;
      values(part, of_vertices, v);
    });
    out_.for_each(mesh_.elements.size(), [&](TextBuffer& part, std::size_t e) {
      const FileCorners corners = file_corners(mesh_, e);
      part << corners.size();
      put_corners(part, corners, 0);
      values(part, of_faces, e);
    });
    return finish();
  }

 private:
  std::vector<Column> columns(Field::On on, std::size_t count, std::span<const std::string_view> reserved) {
    std::vector<Column> result;
    for (std::size_t i = 0; i < mesh_.fields.size(); ++i) {
      const Field& field = mesh_.fields[i];
      if (field.on != on || field.components != 1 || field.values.size() != count) continue;
      kept_fields_.push_back(i);
      std::string name = field.name.empty() ? "unnamed" : field.name;
      for (char& c : name) {
        if (static_cast<unsigned char>(c) <= ' ' || c == 0x7f) c = '_';
      }
      const auto taken = [&](const std::string& wanted) {
        return std::find(reserved.begin(), reserved.end(), wanted) != reserved.end() ||
               std::any_of(result.begin(), result.end(), [&](const Column& column) { return column.name == wanted; });
      };
      while (taken(name)) name += '_';
      if (name != field.name) notes_.push_back(fmt::format("Field \"{}\" is called \"{}\" in the PLY file.", field.name, name));
      result.push_back({&field, name, type_of(field)});
    }
    return result;
  }

  static ScalarType type_of(const Field& field) {
    ScalarType type = ScalarType::Float64;
    if (!scalar_of_word(field.type, type) || ply_word(type) == "double") return ScalarType::Float64;
    const bool fits = std::all_of(field.values.begin(), field.values.end(), [type](double v) { return holds_exactly(type, v); });
    return fits ? type : ScalarType::Float64;
  }

  void declare(const std::vector<Column>& columns) {
    for (const Column& column : columns) out_ << "property " << ply_word(column.type) << ' ' << column.name << '\n';
  }

  static void values(TextBuffer& part, const std::vector<Column>& columns, std::size_t row) {
    for (const Column& column : columns) {
      part << ' ';
      if (is_whole(column.type)) {
        part << static_cast<std::int64_t>(column.field->values[row]);
      } else {
        part << column.field->values[row];
      }
    }
    part << '\n';
  }
};

bool recognises_ply(std::string_view bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r"); }

}  // namespace

constinit const FormatHandler kPlyFormat{
    .info = {"ply", "PLY", ".ply", "triangles and quadrilaterals with one number per property; ASCII and binary"},
    .recognises = recognises_ply,
    .read = read_with<PlyReader>,
    .write = write_with<PlyWriter>};

}  // namespace dmoscope
