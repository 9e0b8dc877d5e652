// Facts of the mesh, and of the picked vertex or element.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/mesh/geographic.h"
#include "core/mesh/orientation.h"
#include "core/mesh/outline.h"
#include "core/quality/quality.h"
#include "core/reference/domain.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

std::string kinds_sentence(const Derived& derived) {
  std::string text;
  for (std::size_t kind = 0; kind < kElementKindCount; ++kind) {
    if (derived.kinds[kind] == 0) continue;
    const ElementKindInfo& one = info(static_cast<ElementKind>(kind));
    if (!text.empty()) text += ", ";
    text += counted(derived.kinds[kind], std::string(one.name).c_str(), std::string(one.plural).c_str());
  }
  return text;
}

/// A title without the remark that ADCIRC's files put behind it: "bahama_g02      ! a grid's name".
std::string first_words(const std::string& title) {
  std::string words = title.substr(0, std::min(title.find('\n'), title.find(" !")));
  words.erase(words.find_last_not_of(" \t\r") + 1);
  return words.empty() ? title : words;
}

void draw_mesh(PanelContext& context, const Frame& frame) {
  const Mesh& mesh = frame.input->mesh;
  heading(context, "Mesh");
  wrapped_text(context.shown(mesh.name));
  if (!frame.input->path.empty()) next_item_tooltip(context.shown(frame.input->path.string()));
  if (!mesh.title.empty() && mesh.title != mesh.name) {
    dim_text(context, fit_text(context.shown(first_words(mesh.title)), ImGui::GetContentRegionAvail().x), false);
    next_item_tooltip(context.shown(mesh.title));
  }
  dim_text(context, kinds_sentence(context.derived));
  if (const auto& surface = frame.input->surface) {
    dim_text(context, "slides on " + context.shown(surface->mesh.name));
    if (!surface->path.empty()) next_item_tooltip(context.shown(surface->path.string()));
  }
  value_row(context, "vertices", count(mesh.vertex_count()));
  if (frame.input->is_volume()) {
    value_row(context, "faces", count(frame.input->faces.face_count()));
    value_row(context, "on the boundary", count(frame.input->faces.boundary().size()), {}, {}, "faces that belong to one element only");
  }
  if (const RunView* run = context.run()) value_row(context, "of these free to move", count(run->free_vertices));
  const std::vector<std::string>& facts = context.derived.mesh_facts;
  if (!facts.empty()) dim_text(context, "Found in the input:");
  for (const std::string& fact : facts) wrapped_text(context.shown(fact), context.palette.warning);
  const RunView* active = context.run();
  if (active != nullptr && active->parameters.standing().layers == LayerRule::Keep) {
    const std::string layers = frame.input->layers_sentence("layers: free");
    if (!layers.empty()) dim_text(context, layers);
  }
  const bool fixed = active != nullptr && active->parameters.interfaces != InterfaceRule::Free;
  const std::string& interfaces = fixed ? context.derived.interfaces : context.derived.free_interfaces;
  if (!interfaces.empty()) dim_text(context, interfaces);
}

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr Statistics kNotKnownYet{kUnknown, kUnknown, kUnknown, kUnknown};

void empty_lines(const PanelContext& context, int count) {
  for (int i = 0; i < count; ++i) dim_text(context, " ", false);
}

/// Words for a command's effect: "Let the boundary slide".
std::string words_of(const std::string& command) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kWords{{{"boundary slide", "Let the boundary slide"},
                                                                                 {"interfaces slide", "Let interfaces slide"},
                                                                                 {"then joint", "Move several vertices at once"},
                                                                                 {"then mean", "Raise the mean"},
                                                                                 {"layers free", "Let boundary layers go"},
                                                                                 {"max-deviation ", "Let the boundary deviate more: "},
                                                                                 {"corner-angle ", "Corners only from a turn of "},
                                                                                 {"feature-angle ", "Features only from a fold of "},
                                                                                 {"unfix ", "Free vertices fixed by hand: "}}};
  for (const auto& [begins, words] : kWords)
    if (command.starts_with(begins)) return std::string(words) + command.substr(begins.size());
  return command;
}

