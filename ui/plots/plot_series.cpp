#include "ui/plots/plot_series.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

#include "core/run/summary.h"
#include "render/shading.h"
#include "ui/analysis/comparison.h"
#include "ui/state/format.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {
namespace {

/// Values that can be plotted: infinity stands for "there is no such element".
double finite_or_gap(double value) { return std::isfinite(value) ? value : NAN; }

/// Where each record of a run stands along the plot.
std::vector<double> course_of(const RunView& run, bool by_seconds) {
  std::vector<double> x;
  x.reserve(run.records.size());
  double seconds = 0.0;
  for (const IterationRecord& record : run.records) {
    seconds += std::isfinite(record.seconds) ? record.seconds : 0.0;
    x.push_back(by_seconds ? seconds : static_cast<double>(record.iteration));
  }
  return x;
}

constexpr double kThick = 2.2, kThin = 1.5;
constexpr double kMuch = 0.9;  // of a range: to show so much of it alone is not worth while

constexpr std::array<double Statistics::*, 3> kCourses{&Statistics::minimum, &Statistics::movable_minimum, &Statistics::mean};

/// The last record in which a quantity is off its last value by more than `visible`; 0: none.
std::size_t last_change_of(const SharedVector<IterationRecord>& records, double visible) {
  for (std::size_t k = records.size(); k-- > 0;) {
    const auto off = [&](double Statistics::*value) {
      return std::abs(records[k].statistics.*value - records.back().statistics.*value) > visible;
    };
    if (std::ranges::any_of(kCourses, off)) return k;
  }
  return 0;
}

/// Builds one plot.
class Builder {
 public:
  Builder(const ViewState& state, const SessionView& session, const SortedQualities& sorted, const Palette& palette)
      : state_(state), session_(session), sorted_(sorted), palette_(palette) {
    plot_.tab = state.plot;
    plot_.axis = state.plots[static_cast<std::size_t>(state.plot)].axis;
    several_ = session.runs.size() > 1;
    names_ = run_names(session);
  }

  Plot build() {
    if (several_) add_runs_to_legend();
    switch (state_.plot) {
      case PlotTab::Convergence:
        build_convergence();
        break;
      case PlotTab::Compare:
        build_judged();
        break;
      case PlotTab::Histogram:
        build_histogram();
        break;
      case PlotTab::Sorted:
        build_sorted();
        break;
      case PlotTab::Moved:
        build_moved();
        break;
      case PlotTab::Time:
        build_time();
        break;
      case PlotTab::Runs:
        plot_.empty_text = "the table of runs is no plot";
        break;
    }
    if (session_.input && !session_.several_meshes()) plot_.title = session_.input->mesh.name + " · " + plot_.title;
    if (plot_.axis == ValueAxis::LogDistance) plot_.y_title = "1 − " + plot_.y_title;
    return std::move(plot_);
  }

 private:
  /// Not those that a person took out.
  [[nodiscard]] bool is_shown(std::size_t k) const { return !state_.panes.hidden_runs.contains(session_.runs[k].id); }

  [[nodiscard]] bool shows_frame(const Frame& frame) const { return frame.run >= session_.runs.size() || is_shown(frame.run); }

  /// "2 laplace"; with more where another run has the same method.
  [[nodiscard]] std::string run_name(std::size_t k) const { return several_ ? names_[k].whole() : std::string(); }

  [[nodiscard]] Series series_of_run(std::size_t k, std::string name, double dash = 0.0, double strength = 1.0) const {
    Series series;
    series.run = run_name(k);
    series.name = std::move(name);
    series.colour = palette_.run(k);
    series.width = k == session_.active ? kThick : kThin;
    series.dash = dash;
    series.strength = strength;
    return series;
  }

  void add_runs_to_legend() {
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      plot_.legend.push_back({run_name(k), true, session_.runs[k].title, series_of_run(k, {})});
      plot_.legend.back().look.width = 4.0;
    }
  }

