#pragma once
// Rewriting of array files (Exodus, CGNS, XDMF's HDF5) with coordinates that moved.

#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/io/arrays/array_file.h"
#include "core/io/format.h"

namespace dmoscope {

/// An array with coordinates: with `axis` 0 to 2 that coordinate of the vertices; with -1 all `components` of each vertex one after the
/// other or, with `by_axis`, all x before all y.
struct CoordinateArray {
  std::string name;
  int axis = -1;
  int components = 3;
  bool by_axis = false;
  std::vector<Index> vertices{};  // vertices of its entries; empty: entry i is vertex first + i
  Index first = 0;
  Index count = 0;  // number of entries
  ScalarType type = ScalarType::Float64;
};

/// The arrays of a file that hold coordinates, and the storage of their numbers.
class CoordinateArrays {
 public:
  /// Reads an array's numbers into `positions`, which is large enough. Throws InputError for a wrong count of numbers, or one that is not
  /// finite.
  void read(ArrayFile& file, CoordinateArray array, std::span<Vec3> positions);
  /// Sets the layout in `source`, and notes that whole numbers cannot be written again.
  void describe(SourceFile& source) const;

  /// The file's bytes with the coordinates in which `moved` differs from `before`, and with the arrays in `changed`; `notes` tell what was
  /// rounded. `target`: name of the written file in errors. Throws OutputError (z in a file without z; too large for a float).
  [[nodiscard]] std::string replaced(ArrayFile& file, std::span<const Vec3> before, std::span<const Vec3> moved, const std::string& target,
                                     Notes& notes, std::vector<ArrayValues> changed = {}) const;
  /// Renumbers the vertices: the new number is vertex_of[the present one].
  void renumber(std::span<const Index> vertex_of);

 private:
  [[nodiscard]] CoordinateLayout layout() const;
  std::vector<CoordinateArray> arrays_;
};

/// Arrays named by Field::Place, with the numbers that changed; the notes name a field without a place.
[[nodiscard]] std::vector<ArrayValues> changed_arrays(ArrayFile& file, const Mesh& mesh, std::span<const FieldValues> fields, Notes& notes);

}  // namespace dmoscope
