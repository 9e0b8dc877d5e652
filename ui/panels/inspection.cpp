// Right, on top: the inspector of one vertex's visit.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "ui/analysis/derived.h"
#include "ui/analysis/inspection_text.h"
#include "ui/overlays/inspection_marks.h"
#include "ui/panels/field.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

void draw_title(PanelContext& context) {
  const InspectionState& state = context.state.inspection;
  const float button = ImGui::CalcTextSize("×").x + 2 * context.px(8);
  const std::string vertex = fmt::format("Vertex {}", state.vertex), whole = "Grid inspection · " + lower_case(vertex);
  ImGui::PushFont(context.fonts.bold);
  const bool room = ImGui::CalcTextSize(whole.c_str()).x + button + context.px(8) <= ImGui::GetContentRegionAvail().x;
  ImGui::PopFont();
  heading(context, state.vertex == kNoIndex ? "Grid inspection" : room ? whole.c_str() : vertex.c_str());
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - button);
  if (ImGui::SmallButton(" × ")) context.send("inspect off");
  note_item(context, "inspect:close", "close   G");
}

void draw_story(PanelContext& context, const Inspection& inspection) {
  const VisitSummary& trace = *inspection.visit();
  if (const std::string other = other_method_sentence(inspection); !other.empty()) wrapped_text(other);
  if (const std::string stuck = stuck_sentence(inspection); !stuck.empty()) wrapped_text(stuck);
  const auto row = [&context, &trace](const StarState& star, const char* when) {
    const bool inverted = !(star.jacobian > 0.0);
    number_row(context, fmt::format("{} {}", inverted ? "least Jacobian" : trace.worst_phrase(), when).c_str(), quality_of(star),
               inverted           ? "while an element of the star is inverted: the least corner Jacobian over its element's reference size"
               : trace.by_corners ? "the least quality among the corners of its star that the vertex changes; the search maximises it"
                                  : "the least quality of its star");
  };
  row(trace.before, "before");
  if (trace.end == VisitEnd::Moved) row(trace.after, "after");
  if (inspection.optimum) {
    number_row(context, "best possible", inspection.optimum->quality,
               "the exact maximum of the star's mean ratio over all places of this vertex; marked by a diamond");
    number_row(context, "gap", std::max(0.0, inspection.optimum->quality - quality_of(trace.after)), gap_sentence(inspection).c_str());
  }
  dim_text(context, fmt::format("{} · {}", metric_phrase(trace.metric), search_phrase(trace)));
  if ((inspection.solid || inspection.grid) && inspection.level_count() > 0) dim_text(context, grid_phrase(inspection));
  if (inspection.level_count() == 0) return;
  next_item_tooltip(fmt::format("The candidates were compared by their {}. The numbers shown are their qualities.", trace.value_phrase));
}

void draw_buttons(PanelContext& context) {
  const std::size_t levels = context.inspection.level_count();
  const InspectionState& state = context.state.inspection;
  action_button(context, "level-back", "‹ Back");
  ImGui::SameLine();
  const bool last = static_cast<std::size_t>(state.level) >= levels, foreign = !context.inspection.other_method.empty();
  ImGui::BeginDisabled(last && foreign);  // there is no such move to make
  action_button(context, "level-next",
                state.applied      ? (state.in_order ? "Next one" : "Again")
                : last && !foreign ? "Apply"
                                   : "Next level",
                true, widest_button({"Next one", "Next level", "Apply", "Again"}));
  ImGui::EndDisabled();
  const char* play = state.playing ? "❚❚" : "▶ Play";
  beside_or_below(play);
  action_button(context, "play-levels", play);
  beside_or_below("CSV");
  action_button(context, "copy-level", "CSV");
}

/// One level's candidates as cells in a square.
class LevelMap {
 public:
  LevelMap(PanelContext& context, const LevelValues& level, const GridSlice& slice, int number, ImVec2 low, float side)
      : context_(context),
        level_(level),
        slice_(slice),
        number_(number),
        low_(low),
        cell_(side / static_cast<float>(level.points)),
        side_(side) {}

