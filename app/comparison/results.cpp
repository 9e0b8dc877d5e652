#include "app/comparison/results.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/common/text.h"
#include "core/view/summaries.h"

namespace dmoscope::app {
namespace {

constexpr std::size_t kReportPoints = 1500;
constexpr std::uint64_t kFewIterations = 100;  // up to this number the axis is linear and shows the input

std::vector<double> input_qualities(const InputMesh& input, Metric judge, ThreadPool* pool) {
  std::vector<double> qualities(input.mesh.elements.size());
  element_qualities(input.quality_context(), input.mesh.positions, judge, pool, qualities);
  return qualities;
}

/// Clears a container and frees its memory; `= {}` would keep the capacity.
template <class T>
void free_all(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

}  // namespace

std::vector<float> curve_of(std::span<const double> qualities) {
  return sorted_choice(std::vector<float>(qualities.begin(), qualities.end()), kReportPoints);
}

Comparison run_all(const ComparisonPlan& plan, std::shared_ptr<const InputMesh> input, const Goal& goal, std::uint64_t shuffles,
                   const Workshop& workshop) {
  Comparison all;
  all.input = std::move(input);
  all.judge = plan.judge;
  all.left_out = plan.left_out;
  std::vector<double> before = input_qualities(*all.input, plan.judge, workshop.pool.get());
  all.input_curve = curve_of(before);
  all.input_percentiles = percentiles_of(before);
  const std::uint64_t count = plan.contenders.size() * (shuffles + 1);
  std::uint64_t done = 0;
  const auto run = [&](const std::string& name, const RunParameters& parameters) {
    workshop.progress.begin(fmt::format("{}, {} of {}:", name, done + 1, count));
    const Progress::Part part(workshop.progress, done++, count);
    return run_judged(name, all.input, parameters, plan.judge, goal, workshop);
  };
  for (std::size_t k = 0; k < plan.contenders.size(); ++k) {
    const Contender& contender = plan.contenders[k];
    OrderCurves orders;
    const auto take_curve = [&](JudgedRun& judged, bool shuffled) {
      orders.add(judged.qualities);
      all.curves.push_back({k, shuffled, curve_of(judged.qualities)});
      free_all(judged.qualities);
    };
    all.runs.push_back(run(contender.name, contender.parameters));
    take_curve(all.runs.back(), false);
    for (std::uint64_t seed = 1; seed <= shuffles; ++seed) {
      RunParameters parameters = contender.parameters;
      parameters.order.seed = seed;
      all.shuffled.push_back(run(fmt::format("{} shuffle:{}", contender.name, seed), parameters));
      take_curve(all.shuffled.back(), true);
      free_all(all.shuffled.back().positions);
    }
    if (shuffles > 0) all.orders.push_back(orders.spread(contender.name));
  }
  all.free = all.runs.front().free;
  return all;
}

std::string quality_title(Metric judge) { return fmt::format("quality by {}", info(judge).name); }

PlotSeries curve_series(std::string name, std::span<const float> qualities) {
  PlotSeries series{.name = std::move(name), .dots = false};
  const double last = qualities.size() > 1 ? static_cast<double>(qualities.size() - 1) : 1.0;
  for (std::size_t i = 0; i < qualities.size(); ++i)
    series.values.push_back(exact(100.0 * static_cast<double>(i) / last, static_cast<double>(qualities[i])));
  return series;
}

PlotSeries course_series(std::string name, std::span<const IterationRecord> records, double Statistics::*value) {
  PlotSeries series{.name = std::move(name), .dots = records.size() <= 31};
  for (const IterationRecord& record : records)
    series.values.push_back(exact(static_cast<double>(record.iteration), record.statistics.*value));
  return series;
}

namespace {

LinePlot course_plot(const Comparison& comparison, const char* what, const char* quantity, double Statistics::*value) {
  LinePlot plot;
  plot.title = fmt::format("{}: {}", comparison.input->mesh.name, what);
  plot.x_title = "iteration";
  plot.y_title = fmt::format("{}, {}", quantity, quality_title(comparison.judge));
  plot.x_axis = plot.y_axis = AxisKind::Linear;
  std::uint64_t longest = 0;
  for (std::size_t k = 0; k < comparison.runs.size(); ++k) {
    const JudgedRun& run = comparison.runs[k];
    longest = std::max(longest, run.row.iterations);
    PlotSeries series = course_series(run.name, run.records, value);
    series.colour = k;
    series.dash = k / 8;
    plot.series.push_back(std::move(series));
  }
  if (longest > kFewIterations) {
    plot.x_axis = AxisKind::Logarithmic;
    plot.note = "the input, iteration 0, is off the axis";
  }
  return plot;
}

}  // namespace

LinePlot convergence_plot(const Comparison& comparison) {
  return course_plot(comparison, "the worst element", "minimum", &Statistics::minimum);
}

LinePlot mean_plot(const Comparison& comparison) {
  LinePlot plot = course_plot(comparison, "the mean of all elements", "mean", &Statistics::mean);
  std::string since;
  for (const JudgedRun& run : comparison.runs) {
    if (run.outcome.phases.mean_since)
      since += fmt::format("{}{} from iteration {} on", since.empty() ? "raised by " : "; ", run.name, *run.outcome.phases.mean_since + 1);
  }
  plot.subtitle = since;
  return plot;
}

LinePlot sorted_plot(const Comparison& comparison) {
  LinePlot plot;
  plot.title = fmt::format("{}: all elements, worst first", comparison.input->mesh.name);
  plot.x_title = "share of the elements, %";
  plot.y_title = quality_title(comparison.judge);
  plot.x_axis = plot.y_axis = AxisKind::Linear;
  plot.series.push_back(curve_series("input", comparison.input_curve));
  plot.series.back().muted = true;
  for (const SortedCurve& curve : comparison.curves) {
    const std::size_t others = comparison.shuffled.size() / comparison.runs.size();
    std::string name = comparison.runs[curve.run].name;
    if (others > 0) name += ", " + counted(others + 1, "order", "orders");
    PlotSeries series = curve_series(curve.shuffled ? std::string() : std::move(name), curve.qualities);
    series.colour = curve.run;
    series.dash = curve.run / 8;
    if (others > 0) series.width = 0.8;
    plot.series.push_back(std::move(series));
  }
  return plot;
}

void OrderCurves::add(std::span<const double> sorted) {
  if (sorted.empty()) return;
  if (orders_++ == 0) {
    low_.assign(sorted.begin(), sorted.end());
    high_ = low_;
  }
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    low_[i] = std::min(low_[i], sorted[i]);
    high_[i] = std::max(high_[i], sorted[i]);
  }
  highest_minimum_ = std::max(highest_minimum_, sorted.front());
}

OrderSpread OrderCurves::spread(std::string name) const {
  OrderSpread spread;
  spread.name = std::move(name);
  spread.orders = orders_;
  spread.elements = low_.size();
  if (low_.empty()) return spread;
  spread.lowest_minimum = low_.front();
  spread.highest_minimum = highest_minimum_;
  double sum = 0.0;
  for (std::size_t i = 0; i < low_.size(); ++i) {
    const double difference = high_[i] - low_[i];
    sum += difference;
    if (difference <= spread.largest_difference) continue;
    spread.largest_difference = difference;
    spread.rank = i;
  }
  spread.mean_difference = sum / static_cast<double>(low_.size());
  return spread;
}

}  // namespace dmoscope::app
