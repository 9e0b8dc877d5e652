// Meshes as bytes, for other processes: one list of members for both directions.

#include <concepts>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/fnv1a.h"
#include "core/io/reading/source_file.h"
#include "library/mesh_data.h"
#include "library/translate.h"

namespace dmo {
namespace {

using dmoscope::CoordinateLayout;
using dmoscope::ElementTable;
using dmoscope::Field;
using dmoscope::Group;
using dmoscope::SourceFile;
using dmoscope::Vec3;

constexpr std::string_view kBegin = "dmoscope mesh " DMOSCOPE_VERSION "\n";
constexpr std::size_t kHashSize = 16;  // hexadecimal digits, at the end

struct SourceParts {
  std::string path, bytes, format, beside, not_patchable;
  std::uint64_t size_on_disk = 0, first_beside = 0;
  CoordinateLayout layout;
  std::vector<std::uint64_t> places;
  std::vector<Index> place_vertices;
  std::vector<std::string> only_in_file, notes;
  std::vector<SourceFile::FieldPiece> field_pieces;
  std::vector<SourceParts> companion;  // one, or none
};

struct MeshParts {
  std::string name, title, path;
  std::vector<Vec3> positions, moved, as_read;  // the last two may be empty, see Mesh::Data
  std::vector<CellKind> kinds;
  std::vector<Index> offsets, connectivity;  // in the order of corners that was given
  std::vector<Field> fields, fields_as_read;
  std::vector<dmoscope::FieldValues> moved_fields;
  std::vector<Group> groups;
  std::vector<std::array<Index, 2>> periodic;
  bool single_precision = false, in_degrees = false, thin = false;
  std::vector<SourceParts> source;  // one or none
};

template <class Archive>
void pass(Archive& archive, Field& f) {
  archive(f.name, f.on, f.components, f.type, f.role, f.values, f.said_material, f.place.begin, f.place.words, f.place.with_positions,
          f.place.at, f.place.bytes, f.place.array, f.place.rows);
}
template <class Archive>
void pass(Archive& archive, dmoscope::FieldValues& v) {
  archive(v.field, v.values);
}
template <class Archive>
void pass(Archive& archive, std::array<Index, 2>& pair) {
  archive(pair[0], pair[1]);
}
template <class Archive>
void pass(Archive& archive, Group& g) {
  archive(g.name, g.role, g.code, g.dimension, g.members, g.faces);
}
template <class Archive>
void pass(Archive& archive, SourceParts& s) {
  CoordinateLayout& l = s.layout;
  archive(s.path, s.bytes, s.format, s.beside, s.first_beside, s.not_patchable, s.size_on_disk, s.places, s.place_vertices, s.only_in_file,
          s.notes, s.field_pieces, s.companion, l.binary, l.components, l.at, l.syntax.comment, l.syntax.comma_is_blank,
          l.syntax.backslash_joins_lines, l.syntax.free_form, l.width, l.scalar, l.big_endian);
}
template <class Archive>
void pass(Archive& archive, MeshParts& m) {
  archive(m.name, m.title, m.path, m.positions, m.moved, m.as_read, m.kinds, m.offsets, m.connectivity, m.fields, m.fields_as_read,
          m.moved_fields, m.groups, m.periodic, m.single_precision, m.in_degrees, m.thin, m.source);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::same_as<T, Vec3> || std::same_as<T, std::array<std::uint32_t, 3>> ||
    std::same_as<T, std::array<dmoscope::CoordinateScalar, 3>> || std::same_as<T, SourceFile::FieldPiece>;

class Saver {
 public:
  template <class... Members>
  void operator()(Members&... members) {
    (put(members), ...);
  }
  [[nodiscard]] std::string& bytes() noexcept { return bytes_; }

 private:
  template <class T>
  void put(T& value) {
    if constexpr (Plain<T>) {
      put_all(&value, 1);
    } else {
      pass(*this, value);
    }
  }
  template <Plain T>
  void put_all(const T* values, std::size_t count) {
    if (count > 0) bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  void put(std::string& text) {
    put_count(text.size());
    bytes_ += text;
  }
  template <class T>
  void put(std::vector<T>& values) {
    put_count(values.size());
    if constexpr (Plain<T>) {
      put_all(values.data(), values.size());
    } else {
      for (T& value : values) put(value);
    }
  }
  void put(ElementTable& table) {
    put_count(table.size());
    for (Index e = 0; e < table.size(); ++e) {
      const dmoscope::ElementKind kind = table.kind(e);
      put_all(&kind, 1);
      put_all(table.corners(e).data(), table.corners(e).size());
    }
  }
  void put_count(std::uint64_t count) { put_all(&count, 1); }

  std::string bytes_{kBegin};
};

[[noreturn]] void refuse() {
  throw dmoscope::InputError(kNoFile, 0, "these bytes are no mesh of dmoscope " DMOSCOPE_VERSION ", or they were damaged");
}

class Loader {
 public:
  explicit Loader(std::string_view bytes) : left_(bytes) {}
  template <class... Members>
  void operator()(Members&... members) {
    (get(members), ...);
  }

 private:
  template <class T>
  void get(T& value) {
    if constexpr (Plain<T>) {
      get_all(&value, 1);
    } else {
      pass(*this, value);
    }
  }
  template <Plain T>
  void get_all(T* values, std::size_t count) {
    if (count > left_.size() / sizeof(T)) refuse();
    if (count > 0) std::memcpy(values, left_.data(), count * sizeof(T));
    left_.remove_prefix(count * sizeof(T));
  }
  void get(std::string& text) {
    text = left_.substr(0, count_of(1));
    left_.remove_prefix(text.size());
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(count_of(Plain<T> ? sizeof(T) : 1));
    if constexpr (Plain<T>) {
      get_all(values.data(), values.size());
    } else {
      for (T& value : values) get(value);
    }
  }
  void get(ElementTable& table) {
    for (std::size_t left = count_of(1); left > 0; --left) {
      dmoscope::ElementKind kind{};
      std::array<Index, 8> corners{};
      get_all(&kind, 1);
      if (static_cast<std::size_t>(kind) >= dmoscope::kElementKindCount) refuse();
      get_all(corners.data(), info(kind).corners);
      table.add(kind, std::span(corners).first(info(kind).corners));
    }
  }
  /// Number of things of at least `size` bytes, which must be there.
  std::size_t count_of(std::size_t size) {
    std::uint64_t count = 0;
    get_all(&count, 1);
    if (count > left_.size() / size) refuse();
    return count;
  }

  std::string_view left_;
};

SourceParts parts_of(const SourceFile& file) {
  SourceParts parts{.path = file.path().string(),
                    .bytes = std::string(file.bytes()),
                    .format = std::string(file.format()),
                    .beside = file.beside(),
                    .not_patchable = file.not_patchable(),
                    .size_on_disk = file.size_on_disk(),
                    .first_beside = file.first_beside(),
                    .layout = file.layout(),
                    .places = {},
                    .place_vertices = {},
                    .only_in_file = file.only_in_file(),
                    .notes = file.notes(),
                    .field_pieces = file.field_pieces(),
                    .companion = {}};
  bool other_order = false;
  for (std::size_t i = 0; i < file.place_count(); ++i) {
    parts.places.push_back(file.place(i));
    parts.place_vertices.push_back(static_cast<Index>(file.vertex_at(i)));
    other_order = other_order || file.vertex_at(i) != i;
  }
  if (!other_order) parts.place_vertices.clear();
  if (file.companion() != nullptr) parts.companion.push_back(parts_of(*file.companion()));
  return parts;
}

std::shared_ptr<const SourceFile> source_of(SourceParts parts) {
  auto file = std::make_shared<SourceFile>(parts.path, dmoscope::FileBytes(parts.bytes));
  file->set_size_on_disk(parts.size_on_disk);
  file->set_format(parts.format);
  file->set_beside(parts.beside, parts.first_beside);
  file->set_not_patchable(parts.not_patchable);
  file->set_layout(parts.layout);
  file->add_places(parts.places);
  file->set_place_vertices(std::move(parts.place_vertices));
  for (const std::string& thing : parts.only_in_file) file->add_only_in_file(thing);
  for (std::string& note : parts.notes) file->add_note(std::move(note));
  for (const SourceFile::FieldPiece& piece : parts.field_pieces) file->add_field_piece(piece);
  if (!parts.companion.empty()) file->set_companion(source_of(std::move(parts.companion.front())));
  return file;
}

std::string hash_of(std::string_view bytes) {
  dmoscope::Fnv1a hash;
  hash.add_bytes(bytes);
  return hash.text();
}

}  // namespace

std::string Mesh::to_bytes() const {
  const dmoscope::Mesh& mesh = data_->input->mesh;
  const Data::Arrays& arrays = data_->arrays();
  MeshParts parts{.name = mesh.name,
                  .title = mesh.title,
                  .path = data_->input->path.string(),
                  .positions = mesh.positions,
                  .moved = data_->moved ? *data_->moved : std::vector<Vec3>(),
                  .as_read = data_->as_read ? data_->as_read->positions : std::vector<Vec3>(),
                  .kinds = arrays.kinds,
                  .offsets = arrays.offsets,
                  .connectivity = arrays.connectivity,
                  .fields = mesh.fields,
                  .fields_as_read = data_->as_read ? data_->as_read->fields : std::vector<Field>(),
                  .moved_fields = data_->fields,
                  .groups = mesh.groups,
                  .periodic = mesh.periodic,
                  .single_precision = mesh.single_precision,
                  .in_degrees = data_->in_degrees,
                  .thin = data_->thin,
                  .source = {}};
  if (mesh.source) parts.source.push_back(parts_of(*mesh.source));
  Saver saver;
  pass(saver, parts);
  saver.bytes() += hash_of(saver.bytes());
  return std::move(saver.bytes());
}

Mesh Mesh::from_bytes(std::string_view bytes, const Progress& progress) {
  return translated([&] {
    if (bytes.size() < kBegin.size() + kHashSize || !bytes.starts_with(kBegin)) refuse();
    const std::string_view body = bytes.substr(0, bytes.size() - kHashSize);
    if (hash_of(body) != bytes.substr(body.size())) refuse();
    MeshParts parts;
    Loader loader(body.substr(kBegin.size()));
    pass(loader, parts);
    const std::size_t vertices = parts.positions.size();
    for (const std::vector<Vec3>* other : {&parts.moved, &parts.as_read})
      if (!other->empty() && other->size() != vertices) refuse();
    if (parts.offsets.size() != parts.kinds.size() + 1 || parts.offsets.back() != parts.connectivity.size()) refuse();

    dmoscope::Mesh mesh;
    mesh.name = std::move(parts.name);
    mesh.title = std::move(parts.title);
    add_cells(mesh.elements, {parts.kinds.size(), parts.kinds.data(), parts.offsets.data(), parts.connectivity.data()}, vertices);
    if (!parts.source.empty()) mesh.source = source_of(std::move(parts.source.front()));
    auto data = std::make_shared<Data>();
    if (!parts.as_read.empty()) {
      auto as_read = std::make_shared<dmoscope::Mesh>(mesh);
      as_read->positions = std::move(parts.as_read);
      as_read->fields = std::move(parts.fields_as_read);
      data->as_read = std::move(as_read);
    }
    if (!parts.moved.empty()) data->moved = std::make_shared<const std::vector<Vec3>>(std::move(parts.moved));
    for (const dmoscope::FieldValues& one : parts.moved_fields)
      if (one.field >= parts.fields.size() || one.values.size() != parts.fields[one.field].values.size()) refuse();
    data->in_degrees = parts.in_degrees;
    data->thin = parts.thin;
    data->fields = std::move(parts.moved_fields);
    mesh.positions = std::move(parts.positions);
    mesh.fields = std::move(parts.fields);
    mesh.groups = std::move(parts.groups);
    mesh.periodic = std::move(parts.periodic);
    mesh.single_precision = parts.single_precision;
    data->input = prepare_input(std::move(mesh), parts.path, dmoscope::Need::Smoothing, progress.state().progress);
    return Mesh(std::shared_ptr<const Data>(std::move(data)));
  });
}

}  // namespace dmo
