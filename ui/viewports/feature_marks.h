#pragma once
// What is drawn of where vertices slide: curves and feature edges as lines, what is held as squares. Plain functions of positions.

#include <span>

#include "core/reference/domain.h"
#include "render/volume_scene.h"
#include "ui/viewports/stepping_marks.h"

namespace dmoscope::ui {

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

}  // namespace dmoscope::ui
