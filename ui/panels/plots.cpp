// Bottom: plots above the timeline.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/format.h"
#include "ui/panels/panels.h"

namespace dmoscope::ui {
namespace {

/// Values that can be plotted: infinity stands for "there is no such element".
double finite_or_gap(double value) { return std::isfinite(value) ? value : NAN; }

std::vector<Series> convergence_series(const PanelContext& context) {
  std::vector<Series> all;
  const auto& runs = context.session.runs;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const RunView& run = runs[k];
    const std::string prefix = runs.size() == 1 ? "" : fmt::format("{} {} ", k + 1, run.parameters.method);
    const render::Rgb ink = context.palette.runs[k % 8];
    const float thick = k == context.session.active ? 2.2F : 1.5F;
    Series minimum{prefix + "minimum", ink, {}, {}, Series::Kind::Line, 0, thick, 1.0F, false};
    Series movable{prefix + "movable minimum", ink, {}, {}, Series::Kind::Line, 0, thick, 1.0F, true};
    Series mean{prefix + "mean", ink, {}, {}, Series::Kind::Line, 0, 1.2F, 0.7F, false};
    bool movable_differs = false;
    for (const IterationRecord& record : run.records) {
      const auto x = static_cast<double>(record.iteration);
      for (Series* series : {&minimum, &movable, &mean}) series->x.push_back(x);
      minimum.y.push_back(finite_or_gap(record.statistics.minimum));
      movable.y.push_back(finite_or_gap(record.statistics.movable_minimum));
      mean.y.push_back(finite_or_gap(record.statistics.mean));
      movable_differs = movable_differs || record.statistics.movable_minimum != record.statistics.minimum;
    }
    all.push_back(std::move(minimum));
    if (movable_differs) all.push_back(std::move(movable));
    all.push_back(std::move(mean));
  }
  return all;
}

/// What every iteration but the input's has one value of.
template <class Value>
std::vector<Series> course_series(const PanelContext& context, Value value) {
  std::vector<Series> all;
  const auto& runs = context.session.runs;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::string name = runs.size() == 1 ? runs[k].parameters.method : fmt::format("{} {}", k + 1, runs[k].parameters.method);
    Series series{name, context.palette.runs[k % 8], {}, {}, Series::Kind::Line, 0, k == context.session.active ? 2.2F : 1.5F, 1.0F, false};
    for (const IterationRecord& record : runs[k].records) {
      if (record.iteration == 0) continue;
      series.x.push_back(static_cast<double>(record.iteration));
      series.y.push_back(finite_or_gap(value(record)));
    }
    all.push_back(std::move(series));
  }
  return all;
}

Series bars(const Histogram& histogram, std::string name, render::Rgb ink, float alpha) {
  Series series{std::move(name), ink, {}, {}, Series::Kind::Bars, 0, 1.0F, alpha, false};
  series.bar_width = (histogram.highest - histogram.lowest) / static_cast<double>(Histogram::kBins);
  for (std::size_t k = 0; k < Histogram::kBins; ++k) {
    series.x.push_back(histogram.lowest + static_cast<double>(k) * series.bar_width);
    series.y.push_back(static_cast<double>(histogram.counts[k]));
  }
  return series;
}

Series sorted(const std::vector<double>& values, std::string name, render::Rgb ink, float alpha) {
  Series series{std::move(name), ink, {}, values, Series::Kind::Line, 0, 2.0F, alpha, false};
  for (std::size_t k = 0; k < values.size(); ++k) {
    series.x.push_back(100.0 * static_cast<double>(k) / static_cast<double>(std::max<std::size_t>(1, values.size() - 1)));
  }
  return series;
}

/// The plotted numbers as comma separated values.
std::string as_csv(const PlotSpec& spec, const std::vector<Series>& series) {
  std::string text = "series," + (spec.hover_x.empty() ? "x" : spec.hover_x) + ",value\n";
  for (const Series& one : series) {
    for (std::size_t k = 0; k < one.x.size(); ++k)
      text += fmt::format("{},{},{}\n", one.name, full_number(one.x[k]), full_number(one.y[k]));
  }
  return text;
}

