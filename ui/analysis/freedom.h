#pragma once
// How free an element's vertices are to move: what the colours and the filter by freedom are about. No ImGui, no OpenGL.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/reference/domain.h"

namespace dmoscope::ui {

/// By the least free of an element's vertices, from none to all of the ways that there are; the first: none of them moves.
inline constexpr std::array<std::string_view, 5> kFreedoms{"all fixed", "some fixed", "some on a curve", "some on the surface", "all free"};

/// Of every element an index into these. `fixed`: see Run::fixed; `domain`: null, where nothing slides.
[[nodiscard]] std::vector<std::uint8_t> freedom_of_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, const Domain* domain);

}  // namespace dmoscope::ui
