// The ids of vertices and elements, on the mesh.
#include <cmath>

#include "ui/panels/panels.h"

namespace dmoscope::ui {

void draw_labels(PanelContext& context, const PaneFacts& pane) {
  const Rect& rect = pane.rect;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float size = std::round(0.8F * context.em());
  for (const render::Label& label : pane.labels) {
    const std::string text = std::to_string(label.id);
    const ImVec2 extent = context.fonts.body->CalcTextSizeA(size, FLT_MAX, 0.0F, text.c_str());
    const Vec2<double> at{0.5 * context.state.viewport.x + label.point.x, 0.5 * context.state.viewport.y - label.point.y};
    const ImVec2 low{std::round(rect.x + static_cast<float>(at.x) - extent.x / 2),
                     std::round(rect.y + static_cast<float>(at.y) - extent.y / 2)};
    const float pad = context.px(2);
    // Labels of vertices are dark on light, those of elements light on dark.
    const render::Rgb plate = label.vertex ? context.palette.text : context.palette.panel;
    const render::Rgb ink = label.vertex ? context.palette.panel : context.palette.text;
    list.AddRectFilled({low.x - pad, low.y}, {low.x + extent.x + pad, low.y + extent.y}, colour(plate, 0.88F), context.px(3));
    list.AddText(context.fonts.body, size, low, colour(ink), text.c_str());
  }
}

}  // namespace dmoscope::ui
