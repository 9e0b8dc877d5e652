// Left: the parameters of the active run, with its second phase and second aim.
#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/mesh/geographic.h"
#include "core/run/ending.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/size_field.h"
#include "ui/commands/size_point.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

using SizeKind = SizeFunction::Kind;

void say(PanelContext& context, Metric first, const CompositeTerms& combination) {
  const std::string size = combination.size_text();
  context.send(fmt::format("combine {}{}", to_text(first, combination), size.empty() ? "" : " " + quote_word(size)));
}

CompositeTerms with(const CompositeTerms& combination, const SizeFunction& size) {
  return {combination.threshold, size, combination.place};
}

/// Middle of the mesh: the point of a size function until one is chosen.
Vec3 middle(const InputMesh& input) {
  Vec3 sum{};
  const Plane& plane = input.geometry.plane;
  for (const Vec3& p : input.mesh.positions) sum = sum + (plane.period > 0.0 ? plane.lift(plane.place(p)) : p);
  return in_file(input.mesh, (1.0 / std::max<double>(1.0, static_cast<double>(input.mesh.positions.size()))) * sum);
}

bool moves_jointly(const RunParameters& p) { return p.then_joint || method_info(p.method).joint; }

/// Combination to begin with: joint moves know metrics alone.
CompositeTerms usual(const PanelContext& context, const RunParameters& p) {
  CompositeTerms combination;
  const auto other = std::ranges::find_if(context.derived.metrics, [&p](Metric one) { return one != p.metric; });
  if (moves_jointly(p) && other != context.derived.metrics.end()) combination.second = *other;
  return combination;
}

void draw_second(PanelContext& context, const RunParameters& p) {
  labelled(context, "second aim", "the aim once the first metric is above its threshold", metric_combo_width(context));
  const auto* metric = std::get_if<Metric>(&p.combination->second);
  Combo combo(context, "second-aim", metric != nullptr ? metric_title(*metric) : std::string(find_place_aim(p.combination->place)->title));
  if (!combo.open()) return;
  for (const PlaceAimInfo& one : place_aims())
    if (!moves_jointly(p) && combo.entry(one.name, one.title, metric == nullptr && p.combination->place == one.name, std::string(one.doc)))
      say(context, p.metric, {p.combination->threshold, SizeFunction{}, one.name});
  for (const Metric one : context.derived.metrics)
    if (one != p.metric && combo.entry(info(one).name, metric_title(one), metric != nullptr && *metric == one))
      say(context, p.metric, {p.combination->threshold, one, {}});
}

void draw_point(PanelContext& context, const SizeFunction& size) {
  labelled(context, "point", "the point of the size function, in the mesh's coordinates; Place puts it where you click next");
  const bool placing = context.state.placing_size_point;
  if (lit_button(context, "place-size-point", "Place", placing, "the next click in the mesh places it", true))
    context.send("place-size-point");
  if (placing) {
    dim_text(context, "click to place it");
  } else {
    // Coordinates have a line of their own: they are long, and half of one says nothing.
    ImGui::TextUnformatted(fit_text(fmt::format("{:.7g}, {:.7g}", size.point.x, size.point.y), ImGui::GetContentRegionAvail().x).c_str());
    next_item_tooltip(fmt::format("{}, {}", full_number(size.point.x), full_number(size.point.y)));
  }
}

/// Draws how well the sizes are met.
void draw_size_course(PanelContext& context, const RunView& run) {
  const char* tip =
      "correlation of the local mean edge length with the target size over the free vertices, at the input → now: 1 when they go together";
  labelled(context, "size corr.", tip);
  ImGui::TextUnformatted(run.summary ? size_course_text(run.summary->sizes.before.sizes, run.summary->sizes.after.sizes).c_str() : "…");
  context.items.record_last("size-course");
  next_item_tooltip(run.summary ? fmt::format("{}\n{}", tip, size_course_details(run.summary->sizes))
                                : "computed while no run is going on");
}

void draw_size(PanelContext& context, const RunView& run, const SizeFunction& size) {
  const RunParameters& p = run.parameters;
  labelled(context, "size", "the wanted element size, up to a common factor");
  const bool open = ImGui::BeginCombo(
      "##size", size.kind == SizeKind::Field ? size.field.c_str() : to_text(size).substr(0, to_text(size).find(':')).c_str());
  context.items.record_last("size-function");
  if (open) {
    const auto choice = [&](const char* name, const SizeFunction& wanted, const char* tip) {
      if (ImGui::Selectable(name, size.kind == wanted.kind && size.field == wanted.field))
        say(context, p.metric, with(*p.combination, wanted));
      note_item(context, fmt::format("size-function:{}", name), tip);
    };
    const InputMesh& input = *context.session.input;
    const Vec3 point = size.has_point() ? size.point : middle(input);
    choice("constant", {}, "the same everywhere");
    choice("h1", {SizeKind::Distance, point, {}}, "grows with the distance to a point (paper, eq. 12)");
    choice("h2", {SizeKind::InverseDistance, point, {}}, "falls with the distance to a point (paper, eq. 13)");
    for (const std::string& field : scalar_fields(input.mesh))
      choice(field.c_str(), {SizeKind::Field, {}, field}, "a nodal field of the file, at the vertex");
    ImGui::EndCombo();
  }
  if (size.has_point()) draw_point(context, size);
  if (size.kind != SizeKind::Constant) draw_size_course(context, run);
}

bool joint_possible(const RunView& run) {
  const RunParameters& p = run.parameters;
  return run.input && !method_info(p.method).joint && why_not_joint(*run.input, {p.metric, p.combination}).empty();
}

