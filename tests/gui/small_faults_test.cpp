// Tooltips of the right size, entries that are not cut, and ways out.
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "tests/gui/headless_test.h"
#include "tests/support/picture_difference.h"
#include "ui/state/actions.h"

namespace dmoscope::app {
namespace {

class SmallFaults : public HeadlessTest {
 protected:
  [[nodiscard]] ui::Items::Box box(const std::string& item) { return window_->app().items().find(item); }
  /// Moves the mouse to an item, and draws the window for as long as it asks to be drawn.
  void rest_on(const std::string& item) {
    const auto at = box(item);
    state().requests.input.push_back({ui::SimulatedInput::Kind::Move, (at[0] + at[2]) / 2, (at[1] + at[3]) / 2, 0, {}, {}});
    window_->frame();
    for (int k = 0; k < 10 && window_->app().redraw_in() <= 0.0; ++k) window_->frame();
  }
  [[nodiscard]] static const ImGuiWindow* tooltip() {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
      if (window->Active && (window->Flags & ImGuiWindowFlags_Tooltip) != 0) return window;
    return nullptr;
  }
  /// Checks that a window is as large as its contents.
  static void expect_fits(const ImGuiWindow& window) {
    EXPECT_FALSE(window.Hidden);
    const ImVec2 end = window.DC.CursorMaxPos;
    EXPECT_NEAR(window.Pos.y + window.Size.y - window.WindowPadding.y, end.y, 1.5F);
    EXPECT_NEAR(window.Pos.x + window.Size.x - window.WindowPadding.x, end.x, 1.5F);
  }
};

TEST_F(SmallFaults, TooltipsFitWhenTheMouseRests) {
  good("generate annulus");
  good("move 5 5");
  for (const char* item : {"toolbar-shown", "fit", "metric", "run:0", "toolbar-shown"}) {
    rest_on(item);
    ASSERT_NE(tooltip(), nullptr) << item;
    expect_fits(*tooltip());
  }
}

TEST_F(SmallFaults, ParametersAnswerOnTheirFieldsToo) {
  open(1280, 1400);
  good("generate annulus");
  good("settings on");
  for (const char* item : {"grid", "levels", "omega", "precision", "threads", "method"}) {
    good("move 640 400");
    EXPECT_EQ(tooltip(), nullptr);
    rest_on(item);
    EXPECT_NE(tooltip(), nullptr) << item;
  }
}

TEST_F(SmallFaults, EscapeLeavesTheBrushBeforeItClearsTheSelection) {
  good("generate annulus");
  good("pick vertex 3");
  good("key S");
  ASSERT_TRUE(state().brush.on);
  good("key Escape");
  EXPECT_FALSE(state().brush.on);
  EXPECT_EQ(state().picked.id, 3U);
  good("key Escape");
  EXPECT_EQ(state().picked.kind, ui::Picked::Kind::None);
}

TEST_F(SmallFaults, EscapeLeavesTheInspectionBeforeItClearsTheSelection) {
  good("generate annulus");
  good("tab worst");
  good("click why:0");
  ASSERT_TRUE(state().inspection.open);
  EXPECT_EQ(state().panels.tab, ui::FactsTab::Selection);
  good("key Escape");
  EXPECT_FALSE(state().inspection.open);
  EXPECT_NE(state().picked.kind, ui::Picked::Kind::None);
  good("key Escape");
  EXPECT_EQ(state().picked.kind, ui::Picked::Kind::None);
  EXPECT_EQ(state().panels.tab, ui::FactsTab::Worst) << "the tab before";
}

TEST_F(SmallFaults, NoFrameStaysRoundThePlot) {
  good("generate annulus");
  good("run 3");
  good("move 5 5");
  const render::Image before = window_->picture();
  const auto plot = box("plot");
  good(fmt::format("right-click {} {}", plot[2] - 20, plot[1] + 5));
  good("key Down");
  good("key Escape");  // closes its menu, which had the keyboard
  good("key Escape");
  good("move 5 5");
  EXPECT_TRUE(render::compare(before, window_->picture()).alike());
  good("key Alt+2");
  good("key Alt+1");
  good("key Down");
  EXPECT_TRUE(render::compare(before, window_->picture()).alike());
}

TEST_F(SmallFaults, MenusAndToolsHaveOneHeight) {
  good("generate annulus");
  for (const char* scale : {"scale 1", "scale 1.25", "scale 1.5", "scale 1"}) {
    good(scale);
    good("move 5 5");
    const ImGuiWindow *menu = ImGui::FindWindowByName("menu"), *tools = ImGui::FindWindowByName("toolbar");
    ASSERT_TRUE(menu != nullptr && tools != nullptr);
    EXPECT_TRUE(menu->Pos.y < tools->Pos.y || menu->Size.y == tools->Size.y) << scale;
  }
}

TEST_F(SmallFaults, WhyAndTheNumberStandApart) {
  good("generate annulus");
  good("tab worst");
  const auto why = box("why:0"), row = box("worst:0");
  EXPECT_LT(row[2], why[0]);
  const float right = 1280.0F - 12.0F - 11.0F - 4.0F;  // right end of the numbers: without the panel's padding and its bar
  EXPECT_GE(right - why[2], ImGui::CalcTextSize("0.003610").x + 6.0F) << "room for the longest number, and a gap";
}

TEST_F(SmallFaults, EntriesOfThePaletteAreWhole) {
  good("generate annulus");
  for (const char* scale : {"1", "1.5"}) {
    good(std::string("scale ") + scale);
    good("dialog palette");
    good("type plot-");
    const auto entries = ui::palette_entries("plot-", ui::situation_of(*session(), state(), false), window_->app().commands().commands());
    const float em = 15.0F * static_cast<float>(state().scale);
    std::size_t seen = 0, broken = 0;
    for (std::size_t k = 0; k < entries.size(); ++k) {
      const auto at = window_->app().items().boxes().find(fmt::format("palette:{}", k));
      if (at == window_->app().items().boxes().end()) continue;
      ++seen;
      const auto& rect = at->second;
      const float width = rect[2] - rect[0];
      const float wanted = ImGui::CalcTextSize((entries[k].title + entries[k].detail).c_str()).x * em / ImGui::GetFontSize();
      const bool two_lines = rect[3] - rect[1] > 1.8F * em;
      if (wanted > width) {
        EXPECT_TRUE(two_lines) << entries[k].title;
        ++broken;
      }
    }
    EXPECT_GT(seen, 5U);
    EXPECT_GT(broken, 0U) << "this text is about long entries";
    good("dialog none");
  }
}

TEST_F(SmallFaults, GroupNamesAreWholeWhereThereIsRoom) {
  good("open " + std::string(DMOSCOPE_SOURCE_DIR) + "/resources/samples/coast.14");
  const auto fix = box("group-fix:land boundary 1");
  const float name = fix[0] - 9.0F - 0.7F * 15.0F - 6.0F;
  EXPECT_GE(name, ImGui::CalcTextSize("land boundary 10").x);
}

}  // namespace
}  // namespace dmoscope::app