  void draw() {
    render::ColourScale colours = colour_scale(context_.state, context_.derived);
    if (const auto range = valid_range(level_); context_.state.inspection.own_range && range && range->second > range->first)
      std::tie(colours.low, colours.high) = *range;
    const auto invalid = invalid_range(level_);
    for (int cell = 0; cell < level_.points * level_.points; ++cell) {
      const std::array<int, 2> place{cell / level_.points, cell % level_.points};
      const int candidate = slice_.index(place[0], place[1]);
      const double quality = level_.quality[static_cast<std::size_t>(candidate)];
      const bool refused = context_.inspection.refuses(number_, candidate);
      const auto [a, b] = box(place);
      list_.AddRectFilled(a, b, colour(context_.palette.raised));
      if (is_valid(quality)) list_.AddRectFilled(a, b, colour(colours.colour(quality), refused ? kRefused : 1.0F));
      // Inverted candidates are drawn the fainter, the less inverted they are: untangling goes by that.
      if (!is_valid(quality))
        list_.AddRectFilled(a, b, colour(kInvalidCandidate, 0.4F - 0.4F * static_cast<float>(part_of(invalid, quality))));
      if (!is_valid(quality) || refused) mark(a, b, !is_valid(quality));
    }
    if (level_.best) frame(*level_.best, true);
    if (context_.state.inspection.hovered) {
      const CandidateName hovered = *context_.state.inspection.hovered;
      if (hovered.level == number_ && hovered.index < static_cast<int>(level_.quality.size())) frame(hovered.index, false);
    }
  }
  /// Candidate under the mouse; -1: none.
  [[nodiscard]] int hovered() const {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const auto i = static_cast<int>(std::floor((mouse.x - low_.x) / cell_)),
               j = static_cast<int>(std::floor((low_.y + side_ - mouse.y) / cell_));
    return i >= 0 && j >= 0 && i < level_.points && j < level_.points ? slice_.index(i, j) : -1;
  }

 private:
  /// Box of a cell: the first axis runs to the right, the second up.
  [[nodiscard]] std::pair<ImVec2, ImVec2> box(std::array<int, 2> place) const {
    const auto i = static_cast<float>(place[0]), j = static_cast<float>(level_.points - 1 - place[1]);
    return {{low_.x + i * cell_, low_.y + j * cell_}, {low_.x + (i + 1) * cell_, low_.y + (j + 1) * cell_}};
  }
  /// Marks a candidate that inverts an element by a cross, one that is refused by a square.
  void mark(ImVec2 a, ImVec2 b, bool crossed) const {
    const float inset = 0.28F * cell_;
    if (cell_ < 4.0F) return;
    const ImVec2 low{a.x + inset, a.y + inset}, high{b.x - inset, b.y - inset};
    if (!crossed) return list_.AddRect(low, high, colour(context_.palette.text), 0.0F, 0, context_.px(1));
    list_.AddLine(low, high, colour(kInvalidCandidate), context_.px(1.3F));
    list_.AddLine({low.x, high.y}, {high.x, low.y}, colour(kInvalidCandidate), context_.px(1.3F));
  }
  void frame(int index, bool chosen) const {
    const auto place = slice_.place(index);
    if (!place) return;
    const auto [a, b] = box(*place);
    const float w = context_.px(chosen ? 2.0F : 1.4F);
    list_.AddRect({a.x - w, a.y - w}, {b.x + w, b.y + w}, colour({0x10, 0x12, 0x16}), 0.0F, 0, 2.2F * w);
    list_.AddRect({a.x - w / 2, a.y - w / 2}, {b.x + w / 2, b.y + w / 2}, colour({0xff, 0xff, 0xff}), 0.0F, 0, w);
  }

  static constexpr float kRefused = 0.35F;  // strength of the colour of a candidate that is refused
  PanelContext& context_;
  const LevelValues& level_;
  GridSlice slice_;
  int number_;
  ImVec2 low_;
  float cell_, side_;
  ImDrawList& list_ = *ImGui::GetWindowDrawList();
};

void draw_level(PanelContext& context, int number, float side) {
  InspectionState& state = context.state.inspection;
  const LevelValues& level = context.inspection.level(number);
  ImGui::BeginGroup();
  const bool shown = !state.applied && (state.all_levels || state.level == number);
  const std::string name = fmt::format("{}", number);
  std::string best = level.best ? short_number(level.quality[static_cast<std::size_t>(*level.best)]) : "none better";
  if (!level.best && ImGui::CalcTextSize((name + "  " + best).c_str()).x > side) best = "none";
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddText(shown ? context.fonts.bold : context.fonts.body, context.em(), at,
               colour(shown ? context.palette.text : context.palette.dim), name.c_str());
  list.AddText({at.x + side - ImGui::CalcTextSize(best.c_str()).x, at.y}, colour(shown ? context.palette.text : context.palette.dim),
               best.c_str());
  const ImVec2 low{at.x, at.y + 1.2F * context.em()};
  LevelMap map(context, level, shown_slice(state, context.inspection, number), number, low, side);
  map.draw();
  if (shown)
    list.AddLine({at.x, low.y + side + context.px(5)}, {at.x + side, low.y + side + context.px(5)}, colour(context.palette.accent),
                 context.px(2));
  if (ImGui::InvisibleButton(fmt::format("##level{}", number).c_str(), {side, 1.2F * context.em() + side + context.px(4)}))
    context.send(fmt::format("level {}", number));
  context.items.record_last(fmt::format("level:{}", number));
  if (ImGui::IsItemHovered()) {
    if (const int index = map.hovered(); index >= 0) {
      state.hovered = CandidateName{number, index};
      next_item_tooltip(candidate_text(context.inspection, number, index));
    }
  }
  ImGui::EndGroup();
}

