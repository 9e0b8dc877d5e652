#pragma once
// Colours of elements that hold one another at the minimum. Part of colour_elements().

#include "ui/analysis/element_colours.h"

namespace dmoscope::ui {

/// Colours elements for ColourBy::Multiplier.
void colour_by_multiplier(const ColourRequest& request, ElementColours& colours, render::Shading& shading);

/// Elements at the vertices of a cluster, ascending.
[[nodiscard]] std::vector<Index> elements_of(const JointCluster& cluster, const InputMesh& input);

}  // namespace dmoscope::ui
