#pragma once
// Builds the window's plots from the session.

#include <span>

#include "core/view/view.h"
#include "ui/plots/plot.h"
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

}  // namespace dmoscope::ui
