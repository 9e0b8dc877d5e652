// Left: the parameters of the active run.
#include <algorithm>

#include <fmt/format.h>

#include "core/run/ending.h"
#include "core/smooth/execution/method_table.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr int kLargestSeed = 1 << 30;  // largest seed that can be entered

void draw_method(PanelContext& context, const RunParameters& parameters) {
  float widest = 0;
  for (const MethodInfo& method : method_table()) widest = std::max(widest, ImGui::CalcTextSize(std::string(method.name).c_str()).x);
  labelled(context, "method", "the method that moves the vertices", combo_width(widest));
  Combo combo(context, "method", parameters.method);
  if (!combo.open()) return;
  for (const MethodInfo& method : method_table())
    if (combo.entry(method.name, method.name, method.name == parameters.method,
                    method.optimises ? std::string(method.doc) : fmt::format("{}; {}", method.doc, kMayMakeWorse)))
      context.send(fmt::format("method {}", method.name));
}

/// Sends `command X` when another number was entered.
void real(PanelContext& context, const char* item, double value) {
  double edited = value;
  ImGui::InputDouble(fmt::format("##{}", item).c_str(), &edited, 0, 0, "%.4g");
  context.items.record_last(item);
  if (ImGui::IsItemDeactivatedAfterEdit() && edited != value) context.send(fmt::format("{} {}", item, full_number(edited)));
}

/// Draws a choice of one of a few words.
void choice(PanelContext& context, const ParameterInfo& row, const std::string& now) {
  const std::string item(row.name);
  Combo combo(context, item, now);
  if (!combo.open()) return;
  for (const std::string_view word : row.choices)
    if (combo.entry(word, word, word == now)) context.send(fmt::format("{} {}", item, word));
}

void draw_parameter(PanelContext& context, const ParameterInfo& row, const RunParameters& parameters) {
  const std::string command(row.name), item(row.item.empty() ? row.name : row.item), now = row.to_text(parameters);
  float wanted = 0;
  for (const std::string_view word : row.choices) wanted = std::max(wanted, combo_width(ImGui::CalcTextSize(std::string(word).c_str()).x));
  labelled(context, std::string(row.title).c_str(), row.help().c_str(), wanted);
  if (row.kind == ParameterKind::Whole) {
    const int most = static_cast<int>(std::min<double>(row.most, kLargestSeed));
    integer(context, item.c_str(), static_cast<int>(std::min<std::uint64_t>(to_count(now), kLargestSeed)), static_cast<int>(row.least),
            most, command.c_str());
  } else if (row.kind == ParameterKind::Real) {
    real(context, item.c_str(), to_number(now));
  } else {
    choice(context, row, now);
  }
}

/// Draws the options of the run's method, and nothing else.
void draw_options(PanelContext& context, const RunParameters& parameters, bool surface) {
  for (const ParameterInfo& row : parameter_table()) {
    const bool is_option = row.reader != nullptr || row.sliding_only || row.name == "boundary";
    if (row.in_session && is_option && row.read_by(parameters, surface) && !(row.volume_only && !context.state.in_space))
      draw_parameter(context, row, parameters);
  }
}

void draw_backend(PanelContext& context, const RunView& run) {
  labelled(context, "backend", "the processor, a CUDA device, or the faster of the two (auto)");
  const Backend chosen = run.parameters.backend;
  const std::string shown = chosen == Backend::Auto ? fmt::format("auto: {}", name(run.backend)) : std::string(name(chosen));
  Combo combo(context, "backend", shown);
  next_item_tooltip(run.backend_reason);
  if (!combo.open()) return;
  for (const Backend backend : {Backend::Auto, Backend::Cpu, Backend::Cuda})
    if (combo.entry(name(backend), name(backend), backend == chosen)) context.send(fmt::format("backend {}", name(backend)));
}

/// Draws the interfaces of a mesh that has any.
void draw_interfaces(PanelContext& context, const RunParameters& parameters) {
  if (!context.session.input || !context.session.input->interfaces.any()) return;
  labelled(context, "interfaces",
           "whether vertices between materials, and on named lines, faces and points of the file, keep their places");
  Combo combo(context, "interfaces", std::string(name(parameters.interfaces)));
  const bool fixed = parameters.interfaces != InterfaceRule::Free;
  next_item_tooltip(fixed ? context.derived.interfaces : context.derived.free_interfaces);
  if (!combo.open()) return;
  for (const InterfaceRule rule : {InterfaceRule::Fixed, InterfaceRule::Free, InterfaceRule::Slide})
    if (combo.entry(name(rule), name(rule), rule == parameters.interfaces)) context.send(fmt::format("interfaces {}", name(rule)));
}

