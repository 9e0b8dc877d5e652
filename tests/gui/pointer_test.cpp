// The value under a pointer that rests over a mesh, and clicks on axes.
#include <cmath>

#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "tests/gui/headless_test.h"

namespace dmoscope::app {
namespace {

class Pointer : public HeadlessTest {
 protected:
  [[nodiscard]] static bool has_tooltip() {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_Tooltip) != 0) return true;
    return false;
  }
  void rest(int frames) {
    for (int k = 0; k < frames; ++k) window_->frame();
  }
};

TEST_F(Pointer, ThatRestsShowsTheValueBelowIt) {
  good("generate grid 100");
  good("move 490 400");
  rest(60);
  EXPECT_FALSE(has_tooltip()) << "pictures of scripts are the same at any time";
  good("pointer-value on");
  good("move 491 400");
  rest(60);
  EXPECT_TRUE(has_tooltip());
  good("move 5 400");
  rest(60);
  EXPECT_FALSE(has_tooltip()) << "beside the mesh";
}

TEST_F(Pointer, ValuesAreThoseOfWhatIsBelowItNow) {
  good("generate grid 100");
  good("pointer-value on");
  const auto rests = [&](const char* line) {
    good(line);
    rest(60);
    EXPECT_TRUE(has_tooltip()) << line;
    return window_->picture().rgba;
  };
  (void)rests("move 600 300");
  for (const char* line : {"zoom 1.7", "step iteration", "show min-angle"}) {
    const auto stayed = rests(line);
    good("move 1100 300");
    EXPECT_FALSE(has_tooltip()) << line;
    EXPECT_TRUE(rests("move 600 300") == stayed) << line;
  }
}

TEST_F(Pointer, ClicksOnAxesLookAlongThem) {
  good("generate solids");
  for (const char* axis : {"x", "y", "z"}) {
    good("view-from iso");
    good(std::string("click axis:") + axis);
    const Vec3 back = state().orbit.back();
    const double along = *axis == 'x' ? back.x : *axis == 'y' ? back.y : back.z;
    EXPECT_NEAR(along, 1.0, 1e-9) << axis;
    good(std::string("click axis:") + axis);
    const Vec3 behind = state().orbit.back();
    EXPECT_NEAR(*axis == 'x' ? behind.x : *axis == 'y' ? behind.y : behind.z, -1.0, 1e-9) << axis;
  }
  good("generate grid 100");
  EXPECT_FALSE(window_->app().items().boxes().contains("axis:x"));
}

}  // namespace
}  // namespace dmoscope::app
