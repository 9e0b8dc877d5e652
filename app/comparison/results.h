#pragma once
// The results of a comparison.

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/common/judged_run.h"
#include "app/common/line_plot.h"
#include "app/comparison/plan.h"

namespace dmoscope::app {

struct OrderSpread {
  std::string name;        // the run whose order was changed
  std::size_t orders = 0;  // number of orders that were tried
  double lowest_minimum = std::numeric_limits<double>::infinity(), highest_minimum = -std::numeric_limits<double>::infinity();
  double largest_difference = 0.0;  // between two curves of sorted qualities, at one rank
  double mean_difference = 0.0;     // mean over all ranks of the widest distance of curves at a rank
  std::size_t rank = 0;             // rank of the largest difference, from 0 for the worst element
  std::size_t elements = 0;
};

/// Gathers sorted qualities, one curve per order.
class OrderCurves {
 public:
  /// Adds a curve. `sorted`: ascending, the same number of elements for all.
  void add(std::span<const double> sorted);
  [[nodiscard]] OrderSpread spread(std::string name) const;

 private:
  std::size_t orders_ = 0;
  std::vector<double> low_, high_;  // over all curves, by rank
  double highest_minimum_ = -std::numeric_limits<double>::infinity();
};

/// The sorted qualities of a run, thinned for plotting.
struct SortedCurve {
  std::size_t run = 0;    // index of the run, or of the one whose order was changed
  bool shuffled = false;  // whether the order is another one than that run's
  std::vector<float> qualities;
};

struct Comparison {
  std::shared_ptr<const InputMesh> input;
  Metric judge = Metric::MeanRatio;
  std::uint64_t free = 0;           // free vertices
  std::vector<JudgedRun> runs;      // in the order of the request; without qualities, which the curves replace
  std::vector<JudgedRun> shuffled;  // runs in other orders; without positions
  std::vector<OrderSpread> orders;  // one per run, if orders were shuffled
  std::vector<SortedCurve> curves;  // curves of all runs
  std::vector<float> input_curve;
  Percentiles input_percentiles;
  std::vector<LeftOut> left_out;
};

/// Does all runs of the plan, one after the other, each also in `shuffles` shuffled orders. Throws the errors of run_judged.
[[nodiscard]] Comparison run_all(const ComparisonPlan& plan, std::shared_ptr<const InputMesh> input, const Goal& goal,
                                 std::uint64_t shuffles, const Workshop& workshop);

/// Plots the minimum over the iterations, a line per run.
[[nodiscard]] LinePlot convergence_plot(const Comparison& comparison);
/// Plots the mean over the iterations, which raising the minimum may lower; marks the iteration from which on it was itself raised.
[[nodiscard]] LinePlot mean_plot(const Comparison& comparison);
/// Plots the qualities of all elements, worst first, a line per run and order; the input's in grey.
[[nodiscard]] LinePlot sorted_plot(const Comparison& comparison);

/// Thins the qualities of all elements to a curve that fits on a page.
[[nodiscard]] std::vector<float> curve_of(std::span<const double> qualities);

/// Title of an axis of qualities: "quality by mean-ratio".
[[nodiscard]] std::string quality_title(Metric judge);
/// Makes the series of a curve over the share of elements.
[[nodiscard]] PlotSeries curve_series(std::string name, std::span<const float> qualities);
/// Makes the series of a value over the iterations, the minimum unless another one is named.
[[nodiscard]] PlotSeries course_series(std::string name, std::span<const IterationRecord> records,
                                       double Statistics::*value = &Statistics::minimum);

}  // namespace dmoscope::app
