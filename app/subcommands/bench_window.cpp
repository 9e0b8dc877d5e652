#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/machine.h"
#include "app/common/text.h"
#include "app/subcommands/bench_pictures.h"
#include "core/base/error.h"
#include "core/base/words.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/window_bench.h"
#endif

namespace dmoscope::app {

#ifdef DMOSCOPE_HAVE_GUI

namespace {

struct Line {
  const char *what, *key;
  WindowCost WindowFigure::*cost;
};
constexpr auto kLines = std::to_array<Line>({{"start to first picture", "first", &WindowFigure::first},
                                             {"start to full picture", "full", &WindowFigure::full},
                                             {"start to rest", "rest", &WindowFigure::rest},
                                             {"zoom, until seen", "zoom", &WindowFigure::zoom},
                                             {"zoom in the midst of drawing", "zoom_in_midst", &WindowFigure::zoom_in_midst},
                                             {"drag, until seen", "drag", &WindowFigure::pan},
                                             {"pick, until seen", "pick", &WindowFigure::pick},
                                             {"fit, until seen", "fit", &WindowFigure::fit},
                                             {"an iteration, until seen", "iteration", &WindowFigure::iteration},
                                             {"metric shown during a run", "metric", &WindowFigure::metric},
                                             {"60 iterations, drawn", "run", &WindowFigure::run}});

void print_figure(const WindowFigure& figure) {
  print("{}; {}, {}, commit {}\n{} vertices, {} elements; {}\n\n", processor(), compiler(), DMOSCOPE_BUILD_TYPE, commit(),
        grouped(figure.vertices), grouped(figure.elements), figure.renderer);
  print("{:<30} {:>12} {:>12}\n", "", "ms", "processor ms");
  for (const Line& line : kLines) {
    const WindowCost& cost = figure.*line.cost;
    print("{:<30} {:>12.0f} {:>12.0f}\n", line.what, 1e3 * cost.seconds, 1e3 * cost.processor);
  }
  print("{:<30} {:>12} frames at most, {:.0f} ms\n", "metric shown during a run", figure.metric_frames, 1e3 * figure.metric_longest);
  print("{:<30} {:>12.0f}\n", "longest answer", 1e3 * figure.longest);
  for (const auto& [what, bytes] : {std::pair{"memory, most until open", figure.memory_open}, {"memory, most after 60", figure.memory_run}})
    print("{:<30} {:>9.2f} GB\n", what, 1e-9 * static_cast<double>(bytes));
}

Json json_of(const WindowFigure& figure) {
  Json costs;
  for (const Line& line : kLines) {
    const WindowCost& cost = figure.*line.cost;
    costs[line.key] = {{"seconds", json_number(cost.seconds)}, {"processor_seconds", json_number(cost.processor)}};
  }
  return {{"commit", commit()},
          {"build", DMOSCOPE_BUILD_TYPE},
          {"processor", processor()},
          {"renderer", figure.renderer},
          {"vertices", figure.vertices},
          {"elements", figure.elements},
          {"costs", std::move(costs)},
          {"metric_frames", figure.metric_frames},
          {"metric_longest", json_number(figure.metric_longest)},
          {"longest_answer", json_number(figure.longest)},
          {"memory_open", figure.memory_open},
          {"memory_after_60", figure.memory_run}};
}

}  // namespace

void bench_window(const BenchPlan& plan, const std::filesystem::path& file, bool json, Progress& progress) {
  WindowSubject subject;
  subject.line = file.empty() ? fmt::format("generate {} {}", plan.elements.front().generator, plan.sizes.front())
                              : "open " + quote_word(file.string());
  subject.acceleration = plan.cpu ? Acceleration{nullptr, "not asked for"} : plan.acceleration;
  subject.threads = *std::ranges::max_element(plan.threads);
  const WindowFigure figure = measure_window(subject, progress);
  if (json) {
    print_json(json_of(figure));
  } else {
    print_figure(figure);
  }
}

#else

void bench_window(const BenchPlan&, const std::filesystem::path&, bool, Progress&) {
  throw UsageError("--window: this program was built without OpenGL, so it draws nothing");
}

#endif

}  // namespace dmoscope::app
