#pragma once
// What the last step moved, drawn over the mesh for a moment: rings, arrows and outlines of few, arrows of many, dots of very many.

#include "ui/state/view_state.h"
#include "ui/viewports/stepping_marks.h"
#include "ui/viewports/volume_stepping_marks.h"

namespace dmoscope::ui {

/// As strong as state.stepping.flash_level says. `frame`: that state.stepping.news is about. Returns how many times too long the arrows
/// are; 0 where there are none.
double add_flash(render::Marks& marks, const MarkView& view, const ViewState& state, const Frame& frame);

/// The same over a volume, of vertices that nothing hides; `unhidden` is ascending.
double add_space_flash(render::SpaceMarks& marks, const SpaceMarkView& view, const ViewState& state, const Frame& frame,
                       std::span<const Index> unhidden);

}  // namespace dmoscope::ui
