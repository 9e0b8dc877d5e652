#pragma once
// Draws the quality around an inspected vertex: as a heat map with contours, wherever it is wanted.

#include <functional>

#include "render/colour_map.h"
#include "ui/analysis/inspection.h"
#include "ui/panels/panels.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {

/// Where a point of the plane, relative to where the vertex stood, is on the window.
using ToWindow = std::function<ImVec2(Vec2<double>)>;

struct FieldLook {
  render::ColourScale colours;
  const Palette& palette;
  float em = 15.0F, scale = 1.0F;
  bool only_valid = false;  // nothing where an element is inverted; else hatching
};

/// Heat map, contours with their values, and the outline of the region without inverted elements.
void draw_field(ImDrawList& list, const FieldPicture& picture, const FieldLook& look, const ToWindow& at);

/// Quality and Jacobian at the sample nearest to a point; nothing outside the field.
[[nodiscard]] std::optional<std::pair<double, double>> field_at(const QualityField& field, Vec2<double> point);

}  // namespace dmoscope::ui
