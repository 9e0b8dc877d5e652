#pragma once
// Sets of kinds of elements.

#include <cstdint>
#include <string>

#include "core/mesh/mesh.h"

namespace dmoscope {

/// Bit k is ElementKind k.
using KindSet = std::uint8_t;
[[nodiscard]] constexpr KindSet kind_set(ElementKind kind) { return static_cast<KindSet>(1U << static_cast<unsigned>(kind)); }
[[nodiscard]] constexpr bool contains(KindSet kinds, ElementKind kind) { return (kinds & kind_set(kind)) != 0; }
/// "triangles, quadrilaterals and tetrahedra".
[[nodiscard]] std::string words(KindSet kinds);

}  // namespace dmoscope