PlotSpec describe(const PanelContext& context, std::vector<Series>& series) {
  PlotSpec spec;
  const Frame* frame = context.frame();
  switch (context.state.plot) {
    case PlotTab::Convergence: {
      spec = {"convergence", "iteration", "quality", true, {}, {}, {}, "open a mesh and run to see how its quality rises", "iteration"};
      series = convergence_series(context);
      if (const RunView* run = context.run()) {
        spec.y_title = metric_phrase(run->parameters.metric);
        if (run->records.size() > 1) spec.x_mark = static_cast<double>(run->moment.iteration);
      }
      break;
    }
    case PlotTab::Histogram: {
      spec = {"histogram", "quality", "elements", false, {}, {}, {}, "open a mesh to see its qualities", "quality"};
      if (frame == nullptr) break;
      spec.x_title = metric_phrase(frame->shown);
      if (frame->moment != Moment{}) {
        series.push_back(bars(frame->before, "at the input", context.palette.dim, 0.55F));
        series.push_back(bars(frame->now, "now", context.palette.runs[frame->run % 8], 0.75F));
      } else {
        series.push_back(bars(frame->now, "at the input", context.palette.runs[frame->run % 8], 0.9F));
      }
      if (frame->now.below > 0) spec.y_title += fmt::format(" ({} below {})", count(frame->now.below), short_number(frame->now.lowest));
      break;
    }
    case PlotTab::Sorted: {
      spec = {"sorted", "share of elements, %", "quality", false, std::pair{0.0, 100.0}, {}, {}, "open a mesh to see its qualities",
              "percent"};
      if (frame == nullptr || context.derived.sorted_now.empty()) break;
      spec.y_title = metric_phrase(frame->shown);
      if (frame->moment != Moment{}) series.push_back(sorted(context.derived.sorted_before, "at the input", context.palette.dim, 1.0F));
      series.push_back(sorted(context.derived.sorted_now, "now", context.palette.runs[frame->run % 8], 1.0F));
      break;
    }
    case PlotTab::Moved:
      spec = {"moved", "iteration", "vertices moved", true, {}, {}, {}, "run to see how many vertices move", "iteration"};
      series = course_series(context, [](const IterationRecord& record) { return static_cast<double>(record.moved); });
      break;
    case PlotTab::Time:
      spec = {"time", "iteration", "seconds of smoothing", true, {}, {}, {}, "run to see how long it takes", "iteration"};
      series = course_series(context, [](const IterationRecord& record) { return record.seconds; });
      break;
  }
  return spec;
}

void tab_button(PanelContext& context, const char* id, const char* label, bool active) {
  if (active) ImGui::PushStyleColor(ImGuiCol_Button, colour_vector(context.palette.accent, 0.25F));
  if (!active) ImGui::PushStyleColor(ImGuiCol_Button, ImVec4{0, 0, 0, 0});
  action_button(context, id, label);
  ImGui::PopStyleColor();
}

}  // namespace

void draw_plots(PanelContext& context, const Rect& rect) {
  if (rect.empty()) return;
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {context.px(12), context.px(6)});
  begin_panel("plots", rect);
  ImGui::PopStyleVar();
  ViewState& state = context.state;
  tab_button(context, "plot-convergence", "Convergence", state.plot == PlotTab::Convergence);
  ImGui::SameLine(0, context.px(4));
  tab_button(context, "plot-histogram", "Histogram", state.plot == PlotTab::Histogram);
  ImGui::SameLine(0, context.px(4));
  tab_button(context, "plot-sorted", "Sorted", state.plot == PlotTab::Sorted);
  ImGui::SameLine(0, context.px(4));
  tab_button(context, "plot-moved", "Moved", state.plot == PlotTab::Moved);
  ImGui::SameLine(0, context.px(4));
  tab_button(context, "plot-time", "Time", state.plot == PlotTab::Time);
  std::vector<Series> series;
  const PlotSpec spec = describe(context, series);

  const ImGuiStyle& look = ImGui::GetStyle();
  const float right = ImGui::GetFrameHeight() + look.ItemInnerSpacing.x + ImGui::CalcTextSize("log").x + context.px(12) +
                      ImGui::CalcTextSize("Copy data").x + 2 * look.FramePadding.x;
  ImGui::SameLine(rect.w - context.px(12) - right);
  bool logarithmic = state.plot_view().axis == ValueAxis::Log;
  if (ImGui::Checkbox("log", &logarithmic)) context.send(logarithmic ? "log-scale on" : "log-scale off");
  context.items.record_last("log-scale");
  next_item_tooltip("logarithmic value axis; values of 0 and below are gaps");
  ImGui::SameLine(0, context.px(12));
  ImGui::BeginDisabled(series.empty());
  if (ImGui::Button("Copy data")) state.requests.clipboard = as_csv(spec, series);
  context.items.record_last("copy-plot");
  ImGui::EndDisabled();
  next_item_tooltip("the plotted numbers as comma separated values, on the clipboard");

  const float timeline = ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("plot area", {0, std::max(1.0F, ImGui::GetContentRegionAvail().y - timeline)}, false,
                    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  const auto clicked = draw_plot(spec, series, state.plot_view(), context.palette, state.scale);
  ImGui::EndChild();
  if (clicked && state.plot == PlotTab::Convergence && !context.activity.busy) {
    if (const RunView* run = context.run()) {
      const auto last = static_cast<double>(run->records.empty() ? 0 : run->records.back().iteration);
      context.send(fmt::format("seek {}", static_cast<long long>(std::llround(std::clamp(*clicked, 0.0, last)))));
    }
  }
  draw_timeline(context);
  end_panel();
}

}  // namespace dmoscope::ui
