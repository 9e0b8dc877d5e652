#include "ui/toolkit/layout.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {

namespace {

// Heights of the parts, in heights of the font. They become whole pixels: ImGui puts windows there, and the mesh's picture must not be
// resampled.
constexpr float kHeader = 2.66F, kMenu = 1.6F, kLowest = 1.87F;
constexpr float kLeastMesh = 24.0F, kUnfoldedMesh = 33.0F, kLeastMeshHeight = 10.0F, kLeastPlots = 9.0F, kStatus = 20.0F;

/// Places menus and tools in one row if both fit, else one above the other. Returns the lower end of the row.
float place_header(Layout& layout, float width, const HeaderSize& header) {
  const float row = std::round(kHeader * header.em);
  if (header.menu + header.tools <= width) {
    layout.menu = {0, 0, header.menu, row};
    layout.toolbar = {header.menu, 0, width - header.menu, row};
    return row;
  }
  const float menu = std::round(kMenu * header.em);
  layout.menu = {0, 0, width, menu};
  layout.toolbar = {0, menu, width, row};
  return menu + row;
}

/// Places the status below the right column, or without one at the right end. The timeline has the rest.
void place_lowest(Layout& layout, const Panels& panels, float width, float height, float em, bool mesh) {
  const float row = std::round(kLowest * em), top = height - row;
  const bool column = !layout.folded && panels.has_column(Side::Right) && layout.right.w >= kStatus * em * 0.7F;
  const float status = !mesh ? width : column ? layout.right.w : std::round(std::min(kStatus * em, 0.4F * width));
  layout.status = {width - status, top, status, row};
  if (mesh) layout.timeline = {0, top, width - status, row};
}

/// Takes the plots' room from the viewport.
void take_bottom(Layout& layout, const Panels& panels, float em) {
  Rect& mesh = layout.viewport;
  float height = 0.0F;
  if (panels.plots()) height = std::min({static_cast<float>(panels.bottom_height) * em, 0.4F * mesh.h, mesh.h - kLeastMeshHeight * em});
  if (height < kLeastPlots * em) return;
  height = std::round(height);
  mesh.h -= height;
  layout.bottom = {mesh.x, mesh.y + mesh.h, mesh.w, height};
}

/// Places columns that are open over the mesh; none covers the other.
void place_folded(Layout& layout, const Panels& panels, float width, float top, float inner, float em) {
  layout.viewport = {0, top, width, inner};
  const auto over = [&](Side side, double size) {
    return panels.uses(side) && panels.over(side) ? std::min(static_cast<float>(size) * em, width * 0.6F) : 0.0F;
  };
  float left = over(Side::Left, panels.left_width), right = over(Side::Right, panels.right_width);
  const float share = std::min(1.0F, width / std::max(1.0F, left + right));
  left = std::floor(left * share);
  right = std::floor(right * share);
  layout.left = {0, top, left, inner};
  layout.right = {width - right, top, right, inner};
}

void place_columns(Layout& layout, const Panels& panels, float width, float top, float inner, float em) {
  float left = panels.has_column(Side::Left) ? static_cast<float>(panels.left_width) * em : 0.0F;
  float right = panels.has_column(Side::Right) ? static_cast<float>(panels.right_width) * em : 0.0F;
  const float room = std::max(0.0F, width - kLeastMesh * em);
  if (left + right > room) {
    const float shrink = room / (left + right);
    left *= shrink;
    right *= shrink;
  }
  left = std::round(left);
  right = std::round(right);
  layout.left = {0, top, left, inner};
  layout.right = {width - right, top, right, inner};
  layout.viewport = {left, top, std::max(0.0F, width - left - right), inner};
}

/// Whether the usual columns leave too little of the window to the mesh: closing one in a small window must not turn the other into a
/// column.
bool folds(const Panels& panels, float width, float em) {
  const Panels usual;
  const double columns = (panels.uses(Side::Left) ? usual.left_width : 0.0) + (panels.uses(Side::Right) ? usual.right_width : 0.0);
  return width < (static_cast<float>(columns) + kUnfoldedMesh) * em;
}

}  // namespace

Rect Layout::uncovered() const {
  if (!folded) return viewport;
  return {viewport.x + left.w, viewport.y, std::max(0.0F, viewport.w - left.w - right.w), viewport.h};
}

Layout compute_layout(const Panels& panels, float width, float height, const HeaderSize& header, bool mesh) {
  Layout out;
  const float em = header.em, top = place_header(out, width, header);
  const float inner = std::max(0.0F, height - std::round(kLowest * em) - top);
  out.folded = folds(panels, width, em);
  if (out.folded)
    place_folded(out, panels, width, top, inner, em);
  else
    place_columns(out, panels, width, top, inner, em);
  if (mesh) take_bottom(out, panels, em);
  place_lowest(out, panels, width, height, em, mesh);
  return out;
}

}  // namespace dmoscope::ui
