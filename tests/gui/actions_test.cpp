#include "ui/state/actions.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/commands/commands.h"
#include "core/commands/session_commands.h"
#include "ui/commands/view_commands.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

TEST(Actions, IdsAndKeysAreUniqueAndKeysCanBeRead) {
  std::set<std::string_view> ids;
  std::set<std::string> keys;
  for (const Action& action : actions()) {
    EXPECT_TRUE(ids.insert(action.id).second) << action.id;
    if (action.key.empty()) continue;
    const auto chord = parse_key(action.key);
    ASSERT_TRUE(chord.has_value()) << action.key;
    EXPECT_EQ(key_name(*chord), action.key);
    EXPECT_TRUE(keys.insert(std::string(action.key)).second) << action.key;
    EXPECT_EQ(action_of(*chord), &action) << action.key;
  }
}

TEST(Actions, EveryCommandIsKnownToATable) {
  ViewState state;
  const CommandHost host;
  const CommandTable table = view_commands(state, host);
  for (const Action& action : actions()) {
    const auto words = split_words(action.command);
    ASSERT_FALSE(words.empty()) << action.id;
    EXPECT_TRUE(is_session_command(action.command) || table.knows(words[0])) << action.command;
  }
}

TEST(Actions, NoVerbOfTheWindowHidesOneOfTheSession) {
  ViewState state;
  const CommandHost host;
  const CommandTable table = view_commands(state, host);
  for (const CommandInfo& command : table.commands()) {
    EXPECT_FALSE(is_session_command(command.name)) << command.name;
    EXPECT_FALSE(command.usage.empty());
    EXPECT_FALSE(command.doc.empty());
  }
}

TEST(Actions, TheKeysThatPeopleAreToldOfWork) {
  const std::pair<const char*, const char*> wanted[] = {{"Space", "run-pause"},   {"N", "step-iteration"},
                                                        {"B", "back-iteration"},  {"C", "step-class"},
                                                        {"V", "step-vertex"},     {"R", "reset"},
                                                        {"U", "until-converged"}, {"F", "fit"},
                                                        {"W", "wireframe"},       {"M", "next-metric"},
                                                        {"Alt+N", "next-run"},    {"Ctrl+O", "open"},
                                                        {"Ctrl+S", "export"},     {"Ctrl+Shift+S", "screenshot"},
                                                        {"Ctrl+Z", "undo"},       {"Ctrl+F", "find"},
                                                        {"Ctrl+Y", "redo"},       {"Ctrl+Shift+Z", "redo"},
                                                        {"F1", "keys"},           {"Ctrl+P", "palette"},
                                                        {"F11", "full-screen"},   {"[", "timeline-back"},
                                                        {"]", "timeline-forward"}};
  for (const auto& [key, id] : wanted) {
    const Action* action = action_of(*parse_key(key));
    ASSERT_NE(action, nullptr) << key;
    EXPECT_EQ(action->id, id);
  }
}

TEST(Actions, AreFoundByWordsInAnyOrder) {
  const auto found = search_actions("class next");
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front()->id, "step-class");
  EXPECT_EQ(search_actions("").size(), actions().size());
  EXPECT_TRUE(search_actions("no such thing at all").empty());
}

TEST(Palette, ListsEveryActionAndEveryVerbOfBothTables) {
  const std::vector<PaletteEntry> all = palette_entries("", {}, view_command_infos());
  const auto lists = [&](std::string_view title) {
    return std::any_of(all.begin(), all.end(), [&](const PaletteEntry& entry) { return entry.title == title; });
  };
  EXPECT_EQ(all.size(), actions().size() + view_command_infos().size() + session_commands().size());
  EXPECT_TRUE(lists("Run: Next iteration"));
  EXPECT_TRUE(lists("wireframe [on|off|toggle]"));
  EXPECT_TRUE(lists("step vertex|class|iteration [COUNT]"));
}

TEST(Palette, BeginsWithWhatRunsAsItIs) {
  const std::vector<PaletteEntry> all = palette_entries("", {.mesh = true, .runs = 1}, view_command_infos());
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.front().title.substr(0, 6), "File: ") << "the menus come first";
  const auto incomplete = std::ranges::find(all, false, &PaletteEntry::complete);
  EXPECT_GT(incomplete - all.begin(), 60) << "commands that lack words come after the actions";
}

TEST(Palette, ACommandWithItsWordsRunsAsTyped) {
  // These words also occur in the commands of "Run 10 iterations" and "Zoom in" (zoom 1.25).
  for (const char* line : {"run 1", "zoom 1", "step iteration 2", "goto vertex 3"}) {
    const std::vector<PaletteEntry> found = palette_entries(line, {.mesh = true}, view_command_infos());
    ASSERT_FALSE(found.empty()) << line;
    EXPECT_EQ(found.front().command, line);
    EXPECT_TRUE(found.front().complete);
  }
}

TEST(Palette, AVerbAloneAsksForItsWords) {
  const std::vector<PaletteEntry> found = palette_entries("screensh", {.mesh = true}, view_command_infos());
  const auto at = std::find_if(found.begin(), found.end(), [](const PaletteEntry& entry) { return entry.command == "screenshot "; });
  ASSERT_NE(at, found.end());
  EXPECT_FALSE(at->complete);
  // Nothing is open: actions that need a mesh come after all that are possible.
  const std::vector<PaletteEntry> none = palette_entries("s", {}, view_command_infos());
  EXPECT_TRUE(std::ranges::is_sorted(none, std::greater<>(), &PaletteEntry::possible));
  EXPECT_FALSE(none.back().possible);
  EXPECT_TRUE(palette_entries("no such thing", {}, view_command_infos()).empty());
}

