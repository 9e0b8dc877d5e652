#pragma once
// What elements are coloured by that sliding is about: how far the boundary is from the input's, and how free elements are. Part of
// colour_elements().

#include "ui/analysis/element_colours.h"

namespace dmoscope::ui {

/// For ColourBy::Deviation, Tilt and Freedom.
void colour_by_sliding(const ColourRequest& request, ElementColours& colours, render::Shading& shading);

}  // namespace dmoscope::ui
