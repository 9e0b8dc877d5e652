#pragma once
// Inverted elements that are too small to be seen in their own colour, marked at their place.

#include <span>
#include <vector>

#include "core/view/view.h"
#include "ui/viewports/stepping_marks.h"

namespace dmoscope::ui {

/// Ascending; of so many that marks would be a carpet an even choice. None of a frame that lives on a device.
[[nodiscard]] std::vector<Index> inverted_elements(const Frame& frame);

/// Diamonds where `elements` are smaller than these in the picture, no two in one place, so that what is around stays to be seen.
void add_inverted(render::Marks& marks, const MarkView& view, const Frame& frame, std::span<const Index> elements);

}  // namespace dmoscope::ui
