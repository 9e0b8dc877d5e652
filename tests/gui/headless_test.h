#pragma once
// A window without a screen, for tests that drive it by lines of a script.

#include <memory>
#include <string_view>

#include <gtest/gtest.h>

#include "app/window/headless.h"

namespace dmoscope::app {

class HeadlessTest : public testing::Test {
 protected:
  void SetUp() override { open(); }
  /// Opens a fresh window instead of the one before, without pictures on its start page; skips the test without OpenGL.
  void open(int width = 1280, int height = 800, Backend backend = Backend::Auto) {
    window_.reset();
    try {
      window_ = std::make_unique<HeadlessWindow>(HeadlessWindow::Options{
          .width = width, .height = height, .threads = 1, .backend = backend, .sample_pictures = false, .explains = explains_});
    } catch (const Error& error) {
      GTEST_SKIP() << "no OpenGL without a screen: " << error.what();
    }
  }
  void good(std::string_view line) {
    const auto failure = window_->run(line);
    ASSERT_FALSE(failure.has_value()) << line << ": " << failure->text;
  }
  [[nodiscard]] ui::ViewState& state() { return window_->app().state(); }
  [[nodiscard]] std::shared_ptr<const SessionView> session() { return window_->app().engine().view(); }

  /// Opens a window that finds what holds the minimum, which the other tests leave out because it is most of the work.
  void open_explaining(int width = 1280, int height = 800) {
    explains_ = true;
    open(width, height);
  }

  std::unique_ptr<HeadlessWindow> window_;

 private:
  bool explains_ = false;
};

}  // namespace dmoscope::app
