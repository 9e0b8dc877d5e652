#pragma once
// Common parts of the plots' builders. Only for sources of this module.

#include <string>
#include <vector>

#include "ui/plots/plot_series.h"
#include "ui/state/run_names.h"

namespace dmoscope::ui {

/// State that a plot is made from.
struct PlotSources {
  const ViewState& state;
  const SessionView& session;
  const SortedQualities& sorted;
  const Palette& palette;
};

/// Place of each record of a run along a plot of iterations or seconds.
[[nodiscard]] std::vector<double> course_of(const RunView& run, bool by_seconds);

/// Plot of convergence, comparison, moved vertices or time: with iterations, or the seconds that they took, along it.
[[nodiscard]] Plot course_plot(const PlotSources& sources);
/// Plot of the histogram or of sorted qualities.
[[nodiscard]] Plot distribution_plot(const PlotSources& sources);

/// Greatest share of a range that is worth showing alone.
inline constexpr double kMuchOfARange = 0.9;

class PlotBuilder {
 protected:
  explicit PlotBuilder(const PlotSources& sources);

  /// Whether a run is shown; not if a person took it out.
  [[nodiscard]] bool is_shown(std::size_t k) const { return !state_.panes.hidden_runs.contains(session_.runs[k].id); }

  [[nodiscard]] bool shows_frame(const Frame& frame) const { return frame.run >= session_.runs.size() || is_shown(frame.run); }

  /// Name of a run: "2 laplace"; longer if another run has the same method.
  [[nodiscard]] std::string run_name(std::size_t k) const { return several_ ? names_[k].whole() : std::string(); }

  [[nodiscard]] Series series_of_run(std::size_t k, std::string name, double dash = 0.0, double strength = 1.0) const;
  /// Adds a quantity's name to the legend, with the look of its series.
  void add_to_legend(const Series& look, std::string tip = {});

  const ViewState& state_;
  const SessionView& session_;
  const SortedQualities& sorted_;
  const Palette& palette_;
  bool several_ = false;  // there are several runs
  std::vector<RunName> names_;
  Plot plot_;
};

}  // namespace dmoscope::ui
