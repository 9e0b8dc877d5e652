#pragma once
// What is drawn of what holds the minimum: the rim of the cluster, the elements that hold one another, and their forces.

#include <span>

#include "core/joint/joint_clusters.h"
#include "ui/viewports/stepping_marks.h"
#include "ui/viewports/volume_stepping_marks.h"

namespace dmoscope::ui {

/// Of a planar mesh.
void add_holders(render::Marks& marks, const MarkView& view, const JointCluster& cluster, const InputMesh& input,
                 std::span<const Vec3> positions, render::Rgba ink, render::Rgba casing);
/// Of a volume: nothing hides them. Its cluster has no rim.
void add_space_holders(render::SpaceMarks& marks, const SpaceMarkView& view, const JointCluster& cluster, std::span<const Vec3> positions,
                       render::Rgba ink, render::Rgba casing);

}  // namespace dmoscope::ui
