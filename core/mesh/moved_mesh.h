#pragma once
// A mesh that is to be written with moved vertices.

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// New numbers for a field of a mesh, as many as it has.
struct FieldValues {
  std::size_t field = 0;  // the field's index in Mesh::fields
  std::vector<double> values;
};

/// Changes of a mesh: positions of all vertices, and new numbers for some of its fields.
struct MovedMesh {
  template <std::convertible_to<std::span<const Vec3>> Positions>
  MovedMesh(const Positions& at, std::span<const FieldValues> changed = {})  // NOLINT(google-explicit-constructor)
      : positions(at), fields(changed) {}

  std::span<const Vec3> positions;  // one for each vertex
  std::span<const FieldValues> fields;
};

/// Returns the mesh with these numbers in its fields.
[[nodiscard]] inline Mesh with_fields(Mesh mesh, std::span<const FieldValues> changed) {
  for (const FieldValues& one : changed) mesh.fields[one.field].values = one.values;
  return mesh;
}

}  // namespace dmoscope
