#include "app/window/draw_bench.h"

#include <chrono>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "app/window/interop.h"
#include "core/base/stopwatch.h"
#include "core/mesh/random.h"
#include "core/view/frame_builder.h"
#include "render/planar_scene.h"

namespace dmoscope::app {
namespace {

/// A scene with its framebuffer, on an OpenGL context of its own.
class BenchStage {
 public:
  BenchStage(const Acceleration& acceleration, int width, int height)
      : context_(headless_context_for(acceleration)), picture_(width, height) {
    scene_.draw_through_host(no_interop(acceleration, *context_));
  }
  void show(const std::shared_ptr<const Frame>& frame) {
    scene_.show(frame);
    if (first_) {
      const Vec2<double> viewport{static_cast<double>(picture_.width()), static_cast<double>(picture_.height())};
      camera_ = render::Camera2D::fit(scene_.bounds(), viewport);
      first_ = false;
    }
    scene_.draw(picture_, camera_, render::Style::dark());
    context_->finish();
  }
  [[nodiscard]] const render::Context& context() const { return *context_; }
  [[nodiscard]] const render::PlanarScene& scene() const { return scene_; }

 private:
  std::unique_ptr<render::Context> context_;
  render::Framebuffer picture_;
  render::PlanarScene scene_;
  render::Camera2D camera_;
  bool first_ = true;
};

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

/// Posts a seek, waits for the engine as a window would, and returns the view that shows it.
std::shared_ptr<const SessionView> seek(Engine& engine, std::uint64_t iteration) {
  engine.post(fmt::format("seek {}", iteration));
  while (engine.busy()) std::this_thread::sleep_for(std::chrono::microseconds(20));
  return engine.view();
}

}  // namespace

DrawFigure measure_drawing(const DrawSubject& subject, Progress& progress) {
  Session& session = subject.session;
  BenchStage stage(subject.acceleration, subject.width, subject.height);
  FrameBuilder builder;
  stage.show(builder.build(session)->frame);  // uploads the topology
  const auto step = [&] { session.active().step(StepUnit::Iteration, progress); };
  const auto publish = [&] { return builder.build(session, FrameDetail::Live)->frame; };
  step();
  std::shared_ptr<const Frame> frame = publish();
  stage.show(frame);  // shaders are compiled and buffers registered

  DrawFigure figure;
  const std::uint64_t bytes_before = frame->device ? frame->device->bytes_to_host() : 0;
  const Clock::time_point start = Clock::now();
  Clock::time_point end = start;
  for (; figure.frames < subject.frames; ++figure.frames) {
    const Clock::time_point begin = end;
    step();
    const Clock::time_point stepped = Clock::now();
    frame = publish();
    const Clock::time_point published = Clock::now();
    stage.show(frame);
    end = Clock::now();
    figure.step_seconds += seconds_between(begin, stepped);
    figure.publish_seconds += seconds_between(stepped, published);
    figure.draw_seconds += seconds_between(published, end);
  }
  figure.seconds = seconds_between(start, end);
  figure.bytes_to_host = frame->device ? frame->device->bytes_to_host() - bytes_before : 0;
  const Run& run = session.active();
  figure.backend = run.backend();
  figure.renderer = stage.context().description();
  figure.path = drawing_path(run.backend(), run.backend_reason(),
                             frame->device_trouble.empty() ? stage.scene().device_trouble() : frame->device_trouble);
  return figure;
}

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
