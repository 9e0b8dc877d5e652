#pragma once
// Visible parts of the plots, as plain data.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dmoscope::ui {

/// Content of the lower panel: plots, the table of runs, which has no axes, and runs compared by several metrics.
enum class PlotTab { Convergence, Histogram, Sorted, Moved, Time, Runs, Compare };
inline constexpr std::array<std::pair<std::string_view, PlotTab>, 7> kPlotTabs{{{"convergence", PlotTab::Convergence},
                                                                                {"histogram", PlotTab::Histogram},
                                                                                {"sorted", PlotTab::Sorted},
                                                                                {"moved", PlotTab::Moved},
                                                                                {"time", PlotTab::Time},
                                                                                {"runs", PlotTab::Runs},
                                                                                {"compare", PlotTab::Compare}}};

/// Scale of values along the upright axis. LogDistance: by the logarithm of 1 - q, the distance to the ideal element, better ones higher.
enum class ValueAxis { Linear, Log, LogDistance };
inline constexpr std::array<std::pair<std::string_view, ValueAxis>, 3> kValueAxes{
    {{"linear", ValueAxis::Linear}, {"log", ValueAxis::Log}, {"log-distance", ValueAxis::LogDistance}}};

/// Whether a plot offers a scale: only qualities have a distance to the ideal.
[[nodiscard]] constexpr bool offers(PlotTab tab, ValueAxis axis) noexcept {
  if (tab == PlotTab::Runs) return axis == ValueAxis::Linear;
  return axis != ValueAxis::LogDistance || tab == PlotTab::Convergence || tab == PlotTab::Compare || tab == PlotTab::Sorted;
}
/// Whether a plot has iterations, or the seconds that they took, along it.
[[nodiscard]] constexpr bool over_iterations(PlotTab tab) noexcept {
  return tab != PlotTab::Histogram && tab != PlotTab::Sorted && tab != PlotTab::Runs;
}

/// Scale of iterations, or seconds, along the plots that have them. Log: by the logarithm of 1 + iteration, so that the first ones, in
/// which most happens, get most room, and the input has a place. Changes: evenly, up to the last visible change.
enum class XAxis { Log, Changes, Linear };

/// Range that the histogram shows at first: that of its elements, or all from 0 to 1.
enum class HistogramRange { Data, Whole };

/// Visible part of one plot.
struct PlotView {
  std::set<std::string> hidden;                               // entries that are switched off in the legend
  std::string isolated;                                       // the only run or quantity to be shown; empty: see hidden
  std::optional<std::pair<double, double>> x_range, y_range;  // none: the initial range, see x_seen
  ValueAxis axis = ValueAxis::Linear;
  friend bool operator==(const PlotView&, const PlotView&) = default;
};

/// Keeps runs switched off in the plot's legend when their names change. `changed`: see KnownRunNames::follow.
void rename_runs(PlotView& view, const std::map<std::string, std::string>& changed);

/// Options of several plots.
struct PlotOptions {
  bool by_seconds = false;  // seconds of smoothing instead of iterations along the plot
  int bins = 64;            // bins of the histogram: 16, 32 or 64
  std::string sorted_by{};  // column by which the table of runs is sorted, see run_columns(); empty: by the order of their making
  bool descending = false;  // whether that table is sorted in descending order
  bool judged_own = false;  // compared runs are judged each by the metric that it optimises, else all by the shown one
  XAxis x_axis = XAxis::Log;
  HistogramRange histogram_range = HistogramRange::Data;
  friend bool operator==(const PlotOptions&, const PlotOptions&) = default;
};

/// A plot to be written in its visible range. An empty path: its numbers go to the clipboard.
struct PlotSave {
  std::filesystem::path path;  // .csv, .svg or .png
  int width = 0, height = 0;   // size of the picture: units of an SVG, pixels of a PNG; 0: 800 x 450 units
  int scale = 2;               // pixels of a PNG a unit; text is 12 units high
};

}  // namespace dmoscope::ui