/// Draws a switch that would free the worst element. Its gain stands beside it once it was tried, and below it what it gives up.
void draw_switch(PanelContext& context, const RunView& run, const HeldMinimum& held) {
  std::string tried = held.trial ? "tried: " + held.trial->figures() : " ";
  tried = with_arrows(tried.substr(0, tried.find(" in ")));
  const float room = ImGui::GetContentRegionAvail().x;
  ImGui::BeginDisabled(context.activity.busy || !run.held.now);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 0});
  std::string words;
  for (const std::string& command : held.commands()) words += (words.empty() ? "" : ", ") + words_of(command);
  const std::string label = fit_text(words, room - 2 * ImGui::GetStyle().FramePadding.x);
  if (ImGui::Button(label.c_str(), {room, 0}))
    for (const std::string& line : held.advice()) context.send(line);
  ImGui::PopStyleVar();
  ImGui::EndDisabled();
  note_item(context, "held-by:switch",
            fmt::format("{}\nClick ({}): goes on with it from the best state that this run reached, until converged; this run is kept.",
                        held.sentence(), fmt::join(held.commands(), ", ")));
  const std::string given_up = held.gives_up();
  dim_text(context, tried, false);
  next_item_tooltip(held.sentence());
  dim_text(context, given_up.empty() ? " " : "gives up " + given_up);
  next_item_tooltip(held.sentence());
}

/// Draws what keeps the minimum from rising and what would let it rise, always in four lines, so that nothing below moves.
void draw_hold(PanelContext& context, const RunView& run) {
  constexpr const char* kAbout = "what keeps the worst element as it is";
  constexpr const char* kLabel = "What holds it";
  const HeldMinimum* held = run.held.found.get();
  const ImVec2 row = ImGui::GetCursorScreenPos();
  context.items.record("held-by", {row.x, row.y, row.x + ImGui::GetContentRegionAvail().x, row.y + ImGui::GetTextLineHeight()});
  if (held == nullptr) {
    dim_text(context, kLabel, false);
    next_item_tooltip(kAbout);
    constexpr const char* kAsk = "find out";
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(kAsk).x - 2 * ImGui::GetStyle().FramePadding.x);
    ImGui::BeginDisabled(context.activity.busy);
    if (ImGui::SmallButton(kAsk)) context.send("held-by");
    ImGui::EndDisabled();
    note_item(context, "held-by:ask",
              "examines the worst element and tries what would improve it; this takes some seconds for a large mesh");
    empty_lines(context, 3);
    return;
  }
  const auto ink = run.held.now ? std::nullopt : std::optional(context.palette.dim);
  value_row(context, kLabel, std::string(held->brief()), held->sentence(), ink, kAbout);
  if (held->has_advice()) {
    draw_switch(context, run, *held);
    return;
  }
  const bool shows = run.hold() != nullptr && !run.hold()->active.empty();
  constexpr const char* kWhy = "why?";
  const float button = shows ? ImGui::CalcTextSize(kWhy).x + 2 * ImGui::GetStyle().FramePadding.x + ImGui::GetStyle().ItemSpacing.x : 0.0F;
  const std::string outlook = held->trial ? fmt::format("{}: no gain", fmt::join(held->commands(), ", ")) : held->outlook();
  dim_text(context, fit_text(outlook, ImGui::GetContentRegionAvail().x - button), false);
  next_item_tooltip(held->sentence());
  if (!shows) return empty_lines(context, 2);
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - button + ImGui::GetStyle().ItemSpacing.x);
  if (ImGui::SmallButton(kWhy)) context.send(context.state.holders ? "holders off" : "holders on");
  note_item(context, "held-by:why", "shows the elements that hold one another, their forces and the cluster around them (Alt+O)");
  empty_lines(context, 2);
}

