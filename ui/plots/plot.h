#pragma once
// A plot as plain data: its series, legend, axes and marks. Painters for the window and for files draw it, others write its numbers.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render/image.h"
#include "ui/state/plot_state.h"

namespace dmoscope::ui {

using Range = std::pair<double, double>;

struct Series {
  /// Kind of a series. Bars and steps stand from x to x + bar_width; steps are bars' outline.
  enum class Kind { Line, Bars, Steps };
  std::string run;   // name of its run in the legend; empty: there is only one, or it belongs to none
  std::string name;  // name of the quantity in the legend; empty: the plot has only one
  render::Rgb colour;
  std::vector<double> x, y;  // x and y of the same size, x ascending; a NaN in y is a gap
  Kind kind = Kind::Line;
  double bar_width = 0.0;
  double width = 1.5;     // width of the line, pixels at scale 1
  double dash = 0.0;      // see Drawing::Line, pixels at scale 1
  double strength = 1.0;  // share of the colour against the background; of bars: their opacity
  bool strip = false;     // drawn in the strip below
};

struct LegendEntry {
  std::string name;
  bool of_run = false;  // entry of a run, else of a quantity
  std::string tip;
  Series look;        // colour, kind, width, dash and strength of its sample
  std::string brief;  // name where room is short
};

/// An upright line.
struct PlotMark {
  double x = 0.0;
  std::string label;  // may be empty
};

/// Unit in which an axis' numbers are written.
struct AxisUnit {
  double factor = 1.0;  // factor of the values
  std::string name;     // "ms"; empty for plain numbers
};

struct Plot {
  PlotTab tab = PlotTab::Convergence;
  std::string title;             // title of a file's picture
  std::string x_title, y_title;  // titles of the axes, with units
  std::string x_name;            // one word, for the readout and a table's column
  std::string strip_title;       // title of the strip below, which has values of another kind over the same x
  double strip_share = 0.0;      // share of the height; 0: none
  bool integer_x = false;        // x is whole
  bool from_zero = false;        // the linear value axis begins at 0
  AxisUnit x_unit, y_unit, strip_unit;
  ValueAxis axis = ValueAxis::Linear;
  std::optional<Range> x_range;  // range of all x; none: from the series
  std::optional<Range> x_home;   // range of x shown at first; none: all
  double x_pivot = 0.0;          // x lies along the plot by the logarithm of 1 + x / this; 0: evenly
  std::vector<Series> series;
  std::vector<LegendEntry> legend;
  bool legend_in_a_row = false;  // the window has brief names in one row, and no titles of the axes
  std::vector<PlotMark> marks;
  std::optional<Range> brush;  // selected part of x
  std::string empty_text = "nothing to show yet";
};

/// Whether a name is switched on in the legend.
[[nodiscard]] bool is_on(const Plot& plot, const PlotView& view, const LegendEntry& entry);
/// Whether a series is drawn: neither its run nor its quantity is switched off.
[[nodiscard]] bool is_visible(const Plot& plot, const PlotView& view, const Series& series);
/// Name of a series with its run: "2 laplace minimum"; never empty.
[[nodiscard]] std::string full_name(const Plot& plot, const Series& series);

/// Range of all x of the plot, whatever is visible.
[[nodiscard]] Range x_extent(const Plot& plot);
/// Range of x in view: the zoomed one, else the one shown at first.
[[nodiscard]] Range x_seen(const Plot& plot, const PlotView& view);
/// Whether an axis can show a value: not NaN or infinite, > 0 for logarithmic ones, < 1 for log-distance.
[[nodiscard]] bool can_show(ValueAxis axis, double value);
/// Smallest and largest value that the visible series have over x in `x_range`, a little wider. `strip`: of the series in the strip. None
/// if there is no value.
[[nodiscard]] std::optional<Range> value_range(const Plot& plot, const PlotView& view, Range x_range, bool strip = false);

/// Values at one x of the plot.
struct Reading {
  const Series* series;
  std::size_t sample;
};
/// The nearest sample to `at` of each visible series: of a line if it reaches that far, of bars the one that contains `at`.
[[nodiscard]] std::vector<Reading> read_plot(const Plot& plot, const PlotView& view, double at);

/// A unit in which `largest` seconds are a number of few digits: s, ms or µs.
[[nodiscard]] AxisUnit time_unit(double largest);

}  // namespace dmoscope::ui
