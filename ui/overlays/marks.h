#pragma once
// Marks that overlays make, as plain functions.

#include <span>
#include <vector>

#include "ui/overlays/overlay.h"

namespace dmoscope::ui {

/// Curves and feature edges along which vertices slide as lines, what is held as squares; as far as they are seen.
void add_features(render::Marks& marks, const MarkView& view, const Domain& domain, std::span<const Vec3> positions, Inks inks);

/// What holds the minimum of the frame on show; null: not known, or not wanted.
[[nodiscard]] std::shared_ptr<const JointCluster> hold_of(const OverlayInput& in);

/// Ascending; of so many that marks would be a carpet an even choice. None of a frame that lives on a device.
[[nodiscard]] std::vector<Index> inverted_elements(const Frame& frame);
/// Diamonds where `elements` are smaller than these in the picture, no two in one place, so that what is around stays to be seen.
void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements);
/// A diamond at a point of the scene.
void add_diamond(render::Marks& marks, Vec3 at, float diameter, const render::Style& style);
/// Of the frame's worst elements all that only their inside inverts, at their place.
void add_inverted_inside(render::Marks& marks, const MarkView& view, const Frame& frame, const render::Style& style);

/// The element that is picked, or those around the vertex that is.
[[nodiscard]] std::vector<Index> picked_elements(const OverlayInput& in);
/// For each element that has a target by `metric` an ellipse of the target's shape and direction, as large as the element, with its longer
/// axis, in space the three of an ellipsoid; and, thinner, that of the element as it stands. None of curved surfaces, or where the frame is
/// not on the host.
void add_targets(render::Marks& marks, const ScenePoints& points, const Frame& frame, Metric metric, std::span<const Index> elements);

}  // namespace dmoscope::ui
