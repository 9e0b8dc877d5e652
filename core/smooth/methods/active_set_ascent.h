#pragma once
// Active-set ascent (Freitag, Jones and Plassmann 1995; Mesquite's NonSmoothDescent): the least quality of a star is raised along the
// steepest direction in which none of those that are about the least falls, from one such set to the next.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// See make_smoother, which checks the arguments.
[[nodiscard]] std::unique_ptr<Smoother> make_active_set_smoother(const SmoothingTask& task);

}  // namespace dmoscope
