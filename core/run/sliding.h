#pragma once
// Sliding of a part of the boundary, and sentences on the vertices that slide.

#include <span>
#include <string>

#include "core/input/input_mesh.h"
#include "core/run/run.h"

namespace dmoscope {

/// Lets the boundary slide at these vertices and fixes the rest of it. Throws UsageError where none of them is on the boundary.
void slide_only(RunParameters& parameters, const InputMesh& input, std::span<const Index> vertices);

/// Number of vertices that the rule lets slide, without those fixed by hand.
[[nodiscard]] Index count_sliding(const Run& run);
/// Domain::sentence(), and how many of its vertices were fixed by hand. Empty where nothing slides by a rule.
[[nodiscard]] std::string sliding_sentence(const Run& run);

}  // namespace dmoscope
