// The worst elements, each with a button for the search of its worst corner.
#include <algorithm>

#include <fmt/format.h>

#include "core/mesh/geographic.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// Draws the right end of a row of the worst list, a button that leads to the search of its worst free corner, or says that there is none.
void draw_why(PanelContext& context, const Frame& frame, Index element, int row, ImVec2 at, float right) {
  const RunView* run = context.run();
  const auto corners = frame.input->mesh.elements.corners(element);
  const bool fixed = run != nullptr && run->fixed.size() == frame.vertex_count() &&
                     std::all_of(corners.begin(), corners.end(), [&](Index corner) { return run->fixed[corner] != 0; });
  const char* label = fixed ? "fixed" : "why?";
  const ImVec2 size = ImGui::CalcTextSize(label), back = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({right - size.x, at.y});
  if (ImGui::InvisibleButton("##why", size)) context.send(fmt::format("inspect element {}", element));
  if (!fixed && !context.items.boxes().contains("why?")) context.items.record_last("why?");
  note_item(context, fmt::format("why:{}", row),
            fixed ? "All its corners are fixed: no smoothing can change it. It is part of the ceiling."
                  : "inspects the search of its worst free corner: what limits it, and how much is left");
  ImGui::GetWindowDrawList()->AddText({right - size.x, at.y},
                                      colour(ImGui::IsItemHovered() ? context.palette.text
                                             : fixed                ? context.palette.dim
                                                                    : context.palette.accent),
                                      label);
  ImGui::SetCursorScreenPos(back);
}

std::string inside_words(Vec3 at) {
  return fmt::format("\ninverted only inside, where the diamond is: at ({:.8g}, {:.8g}, {:.8g})", at.x, at.y, at.z);
}

/// Greatest width of the qualities in the list; nearly always that of usual ones, so that nothing moves from step to step.
float widest_number(const Frame& frame) {
  float widest = ImGui::CalcTextSize("0.003610").x;
  for (const RankedElement& ranked : frame.worst) widest = std::max(widest, ImGui::CalcTextSize(short_number(ranked.quality).c_str()).x);
  return widest;
}

/// The text "element 1234", shortened to the room.
std::string id_text(Index element, float room) {
  std::string text = fmt::format("element {}", element);
  return ImGui::CalcTextSize(text.c_str()).x <= room ? text : fmt::to_string(element);
}

}  // namespace

void draw_worst(PanelContext& context) {
  const Frame* frame = context.frame();
  if (frame == nullptr || frame->worst.empty()) return;
  ImGui::Dummy({0, context.px(2)});
  heading(context, "Worst elements");
  ImGui::SameLine();
  dim_text(context, metric_phrase(frame->shown), false);
  const float number_width = widest_number(*frame);
  const float gap = context.px(7), why_width = std::max(ImGui::CalcTextSize("fixed").x, ImGui::CalcTextSize("why?").x);
  // Ranks stand before the ids if there is room for both.
  const float beside_id = number_width + context.px(4) + why_width + 3 * gap;
  const float ids = ImGui::CalcTextSize(count(frame->element_count()).c_str()).x, ranks = ImGui::CalcTextSize("000").x;
  const bool ranked_rows = ranks + context.px(10) + ids + beside_id <= ImGui::GetContentRegionAvail().x;
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(frame->worst.size()));
  while (clipper.Step()) {
    for (int k = clipper.DisplayStart; k < clipper.DisplayEnd; ++k) {
      const RankedElement& ranked = frame->worst[static_cast<std::size_t>(k)];
      ImGui::PushID(k);
      const ImVec2 at = ImGui::GetCursorScreenPos();
      const float width = ImGui::GetContentRegionAvail().x;
      const bool selected = context.state.picked == Picked{Picked::Kind::Element, ranked.element};
      if (ImGui::Selectable("##worst", selected, ImGuiSelectableFlags_AllowItemOverlap))
        context.send(fmt::format("goto element {}", ranked.element));
      const float number_left = at.x + width - number_width - context.px(4), why_left = number_left - why_width - 2 * gap;
      if (ImGui::IsItemVisible())  // only as far as a click reaches
        context.items.record(fmt::format("worst:{}", k), {at.x, ImGui::GetItemRectMin().y, why_left, ImGui::GetItemRectMax().y});
      next_item_tooltip(full_number(ranked.quality) + (ranked.inside ? inside_words(in_file(frame->input->mesh, *ranked.inside)) : "") +
                        "\nclick to go there");
      ImDrawList& list = *ImGui::GetWindowDrawList();
      const std::string rank = std::to_string(k + 1), number = short_number(ranked.quality);
      if (ranked_rows) list.AddText({at.x + ranks - ImGui::CalcTextSize(rank.c_str()).x, at.y}, colour(context.palette.dim), rank.c_str());
      const float id_left = ranked_rows ? at.x + ranks + context.px(10) : at.x;
      const float diamond = ranked.inside ? 0.8F * ImGui::GetTextLineHeight() : 0.0F;
      const std::string id = id_text(ranked.element, why_left - gap - diamond - id_left);
      list.AddText({id_left, at.y}, colour(context.palette.text), id.c_str());
      if (ranked.inside) {
        const ImVec2 middle{id_left + ImGui::CalcTextSize(id.c_str()).x + 0.6F * diamond, at.y + 0.5F * ImGui::GetTextLineHeight()};
        list.AddNgonFilled(middle, 0.45F * diamond, colour(context.palette.error), 4);
      }
      list.AddText({at.x + width - ImGui::CalcTextSize(number.c_str()).x - context.px(4), at.y},
                   colour(ranked.inverted ? context.palette.error : context.palette.text), number.c_str());
      draw_why(context, *frame, ranked.element, k, at, number_left - gap);
      ImGui::PopID();
    }
  }
}

}  // namespace dmoscope::ui
