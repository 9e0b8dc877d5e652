#pragma once
// Data of the library's meshes.

#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/input/input_mesh.h"
#include "core/mesh/moved_mesh.h"
#include "library/include/dmoscope/error.h"
#include "library/include/dmoscope/mesh.h"

namespace dmo {

struct Progress::State {
  dmoscope::Progress progress;
};

/// A prepared mesh, and the positions of its vertices: those at which it was prepared, or others.
struct Mesh::Data {
  Data() = default;
  /// Copies all but the arrays, which arrays() makes anew.
  Data(const Data& of)
      : input(of.input), moved(of.moved), fields(of.fields), in_degrees(of.in_degrees), thin(of.thin), as_read(of.as_read) {}

  std::shared_ptr<const dmoscope::InputMesh> input;
  std::shared_ptr<const std::vector<dmoscope::Vec3>> moved;  // null: the positions of `input`
  std::vector<dmoscope::FieldValues> fields;                 // nodal fields whose numbers differ from those of `input`
  bool in_degrees = false;                                   // longitude and latitude: the mesh is judged on the Earth
  bool thin = false;                                         // one cell thick: the mesh is judged as the 2-D mesh of its front (thin.h)
  std::shared_ptr<const dmoscope::Mesh> as_read;             // with the positions of the file that was read; null: those of `input`

  [[nodiscard]] std::span<const dmoscope::Vec3> positions() const { return moved ? *moved : input->mesh.positions; }
  /// Fields of `input` that have changed since it was read as `before`.
  [[nodiscard]] std::vector<dmoscope::FieldValues> fields_since(const dmoscope::Mesh& before) const;
  /// The mesh prepared at its own positions, which is `input` if nothing has moved.
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> prepared(dmoscope::Progress& progress) const {
    return prepared(progress, false);
  }
  /// The mesh as it is judged and smoothed: mapped if it is in degrees (geographic.h), the mesh of its front if it is thin.
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> judged(dmoscope::Progress& progress) const { return prepared(progress, true); }
  /// The mesh whose elements judge at judged_positions().
  [[nodiscard]] std::shared_ptr<const dmoscope::InputMesh> judge() const;
  /// positions(), mapped as for judging.
  [[nodiscard]] std::vector<dmoscope::Vec3> judged_positions() const;

  // Cells as they were given; made at the first call.
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

/// Adds cells to `elements`. Throws dmoscope::InputError for impossible cells.
void add_cells(dmoscope::ElementTable& elements, const Cells& cells, std::size_t vertices);

/// Returns the mesh with other positions, and with these numbers in its fields.
[[nodiscard]] Mesh moved_mesh(const Mesh& mesh, std::vector<dmoscope::Vec3> positions, std::vector<dmoscope::FieldValues> fields);

// Translation of the program's errors to the library's.

inline constexpr const char* kNoFile = "mesh";  // stands for the file of a mesh that has none

/// Returns work(); its errors become errors of the library.
template <class Work>
decltype(auto) translated(const Work& work) {
  try {
    return work();
  } catch (const dmoscope::InputError& error) {
    throw InputError(error.what(), error.file() == kNoFile ? std::string() : error.file(), error.line());
  } catch (const dmoscope::OutputError& error) {
    throw OutputError(error.what());
  } catch (const dmoscope::UsageError& error) {
    throw UsageError(error.what());
  } catch (const dmoscope::Cancelled& error) {
    throw Cancelled(error.what());
  } catch (const dmoscope::Error& error) {
    throw Error(error.what());
  }
}

}  // namespace dmo