/// Draws a quality in large numerals, its place on the scale of colours, and the smallest angle. `item`: name of the number.
void large_number(PanelContext& context, const char* item, Metric metric, double value, bool inverted, const std::optional<double>& angle) {
  ImGui::PushFont(context.fonts.large);
  ImGui::TextUnformatted(short_number(value).c_str());
  ImGui::PopFont();
  copied_by_click(context, full_number(value));
  context.items.record_last(item);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(), back = ImGui::GetCursorPos();
  const float middle = (low.y + high.y) / 2, half = context.px(6), left = high.x + context.px(10);
  const bool coloured_by_it = metric == context.session.shown && context.state.colouring.by == ColourBy::Quality;
  if (std::isfinite(value) && coloured_by_it)
    ImGui::GetWindowDrawList()->AddRectFilled(
        {left, middle - half}, {left + 2 * half, middle + half},
        colour(inverted ? render::kInvertedColour : shown_scale(context.state, context.derived).colour(value)), context.px(3));
  if (!angle) return;
  ImGui::SetCursorScreenPos({coloured_by_it ? left + 2 * half + context.px(10) : left, middle - ImGui::GetTextLineHeight() / 2});
  dim_text(context, degrees(*angle), false);
  next_item_tooltip("the smallest angle of this element");
  ImGui::SetCursorPos(back);
}

/// Draws a text in the middle of the large number that begins at `top` and was drawn last.
void draw_beside_number(PanelContext& context, float top, const std::string& words, std::span<const SideButton> buttons) {
  const float bottom = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
  side_buttons(context, (top + bottom - ImGui::GetTextLineHeight()) / 2, words, buttons);
}

void draw_minimum(PanelContext& context, Metric metric, double minimum, Index worst) {
  dim_text(context, fmt::format("Worst element by {}", metric_phrase(metric)), false);
  metric_tooltip(context, info(metric));
  const float top = ImGui::GetCursorPosY();
  const auto& angles = context.derived.worst_angles;
  large_number(context, "minimum", metric, minimum, !(minimum > 0.0),
               angles && metric == context.session.shown ? std::optional(angles->smallest) : std::nullopt);
  if (worst == kNoIndex) return;
  const SideButton show{"Show it", "show-worst", "selects the worst element and goes there", fmt::format("goto element {}", worst)};
  draw_beside_number(context, top, "", {&show, 1});
}

/// Draws the quality of a picked element; for one in the list of the worst also its rank, and buttons to its neighbours there.
void draw_own_quality(PanelContext& context, const Frame& frame, Index element) {
  const PickedFacts& facts = context.derived.facts;
  const auto row = std::ranges::find(facts.metrics, &info(frame.shown), &PickedFacts::Row::metric);
  if (row == facts.metrics.end()) return;
  dim_text(context, capitalised(metric_phrase(frame.shown)), false);
  metric_tooltip(context, info(frame.shown));
  const float top = ImGui::GetCursorPosY();
  const auto at = std::ranges::find(frame.worst, element, &RankedElement::element);
  const bool room = facts.angles && at == frame.worst.end();  // no rank at the line's end
  large_number(context, "element-quality", frame.shown, row->now, facts.inverted,
               room ? std::optional(facts.angles->smallest) : std::nullopt);
  if (at == frame.worst.end()) return;
  const auto go_to = [&](std::ptrdiff_t step) {
    const std::ptrdiff_t rank = at - frame.worst.begin() + step;
    const bool any = rank >= 0 && rank < std::ssize(frame.worst);
    return any ? fmt::format("goto element {}", frame.worst[static_cast<std::size_t>(rank)].element) : std::string();
  };
  draw_beside_number(context, top, at == frame.worst.begin() ? "the worst" : fmt::format("worst {}", at - frame.worst.begin() + 1),
                     std::array<SideButton, 2>{{{"‹", "worse-element", "goes to the next worse element", go_to(-1)},
                                                {"›", "better-element", "goes to the next better one", go_to(1)}}});
}

/// Quality below which one element in a hundred lies, by the shown metric; NaN while it is not known.
double worst_percent(const PanelContext& context, Metric metric) {
  const RunView* run = context.run();
  if (run == nullptr || !run->summary || run->summary->metric != metric || run->summary->moment != context.frame()->moment) return kUnknown;
  return percentiles_of_sorted(run->summary->sorted).p1;
}