void draw_order(PanelContext& context, const RunParameters& parameters) {
  labelled(context, "order", "the order in which an iteration visits the vertices, before colouring");
  const bool shuffled = parameters.order.seed.has_value();
  if (Combo combo(context, "order", shuffled ? "shuffled" : "natural"); combo.open()) {
    if (combo.entry("natural", "natural", !shuffled)) context.send("order natural");
    if (combo.entry("shuffled", "shuffled", shuffled)) context.send("order shuffle:1");
  }
  if (!shuffled) return;
  labelled(context, "seed", "seed of the shuffled order");
  integer(context, "seed", static_cast<int>(*parameters.order.seed), 0, kLargestSeed, "order shuffle:");
}

/// Draws a note of constant height, so that nothing below it moves: the effect of a change, or that the method promises nothing.
void draw_note(PanelContext& context, const RunView& run) {
  const bool begun = run.moment != Moment{} || run.edits > 0 || run.records.size() > 1;
  constexpr const char* kNew = "Changes start a new run.";
  constexpr const char* kSame = "Changes apply to this run.";
  constexpr const char* kWorse = "May make elements worse.";
  const float room = ImGui::GetContentRegionAvail().x, top = ImGui::GetCursorPosY();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  float height = 0;
  for (const char* text : {kNew, kSame, kWorse}) height = std::max(height, ImGui::CalcTextSize(text, nullptr, false, room).y);
  const bool promises = method_info(run.parameters.method).optimises;
  std::string about = begun ? "This run has begun. A change starts a new run from the input; this one is kept."
                            : "This run has not begun. Once it has, a change starts a new run beside it.";
  if (promises) {
    dim_text(context, begun ? kNew : kSame);
  } else {
    wrapped_text(kWorse, context.palette.warning);
    context.items.record_last("method-note");
    about = "This method may make elements worse; Best iteration in the menu Run goes back to the best one. " + about;
  }
  context.items.record("change-note", {corner.x, corner.y, corner.x + room, corner.y + height});
  next_item_tooltip(about);
  ImGui::SetCursorPosY(top + height + ImGui::GetStyle().ItemSpacing.y);
}

/// Draws the choice of the elements' target.
void draw_target(PanelContext& context, const RunView& run) {
  const std::string now = to_text(target_of(run.parameters.metric));
  const auto& choices = context.widgets.target_choices.of(run.input);
  float widest = 0;
  for (const TargetChoice& one : choices) widest = std::max(widest, ImGui::CalcTextSize(context.shown(one.title).c_str()).x);
  labelled(context, "target", "the target shape of the elements; an element of that shape has quality 1", combo_width(widest));
  const auto current = std::ranges::find(choices, now, &TargetChoice::text);
  Combo combo(context, "target", context.shown(current != choices.end() ? current->title : now));
  if (!combo.open()) return;
  for (const TargetChoice& one : choices)
    if (combo.entry(one.text, context.shown(one.title), one.text == now, one.doc)) context.send("target " + quote_word(one.text));
  if (combo.entry("other", "another…", false)) context.state.dialog = Dialog::Formula;
}

/// Summary of the parameters that are folded away: "all usual" or "2 changed".
std::string changes_of(const RunParameters& parameters) {
  const RunParameters usual;
  std::size_t changed = 0;
  for (const ParameterInfo& row : parameter_table())
    if (row.in_session && row.name != "method" && row.name != "metric" && row.to_text(parameters) != row.to_text(usual)) ++changed;
  return changed == 0 ? "all usual" : fmt::format("{} changed", changed);
}

void draw_settings(PanelContext& context, const RunView& run) {
  const RunParameters& parameters = run.parameters;
  if (run.input) draw_target(context, run);
  draw_composite(context, run);
  draw_options(context, parameters, run.input && run.input->is_surface());
  draw_interfaces(context, parameters);
  draw_order(context, parameters);
  draw_backend(context, run);
  labelled(context, "threads", "number of processor threads; the result does not depend on it");
  integer(context, "threads", static_cast<int>(context.session.threads), 1, 1024, "threads");
}

}  // namespace

const std::vector<TargetChoice>& TargetChoices::of(const std::shared_ptr<const InputMesh>& input) {
  if (input != input_) {
    input_ = input;
    choices_ = target_choices(*input);
  }
  return choices_;
}

void draw_parameters(PanelContext& context) {
  const RunView* run = context.run();
  if (run == nullptr) return;
  const RunParameters& parameters = run->parameters;
  ImGui::BeginDisabled(context.activity.busy);
  draw_method(context, parameters);
  if (method_info(parameters.method).optimises)
    labelled(context, "metric", "the metric that the method optimises: it raises the minimum around each vertex",
             metric_combo_width(context));
  else
    labelled(context, "judged by", "the metric of the run's statistics; the method itself uses none", metric_combo_width(context));
  metric_combo(context, "metric", parameters.metric, "metric");
  draw_note(context, *run);
  ImGui::EndDisabled();
  const bool open = context.state.panels.settings;
  if (fold_row(context, "settings", "More settings", changes_of(parameters), open, "target, phases, grid, boundary, order, threads"))
    context.send(open ? "settings off" : "settings on");
  if (!open) return;
  ImGui::BeginDisabled(context.activity.busy);
  draw_settings(context, *run);
  ImGui::EndDisabled();
}

}  // namespace dmoscope::ui
