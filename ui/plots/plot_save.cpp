#include "ui/plots/plot_save.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/writing/atomic_file.h"
#include "render/drawing_picture.h"
#include "ui/analysis/comparison.h"
#include "ui/plots/plot_drawing.h"
#include "ui/plots/run_rows.h"

namespace dmoscope::ui {
namespace {

std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : std::string(); }

/// A word as a field of a CSV table.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

Drawing drawing_of(const PlotSave& save, const Plot& plot, const PlotView& view, double unit) {
  const double width = save.width > 0 ? save.width / unit : 800.0, height = save.height > 0 ? save.height / unit : 450.0;
  PlotInk ink = ink_of(palette(Theme::Light));
  ink.background = {255, 255, 255};
  return whole_plot(plot, view, width, height, ink);
}

void save_table(const PlotSave& save, ViewState& state, const SessionView& session, std::vector<Message>& said) {
  if (session.runs.empty()) throw UsageError("there are no runs yet");
  std::string text = run_table_csv(rows_to_save(session, state.plot_options));
  if (save.path.empty()) {
    state.requests.clipboard = std::move(text);
    return;
  }
  if (save.path.extension() != ".csv") throw UsageError("the table of runs is saved as .csv");
  write_file_atomically(save.path, text);
  said.push_back({Message::Kind::Info, "table of runs saved as " + save.path.string(), 0});
}

/// Writes a plot, all or nothing. Throws Error.
void save_plot(const PlotSave& save, const Plot& plot, const PlotView& view) {
  const std::string extension = save.path.extension().string();
  if (extension == ".csv") {
    write_file_atomically(save.path, plot_csv(plot, view));
  } else if (extension == ".svg") {
    write_file_atomically(save.path, svg_of(drawing_of(save, plot, view, 1.0)));
  } else if (extension == ".png") {
    render::write_png(save.path, render::picture_of(drawing_of(save, plot, view, save.scale), save.scale));
  } else {
    throw UsageError("a plot is saved as .csv, .svg or .png");
  }
}

}  // namespace

std::string plot_csv(const Plot& plot, const PlotView& view) {
  const bool bars = plot.tab == PlotTab::Histogram;
  std::string text = bars ? "run,series,from,to,elements\n" : fmt::format("run,series,{},value\n", plot.x_name);
  const Range range = x_seen(plot, view);
  for (const Series& one : plot.series) {
    if (!is_visible(plot, view, one)) continue;
    const std::string head = field(one.run) + ',' + field(one.name.empty() ? plot.y_title : one.name);
    for (std::size_t k = 0; k < one.x.size(); ++k) {
      if (one.x[k] + one.bar_width < range.first || one.x[k] > range.second) continue;
      fmt::format_to(std::back_inserter(text), "{},{}", head, number(one.x[k]));
      if (bars) text += ',' + number(one.x[k] + one.bar_width);
      text += ',' + number(one.y[k]) + '\n';
    }
  }
  return text;
}

std::vector<Message> serve_plot_requests(ViewState& state, const SessionView& session, const SortedQualities& sorted) {
  std::vector<Message> said;
  while (!state.requests.plots.empty()) {
    const PlotSave save = std::move(state.requests.plots.front());
    state.requests.plots.pop_front();
    try {
      if (state.plot == PlotTab::Runs) {
        save_table(save, state, session, said);
        continue;
      }
      const bool numbers = save.path.empty() || save.path.extension() == ".csv";
      if (state.plot == PlotTab::Compare && numbers && session.runs.size() > 1) {
        const std::string text = comparison_csv(compare_runs(session), session);
        if (save.path.empty()) {
          state.requests.clipboard = text;
        } else {
          write_file_atomically(save.path, text);
          said.push_back({Message::Kind::Info, "comparison saved as " + save.path.string(), 0});
        }
        continue;
      }
      const Plot plot = build_plot(state, session, sorted, palette(Theme::Light));
      if (plot.series.empty()) throw UsageError("there is no plot yet: " + plot.empty_text);
      if (save.path.empty()) {
        state.requests.clipboard = plot_csv(plot, state.plot_view());
      } else {
        save_plot(save, plot, state.plot_view());
        said.push_back({Message::Kind::Info, "plot saved as " + save.path.string(), 0});
      }
    } catch (const Error& error) {
      said.push_back({Message::Kind::Error, error.what(), error.exit_code()});
    }
  }
  return said;
}

}  // namespace dmoscope::ui
