#include "ui/commands/clipping_text.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace dmoscope::ui {

std::pair<double, double> span_of(const ClipPlane& plane, const render::Bounds3& box) {
  double low = INFINITY, high = -INFINITY;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const double at = dot(plane.normal, {(corner & 1U) != 0 ? box.high.x : box.low.x, (corner & 2U) != 0 ? box.high.y : box.low.y,
                                         (corner & 4U) != 0 ? box.high.z : box.low.z});
    low = std::min(low, at);
    high = std::max(high, at);
  }
  return {low, high};
}

std::optional<AxisPlane> axis_plane(const ClipPlane& plane, const render::Bounds3& box) {
  const std::array<double, 3> normal{plane.normal.x, plane.normal.y, plane.normal.z}, low{box.low.x, box.low.y, box.low.z},
      high{box.high.x, box.high.y, box.high.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (normal[axis] == 0.0 || normal[(axis + 1) % 3] != 0.0 || normal[(axis + 2) % 3] != 0.0) continue;
    if (!(high[axis] > low[axis])) return std::nullopt;
    const double at = plane.offset / normal[axis];
    return AxisPlane{static_cast<int>(axis), plane.flip != (normal[axis] < 0.0), (at - low[axis]) / (high[axis] - low[axis])};
  }
  return std::nullopt;
}

bool looks_along(const render::OrbitCamera& camera, int axis) {
  const Vec3 back = camera.back();
  constexpr double kFromTheSide = 1e-6;  // so small that the view is practically from the side
  return (axis == 0 ? back.x : axis == 1 ? back.y : back.z) < -kFromTheSide;
}

std::string axis_name(int axis, bool flip) { return std::string(flip ? "-" : "") + static_cast<char>('x' + axis); }

std::string exact_clip_command(const ClipPlane& plane) {
  if (!plane.on) return "clip off";
  const double side = plane.flip ? -1.0 : 1.0;
  const Vec3 n = side * plane.normal;
  return fmt::format("clip {},{},{}:{}", n.x, n.y, n.z, side * plane.offset);
}

std::string clip_command(const ClipPlane& plane, const render::Bounds3& box) {
  const auto across = axis_plane(plane, box);
  if (!across || across->fraction < 0.0 || across->fraction > 1.0) return exact_clip_command(plane);
  return fmt::format("clip {}:{:.4g}", axis_name(across->axis, across->flip), across->fraction);
}

std::vector<std::string> inside_lines(const ViewState& state, bool with_camera) {
  const ClippingView& view = state.inside;
  std::vector<std::string> lines{exact_clip_command(view.clip)};
  lines.push_back(view.peel_quality ? fmt::format("peel-quality {}", *view.peel_quality) : "peel-quality off");
  lines.push_back(view.isolate ? fmt::format("keep-quality {} {}", view.isolate->first, view.isolate->second) : "keep-quality off");
  if (!with_camera) return lines;
  const render::OrbitCamera& orbit = state.orbit;
  const Vec3 &c = orbit.centre, &r = orbit.right, &u = orbit.up;
  lines.push_back(fmt::format("orbit {} {} {} {} {} {} {} {} {} {}", c.x, c.y, c.z, orbit.height, r.x, r.y, r.z, u.x, u.y, u.z));
  return lines;
}

}  // namespace dmoscope::ui
