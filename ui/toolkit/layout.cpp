#include "ui/toolkit/layout.h"

#include <algorithm>
#include <cmath>

namespace dmoscope::ui {

namespace {

/// The viewport gives plots and timeline their room.
void take_bottom(Layout& layout, const Panels& panels, float em) {
  constexpr float kLeastMeshHeight = 10.0F, kLeastPlots = 9.0F, kTimeline = 2.7F;
  Rect& mesh = layout.viewport;
  float height = 0.0F;
  if (panels.plots()) height = std::min({static_cast<float>(panels.bottom_height) * em, 0.4F * mesh.h, mesh.h - kLeastMeshHeight * em});
  if (height < kLeastPlots * em) {
    layout.timeline_only = mesh.h >= (kTimeline + kLeastMeshHeight) * em;
    height = layout.timeline_only ? kTimeline * em : 0.0F;
  }
  height = std::round(height);
  mesh.h = std::max(0.0F, mesh.h - height);
  layout.bottom = {mesh.x, mesh.y + mesh.h, mesh.w, height};
}

}  // namespace

Layout compute_layout(const Panels& panels, float width, float height, float em, float menu, bool timeline) {
  constexpr float kToolbar = 2.9F, kStatus = 1.9F, kStrip = 2.6F;
  constexpr float kFoldBelow = 68.0F, kLeastMesh = 24.0F;
  Layout out;
  // Whole pixels everywhere: ImGui puts windows there, and the mesh's picture must not be resampled.
  out.toolbar = {0, std::round(menu), width, std::round(kToolbar * em)};
  const float status = std::round(kStatus * em);
  out.status = {0, height - status, width, status};
  const float top = out.toolbar.y + out.toolbar.h;
  const float inner = std::max(0.0F, out.status.y - top);

  out.folded = width < kFoldBelow * em;
  float left = panels.left ? static_cast<float>(panels.left_width) * em : 0.0F;
  float right = panels.right ? static_cast<float>(panels.right_width) * em : 0.0F;
  const float room = std::max(0.0F, width - kLeastMesh * em);
  if (out.folded) {
    const float strip = std::round(kStrip * em);
    const float over = std::min(std::max(0.0F, width - 2 * strip), width * 0.6F);
    out.left_strip = {0, top, strip, inner};
    out.right_strip = {width - strip, top, strip, inner};
    out.viewport = {strip, top, std::max(0.0F, width - 2 * strip), inner};
    if (timeline) take_bottom(out, panels, em);
    const float left_wanted = std::min(static_cast<float>(panels.left_width) * em, over);
    const float right_wanted = std::min(static_cast<float>(panels.right_width) * em, over);
    const bool both = panels.left_over && panels.right_over;  // then neither may cover the other
    const float share = both ? std::min(1.0F, out.viewport.w / (left_wanted + right_wanted)) : 1.0F;
    const float left_over = std::floor(left_wanted * share);
    const float right_over = std::floor(right_wanted * share);
    if (panels.left_over) out.left = {strip, top, left_over, inner};
    if (panels.right_over) out.right = {width - strip - right_over, top, right_over, inner};
    return out;
  }
  if (left + right > room) {
    const float shrink = room / (left + right);
    left *= shrink;
    right *= shrink;
  }
  left = std::round(left);
  right = std::round(right);
  out.left = {0, top, left, inner};
  out.right = {width - right, top, right, inner};
  out.viewport = {left, top, std::max(0.0F, width - left - right), inner};
  if (timeline) take_bottom(out, panels, em);
  return out;
}

}  // namespace dmoscope::ui
