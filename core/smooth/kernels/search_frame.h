#pragma once
// Plane and unit in which vertices are searched.

#include <cmath>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/input/input_mesh.h"
#include "core/mesh/plane.h"
#include "core/smooth/displace.h"

namespace dmoscope {

/// New place of a vertex.
struct Displacement {
  double target[3];   // the position as it will be stored
  Vec2<double> step;  // the step to there in the plane, as stored
};

/// Search frame, as plain data for any processor. Its functions are always inlined: code for different processors shares them, and must not
/// share one compiled copy.
struct SearchFrame {
  double u[3], v[3];      // the mesh's plane
  int u_axis, v_axis;     // their coordinates, or -1 where the plane is parallel to no coordinate plane
  double scale, inverse;  // a power of two about as large as an edge, and 1 / scale
  bool single_precision;  // see Mesh
  double period, west;    // see Plane
  /// Width plus height of the star's bounding box above which the search in float is not to be trusted, in units of `scale`: floats cannot
  /// hold more; and a star of a mesh that wraps whose offsets are so large, taken plainly, lies across the seam.
  float largest_extent;
  static constexpr float kLargestExtent = 0x1p20F;

  /// Offset from `origin` to `at`, in the plane and in mesh units. Axes: u_axis and v_axis are coordinates.
  template <bool Axes>
  [[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE Vec2<double> offset(const double* at, const double* origin) const {
    if constexpr (Axes) {
      return {at[u_axis] - origin[u_axis], at[v_axis] - origin[v_axis]};
    } else {
      const double dx = at[0] - origin[0], dy = at[1] - origin[1], dz = at[2] - origin[2];
      return {dx * u[0] + dy * u[1] + dz * u[2], dx * v[0] + dy * v[1] + dz * v[2]};
    }
  }

  /// New place of a vertex at `at` after an offset in units of `scale`.
  [[gnu::always_inline]] [[nodiscard]] DMOSCOPE_ANYWHERE Displacement displace(const double* at, float x, float y) const {
    const double along_u = static_cast<double>(x) * scale, along_v = static_cast<double>(y) * scale;
    Displacement to{};
    if (u_axis >= 0) {
      for (int i = 0; i < 3; ++i) to.target[i] = at[i];
      to.target[u_axis] = displaced(at[u_axis], along_u, single_precision);
      to.target[v_axis] = displaced(at[v_axis], along_v, single_precision);
      to.step = {to.target[u_axis] - at[u_axis], to.target[v_axis] - at[v_axis]};
      if (period > 0.0) settle(at, to);
      return to;
    }
    for (int i = 0; i < 3; ++i) to.target[i] = displaced(at[i], along_u * u[i] + along_v * v[i], single_precision);
    to.step = offset<false>(to.target, at);
    return to;
  }

 private:
  /// Brings x back into its range on a mesh that wraps, whose u is x.
  [[gnu::always_inline]] DMOSCOPE_ANYWHERE void settle(const double* at, Displacement& to) const {
    const double plain = to.target[0];
    to.target[0] = settled(plain, west, period, single_precision);
    if (to.target[0] != plain) to.step.x = way_round(to.target[0], at[0], period);
  }
};

[[nodiscard]] inline SearchFrame make_search_frame(const InputMesh& input) {
  const Plane& plane = input.geometry.plane;
  const PlaneAxes axes(plane);
  const double edge = input.geometry.size / std::sqrt(1.0 + static_cast<double>(input.whole_element_count()));
  const double scale = edge > 0.0 && std::isfinite(edge) ? std::exp2(std::ilogb(edge)) : 1.0;
  const double half = 0.5 * plane.period / scale;
  const float largest = plane.period > 0.0 && half < static_cast<double>(SearchFrame::kLargestExtent) ? static_cast<float>(half)
                                                                                                      : SearchFrame::kLargestExtent;
  return {{plane.u.x, plane.u.y, plane.u.z},
          {plane.v.x, plane.v.y, plane.v.z},
          axes.u,
          axes.v,
          scale,
          1.0 / scale,
          input.mesh.single_precision,
          plane.period,
          plane.west,
          largest};
}

}  // namespace dmoscope
