#pragma once
// Draws the quality around an inspected vertex as a heat map with contours, in any panel.

#include <functional>

#include "render/colour_map.h"
#include "ui/analysis/inspection.h"
#include "ui/panels/panels.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {

/// Maps a point of the plane, relative to the vertex's place before its visit, to the window.
using ToWindow = std::function<ImVec2(Vec2<double>)>;

struct FieldLook {
  render::ColourScale colours;
  const Palette& palette;
  float em = 15.0F, scale = 1.0F;
  bool only_valid = false;  // draws nothing where an element is inverted; else hatching
};

/// Draws the heat map, contours with their values, and the outline of the region without inverted elements.
void draw_field(ImDrawList& list, const FieldPicture& picture, const FieldLook& look, const ToWindow& at);

/// Quality and Jacobian at the sample nearest to a point; none outside the field.
[[nodiscard]] std::optional<std::pair<double, double>> field_at(const QualityField& field, Vec2<double> point);

}  // namespace dmoscope::ui