/// Draws the maps side by side, as many in a row as can be read.
void draw_levels(PanelContext& context) {
  const auto levels = static_cast<int>(context.inspection.level_count());
  const float gap = context.px(8), room = ImGui::GetContentRegionAvail().x;
  const int most = std::max(1, static_cast<int>((room + gap) / (4.1F * context.em() + gap)));
  const int rows = (levels + most - 1) / most, in_row = (levels + rows - 1) / rows;
  const float side = std::floor(std::min((room - gap * static_cast<float>(in_row - 1)) / static_cast<float>(in_row), 9.0F * context.em()));
  for (int number = 1; number <= levels; ++number) {
    if (number > 1 && (number - 1) % in_row != 0) ImGui::SameLine(0, gap);
    draw_level(context, number, side);
  }
}

/// Draws the choice of the slice of a volume's grids that the maps show.
void draw_slice(PanelContext& context) {
  const InspectionState& state = context.state.inspection;
  const int level = std::clamp(state.level, 1, static_cast<int>(context.inspection.level_count()));
  const GridSlice slice = shown_slice(state, context.inspection, level);
  for (const int axis : {0, 1, 2}) {
    const char name[2] = {"xyz"[axis], 0};
    if (axis > 0) ImGui::SameLine(0, context.px(2));
    ImGui::PushStyleColor(ImGuiCol_Text, colour(axis == state.slice_axis ? context.palette.text : context.palette.dim));
    if (ImGui::Button(name)) context.send(fmt::format("grid-slice {}", name));
    ImGui::PopStyleColor();
    note_item(context, fmt::format("slice:{}", name), fmt::format("slices at right angles to the {} axis", name));
  }
  ImGui::SameLine(0, context.px(8));
  const float button = ImGui::CalcTextSize("best").x + 2 * context.px(8);
  ImGui::SetNextItemWidth(std::max(4 * context.em(), ImGui::GetContentRegionAvail().x - button - context.px(8)));
  int number = slice.number + 1;
  if (ImGui::SliderInt("##slice", &number, 1, slice.points, slice_phrase(slice).c_str(), ImGuiSliderFlags_AlwaysClamp) &&
      number != slice.number + 1)
    context.send(fmt::format("grid-slice {}", number));
  context.items.record_last("slice");
  ImGui::SameLine(0, context.px(8));
  ImGui::BeginDisabled(!state.slice);
  if (ImGui::Button("best")) context.send("grid-slice best");
  ImGui::EndDisabled();
  note_item(context, "slice:best", "for each level the slice with the chosen candidate");
}

/// Draws two bars, one over the other: before and after.
void draw_bars(const PanelContext& context, ImVec2 low, float width, const ElementChange& change, bool moved) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight(), height = moved ? 0.26F * line : 0.45F * line;
  const auto bar = [&](float top, double quality, bool inverted, render::Rgb ink) {
    const auto part = static_cast<float>(std::clamp(std::isfinite(quality) ? quality : 0.0, 0.0, 1.0));
    list.AddRectFilled({low.x, top}, {low.x + width, top + height}, colour(context.palette.raised));
    if (inverted) ink = render::kInvertedColour;
    list.AddRectFilled({low.x, top}, {low.x + std::max(part * width, inverted ? context.px(3) : 0.0F), top + height}, colour(ink));
  };
  bar(low.y + 0.2F * line, change.before, change.inverted_before, context.palette.dim);
  if (moved) bar(low.y + 0.56F * line, change.after, change.inverted_after, context.palette.accent);
}