/// Draws the statistics of qualities. `run`: run whose minimum it is; null: none.
void draw_statistics(PanelContext& context, Metric metric, const Statistics& statistics, const RunView* run) {
  draw_minimum(context, metric, statistics.minimum, statistics.worst_element);
  if (metric == context.session.shown)
    number_row(context, "worst 1 % below", worst_percent(context, metric), "one element in a hundred is worse");
  number_row(context, "mean", statistics.mean, "over all elements");
  const Frame& frame = *context.frame();
  if (run != nullptr || metric == frame.shown) {
    const Index inverted = frame.shown_statistics.inverted;  // independent of the metric
    value_row(context, "inverted elements", inverted == 0 ? "none" : count(inverted), {},
              inverted == 0 ? context.palette.good : context.palette.error, "elements whose Jacobian is 0 or less, at a corner or inside");
  }
  if (run == nullptr) return;
  const HeldMinimum* held = run->held.found.get();
  const bool rests = held != nullptr && held->brief() != "nothing";  // the minimum no longer rises
  const std::string aside = rests ? fit_text(std::string(held->brief()), 9 * context.em()) : std::string();
  const bool open = context.state.panels.holds;
  if (fold_row(context, "holds", "Why no better?", aside, open, "what holds the worst element, and what would raise it"))
    context.send(open ? "unfold-holds off" : "unfold-holds on");
  if (!open) return;
  draw_hold(context, *run);
  number_row(context, "movable minimum", statistics.movable_minimum);
  dim_text(context, "the worst element that has a free corner");
  number_row(context, "ceiling", statistics.ceiling);
  dim_text(context, std::isfinite(statistics.ceiling) ? "the worst element whose corners are all fixed: the minimum stays below"
                                                      : "the worst element whose corners are all fixed: there is none");
}

const char* held_word(HeldOn held) {
  constexpr const char* kBoundary = "fixed: boundary";
  constexpr std::array<const char*, 9> kWords{
      kBoundary,  // in the order of HeldOn
      "fixed: corner", "fixed: features meet", "fixed: feature ends", "fixed: parts touch", "fixed: by the file", kBoundary,
      kBoundary,       "fixed: corner by hand"};
  return kWords[static_cast<std::size_t>(held)];
}

/// Draws buttons that select vertices.
void draw_vertices(PanelContext& context, const char* label, std::span<const Index> vertices) {
  dim_text(context, label, false);
  for (const Index vertex : vertices) {
    ImGui::SameLine();
    const std::string id = fmt::format("{}", vertex);
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(id.c_str()).x + context.px(16)) ImGui::NewLine();
    if (ImGui::SmallButton(id.c_str())) context.send(fmt::format("pick vertex {}", vertex));
    next_item_tooltip("select this vertex");
  }
}

/// Draws the neighbours of a vertex in the order in which they lie around it.
void draw_ring(PanelContext& context, const Frame& frame, Index vertex) {
  constexpr std::size_t kMost = 24;  // a longer list cannot be read
  const std::vector<Index> ring = ordered_ring(frame.input->mesh, frame.input->topology, vertex);
  if (ring.empty() || ring.size() > kMost) return;
  draw_vertices(context, "Neighbours", ring);
}

