#pragma once
// What a vertex's star is made of.

#include "core/base/vec.h"

namespace dmoscope {

/// One incident element of a vertex: which, and which of its corners the vertex is.
struct Incidence {
  Index element;
  Index corner;
};

}  // namespace dmoscope
