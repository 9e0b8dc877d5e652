#pragma once
// Plots, and the sessions that they show, for tests of plots.

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/engine/engine.h"
#include "ui/analysis/derived.h"
#include "ui/plots/plot_builder.h"

namespace dmoscope::ui {

inline const Palette& colours() { return palette(Theme::Light); }

inline IterationRecord record(std::uint64_t iteration, double minimum, double mean, double seconds) {
  IterationRecord made;
  made.iteration = iteration;
  made.statistics.minimum = minimum;
  made.statistics.mean = mean;
  made.statistics.movable_minimum = minimum + 0.01;
  made.moved = 100 - iteration;
  made.seconds = seconds;
  return made;
}

inline void set_records(RunView& run, std::vector<IterationRecord> records) {
  run.records = SharedVector<IterationRecord>(std::make_shared<const std::vector<IterationRecord>>(std::move(records)));
}

/// Changes the statistics of one record.
template <class Change>
void change(RunView& run, std::size_t k, Change how) {
  std::vector<IterationRecord> records = run.records.whole();
  how(records.at(k).statistics);
  set_records(run, std::move(records));
}

/// A session without a mesh, for plots that need only the runs' records.
inline SessionView session_of(std::size_t runs, std::size_t records) {
  SessionView session;
  for (std::size_t r = 0; r < runs; ++r) {
    RunView run;
    run.title = "run " + std::to_string(r);
    std::vector<IterationRecord> made;
    for (std::size_t k = 0; k < records; ++k) {
      const double t = static_cast<double>(k) + 10.0 * static_cast<double>(r);
      made.push_back(record(k, 0.1 + 0.001 * t, 0.8 + 0.0005 * t, k == 0 ? 0.0 : 0.002 + 0.0001 * t));
    }
    set_records(run, std::move(made));
    session.runs.push_back(std::move(run));
  }
  return session;
}

inline Plot plot_of(const ViewState& state, const SessionView& session) { return build_plot(state, session, {}, colours()); }

inline Plot plot_of(const SessionView& session) {
  const auto state = std::make_unique<ViewState>();
  return plot_of(*state, session);
}

/// A plot whose iterations lie evenly, so that places are easy to tell.
inline Plot even_plot_of(const SessionView& session) {
  const auto state = std::make_unique<ViewState>();
  state->plot_options.x_axis = XAxis::Linear;
  return plot_of(*state, session);
}

inline const Series& series_named(const Plot& plot, const std::string& run, const std::string& name) {
  for (const Series& one : plot.series) {
    if (one.run == run && one.name == name) return one;
  }
  throw std::out_of_range(run + "/" + name);
}

inline std::shared_ptr<const SessionView> smoothed(const std::string& mesh, int iterations) {
  Engine engine(1);
  engine.post("generate " + mesh);
  engine.post("run " + std::to_string(iterations));
  engine.wait_idle();
  return engine.view();
}

}  // namespace dmoscope::ui
