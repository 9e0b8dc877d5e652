// Dialog for a person's own metric: a formula that is checked while it is typed, with its picture; and the target shape of the elements.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include "core/formula/vocabulary.h"
#include "core/quality/defined_metric.h"
#include "render/colour_map.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {

namespace {

constexpr const char* kFirst = "2*det/norm^2";

/// Starts the dialog with the formula of the active run's metric.
void begin(FormulaDialog& dialog, const RunView* run) {
  const Metric metric = run != nullptr ? run->parameters.metric : Metric::MeanRatio;
  if (is_built_in(metric)) {
    if (dialog.text.empty()) dialog.text = kFirst;
    dialog.target = "ideal";
    return;
  }
  dialog.text = defined(metric).formula->text();
  dialog.target = to_text(target_of(metric));
}

/// Draws a list of texts to begin with.
void draw_examples(PanelContext& context) {
  FormulaDialog& dialog = context.widgets.formula;
  ImGui::SetNextItemWidth(14 * context.em());
  if (ImGui::BeginCombo("##examples", "start from an example")) {
    const auto choice = [&](std::string_view title, std::string_view text) {
      if (ImGui::Selectable(std::string(title).c_str())) dialog.text = text;
    };
    for (const MetricInfo& metric : metric_table()) choice(metric.title, formula_of(metric.metric));
    for (const NamedFormula& named : named_formulas()) choice(named.title, named.formula);
    ImGui::EndCombo();
  }
  context.items.record_last("formula:examples");
}

void draw_names(PanelContext& context) {
  if (!ImGui::BeginChild("names", {0, 7.5F * context.em()}, true)) return ImGui::EndChild();
  ImGui::PushTextWrapPos(0);
  const auto line = [&](std::string_view name, std::string_view doc) {
    ImGui::TextUnformatted(std::string(name).c_str());
    ImGui::SameLine(9 * context.em());
    dim_text(context, std::string(doc));
  };
  line("p1, p2, …; l12, …", "corners; lengths between them");
  for (const FormulaName& name : formula_names())
    line(name.name, fmt::format("{}{}",
                                name.scope == NameScope::Corner ? "corner: "
                                : name.scope == NameScope::Edge ? "edge: "
                                                                : "",
                                name.doc));
  for (const FormulaFunction& f : formula_functions()) line(fmt::format("{}({})", f.name, f.arguments), f.doc);
  ImGui::PopTextWrapPos();
  ImGui::EndChild();
}

void draw_verdict(PanelContext& context, const FormulaCheck& check) {
  ImGui::PushTextWrapPos(0);
  if (!check.error.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.error));
    const std::string line = check.place && check.place->line > 1 ? fmt::format("line {}, ", check.place->line) : std::string();
    ImGui::TextUnformatted(check.place ? fmt::format("{}column {}: {}", line, check.place->column, check.error).c_str()
                                       : check.error.c_str());
    ImGui::PopStyleColor();
  } else {
    ImGui::TextUnformatted(fmt::format("for {}", check.kinds).c_str());
    dim_text(context, check.summary);
    for (const std::string& warning : check.warnings) {
      ImGui::PushStyleColor(ImGuiCol_Text, colour_vector(context.palette.warning));
      ImGui::TextUnformatted(warning.c_str());
      ImGui::PopStyleColor();
    }
    if (check.warnings.empty()) dim_text(context, "higher is better: 1 at best, 0 or less for inverted elements");
  }
  ImGui::PopTextWrapPos();
}

