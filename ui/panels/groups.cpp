// Groups of the mesh; and boundary loops, which need no names in the file: each can be selected, fixed, or let slide while the rest of
// the boundary stays.
#include <algorithm>
#include <array>
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
  std::string_view icon;
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
  const GroupSwitch fix{"fix", fixed ? Icon::kLock : Icon::kLockOff, "group-fix:" + group.name,
                        fixed ? "fixed; click to free its vertices again" : "fix: its vertices keep their places", fixed};
  if (draw_switch(context, fix, look.words)) context.send((fixed ? "unfix " : "fix ") + quote_word(line.word));
  ImGui::SameLine(0, context.px(look.words ? 4 : 1));
  const bool alone = context.state.colouring.isolated == Isolation{ColourBy::Group, group.name};
  const GroupSwitch isolate{"isolate", Icon::kEye, "group-isolate:" + group.name,
                            alone ? "isolated; click to count all elements again" : "isolate: only its elements, or those around it, count",
                            alone};
  if (draw_switch(context, isolate, look.words)) context.send(alone ? "isolate off" : "isolate group " + quote_word(group.name));
}

constexpr Index kMostShown = 40;  // a longer list in a panel helps nobody

void draw_loop(PanelContext& context, const Outline& outline, Index number) {
  const BoundaryLoop& loop = outline.loops[number];
  const std::string word = fmt::format("loop:{}", number + 1);
  const std::array<SideButton, 3> buttons{
      {{"select", fmt::format("loop-select:{}", number + 1), "selects its vertices", "select vertex " + word},
       {"fix", fmt::format("loop-fix:{}", number + 1), "fix: its vertices keep their places, even where the boundary slides",
        "fix " + word},
       {"slide", fmt::format("loop-slide:{}", number + 1), "its vertices slide along it; the rest of the boundary is fixed",
        "slide " + word}}};
  const float y = ImGui::GetCursorPosY();
  const std::string name = outline.name(number);
  const std::string counted_name = fmt::format("{}  {}", name, count(loop.vertices.size()));
  const float room = ImGui::GetContentRegionAvail().x - width_of(context, buttons) - context.px(4);
  ImGui::TextUnformatted(ImGui::CalcTextSize(counted_name.c_str()).x <= room ? counted_name.c_str() : fit_text(name, room).c_str());
  next_item_tooltip(fmt::format("{}: {}\nlength {}\nencloses {}{}", name, counted(loop.vertices.size(), "vertex", "vertices"),
                                short_number(loop.length), short_number(loop.area),
                                outline.parts.size() > 1 ? fmt::format("\nof part {}", loop.part + 1) : ""));
  side_buttons(context, y, "", buttons);
}

}  // namespace

void draw_groups(PanelContext& context) {
  const std::vector<GroupLine>& groups = context.derived.groups;
  if (groups.empty() || context.run() == nullptr) return;
  ImGui::Dummy({0, context.px(4)});
  heading(context, "Groups");
  const std::size_t shown = std::min<std::size_t>(groups.size(), kMostShown);
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

void draw_loops(PanelContext& context) {
  const Frame* frame = context.frame();
  if (frame == nullptr || context.run() == nullptr || frame->input->is_volume()) return;
  const Index known = frame->input->report.boundary_loops;  // known without half-edges
  const bool open = context.state.panels.loops;
  if (fold_row(context, "loops", "Boundary loops", known == 0 ? "none" : count(known), open,
               "closed curves of the boundary: their lengths, and buttons to select, to fix and to let slide"))
    context.send(open ? "unfold-loops off" : "unfold-loops on");
  if (!open || known == 0) return;
  const Outline* outline = context.widgets.outline.of(frame->input);
  if (outline == nullptr) return dim_text(context, "searching …");
  ImGui::BeginDisabled(context.activity.busy);
  const auto all = static_cast<Index>(outline->loops.size());
  for (Index number = 0; number < std::min(all, kMostShown); ++number) {
    ImGui::PushID(static_cast<int>(number));
    draw_loop(context, *outline, number);
    ImGui::PopID();
  }
  ImGui::EndDisabled();
  if (all > kMostShown) dim_text(context, fmt::format("and {} more: dmoscope info FILE lists all", count(all - kMostShown)));
}

void draw_loop_place(PanelContext& context, const Frame& frame, Index vertex) {
  if (frame.input->is_volume() || frame.input->topology.boundary()[vertex] == 0) return;
  const Outline* outline = context.widgets.outline.of(frame.input);
  if (outline == nullptr) return dim_text(context, "searching for its boundary loop …");
  const auto place = outline->find(vertex);
  if (!place) return;
  const std::vector<Index>& around = outline->loops[place->loop].vertices;
  const auto size = static_cast<Index>(around.size());
  const auto neighbour = [&](Index step) { return fmt::format("pick vertex {}", around[(place->at + step) % size]); };
  const float y = ImGui::GetCursorPosY();
  dim_text(context, fmt::format("{}, {} of {}", outline->name(place->loop), count(place->at + 1), count(size)), false);
  side_buttons(
      context, y, "",
      std::array<SideButton, 2>{{{"<", "loop-back", "the vertex before it along the boundary", neighbour(size - 1)},
                                 {">", "loop-next", "the next vertex along the boundary, with the mesh to the left", neighbour(1)}}});
}

}  // namespace dmoscope::ui
