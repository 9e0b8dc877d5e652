#include "app/window/window_bench.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <sys/resource.h>

#include "app/window/headless.h"
#include "core/base/stopwatch.h"

namespace dmoscope::app {
namespace {

constexpr int kAnswers = 5;  // answers of each kind

double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Peak memory of the program, in bytes.
std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

class Timer {
 public:
  [[nodiscard]] WindowCost cost() const { return {watch_.seconds(), processor_seconds() - before_}; }

 private:
  Stopwatch watch_;
  double before_ = processor_seconds();
};

/// Times of the next frame, as in a window on a screen: see Desktop::wait().
class Pace {
 public:
  void wake() {
    {
      const std::scoped_lock lock(mutex_);
      woken_ = true;
    }
    changed_.notify_all();
  }
  /// Takes note of a press.
  void input() { left_ = kFramesAfterEvent; }
  /// Waits until the next frame, which the window wants after `redraw_in` seconds.
  void wait(double redraw_in) {
    constexpr std::chrono::duration<double> kRefresh{1.0 / 60.0};
    constexpr double kMost = 1.0;
    std::this_thread::sleep_until(drawn_ + kRefresh);
    {
      std::unique_lock lock(mutex_);
      const std::chrono::duration<double> most{std::min(redraw_in, kMost)};
      if (left_ > 0) {
        --left_;
      } else if (changed_.wait_for(lock, most, [&] { return woken_; })) {
        left_ = kFramesAfterEvent;
      }
      woken_ = false;
    }
    drawn_ = std::chrono::steady_clock::now();
  }

 private:
  static constexpr int kFramesAfterEvent = 4;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool woken_ = false;
  int left_ = 0;
  std::chrono::steady_clock::time_point drawn_;
};

/// A window that is drawn like one on a screen.
class Subject {
 public:
  Subject(const WindowSubject& subject, Progress& progress)
      : progress_(progress),
        window_({.width = subject.width,
                 .height = subject.height,
                 .threads = subject.threads,
                 .acceleration = subject.acceleration,
                 .as_on_screen = true}) {
    app().set_wake([this] { pace_.wake(); });
  }
  ~Subject() { app().set_wake({}); }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  [[nodiscard]] ui::App& app() { return window_.app(); }
  [[nodiscard]] ui::ViewState& state() { return window_.app().state(); }
  void frame() {
    progress_.check();
    window_.frame();
    window_.present();
    for (const Message& message : window_.said())
      if (message.kind == Message::Kind::Error) throw Error(message.text);
  }
  /// Draws frames at the times that the window wants, until `done()`.
  template <class Done>
  void frames_until(const Done& done) {
    while (true) {
      frame();
      if (done()) return;
      constexpr double kWoken = 0.02;  // the session wakes a sleeping window
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(app().redraw_in(), kWoken)));
    }
  }
  /// Draws frames at a screen's rate, until `done()`; returns their number.
  template <class Done>
  int frames_on_screen(const Done& done) {
    for (int count = 1;; ++count) {
      frame();
      if (done()) return count;
      pace_.wait(app().redraw_in());
    }
  }
  [[nodiscard]] Pace& pace() noexcept { return pace_; }
  [[nodiscard]] bool complete() { return app().settled() && !app().activity().reduced && !app().engine().busy(); }
  void rest() {
    frames_until([&] { return complete() && std::isinf(app().redraw_in()); });
    app().engine().wait_idle();
    frames_until([&] { return complete() && std::isinf(app().redraw_in()); });
  }
  /// Moves the mouse to the middle of the mesh, and draws a few frames there.
  void hover() {
    const ui::Rect rect = app().panes().front().rect;
    x_ = std::round(rect.x + rect.w / 2);
    y_ = std::round(rect.y + rect.h / 2);
    for (int k = 0; k < 3; ++k) {
      play({ui::SimulatedInput::Kind::Move, x_, y_, 0, {}, {}});
      frame();
    }
  }
  void play(ui::SimulatedInput input) { state().requests.input.push_back(std::move(input)); }
  void wheel(float amount) { play({ui::SimulatedInput::Kind::Wheel, 0, amount, 0, {}, {}}); }
  void press() { play({ui::SimulatedInput::Kind::Press, x_, y_, 0, {}, {}}); }
  void release() { play({ui::SimulatedInput::Kind::Release, x_, y_, 0, {}, {}}); }
  void move(float dx, float dy) { play({ui::SimulatedInput::Kind::Move, x_ += dx, y_ += dy, 0, {}, {}}); }
  void key(const char* name) {
    const ui::KeyChord chord = *ui::parse_key(name);
    play({ui::SimulatedInput::Kind::KeyDown, 0, 0, 0, chord, {}});
    play({ui::SimulatedInput::Kind::KeyUp, 0, 0, 0, chord, {}});
  }
  /// The camera under which the mesh is drawn.
  [[nodiscard]] render::Camera camera() {
    if (state().in_space) return state().orbit;
    return state().camera;
  }
  /// Draws frames until `changed`, including the one that shows it.
  template <class Changed>
  [[nodiscard]] WindowCost answer(const Changed& changed) {
    const Timer timer;
    frame();
    while (!changed()) frame();
    frame();
    const WindowCost cost = timer.cost();
    longest_ = std::max(longest_, cost.seconds);
    return cost;
  }
  [[nodiscard]] double longest() const noexcept { return longest_; }

