#include "ui/plots/plot_builder.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace dmoscope::ui {
namespace {

constexpr double kThick = 2.2, kThin = 1.5;

}  // namespace

PlotBuilder::PlotBuilder(const PlotSources& sources)
    : state_(sources.state),
      session_(sources.session),
      sorted_(sources.sorted),
      palette_(sources.palette),
      several_(sources.session.runs.size() > 1),
      names_(run_names(sources.session)) {
  plot_.tab = state_.plot;
  plot_.axis = state_.plots[static_cast<std::size_t>(state_.plot)].axis;
  if (!several_) return;
  for (std::size_t k = 0; k < session_.runs.size(); ++k) {
    if (!is_shown(k)) continue;
    plot_.legend.push_back({run_name(k), true, session_.runs[k].title, series_of_run(k, {}), names_[k].brief()});
    plot_.legend.back().look.width = 4.0;
  }
}

Series PlotBuilder::series_of_run(std::size_t k, std::string name, double dash, double strength) const {
  Series series;
  series.run = run_name(k);
  series.name = std::move(name);
  series.colour = palette_.run(k);
  series.width = k == session_.active ? kThick : kThin;
  series.dash = dash;
  series.strength = strength;
  return series;
}

void PlotBuilder::add_to_legend(const Series& look, std::string tip) {
  for (const LegendEntry& entry : plot_.legend) {
    if (entry.name == look.name) return;
  }
  LegendEntry entry{look.name, false, std::move(tip), {}, look.name};
  entry.look.colour = several_ && !look.run.empty() ? palette_.text : look.colour;
  entry.look.kind = look.kind;
  entry.look.width = std::min(look.width, 2.0);
  entry.look.dash = look.dash;
  entry.look.strength = look.strength;
  plot_.legend.push_back(std::move(entry));
}

Plot build_plot(const ViewState& state, const SessionView& session, const SortedQualities& sorted, const Palette& palette) {
  const PlotSources sources{state, session, sorted, palette};
  const bool table = state.plot == PlotTab::Runs;
  Plot plot = over_iterations(state.plot) ? course_plot(sources) : distribution_plot(sources);
  if (table) plot.empty_text = "the table of runs is not a plot";
  if (session.input && !session.several_meshes()) plot.title = session.input->mesh.name + " · " + plot.title;
  if (plot.axis == ValueAxis::LogDistance) plot.y_title = "1 − " + plot.y_title;
  return plot;
}

std::string plot_key(const ViewState& state, const SessionView& session, const SortedQualities& sorted) {
  const PlotView& view = state.plots[static_cast<std::size_t>(state.plot)];
  const PlotOptions& options = state.plot_options;
  std::string key = fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}", static_cast<int>(state.plot), static_cast<int>(view.axis),
                                options.by_seconds, options.bins, static_cast<int>(options.x_axis),
                                static_cast<int>(options.histogram_range), session.frame ? session.frame->serial : 0, session.active,
                                sorted.before.size(), sorted.now.size(), options.judged_own, info(session.shown).name);
  if (const auto& filter = state.colouring.filter) fmt::format_to(std::back_inserter(key), " {}:{}", filter->first, filter->second);
  for (const Mark* mark : {&state.timeline.a, &state.timeline.b}) key += mark->frame ? fmt::format(" {}", mark->frame->serial) : " -";
  for (const RunView& run : session.runs) {
    if (state.panes.hidden_runs.contains(run.id)) key += " -";
    fmt::format_to(std::back_inserter(key), " {} {} {} {} {}", run.title, run.records.size(), fmt::ptr(run.percentiles.data()),
                   fmt::ptr(run.summary.get()), fmt::ptr(run.judged.get()));
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