  /// The quantity's name in the legend, looking as its series do.
  void add_to_legend(const Series& look, std::string tip = {}) {
    for (const LegendEntry& entry : plot_.legend) {
      if (entry.name == look.name) return;
    }
    LegendEntry entry{look.name, false, std::move(tip), {}};
    entry.look.colour = several_ && !look.run.empty() ? palette_.text : look.colour;
    entry.look.kind = look.kind;
    entry.look.width = std::min(look.width, 2.0);
    entry.look.dash = look.dash;
    entry.look.strength = look.strength;
    plot_.legend.push_back(std::move(entry));
  }

  [[nodiscard]] std::vector<double> course(const RunView& run) const { return course_of(run, state_.plot_options.by_seconds); }

  void describe_course() {
    plot_.x_name = state_.plot_options.by_seconds ? "seconds" : "iteration";
    plot_.x_title = plot_.x_name;
    plot_.integer_x = !state_.plot_options.by_seconds;
    double longest = 0.0;
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      const auto x = course(session_.runs[k]);
      if (!x.empty()) longest = std::max(longest, x.back());
    }
    plot_.x_range = Range{0.0, longest > 0.0 ? longest : 1.0};
    if (state_.plot_options.by_seconds) {
      plot_.x_unit = time_unit(longest);
      plot_.x_title = "smoothing time, " + plot_.x_unit.name;
    }
    lay_along(longest);
    if (session_.runs.empty()) return;
    mark(session_.active, session_.runs[session_.active].moment, {});
    for (std::size_t k = 0; k < session_.runs.size(); ++k)
      for (const auto& [since, label] :
           {std::pair{session_.runs[k].phases.joint_since, "joint"}, {session_.runs[k].phases.mean_since, "mean"}})
        if (since && *since > 0) mark(k, {*since}, several_ ? fmt::format("{} {}", k + 1, label) : label);
    for (const auto& [its, label] : {std::pair{&state_.timeline.a, "A"}, {&state_.timeline.b, "B"}}) {
      if (its->frame && session_.frame) mark(its->frame->run, its->frame->moment, label);
    }
  }

  /// How the course lies along the plot, `longest` being its end.
  void lay_along(double longest) {
    if (!(longest > 0.0)) return;
    if (state_.plot_options.x_axis == XAxis::Log) {
      plot_.x_pivot = first_step();
    } else if (state_.plot_options.x_axis == XAxis::Changes) {
      const double until = last_change();
      if (!(until > 0.0 && until < kMuch * longest)) return;
      plot_.x_home = Range{0.0, until};
      const std::string all = plot_.integer_x ? count(static_cast<std::uint64_t>(longest)) : short_number(longest * plot_.x_unit.factor);
      plot_.x_title += fmt::format(", up to the last change; all: {}", all);
    }
  }

  /// An iteration, or the seconds of the fastest first one.
  [[nodiscard]] double first_step() const {
    if (plot_.integer_x) return 1.0;
    double least = INFINITY;
    for (const RunView& run : session_.runs)
      if (const auto x = course(run); x.size() > 1 && x[1] > 0.0) least = std::min(least, x[1]);
    return std::isfinite(least) ? least : 0.0;
  }

  /// Some room behind the last place at which a run changed by more than a hundredth of what the plot of its qualities spans.
  [[nodiscard]] double last_change() const {
    double low = INFINITY, high = -INFINITY, last = 0.0;
    for (const RunView& run : session_.runs) {
      for (const IterationRecord& record : run.records) {
        for (const double Statistics::*value : kCourses) {
          if (!std::isfinite(record.statistics.*value)) continue;
          low = std::min(low, record.statistics.*value);
          high = std::max(high, record.statistics.*value);
        }
      }
    }
    if (!(high > low)) return 0.0;
    for (const RunView& run : session_.runs) {
      const auto x = course(run);
      if (!x.empty()) last = std::max(last, x[std::min(last_change_of(run.records, 0.01 * (high - low)) + 1, x.size() - 1)]);
    }
    return 1.15 * last;
  }

  void mark(std::size_t run, const Moment& moment, std::string label) {
    if (run >= session_.runs.size() || !is_shown(run)) return;
    const auto& records = session_.runs[run].records;
    if (records.size() > 1 && moment.iteration < records.size())
      plot_.marks.push_back({course(session_.runs[run])[moment.iteration], std::move(label)});
  }

  template <class Value>
  void add_course(std::size_t run, Series series, Value value, std::size_t first = 0) {
    const auto& records = session_.runs[run].records;
    const auto x = course(session_.runs[run]);
    for (std::size_t k = first; k < records.size(); ++k) {
      series.x.push_back(x[k]);
      series.y.push_back(finite_or_gap(value(records[k])));
    }
    plot_.series.push_back(std::move(series));
  }

  void build_convergence() {
    describe_course();
    plot_.y_title = "quality";
    plot_.empty_text = "open a mesh and run to see how its quality rises";
    if (session_.runs.empty()) return;
    plot_.y_title = metric_phrase(session_.runs[session_.active].parameters.metric);
    bool movable_differs = false, inverted = false, joint = false;
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      const RunView& run = session_.runs[k];
      if (run.parameters.metric != session_.runs[session_.active].parameters.metric) plot_.y_title = "quality, each run by its own metric";
      for (const IterationRecord& record : run.records) {
        movable_differs = movable_differs || record.statistics.movable_minimum != record.statistics.minimum;
        inverted = inverted || record.statistics.inverted > 0;
        joint = joint || record.joint.has_value();
      }
    }
    plot_.title = fmt::format("{} by {}", plot_.y_title.substr(0, plot_.y_title.find(',')), plot_.x_name);
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      add_course(k, series_of_run(k, "minimum"), [](const IterationRecord& record) { return record.statistics.minimum; });
      add_to_legend(plot_.series.back(), "quality of the worst element");
      if (movable_differs) {
        add_course(k, series_of_run(k, "movable minimum", 5.0),
                   [](const IterationRecord& record) { return record.statistics.movable_minimum; });
        add_to_legend(plot_.series.back(), "of the worst element that has a free corner");
      }
      if (joint) {
        Series bound = series_of_run(k, "bound", 2.0);
        bound.width = 1.2;
        add_course(k, std::move(bound), [](const IterationRecord& record) {
          const bool known = record.joint && record.joint->end == JointState::End::None && !record.joint->beyond;
          return known ? record.joint->bound : std::numeric_limits<double>::quiet_NaN();
        });
        add_to_legend(plot_.series.back(), "what the cluster that moved can reach at most, by duality");
      }
      Series mean = series_of_run(k, "mean", 0.0, 0.7);
      mean.width = 1.2;
      add_course(k, std::move(mean), [](const IterationRecord& record) { return record.statistics.mean; });
      add_to_legend(plot_.series.back());
      add_percentiles(k);
      if (!inverted) continue;
      Series strip = series_of_run(k, "inverted", 2.0);
      strip.strip = true;
      add_course(k, std::move(strip), [](const IterationRecord& record) { return static_cast<double>(record.statistics.inverted); });
      add_to_legend(plot_.series.back(), "inverted elements, in the strip below");
      plot_.strip_share = 0.27;
      plot_.strip_title = "inverted";
    }
  }

  /// The minima of all runs by one metric; by another metric than a run's own at those of its iterations that were judged by it.
  void build_judged() {
    describe_course();
    const bool own = state_.plot_options.judged_own;
    plot_.y_title = own ? "worst element, each run by its own metric" : "worst element by " + metric_phrase(session_.shown);
    plot_.title = "comparison by " + plot_.x_name;
    plot_.empty_text = "compare runs to see how each fares by the metric of the others";
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      const RunView& run = session_.runs[k];
      if (own || run.parameters.metric == session_.shown) {
        add_course(k, series_of_run(k, "minimum"), [](const IterationRecord& record) { return record.statistics.minimum; });
        continue;
      }
      Series series = series_of_run(k, "minimum");
      const JudgedBy* judged = judged_by(run, session_.shown);
      const auto x = course(run);
      for (std::size_t i = 0; judged != nullptr && i < judged->course.size(); ++i) {
        if (judged->course[i].iteration >= x.size()) continue;
        series.x.push_back(x[judged->course[i].iteration]);
        series.y.push_back(finite_or_gap(judged->course[i].minimum));
      }
      plot_.series.push_back(std::move(series));
    }
  }

  void add_percentiles(std::size_t k) {
    const RunView& run = session_.runs[k];
    if (run.percentiles.empty()) return;
    struct Kind {
      const char *name, *tip;
      double Percentiles::*value;
      double dash;
    };
    for (const Kind& kind : {Kind{"worst 1 %", "a hundredth of the elements is worse", &Percentiles::p1, 1.5},
                             Kind{"worst 5 %", "a twentieth of the elements is worse", &Percentiles::p5, 3.0},
                             Kind{"median", "half of the elements are worse", &Percentiles::p50, 9.0}}) {
      Series series = series_of_run(k, kind.name, kind.dash, 0.85);
      series.width = 1.2;
      add_course(k, std::move(series), [&](const IterationRecord& record) {
        const auto at = static_cast<std::size_t>(&record - run.records.begin());
        return at < run.percentiles.size() ? run.percentiles[at].*kind.value : NAN;
      });
      add_to_legend(plot_.series.back(), kind.tip);
    }
  }

  /// Of the shown metric, of a run whose elements are not in the frame; null where it is not worked out yet.
  [[nodiscard]] const RunSummary* summary_of(std::size_t k) const {
    const RunSummary* summary = session_.runs[k].summary.get();
    return k != session_.frame->run && is_shown(k) && summary != nullptr && summary->metric == session_.frame->shown ? summary : nullptr;
  }

  void build_moved() {
    describe_course();
    plot_.y_title = "vertices moved in an iteration";
    plot_.title = "vertices moved by " + plot_.x_name;
    plot_.empty_text = "run to see how many vertices move";
    plot_.from_zero = true;
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      add_course(
          k, series_of_run(k, {}), [](const IterationRecord& record) { return static_cast<double>(record.moved); }, 1);
    }
  }

  void build_time() {
    describe_course();
    plot_.title = "time by " + plot_.x_name;
    plot_.empty_text = "run to see how long it takes";
    plot_.from_zero = true;
    double longest = 0.0, whole = 0.0;
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (!is_shown(k)) continue;
      add_course(
          k, series_of_run(k, "an iteration"), [](const IterationRecord& record) { return record.seconds; }, 1);
      add_to_legend(plot_.series.back(), "smoothing alone");
      for (const double seconds : plot_.series.back().y) longest = std::isfinite(seconds) ? std::max(longest, seconds) : longest;
      Series sum = series_of_run(k, "since the input", 5.0);
      sum.strip = true;
      double seconds = 0.0;
      add_course(
          k, std::move(sum), [&seconds](const IterationRecord& record) { return seconds += record.seconds; }, 1);
      add_to_legend(plot_.series.back(), "all iterations so far, in the strip below");
      whole = std::max(whole, seconds);
    }
    plot_.y_unit = time_unit(longest);
    plot_.strip_unit = time_unit(whole);
    plot_.y_title = "time of an iteration, " + plot_.y_unit.name;
    plot_.strip_title = "all, " + plot_.strip_unit.name;
    plot_.strip_share = 0.4;
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
    Series before;
    before.name = "input";
    before.colour = palette_.dim;
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
    if (frame->now.below > 0) plot_.y_title += fmt::format(" ({} below {:g})", count(frame->now.below), frame->now.lowest);
    if (state_.plot_options.histogram_range == HistogramRange::Data) show_data_alone();
  }

  /// At first the histogram shows whole bars from where its elements begin to where they end. A few far down, no more than a thousandth,
  /// are left out where all else gets much wider by that; how many is said.
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
    if (home.second - home.first > kMuch * (all.second - all.first)) return;
    plot_.x_home = home;
    if (!cut) return;
    double left_out = 0.0;  // now
    for (const Series& one : plot_.series) {
      if (one.name == "input" && plot_.series.size() > 1) continue;
      for (std::size_t k = 0; k < one.x.size() && one.x[k] + one.bar_width <= home.first + 1e-9; ++k) left_out += one.y[k];
    }
    if (left_out > 0.0)
      plot_.y_title += fmt::format(" · {} below {:.3g}, left of what is shown", count(static_cast<std::uint64_t>(left_out)), home.first);
  }

  /// The filter is the histogram's brush; how many elements it leaves is said beside.
  void brush(const Frame& frame) {
    const auto& filter = state_.colouring.filter;
    if (!filter) return;
    plot_.brush = *filter;
    if (frame.quality.empty()) return;  // they are on a device
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
    Series before;
    before.name = "input";
    before.colour = palette_.dim;
    if (moved || several_) add_sorted(std::move(before), sorted_.before);
    if (shows_frame(*frame)) add_sorted(series_of_run(frame->run, moved || several_ ? "now" : "input"), sorted_.now);
    for (std::size_t k = 0; k < session_.runs.size(); ++k) {
      if (const RunSummary* summary = summary_of(k)) add_sorted(series_of_run(k, "now"), summary->sorted);
    }
  }

  const ViewState& state_;
  const SessionView& session_;
  const SortedQualities& sorted_;
  const Palette& palette_;
  bool several_ = false;
  std::vector<RunName> names_;
  Plot plot_;
};

}  // namespace

