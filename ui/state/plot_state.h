#pragma once
// What is seen of the plots, as plain data.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace dmoscope::ui {

/// What the lower panel shows: plots, the table of runs, which has no axes, and runs compared by several metrics.
enum class PlotTab { Convergence, Histogram, Sorted, Moved, Time, Runs, Compare };
inline constexpr std::array<std::pair<std::string_view, PlotTab>, 7> kPlotTabs{{{"convergence", PlotTab::Convergence},
                                                                                {"histogram", PlotTab::Histogram},
                                                                                {"sorted", PlotTab::Sorted},
                                                                                {"moved", PlotTab::Moved},
                                                                                {"time", PlotTab::Time},
                                                                                {"runs", PlotTab::Runs},
                                                                                {"compare", PlotTab::Compare}}};

/// How values lie along the upright axis. LogDistance: by the logarithm of 1 - q, the distance to the ideal element, better ones higher.
enum class ValueAxis { Linear, Log, LogDistance };
inline constexpr std::array<std::pair<std::string_view, ValueAxis>, 3> kValueAxes{
    {{"linear", ValueAxis::Linear}, {"log", ValueAxis::Log}, {"log-distance", ValueAxis::LogDistance}}};

/// Only qualities have a distance to the ideal.
[[nodiscard]] constexpr bool offers(PlotTab tab, ValueAxis axis) noexcept {
  if (tab == PlotTab::Runs) return axis == ValueAxis::Linear;
  return axis != ValueAxis::LogDistance || tab == PlotTab::Convergence || tab == PlotTab::Compare || tab == PlotTab::Sorted;
}
/// Plots that have the iterations, or the seconds that they took, along them.
[[nodiscard]] constexpr bool over_iterations(PlotTab tab) noexcept {
  return tab != PlotTab::Histogram && tab != PlotTab::Sorted && tab != PlotTab::Runs;
}

/// How iterations, or seconds, lie along the plots that have them. Log: by the logarithm of 1 + iteration, so that the first ones, in which
/// most happens, have the room, and the input its place. Changes: evenly, up to the last change that could be seen.
enum class XAxis { Log, Changes, Linear };

/// What the histogram shows at first: where its elements are, or all from 0 to 1.
enum class HistogramRange { Data, Whole };

/// What is seen of one plot.
struct PlotView {
  std::set<std::string> hidden;                               // what is switched off in the legend
  std::string isolated;                                       // of the runs, or of the quantities, only this one; empty: see hidden
  std::optional<std::pair<double, double>> x_range, y_range;  // none: as it is seen at first, see x_seen
  ValueAxis axis = ValueAxis::Linear;
  friend bool operator==(const PlotView&, const PlotView&) = default;
};

/// Runs that the plot's legend switched off stay so under other names. `changed`: see KnownRunNames::follow.
void rename_runs(PlotView& view, const std::map<std::string, std::string>& changed);

/// What holds for several of them.
struct PlotOptions {
  bool by_seconds = false;  // smoothing's seconds instead of iterations along the plot
  int bins = 64;            // of the histogram: 16, 32 or 64
  std::string sorted_by{};  // the column of the table of runs that they are sorted by, see run_columns(); empty: as they were made
  bool descending = false;  // likewise
  bool judged_own = false;  // runs that are compared by the metric that each optimises, else all by the one that is shown
  XAxis x_axis = XAxis::Log;
  HistogramRange histogram_range = HistogramRange::Data;
  friend bool operator==(const PlotOptions&, const PlotOptions&) = default;
};

/// A plot to be written as it is seen. An empty path: its numbers to the clipboard.
struct PlotSave {
  std::filesystem::path path;  // .csv, .svg or .png
  int width = 0, height = 0;   // of the picture: units of an SVG, pixels of a PNG; 0: 800 x 450 units
  int scale = 2;               // pixels of a PNG a unit; text is 12 units high
};

}  // namespace dmoscope::ui
