#include "ui/panels/icons.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "ui/panels/widgets.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

/// Draws the strokes of a path one after the other.
class PathPen {
 public:
  PathPen(ImDrawList& list, ImVec2 middle, float side, ImU32 ink)
      : list_(list), middle_(middle), unit_(side / 16), ink_(ink), width_(std::max(1.0F, 1.5F * side / 16)) {}

  void draw(std::string_view path) {
    for (rest_ = path; !rest_.empty();) {
      const char step = rest_.front();
      rest_.remove_prefix(1);
      if (step == 'M' || step == 'Z') end(step == 'Z');
      if (step == 'F') list_.PathFillConvex(ink_);
      if (step == 'M' || step == 'L') list_.PathLineTo(point());
      if (step == 'Q') {
        const ImVec2 control = point();
        list_.PathBezierQuadraticCurveTo(control, point());
      }
      if (step == 'A') arc();
    }
    end(false);
  }

 private:
  void end(bool closed) { list_.PathStroke(ink_, closed ? ImDrawFlags_Closed : ImDrawFlags_None, width_); }
  void arc() {
    constexpr float kDegree = 3.14159265F / 180;
    const ImVec2 centre = point();
    const float radius = number() * unit_, from = number() * kDegree;
    list_.PathArcTo(centre, radius, from, number() * kDegree);
  }
  ImVec2 point() {
    const float x = number();
    return {middle_.x + (x - 8) * unit_, middle_.y + (number() - 8) * unit_};
  }
  float number() {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
    float value = 0;
    rest_.remove_prefix(static_cast<std::size_t>(std::from_chars(rest_.data(), rest_.data() + rest_.size(), value).ptr - rest_.data()));
    return value;
  }

  ImDrawList& list_;
  ImVec2 middle_;
  float unit_;
  ImU32 ink_;
  float width_;
  std::string_view rest_;
};

}  // namespace

void draw_icon(ImDrawList& list, std::string_view icon, ImVec2 middle, float side, ImU32 ink) {
  PathPen(list, middle, side, ink).draw(icon);
}

bool icon_button(PanelContext& context, const std::string& item, std::string_view icon, ImVec2 size, const std::string& tooltip, bool lit) {
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
  draw_icon(list, icon, {std::round(at.x + size.x / 2), std::round(at.y + size.y / 2)},
            std::min({size.x, size.y, std::round(1.1F * context.em())}), colour(ink, alpha));
  return pressed;
}

void action_icon(PanelContext& context, std::string_view id, std::string_view icon, ImVec2 size) {
  const Action& action = *find_action(id);
  ImGui::BeginDisabled(!enabled(action, context.situation()));
  if (icon_button(context, std::string(id), icon, size, tooltip_of(action), is_ticked(context.state, action)))
    context.send(std::string(action.command));
  ImGui::EndDisabled();
}

}  // namespace dmoscope::ui
