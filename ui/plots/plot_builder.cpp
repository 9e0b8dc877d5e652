#include "ui/plots/plot_builder.h"

#include <algorithm>
#include <utility>

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
    plot_.legend.push_back({run_name(k), true, session_.runs[k].title, series_of_run(k, {})});
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
  LegendEntry entry{look.name, false, std::move(tip), {}};
  entry.look.colour = several_ && !look.run.empty() ? palette_.text : look.colour;
  entry.look.kind = look.kind;
  entry.look.width = std::min(look.width, 2.0);
  entry.look.dash = look.dash;
  entry.look.strength = look.strength;
  plot_.legend.push_back(std::move(entry));
}

}  // namespace dmoscope::ui
