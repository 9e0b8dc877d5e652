#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "ui/analysis/comparison.h"
#include "ui/plots/plot_builder.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

/// Value to be plotted, with a gap for infinity, which stands for "there is no such element".
double finite_or_gap(double value) { return std::isfinite(value) ? value : NAN; }

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

class CoursePlot : PlotBuilder {
 public:
  explicit CoursePlot(const PlotSources& sources) : PlotBuilder(sources) {}

  Plot build() {
    if (state_.plot == PlotTab::Convergence) build_convergence();
    if (state_.plot == PlotTab::Compare) build_judged();
    if (state_.plot == PlotTab::Moved) build_moved();
    if (state_.plot == PlotTab::Time) build_time();
    return std::move(plot_);
  }

 private:
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
    const RunPhases& phases = session_.runs[session_.active].phases;  // those of all runs would lie on one another
    for (const auto& [since, label] : {std::pair{phases.joint_since, "joint"}, {phases.mean_since, "mean"}})
      if (since && *since > 0) mark(session_.active, {*since}, label);
    for (const auto& [its, label] : {std::pair{&state_.timeline.a, "A"}, {&state_.timeline.b, "B"}}) {
      if (its->frame && session_.frame) mark(its->frame->run, its->frame->moment, label);
    }
  }

  /// Lays the course along the plot up to `longest`.
  void lay_along(double longest) {
    if (!(longest > 0.0)) return;
    if (state_.plot_options.x_axis == XAxis::Log) {
      plot_.x_pivot = first_step();
    } else if (state_.plot_options.x_axis == XAxis::Changes) {
      const double until = last_change();
      if (!(until > 0.0 && until < kMuchOfARange * longest)) return;
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

  /// End of the changes: some room behind the last place at which a run changed by more than a hundredth of what the plot of its qualities
  /// spans.
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
        add_to_legend(plot_.series.back(), "quality of the worst element that has a free corner");
      }
      if (joint) {
        Series bound = series_of_run(k, "bound", 2.0);
        bound.width = 1.2;
        add_course(k, std::move(bound), [](const IterationRecord& record) {
          const bool known = record.joint && record.joint->end == JointState::End::None && !record.joint->beyond;
          return known ? record.joint->bound : std::numeric_limits<double>::quiet_NaN();
        });
        add_to_legend(plot_.series.back(), "upper bound of what the moved cluster can reach, by duality");
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

  /// Builds the minima of all runs by one metric; if a run optimises another metric, only at those iterations that were judged.
  void build_judged() {
    describe_course();
    const bool own = state_.plot_options.judged_own;
    plot_.y_title = own ? "worst element, each run by its own metric" : "worst element by " + metric_phrase(session_.shown);
    plot_.title = "comparison by " + plot_.x_name;
    plot_.legend_in_a_row = true;
    plot_.empty_text = "compare runs to see each by the metrics of the others";
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
    for (const Kind& kind : {Kind{"worst 1 %", "1 % of the elements are worse", &Percentiles::p1, 1.5},
                             Kind{"worst 5 %", "5 % of the elements are worse", &Percentiles::p5, 3.0},
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
};

}  // namespace

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

Plot course_plot(const PlotSources& sources) { return CoursePlot(sources).build(); }

}  // namespace dmoscope::ui