void draw_elements(PanelContext& context, const VisitSummary& trace) {
  const bool moved = trace.end == VisitEnd::Moved;
  dim_text(context, moved ? "its elements, before → after" : "its elements", false);
  next_item_tooltip("▸ has the least quality before the visit, ▹ after it; click selects an element");
  const Index limit_before = limiting_element(trace, false), limit_after = limiting_element(trace, true);
  const auto numbers_of = [moved](const ElementChange& change) {
    return moved ? fmt::format("{} → {}", short_number(change.before), short_number(change.after)) : short_number(change.before);
  };
  float id_width = 0, number_width = 0;
  for (const ElementChange& change : trace.elements) {
    id_width = std::max(id_width, ImGui::CalcTextSize(fmt::to_string(change.element).c_str()).x);
    number_width = std::max(number_width, ImGui::CalcTextSize(numbers_of(change).c_str()).x);
  }
  for (const ElementChange& change : trace.elements) {
    ImGui::PushID(static_cast<int>(change.element));
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, gutter = 1.5F * context.em();
    const bool selected = context.state.picked == Picked{Picked::Kind::Element, change.element};
    if (ImGui::Selectable("##change", selected)) context.send(fmt::format("pick element {}", change.element));
    context.items.record_last(fmt::format("change:{}", change.element));
    next_item_tooltip(fmt::format("element {}\nbefore {}{}\nafter {}{}", change.element, full_number(change.before),
                                  change.inverted_before ? ", inverted" : "", full_number(change.after),
                                  change.inverted_after ? ", inverted" : ""));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    std::string marks;
    if (change.element == limit_before) marks += "▸";
    if (moved && change.element == limit_after) marks += "▹";
    list.AddText(at, colour(context.palette.text), marks.c_str());
    const std::string id = fmt::to_string(change.element);
    list.AddText({at.x + gutter + id_width - ImGui::CalcTextSize(id.c_str()).x, at.y}, colour(context.palette.text), id.c_str());
    const std::string numbers = numbers_of(change);
    list.AddText({at.x + width - ImGui::CalcTextSize(numbers.c_str()).x, at.y},
                 colour(change.inverted_after ? context.palette.error : context.palette.text), numbers.c_str());
    const float left = at.x + gutter + id_width + context.px(8), right = at.x + width - number_width - context.px(8);
    if (right > left + context.em()) draw_bars(context, {left, at.y}, right - left, change, moved);
    ImGui::PopID();
  }
}

/// Draws the candidates of the shown level that lie in the slice.
void draw_slice_candidates(const PanelContext& context, const Inspection& inspection, const ToWindow& at) {
  const InspectionState& state = context.state.inspection;
  if (state.applied || state.level < 1 || inspection.level_count() == 0) return;
  const VolumeLevel& level = inspection.solid->levels[static_cast<std::size_t>(state.level - 1)];
  const GridSlice slice = shown_slice(state, inspection, state.level);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  for (int column = 0; column < level.points; ++column)
    for (int row = 0; row < level.points; ++row) {
      const int index = slice.index(column, row);
      const ImVec2 place = at(inspection.field_slice.project(level.at(index)));
      const bool valid = is_valid(level.quality[static_cast<std::size_t>(index)]), best = level.best == index;
      list.AddCircleFilled(place, context.px(best ? 3.4F : 1.8F), colour({0x10, 0x12, 0x16}));
      list.AddCircleFilled(place, context.px(best ? 2.2F : 1.0F), valid ? colour({0xff, 0xff, 0xff}) : colour(kInvalidCandidate));
    }
}

/// Draws the star, grids, and the places before, after and best, over the heat map.
void draw_field_marks(const PanelContext& context, const Inspection& inspection, const ToWindow& at) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const VisitSummary& trace = *inspection.visit();
  const ImU32 light = colour({0xff, 0xff, 0xff}), dark = colour({0x10, 0x12, 0x16});
  const auto edge = [&](Vec2<double> a, Vec2<double> b, float strength) {
    list.AddLine(at(a), at(b), colour({0xff, 0xff, 0xff}, 0.25F * strength), context.px(2.4F));
    list.AddLine(at(a), at(b), colour({0x10, 0x12, 0x16}, 0.55F * strength), context.px(1));
  };
  const auto rectangle = [&](Vec2<double> low, Vec2<double> high) {
    const ImVec2 a = at(low), b = at(high);
    list.AddRect({a.x, b.y}, {b.x, a.y}, dark, 0.0F, 0, context.px(2.6F));
    list.AddRect({a.x, b.y}, {b.x, a.y}, light, 0.0F, 0, context.px(1.2F));
  };
  Vec2<double> step;
  if (inspection.trace) {
    for (const auto& [a, b] : inspection.edges) edge({a.x, a.y}, {b.x, b.y}, 1.0F);
    for (const TracedLevel& level : inspection.trace->levels) {
      const Vec2<double> half{level.size.x / 2, level.size.y / 2};
      rectangle(level.centre - half, level.centre + half);
    }
    step = inspection.trace->step;
  } else {  // projections into the plane of the slice
    const StarSlice& plane = inspection.field_slice;
    for (const auto& [a, b] : inspection.edges) edge(plane.project(a), plane.project(b), 0.5F);
    for (const VolumeLevel& level : inspection.solid->levels)
      rectangle(plane.project(level.centre - 0.5 * level.size), plane.project(level.centre + 0.5 * level.size));
    step = plane.project(inspection.solid->step);
    draw_slice_candidates(context, inspection, at);
  }
  const ImVec2 from = at({}), to = at(step);
  list.AddCircle(from, context.px(4), dark, 0, context.px(3.4F));
  list.AddCircle(from, context.px(4), light, 0, context.px(1.6F));
  if (inspection.optimum) {
    const ImVec2 best = at(inspection.optimum->at);
    for (const bool casing : {true, false}) {
      const float r = context.px(casing ? 7.0F : 5.4F);
      list.AddQuadFilled({best.x - r, best.y}, {best.x, best.y - r}, {best.x + r, best.y}, {best.x, best.y + r},
                         casing ? dark : colour(context.palette.accent));
    }
  }
  if (trace.end == VisitEnd::Moved) {
    list.AddCircleFilled(to, context.px(4.2F), dark);
    list.AddCircleFilled(to, context.px(2.8F), light);
  }
}

