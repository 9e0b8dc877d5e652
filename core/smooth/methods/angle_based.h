#pragma once
// Angle-based smoothing (Zhou and Shimada 2000): each vertex goes to the mean of the places at which it halves the angles of the ring of
// its edge neighbours, one place per angle, whatever becomes of the elements.

#include <memory>

#include "core/smooth/smoother.h"

namespace dmoscope {

/// See make_smoother, which checks the arguments. Quadrilaterals count by the ring of edge neighbours, too.
[[nodiscard]] std::unique_ptr<Smoother> make_angle_based_smoother(const SmoothingTask& task);

}  // namespace dmoscope
