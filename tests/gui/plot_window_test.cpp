// Plots in the real window, off screen, and as files.
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <gtest/gtest.h>

#include "render/image.h"
#include "tests/gui/headless_test.h"
#include "tests/support/temporary_folder.h"
#include "ui/state/format.h"

namespace dmoscope::app {
namespace {

namespace fs = std::filesystem;

class PlotWindow : public HeadlessTest {
 protected:
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
  static std::string read(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  [[nodiscard]] const ui::Items::Box& box(const std::string& name) { return window_->app().items().find(name); }
  /// Pixel of the plot at shares of its width and height.
  [[nodiscard]] std::string at(double x, double y) {
    const auto& b = box("plot");
    const auto mix = [](float from, float to, double t) { return static_cast<double>(from) + t * static_cast<double>(to - from); };
    return std::to_string(mix(b[0], b[2], x)) + " " + std::to_string(mix(b[1], b[3], y));
  }
  [[nodiscard]] ui::PlotView& view() { return window_->app().state().plot_view(); }
  [[nodiscard]] std::uint64_t iteration() { return window_->app().engine().view()->frame->moment.iteration; }
  const test::TemporaryFolder folder_;
};

TEST_F(PlotWindow, IsSavedAsNumbersDrawingAndPicture) {
  good("generate annulus");
  good("run 4");
  for (const char* tab : {"convergence", "histogram", "sorted", "moved", "time"}) {
    good(std::string("plot ") + tab);
    const fs::path csv = file(std::string(tab) + ".csv"), svg = file(std::string(tab) + ".svg"), png = file(std::string(tab) + ".png");
    good("plot-save \"" + csv.string() + "\"");
    good("plot-save \"" + svg.string() + "\" --size 640x400");
    good("plot-save \"" + png.string() + "\" --size 500x300 --scale 1");
    EXPECT_TRUE(read(csv).starts_with("run,series,")) << tab;
    EXPECT_NE(read(svg).find("width=\"640\" height=\"400\""), std::string::npos) << tab;
    const render::Image picture = render::read_png(png);
    EXPECT_EQ(picture.width, 500);
    EXPECT_EQ(picture.height, 300);
    EXPECT_EQ(picture.at(2, 2), (render::Rgba{255, 255, 255, 255}));
    good("plot-copy");
    EXPECT_EQ(window_->clipboard(), read(csv)) << tab;
  }
}

TEST_F(PlotWindow, WhatCannotBeSavedIsAnErrorAndLeavesTheOldFile) {
  EXPECT_TRUE(window_->run("plot-save /tmp/plot.svg").has_value());  // nothing is open
  good("generate annulus");
  EXPECT_TRUE(window_->run("plot-save /proc/none/plot.svg").has_value());
  EXPECT_TRUE(window_->run("plot-save plot.bmp").has_value());
  EXPECT_TRUE(window_->run("plot-save plot.png --size 10x10").has_value());
}

TEST_F(PlotWindow, WheelBoxAndDoubleClickZoom) {
  good("x-axis linear");
  good("generate annulus");
  good("run 20");
  good("wheel " + at(0.5, 0.5) + " 2");
  ASSERT_TRUE(view().x_range);
  EXPECT_NEAR((view().x_range->first + view().x_range->second) / 2, 10, 0.1);
  EXPECT_FALSE(view().y_range);
  const auto y = box("plot-y");
  good("wheel " + std::to_string((y[0] + y[2]) / 2) + " " + std::to_string((y[1] + y[3]) / 2) + " 1");
  EXPECT_TRUE(view().y_range);
  good("double-click " + at(0.3, 0.5));
  EXPECT_FALSE(view().x_range);
  EXPECT_FALSE(view().y_range);
}

TEST_F(PlotWindow, AClickShowsThatIteration) {
  good("x-axis linear");
  good("generate annulus");
  good("run 20");
  good("click " + at(0.25, 0.4));
  EXPECT_EQ(iteration(), 5U);
  good("plot moved");
  good("click " + at(0.5, 0.4));
  EXPECT_EQ(iteration(), 10U);
}

TEST_F(PlotWindow, BrushingTheHistogramFiltersAndAClickShowsAllAgain) {
  good("generate annulus");
  good("plot histogram");
  good("plot-bins 16");
  good("drag " + at(0.51, 0.5) + " " + at(0.73, 0.6));
  const auto& filter = window_->app().state().colouring.filter;
  ASSERT_TRUE(filter);
  EXPECT_EQ(*filter, (std::pair{0.5, 0.75}));
  std::size_t inside = 0;
  for (const float q : window_->app().engine().view()->frame->quality) inside += q >= 0.5F && q <= 0.75F ? 1 : 0;
  ASSERT_GT(inside, 0U);
  const fs::path svg = file("brush.svg");
  good("plot-save \"" + svg.string() + "\"");
  EXPECT_NE(read(svg).find(ui::count(inside) + " of "), std::string::npos);
  EXPECT_NE(read(svg).find("fill-opacity"), std::string::npos);  // bars outside are dimmed
  good("click " + at(0.1, 0.2));
  EXPECT_FALSE(filter);
}

TEST_F(PlotWindow, TheLegendHidesAndIsolates) {
  good("generate annulus");
  good("run 3");
  good("click legend:mean");
  EXPECT_TRUE(view().hidden.contains("mean"));
  good("click legend:mean");
  EXPECT_FALSE(view().hidden.contains("mean"));
  good("double-click legend:minimum");
  EXPECT_EQ(view().isolated, "minimum");
  EXPECT_FALSE(view().hidden.contains("minimum"));
  good("click legend:mean");
  EXPECT_EQ(view().isolated, "");
  EXPECT_TRUE(view().hidden.empty());
}

TEST_F(PlotWindow, AxesAreChosenAndKeptByTab) {
  good("generate annulus");
  good("run 3");
  good("click plot-axes");
  good("click \"plot-menu:log 1 − q\"");
  EXPECT_EQ(view().axis, ui::ValueAxis::LogDistance);
  good("plot histogram");
  EXPECT_EQ(view().axis, ui::ValueAxis::Linear);
  EXPECT_TRUE(window_->run("axis log-distance").has_value());
  good("key Alt+L");
  EXPECT_EQ(view().axis, ui::ValueAxis::Log);
  good("key Alt+L");
  EXPECT_EQ(view().axis, ui::ValueAxis::Linear);
  good("click plot-axes");
  good("click \"plot-menu:16 bars\"");
  EXPECT_EQ(window_->app().state().plot_options.bins, 16);
}

TEST_F(PlotWindow, ARightClickOffersWhatCanBeChosen) {
  open(1600, 900);
  good("generate annulus");
  good("run 8");
  const ui::PlotOptions& options = window_->app().state().plot_options;
  good("right-click " + at(0.5, 0.5));
  good("click \"plot-menu:x: last change\"");
  EXPECT_EQ(options.x_axis, ui::XAxis::Changes);
  good("click plot-axes");
  good("click \"plot-menu:x: linear\"");
  EXPECT_EQ(options.x_axis, ui::XAxis::Linear);
  good("plot histogram");
  good("click plot-axes");
  good("click \"plot-menu:0 to 1\"");
  EXPECT_EQ(options.histogram_range, ui::HistogramRange::Whole);
  good("right-click " + at(0.5, 0.5));
  good("click \"plot-menu:its data\"");
  EXPECT_EQ(options.histogram_range, ui::HistogramRange::Data);
  good("right-click " + at(0.5, 0.5));
  good("click plot-copy");
  EXPECT_TRUE(window_->clipboard().starts_with("run,series,from,to,elements"));
}

TEST_F(PlotWindow, TheDialogSavesWhereItSays) {
  open(1600, 900);
  good("generate annulus");
  good("panel bottom on");
  const fs::path svg = file("dialog.svg");
  good("click plot-save");
  ASSERT_EQ(window_->app().state().dialog, ui::Dialog::Plot);
  good("click plot:file");
  good("key Ctrl+A");
  good("type \"" + svg.string() + "\"");
  good("click plot:go");
  EXPECT_EQ(window_->app().state().dialog, ui::Dialog::None);
  EXPECT_FALSE(read(svg).empty());
}

TEST_F(PlotWindow, ControlsStayInTheWindowWhateverItsSizeAndScale) {
  for (const auto& [size, scale] : {std::pair{"1280 800", "1"}, {"800 600", "1"}, {"2560 1600", "2"}, {"1600 1200", "2"}}) {
    good(std::string("size ") + size);
    good(std::string("scale ") + scale);
    good("generate annulus");
    good("panel bottom on");
    for (const char* tab : {"convergence", "histogram", "sorted"}) {
      good(std::string("plot ") + tab);
      const float width = box("viewport")[2];
      const bool roomy = window_->app().items().boxes().contains("plot-save");  // otherwise it is in the menu
      EXPECT_LE(box(roomy ? "plot-save" : "plot-axes")[2], width) << size << " " << tab;
      EXPECT_GT(box("plot-axes")[0], box("plot-compare")[2]) << size << " " << tab;
    }
  }
}

}  // namespace
}  // namespace dmoscope::app
