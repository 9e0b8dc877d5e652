#pragma once
// What is marked on a mesh besides stepping and a visit. Plain functions of positions.

#include <span>
#include <vector>

#include "core/joint/joint_clusters.h"
#include "core/reference/domain.h"
#include "core/view/view.h"
#include "render/volume_scene.h"
#include "ui/state/view_state.h"
#include "ui/viewports/stepping_marks.h"
#include "ui/viewports/volume_stepping_marks.h"

namespace dmoscope::ui {

// Where vertices slide: curves and feature edges as lines, what is held as squares.

/// Of a planar mesh, as far as it is in view.
void add_features(render::Marks& marks, const MarkView& view, const Domain& domain, const InputMesh& input, std::span<const Vec3> positions,
                  render::Rgba ink);
/// Of a volume or a curved surface, as far as nothing hides it.
void add_space_features(render::SpaceMarks& marks, const Domain& domain, std::span<const Vec3> positions, const render::Unhidden& unhidden,
                        render::Rgba ink, render::Rgba casing);

/// One edge, so that it is found among the others.
void add_edge(render::Marks& marks, const InputMesh& input, std::span<const Vec3> positions, const EdgeEnds& edge, render::Rgba ink,
              render::Rgba casing);
void add_space_edge(render::SpaceMarks& marks, std::span<const Vec3> positions, const EdgeEnds& edge, render::Rgba ink,
                    render::Rgba casing);

// What holds the minimum: the rim of the cluster, the elements that hold one another, and their forces.

/// Of a planar mesh.
void add_holders(render::Marks& marks, const MarkView& view, const JointCluster& cluster, const InputMesh& input,
                 std::span<const Vec3> positions, render::Rgba ink, render::Rgba casing);
/// Of a volume: nothing hides them. Its cluster has no rim.
void add_space_holders(render::SpaceMarks& marks, const SpaceMarkView& view, const JointCluster& cluster, std::span<const Vec3> positions,
                       render::Rgba ink, render::Rgba casing);

// Inverted elements that are too small to be seen in their own colour, and those that only their inside inverts, at their place.

/// Ascending; of so many that marks would be a carpet an even choice. None of a frame that lives on a device.
[[nodiscard]] std::vector<Index> inverted_elements(const Frame& frame);

/// Diamonds where `elements` are smaller than these in the picture, no two in one place, so that what is around stays to be seen.
void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements);

/// Where an element is inverted inside.
void add_diamond(render::SpaceMarks& marks, Vec3 at, float diameter, render::Rgba colour, const render::Style& style);
/// Of the frame's worst elements all that only their inside inverts.
void add_inverted_inside(render::SpaceMarks& marks, const Frame& frame, const render::Style& style);

// What elements are wished to be: ellipses over those that are picked; in space the three of an ellipsoid.

/// For each element that has a target by `metric` an ellipse of the target's shape and direction, as large as the element, with its longer
/// axis; and, thinner, that of the element as it stands. Of planar meshes whose frame is on the host; others have none.
void add_targets(render::Marks& marks, const Frame& frame, Metric metric, std::span<const Index> elements);
/// The same of one element of a volume, around the axes of the ellipsoid.
void add_space_target(render::SpaceMarks& marks, const Frame& frame, Metric metric, Index element);

// What the last step moved, for a moment: rings, arrows and outlines of few, arrows of many, dots of very many.

/// As strong as state.stepping.flash_level says. `frame`: that state.stepping.news is about. Returns how many times too long the arrows
/// are; 0 where there are none.
double add_flash(render::Marks& marks, const MarkView& view, const ViewState& state, const Frame& frame);

/// The same over a volume, of vertices that nothing hides; `unhidden` is ascending.
double add_space_flash(render::SpaceMarks& marks, const SpaceMarkView& view, const ViewState& state, const Frame& frame,
                       std::span<const Index> unhidden);

}  // namespace dmoscope::ui
