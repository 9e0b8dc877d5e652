#pragma once
// Writing a file of arrays (Exodus, CGNS, XDMF's HDF5) again with the coordinates that moved.

#include <span>
#include <string>
#include <vector>

#include "core/base/vec.h"
#include "core/io/arrays/array_file.h"
#include "core/io/format.h"

namespace dmoscope {

/// An array with coordinates: `axis` 0 to 2 of vertices, or -1: all `components` of each vertex behind each other, or, where `by_axis`, all
/// x before all y.
struct CoordinateArray {
  std::string name;
  int axis = -1;
  int components = 3;
  bool by_axis = false;
  std::vector<Index> vertices{};  // of its entries; empty: the i-th is that of vertex first + i
  Index first = 0;
  Index count = 0;  // entries
  ScalarType type = ScalarType::Float64;
};

/// The coordinates that arrays hold, and how their numbers are stored.
class CoordinateArrays {
 public:
  /// Reads an array's numbers into `positions`, which is large enough. Throws InputError: not as many numbers as it should have, one that
  /// is not finite.
  void read(ArrayFile& file, CoordinateArray array, std::span<Vec3> positions);
  /// Tells the file its layout, and that whole numbers cannot be written again.
  void describe(SourceFile& source) const;

  /// The file's bytes with the coordinates in which `moved` differs from `before`, and with the arrays that `changed` besides; `notes` say
  /// what was rounded. `target` is what errors call the file that is written. Throws OutputError (z of a file that has none; too large for
  /// a float).
  [[nodiscard]] std::string replaced(ArrayFile& file, std::span<const Vec3> before, std::span<const Vec3> moved, const std::string& target,
                                     Notes& notes, std::vector<ArrayValues> changed = {}) const;
  /// The vertices have other numbers: vertex_of[the number so far].
  void renumber(std::span<const Index> vertex_of);

 private:
  [[nodiscard]] CoordinateLayout layout() const;
  std::vector<CoordinateArray> arrays_;
};

/// The arrays that Field::Place names, with the numbers that changed; a field without a place is told in the notes.
[[nodiscard]] std::vector<ArrayValues> changed_arrays(ArrayFile& file, const Mesh& mesh, std::span<const FieldValues> fields, Notes& notes);

[[nodiscard]] bool same_positions(std::span<const Vec3> a, std::span<const Vec3> b) noexcept;

}  // namespace dmoscope