Plot build_plot(const ViewState& state, const SessionView& session, const SortedQualities& sorted, const Palette& palette) {
  return Builder(state, session, sorted, palette).build();
}

std::string plot_key(const ViewState& state, const SessionView& session, const SortedQualities& sorted) {
  const PlotView& view = state.plots[static_cast<std::size_t>(state.plot)];
  const PlotOptions& options = state.plot_options;
  std::string key =
      fmt::format("{} {} {} {} {} {} {} {} {} {}", static_cast<int>(state.plot), static_cast<int>(view.axis), options.by_seconds,
                  options.bins, static_cast<int>(options.x_axis), static_cast<int>(options.histogram_range),
                  session.frame ? session.frame->serial : 0, session.active, sorted.before.size(), sorted.now.size());
  if (const auto& filter = state.colouring.filter) fmt::format_to(std::back_inserter(key), " {}:{}", filter->first, filter->second);
  for (const Mark* mark : {&state.timeline.a, &state.timeline.b}) key += mark->frame ? fmt::format(" {}", mark->frame->serial) : " -";
  for (const RunView& run : session.runs) {
    if (state.panes.hidden_runs.contains(run.id)) key += " -";
    fmt::format_to(std::back_inserter(key), " {} {} {} {}", run.title, run.records.size(), fmt::ptr(run.percentiles.data()),
                   fmt::ptr(run.summary.get()));
  }
  return key;
}

std::uint64_t iteration_at(const RunView& run, bool by_seconds, double x) {
  const std::vector<double> places = course_of(run, by_seconds);
  if (places.empty()) return 0;
  const auto nearest =
      std::min_element(places.begin(), places.end(), [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
  return run.records[static_cast<std::size_t>(nearest - places.begin())].iteration;
}

std::vector<double> rebinned(const Histogram& histogram, std::size_t bins) {
  const std::size_t each = Histogram::kBins / bins;
  std::vector<double> sums(bins, 0.0);
  for (std::size_t k = 0; k < Histogram::kBins; ++k) sums[std::min(k / each, bins - 1)] += static_cast<double>(histogram.counts[k]);
  return sums;
}

}  // namespace dmoscope::ui
