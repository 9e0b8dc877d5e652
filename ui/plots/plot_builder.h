#pragma once
// What the plots' builders have in common. Only for sources of this room.

#include <string>
#include <vector>

#include "ui/plots/plot_series.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {

/// What a plot is made of.
struct PlotSources {
  const ViewState& state;
  const SessionView& session;
  const SortedQualities& sorted;
  const Palette& palette;
};

/// Where each record of a run stands along a plot of iterations or seconds.
[[nodiscard]] std::vector<double> course_of(const RunView& run, bool by_seconds);

/// Convergence, comparison, moved vertices and time: with iterations, or the seconds that they took, along them.
[[nodiscard]] Plot course_plot(const PlotSources& sources);
/// Histogram and sorted qualities.
[[nodiscard]] Plot distribution_plot(const PlotSources& sources);

/// To show so much of a range alone is not worth while.
inline constexpr double kMuchOfARange = 0.9;

class PlotBuilder {
 protected:
  explicit PlotBuilder(const PlotSources& sources);

  /// Not those that a person took out.
  [[nodiscard]] bool is_shown(std::size_t k) const { return !state_.panes.hidden_runs.contains(session_.runs[k].id); }

  [[nodiscard]] bool shows_frame(const Frame& frame) const { return frame.run >= session_.runs.size() || is_shown(frame.run); }

  /// "2 laplace"; with more where another run has the same method.
  [[nodiscard]] std::string run_name(std::size_t k) const { return several_ ? names_[k].whole() : std::string(); }

  [[nodiscard]] Series series_of_run(std::size_t k, std::string name, double dash = 0.0, double strength = 1.0) const;
  /// The quantity's name in the legend, looking as its series do.
  void add_to_legend(const Series& look, std::string tip = {});

  const ViewState& state_;
  const SessionView& session_;
  const SortedQualities& sorted_;
  const Palette& palette_;
  bool several_ = false;  // runs
  std::vector<RunName> names_;
  Plot plot_;
};

}  // namespace dmoscope::ui
