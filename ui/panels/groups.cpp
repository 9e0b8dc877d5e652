// Left: the groups that the file carried.
#include <algorithm>

#include <fmt/format.h>

#include "core/commands/commands.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

std::string tooltip_of(const GroupFacts& group) {
  std::string text =
      fmt::format("{}\n{}: {} {}, {} vertices", group.name, group.kind, count(group.members), group.of, count(group.vertices));
  if (group.number) text += fmt::format("; number {} in the file", *group.number);
  if (group.type) text += fmt::format("; type {}", *group.type);
  return text;
}

/// "land b… 12": names of a kind differ at their end, so they are cut in their midst. The count goes first where there is no room.
std::string fit_name(const GroupFacts& group, float room) {
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  if (std::string whole = fmt::format("{}  {}", group.name, count(group.members)); width(whole) <= room) return whole;
  if (width(group.name) <= room) return group.name;
  const std::size_t space = group.name.rfind(' ');
  constexpr std::size_t kLongestEnd = 6;
  if (space == std::string::npos || group.name.size() - space > kLongestEnd) return fit_text(group.name, room);
  const std::string end = group.name.substr(space);
  return fit_text(group.name.substr(0, space), room - width(end)) + end;
}

/// A small button that is lit while what it does is in force.
bool switch_button(const PanelContext& context, const char* label, bool on) {
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, colour_vector(context.palette.accent, 0.45F));
  const bool pressed = ImGui::SmallButton(label);
  if (on) ImGui::PopStyleColor();
  return pressed;
}

void draw_line(PanelContext& context, const GroupLine& line, bool fixed) {
  const GroupFacts& group = line.facts;
  const float side = 0.7F * ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float top = at.y + ImGui::GetStyle().FramePadding.y;
  if (line.colour) list.AddRectFilled({at.x, top}, {at.x + side, top + side}, colour(*line.colour), context.px(2));
  const float buttons = ImGui::CalcTextSize("fixisolate").x + 4 * ImGui::GetStyle().FramePadding.x + context.px(14);
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  const float name = ImGui::GetCursorPosX() + side + context.px(6);
  ImGui::SetCursorPosX(name);
  ImGui::TextUnformatted(fit_name(group, right - buttons - name).c_str());
  next_item_tooltip(tooltip_of(group));
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - buttons + context.px(6));
  if (switch_button(context, "fix", fixed)) context.send((fixed ? "unfix " : "fix ") + quote_word(line.word));
  context.items.record_last("group-fix:" + group.name);
  next_item_tooltip(fixed ? "its vertices stay; a click gives them back" : "keeps its vertices where they are");
  ImGui::SameLine(0, context.px(4));
  const bool alone = context.state.colouring.isolated == Isolation{ColourBy::Group, group.name};
  if (switch_button(context, "isolate", alone)) context.send(alone ? "isolate off" : "isolate group " + quote_word(group.name));
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
  constexpr float kMostRows = 5;          // more of them scroll by themselves, so that the parameters stay in sight
  const std::size_t shown = std::min(groups.size(), kMostShown);
  const bool more = groups.size() > kMostShown, scrolls = static_cast<float>(groups.size()) > kMostRows;
  if (scrolls) ImGui::BeginChild("groups", {0, (kMostRows + 0.5F) * ImGui::GetTextLineHeightWithSpacing()});
  ImGui::BeginDisabled(context.activity.busy);
  for (std::size_t g = 0; g < shown; ++g) {
    ImGui::PushID(static_cast<int>(g));
    draw_line(context, groups[g], g < context.derived.groups_fixed.size() && context.derived.groups_fixed[g]);
    ImGui::PopID();
  }
  ImGui::EndDisabled();
  if (more) dim_text(context, fmt::format("and {} more: dmoscope info FILE lists all", count(groups.size() - kMostShown)));
  if (scrolls) ImGui::EndChild();
}

}  // namespace dmoscope::ui
