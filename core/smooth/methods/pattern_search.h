#pragma once
// Compass search (the pattern search that Park and Shontz 2010 use on meshes): four steps along the axes are tried, the best is made, and
// the steps grow or shrink, until they are small.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_pattern_search_smoother(const SmoothingTask& task);

}  // namespace dmoscope
