// Kinds of vertices and edges where vertices slide, and controls that change them: in the inspector, and in a viewport's menu.
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/reference/kind_facts.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// A small button of a vertex or an edge, lit while its kind is in force.
struct KindButton {
  const char* label;
  std::string item, command, tooltip;  // without a command a click does nothing
  bool on;
  bool enabled = true;
};

void draw_button(PanelContext& context, const KindButton& one) {
  ImGui::BeginDisabled(!one.enabled || context.activity.busy);
  if (lit_button(context, one.item, one.label, one.on, one.tooltip, true) && !one.command.empty()) context.send(one.command);
  ImGui::EndDisabled();
}

/// Effect of a click on the button of an edge.
struct EdgeTurn {
  std::string_view command;  // empty: none, the file or the mesh decides
  std::string tooltip;
};
EdgeTurn turn_of(EdgeKind kind, const Kinds& kinds, EdgeEnds edge) {
  const bool by_hand = kinds.has_feature(edge) || kinds.has_no_feature(edge);
  switch (kind) {
    case EdgeKind::Smooth:
      if (by_hand) return {"auto-feature", "smooth, set by hand. Click: decided by the angle again"};
      return {"feature", "smooth: vertices may cross it. Click: make it a feature edge, which vertices slide along but never cross"};
    case EdgeKind::Hand:
      return {"auto-feature", "a feature edge, set by hand. Click: decided by the angle again"};
    case EdgeKind::Angle:
      return {"no-feature", "a feature edge, because the surface folds there. Click: make it smooth"};
    default:
      return {{}, fmt::format("a feature edge: {}", phrase(kind))};
  }
}

struct EdgeRow {
  Index from, to;
  bool of_vertex;  // the picked vertex is `from`
};

void draw_edge(PanelContext& context, const InputMesh& input, const RunView& run, const StandingRule& rule, const EdgeRow& row) {
  const Domain& domain = *run.domain;
  const EdgeKind kind = edge_kind(input, rule, domain, row.from, row.to);
  const EdgeEnds ends = edge_ends(row.from, row.to);
  const EdgeTurn turn = turn_of(kind, rule.kinds, ends);
  const std::string name = fmt::format("{}-{}", ends[0], ends[1]);
  ImGui::PushID(name.c_str());
  const ImVec2 top = ImGui::GetCursorScreenPos();
  const float right = ImGui::GetWindowContentRegionMax().x;
  constexpr const char *kFeature = "feature", *kChain = "chain";
  const float gap = context.px(4), first = right - widest_button({kFeature}) - widest_button({kChain}) - gap;
  const std::string whole = row.of_vertex ? fmt::format("to {}", row.to) : name;
  const std::string label = fit_text(whole, first - gap - ImGui::GetCursorPosX());
  ImGui::TextUnformatted(label.c_str());
  next_item_tooltip("edge " + name);
  if (const auto fold = fold_of(input, domain, row.from, row.to)) {
    const std::string angle = fmt::format("{:.0f}°", *fold);
    const float width = ImGui::CalcTextSize(angle.c_str()).x, left = first - gap - width;
    if (left > ImGui::GetCursorPosX() + ImGui::CalcTextSize(label.c_str()).x + gap) {
      ImGui::SameLine(left);
      dim_text(context, angle, false);
      next_item_tooltip("the angle by which the input's surface folds there");
    }
  }
  ImGui::SameLine(first);
  draw_button(context, {kFeature, "edge:" + name, fmt::format("{} edges:{}", turn.command, name), turn.tooltip, is_feature(kind),
                        !turn.command.empty()});
  ImGui::SameLine(0, gap);
  const bool chained = !turn.command.empty() && turn.command != "feature";
  draw_button(context,
              {kChain, "chain:" + name, fmt::format("{} chain:{}", turn.command, name),
               chained ? "the same for all feature edges that continue it, both ways up to the next corner" : "no chain continues here",
               false, chained});
  ImGui::PopID();
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const bool over = mouse.y >= top.y && mouse.y < ImGui::GetCursorScreenPos().y && mouse.x >= top.x;
  if (over && ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem)) context.state.edge_under_mouse = ends;
}

void draw_edges(PanelContext& context, const InputMesh& input, const RunView& run, const std::vector<EdgeRow>& rows) {
  const StandingRule rule = run.parameters.standing();
  std::vector<EdgeRow> on_domain;
  for (const EdgeRow& row : rows)
    if (edge_kind(input, rule, *run.domain, row.from, row.to) != EdgeKind::Off) on_domain.push_back(row);
  if (on_domain.empty()) return;
  dim_text(context, "Edges", false);
  next_item_tooltip("feature edges, which no vertex crosses, and other edges; point at one to see it in the mesh");
  for (const EdgeRow& row : on_domain) draw_edge(context, input, run, rule, row);
}

/// Edges of an element, each once.
std::vector<EdgeEnds> edges_of(const Frame& frame, Index element) {
  const ElementTable& elements = frame.input->mesh.elements;
  const auto corners = elements.corners(element);
  std::vector<EdgeEnds> edges;
  for (const LocalFace& face : faces_of(elements.kind(element)))
    for (std::size_t i = 0; i < face.count; ++i)
      edges.push_back(edge_ends(corners[face.corners[i]], corners[face.corners[i + 1 < face.count ? i + 1 : 0]]));
  std::erase_if(edges, [](const EdgeEnds& edge) { return edge[0] == edge[1]; });
  std::ranges::sort(edges);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Reason why a vertex cannot be made to slide by hand; empty if it can.
std::string why_stays(const Domain& domain, Index vertex) {
  const HeldOn held = domain.held_on(vertex);
  const bool can_slide = held == HeldOn::Nothing || held == HeldOn::Corner || held == HeldOn::Hand;
  return can_slide ? std::string() : std::string(domain.why_held(vertex));
}

}  // namespace

