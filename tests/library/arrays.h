#pragma once
// Meshes as arrays for the library's tests, by its public headers alone.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "dmoscope/dmoscope.h"

namespace dmoscope_test {

struct Arrays {
  std::vector<double> positions;
  std::vector<dmo::CellKind> kinds;
  std::vector<dmo::Index> offsets{0}, connectivity;

  void add(dmo::CellKind kind, const std::vector<dmo::Index>& corners) {
    kinds.push_back(kind);
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<dmo::Index>(connectivity.size()));
  }
  [[nodiscard]] dmo::Cells cells() const { return {kinds.size(), kinds.data(), offsets.data(), connectivity.data()}; }
  [[nodiscard]] dmo::Mesh mesh() const { return {positions.data(), positions.size() / 3, cells()}; }
};

/// n x n squares, some of them cut into triangles, every inner vertex a third of a cell out of place.
inline Arrays sheet(dmo::Index n) {
  Arrays arrays;
  for (dmo::Index j = 0; j <= n; ++j)
    for (dmo::Index i = 0; i <= n; ++i) {
      const bool inside = i > 0 && i < n && j > 0 && j < n;
      const double turn = 1.7 * i + 2.9 * j;
      arrays.positions.insert(arrays.positions.end(),
                              {i + (inside ? 0.33 * std::cos(turn) : 0.0), j + (inside ? 0.33 * std::sin(turn) : 0.0), 5.0});
    }
  for (dmo::Index j = 0; j < n; ++j)
    for (dmo::Index i = 0; i < n; ++i) {
      const dmo::Index a = i + (n + 1) * j, b = a + 1, c = b + n + 1, d = a + n + 1;
      if ((i + j) % 3 == 0) {
        arrays.add(dmo::CellKind::Quadrilateral, {a, b, c, d});
      } else {
        arrays.add(dmo::CellKind::Triangle, {a, b, c});
        arrays.add(dmo::CellKind::Triangle, {a, c, d});
      }
    }
  return arrays;
}

/// A cube's corners, its middle near one of them, and six pyramids around that; a wedge on top, in VTK's order.
inline Arrays solids() {
  Arrays arrays;
  arrays.positions = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1, 0.2, 0.3, 0.25, 0.5, 0, 2, 0.5, 1, 2};
  using K = dmo::CellKind;
  for (const std::vector<dmo::Index>& face :
       {std::vector<dmo::Index>{0, 1, 2, 3, 8}, {4, 7, 6, 5, 8}, {0, 4, 5, 1, 8}, {1, 5, 6, 2, 8}, {2, 6, 7, 3, 8}, {3, 7, 4, 0, 8}})
    arrays.add(K::Pyramid, face);
  arrays.add(K::Wedge, {4, 5, 9, 7, 6, 10});
  return arrays;
}

/// Two materials, and data of other shapes.
inline dmo::Mesh sheet_with_data(const Arrays& arrays) {
  std::vector<double> material, wind;
  for (std::size_t c = 0; c < arrays.kinds.size(); ++c) material.push_back(c < arrays.kinds.size() / 2 ? 1.0 : 2.0);
  for (std::size_t v = 0; v < arrays.positions.size() / 3; ++v) wind.insert(wind.end(), {0.5, static_cast<double>(v), -1.0});
  return {arrays.positions.data(),
          arrays.positions.size() / 3,
          arrays.cells(),
          {{.name = "material", .values = std::move(material), .components = 1, .whole = true}},
          {{.name = "wind", .values = std::move(wind), .components = 3, .whole = false}}};
}

}  // namespace dmoscope_test
