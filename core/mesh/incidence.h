#pragma once
// Entries of a vertex's star.

#include "core/base/vec.h"

namespace dmoscope {

/// One incident element of a vertex: its index, and the vertex's place among its corners.
struct Incidence {
  Index element;
  Index corner;
};

}  // namespace dmoscope
