// The window while a run steps on a device: drawing, picks and values come from the device that has the positions.
#include <algorithm>
#include <memory>

#include <glad/gl.h>
#include <gtest/gtest.h>

#include "app/window/headless.h"
#include "tests/support/fake_accelerator.h"
#include "tests/support/meshes.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/facts.h"

namespace dmoscope::app {
namespace {

using testing::FakeDevice;
using testing::FakePictureDevice;
using ui::Picked;

class LiveWindow : public ::testing::Test {
 protected:
  /// Opens the window. no_interop: as HeadlessWindow's.
  void open(std::optional<std::string> no_interop) {
    device->pictures = std::make_shared<FakePictureDevice>();
    device->pictures->fill = [](std::uint32_t buffer, std::span<const std::byte> data) {
      glNamedBufferSubData(buffer, 0, static_cast<GLsizeiptr>(data.size()), data.data());
    };
    HeadlessWindow::Options options{1280, 800, 1.0, 1};
    options.acceleration = testing::acceleration(device);
    options.no_interop = std::move(no_interop);
    try {
      window = std::make_unique<HeadlessWindow>(options);
    } catch (const Error& error) {
      GTEST_SKIP() << "no OpenGL without a screen: " << error.what();
    }
    ASSERT_FALSE(window->run("generate annulus 1500").has_value());
  }
  /// Draws frames of a run without end until a light one is drawn and `more` holds.
  template <class More>
  bool draw_until_live(More more) {
    if (!window->app().engine().busy()) window->app().submit("run 100000000");
    for (int k = 0; k < 100'000; ++k) {
      window->frame();
      drawn = window->app().frame();
      if (drawn && drawn->device && more()) return true;
    }
    return false;
  }
  bool draw_until_live() {
    return draw_until_live([] { return true; });
  }
  void stop() {
    window->app().submit("cancel");
    window->settle();
  }

