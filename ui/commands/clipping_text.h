#pragma once
// What is seen of a volume mesh, in words of the command language.

#include <optional>
#include <string>
#include <vector>

#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// The axis that a clip plane lies across (0 to 2), which side of it is taken away, and where it is from the lower to the upper end of the
/// box (0 to 1 within it).
struct AxisPlane {
  int axis = 0;
  bool flip = false;
  double fraction = 0.5;
};
/// None where the plane is oblique, or the box flat along its axis.
[[nodiscard]] std::optional<AxisPlane> axis_plane(const ClipPlane& plane, const render::Bounds3& box);
/// "x", "-x"
[[nodiscard]] std::string axis_name(int axis, bool flip);
/// Whether the side of a plane across an axis that is nearer to the eye is the lower one: what is taken away there uncovers the plane.
[[nodiscard]] bool looks_along(const render::OrbitCamera& camera, int axis);
/// The values of dot(normal, x) over the box, lowest and highest.
[[nodiscard]] std::pair<double, double> span_of(const ClipPlane& plane, const render::Bounds3& box);

/// "clip -x:0.42" to four digits where that says it, else by numbers. `plane` is on.
[[nodiscard]] std::string clip_command(const ClipPlane& plane, const render::Bounds3& box);
/// "clip -1,0,0:0.25": the same plane to the last digit, wherever the mesh lies; "clip off".
[[nodiscard]] std::string exact_clip_command(const ClipPlane& plane);

/// Commands that bring about the view of a volume mesh: what is seen of it and, `with_camera`, from where.
[[nodiscard]] std::vector<std::string> inside_lines(const ViewState& state, bool with_camera);

}  // namespace dmoscope::ui
