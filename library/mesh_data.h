#pragma once
// What is behind the library's meshes.

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/moved_mesh.h"
#include "library/include/dmoscope/mesh.h"

namespace dmo {

struct Progress::State {
  dmoscope::Progress progress;
};

/// A prepared mesh, and where its vertices are: as it was prepared, or elsewhere.
struct Mesh::Data {
  Data() = default;
  /// All but the arrays, which are made anew for who asks.
  Data(const Data& of)
      : input(of.input), moved(of.moved), fields(of.fields), in_degrees(of.in_degrees), thin(of.thin), as_read(of.as_read) {}

  std::shared_ptr<const dmoscope::InputMesh> input;
  std::shared_ptr<const std::vector<dmoscope::Vec3>> moved;  // null: where `input` has them
  std::vector<dmoscope::FieldValues> fields;                 // nodal fields that have other numbers there than `input` has
  bool in_degrees = false;                                   // longitude and latitude: judged on the Earth
  bool thin = false;                                         // one cell thick: judged as the 2-D mesh of its front (thin.h)
  std::shared_ptr<const dmoscope::Mesh> as_read;  // with the positions of the file that it was read from; null: as `input` has it

  [[nodiscard]] std::span<const dmoscope::Vec3> positions() const { return moved ? *moved : input->mesh.positions; }
  /// What `input` has become since it was read as `before`.
  [[nodiscard]] std::vector<dmoscope::FieldValues> fields_since(const dmoscope::Mesh& before) const;
  /// The mesh as it is prepared at its own positions, which is `input` where nothing has moved.
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> prepared(dmoscope::Progress& progress) const {
    return prepared(progress, false);
  }
  /// The same as it is judged and smoothed: mapped where it is in degrees (geographic.h), the mesh of its front where it is thin.
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> judged(dmoscope::Progress& progress) const { return prepared(progress, true); }
  /// The mesh whose elements judge at judged_positions().
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> judge() const;
  /// positions() as they are judged.
  [[nodiscard]] std::vector<dmoscope::Vec3> judged_positions() const;

  // As they came in; made for who asks first.
  struct Arrays {
    std::vector<CellKind> kinds;
    std::vector<Index> offsets, connectivity;
  };
  [[nodiscard]] const Arrays& arrays() const;

 private:
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> prepared(dmoscope::Progress& progress, bool to_be_judged) const;

  mutable std::once_flag arrays_made_;
  mutable Arrays arrays_;
};

/// Throws dmoscope::InputError for cells that cannot be.
void add_cells(dmoscope::ElementTable& elements, const Cells& cells, std::size_t vertices);

/// The same mesh with its vertices elsewhere, and with these numbers in its fields.
[[nodiscard]] Mesh moved_mesh(const Mesh& mesh, std::vector<dmoscope::Vec3> positions, std::vector<dmoscope::FieldValues> fields);

}  // namespace dmo
