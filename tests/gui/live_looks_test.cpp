// Displays that do not affect the mesh change while a run computes.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <thread>

#include "core/base/stopwatch.h"
#include "tests/gui/headless_test.h"
#include "tests/support/nice_values.h"
#include "ui/plots/plot_builder.h"

namespace dmoscope::app {
namespace {

class LiveLooks : public HeadlessTest {
 protected:
  /// Begins a run without end, and waits until it goes on.
  void begin(const char* mesh = "generate random 20000") {
    good(mesh);
    window_->app().submit("run 100000000");
    ASSERT_TRUE(frames_until([&] { return frame().moment > Moment{}; }));
  }
  void TearDown() override {
    if (!window_) return;
    window_->app().submit("cancel");
    window_->settle();
  }
  [[nodiscard]] const Frame& frame() {
    held_ = window_->app().frame();
    return *held_;
  }
  template <class Wanted>
  bool frames_until(Wanted wanted) {
    for (int k = 0; k < 20'000; ++k) {
      window_->frame();
      if (wanted()) return window_->app().engine().busy();
    }
    return false;
  }
  void key(const char* name) {
    window_->app().submit(std::string("key ") + name);
    while (!state().requests.input.empty()) window_->frame();
  }

  std::shared_ptr<const Frame> held_;
};

TEST_F(LiveLooks, KeyMShowsTheNextMetricAndTheRunGoesOn) {
  begin();
  ASSERT_EQ(frame().shown, Metric::MeanRatio);
  key("M");
  ASSERT_TRUE(frames_until([&] { return frame().shown != Metric::MeanRatio; })) << "not before the run's end";
  const Metric first = frame().shown;
  const Moment then = frame().moment;
  key("M");
  key("M");
  ASSERT_TRUE(frames_until([&] { return frame().shown != first; }));
  EXPECT_TRUE(frames_until([&] { return frame().moment > then; })) << "it still goes on";
  EXPECT_EQ(session()->runs[0].parameters.metric, Metric::MeanRatio);
}

TEST_F(LiveLooks, CancelStaysWhereItIsWhateverIsSaidOfTheRun) {
  begin();
  const auto box = [&](const char* item) { return window_->app().items().find(item); };
  const auto there = [&](const char* item) {
    const auto& boxes = window_->app().items().boxes();
    return boxes.find(item) != boxes.end();
  };
  ASSERT_TRUE(frames_until([&] { return there("cancel") && there("status-progress"); }));
  const auto cancel = box("cancel"), said = box("status-progress");
  ASSERT_TRUE(frames_until([&] { return box("status-progress") != said; })) << "else this test shows nothing";
  EXPECT_EQ(box("cancel"), cancel);
}

#ifdef __linux__
TEST_F(LiveLooks, WhatComputesGivesWayToWhatDraws) {
  if (testing::own_nice_value() != 0) GTEST_SKIP() << "the tests themselves give way";
  good("generate annulus 400");
  const auto behind = [] { return std::ranges::count_if(testing::nice_values(), [](int value) { return value > 0; }); };
  const auto before = behind();  // some of OpenGL's own threads have such values, too
  good("run 1");
  EXPECT_GT(behind(), before);
  EXPECT_EQ(testing::own_nice_value(), 0) << "who draws goes first";
}
#endif

TEST_F(LiveLooks, AChoiceOfTheShownMetricIsDrawnAndRecorded) {
  begin();
  window_->app().submit("show min-angle");
  ASSERT_TRUE(frames_until([&] { return frame().shown == Metric::MinAngle; }));
  bool done = false;
  ASSERT_TRUE(frames_until([&] {
    for (const ui::LogLine& line : state().commands.lines())
      if (line.text == "show min-angle") done = line.state == ui::LogLine::State::Done;
    return done;
  }));
  EXPECT_NE(state().commands.script({}).find("\nshow min-angle\n"), std::string::npos);
  ASSERT_TRUE(state().result.newest());
  EXPECT_EQ(state().result.newest()->text, "show min-angle: done");
}

TEST_F(LiveLooks, PlayingGoesOnUnderAnotherMetric) {
  good("generate random 400");
  good("run 30");
  window_->app().submit("timeline first");
  window_->settle();
  window_->app().submit("speed 4");
  window_->app().submit("play on");
  window_->app().submit("show min-angle");
  EXPECT_EQ(state().timeline.play.kind, ui::Playback::Kind::History);
}

TEST_F(LiveLooks, EveryOtherLookChangesAtOnce) {
  begin();
  const auto at_once = [&](const char* line, auto holds) {
    window_->app().submit(line);
    window_->frame();
    window_->frame();
    EXPECT_TRUE(holds()) << line;
    EXPECT_TRUE(window_->app().engine().busy()) << line;
    EXPECT_EQ(state().dialog, ui::Dialog::None) << line;
  };
  using ui::PlotTab;
  at_once("colormap cividis", [&] { return state().colour_map == render::ColourMap::Cividis; });
  at_once("reverse-colors on", [&] { return state().colouring.reversed; });
  at_once("range 0.25 0.5", [&] { return window_->app().colour_range() == std::pair{0.25, 0.5}; });
  at_once("range auto", [&] { return window_->app().colour_range().first > 0.0 && window_->app().colour_range().second <= 1.01; });
  at_once("filter 0.5 0.75", [&] { return state().colouring.filter.has_value(); });
  at_once("filter off", [&] { return !state().colouring.filter; });
  at_once("color-by valence", [&] { return state().colouring.by == ui::ColourBy::Valence; });
  ASSERT_TRUE(frames_until([&] { return window_->app().colours() != nullptr; })) << "worked out besides";
  at_once("color-by quality", [&] { return window_->app().colours() == nullptr; });
  at_once("viewports 2", [&] { return window_->app().panes().size() == 2; });
  ASSERT_TRUE(frames_until([&] {
    const auto panes = window_->app().panes();
    return panes.size() == 2 && panes[0].session->frame && panes[1].session->frame;
  })) << "the input beside the run";
  at_once("viewports 1", [&] { return window_->app().panes().size() == 1; });
  at_once("panel left off", [&] { return !state().panels.setup; });
  at_once("plot histogram", [&] { return state().plot == PlotTab::Histogram; });
  at_once("histogram-range whole", [&] { return state().plot_options.histogram_range == ui::HistogramRange::Whole; });
  at_once("plot convergence", [&] { return state().plot == PlotTab::Convergence; });
  at_once("x-axis linear", [&] { return state().plot_options.x_axis == ui::XAxis::Linear; });
  at_once("pick vertex 300", [&] { return state().picked.id == 300; });
  at_once("inspect on", [&] { return window_->app().inspection().visit() != nullptr || !window_->app().inspection().trouble.empty(); });
  at_once("inspect off", [&] { return !state().inspection.open; });
  at_once("theme light", [&] { return state().theme == ui::Theme::Light; });
  at_once("wireframe off", [&] { return !state().wireframe; });
}

/// A measurement, run by hand: --gtest_also_run_disabled_tests --gtest_filter='*Measure*'
TEST_F(LiveLooks, DISABLED_MeasureFramesUntilAnotherMetricIsShown) {
  begin("generate random 1330000");
  for (const char* metric : {"min-angle", "scaled-jacobian", "radius-ratio", "mean-ratio"}) {
    for (int k = 0; k < 3; ++k) window_->frame();
    const Frame& drawn = frame();
    const std::uint64_t iteration = drawn.moment.iteration;
    const Metric before = drawn.shown;
    window_->app().submit(std::string("show ") + metric);
    const Stopwatch watch;
    const auto begun = std::chrono::steady_clock::now();
    int frames = 0;
    do {  // sixty frames a second, as on a screen
      window_->frame();
      ++frames;
      std::this_thread::sleep_until(begun + frames * std::chrono::microseconds(16'667));
    } while (frame().shown == before && frames < 10'000);
    const double shown = watch.seconds();
    const Stopwatch one_more;
    window_->frame();
    std::printf("%-16s shown in frame %d after %.2f s; a frame takes %.2f s; iteration %llu, busy %d\n", metric, frames, shown,
                one_more.seconds(), static_cast<unsigned long long>(iteration), window_->app().engine().busy() ? 1 : 0);
  }
}

TEST_F(LiveLooks, TheStatusBarSaysHowTheRunGoes) {
  begin("generate random 3000");
  ASSERT_TRUE(frames_until([&] { return window_->app().items().boxes().contains("status-progress"); }));
  TearDown();
  window_->frame();
  EXPECT_FALSE(window_->app().items().boxes().contains("status-progress"));
  EXPECT_TRUE(window_->app().items().boxes().contains("status-backend"));
}

}  // namespace
}  // namespace dmoscope::app
