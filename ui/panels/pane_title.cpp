// Title and frame of a viewport, and the menu that chooses its content.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "ui/panels/icons.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

struct TitleLayout {
  std::vector<TitlePiece> pieces;
  Rect plate;
  bool swatch = true;
};

/// Number of the active viewport's buttons, and their side in pixels. Those with the least use go first where room is short.
struct ViewportTools {
  int count = 0;
  float side = 0;
  static constexpr std::array<std::pair<const char*, std::string_view>, 6> kAll{{{"fit", Icon::kFit},
                                                                                 {"wireframe", Icon::kWires},
                                                                                 {"worst-marker", Icon::kRing},
                                                                                 {"shading", Icon::kSun},
                                                                                 {"inside-clip", Icon::kClip},
                                                                                 {"inside-worst", Icon::kCell}}};
  ViewportTools(const PanelContext& context, const PaneFacts& pane) : side(ImGui::GetFrameHeight()) {
    const float room = pane.uncovered.w - 16 * context.em();
    if (pane.focus && pane.frame() != nullptr) count = std::clamp(static_cast<int>(room / side), 0, pane.in_space() ? 6 : 3);
  }
  [[nodiscard]] float width() const { return static_cast<float>(count) * side; }
};

bool is_bold(const TitlePiece& piece) { return piece.role == TitlePiece::Role::Name || piece.role == TitlePiece::Role::Bad; }

render::Rgb ink_of(const PanelContext& context, const TitlePiece& piece) {
  using Role = TitlePiece::Role;
  const Palette& colours = context.palette;
  return piece.role == Role::Dim       ? colours.dim
         : piece.role == Role::Bad     ? colours.error
         : piece.role == Role::Warning ? colours.warning
                                       : colours.text;
}

float width_of(const PanelContext& context, const TitlePiece& piece) {
  const ImFont* font = is_bold(piece) ? context.fonts.bold : context.fonts.body;
  return font->CalcTextSizeA(context.em(), FLT_MAX, 0.0F, piece.text.c_str()).x;
}

/// Gap between a piece and the one before it.
float gap_before(const PanelContext& context, const TitlePiece& piece) { return context.px(piece.text.starts_with("· ") ? 5 : 9); }

TitleLayout lay_out(const PanelContext& context, const PaneFacts& pane) {
  TitleLayout layout;
  layout.pieces = title_of(pane, context.session.shown);
  if (context.state.panes.one())  // the facts show its numbers
    std::erase_if(layout.pieces, [](const TitlePiece& piece) { return piece.role == TitlePiece::Role::Dim; });
  layout.swatch = pane.of_run && pane.run() != nullptr && !pane.removed;
  const float pad = context.px(8), line = ImGui::GetTextLineHeight();
  const float room = title_room(context, pane);
  const auto width = [&] {
    float sum = 2 * pad + (layout.swatch ? context.px(14) : 0.0F);
    for (const TitlePiece& piece : layout.pieces)
      sum += width_of(context, piece) + (&piece == &layout.pieces.front() ? 0.0F : gap_before(context, piece));
    return sum;
  };
  while (layout.pieces.size() > 1 && width() > room) {
    const auto worst = std::ranges::max_element(layout.pieces, {}, &TitlePiece::rank);
    if (worst->rank == 0) break;
    layout.pieces.erase(worst);
  }
  // The remaining pieces must all be there. The longest is shortened: at its end if the run's number leads it, else in its middle, because
  // names that begin alike end differently.
  const auto longest = std::ranges::max_element(layout.pieces, {}, [&](const TitlePiece& piece) { return width_of(context, piece); });
  if (longest != layout.pieces.end()) {
    const std::string whole = longest->text;
    const bool numbered = layout.swatch && pane.session->runs.size() > 1 && whole.find(' ') < 4;
    if (numbered && width() > room) longest->text = fit_text(whole, 0.88F * (room - width() + width_of(context, *longest)));
    for (std::size_t letters = whole.size(); width() > room && letters > 4;) longest->text = without_middle(whole, --letters);
  }
  layout.plate = {pane.uncovered.x + pad, pane.clip.y + pad, std::min(room, width()), line + pad};
  return layout;
}

void draw_frame_of(const PanelContext& context, const PaneFacts& pane) {
  const Rect& clip = pane.clip;
  const float width = context.px(pane.focus ? 2 : 1), half = width / 2;
  ImGui::GetWindowDrawList()->AddRect({clip.x + half, clip.y + half}, {clip.x + clip.w - half, clip.y + clip.h - half},
                                      colour(pane.focus ? context.palette.accent : context.palette.line), 0.0F, 0, width);
}

/// Run that a click on the title makes the active one; 0: none, or it is already.
std::size_t run_to_select(const PanelContext& context, const PaneFacts& pane) {
  const PaneContent& content = context.state.panes.panes[pane.number].content;
  const auto& ids = context.state.panes.run_ids;
  const auto at = std::ranges::find(ids, content.run);
  if (content.kind != PaneContent::Kind::Run || at == ids.end() || content.run == context.state.panes.active_id) return 0;
  return static_cast<std::size_t>(at - ids.begin()) + 1;
}

}  // namespace

float title_room(const PanelContext& context, const PaneFacts& pane) {
  const float pad = context.px(8), tools = ViewportTools(context, pane).width();
  return pane.uncovered.w - 2 * pad - (tools > 0 ? tools + pad : 0.0F);
}