/// Draws the metric over the free corner, in the window's colours; values of 0 or less look like inverted elements.
void draw_picture(PanelContext& context, const FormulaCheck& check) {
  const float width = ImGui::GetContentRegionAvail().x, height = 0.75F * width;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy({width, height});
  context.items.record_last("formula:picture");
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + height}, colour(context.palette.raised));
  if (!check.picture) return;
  const FormulaPicture& picture = *check.picture;
  const auto pixel = [&](double x, double y) {
    return ImVec2{corner.x + static_cast<float>((x - picture.low_x) / (picture.high_x - picture.low_x)) * width,
                  corner.y + height - static_cast<float>((y - picture.low_y) / (picture.high_y - picture.low_y)) * height};
  };
  const render::ColourScale scale{.map = context.state.colour_map, .high = std::max(1.0, std::min(picture.greatest, 10.0))};
  const double dx = (picture.high_x - picture.low_x) / picture.columns, dy = (picture.high_y - picture.low_y) / picture.rows;
  for (int row = 0; row < picture.rows; ++row)
    for (int column = 0; column < picture.columns; ++column) {
      const float value = picture.values[static_cast<std::size_t>(row * picture.columns + column)];
      const render::Rgb ink = value > 0.0F ? scale.colour(value) : context.palette.raised;
      const double x = picture.low_x + column * dx, y = picture.low_y + row * dy;
      list.AddRectFilled(pixel(x, y + dy), pixel(x + dx, y), colour(ink));
    }
  for (std::size_t i = 0; i < picture.corners.size(); ++i) {
    const auto [ax, ay] = picture.corners[i];
    if (i + 1 < picture.corners.size())
      list.AddLine(pixel(ax, ay), pixel(picture.corners[i + 1].first, picture.corners[i + 1].second), colour(context.palette.text),
                   context.px(2));
    list.AddCircleFilled(pixel(ax, ay), context.px(4), colour(context.palette.text));
  }
}

void draw_target(PanelContext& context) {
  FormulaDialog& dialog = context.widgets.formula;
  ImGui::TextUnformatted("against");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(std::max(8 * context.em(), ImGui::GetContentRegionAvail().x - 10 * context.em()));
  ImGui::InputText("##target", &dialog.target);
  note_item(context, "formula:target", std::string("target shape: ") + std::string(kTargetHelp));
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##targets", "choose", ImGuiComboFlags_NoPreview)) {
    if (context.session.input)
      for (const TargetChoice& one : context.widgets.target_choices.of(context.session.input)) {
        if (ImGui::Selectable(one.title.c_str(), one.text == dialog.target)) dialog.target = one.text;
        next_item_tooltip(one.doc);
      }
    ImGui::EndCombo();
  }
  context.items.record_last("formula:targets");
}

}  // namespace

void draw_formula_dialog(PanelContext& context) {
  FormulaDialog& dialog = context.widgets.formula;
  if (context.widgets.dialog_opened) begin(dialog, context.run());
  if (!begin_dialog(context, "A metric of your own", 58)) return;
  const float left = 0.56F * ImGui::GetContentRegionAvail().x;
  ImGui::BeginGroup();
  ImGui::PushItemWidth(left);
  if (context.widgets.dialog_opened) ImGui::SetKeyboardFocusHere();
  ImGui::InputTextMultiline("##formula", &dialog.text, {left, 8 * context.em()});
  context.items.record_last("formula:text");
  ImGui::PopItemWidth();
  if (dialog.check.text != dialog.text) dialog.check = check_formula(dialog.text);
  if (ImGui::BeginChild("verdict", {left, 6.5F * context.em()})) draw_verdict(context, dialog.check);
  ImGui::EndChild();
  ImGui::EndGroup();
  ImGui::SameLine(0, context.em());
  ImGui::BeginGroup();
  draw_picture(context, dialog.check);
  dim_text(context, dialog.check.picture ? fmt::format("above the last corner of a {}", info(dialog.check.picture->kind).name) : " ",
           false);
  ImGui::EndGroup();
  draw_examples(context);
  ImGui::SameLine(0, context.em());
  draw_target(context);
  draw_names(context);
  const bool usable = dialog.check.error.empty() && context.session.input != nullptr;
  const std::string name = dialog.check.name + (dialog.target.empty() || dialog.target == "ideal" ? "" : "@" + dialog.target);
  ImGui::BeginDisabled(!usable || context.activity.busy);
  if (ImGui::Button("Optimise with it")) {
    context.send("metric " + quote_word(name));
    context.state.dialog = Dialog::None;
  }
  context.items.record_last("formula:optimise");
  ImGui::SameLine();
  if (ImGui::Button("Show it")) {
    context.send("show " + quote_word(name));
    context.state.dialog = Dialog::None;
  }
  context.items.record_last("formula:show");
  ImGui::EndDisabled();
  ImGui::SameLine();
  close_button(context, "Close");
  end_dialog();
}

}  // namespace dmoscope::ui
