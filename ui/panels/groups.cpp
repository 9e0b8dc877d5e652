// The groups from the mesh's file.
#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "core/commands/commands.h"
#include "ui/panels/icons.h"
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

/// Parts of a row that there is room for, the same for all rows.
struct RowLook {
  float room = 0;      // room for the names
  bool words = false;  // whether buttons have words instead of icons
  bool counts = false;
};

std::string counted_name(const GroupFacts& group) { return fmt::format("{}  {}", group.name, count(group.members)); }

float words_width(const PanelContext& context) {
  return ImGui::CalcTextSize("fixisolate").x + 4 * ImGui::GetStyle().FramePadding.x + context.px(14);
}
float icons_width(const PanelContext& context) { return 2 * context.px(18) + context.px(8); }

RowLook look_of(const PanelContext& context, std::span<const GroupLine> lines, float width) {
  float names = 0, with_counts = 0;
  for (const GroupLine& line : lines) {
    names = std::max(names, ImGui::CalcTextSize(line.facts.name.c_str()).x);
    with_counts = std::max(with_counts, ImGui::CalcTextSize(counted_name(line.facts).c_str()).x);
  }
  const float beside_words = width - words_width(context), beside_icons = width - icons_width(context);
  RowLook look{beside_words, true, with_counts <= beside_words};
  if (names > beside_words) look = {beside_icons, false, with_counts <= beside_icons};
  return look;
}

/// Name of a group, cut in its middle if there is no room for all of it ("land b… 12"): names of a kind differ at their end.
std::string fit_name(const GroupFacts& group, const RowLook& look) {
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  if (look.counts) return counted_name(group);
  if (width(group.name) <= look.room) return group.name;
  const std::size_t space = group.name.rfind(' ');
  constexpr std::size_t kLongestEnd = 6;
  if (space == std::string::npos || group.name.size() - space > kLongestEnd) return fit_text(group.name, look.room);
  const std::string end = group.name.substr(space);
  return fit_text(group.name.substr(0, space), look.room - width(end)) + end;
}

struct GroupSwitch {
  const char* word;
  Icon icon;
  std::string item, tooltip;
  bool on;
};

bool draw_switch(PanelContext& context, const GroupSwitch& one, bool words) {
  if (!words) return icon_button(context, one.item, one.icon, {context.px(18), ImGui::GetTextLineHeight()}, one.tooltip, one.on);
  return lit_button(context, one.item, one.word, one.on, one.tooltip, true);
}

void draw_line(PanelContext& context, const GroupLine& line, bool fixed, const RowLook& look) {
  const GroupFacts& group = line.facts;
  const float side = 0.7F * ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float top = at.y + ImGui::GetStyle().FramePadding.y;
  if (line.colour) list.AddRectFilled({at.x, top}, {at.x + side, top + side}, colour(*line.colour), context.px(2));
  const float right = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + side + context.px(6));
  ImGui::TextUnformatted(context.shown(fit_name(group, look)).c_str());
  next_item_tooltip(context.shown(tooltip_of(group)));
  ImGui::SameLine();
  ImGui::SetCursorPosX(right - (look.words ? words_width(context) : icons_width(context)) + context.px(6));
  const GroupSwitch fix{"fix", fixed ? Icon::Lock : Icon::LockOff, "group-fix:" + group.name,
                        fixed ? "fixed: its vertices stay; click to release them" : "fix: its vertices keep their places", fixed};
  if (draw_switch(context, fix, look.words)) context.send((fixed ? "unfix " : "fix ") + quote_word(line.word));
  ImGui::SameLine(0, context.px(look.words ? 4 : 1));
  const bool alone = context.state.colouring.isolated == Isolation{ColourBy::Group, group.name};
  const GroupSwitch isolate{"isolate", Icon::Eye, "group-isolate:" + group.name,
                            alone ? "isolated; click to count all elements again" : "isolate: only its elements, or those around it, count",
                            alone};
  if (draw_switch(context, isolate, look.words)) context.send(alone ? "isolate off" : "isolate group " + quote_word(group.name));
}

}  // namespace

void draw_groups(PanelContext& context) {
  const std::vector<GroupLine>& groups = context.derived.groups;
  if (groups.empty() || context.run() == nullptr) return;
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Groups");
  constexpr std::size_t kMostShown = 40;  // a longer list in a panel helps nobody
  const std::size_t shown = std::min(groups.size(), kMostShown);
  const bool more = groups.size() > kMostShown;
  ImGui::BeginDisabled(context.activity.busy);
  const float swatch = 0.7F * ImGui::GetTextLineHeight() + context.px(6);
  const RowLook look = look_of(context, std::span(groups).first(shown), ImGui::GetContentRegionAvail().x - swatch);
  for (std::size_t g = 0; g < shown; ++g) {
    ImGui::PushID(static_cast<int>(g));
    draw_line(context, groups[g], g < context.derived.groups_fixed.size() && context.derived.groups_fixed[g], look);
    ImGui::PopID();
  }
  ImGui::EndDisabled();
  if (more) dim_text(context, fmt::format("and {} more: dmoscope info FILE lists all", count(groups.size() - kMostShown)));
}

}  // namespace dmoscope::ui
