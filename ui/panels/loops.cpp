// Boundary loops, which need no names in the file: each can be selected, fixed, or let slide while the rest of the boundary stays.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr Index kMostShown = 40;  // a longer list in a panel helps nobody

void draw_loop(PanelContext& context, const Outline& outline, Index number) {
  const BoundaryLoop& loop = outline.loops[number];
  const std::string word = fmt::format("loop:{}", number + 1);
  const std::array<SideButton, 3> buttons{
      {{"select", fmt::format("loop-select:{}", number + 1), "selects its vertices", "select vertex " + word},
       {"fix", fmt::format("loop-fix:{}", number + 1), "its vertices keep their places, even where the boundary slides", "fix " + word},
       {"slide", fmt::format("loop-slide:{}", number + 1), "lets its vertices slide along it; the rest of the boundary stays",
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
