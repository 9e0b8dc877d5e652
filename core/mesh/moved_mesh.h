#pragma once
// A mesh that is to be written with its vertices elsewhere.

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// A field of a mesh with other numbers, as many as it has.
struct FieldValues {
  std::size_t field = 0;  // its number in Mesh::fields
  std::vector<double> values;
};

/// What a mesh becomes: where its vertices are, and those of its fields that have other numbers there.
struct MovedMesh {
  template <std::convertible_to<std::span<const Vec3>> Positions>
  MovedMesh(const Positions& at, std::span<const FieldValues> changed = {})  // NOLINT(google-explicit-constructor)
      : positions(at), fields(changed) {}

  std::span<const Vec3> positions;  // as many as the mesh has
  std::span<const FieldValues> fields;
};

/// The mesh with these numbers in its fields.
[[nodiscard]] inline Mesh with_fields(Mesh mesh, std::span<const FieldValues> changed) {
  for (const FieldValues& one : changed) mesh.fields[one.field].values = one.values;
  return mesh;
}

}  // namespace dmoscope
