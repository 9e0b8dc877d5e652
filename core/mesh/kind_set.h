#pragma once
// Sets of element kinds.

#include <cstdint>
#include <string>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Set of element kinds: bit k stands for ElementKind k.
using KindSet = std::uint8_t;
[[nodiscard]] constexpr KindSet kind_set(ElementKind kind) { return static_cast<KindSet>(1U << static_cast<unsigned>(kind)); }
[[nodiscard]] constexpr bool contains(KindSet kinds, ElementKind kind) { return (kinds & kind_set(kind)) != 0; }
/// Names of the kinds in a sentence: "triangles, quadrilaterals and tetrahedra".
[[nodiscard]] std::string words(KindSet kinds);

}  // namespace dmoscope
