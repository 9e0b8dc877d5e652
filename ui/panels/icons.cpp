#include "ui/panels/icons.h"

#include <algorithm>
#include <cmath>

#include "ui/panels/widgets.h"

namespace dmoscope::ui {
namespace {

void draw_eye(ImDrawList& list, ImVec2 m, float r, ImU32 ink, float width) {
  for (const float way : {-1.0F, 1.0F}) list.AddBezierQuadratic({m.x - r, m.y}, {m.x, m.y + 1.25F * way * r}, {m.x + r, m.y}, ink, width);
  list.AddCircleFilled(m, 0.30F * r, ink);
}

void draw_lock(ImDrawList& list, ImVec2 m, float r, ImU32 ink, float width, bool shut) {
  const float side = 0.62F * r, top = m.y - 0.08F * r, bow = 0.42F * r, up = shut ? 0.0F : 0.18F * r;
  list.AddRectFilled({m.x - side, top}, {m.x + side, m.y + 0.85F * r}, ink, 0.18F * r);
  constexpr float kPi = 3.14159265F;
  list.PathArcTo({m.x, top - 0.28F * r - up}, bow, kPi, 2 * kPi);
  if (shut) list.PathLineTo({m.x + bow, top});
  list.PathStroke(ink, 0, width);
  list.AddLine({m.x - bow, top - 0.28F * r - up}, {m.x - bow, top}, ink, width);
}

void draw_chevron(ImDrawList& list, ImVec2 m, float r, ImVec2 way, ImU32 ink, float width) {
  const float reach = 0.45F * r, wide = 0.8F * r;
  const ImVec2 across{-way.y, way.x};
  const auto at = [&](float along, float aside) {
    return ImVec2{m.x + along * way.x + aside * across.x, m.y + along * way.y + aside * across.y};
  };
  const ImVec2 points[] = {at(-reach, -wide), at(reach, 0), at(-reach, wide)};
  list.AddPolyline(points, 3, ink, ImDrawFlags_None, width);
}

}  // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 middle, float side, ImU32 ink) {
  const float r = 0.42F * side, width = std::max(1.0F, 0.09F * side);
  switch (icon) {
    case Icon::Eye:
      return draw_eye(list, middle, r, ink, width);
    case Icon::EyeOff:
      draw_eye(list, middle, r, ink, width);
      return list.AddLine({middle.x - 0.8F * r, middle.y + 0.8F * r}, {middle.x + 0.8F * r, middle.y - 0.8F * r}, ink, 1.4F * width);
    case Icon::Cross:
      for (const float way : {-1.0F, 1.0F})
        list.AddLine({middle.x - 0.6F * r, middle.y - 0.6F * way * r}, {middle.x + 0.6F * r, middle.y + 0.6F * way * r}, ink, 1.2F * width);
      return;
    case Icon::Lock:
      return draw_lock(list, middle, r, ink, width, true);
    case Icon::LockOff:
      return draw_lock(list, middle, r, ink, width, false);
    case Icon::ChevronLeft:
      return draw_chevron(list, middle, r, {-1, 0}, ink, 1.2F * width);
    case Icon::ChevronRight:
      return draw_chevron(list, middle, r, {1, 0}, ink, 1.2F * width);
    case Icon::ChevronUp:
      return draw_chevron(list, middle, r, {0, -1}, ink, 1.2F * width);
    case Icon::ChevronDown:
      return draw_chevron(list, middle, r, {0, 1}, ink, 1.2F * width);
  }
}

bool icon_button(PanelContext& context, const std::string& item, Icon icon, ImVec2 size, const std::string& tooltip, bool lit) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const bool pressed = ImGui::InvisibleButton(item.c_str(), size);
  context.items.record_last(item);
  const bool hovered = ImGui::IsItemHovered();
  next_item_tooltip(tooltip);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float alpha = ImGui::GetStyle().Alpha;
  if (hovered || lit)
    list.AddRectFilled(at, {at.x + size.x, at.y + size.y},
                       colour(lit ? context.palette.accent : context.palette.text, hovered ? 0.22F : 0.3F), context.px(3));
  const render::Rgb ink = hovered || lit ? context.palette.text : context.palette.dim;
  draw_icon(list, icon, {std::round(at.x + size.x / 2), std::round(at.y + size.y / 2)}, std::min(size.x, size.y), colour(ink, alpha));
  return pressed;
}

}  // namespace dmoscope::ui
