#pragma once
// Colours about sliding: distance of the boundary from the input's, and freedom of elements. Part of colour_elements().

#include "ui/analysis/element_colours.h"

namespace dmoscope::ui {

/// Colours elements for ColourBy::Deviation, Tilt and Freedom.
void colour_by_sliding(const ColourRequest& request, ElementColours& colours, render::Shading& shading);

}  // namespace dmoscope::ui