  std::shared_ptr<FakeDevice> device = std::make_shared<FakeDevice>();
  std::unique_ptr<HeadlessWindow> window;
  std::shared_ptr<const Frame> drawn;
};

TEST_F(LiveWindow, DrawsFromTheDeviceAndSaysSo) {
  open("");
  if (IsSkipped()) return;
  ASSERT_TRUE(draw_until_live());
  window->frame();
  EXPECT_EQ(window->app().activity().drawing.sentence(), "cuda with interop");
  EXPECT_EQ(device->pictures->downloads, 0);
  EXPECT_GT(device->pictures->writes, 0);
  stop();
  EXPECT_EQ(window->app().frame()->device, nullptr);
  EXPECT_EQ(window->app().activity().drawing.sentence(), "cuda with interop");
}

TEST_F(LiveWindow, AProcessorThatDrawsIsNoDevicesBusiness) {
  open(std::nullopt);
  if (IsSkipped()) return;
  ASSERT_TRUE(draw_until_live());
  window->frame();
  const DrawingPath& path = window->app().activity().drawing;
  if (path.name == "cuda with interop") GTEST_SKIP() << "OpenGL is drawn by a card here";
  EXPECT_EQ(path.name, "cuda with host copy");
  EXPECT_NE(path.reason.find("no interop: "), std::string::npos) << path.reason;
  EXPECT_EQ(device->pictures->targets_made, 0);
  EXPECT_GT(device->pictures->downloads, 0);
  stop();
}

TEST_F(LiveWindow, EveryPanelStandsALightFrame) {
  open("");
  if (IsSkipped()) return;
  for (const char* line :
       {"vertices on", "range auto", "plot sorted", "goto vertex 300", "pick element 77", "plot histogram", "dialog find", "dialog none",
        "goto element 12", "fit", "screenshot /dev/null/x.png", "dialog none", "pick none"}) {
    ASSERT_TRUE(draw_until_live()) << line;
    window->app().submit(line);
    const std::uint64_t serial = drawn->serial;
    ASSERT_TRUE(draw_until_live([&] { return drawn->serial > serial; })) << line;
  }
  stop();
}

TEST_F(LiveWindow, ALostDeviceIsSaidAndCrashesNothing) {
  open("");
  if (IsSkipped()) return;
  window->app().submit("pick vertex 300");
  ASSERT_TRUE(draw_until_live());
  auto& pictures = *device->pictures;
  pictures.can_write = pictures.can_download = pictures.can_tell_positions = false;
  const std::uint64_t serial = drawn->serial;
  ASSERT_TRUE(draw_until_live([&] { return drawn->serial > serial; }));
  window->frame();
  EXPECT_EQ(window->app().activity().drawing.reason, "no interop: the device was lost");
  window->app().submit("goto vertex 12");  // asks the device, whose error is shown
  EXPECT_EQ(window->app().state().dialog, ui::Dialog::Error);
  stop();
}

/// A mesh with some elements turned over, on the host and on a device.
std::pair<std::shared_ptr<Frame>, std::shared_ptr<Frame>> two_frames(const std::shared_ptr<FakePictureDevice>& device) {
  const auto input = testing::input(testing::lattice(20, 0.3, 5, testing::Cells::Mixed));
  std::vector<Vec3> positions = input->mesh.positions;
  for (std::size_t v = 30; v < positions.size(); v += 41) positions[v].x += 0.06;
  auto whole = testing::whole_frame(input, positions, Metric::MeanRatio, 1, 1);
  auto light = testing::light_frame(*whole, device);
  light->serial = 2;
  return {whole, light};
}

TEST(Facts, AreTheSameBitsOfALightFrame) {
  const auto device = std::make_shared<FakePictureDevice>();
  const auto [whole, light] = two_frames(device);
  ASSERT_GT(whole->shown_statistics.inverted, 0U);
  for (Index id = 0; id < whole->vertex_count(); ++id) {
    const ui::PickedFacts a = ui::facts_of(*whole, {Picked::Kind::Vertex, id}), b = ui::facts_of(*light, {Picked::Kind::Vertex, id});
    EXPECT_EQ(a.at, whole->positions[id]);
    EXPECT_EQ(a.at, b.at);
    EXPECT_EQ(a.now, b.now);
    EXPECT_EQ(a.now, vertex_quality(whole->input->quality_context(), whole->input->topology, whole->positions, whole->shown, id));
    ASSERT_EQ(a.star.size(), b.star.size());
    for (std::size_t k = 0; k < a.star.size(); ++k) {
      EXPECT_EQ(a.star[k].quality, b.star[k].quality);
      EXPECT_EQ(a.star[k].inverted, whole->inverted[a.star[k].element] != 0);
      EXPECT_EQ(a.star[k].inverted, b.star[k].inverted);
    }
  }
  const Index worst = whole->worst[0].element;
  const ui::PickedFacts a = ui::facts_of(*whole, {Picked::Kind::Element, worst}), b = ui::facts_of(*light, {Picked::Kind::Element, worst});
  EXPECT_TRUE(a.inverted && b.inverted);
  const ElementKind kind = whole->input->mesh.elements.kind(worst);
  const auto defined = std::ranges::count_if(metric_table(), [&](const MetricInfo& one) { return one.defined_for(kind); });
  ASSERT_EQ(a.metrics.size(), static_cast<std::size_t>(defined));
  ASSERT_EQ(b.metrics.size(), a.metrics.size());
  for (std::size_t k = 0; k < a.metrics.size(); ++k) {
    EXPECT_TRUE(a.metrics[k].now == b.metrics[k].now || (std::isnan(a.metrics[k].now) && std::isnan(b.metrics[k].now)));
    EXPECT_TRUE(a.metrics[k].before == b.metrics[k].before || (std::isnan(a.metrics[k].before) && std::isnan(b.metrics[k].before)));
  }
  device->can_tell_positions = false;
  const ui::PickedFacts lost = ui::facts_of(*light, {Picked::Kind::Element, worst});
  EXPECT_EQ(lost.picked, Picked{});
  EXPECT_EQ(lost.trouble, "the device was lost");
}

TEST(Derived, TellsOfALightFrameWhatItsHistogramTells) {
  const auto [whole, light] = two_frames(std::make_shared<FakePictureDevice>());
  ui::ViewState state;
  state.plot = ui::PlotTab::Sorted;
  state.range_mode = ui::RangeMode::Auto;
  const auto derive = [&](const std::shared_ptr<Frame>& frame) {
    SessionView session;
    session.frame = frame;
    ui::Derived derived;
    ui::refresh(derived, state, session);
    return derived;
  };
  const ui::Derived a = derive(whole), b = derive(light);
  const double bin = 1.0 / Histogram::kBins;
  EXPECT_EQ(b.range.first, a.range.first);
  EXPECT_GE(b.range.second, a.range.second);
  EXPECT_LE(b.range.second, a.range.second + bin);
  EXPECT_FALSE(b.undefined);
  EXPECT_EQ(a.sorted_before, b.sorted_before);
  ASSERT_GT(b.sorted_now.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(b.sorted_now));
  for (std::size_t k = 0; k < b.sorted_now.size(); ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(b.sorted_now.size());
    const double exact = a.sorted_now[static_cast<std::size_t>(share * static_cast<double>(a.sorted_now.size()))];
    if (exact > 0.0) {
      EXPECT_NEAR(b.sorted_now[k], exact, 1.01 * bin) << k;
    }
  }
  EXPECT_EQ(b.sorted_now.front(), whole->shown_statistics.minimum);
}

}  // namespace
}  // namespace dmoscope::app
