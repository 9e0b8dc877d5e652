#pragma once
// Colours, fonts and spacing of the interface.

#include <array>

#include <imgui.h>

#include "render/image.h"
#include "render/style.h"
#include "ui/state/view_state.h"

namespace dmoscope::ui {

/// All colours that panels draw with.
struct Palette {
  render::Rgb background;  // colour behind the mesh
  render::Rgb panel, raised, line;
  render::Rgb text, dim;
  render::Rgb accent, on_accent;
  render::Rgb good, warning, error;
  render::Rgb grid;  // grid of plots
  std::array<render::Rgb, 16> runs;
  /// Colour of run k, from 0.
  [[nodiscard]] render::Rgb run(std::size_t k) const { return runs[k % runs.size()]; }
};
[[nodiscard]] const Palette& palette(Theme theme);

/// WCAG 2 contrast of two colours, 1 to 21.
[[nodiscard]] double contrast(render::Rgb a, render::Rgb b);

[[nodiscard]] ImU32 colour(render::Rgb rgb, float alpha = 1.0F);
[[nodiscard]] ImVec4 colour_vector(render::Rgb rgb, float alpha = 1.0F);

/// Sets ImGui's colours and spacing; all sizes follow the font.
void apply_style(Theme theme, double scale);

/// Look of the mesh in this theme.
[[nodiscard]] render::Style scene_style(const ViewState& state);

}  // namespace dmoscope::ui
