#pragma once
// A boundary of which a part slides, and what is said of those that slide.

#include <span>
#include <string>

#include "core/input/input_mesh.h"
#include "core/run/run.h"

namespace dmoscope {

/// Lets the boundary slide at these vertices and fixes the rest of it. Throws UsageError where none of them is on the boundary.
void slide_only(RunParameters& parameters, const InputMesh& input, std::span<const Index> vertices);

/// How many vertices slide: those that the rule lets slide, without what was fixed by hand.
[[nodiscard]] Index count_sliding(const Run& run);
/// Domain::sentence(), and how many of those were fixed by hand. Empty where nothing slides by a rule.
[[nodiscard]] std::string sliding_sentence(const Run& run);

}  // namespace dmoscope