void draw_phases(PanelContext& context, const RunView& run) {
  const RunParameters& p = run.parameters;
  bool then_joint = p.then_joint.has_value(), then_mean = p.then_mean.has_value();
  const auto say_then = [&] {
    RunParameters wanted;
    wanted.mean = p.mean;
    if (then_joint) wanted.then_joint.emplace();
    if (then_mean) wanted.then_mean.emplace();
    context.send("then " + then_words(wanted));
  };
  if (joint_possible(run)) {
    if (ImGui::Checkbox("then joint", &then_joint)) say_then();
    note_item(context, "then-joint",
              "once the minimum has converged, moves vertices together where single ones gain nothing, until nothing does");
  }
  if (p.combination && p.combination->size() != nullptr) return;  // the mean phase would undo the sizes
  if (ImGui::Checkbox("then mean", &then_mean)) say_then();
  note_item(context, "then-mean", "once the minimum has converged, raises the mean quality, with the minimum as floor");
}

/// Draws the active run's second phase and second aim, as part of its parameters.
void draw_composite(PanelContext& context, const RunView& run) {
  const RunParameters& p = run.parameters;
  draw_phases(context, run);
  if (!method_info(p.method).optimises) return;
  bool combined = p.combination.has_value();
  if (ImGui::Checkbox("combine", &combined)) {
    if (combined)
      say(context, p.metric, usual(context, p));
    else
      context.send("combine off");
  }
  note_item(context, "combine",
            "two aims: the metric up to a threshold, and beyond it a second one, such as sizes of elements (paper, Section 4.2)");
  if (!p.combination) return;
  labelled(context, "threshold", "quality above 0 and below 1 from which on the second aim counts");
  double threshold = p.combination->threshold;
  ImGui::InputDouble("##threshold", &threshold, 0, 0, "%.4g");
  context.items.record_last("threshold");
  if (ImGui::IsItemDeactivatedAfterEdit() && threshold != p.combination->threshold)
    say(context, p.metric, {threshold, p.combination->second, p.combination->place});
  draw_second(context, p);
  if (run.size) draw_size(context, run, *p.combination->size());
}

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

/// Draws a choice of one of a few words.
void choice(PanelContext& context, const ParameterInfo& row, const std::string& now) {
  const std::string item(row.name);
  Combo combo(context, item, now);
  if (!combo.open()) return;
  for (const std::string_view word : row.choices)
    if (combo.entry(word, word, word == now)) context.send(fmt::format("{} {}", item, word));
}

/// Draws a field for a number or words. Its command refuses what means nothing.
void word_field(PanelContext& context, const std::string& item, const std::string& now, const std::string& command) {
  std::string edited = now;
  ImGui::InputText(fmt::format("##{}", item).c_str(), &edited);
  context.items.record_last(item);
  if (ImGui::IsItemDeactivatedAfterEdit() && edited != now) context.send(fmt::format("{} {}", command, edited));
}

void draw_parameter(PanelContext& context, const ParameterInfo& row, const RunParameters& parameters) {
  const std::string command(row.command()), item(row.item.empty() ? row.name : row.item), now = row.to_text(parameters);
  float wanted = 0;
  for (const std::string_view word : row.choices) wanted = std::max(wanted, combo_width(ImGui::CalcTextSize(std::string(word).c_str()).x));
  labelled(context, std::string(row.title).c_str(), row.help().c_str(), wanted);
  if (row.kind == ParameterKind::Whole) {
    const int most = static_cast<int>(std::min<double>(row.most, kLargestSeed));
    integer(context, item.c_str(), static_cast<int>(std::min<std::uint64_t>(to_count(now), kLargestSeed)), static_cast<int>(row.least),
            most, command.c_str());
  } else if (row.kind == ParameterKind::Choice) {
    choice(context, row, now);
  } else {
    word_field(context, item, now, command);
  }
}

/// Draws the options of the run's method, and nothing else.
void draw_options(PanelContext& context, const RunView& run) {
  const RunParameters& parameters = run.parameters;
  const bool surface = run.input && run.input->is_surface(), of_another = run.input && run.input->surface;
  for (const ParameterInfo& row : parameter_table()) {
    const bool is_option = row.reader != nullptr ? row.kind != ParameterKind::Text : row.sliding_only || row.name == "boundary";
    if (row.name == "fit" && !of_another) continue;  // there is nothing else to fit to
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

/// Draws the interfaces and the boundary layers of a mesh that has any.
void draw_standing(PanelContext& context, const InputMesh& input, const RunParameters& parameters) {
  if (input.interfaces.any()) {
    draw_parameter(context, parameter_info("interfaces"), parameters);
    const bool fixed = parameters.interfaces != InterfaceRule::Free;
    next_item_tooltip(fixed ? context.derived.interfaces : context.derived.free_interfaces);
  }
  if (!input.layers.empty()) draw_parameter(context, parameter_info("layers"), parameters);
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
  std::size_t changed = then_words(parameters) == then_words(usual) ? 0 : 1;
  for (const ParameterInfo& row : parameter_table())
    if (row.in_session && row.name != "method" && row.name != "metric" && row.to_text(parameters) != row.to_text(usual)) ++changed;
  return changed == 0 ? "all usual" : fmt::format("{} changed", changed);
}

void draw_settings(PanelContext& context, const RunView& run) {
  const RunParameters& parameters = run.parameters;
  if (run.input) draw_target(context, run);
  draw_composite(context, run);
  draw_options(context, run);
  if (context.session.input) draw_standing(context, *context.session.input, parameters);
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
