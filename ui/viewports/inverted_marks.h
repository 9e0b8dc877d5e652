#pragma once
// Inverted elements that are too small to be seen in their own colour, and those that only their inside inverts, marked at their place.

#include <span>
#include <vector>

#include "core/view/view.h"
#include "render/space_marks.h"
#include "render/style.h"
#include "ui/viewports/stepping_marks.h"

namespace dmoscope::ui {

/// Ascending; of so many that marks would be a carpet an even choice. None of a frame that lives on a device.
[[nodiscard]] std::vector<Index> inverted_elements(const Frame& frame);

/// Diamonds where `elements` are smaller than these in the picture, no two in one place, so that what is around stays to be seen.
void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements);

/// Where an element is inverted inside.
void add_diamond(render::SpaceMarks& marks, Vec3 at, float diameter, render::Rgba colour, const render::Style& style);
/// Of the frame's worst elements all that only their inside inverts.
void add_inverted_inside(render::SpaceMarks& marks, const Frame& frame, const render::Style& style);

}  // namespace dmoscope::ui