 private:
  Progress& progress_;
  Pace pace_;
  HeadlessWindow window_;
  float x_ = 0, y_ = 0;
  double longest_ = 0.0;
};

/// Measures some answers and returns their mean; `rest`: whether the full picture is there before each.
template <class Once>
WindowCost mean_of(Subject& subject, bool rest, const Once& once) {
  WindowCost sum;
  for (int k = 0; k < kAnswers; ++k) {
    if (rest) subject.frames_until([&] { return subject.complete(); });
    const WindowCost one = once(k);
    sum.seconds += one.seconds / kAnswers;
    sum.processor += one.processor / kAnswers;
  }
  return sum;
}

void measure_answers(Subject& subject, WindowFigure& figure) {
  subject.hover();
  const auto zoom = [&](int k) {
    const render::Camera before = subject.camera();
    subject.wheel(k % 2 == 0 ? 1.0F : -1.0F);
    return subject.answer([&] { return subject.camera() != before; });
  };
  figure.zoom = mean_of(subject, true, zoom);
  figure.zoom_in_midst = mean_of(subject, false, [&](int k) {
    // Later than the rest that follows a movement, and before the full picture.
    constexpr int kFramesOfRest = 20;
    for (int i = 0; i < kFramesOfRest && !subject.complete(); ++i) subject.frame();
    return zoom(k);
  });
  figure.pick = mean_of(subject, true, [&](int) {
    subject.state().picked = {};
    subject.press();
    subject.frame();
    subject.release();
    return subject.answer([&] { return subject.state().picked.kind != ui::Picked::Kind::None; });
  });
  subject.press();
  subject.frame();
  figure.pan = mean_of(subject, true, [&](int k) {
    const render::Camera before = subject.camera();
    subject.move(k % 2 == 0 ? 9.0F : -9.0F, 6.0F);
    return subject.answer([&] { return subject.camera() != before; });
  });
  subject.release();
  subject.frame();
  figure.fit = mean_of(subject, true, [&](int) {
    subject.wheel(3.0F);
    subject.frame();
    subject.frames_until([&] { return subject.complete(); });
    const render::Camera before = subject.camera();
    subject.key("F");
    return subject.answer([&] { return subject.camera() != before; });
  });
  figure.longest = subject.longest();
}

/// Measures the time until another metric is shown while a run goes on.
void measure_metric(Subject& subject, WindowFigure& figure) {
  subject.app().execute("run 1000000");
  const std::array metrics{Metric::MinAngle, Metric::ScaledJacobian, Metric::RadiusRatio, Metric::MeanRatio};
  for (const Metric metric : metrics) {
    const std::uint64_t begun = subject.app().frame()->serial;
    constexpr std::uint64_t kSeen = 3;  // frames of the run
    (void)subject.frames_on_screen([&] { return subject.app().frame()->serial >= begun + kSeen; });
    const Timer timer;
    subject.app().execute(fmt::format("show {}", info(metric).name));
    subject.pace().input();
    const int frames = subject.frames_on_screen([&] { return subject.app().frame()->shown == metric; });
    const WindowCost cost = timer.cost();
    figure.metric.seconds += cost.seconds / metrics.size();
    figure.metric.processor += cost.processor / metrics.size();
    figure.metric_frames = std::max(figure.metric_frames, frames);
    figure.metric_longest = std::max(figure.metric_longest, cost.seconds);
  }
  subject.app().engine().cancel();
  subject.frames_until([&] { return subject.complete(); });
}

}  // namespace

WindowFigure measure_window(const WindowSubject& wanted, Progress& progress) {
  WindowFigure figure;
  const Stopwatch watch;
  const auto since_start = [&] { return WindowCost{watch.seconds(), processor_seconds()}; };
  Subject subject(wanted, progress);
  subject.app().execute(wanted.line);
  const auto seen = [&] { return subject.app().frame() && !subject.app().panes().empty() && subject.app().panes().front().current; };
  subject.frames_until([&] {
    if (seen() && figure.first.seconds == 0.0) figure.first = since_start();
    return seen() && subject.complete();
  });
  figure.full = since_start();
  subject.rest();
  figure.rest = since_start();
  figure.memory_open = peak_memory();
  figure.renderer = subject.app().activity().renderer;
  figure.vertices = subject.app().frame()->vertex_count();
  figure.elements = subject.app().frame()->element_count();
  measure_answers(subject, figure);
  subject.rest();
  const auto run = [&](const std::string& line) {
    const Timer timer;
    subject.app().execute(line);
    subject.frames_until([&] { return subject.complete(); });
    return timer.cost();
  };
  figure.iteration = run("step iteration");
  figure.run = run(fmt::format("run {}", wanted.iterations));
  subject.rest();
  figure.memory_run = peak_memory();
  measure_metric(subject, figure);
  return figure;
}

}  // namespace dmoscope::app
