#pragma once
// Marks that overlays make, as plain functions.

#include <span>
#include <vector>

#include "ui/overlays/overlay.h"

namespace dmoscope::ui {

/// Adds curves and feature edges along which vertices slide as lines, and held vertices as squares, as far as they are seen.
void add_features(render::Marks& marks, const MarkView& view, const Domain& domain, std::span<const Vec3> positions, Inks inks);

/// The joint move that holds the minimum of the frame on show; null: not known, or not wanted.
[[nodiscard]] std::shared_ptr<const JointCluster> hold_of(const OverlayInput& in);

/// Inverted elements, ascending; if they are too many for marks, an even choice of them. None of a frame that is on a device.
[[nodiscard]] std::vector<Index> inverted_elements(const Frame& frame);
/// Adds diamonds for those of `elements` that are smaller in the picture, no two in one place, so that the surroundings stay visible.
void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements);
/// Adds a diamond at a point of the scene.
void add_diamond(render::Marks& marks, Vec3 at, float diameter, const render::Style& style);
/// Adds marks for those of the frame's worst elements that are inverted only inside, at the place of the least Jacobian.
void add_inverted_inside(render::Marks& marks, const MarkView& view, const Frame& frame, const render::Style& style);

/// The picked element, or those around the picked vertex.
[[nodiscard]] std::vector<Index> picked_elements(const OverlayInput& in);
/// Adds for each element that has a target by `metric` an ellipse of the target's shape and direction, as large as the element, with its
/// longer axis (in space the three ellipses of an ellipsoid); and, thinner, the ellipse of the element itself. None for curved surfaces, or
/// if the frame is not on the host.
void add_targets(render::Marks& marks, const ScenePoints& points, const Frame& frame, Metric metric, std::span<const Index> elements);

}  // namespace dmoscope::ui
