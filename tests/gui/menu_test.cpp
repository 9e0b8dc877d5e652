// Every action of the menus has the same result as a script's line, through the palette, and by its key.
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/gui/headless_test.h"
#include "tests/support/sanitized.h"
#include "ui/commands/view_commands.h"
#include "ui/commands/view_json.h"
#include "ui/state/actions.h"
#include "ui/state/view_options.h"

namespace dmoscope::app {
namespace {

class Menus : public HeadlessTest {
 protected:
  void SetUp() override {
    open(800, 600);
    if (IsSkipped()) return;
    fresh_ = state();
  }
  void run(const std::string& line) { (void)window_->run(line); }
  /// Begins with two runs, a history, a pick and marks; the same every time.
  void begin() {
    state() = fresh_;
    for (const char* line : {"generate grid 100", "then nothing", "joint-gap 0.0002", "pick vertex 40", "show mean-ratio",
                             "step iteration 3", "add-run dmo", "step iteration 4", "seek 2", "step class", "mark a", "fit", "move 3 3"}) {
      const auto failure = window_->run(line);
      ASSERT_FALSE(failure.has_value()) << line << ": " << failure->text;
    }
  }
  /// Everything in a window that an action can change, in words.
  [[nodiscard]] std::string outcome() {
    run("move 3 3");
    const auto view = window_->app().engine().view();
    std::string text = ui::view_json(state());
    text += fmt::format("\ndialog {}, {}, scale {}, full screen {}, shown {}, plays {}, watches {}, b {}", static_cast<int>(state().dialog),
                        ui::option_line(state(), "theme"), state().scale, state().full_screen, static_cast<int>(state().timeline.shown),
                        static_cast<int>(state().timeline.play.kind), state().watch_file, state().timeline.b.frame != nullptr);
    text +=
        fmt::format("\n{}, run {} of {}, shown {}", view->input->mesh.name, view->active, view->runs.size(), static_cast<int>(view->shown));
    for (const RunView& one : view->runs) text += fmt::format("\n{} {} {}", one.title, one.moment.iteration, one.moment.visits);
    double sum = 0.0;
    for (const Vec3& position : view->frame->positions) sum = 0.5 * sum + position.x + 3.0 * position.y;
    text += fmt::format("\n{}", sum);
    if (std::exchange(state().requests.quit, false)) text += "\nquit";
    state().timeline.play.kind = ui::Playback::Kind::Off;
    run("cancel");
    return text;
  }
  /// Finds the action by its title, as a person does, and clicks on it; or only finds it.
  [[nodiscard]] bool choose_in_palette(const ui::Action& action, bool click) {
    if (click) {
      run("key Ctrl+P");
      run("type " + quote_word(action.title));
    }
    const auto view = window_->app().engine().view();
    const ui::Situation now = ui::situation_of(*view, state(), false);
    const auto entries = ui::palette_entries(action.title, now, window_->app().commands().commands());
    const std::string title = fmt::format("{}: {}", action.menu, ui::title_of(action, now));
    const auto at = std::ranges::find(entries, title, &ui::PaletteEntry::title);
    if (at == entries.end()) return false;
    if (click) run(fmt::format("click palette:{}", at - entries.begin()));
    possible_ = at->possible;
    return true;
  }

  ui::ViewState fresh_;
  bool possible_ = true;
};

TEST_F(Menus, EveryActionIsReachedByScriptPaletteAndKeyAlike) {
  // Every letter takes a frame: with a sanitizer only some actions are tried, and the palette is opened for some of these.
  constexpr std::size_t kTried = testing::kSanitized ? 5 : 1, kStride = testing::kSanitized ? 20 : 1;
  std::size_t count = 0;
  for (const ui::Action& action : ui::actions()) {
    SCOPED_TRACE(std::string(action.id));
    if (count++ % kTried != 0) continue;
    const bool by_hand = (count - 1) % kStride == 0;
    // Stepping by itself goes on until it is stopped: its result depends on time.
    const bool endless = action.command.starts_with("play-steps");
    begin();
    // A script gets the error; a person gets the dialog.
    if (window_->run(action.command)) state().dialog = ui::Dialog::Error;
    const std::string by_script = outcome();
    if (!by_hand && action.key.empty()) continue;
    begin();
    ASSERT_TRUE(choose_in_palette(action, by_hand));
    if (by_hand) {
      const std::string by_palette = outcome();
      if (!possible_) {  // the entry is grey; a script gets the reason
        EXPECT_EQ(state().dialog, ui::Dialog::Palette);
      } else if (!endless) {
        EXPECT_EQ(by_palette, by_script);
      }
    }
    if (!possible_ || action.key.empty()) continue;
    if (by_hand) begin();
    run("key " + std::string(action.key));
    if (!endless) {
      EXPECT_EQ(outcome(), by_script);
    }
  }
}

}  // namespace
}  // namespace dmoscope::app
