#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "core/run/summary.h"
#include "render/shading.h"
#include "ui/plots/plot_builder.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

class DistributionPlot : PlotBuilder {
 public:
  explicit DistributionPlot(const PlotSources& sources) : PlotBuilder(sources) {}

  Plot build() {
    if (state_.plot == PlotTab::Histogram) build_histogram();
    if (state_.plot == PlotTab::Sorted) build_sorted();
    return std::move(plot_);
  }

 private:
  /// Summary by the shown metric of a run whose elements are not in the frame; null while it is not worked out yet.
  [[nodiscard]] const RunSummary* summary_of(std::size_t k) const {
    const RunSummary* summary = session_.runs[k].summary.get();
    return k != session_.frame->run && is_shown(k) && summary != nullptr && summary->metric == session_.frame->shown ? summary : nullptr;
  }

  [[nodiscard]] Series series_of_input() const {
    Series series;
    series.name = "input";
    series.colour = palette_.dim;
    return series;
  }

  void add_histogram(Series series, const Histogram& histogram) {
    const auto bins = static_cast<std::size_t>(state_.plot_options.bins);
    series.y = rebinned(histogram, bins);
    series.bar_width = (histogram.highest - histogram.lowest) / static_cast<double>(bins);
    for (std::size_t k = 0; k < bins; ++k) series.x.push_back(histogram.lowest + static_cast<double>(k) * series.bar_width);
    add_to_legend(series);
    plot_.series.push_back(std::move(series));
  }

  void build_histogram() {
    plot_.x_name = "quality";
    plot_.x_title = "quality";
    plot_.y_title = "elements";
    plot_.empty_text = "open a mesh to see its qualities";
    const Frame* frame = session_.frame.get();
    if (frame == nullptr) return;
    plot_.x_title = metric_phrase(frame->shown);
    plot_.title = "histogram of the " + plot_.x_title;
    const bool moved = frame->moment != Moment{};
    Series before = series_of_input();
    before.kind = Series::Kind::Bars;
    before.strength = 0.5;
    if ((moved || several_) && (!frame->provisional || frame->input_spread)) add_histogram(std::move(before), frame->before);
    Series now = series_of_run(frame->run, moved ? "now" : several_ ? "now" : "input");
    now.kind = several_ ? Series::Kind::Steps : Series::Kind::Bars;
    now.strength = several_ ? 1.0 : 0.75;
    if (shows_frame(*frame)) add_histogram(std::move(now), frame->now);
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      const RunSummary* summary = summary_of(k);
      if (summary == nullptr) continue;
      Series other = series_of_run(k, "now");
      other.kind = Series::Kind::Steps;
      add_histogram(std::move(other), summary->histogram);
    }
    brush(*frame);
    const bool both = moved && frame->before.below != frame->now.below && !(frame->provisional && !frame->input_spread);
    if (frame->now.below > 0 || both)
      plot_.y_title += fmt::format(" ({} below {:g}{})", count(frame->now.below), frame->now.lowest,
                                   both ? fmt::format(", {} in the input", count(frame->before.below)) : std::string());
    if (state_.plot_options.histogram_range == HistogramRange::Data) show_data_alone();
  }

  /// Sets the histogram's first range to whole bars from the first to the last element. A few far down, no more than a thousandth, are left
  /// out if everything else gets much wider by that; a note tells their number.
  void show_data_alone() {
    constexpr double kFew = 1e-3, kWorthIt = 0.6, kFewestBars = 4.0;
    const Range all = x_extent(plot_);
    double low = all.second, low_of_most = all.second, high = all.first, width = 0.0;
    for (const Series& one : plot_.series) {
      const double few = kFew * std::accumulate(one.y.begin(), one.y.end(), 0.0);
      double passed = 0.0;
      for (std::size_t k = 0; k < one.y.size(); ++k) {
        if (!(one.y[k] > 0.0)) continue;
        low = std::min(low, one.x[k]);
        passed += one.y[k];
        if (passed > few) low_of_most = std::min(low_of_most, one.x[k]);
        high = std::max(high, one.x[k] + one.bar_width);
      }
      width = one.bar_width;
    }
    if (!(high > low)) return;
    const bool cut = high - low_of_most < kWorthIt * (high - low);
    Range home{std::max(all.first, (cut ? low_of_most : low) - width), std::min(all.second, high + width)};
    home.first = std::max(all.first, std::min(home.first, home.second - kFewestBars * width));
    if (home.second - home.first > kMuchOfARange * (all.second - all.first)) return;
    plot_.x_home = home;
    if (!cut) return;
    double left_out = 0.0;  // elements left out now
    for (const Series& one : plot_.series) {
      if (one.name == "input" && plot_.series.size() > 1) continue;
      for (std::size_t k = 0; k < one.x.size() && one.x[k] + one.bar_width <= home.first + 1e-9; ++k) left_out += one.y[k];
    }
    if (left_out > 0.0)
      plot_.y_title += fmt::format(" · {} below {:.3g}, left of what is shown", count(static_cast<std::uint64_t>(left_out)), home.first);
  }

  /// Adds the filter as the histogram's brush, with a note on the number of elements that it leaves.
  void brush(const Frame& frame) {
    const auto& filter = state_.colouring.filter;
    if (!filter) return;
    plot_.brush = *filter;
    if (frame.quality.empty()) return;  // qualities are on a device
    const std::pair range{static_cast<float>(filter->first), static_cast<float>(filter->second)};
    std::size_t inside = 0;
    for (std::size_t e = 0; e < frame.quality.size(); ++e)
      inside += render::in_quality_range(range, shade_of(frame.quality[e], frame.inverted[e] != 0)) ? 1 : 0;
    plot_.y_title +=
        fmt::format(" · {} of {} from {:.4g} to {:.4g}", count(inside), count(frame.quality.size()), filter->first, filter->second);
  }

  template <class Values>
  void add_sorted(Series series, const Values& values) {
    series.y.assign(values.begin(), values.end());
    const auto last = static_cast<double>(std::max<std::size_t>(2, values.size()) - 1);
    for (std::size_t k = 0; k < values.size(); ++k) series.x.push_back(100.0 * static_cast<double>(k) / last);
    add_to_legend(series);
    plot_.series.push_back(std::move(series));
  }

  void build_sorted() {
    plot_.x_name = "percent";
    plot_.x_title = "share of the elements, %";
    plot_.y_title = "quality";
    plot_.x_range = Range{0.0, 100.0};
    plot_.empty_text = "open a mesh to see its qualities";
    const Frame* frame = session_.frame.get();
    if (frame == nullptr || sorted_.now.empty()) return;
    plot_.y_title = metric_phrase(frame->shown);
    plot_.title = "sorted " + plot_.y_title;
    const bool moved = frame->moment != Moment{};
    if (moved || several_) add_sorted(series_of_input(), sorted_.before);
    if (shows_frame(*frame)) add_sorted(series_of_run(frame->run, moved || several_ ? "now" : "input"), sorted_.now);
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (const RunSummary* summary = summary_of(k)) add_sorted(series_of_run(k, "now"), summary->sorted);
    }
  }
};

}  // namespace

Plot distribution_plot(const PlotSources& sources) { return DistributionPlot(sources).build(); }

}  // namespace dmoscope::ui