void draw_vertex(PanelContext& context, const Frame& frame, Index vertex) {
  heading(context, fmt::format("Vertex {}", vertex).c_str());
  const Topology& topology = frame.input->topology;
  const RunView* run = context.run();
  const PickedFacts& facts = context.derived.facts;
  const Vec3& at = facts.at;
  const std::string full = fmt::format("{} {} {}", full_number(at.x), full_number(at.y), full_number(at.z));
  value_row(context, "x", fmt::format("{:.8g}", at.x), full);
  value_row(context, "y", fmt::format("{:.8g}", at.y), full);
  if (at.z != 0.0 || context.state.in_space) value_row(context, "z", fmt::format("{:.8g}", at.z), full);
  const bool boundary = topology.boundary()[vertex] != 0;
  const bool fixed = run != nullptr && vertex < run->fixed.size() && run->fixed[vertex] != 0;
  const bool slides = !fixed && run != nullptr && run->domain != nullptr && run->domain->slides(vertex);
  const Interfaces& interfaces = frame.input->interfaces;
  const bool layer =
      fixed && run->parameters.standing().layers == LayerRule::Keep && std::ranges::binary_search(frame.input->layers, vertex);
  const bool interface = fixed && run->parameters.interfaces != InterfaceRule::Free && interfaces.holds(vertex);
  const bool on_surface = slides && run->domain->on_surface(vertex), in_space = frame.input->in_space();
  const std::string_view held = fixed && run->domain != nullptr ? run->domain->why_held(vertex) : std::string_view();
  value_row(context, "may move",
            on_surface                      ? "on the surface"
            : slides && in_space            ? "along a feature"
            : slides                        ? boundary ? "along the boundary" : "along the interface"
            : !fixed                        ? "free"
            : topology.star(vertex).empty() ? "fixed: unused"
            : layer                         ? "fixed: boundary layer"
            : interface                     ? "fixed: interface"
            : !held.empty()                 ? held_word(run->domain->held_on(vertex))
            : boundary                      ? "fixed: boundary"
                                            : "fixed",
            layer       ? "boundary layers stay (layers: free lets them go)"
            : interface ? interfaces.why(vertex)
                        : std::string(held));
  if (run != nullptr) draw_vertex_kind(context, frame, *run, vertex);
  value_row(context, "valence", count(topology.star(vertex).size()), {}, {}, "elements around it");
  draw_loop_place(context, frame, vertex);
  draw_ring(context, frame, vertex);
  number_row(context, "quality now", facts.now, "the worst element around it, by the shown metric");
  number_row(context, "at the input", facts.before);
  if (context.state.inspection.open && context.state.inspection.vertex == vertex) return;  // its elements are listed above
  action_button(context, "inspect", "Inspect its search");
  dim_text(context, fmt::format("Its elements by {}", metric_phrase(frame.shown)));
  for (const auto& [element, q, inverted, inside] : facts.star) {
    ImGui::PushID(static_cast<int>(element));
    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    if (ImGui::Selectable("##star")) context.send(fmt::format("pick element {}", element));
    context.items.record_last(fmt::format("star:{}", element));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float width = ImGui::GetContentRegionAvail().x, line = ImGui::GetTextLineHeight();
    const std::string number = short_number(q), name = fmt::format("element {}", element);
    list.AddText(cursor, colour(context.palette.text), name.c_str());
    const float left = cursor.x + 8.5F * context.em(), right = cursor.x + width - 4 * context.em();
    if (right > left + context.em()) {
      list.AddRectFilled({left, cursor.y + 0.3F * line}, {right, cursor.y + 0.75F * line}, colour(context.palette.raised), context.px(2));
      const float part = static_cast<float>(std::clamp(std::isfinite(q) ? q : 0.0, 0.0, 1.0));
      const render::Rgb ink = inverted ? render::kInvertedColour : context.palette.accent;
      list.AddRectFilled({left, cursor.y + 0.3F * line}, {left + part * (right - left), cursor.y + 0.75F * line}, colour(ink),
                         context.px(2));
    }
    list.AddText({cursor.x + width - ImGui::CalcTextSize(number.c_str()).x, cursor.y}, colour(context.palette.text), number.c_str());
    ImGui::PopID();
  }
}

