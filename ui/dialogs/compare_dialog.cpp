// Dialog that chooses methods and metrics of runs to be compared with the active one.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "core/base/words.h"
#include "core/smooth/execution/method_table.h"
#include "ui/panels/panels.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// Sets the choice to the active run's method and metric.
void begin(CompareDialog& dialog, const RunView& run) {
  dialog.methods = {run.parameters.method};
  dialog.metrics = {std::string(info(run.parameters.metric).name)};
}

void tick(std::set<std::string>& chosen, const std::string& name, bool on) {
  if (on)
    chosen.insert(name);
  else
    chosen.erase(name);
}

void draw_methods(PanelContext& context, CompareDialog& dialog) {
  heading(context, "Methods");
  for (const MethodInfo& method : method_table()) {
    const std::string name(method.name);
    bool on = dialog.methods.contains(name);
    const bool possible = !(method.planar_only && context.session.input->is_volume());
    ImGui::BeginDisabled(!possible);
    if (ImGui::Checkbox(name.c_str(), &on)) tick(dialog.methods, name, on);
    ImGui::EndDisabled();
    note_item(context, "compare:" + name, std::string(method.doc));
  }
}

void draw_metrics(PanelContext& context, CompareDialog& dialog) {
  heading(context, "Metrics");
  for (const Metric metric : context.derived.metrics) {
    const std::string name(info(metric).name);
    bool on = dialog.metrics.contains(name);
    if (ImGui::Checkbox(context.shown(info(metric).title).c_str(), &on)) tick(dialog.metrics, name, on);
    note_item(context, "compare:" + name, std::string(info(metric).doc));
  }
}

/// Commands for the runs besides the active one: every chosen method with every chosen metric.
std::vector<std::string> chosen_runs(const CompareDialog& dialog, const RunView& active) {
  std::vector<std::string> runs;
  for (const MethodInfo& method : method_table())
    for (const std::string& metric : dialog.metrics) {
      const bool is_active = active.parameters.method == method.name && info(active.parameters.metric).name == metric;
      if (dialog.methods.contains(std::string(method.name)) && !is_active) runs.push_back(fmt::format("{}:{}", method.name, metric));
    }
  return runs;
}

void send_all(PanelContext& context, const CompareDialog& dialog, const std::vector<std::string>& runs) {
  std::string line = "compare with";
  for (const std::string& run : runs) line += " " + quote_word(run);
  context.send(line + (dialog.until_converged ? std::string(" converged") : fmt::format(" {}", dialog.iterations)));
}

void draw_presets(PanelContext& context, CompareDialog& dialog, const RunView& run) {
  if (ImGui::SmallButton("The paper's Fig. 4")) {
    dialog.methods = {"dmo", "laplace", "dvr"};
    if (!context.session.input->is_volume()) dialog.methods.insert("angle-based");
    dialog.metrics = {std::string(info(run.parameters.metric).name)};
    dialog.until_converged = true;
  }
  note_item(context, "compare:figure-4", "DMO, Laplace, angle-based and derivative-free smoothing, each until it converges");
  ImGui::SameLine();
  if (ImGui::SmallButton("All methods"))
    for (const MethodInfo& method : method_table()) dialog.methods.insert(std::string(method.name));
  context.items.record_last("compare:all-methods");
  ImGui::SameLine();
  if (ImGui::SmallButton("All metrics"))
    for (const Metric metric : context.derived.metrics) dialog.metrics.insert(std::string(info(metric).name));
  context.items.record_last("compare:all-metrics");
}

}  // namespace

void draw_compare_dialog(PanelContext& context) {
  CompareDialog& dialog = context.widgets.compare;
  const RunView* run = context.run();
  if (!begin_dialog(context, "Compare", 34)) return;
  if (run == nullptr) {
    dim_text(context, "Open a mesh first.");
    close_button(context, "Close");
    return end_dialog();
  }
  if (context.widgets.dialog_opened) begin(dialog, *run);
  dim_text(context, "Every chosen method is run with every chosen metric. Each run starts from the input; existing runs stay.");
  draw_presets(context, dialog, *run);
  const std::size_t rows = std::max(method_table().size(), context.derived.metrics.size());
  const float half = ImGui::GetContentRegionAvail().x / 2, wanted = static_cast<float>(rows + 1) * ImGui::GetFrameHeightWithSpacing();
  const float most = ImGui::GetIO().DisplaySize.y - 18 * context.em();
  const ImVec2 list{half - context.px(8), std::clamp(most, 6 * context.em(), wanted)};
  if (ImGui::BeginChild("methods", list)) draw_methods(context, dialog);
  ImGui::EndChild();
  ImGui::SameLine(half);
  if (ImGui::BeginChild("metrics", list)) draw_metrics(context, dialog);
  ImGui::EndChild();
  ImGui::Checkbox("until they converge", &dialog.until_converged);
  context.items.record_last("compare:converged");
  if (!dialog.until_converged) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(9 * context.em());
    if (ImGui::InputInt("iterations", &dialog.iterations, 1, 10)) dialog.iterations = std::clamp(dialog.iterations, 1, 1'000'000);
    context.items.record_last("compare:iterations");
  }
  const std::vector<std::string> runs = chosen_runs(dialog, *run);
  constexpr std::size_t kMost = 64;
  dim_text(context, runs.empty()          ? std::string("Choose a method or metric that the current run does not have.")
                    : runs.size() > kMost ? fmt::format("{} runs: at most {} can be compared.", runs.size(), kMost)
                                          : fmt::format("{} beside the current one", counted(runs.size(), "run", "runs")));
  ImGui::BeginDisabled(runs.empty() || runs.size() > kMost || context.activity.busy);
  if (ImGui::Button("Run and compare")) {
    send_all(context, dialog, runs);
    context.state.dialog = Dialog::None;
  }
  ImGui::EndDisabled();
  context.items.record_last("compare:go");
  ImGui::SameLine();
  close_button(context, "Cancel");
  end_dialog();
}

}  // namespace dmoscope::ui
