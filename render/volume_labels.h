#pragma once
// What of a volume mesh can be written and drawn at, because nothing hides it. Only for sources of this room.

#include <vector>

#include "render/depth_map.h"
#include "render/volume_scene.h"

namespace dmoscope::render {

/// See VolumeScene::unhidden and VolumeScene::labels.
[[nodiscard]] Unhidden unhidden_of(const SeenFaces& seen, const DepthMap& depths);
[[nodiscard]] std::vector<Label> labels_of(const SeenFaces& seen, const DepthMap& depths, const LabelWish& wish);

}  // namespace dmoscope::render