/// Draws every metric of one element now and at the input.
void draw_metric_table(PanelContext& context) {
  using Row = PickedFacts::Row;
  const std::vector<Row>& rows = context.derived.facts.metrics;
  std::array<float, 2> widths{ImGui::CalcTextSize("now").x, ImGui::CalcTextSize("input").x};
  for (const Row& row : rows) {
    widths[0] = std::max(widths[0], ImGui::CalcTextSize(short_number(row.now).c_str()).x);
    widths[1] = std::max(widths[1], ImGui::CalcTextSize(short_number(row.before).c_str()).x);
  }
  if (!ImGui::BeginTable("metrics", 3, ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupColumn("metric", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("now", ImGuiTableColumnFlags_WidthFixed, widths[0]);
  ImGui::TableSetupColumn("input", ImGuiTableColumnFlags_WidthFixed, widths[1]);
  const auto cell = [&](const std::string& text, const std::string& full, const render::Rgb& ink) {
    ImGui::TableNextColumn();
    right_text(text, ink);
    if (!full.empty()) copied_by_click(context, full);
  };
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  dim_text(context, "metric", false);
  for (const char* title : {"now", "input"}) cell(title, {}, context.palette.dim);
  for (const Row& row : rows) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    wrapped_text(std::string(row.metric->title));
    metric_tooltip(context, *row.metric);
    context.items.record_last(fmt::format("metric:{}", row.metric->name));
    cell(short_number(row.now), full_number(row.now), context.palette.text);
    cell(short_number(row.before), full_number(row.before), context.palette.dim);
  }
  ImGui::EndTable();
}

void draw_element(PanelContext& context, const Frame& frame, Index element) {
  const ElementTable& elements = frame.input->mesh.elements;
  heading(context, fmt::format("Element {}", element).c_str());
  ImGui::SameLine();
  dim_text(context, std::string(info(elements.kind(element)).name), false);
  draw_own_quality(context, frame, element);
  if (const PickedFacts& facts = context.derived.facts; facts.inverted)
    value_row(context, "inverted", facts.inverted_inside ? "only inside" : "yes", {}, context.palette.error,
              facts.inverted_inside ? "not at its corners: at the diamond" : nullptr);
  if (const auto& angles = context.derived.facts.angles)
    value_row(context, "angles", degrees(angles->smallest) + " to " + degrees(angles->largest), {}, {},
              frame.input->is_volume() ? "smallest and largest between its faces" : "smallest and largest at its corners");
  if (frame.input->is_volume() && !frame.positions.empty())
    number_row(context, "volume", signed_volume(elements, frame.positions, element), "negative where it is inside out");
  if (const PickedFacts& facts = context.derived.facts; facts.aspect && facts.target_aspect) {
    number_row(context, "aspect", *facts.aspect, "longest over shortest axis of its map from the ideal element");
    number_row(context, "target aspect", *facts.target_aspect, "the same for its target shape");
  }
  draw_vertices(context, "Corners", elements.corners(element));
  if (ImGui::SmallButton("Inspect its worst corner")) context.send(fmt::format("inspect element {}", element));
  note_item(context, "why", "inspects the search of its worst free corner");
  draw_metric_table(context);
  if (const RunView* run = context.run()) draw_element_edges(context, frame, *run, element);
}

}  // namespace

void draw_mesh_facts(PanelContext& context) {
  const Frame* frame = context.frame();
  if (frame == nullptr) return dim_text(context, "The numbers of an open mesh are shown here.");
  const RunView* run = context.run();
  const Metric optimised = run != nullptr ? run->parameters.metric : frame->shown;
  if (optimised != frame->shown) {
    draw_statistics(context, optimised, frame->provisional ? kNotKnownYet : frame->statistics, run);
    ImGui::Dummy({0, context.px(4)});
    draw_statistics(context, frame->shown, frame->shown_statistics, nullptr);
  } else {
    draw_statistics(context, frame->shown, frame->shown_statistics, run);
  }
  ImGui::Dummy({0, context.px(4)});
  draw_mesh(context, *frame);
}

void draw_selection(PanelContext& context) {
  const Frame* frame = context.frame();
  const PickedFacts& facts = context.derived.facts;  // facts of the pick when this drawing began
  if (frame != nullptr && facts.picked.kind == Picked::Kind::Vertex) return draw_vertex(context, *frame, facts.picked.id);
  if (frame != nullptr && facts.picked.kind == Picked::Kind::Element) return draw_element(context, *frame, facts.picked.id);
  dim_text(context, facts.trouble.empty() ? "Click a vertex or an element (Alt: the element)."
                                          : "The selection cannot be read now: " + facts.trouble);
}

}  // namespace dmoscope::ui
