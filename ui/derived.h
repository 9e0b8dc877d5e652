#pragma once
// Values worked out from a frame once, not at every drawing.

#include "render/screenshot.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {

/// Brings `derived` up to date with the session's frame and the view's colour range, plot and selection; cheap when nothing changed.
void refresh(Derived& derived, const ViewState& state, const SessionView& session);

/// How a quality becomes a colour now: in the mesh, the bar, legends and heat maps alike.
[[nodiscard]] render::ColourScale colour_scale(const ViewState& state, const Derived& derived);
/// The same for what the elements are coloured by now, where those are no categories.
[[nodiscard]] render::ColourScale shown_scale(const ViewState& state, const Derived& derived);
/// Which elements count now.
[[nodiscard]] render::Selection selection_of(const ViewState& state, const Derived& derived);
/// What a picture tells about its colours.
[[nodiscard]] render::Legend legend_of(const ViewState& state, const Derived& derived, const Frame& frame);

}  // namespace dmoscope::ui
