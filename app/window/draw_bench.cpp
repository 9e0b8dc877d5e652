#include "app/window/draw_bench.h"

#include <chrono>

#include "app/window/bench_stage.h"
#include "core/view/frame_builder.h"

namespace dmoscope::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point a, Clock::time_point b) { return std::chrono::duration<double>(b - a).count(); }

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

}  // namespace dmoscope::app
