#pragma once
// A nodal field of a planar mesh, interpolated at any place.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/base/vec.h"
#include "core/mesh/mesh.h"
#include "core/mesh/plane.h"
#include "core/mesh/topology.h"

namespace dmoscope {

/// A nodal field that is linear on triangles, and on the two triangles 0 1 2 and 0 2 3 of a quadrilateral; outside of the mesh it has the
/// value of the nearest vertex. The mesh is that of the positions given, wherever its vertices go later. Mesh and topology must outlive it.
class NodalField {
 public:
  /// Prepares the interpolation. `values`: one for each vertex.
  NodalField(const Mesh& mesh, const Topology& topology, const Plane& plane, std::vector<double> values);

  /// Value at a place. `near`: a vertex; if the place lies in its star, as it mostly does, nothing is searched. The value does not depend
  /// on it.
  [[nodiscard]] double at(Index near, Vec3 place) const;
  [[nodiscard]] std::span<const double> values() const noexcept { return values_; }

 private:
  /// Lists of things in the cells of a uniform grid.
  struct Cells {
    std::vector<std::size_t> offsets;  // offset of each cell's members, and their number at the end
    std::vector<Index> members;        // members of all cells, one cell after the other, each in ascending order
    [[nodiscard]] std::span<const Index> of(std::size_t cell) const {
      return {members.data() + offsets[cell], members.data() + offsets[cell + 1]};
    }
  };
  using Point = Vec2<double>;
  /// Cells that a bounding box touches, from the first to the last.
  struct CellBox {
    int left, bottom, right, top;
    [[nodiscard]] std::size_t count() const {
      return static_cast<std::size_t>(right - left + 1) * static_cast<std::size_t>(top - bottom + 1);
    }
  };
  [[nodiscard]] Point flat(Index vertex) const;
  [[nodiscard]] Point flat_near(Index vertex, Point p) const;
  [[nodiscard]] int column(double x) const;
  [[nodiscard]] int row(double y) const;
  [[nodiscard]] std::size_t cell(int i, int j) const;
  [[nodiscard]] CellBox cells_of(Index element, double shift = 0.0) const;
  template <class Visit>
  void for_images(Index element, const Visit& visit) const;
  [[nodiscard]] bool is_crowded() const;
  void set_width(double width);
  template <class ForMembers>
  [[nodiscard]] Cells fill(const ForMembers& for_members) const;
  [[nodiscard]] std::optional<double> in_element(Index element, Point p) const;
  [[nodiscard]] std::optional<double> in_triangle(Index a, Index b, Index c, Point p) const;
  [[nodiscard]] Index nearest(Point p) const;
  void look_around(Point p, Index& best, double& least) const;

  const Mesh& mesh_;
  const Topology& topology_;
  Plane plane_;
  std::vector<double> values_;
  Vec3 origin_{};
  Point low_{}, high_{};
  double width_ = 1.0;  // edge of a grid cell, in mesh units
  int columns_ = 1, rows_ = 1;
  Cells elements_, vertices_;
};

}  // namespace dmoscope
