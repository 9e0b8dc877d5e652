#pragma once
// Freedom of elements' vertices to move, for the colours and the filter by freedom. No ImGui, no OpenGL.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/reference/domain.h"

namespace dmoscope::ui {

/// Names of an element's freedom, by the least free of its vertices, from no direction to all; the first means that none of the vertices
/// moves.
inline constexpr std::array<std::string_view, 5> kFreedoms{"all fixed", "some fixed", "some on a curve", "some on the surface", "all free"};

/// Index into kFreedoms for every element. `fixed`: see Run::fixed; `domain`: null if nothing slides.
[[nodiscard]] std::vector<std::uint8_t> freedom_of_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, const Domain* domain);

}  // namespace dmoscope::ui
