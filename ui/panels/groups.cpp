// Left: the groups that the file carried.
#include <algorithm>

#include <fmt/format.h>

#include "core/session/commands.h"
#include "ui/format.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

std::string tooltip_of(const GroupFacts& group) {
  std::string text = fmt::format("{}: {} {}, {} vertices", group.kind, count(group.members), group.of, count(group.vertices));
  if (group.number) text += fmt::format("; number {} in the file", *group.number);
  if (group.type) text += fmt::format("; type {}", *group.type);
  return text;
}

void draw_line(PanelContext& context, const GroupLine& line) {
  const GroupFacts& group = line.facts;
  const float side = 0.7F * ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float top = at.y + ImGui::GetStyle().FramePadding.y;
  if (line.colour) list.AddRectFilled({at.x, top}, {at.x + side, top + side}, colour(*line.colour), context.px(2));
  const float buttons = ImGui::CalcTextSize("fixisolate").x + 4 * ImGui::GetStyle().FramePadding.x + context.px(14);
  const float right = ImGui::GetWindowContentRegionMax().x;
  const float name = ImGui::GetCursorPosX() + side + context.px(6);
  ImGui::SetCursorPosX(name);
  ImGui::TextUnformatted(fit_text(fmt::format("{}  {}", group.name, count(group.members)), right - buttons - name).c_str());
  next_item_tooltip(tooltip_of(group));
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - buttons + context.px(6));
  if (ImGui::SmallButton("fix")) context.send("fix " + quote_word(line.word));
  context.items.record_last("group-fix:" + group.name);
  next_item_tooltip("keeps its vertices where they are");
  ImGui::SameLine(0, context.px(4));
  const bool alone = context.state.colouring.isolated == Isolation{ColourBy::Group, group.name};
  if (ImGui::SmallButton(alone ? "all" : "isolate")) context.send(alone ? "isolate off" : "isolate group " + quote_word(group.name));
  context.items.record_last("group-isolate:" + group.name);
  next_item_tooltip(alone ? "all elements count again" : "only its elements, or those around it, count");
}

}  // namespace

void draw_groups(PanelContext& context) {
  const std::vector<GroupLine>& groups = context.derived.groups;
  if (groups.empty() || context.run() == nullptr) return;
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Groups");
  constexpr std::size_t kMostShown = 40;  // beyond, a list in a panel helps nobody
  ImGui::BeginDisabled(context.activity.busy);
  for (std::size_t g = 0; g < std::min(groups.size(), kMostShown); ++g) {
    ImGui::PushID(static_cast<int>(g));
    draw_line(context, groups[g]);
    ImGui::PopID();
  }
  ImGui::EndDisabled();
  if (groups.size() > kMostShown)
    dim_text(context, fmt::format("and {} more: dmoscope info FILE lists all", count(groups.size() - kMostShown)));
}

}  // namespace dmoscope::ui
