#pragma once
// Colours of elements that depend on the run: freedom to move, distance of the boundary from the input's, and what holds the minimum.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/mesh/mesh.h"
#include "core/reference/domain.h"
#include "ui/analysis/element_colours.h"

namespace dmoscope::ui {

/// Names of an element's freedom, by the least free of its vertices, from no direction to all; the first means that none of the vertices
/// moves.
inline constexpr std::array<std::string_view, 5> kFreedoms{"all fixed", "some fixed", "some on a curve", "some on the surface", "all free"};

/// Index into kFreedoms for every element. `fixed`: see Run::fixed; `domain`: null if nothing slides.
[[nodiscard]] std::vector<std::uint8_t> freedom_of_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, const Domain* domain);

/// Colours elements for ColourBy::Deviation, Tilt and Freedom.
void colour_by_sliding(const ColourRequest& request, ElementColours& colours, render::Shading& shading);

/// Colours elements for ColourBy::Multiplier.
void colour_by_multiplier(const ColourRequest& request, ElementColours& colours, render::Shading& shading);

/// Elements at the vertices of a cluster, ascending.
[[nodiscard]] std::vector<Index> elements_of(const JointCluster& cluster, const InputMesh& input);

}  // namespace dmoscope::ui