TEST(Actions, AreOnlyPossibleWhenTheyMakeSense) {
  const Action& step = *find_action("step-iteration");
  EXPECT_FALSE(enabled(step, {}));
  EXPECT_TRUE(enabled(step, {.mesh = true, .busy = false, .picked = false, .runs = 1}));
  EXPECT_FALSE(enabled(step, {.mesh = true, .busy = true, .picked = false, .runs = 1}));
  EXPECT_TRUE(enabled(*find_action("cancel"), {.mesh = true, .busy = true, .picked = false, .runs = 1}));
  EXPECT_TRUE(enabled(*find_action("run-pause"), {.mesh = true, .busy = true, .picked = false, .runs = 1}));
}

TEST(Keys, NamesAreReadBack) {
  EXPECT_FALSE(parse_key("").has_value());
  EXPECT_FALSE(parse_key("Nonsense").has_value());
  EXPECT_FALSE(parse_key("F13").has_value());
  EXPECT_FALSE(parse_key("Ctrl+").has_value());
  EXPECT_EQ(parse_key("Ctrl+Shift+S"), (KeyChord{'S', true, true, false}));
  EXPECT_EQ(parse_key("ctrl"), std::nullopt);
  EXPECT_EQ(parse_key("n"), parse_key("N"));
}

TEST(Theme, TextIsReadableOnEveryGround) {
  for (const Theme theme : {Theme::Dark, Theme::Light, Theme::Contrast}) {
    const Palette& p = palette(theme);
    for (const render::Rgb ground : {p.panel, p.background, p.raised}) {
      for (const render::Rgb ink : {p.text, p.dim, p.warning, p.error, p.good}) EXPECT_GE(contrast(ink, ground), 4.5);
    }
    EXPECT_GE(contrast(p.on_accent, p.accent), 4.5);
    for (const render::Rgb run : p.runs) EXPECT_GE(contrast(run, p.panel), 3.0);
  }
  EXPECT_NEAR(contrast({0, 0, 0}, {255, 255, 255}), 21.0, 1e-9);
}

TEST(Theme, RunsHaveColoursOfTheirOwn) {
  for (const Theme theme : {Theme::Dark, Theme::Light, Theme::Contrast}) {
    const Palette& p = palette(theme);
    for (std::size_t a = 0; a < 16; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const render::Rgb one = p.run(a), other = p.run(b);
        const int distance = std::abs(one.r - other.r) + std::abs(one.g - other.g) + std::abs(one.b - other.b);
        EXPECT_GE(distance, 50) << a << " and " << b;
      }
    }
  }
}

TEST(Layout, PanelsCoverTheWindowWithoutOverlap) {
  for (const auto& [width, height, em] :
       {std::tuple{1280.0F, 800.0F, 15.0F}, {800.0F, 600.0F, 15.0F}, {2560.0F, 1600.0F, 30.0F}, {400.0F, 300.0F, 15.0F}}) {
    Panels panels;
    panels.plots_wait = false;
    for (const Side setup_side : {Side::Left, Side::Right}) {
      panels.setup_side = setup_side;
      const Layout layout = compute_layout(panels, width, height, {em, 20 * em, 40 * em});
      EXPECT_GE(layout.viewport.w, 0);
      EXPECT_GE(layout.viewport.h, 0);
      EXPECT_NEAR(layout.folded ? layout.viewport.w : layout.left.w + layout.viewport.w + layout.right.w, width, 0.5);
      EXPECT_EQ(!layout.folded && layout.left.w > 0, !layout.folded && setup_side == Side::Left) << "facts stand at the right";
      const bool one_row = layout.toolbar.y == 0;
      EXPECT_EQ(one_row, width >= 60 * em);
      EXPECT_NEAR((one_row ? 0 : layout.menu.h) + layout.toolbar.h + layout.viewport.h + layout.bottom.h + layout.status.h, height, 0.5);
      EXPECT_NEAR(layout.timeline.w + layout.status.w, width, 0.5);
      EXPECT_EQ(layout.timeline.y, layout.status.y);
    }
  }
  Panels open;
  open.left_over = open.right_over = true;
  open.setup_side = Side::Left;
  const HeaderSize one{15, 300, 700}, two{30, 600, 1400};
  const Layout both = compute_layout(open, 1280, 800, two);
  EXPECT_TRUE(both.folded);
  EXPECT_LE(both.left.x + both.left.w, both.right.x);
  EXPECT_TRUE(both.bottom.empty());
  EXPECT_FALSE(both.timeline.empty());
  Panels begun;
  begun.plots_wait = false;
  EXPECT_FALSE(compute_layout(begun, 800, 600, one).bottom.empty());
  EXPECT_TRUE(compute_layout({}, 800, 600, one).bottom.empty()) << "nothing to plot yet";
  EXPECT_TRUE(compute_layout({}, 800, 600, one, false).timeline.empty()) << "no mesh";
  EXPECT_FALSE(compute_layout({}, 1280, 800, one).folded);
  EXPECT_FALSE(compute_layout({}, 800, 600, one).folded);
  EXPECT_TRUE(compute_layout({}, 780, 600, one).folded);
  EXPECT_TRUE(compute_layout(open, 800, 600, one).folded) << "two columns";
  EXPECT_FALSE(compute_layout({}, 2560, 1600, two).folded);
}

}  // namespace
}  // namespace dmoscope::ui