void draw_vertex_kind(PanelContext& context, const Frame& frame, const RunView& run, Index vertex) {
  if (run.domain == nullptr) return;
  const Domain& domain = *run.domain;
  if (!domain.slides(vertex) && domain.held_on(vertex) == HeldOn::Nothing) return;
  const Kinds& kinds = run.parameters.kinds;
  const bool corner = kinds.has_corner(vertex), none = kinds.has_no_corner(vertex);
  const std::string stays = why_stays(domain, vertex), words = fmt::format(" vertices:{}", vertex);
  const float gap = context.px(4);
  draw_button(context, {"corner", "kind:corner", corner ? "" : "corner" + words, "it is fixed although it could slide", corner,
                        stays.empty() || corner});
  ImGui::SameLine(0, gap);
  draw_button(context,
              {"no corner", "kind:no-corner", none ? "" : "no-corner" + words,
               stays.empty() ? "it slides along its curve, however much that turns there" : "it is fixed: " + stays, none, stays.empty()});
  ImGui::SameLine(0, gap);
  draw_button(context, {"auto", "kind:auto", corner || none ? "auto-corner" + words : "",
                        "a corner if the file says so or its curve turns by more than the corner angle", !corner && !none});
  std::vector<EdgeRow> rows;
  for (const Index other : edges_at(*frame.input, vertex)) rows.push_back({vertex, other, true});
  draw_edges(context, *frame.input, run, rows);
}

void draw_element_edges(PanelContext& context, const Frame& frame, const RunView& run, Index element) {
  if (run.domain == nullptr) return;
  std::vector<EdgeRow> rows;
  for (const auto& [a, b] : edges_of(frame, element)) rows.push_back({a, b, false});
  draw_edges(context, *frame.input, run, rows);
}

bool draw_kind_entries(PanelContext& context, const Frame& frame, const RunView& run, Index vertex, EdgeEnds edge) {
  if (run.domain == nullptr) return false;
  bool any = false;
  const Domain& domain = *run.domain;
  const StandingRule rule = run.parameters.standing();
  const auto entry = [&](const std::string& label, const char* item, const std::string& command, bool possible) {
    if (ImGui::MenuItem(label.c_str(), nullptr, false, possible && !context.activity.busy)) context.send(command);
    context.items.record_last(item);
    any = true;
  };
  const auto edge_entry = [&](const std::string& label, const char* item, const std::string& command, bool possible) {
    entry(label, item, command, possible);
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) context.state.edge_under_mouse = edge;
  };
  if (vertex < frame.vertex_count() && (domain.slides(vertex) || domain.held_on(vertex) != HeldOn::Nothing)) {
    const bool said = rule.kinds.has_corner(vertex) || rule.kinds.has_no_corner(vertex), held = !why_stays(domain, vertex).empty();
    const std::string words = fmt::format(" vertices:{}", vertex);
    entry(fmt::format("Vertex {}: make it a corner", vertex), "menu:corner", "corner" + words, !rule.kinds.has_corner(vertex) && !held);
    entry(fmt::format("Vertex {}: no corner, let it slide", vertex), "menu:no-corner", "no-corner" + words,
          !rule.kinds.has_no_corner(vertex) && !held);
    if (said) entry(fmt::format("Vertex {}: as file and angles say", vertex), "menu:auto-corner", "auto-corner" + words, true);
  }
  if (edge[1] >= frame.vertex_count()) return any;
  const EdgeKind kind = edge_kind(*frame.input, rule, domain, edge[0], edge[1]);
  if (kind == EdgeKind::Off) return any;
  const EdgeTurn turn = turn_of(kind, rule.kinds, edge);
  const std::string name = fmt::format("{}-{}", edge[0], edge[1]);
  const char* what = turn.command == "feature"      ? "make it a feature edge"
                     : turn.command == "no-feature" ? "make it smooth"
                                                    : "as file and angles say";
  if (turn.command.empty()) {
    edge_entry(fmt::format("Edge {}: it stays a feature edge", name), "menu:edge", {}, false);
    return any;
  }
  edge_entry(fmt::format("Edge {}: {}", name, what), "menu:edge", fmt::format("{} edges:{}", turn.command, name), true);
  if (turn.command != "feature")
    edge_entry(fmt::format("Edge {} and its chain: {}", name, what), "menu:chain", fmt::format("{} chain:{}", turn.command, name), true);
  return any;
}

EdgeEnds nearest_edge(const Frame& frame, Index element, Vec3 at) {
  EdgeEnds nearest{kNoIndex, kNoIndex};
  double least = std::numeric_limits<double>::infinity();
  if (frame.device || element >= frame.element_count()) return nearest;
  for (const EdgeEnds& edge : edges_of(frame, element)) {
    const Vec3 from = frame.positions[edge[0]], along = frame.positions[edge[1]] - from;
    const double square = dot(along, along), share = square > 0.0 ? std::clamp(dot(at - from, along) / square, 0.0, 1.0) : 0.0;
    const double far = length(at - (from + share * along));
    if (far < least) least = far, nearest = edge;
  }
  return nearest;
}

}  // namespace dmoscope::ui
