#pragma once
// Where labels and marks of a volume mesh can be put because nothing hides the place. Only for sources of this module.

#include <vector>

#include "render/depth_map.h"
#include "render/volume_scene.h"

namespace dmoscope::render {

/// See VolumeScene::unhidden and VolumeScene::labels.
[[nodiscard]] Unhidden unhidden_of(const SeenFaces& seen, const DepthMap& depths);
[[nodiscard]] std::vector<Label> labels_of(const SeenFaces& seen, const DepthMap& depths, const LabelWish& wish);

}  // namespace dmoscope::render
