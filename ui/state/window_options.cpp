// Rows of the table of options: plots, panels, and the window on the desktop.
#include <bit>

#include "ui/state/option_rows.h"

namespace dmoscope::ui {
namespace {

using V = ViewState;
using P = PlotOptions;

constexpr OptionNumber kPanelSize{.least = 6.0, .most = 60.0, .clamped = true, .unit = "EM", .rest_word = "default"};

/// Shows all of the horizontal axis, because its quantity is another one now.
void show_all_iterations(ViewState& state) {
  for (const auto& [name, tab] : kPlotTabs)
    if (over_iterations(tab)) state.plots[static_cast<std::size_t>(tab)].x_range.reset();
}

void show_all_of_histogram(ViewState& state) { state.plots[static_cast<std::size_t>(PlotTab::Histogram)].x_range.reset(); }

double axis_of(const ViewState& state) { return static_cast<double>(state.plots[static_cast<std::size_t>(state.plot)].axis); }
bool offers_axis(const ViewState& state, double axis) { return offers(state.plot, static_cast<ValueAxis>(static_cast<int>(axis))); }
void choose_axis(ViewState& state, double axis) {
  if (!offers_axis(state, axis)) throw UsageError("log-distance is for plots of quality: convergence and sorted");
  if (axis_of(state) != axis) state.plot_view().y_range.reset();
  state.plot_view().axis = static_cast<ValueAxis>(static_cast<int>(axis));
}

}  // namespace

std::vector<ViewOption> plot_options() {
  using namespace option_rows;
  return {
      row("plot", "which plot is shown, or the table of runs",
          words(at<&V::plot>(), choice("convergence", "Convergence", "", "", "Alt+1"), choice("histogram", "Histogram", "", "", "Alt+2"),
                choice("sorted", "Sorted", "", "Sorted quality", "Alt+3"), choice("moved", "Moved", "", "Moved vertices", "Alt+4"),
                choice("time", "Time", "", "", "Alt+5"), choice("runs", "Runs", "", "Table of runs", "Alt+6"),
                choice("compare", "Compare", "", "Comparison of runs", "Alt+7")),
          {"/plots/shown"}, {}, {"log", "", false, false, "Plot"}),
      row("judged-by", "the metric of runs that are compared: the one that is shown, or each its own",
          words(at<&V::plot_options, &P::judged_own>(), choice("shown"), choice("own")), {"/plots/judged_own"}),
      row("axis", "the shown plot's value axis; log-distance: by the logarithm of 1 - quality",
          words({axis_of}, choice("linear", "linear", "values evenly along the axis"),
                choice("log", "log", "logarithmic; values of 0 and below are gaps"),
                choice("log-distance", "log 1 − q", "by the logarithm of 1 - q, the distance to the ideal element: for qualities near 1"))
              .changed_by(choose_axis)
              .offered_if(offers_axis),
          {}, {"Next value axis", "plot-runs", "Alt+L", "log-scale", Nothing, kApart}),
      row("plot-x", "the horizontal axis of plots over a run: iterations or seconds",
          words(at<&V::plot_options, &P::by_seconds>(), choice("iteration", "by iteration", "iterations along the plot"),
                choice("seconds", "by seconds", "seconds of smoothing along the plot: compares methods by their cost"))
              .and_then(show_all_iterations),
          {"/plots/by_seconds"}, {"Seconds instead of iterations", "log-scale", "Alt+T", "plot-seconds"}),
      row("x-axis", "the axis of iterations or seconds: logarithmic, linear up to the last visible change, or linear",
          words(at<&V::plot_options, &P::x_axis>(),
                choice("log", "x: log", "0, 1, 2, 5, 10, …: the first iterations, in which most happens, have the room",
                       "Iterations by their logarithm"),
                choice("changes", "x: last change", "evenly, up to the last iteration with a visible change",
                       "Iterations up to the last change"),
                choice("linear", "x: linear", "all iterations, evenly", "Iterations evenly"))
              .and_then(show_all_iterations),
          {"/plots/x_axis", "/x_axis"}, {}, {"plot-seconds"}),
      row("histogram-range", "whether the histogram begins where its elements are, or from 0 to 1",
          words(at<&V::plot_options, &P::histogram_range>(),
                choice("data", "its data", "from the first bar to the last; what lies outside is said above"),
                choice("whole", "0 to 1", "all possible qualities"))
              .and_then(show_all_of_histogram),
          {"/plots/histogram_range", "/histogram_range"}, {"Histogram from 0 to 1", "x-axis-linear", "", "histogram-whole"}),
      row("plot-bins", "bars of the histogram",
          words({[](const V& s) { return static_cast<double>(std::countr_zero(static_cast<unsigned>(s.plot_options.bins)) - 4); },
                 [](V& s, double value) { s.plot_options.bins = 16 << static_cast<int>(value); }},
                choice("16", "16 bars", "bars from 0 to 1"), choice("32", "32 bars", "bars from 0 to 1"),
                choice("64", "64 bars", "bars from 0 to 1")),
          {"/plots/bins"}),
      row("", "", at<&V::plot_options, &P::descending>(), {"/plots/runs_descending"}),
  };
}

namespace {

template <auto Dock>
OptionValue side_of() {
  using namespace option_rows;
  return words(at<&V::panels, Dock>(), choice("left"), choice("right"));
}

}  // namespace

std::vector<ViewOption> panel_options() {
  using namespace option_rows;
  return {
      row("panel setup", "shows or hides a panel; left and right are older names of the first two", at<&V::panels, &Panels::setup>(),
          both("/panels/left", kScript), {"Setup: runs, method, metric", "from-trackball", "F2", "panel-left", Nothing, kApart}),
      row("panel facts", "shows or hides a panel", at<&V::panels, &Panels::facts>(), both("/panels/right", kScript),
          {"Facts: mesh, selection, worst", "panel-left", "F3", "panel-right"}),
      row("panel left", "an older name of setup", at<&V::panels, &Panels::setup>()),
      row("panel right", "an older name of facts", at<&V::panels, &Panels::facts>()),
      row("dock setup", "the side at which a panel stands", side_of<&Panels::setup_side>(), both("/panels/setup_side", kScript)),
      row("dock facts", "the side at which a panel stands", side_of<&Panels::facts_side>(), both("/panels/facts_side", kScript)),
      row("tab", "what the panel of facts shows: mesh, what is picked, worst elements, colours, the inside of a volume",
          words(at<&V::panels, &Panels::tab>(), choice("mesh"), choice("selection"), choice("worst"), choice("colours"), choice("inside")),
          {"/panels/tab", "", kScript}),
      row("settings", "all parameters of the run", at<&V::panels, &Panels::settings>(), {"", "/panels/settings", kScript}),
      row("unfold-holds", "what holds the minimum, and what would raise it", at<&V::panels, &Panels::holds>(),
          {"", "/panels/holds", kScript}),
      row("unfold-loops", "the list of boundary loops", at<&V::panels, &Panels::loops>(), {"", "/panels/loops"}),
      row("unfold-notice", "the note about a run's end", at<&V::panels, &Panels::notice>(), {"", "/panels/notice", kScript}),
      row("panel bottom", "shows or hides a panel",
          at<&V::panels, &Panels::bottom>().and_then([](V& state) { state.panels.plots_wait = false; }).seen_as([](const V& state) {
            return state.panels.plots() ? 1.0 : 0.0;
          }),
          both("/panels/bottom"), {"Bottom panel: plots", "panel-right", "F4", "panel-bottom"}),
      row("panel-size left", "width or height of a panel, or of the list of runs, in heights of the interface's font",
          numbers(at<&V::panels, &Panels::left_width>(), kPanelSize), both("/panels/left_width", kScript)),
      row("panel-size right", "width of the right column", numbers(at<&V::panels, &Panels::right_width>(), kPanelSize),
          both("/panels/right_width", kScript)),
      row("panel-size bottom", "height of the bottom panel", numbers(at<&V::panels, &Panels::bottom_height>(), kPanelSize),
          both("/panels/bottom_height", kScript)),
      row("panel-size runs", "height of the list of runs",
          numbers(at<&V::panels, &Panels::runs_height>(),
                  {.least = 4.0, .most = 60.0, .clamped = true, .unit = "EM", .rest_word = "default"}),
          both("/panels/runs_height", kScript)),
      row("unfold left", "in a narrow window: shows a side panel over the mesh",
          at<&V::panels, &Panels::left_over>().and_then([](V& state) { state.panels.picked_over = false; }), {"", "", kScript},
          {"Show the left column over the mesh", "scale-one", "", "unfold-left"}),
      row("unfold right", "in a narrow window: shows a side panel over the mesh",
          at<&V::panels, &Panels::right_over>().and_then([](V& state) { state.panels.picked_over = false; }), {"", "", kScript},
          {"Show the right column over the mesh", "unfold-left", "", "unfold-right"}),
  };
}

std::vector<ViewOption> desktop_options() {
  using namespace option_rows;
  return {
      row("full-screen", "the whole monitor",
          at<&V::full_screen>().and_then([](V& state) { state.requests.full_screen = state.full_screen; }), {},
          {"Full screen", "panel-bottom", "F11"}),
      row("theme", "colours of the interface",
          words(at<&V::theme>(), choice("dark", "dark"), choice("light", "light"), choice("contrast", "high contrast")),
          {"", "/theme", kScript}, {}, {"full-screen", "Theme", kApart}),
      row("watch", "reads the mesh's file again whenever it changes", at<&V::watch_file>(), {}, {"Watch the file", "reload"}),
      row("native-dialogs", "the desktop's own file dialogs where there are any (zenity, kdialog)", at<&V::native_dialogs>(),
          {"", "/native_dialogs"}, {"The desktop's file dialogs", "sample-biased", "", "", Nothing, kApart}),
      row("ask-unsaved", "asks before unsaved work is given up", at<&V::asks_unsaved>()),
      row("", "", at<&V::tour, &Tour::offered>(), {"", "/tour_offered"}),
  };
}

}  // namespace dmoscope::ui
