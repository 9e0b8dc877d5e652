// Left: the runs and the parameters of the active one.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/run/left_inverted.h"
#include "core/smooth/execution/method_table.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr int kLargestSeed = 1 << 30;  // that can be entered

/// A title in one line, or, where it is too long, in two, the first of which ends with one of its parts.
std::vector<std::string> in_lines(const std::string& title, float first_room, float room) {
  const auto width = [](const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; };
  if (width(title) <= first_room) return {title};
  std::size_t end = std::string::npos;
  for (std::size_t at = title.find(' '); at != std::string::npos; at = title.find(' ', at + 1)) {
    if (width(title.substr(0, at)) > first_room) break;
    if (!title.substr(at).starts_with(" ·")) end = at;  // which would begin the second line
  }
  if (end == std::string::npos) return {fit_text(title, first_room)};
  return {title.substr(0, end), fit_text(title.substr(end + 1), room)};
}

void draw_run_row(PanelContext& context, std::size_t k) {
  const RunView& run = context.session.runs[k];
  ImGui::PushID(static_cast<int>(k));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight(), pad = context.px(4);
  const float width = ImGui::GetContentRegionAvail().x;
  const bool active = k == context.session.active;
  const float bar = context.px(4);
  const std::string iteration = fmt::format("it {}", count(run.moment.iteration));
  const float iteration_width = ImGui::CalcTextSize(iteration.c_str()).x;
  const std::vector<std::string> title = in_lines(run.title, width - iteration_width - bar - context.px(24), width - bar - context.px(12));
  const float height = static_cast<float>(title.size() + 1) * line;
  if (ImGui::Selectable("##run", active, 0, {0, height + 3 * pad})) context.send(fmt::format("select-run {}", k + 1));
  context.items.record_last(fmt::format("run:{}", k));
  std::string tip = run.title;
  if (!run.last_outcome.empty()) tip += "\n" + run.last_outcome;
  if (run.summary && run.summary->sizes.known())
    tip += "\ncorrelation of edge length and target size: " +
           size_course_text(run.summary->sizes.before.sizes, run.summary->sizes.after.sizes);
  next_item_tooltip(tip);
  if (ImGui::BeginPopupContextItem("run menu")) {
    if (ImGui::MenuItem("Remove", nullptr, false, context.session.runs.size() > 1 && !context.activity.busy)) {
      context.send(fmt::format("remove-run {}", k + 1));
    }
    ImGui::EndPopup();
  }
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled({at.x, at.y + pad}, {at.x + bar, at.y + height + 2 * pad}, colour(context.palette.run(k)), bar / 2);
  const float text = at.x + bar + context.px(8);
  for (std::size_t row = 0; row < title.size(); ++row)
    list.AddText({text, at.y + pad + static_cast<float>(row) * line}, colour(context.palette.text), title[row].c_str());
  list.AddText({at.x + width - iteration_width - pad, at.y + pad}, colour(context.palette.dim), iteration.c_str());
  if (!run.records.empty()) {
    const IterationRecord* record = &run.records.back();
    for (const IterationRecord& one : run.records) {
      if (one.iteration == run.moment.iteration) record = &one;
    }
    // In the midst of an iteration, and after edits, the record is of another moment.
    const Frame* frame = context.frame();
    const bool shown = frame != nullptr && frame->run == k && active && frame->moment == run.moment;  // not a mark of before
    const Statistics& statistics = shown ? frame->statistics : record->statistics;
    const std::string facts = fmt::format("min {}  mean {}", short_number(statistics.minimum), short_number(statistics.mean));
    list.AddText({text, at.y + height - line + 1.5F * pad}, colour(context.palette.dim),
                 fit_text(facts, width - bar - context.px(12)).c_str());
  }
  ImGui::PopID();
}

void draw_method(PanelContext& context, const RunParameters& parameters) {
  labelled(context, "method", "how vertices are moved");
  const bool open = ImGui::BeginCombo("##method", parameters.method.c_str());
  context.items.record_last("method");
  if (!open) return;
  for (const MethodInfo& method : method_table()) {
    if (ImGui::Selectable(std::string(method.name).c_str(), method.name == parameters.method)) {
      context.send(fmt::format("method {}", method.name));
    }
    context.items.record_last(fmt::format("method:{}", method.name));
    next_item_tooltip(method.optimises ? std::string(method.doc) : fmt::format("{}; {}", method.doc, kMayMakeWorse));
  }
  ImGui::EndCombo();
}

/// Of a method that promises nothing.
void draw_method_note(PanelContext& context, const RunParameters& parameters) {
  if (method_info(parameters.method).optimises) return;
  ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.warning));
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(fmt::format("{}; Best goes back to the best iteration", kMayMakeWorse).c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  context.items.record_last("method-note");
}

/// Sends `command X` when another number was entered.
void real(PanelContext& context, const char* item, double value) {
  double edited = value;
  ImGui::InputDouble(fmt::format("##{}", item).c_str(), &edited, 0, 0, "%.4g");
  context.items.record_last(item);
  if (ImGui::IsItemDeactivatedAfterEdit() && edited != value) context.send(fmt::format("{} {}", item, full_number(edited)));
}

/// What may be chosen, one of a few words.
void choice(PanelContext& context, const ParameterInfo& row, const std::string& now) {
  const std::string item(row.name);
  const bool open = ImGui::BeginCombo(("##" + item).c_str(), now.c_str());
  context.items.record_last(item);
  if (!open) return;
  for (const std::string_view word : row.choices) {
    if (ImGui::Selectable(std::string(word).c_str(), word == now)) context.send(fmt::format("{} {}", item, word));
    context.items.record_last(fmt::format("{}:{}", item, word));
  }
  ImGui::EndCombo();
}

