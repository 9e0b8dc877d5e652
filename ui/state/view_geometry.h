#pragma once
// Positions of a frame in the plane, cameras for picked things, and metrics that a mesh allows.

#include <vector>

#include "core/view/view.h"
#include "render/camera.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// Box of an element, or of the star of a vertex. Throw DeviceError.
[[nodiscard]] render::Bounds2 element_box(const Frame& frame, Index element);
[[nodiscard]] render::Bounds2 star_box(const Frame& frame, Index vertex);

/// Moves the camera to the picked element or vertex, close enough to read it. Does nothing when nothing is picked. Throws DeviceError.
void look_at_picked(ViewState& state, const Frame& frame);

/// Guess of the upright axis of a mesh in space: y if it stands on a flat face below in y and on none below in z, or if it stands on none
/// and its file's format mostly has y up (OBJ); else z.
[[nodiscard]] render::UpAxis guessed_up(const InputMesh& input);

/// Metrics defined for every element of the mesh.
[[nodiscard]] std::vector<Metric> usable_metrics(const Mesh& mesh);

}  // namespace dmoscope::ui