void handle_pane_title(PanelContext& context, const PaneFacts& pane) {
  const Rect plate = lay_out(context, pane).plate;
  if (plate.w <= 0) return;
  ImGui::SetCursorScreenPos({plate.x, plate.y});
  const bool clicked = ImGui::InvisibleButton("title", {plate.w, plate.h});
  context.items.record_last(fmt::format("pane-title:{}", pane.number + 1));
  const std::size_t run = run_to_select(context, pane);
  if (run > 0) {
    next_item_tooltip(fmt::format("{}\nclick: make this the active run (Tab: the next one)", run_title(context.session, run - 1)));
  } else if (pane.run() != nullptr && pane.frame() != nullptr) {
    next_item_tooltip(pane.name == "input" ? "the mesh as it was read" : run_title(*pane.session, pane.session->active));
  }
  if (!clicked) return;
  if (!pane.focus) context.send(fmt::format("focus-pane {}", pane.number + 1));
  if (run > 0) context.send(fmt::format("select-run {}", run));
}

void draw_viewport_tools(PanelContext& context, const PaneFacts& pane) {
  const ViewportTools tools(context, pane);
  if (tools.count == 0) return;
  const float pad = context.px(8);
  const ImVec2 low{std::round(pane.uncovered.x + pane.uncovered.w - pad - tools.width()), pane.clip.y + pad};
  draw_plate(context, low, {low.x + tools.width(), low.y + tools.side});
  for (int k = 0; k < tools.count; ++k) {
    const auto& [id, icon] = ViewportTools::kAll[static_cast<std::size_t>(k)];
    ImGui::SetCursorScreenPos({low.x + static_cast<float>(k) * tools.side, low.y});
    action_icon(context, id, icon, {tools.side, tools.side});
  }
}

Rect draw_pane_title(PanelContext& context, const PaneFacts& pane) {
  const TitleLayout layout = lay_out(context, pane);
  const Rect& plate = layout.plate;
  if (pane.frame() == nullptr) {
    draw_centred(context, pane.clip, pane.why_not, -1.1F);
    draw_centred(context, pane.clip, "right click: choose what this viewport shows", 0.1F);
  }
  if (!context.state.panes.one()) draw_frame_of(context, pane);
  if (layout.pieces.empty() || plate.w <= 0) return plate;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float pad = context.px(8), line = ImGui::GetTextLineHeight();
  draw_plate(context, {plate.x, plate.y}, {plate.x + plate.w, plate.y + plate.h});
  float x = plate.x + pad;
  const float y = plate.y + pad / 2;
  if (layout.swatch) {
    const std::size_t run = pane.session->active;
    list.AddRectFilled({x, y + 0.2F * line}, {x + context.px(8), y + 0.8F * line}, colour(context.palette.run(run)), context.px(2));
    x += context.px(14);
  }
  ImGui::PushClipRect({plate.x, plate.y}, {plate.x + plate.w - pad / 2, plate.y + plate.h}, true);
  for (const TitlePiece& piece : layout.pieces) {
    if (&piece != &layout.pieces.front()) x += gap_before(context, piece);
    list.AddText(is_bold(piece) ? context.fonts.bold : context.fonts.body, context.em(), {x, y}, colour(ink_of(context, piece)),
                 piece.text.c_str());
    x += width_of(context, piece);
  }
  ImGui::PopClipRect();
  return plate;
}

void draw_pane_entries(PanelContext& context, const PaneFacts& pane) {
  if (!ImGui::BeginMenu("Show here")) return;
  const Panes& panes = context.state.panes;
  const Pane& now = panes.panes[pane.number];
  const auto entry = [&](const std::string& title, const PaneContent& content, bool possible) {
    const bool chosen = content.kind == PaneContent::Kind::Free ? !now.chosen : now.content == content;
    if (ImGui::MenuItem(title.c_str(), nullptr, chosen, possible))
      context.send(fmt::format("pane {} {}", pane.number + 1, panes.words(content)));
    context.items.record_last(fmt::format("show-here:{}", panes.words(content)));
  };
  using Kind = PaneContent::Kind;
  entry("Automatic: a run that is not shown elsewhere", {}, true);
  entry("The active run", {Kind::Active, 0, std::nullopt}, true);
  for (std::size_t k = 0; k < context.session.runs.size(); ++k) {
    const RunView& run = context.session.runs[k];
    entry(run_title(context.session, k), {Kind::Run, run.id, std::nullopt}, true);
  }
  if (pane.frame() != nullptr && pane.frame()->run != Frame::kNoRun && pane.name.empty()) {
    const PaneContent pinned{Kind::Run, pane.run()->id, pane.frame()->moment.iteration};
    entry(fmt::format("Stay at iteration {} of this run", count(*pinned.iteration)), pinned, true);
  }
  entry("The input", {Kind::Input, 0, std::nullopt}, true);
  entry("Mark A", {Kind::MarkA, 0, std::nullopt}, context.state.timeline.a.frame != nullptr);
  entry("Mark B", {Kind::MarkB, 0, std::nullopt}, context.state.timeline.b.frame != nullptr);
  ImGui::EndMenu();
}

}  // namespace dmoscope::ui