void draw_parameter(PanelContext& context, const ParameterInfo& row, const RunParameters& parameters) {
  const std::string command(row.name), item(row.item.empty() ? row.name : row.item), now = row.to_text(parameters);
  labelled(context, std::string(row.title).c_str(), row.help().c_str());
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

/// What the run's method can be told, and nothing else.
void draw_options(PanelContext& context, const RunParameters& parameters) {
  for (const ParameterInfo& row : parameter_table())
    if (row.in_session && row.reader != nullptr && row.read_by(parameters)) draw_parameter(context, row, parameters);
}

void draw_backend(PanelContext& context, const RunView& run) {
  labelled(context, "backend", "what smooths: the processor, a CUDA device, or the best there is (auto)");
  const Backend chosen = run.parameters.backend;
  const std::string shown = chosen == Backend::Auto ? fmt::format("auto: {}", name(run.backend)) : std::string(name(chosen));
  const bool open = ImGui::BeginCombo("##backend", shown.c_str());
  context.items.record_last("backend");
  next_item_tooltip(run.backend_reason);
  if (!open) return;
  for (const Backend backend : {Backend::Auto, Backend::Cpu, Backend::Cuda}) {
    const std::string word(name(backend));
    if (ImGui::Selectable(word.c_str(), backend == chosen)) context.send("backend " + word);
    context.items.record_last("backend:" + word);
  }
  ImGui::EndCombo();
}

/// Of a mesh that has any.
void draw_interfaces(PanelContext& context, const RunParameters& parameters) {
  if (!context.session.input || !context.session.input->interfaces.any()) return;
  labelled(context, "interfaces", "whether what lies between materials, and on lines, faces and points that the file names, stays");
  const bool open = ImGui::BeginCombo("##interfaces", std::string(name(parameters.interfaces)).c_str());
  context.items.record_last("interfaces");
  const bool fixed = parameters.interfaces == InterfaceRule::Fixed;
  next_item_tooltip(fixed ? context.derived.interfaces : context.derived.free_interfaces);
  if (!open) return;
  for (const InterfaceRule rule : {InterfaceRule::Fixed, InterfaceRule::Free}) {
    const std::string word(name(rule));
    if (ImGui::Selectable(word.c_str(), rule == parameters.interfaces)) context.send("interfaces " + word);
    context.items.record_last("interfaces:" + word);
  }
  ImGui::EndCombo();
}

void draw_order(PanelContext& context, const RunParameters& parameters) {
  labelled(context, "order", "in which order an iteration visits the vertices, before colouring");
  const bool shuffled = parameters.order.seed.has_value();
  const bool open = ImGui::BeginCombo("##order", shuffled ? "shuffled" : "natural");
  context.items.record_last("order");
  if (open) {
    if (ImGui::Selectable("natural", !shuffled)) context.send("order natural");
    if (ImGui::Selectable("shuffled", shuffled)) context.send("order shuffle:1");
    ImGui::EndCombo();
  }
  if (!shuffled) return;
  labelled(context, "seed", "of the shuffled order");
  integer(context, "seed", static_cast<int>(*parameters.order.seed), 0, kLargestSeed, "order shuffle:");
}

}  // namespace

void draw_runs(PanelContext& context) {
  heading(context, "Runs");
  ImGui::SameLine();
  const char* add = "+ add";
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::CalcTextSize(add).x - 2 * ImGui::GetStyle().FramePadding.x);
  const RunView* run = context.run();
  ImGui::BeginDisabled(run == nullptr || context.activity.busy);
  if (ImGui::SmallButton(add)) ImGui::OpenPopup("add run");
  context.items.record_last("add-run");
  ImGui::EndDisabled();
  next_item_tooltip("another run on the same input, to compare with");
  if (ImGui::BeginPopup("add run")) {
    dim_text(context, "new run: metric to optimise", false);
    for (const Metric metric : context.derived.metrics) {
      if (ImGui::MenuItem(metric_title(metric).c_str())) {
        context.send(fmt::format("add-run {}:{}", run->parameters.method, info(metric).name));
      }
    }
    ImGui::EndPopup();
  }
  if (context.session.runs.empty()) dim_text(context, "none yet: open a mesh");
  for (std::size_t k = 0; k < context.session.runs.size(); ++k) draw_run_row(context, k);
}

void draw_parameters(PanelContext& context) {
  heading(context, "Parameters");
  const RunView* run = context.run();
  if (run == nullptr) {
    dim_text(context, "of the run that is selected");
    return;
  }
  const RunParameters& parameters = run->parameters;
  ImGui::BeginDisabled(context.activity.busy);
  draw_method(context, parameters);
  draw_method_note(context, parameters);
  if (method_info(parameters.method).optimises)
    labelled(context, "optimises", "the metric whose minimum over each star the method raises");
  else
    labelled(context, "judged by", "the metric of the run's statistics; the method goes by none");
  metric_combo(context, "metric", parameters.metric, "metric");
  draw_composite(context, *run);
  draw_options(context, parameters);
  draw_interfaces(context, parameters);
  draw_order(context, parameters);
  draw_backend(context, *run);
  labelled(context, "threads", "of this computer that smooth; the result does not depend on it");
  integer(context, "threads", static_cast<int>(context.session.threads), 1, 1024, "threads");
  ImGui::EndDisabled();
  if (run->moment != Moment{} || run->edits > 0) {
    dim_text(context, "A change starts a new run beside this one.");
  }
}

}  // namespace dmoscope::ui
