#pragma once
// Properties of any bytes for a reader: it refuses them with an InputError, or the mesh is sound and survives being written and read again.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/error.h"
#include "core/io/writing/text_writer.h"
#include "tests/fuzz/memory_files.h"

namespace dmoscope::testing {

inline void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

inline bool same_values(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}
inline bool same_values(Vec3 a, Vec3 b) { return same_values(a.x, b.x) && same_values(a.y, b.y) && same_values(a.z, b.z); }

inline void check_sound(const Mesh& mesh) {
  for (const Vec3 p : mesh.positions) require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "position not finite");
  for (const Index v : mesh.elements.all_corners()) require(v < mesh.positions.size(), "corner out of range");
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    require(mesh.elements.corners(e).size() == info(mesh.elements.kind(e)).corners, "number of corners");
  }
  for (const Field& field : mesh.fields) {
    const std::size_t rows = field.on == Field::On::Vertices ? mesh.positions.size() : mesh.elements.size();
    require(field.components >= 1 && field.values.size() == rows * static_cast<std::size_t>(field.components), "size of a field");
  }
  for (const Group& group : mesh.groups) {
    for (const Index v : group.vertices()) require(v < mesh.positions.size(), "corner of a group's face");
    for (const Index member : group.members) {
      require(member < (group.dimension == 2 ? static_cast<std::size_t>(mesh.elements.size()) : mesh.positions.size()), "group member");
    }
  }
  const SourceFile& source = *mesh.source;
  std::uint64_t last = 0;
  for (std::size_t i = 0; i < source.place_count(); ++i) {
    require(source.place(i) >= last && source.place(i) < source.bytes().size(), "place in the file");
    require(source.vertex_at(i) < mesh.positions.size(), "vertex of a place");
    last = source.place(i);
  }
}

/// The coordinate that a format of limited width gives back.
inline double narrowed(std::string_view format, double value) {
  if (format == "abaqus") return number_in_field(value, 20, ExponentStyle::Letter).value;
  if (format == "nastran") return number_in_field(value, 16, ExponentStyle::Sign).value;
  return value;
}
inline std::vector<Vec3> narrowed(std::string_view format, std::vector<Vec3> positions) {
  for (Vec3& p : positions) p = {narrowed(format, p.x), narrowed(format, p.y), narrowed(format, p.z)};
  return positions;
}

/// Checks that the elements have corners at the same positions; and the same vertices, unless the format has none of its own (STL).
inline void check_same(const Mesh& mesh, const std::vector<Vec3>& positions, const Mesh& other, bool vertices, bool with_z) {
  require(other.elements.size() == mesh.elements.size(), "number of elements after writing");
  if (vertices) require(other.positions.size() == positions.size(), "number of vertices after writing");
  for (Index e = 0; e < mesh.elements.size(); ++e) {
    require(other.elements.kind(e) == mesh.elements.kind(e), "kind of an element after writing");
    for (std::size_t k = 0; k < mesh.elements.corners(e).size(); ++k) {
      const Index before = mesh.elements.corners(e)[k];
      const Index after = other.elements.corners(e)[k];
      if (vertices) require(before == after, "corner after writing");
      Vec3 p = positions[before];
      Vec3 q = other.positions[after];
      if (!with_z) p.z = q.z = 0.0;
      require(vertices ? same_values(p, q) : p == q, "position of a corner after writing");
    }
  }
  if (!vertices) return;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    Vec3 p = positions[v];
    Vec3 q = other.positions[v];
    if (!with_z) p.z = q.z = 0.0;
    require(same_values(p, q), "position after writing");
  }
}

inline void check_same_data(const Mesh& mesh, const Mesh& other) {
  require(mesh.title == other.title, "title after writing");
  require(mesh.fields.size() == other.fields.size() && mesh.groups.size() == other.groups.size(), "number of fields and groups");
  for (std::size_t i = 0; i < mesh.fields.size(); ++i) {
    require(mesh.fields[i].name == other.fields[i].name && mesh.fields[i].type == other.fields[i].type, "name and type of a field");
    for (std::size_t k = 0; k < mesh.fields[i].values.size(); ++k) {
      require(same_values(mesh.fields[i].values[k], other.fields[i].values[k]), "value of a field");
    }
  }
  for (std::size_t i = 0; i < mesh.groups.size(); ++i) {
    require(mesh.groups[i].members == other.groups[i].members, "members of a group");
    require(std::ranges::equal(mesh.groups[i].faces.all_corners(), other.groups[i].faces.all_corners()), "faces of a group");
  }
}

/// Checks the same file with every vertex moved; all else stays.
inline void check_patch(std::string_view format, const Mesh& mesh) {
  const CoordinateLayout& layout = mesh.source->layout();
  std::vector<Vec3> moved = mesh.positions;
  require(write_again(mesh, moved).bytes == source_bytes(*mesh.source), "an unchanged file must be written byte for byte");
  for (Vec3& p : moved) {
    p = {p.x * 0.5 + 0.1, 0.3 - p.y * 0.5, layout.components == 2 ? p.z : p.z * 0.25 - 0.7};
  }
  const std::string bytes = write_again(mesh, moved).bytes;
  const auto rounded = [&](double value, std::size_t axis) {
    value = narrowed(format, value);
    if (format == "unv" && layout.width < 24) value = number_in_field(value, layout.width, ExponentStyle::Letter).value;
    return layout.binary && layout.scalar[axis] == CoordinateScalar::Float32 ? static_cast<double>(static_cast<float>(value)) : value;
  };
  for (Vec3& p : moved) p = {rounded(p.x, 0), rounded(p.y, 1), rounded(p.z, 2)};
  const Mesh again = read_bytes(format, bytes);
  check_same(mesh, moved, again, format != "stl", true);
  if (format != "stl") check_same_data(mesh, again);
}

/// Checks a new file of the same format.
inline void check_new_file(std::string_view format, const Mesh& mesh) {
  std::string bytes;
  try {
    bytes = write_anew(format, mesh, mesh.positions).bytes;
  } catch (const OutputError&) {
    return;  // the format cannot hold this mesh, and reports that
  }
  const Mesh again = read_bytes(format, bytes);
  // Formats of two coordinates say in a note that they drop a constant z.
  check_same(mesh, narrowed(format, mesh.positions), again, format != "stl", again.source->layout().components == 3);
}

/// Returns true if the bytes were read, false if they were refused. Throws std::logic_error if a property is violated.
inline bool check_reader(std::string_view format, const std::string& bytes) {
  Mesh mesh;
  try {
    mesh = read_bytes(format, bytes);
  } catch (const InputError&) {
    return false;
  }
  check_sound(mesh);
  try {
    if (mesh.source->not_patchable().empty()) check_patch(format, mesh);
    if (mesh.elements.size() > 0) check_new_file(format, mesh);
  } catch (const Error& error) {
    throw std::logic_error(std::string("a mesh that was read cannot be written and read again: ") + error.what());
  }
  return true;
}

}  // namespace dmoscope::testing
