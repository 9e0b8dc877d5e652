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

namespace dmo {
namespace {

using dmoscope::CoordinateLayout;
using dmoscope::ElementTable;
using dmoscope::Field;
using dmoscope::Group;
using dmoscope::SourceFile;
using dmoscope::Vec3;

constexpr std::string_view kBegin = "dmoscope mesh " DMOSCOPE_VERSION " b\n";  // b: the second form
constexpr std::size_t kHashSize = 16;                                          // hexadecimal digits, at the end

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
  std::shared_ptr<const SourceFile> source;  // may be null
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
void pass(Archive& archive, CoordinateLayout& l) {
  archive(l.binary, l.components, l.at, l.syntax.comment, l.syntax.comma_is_blank, l.syntax.backslash_joins_lines, l.syntax.free_form,
          l.width, l.scalar, l.big_endian);
}
template <class Archive>
void pass(Archive& archive, MeshParts& m) {
  archive(m.name, m.title, m.path, m.positions, m.moved, m.as_read, m.kinds, m.offsets, m.connectivity, m.fields, m.fields_as_read,
          m.moved_fields, m.groups, m.periodic, m.single_precision, m.in_degrees, m.thin, m.source);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::same_as<T, Vec3> || std::same_as<T, std::array<std::uint32_t, 3>> ||
    std::same_as<T, std::array<dmoscope::CoordinateScalar, 3>> || std::same_as<T, SourceFile::FieldPiece>;

[[noreturn]] void refuse() {
  throw dmoscope::InputError(kNoFile, 0, "these bytes are no mesh of dmoscope " DMOSCOPE_VERSION ", or they were damaged");
}

/// Appends members to bytes or, with `kLoads`, takes them from the begin of bytes.
template <bool kLoads>
class Archive {
 public:
  using Bytes = std::conditional_t<kLoads, std::string_view, std::string>;
  explicit Archive(Bytes bytes) : bytes_(std::move(bytes)) {}
  template <class... Members>
  void operator()(Members&... members) {
    (one(members), ...);
  }
  [[nodiscard]] Bytes& bytes() noexcept { return bytes_; }

 private:
  template <class T>
  void one(T& value) {
    if constexpr (Plain<T>) {
      raw(&value, 1);
    } else {
      pass(*this, value);
    }
  }
  template <Plain T>
  void raw(T* values, std::size_t count) {
    if constexpr (kLoads) {
      if (count > bytes_.size() / sizeof(T)) refuse();
      if (count > 0) std::memcpy(values, bytes_.data(), count * sizeof(T));
      bytes_.remove_prefix(count * sizeof(T));
    } else if (count > 0) {
      bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
    }
  }
  void one(std::string& text) {
    text.resize(count(text.size(), 1));
    raw(text.data(), text.size());
  }
  void one(std::filesystem::path& path) {
    std::string text = path.string();
    one(text);
    path = text;
  }
  void one(dmoscope::FileBytes& bytes) {
    const std::size_t size = count(bytes.view().size(), 1);
    if constexpr (kLoads) {
      bytes = dmoscope::FileBytes(bytes_.substr(0, size));
      bytes_.remove_prefix(size);
    } else {
      bytes_ += bytes.view();
    }
  }
  template <class T>
  void one(std::shared_ptr<const T>& shared) {
    bool there = shared != nullptr;
    raw(&there, 1);
    if (!there) return;
    if constexpr (kLoads) {
      const auto loaded = std::make_shared<T>();
      one(*loaded);
      shared = loaded;
    } else {
      one(const_cast<T&>(*shared));  // unchanged by saving
    }
  }
  template <class T>
  void one(std::vector<T>& values) {
    values.resize(count(values.size(), Plain<T> ? sizeof(T) : 1));
    if constexpr (Plain<T>) {
      raw(values.data(), values.size());
    } else {
      for (T& value : values) one(value);
    }
  }
  void one(ElementTable& table) {
    const std::size_t elements = count(table.size(), 1);
    for (std::size_t e = 0; e < elements; ++e) {
      dmoscope::ElementKind kind{};
      std::array<Index, 8> corners{};
      if constexpr (!kLoads) {
        kind = table.kind(static_cast<Index>(e));
        std::ranges::copy(table.corners(static_cast<Index>(e)), corners.begin());
      }
      raw(&kind, 1);
      if (static_cast<std::size_t>(kind) >= dmoscope::kElementKindCount) refuse();
      raw(corners.data(), info(kind).corners);
      if constexpr (kLoads) table.add(kind, std::span(corners).first(info(kind).corners));
    }
  }
  /// Number of things of at least `size` bytes, which must be there. `present`: their number if they are saved.
  std::size_t count(std::size_t present, std::size_t size) {
    std::uint64_t number = present;
    raw(&number, 1);
    if (kLoads && number > bytes_.size() / size) refuse();
    return number;
  }

  Bytes bytes_;
};

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
                  .source = mesh.source};
  Archive<false> saver{std::string(kBegin)};
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
    Archive<true> loader(body.substr(kBegin.size()));
    pass(loader, parts);
    const std::size_t vertices = parts.positions.size();
    for (const std::vector<Vec3>* other : {&parts.moved, &parts.as_read})
      if (!other->empty() && other->size() != vertices) refuse();
    if (parts.offsets.size() != parts.kinds.size() + 1 || parts.offsets.back() != parts.connectivity.size()) refuse();

    dmoscope::Mesh mesh;
    mesh.name = std::move(parts.name);
    mesh.title = std::move(parts.title);
    add_cells(mesh.elements, {parts.kinds.size(), parts.kinds.data(), parts.offsets.data(), parts.connectivity.data()}, vertices);
    mesh.source = std::move(parts.source);
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
