#include "core/view/run_table.h"
#include "ui/commands/command_words.h"
#include "ui/state/view_options.h"

namespace dmoscope::ui {
namespace {

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
  require(words, 2, 5);
  if (words[0] == "box") {
    require(words, 5, 5);
    const auto x = parse_range(words[1], words[2]), y = parse_range(words[3], words[4]);
    view.x_range = x;
    view.y_range = y;
    return;
  }
  static constexpr std::array<std::pair<std::string_view, std::optional<std::pair<double, double>> PlotView::*>, 2> axes{
      {{"x", &PlotView::x_range}, {"y", &PlotView::y_range}}};
  auto& range = view.*choose(words[0], axes);
  if (words.size() == 2 && words[1] == "all") {
    range.reset();
  } else {
    require(words, 3, 3);
    range = parse_range(words[1], words[2]);
  }
}

void switch_series(ViewState& state, Arguments words) {
  PlotView& view = state.plot_view();
  const std::string before = std::exchange(view.isolated, {});
  const std::string name = state.run_names.of_now(words[0]);
  if (name == "all") {
    if (words.size() > 1 && words[1] != "on") unexpected(words[1], "on");
    view.hidden.clear();
  } else if (words.size() > 1 && words[1] == "only") {
    view.isolated = name;
    view.hidden.erase(name);
  } else if (!before.empty() && (words.size() == 1 || words[1] == "toggle")) {
    // The isolation ends: all entries from before come back.
  } else if (switched(words, 1, !view.hidden.contains(name))) {
    view.hidden.erase(name);
  } else {
    view.hidden.insert(name);
  }
}

void sort_runs(ViewState& state, Arguments words) {
  static constexpr std::array<std::pair<std::string_view, bool>, 2> ways{{{"ascending", false}, {"descending", true}}};
  const bool descending = words.size() > 1 && choose(words[1], ways);
  state.plot_options.sorted_by = words[0] == "off" ? std::string() : std::string(run_column(words[0]).name);
  state.plot_options.descending = descending;
}

PlotSave parse_save(Arguments words) {
  PlotSave save;
  read_options(words, save.path, "one file and options", [&save](const std::string& word, const auto& value) {
    if (word == "--size") {
      std::tie(save.width, save.height) = parse_size(value());
      if (save.width < 200 || save.height < 120 || save.width > 16384 || save.height > 16384)
        throw UsageError("a plot's picture is 200x120 to 16384x16384");
    } else if (word == "--scale") {
      const std::uint64_t scale = to_count(value(), 1);
      if (scale > 8) throw UsageError("--scale goes from 1 to 8");
      save.scale = static_cast<int>(scale);
    } else {
      return false;
    }
    return true;
  });
  const std::string extension = save.path.extension().string();
  if (extension != ".csv" && extension != ".svg" && extension != ".png") throw UsageError("a plot is saved as .csv, .svg or .png");
  return save;
}

}  // namespace

void rename_runs(PlotView& view, const std::map<std::string, std::string>& changed) {
  // All are renamed at once: a run may now have the name that another one had.
  std::set<std::string> hidden;
  for (const std::string& name : view.hidden) {
    const auto at = changed.find(name);
    const std::string& now = at == changed.end() ? name : at->second;
    if (!now.empty()) hidden.insert(now);
  }
  view.hidden = std::move(hidden);
  if (const auto at = changed.find(view.isolated); at != changed.end()) view.isolated = at->second;
}

void add_plot_commands(CommandTable& table, ViewState& state) {
  table.add({"log-scale", "log-scale [on|off|toggle]", "the shown plot's value axis, logarithmic or linear"}, {0, 1},
            [&state](Arguments words) {
              const OptionValue& axis = view_option("axis").at;
              axis.change(state, switched(words, 0, axis.get(state) == 1.0) ? 1.0 : 0.0);
            });
  table.add(
      {"plot-zoom", "plot-zoom all | x|y LOW HIGH | x|y all | box X0 X1 Y0 Y1", "the part of the plot that is shown; all: as at first"},
      [&state](Arguments words) { zoom_plot(state, words); });
  table.add({"plot-series", "plot-series NAME [on|off|toggle|only]  or  plot-series all",
             "shows or hides a run or a quantity of the plot's legend"},
            {1, 2}, [&state](Arguments words) { switch_series(state, words); });
  table.add({"sort-runs", "sort-runs COLUMN [ascending|descending] | sort-runs off", "the order of the table of runs"}, {1, 2},
            [&state](Arguments words) { sort_runs(state, words); });
  table.add({"plot-copy", "plot-copy", "the plotted numbers, or the table of runs, as comma separated values, on the clipboard"}, {0, 0},
            [&state](Arguments) { state.requests.plots.push_back({}); });
  table.add({"plot-save", "plot-save FILE.csv|.svg|.png [--size WxH] [--scale N]", "writes the plot as it is seen, on white"},
            [&state](Arguments words) { state.requests.plots.push_back(parse_save(words)); });
}

}  // namespace dmoscope::ui
