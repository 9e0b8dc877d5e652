// The page that is shown while the first mesh is being read.
#include <chrono>
#include <fstream>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "app/window/headless.h"
#include "tests/support/temporary_folder.h"
#include "ui/toolkit/file_browser.h"

namespace dmoscope::app {
namespace {

TEST(BeingRead, NamesTheFileItsSizeAndItsFolder) {
  const test::TemporaryFolder folder;
  const auto file = folder / "two words.14";
  std::ofstream(file) << std::string(12'300, 'x');
  const auto reading = ui::being_read("open \"" + file.string() + "\"");
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->name, "two words.14");
  EXPECT_EQ(reading->where, "12.3 kB in " + folder.path().string());
  EXPECT_EQ(ui::being_read("open-state a.dmoscope")->name, "a.dmoscope");
  EXPECT_EQ(ui::being_read("generate coast 1000")->name, "sample coast");
  EXPECT_FALSE(ui::being_read("step iteration"));
  EXPECT_FALSE(ui::being_read("open"));
  EXPECT_FALSE(ui::being_read("open \"a"));
}

class ReadingPage : public testing::Test {
 protected:
  void SetUp() override {
    try {
      window = std::make_unique<HeadlessWindow>(HeadlessWindow::Options{.threads = 1, .sample_pictures = false, .as_on_screen = true});
    } catch (const Error& error) {
      GTEST_SKIP() << "no OpenGL without a screen: " << error.what();
    }
  }
  [[nodiscard]] bool shows(const char* item) const { return window->app().items().boxes().contains(item); }

  std::unique_ptr<HeadlessWindow> window;
};

TEST_F(ReadingPage, StandsInTheViewportsPlaceAtOnceAndCancels) {
  window->frame();
  EXPECT_TRUE(shows("start:open"));
  window->app().execute("generate grid 4000000");  // takes seconds
  window->frame();
  EXPECT_TRUE(shows("reading:name"));
  EXPECT_TRUE(shows("reading:bar"));
  EXPECT_FALSE(shows("start:open"));
  window->app().execute("click reading:cancel");
  for (int k = 0; k < 10'000 && window->app().engine().busy(); ++k) {
    window->frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  window->frame();
  EXPECT_EQ(window->app().frame(), nullptr) << "it was read to its end";
  EXPECT_TRUE(shows("start:open"));
}

}  // namespace
}  // namespace dmoscope::app
