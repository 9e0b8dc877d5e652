#pragma once
// The quality of a star as a function of its vertex's place (paper, Fig. 1), sampled densely; and the best place by the mean ratio of
// triangles.

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
  std::vector<float> quality;   // least metric of the star, rows * columns values, row by row from below; NaN where it is not defined
  std::vector<float> jacobian;  // least normalised Jacobian, in the same order; > 0 where no element is inverted
};

/// Samples the rectangle from `low` to `high`. The result does not depend on the pool (null: this thread alone). Throws UsageError for a
/// mesh that is not planar, a vertex that does not exist or belongs to no element, and for sizes below 2.
[[nodiscard]] QualityField sample_quality(const InputMesh& input, PositionView positions, Metric metric, Index vertex, Vec2<double> low,
                                          Vec2<double> high, int columns, int rows, ThreadPool* pool = nullptr);

/// A plane through the star of a volume mesh, at right angles to an axis.
struct StarSlice {
  int axis = 2;         // axis at right angles to the plane: 0 x, 1 y, 2 z
  double offset = 0.0;  // offset along that axis, relative to the vertex; mesh units
  /// Projects into the plane, whose axes are the other two in their order; the other function lifts back.
  [[nodiscard]] Vec2<double> project(Vec3 p) const {
    return axis == 0 ? Vec2<double>{p.y, p.z} : axis == 1 ? Vec2<double>{p.x, p.z} : Vec2<double>{p.x, p.y};
  }
  [[nodiscard]] Vec3 lift(Vec2<double> p) const {
    return axis == 0 ? Vec3{offset, p.x, p.y} : axis == 1 ? Vec3{p.x, offset, p.y} : Vec3{p.x, p.y, offset};
  }
  friend bool operator==(const StarSlice&, const StarSlice&) = default;
};

/// Samples a slice through a volume mesh; `low` to `high` are in the slice's plane. Otherwise like sample_quality().
[[nodiscard]] QualityField sample_slice(const InputMesh& input, PositionView positions, Metric metric, Index vertex, const StarSlice& slice,
                                        Vec2<double> low, Vec2<double> high, int columns, int rows, ThreadPool* pool = nullptr);

struct LocalOptimum {
  Vec2<double> at;       // offset from the vertex in the plane; mesh units
  double quality = 0.0;  // quality of the star with the vertex there
};

/// The best place for `vertex` in a star of triangles by the mean ratio: the exact maximum, to 1e-9 of the star's size. None if no place is
/// without inverted elements, and for other stars and metrics.
[[nodiscard]] std::optional<LocalOptimum> local_optimum(const InputMesh& input, PositionView positions, Metric metric, Index vertex);

}  // namespace dmoscope