void draw_field_panel(PanelContext& context, const Inspection& inspection) {
  const FieldPicture& picture = *inspection.field;
  const QualityField& field = picture.field;
  const bool nowhere = !(picture.highest >= picture.lowest);
  dim_text(context,
           nowhere
               ? std::string(inspection.solid ? "an element is inverted in the whole slice" : "an element is inverted for every place")
               : fmt::format("{} around the vertex{}", metric_phrase(inspection.visit()->metric), inspection.solid ? ", in the slice" : ""),
           false);
  const double aspect = (field.high.y - field.low.y) / (field.high.x - field.low.x);
  const float room = ImGui::GetContentRegionAvail().x;
  float w = room, h = static_cast<float>(aspect) * w;
  if (h > 1.15F * room) {
    h = 1.15F * room;
    w = h / static_cast<float>(aspect);
  }
  const ImVec2 cursor = ImGui::GetCursorScreenPos(), low{std::round(cursor.x + (room - w) / 2), cursor.y};
  ImGui::InvisibleButton("##field", {room, h});
  context.items.record_last("field");
  if (!ImGui::IsItemVisible()) return;
  const ToWindow at = [&](Vec2<double> p) {
    return ImVec2{low.x + static_cast<float>((p.x - field.low.x) / (field.high.x - field.low.x)) * w,
                  low.y + static_cast<float>((field.high.y - p.y) / (field.high.y - field.low.y)) * h};
  };
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.PushClipRect(low, {low.x + w, low.y + h}, true);
  draw_field(list, picture, {colour_scale(context.state, context.derived), context.palette, context.em(), context.px(1)}, at);
  draw_field_marks(context, inspection, at);
  list.PopClipRect();
  if (!ImGui::IsItemHovered()) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const Vec2<double> point{field.low.x + static_cast<double>((mouse.x - low.x) / w) * (field.high.x - field.low.x),
                           field.high.y - static_cast<double>((mouse.y - low.y) / h) * (field.high.y - field.low.y)};
  const auto value = field_at(field, point);
  if (!value) return;
  next_item_tooltip(fmt::format("{}\noffset {}, {}",
                                value->second > 0.0 ? fmt::format("quality {}", short_number(value->first)) : "an element is inverted",
                                short_number(point.x), short_number(point.y)));
}

}  // namespace

void draw_inspection(PanelContext& context) {
  draw_title(context);
  const InspectionState& state = context.state.inspection;
  const Inspection& inspection = context.inspection;
  if (state.vertex == kNoIndex) {
    wrapped_text(state.note.empty() ? "Click a vertex to inspect its search; L inspects the one that the run visits next." : state.note);
  } else if (inspection.visit() == nullptr) {
    wrapped_text(inspection.trouble);
  } else {
    // The text may take more lines with the next level, so the buttons stand above it.
    if (inspection.level_count() > 0) draw_buttons(context);
    draw_story(context, inspection);
    if (inspection.level_count() > 0) {
      draw_levels(context);
      if (inspection.solid) draw_slice(context);
    }
    draw_elements(context, *inspection.visit());
    if (state.field && inspection.field) draw_field_panel(context, inspection);
  }
  ImGui::Dummy({0, context.px(2)});
  ImGui::Separator();
  ImGui::Dummy({0, context.px(2)});
}

}  // namespace dmoscope::ui
