#include "app/window/seek_bench.h"

#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "app/window/bench_stage.h"
#include "core/base/stopwatch.h"
#include "core/mesh/random.h"

namespace dmoscope::app {
namespace {

/// Posts a seek, waits for the engine as a window would, and returns the view that shows it.
std::shared_ptr<const SessionView> seek(Engine& engine, std::uint64_t iteration) {
  engine.post(fmt::format("seek {}", iteration));
  while (engine.busy()) std::this_thread::sleep_for(std::chrono::microseconds(20));
  return engine.view();
}

}  // namespace

SeekFigure measure_seeks(Engine& engine, const Acceleration& acceleration, std::uint64_t iterations, std::uint64_t seeks,
                         Progress& progress) {
  constexpr int kWidth = 1280, kHeight = 800;
  SeekFigure figure;
  Random random(1);
  const auto anywhere = [&] { return random.below(iterations + 1); };
  for (std::uint64_t i = 0; i < seeks; ++i) {
    progress.check();
    const Stopwatch watch;
    (void)seek(engine, anywhere());
    figure.seeks.push_back(watch.seconds());
  }
  BenchStage stage(acceleration, kWidth, kHeight);
  stage.show(engine.view()->frame);
  for (std::uint64_t i = 0; i < seeks; ++i) {
    progress.check();
    const Stopwatch watch;
    const auto view = seek(engine, anywhere());
    const Stopwatch drawing;
    stage.show(view->frame);
    figure.full_frames.push_back(drawing.seconds());
    figure.drawn.push_back(watch.seconds());
  }
  figure.renderer = stage.context().description();
  return figure;
}

}  // namespace dmoscope::app
