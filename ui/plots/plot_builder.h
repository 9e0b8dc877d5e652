#pragma once
// Builds the window's plots from the session.

#include <span>
#include <string>
#include <vector>

#include "core/view/view.h"
#include "ui/plots/plot.h"
#include "ui/state/run_names.h"
#include "ui/state/view_state.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {

/// Sorted samples of the shown metric of the active run; see Derived.
struct SortedQualities {
  std::span<const double> before, now;
};

/// The plot that `state` shows. Runs have the palette's colours, the active one the thickest lines.
[[nodiscard]] Plot build_plot(const ViewState& state, const SessionView& session, const SortedQualities& sorted, const Palette& palette);

/// Text that changes whenever build_plot() would make another plot of the same palette.
[[nodiscard]] std::string plot_key(const ViewState& state, const SessionView& session, const SortedQualities& sorted);

/// The iteration of a run that is nearest to `x` in plots over iterations, or over seconds.
[[nodiscard]] std::uint64_t iteration_at(const RunView& run, bool by_seconds, double x);

/// The histogram with its elements in fewer bins. `bins`: 16, 32 or 64.
[[nodiscard]] std::vector<double> rebinned(const Histogram& histogram, std::size_t bins);

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
