#include "ui/plot_commands.h"

#include "ui/command_words.h"

namespace dmoscope::ui {
namespace {

ValueAxis next_axis(PlotTab tab, ValueAxis axis) {
  do {
    axis = static_cast<ValueAxis>((static_cast<std::size_t>(axis) + 1) % kValueAxes.size());
  } while (!offers(tab, axis));
  return axis;
}

void choose_axis(ViewState& state, ValueAxis axis) {
  if (!offers(state.plot, axis)) throw UsageError("log-distance is for plots of quality: convergence and sorted");
  PlotView& view = state.plot_view();
  if (view.axis != axis) view.y_range.reset();
  view.axis = axis;
}

std::pair<double, double> parse_range(const std::string& low, const std::string& high) {
  const std::pair range{to_number(low), to_number(high)};
  if (!(range.second > range.first)) throw UsageError("the second value must be greater than the first");
  return range;
}

void zoom_plot(ViewState& state, Arguments words) {
  PlotView& view = state.plot_view();
  if (words.size() == 1 && words[0] == "all") {
    view.x_range.reset();
    view.y_range.reset();
    return;
  }
  need(words, 3, 5);
  if (words[0] == "box") {
    need(words, 5, 5);
    const auto x = parse_range(words[1], words[2]), y = parse_range(words[3], words[4]);
    view.x_range = x;
    view.y_range = y;
    return;
  }
  need(words, 3, 3);
  static constexpr std::array<std::pair<std::string_view, std::optional<std::pair<double, double>> PlotView::*>, 2> axes{
      {{"x", &PlotView::x_range}, {"y", &PlotView::y_range}}};
  view.*choose(words[0], axes) = parse_range(words[1], words[2]);
}

void switch_series(ViewState& state, Arguments words) {
  need(words, 1, 2);
  std::set<std::string>& hidden = state.plot_view().hidden;
  if (words[0] == "all") {
    if (words.size() > 1 && words[1] != "on") unexpected(words[1], "on");
    hidden.clear();
    return;
  }
  if (switched(words, 1, !hidden.contains(words[0]))) {
    hidden.erase(words[0]);
  } else {
    hidden.insert(words[0]);
  }
}

}  // namespace

void add_plot_verbs(CommandTable& table, ViewState& state) {
  table.add({"plot", "plot convergence|histogram|sorted|moved|time", "which plot is shown"}, [&state](Arguments words) {
    need(words, 1, 1);
    state.plot = choose(words[0], kPlotTabs);
  });
  table.add({"axis", "axis linear|log|log-distance|next", "the shown plot's value axis; log-distance: by the logarithm of 1 - quality"},
            [&state](Arguments words) {
              need(words, 1, 1);
              choose_axis(state, words[0] == "next" ? next_axis(state.plot, state.plot_view().axis) : choose(words[0], kValueAxes));
            });
  table.add({"log-scale", "log-scale [on|off|toggle]", "the shown plot's value axis, logarithmic or linear"}, [&state](Arguments words) {
    need(words, 0, 1);
    choose_axis(state, switched(words, 0, state.plot_view().axis == ValueAxis::Log) ? ValueAxis::Log : ValueAxis::Linear);
  });
  table.add({"plot-x", "plot-x iteration|seconds|toggle", "what runs along the plots of a run's course"}, [&state](Arguments words) {
    need(words, 1, 1);
    static constexpr std::array<std::pair<std::string_view, bool>, 2> names{{{"iteration", false}, {"seconds", true}}};
    const bool before = state.plot_options.by_seconds;
    state.plot_options.by_seconds = words[0] == "toggle" ? !before : choose(words[0], names);
    if (state.plot_options.by_seconds == before) return;
    for (const auto& [name, tab] : kPlotTabs) {
      if (over_iterations(tab)) state.plots[static_cast<std::size_t>(tab)].x_range.reset();
    }
  });
  table.add({"plot-zoom", "plot-zoom all | x LOW HIGH | y LOW HIGH | box X0 X1 Y0 Y1", "the part of the plot that is shown"},
            [&state](Arguments words) { zoom_plot(state, words); });
  table.add({"plot-series", "plot-series NAME [on|off|toggle]  or  plot-series all", "shows or hides a name of the plot's legend"},
            [&state](Arguments words) { switch_series(state, words); });
  table.add({"plot-bins", "plot-bins 16|32|64", "bars of the histogram"}, [&state](Arguments words) {
    need(words, 1, 1);
    static constexpr std::array<std::pair<std::string_view, int>, 3> counts{{{"16", 16}, {"32", 32}, {"64", 64}}};
    state.plot_options.bins = choose(words[0], counts);
  });
}

}  // namespace dmoscope::ui
