#pragma once
// The results of a comparison.

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/common/judged_run.h"
#include "app/common/line_plot.h"
#include "app/comparison/order_spread.h"
#include "app/comparison/plan.h"

namespace dmoscope::app {

/// The sorted qualities of a run, thinned for plotting.
struct SortedCurve {
  std::size_t run = 0;    // index of the run, or of the one whose order was changed
  bool shuffled = false;  // in another order than that run's
  std::vector<float> qualities;
};

struct Comparison {
  std::shared_ptr<const InputMesh> input;
  Metric judge = Metric::MeanRatio;
  std::uint64_t free = 0;           // vertices
  std::vector<JudgedRun> runs;      // as they were asked for; their qualities are given up for the curves
  std::vector<JudgedRun> shuffled;  // the same in other orders; without positions
  std::vector<OrderSpread> orders;  // one per run, where orders were shuffled
  std::vector<SortedCurve> curves;  // of all of them
  std::vector<float> input_curve;
  Percentiles input_percentiles;
  std::vector<LeftOut> left_out;
};

/// Does all runs of the plan, one after the other, each also in `shuffles` shuffled orders. Throws what run_judged does.
[[nodiscard]] Comparison run_all(const ComparisonPlan& plan, std::shared_ptr<const InputMesh> input, const Goal& goal,
                                 std::uint64_t shuffles, const Workshop& workshop);

/// The minimum over the iterations, a line per run.
[[nodiscard]] LinePlot convergence_plot(const Comparison& comparison);
/// The mean over the iterations, which what raises the minimum may lower; says since when it was itself raised.
[[nodiscard]] LinePlot mean_plot(const Comparison& comparison);
/// The qualities of all elements, worst first, a line per run and order; the input's in grey.
[[nodiscard]] LinePlot sorted_plot(const Comparison& comparison);

/// The qualities of all elements as a curve that a page has room for.
[[nodiscard]] std::vector<float> curve_of(std::span<const double> qualities);

/// "quality by mean-ratio": what the axis of a plot of qualities says.
[[nodiscard]] std::string quality_title(Metric judge);
/// A curve over the share of elements, for a plot.
[[nodiscard]] PlotSeries curve_series(std::string name, std::span<const float> qualities);
/// A course over the iterations, for a plot: of minima unless another value is named.
[[nodiscard]] PlotSeries course_series(std::string name, std::span<const IterationRecord> records,
                                       double Statistics::*value = &Statistics::minimum);

}  // namespace dmoscope::app
