#pragma once
// The quality of a star as a function of where its vertex stands (paper, Fig. 1), sampled densely; and for the mean ratio of
// triangles the best place.

#include <optional>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"
#include "core/quality/metric.h"

namespace dmoscope {

class ThreadPool;

/// Samples at the middles of columns x rows equal cells of a rectangle in the plane.
struct QualityField {
  Vec2<double> low, high;  // the rectangle, relative to the vertex; mesh units
  int columns = 0, rows = 0;
  std::vector<float> quality;   // rows * columns, row by row from below: the star's least metric; NaN where it is not defined
  std::vector<float> jacobian;  // likewise: the least normalised Jacobian; > 0 where no element is inverted
};

/// Over `low` to `high`; the same for any pool (null: this thread alone). Throws UsageError for a mesh that is not planar, a vertex that
/// does not exist or is of no element, and for sizes below 2.
[[nodiscard]] QualityField sample_quality(const InputMesh& input, PositionView positions, Metric metric, Index vertex, Vec2<double> low,
                                          Vec2<double> high, int columns, int rows, ThreadPool* pool = nullptr);

/// A plane through a volume's star, at right angles to an axis.
struct StarSlice {
  int axis = 2;         // 0 x, 1 y, 2 z: what is the same all over the plane
  double offset = 0.0;  // along it, relative to the vertex; mesh units
  /// Into the plane, whose axes are the other two in their order, and back.
  [[nodiscard]] Vec2<double> project(Vec3 p) const {
    return axis == 0 ? Vec2<double>{p.y, p.z} : axis == 1 ? Vec2<double>{p.x, p.z} : Vec2<double>{p.x, p.y};
  }
  [[nodiscard]] Vec3 lift(Vec2<double> p) const {
    return axis == 0 ? Vec3{offset, p.x, p.y} : axis == 1 ? Vec3{p.x, offset, p.y} : Vec3{p.x, p.y, offset};
  }
  friend bool operator==(const StarSlice&, const StarSlice&) = default;
};

/// The same for a slice through a volume mesh: `low` to `high` are in the slice's plane. Else as sample_quality().
[[nodiscard]] QualityField sample_slice(const InputMesh& input, PositionView positions, Metric metric, Index vertex, const StarSlice& slice,
                                        Vec2<double> low, Vec2<double> high, int columns, int rows, ThreadPool* pool = nullptr);

struct LocalOptimum {
  Vec2<double> at;       // relative to the vertex; in the plane, mesh units
  double quality = 0.0;  // of the star there
};

/// The best place for `vertex` of a star of triangles by the mean ratio: its exact maximum, to 1e-9 of the star's size, where one without
/// inverted elements exists; none otherwise, and for other stars and metrics.
[[nodiscard]] std::optional<LocalOptimum> local_optimum(const InputMesh& input, PositionView positions, Metric metric, Index vertex);

}  // namespace dmoscope
