#pragma once
// The visible part of a volume mesh as commands.

#include <optional>
#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// A clip plane across an axis (0 to 2), the side of it that is taken away, and its place from the lower to the upper end of the box (0 to
/// 1 within it).
struct AxisPlane {
  int axis = 0;
  bool flip = false;
  double fraction = 0.5;
};
/// The axis and place of a plane; none if the plane is oblique, or the box flat along its axis.
[[nodiscard]] std::optional<AxisPlane> axis_plane(const ClipPlane& plane, const render::Bounds3& box);
/// Name of an axis and a side: "x", "-x".
[[nodiscard]] std::string axis_name(int axis, bool flip);
/// Whether the lower side of a plane across an axis is nearer to the eye, so that taking it away uncovers the plane.
[[nodiscard]] bool looks_along(const render::OrbitCamera& camera, int axis);
/// Lowest and highest value of dot(normal, x) over the box.
[[nodiscard]] std::pair<double, double> span_of(const ClipPlane& plane, const render::Bounds3& box);

/// Command for a plane, which must be on: "clip -x:0.42" to four digits if that is enough, else by numbers.
[[nodiscard]] std::string clip_command(const ClipPlane& plane, const render::Bounds3& box);

/// Commands that restore the view of a volume mesh: its visible part and, `with_camera`, the camera.
[[nodiscard]] std::vector<std::string> inside_lines(const ViewState& state, bool with_camera);

}  // namespace dmoscope::ui
