#include "ui/state/view_options.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/commands/commands.h"
#include "ui/commands/settings.h"
#include "ui/commands/view_commands.h"
#include "ui/commands/view_json.h"

namespace dmoscope::ui {
namespace {

using Kind = ViewOption::Kind;
using nlohmann::json;

/// Values that an option can have, its default among them.
std::vector<double> values_of(const ViewOption& option) {
  if (option.kind() == Kind::Flag) return {0.0, 1.0};
  std::vector<double> values;
  for (std::size_t k = 0; k < option.at.choices.size(); ++k) values.push_back(static_cast<double>(k));
  if (!values.empty()) return values;
  values = {option.at.number.least, option.at.number.most, option.at.get({})};
  if (!std::isnan(option.at.number.rest)) values.push_back(option.at.number.rest);
  return values;
}

json::json_pointer pointer(std::string_view member) { return json::json_pointer(std::string(member)); }

TEST(ViewOptions, AreReadBackAsTheyWereSavedAndRefuseOtherWords) {
  for (const ViewOption& option : view_options()) {
    if (option.at.set == nullptr) continue;
    for (const double value : values_of(option)) {
      ViewState state, read;
      option.at.set(state, value);
      EXPECT_EQ(option.at.get(state), value) << option.command << option.kept.member;
      if (!option.is_saved(state)) continue;
      EXPECT_TRUE(option.take(option.saved(state), read)) << option.command << option.kept.member;
      EXPECT_EQ(option.at.get(read), value) << option.command << option.kept.member;
      for (const json& wrong : {json("no such word"), json(-1e301), json(), json::array()}) {
        EXPECT_FALSE(option.take(wrong, read)) << option.command << option.kept.member;
        EXPECT_EQ(option.at.get(read), value) << option.command << option.kept.member;
      }
    }
  }
}

TEST(ViewOptions, BeginAsANewWindowDoes) {
  const json view = json::parse(view_json({})), settings = json::parse(settings_text({}));
  for (const ViewOption& option : view_options()) {
    ViewState read;
    if (option.at.set != nullptr) option.at.set(read, values_of(option).front());
    if (!option.kept.member.empty()) {
      EXPECT_TRUE(option.take(view[pointer(option.kept.member)], read));
      EXPECT_EQ(option.at.get(read), option.at.get({})) << option.kept.member;
    }
    if (!option.kept.setting.empty()) {
      EXPECT_TRUE(option.take(settings[pointer(option.kept.setting)], read));
      EXPECT_EQ(option.at.get(read), option.at.get({})) << option.kept.setting;
    }
  }
}

TEST(ViewOptions, AreSetByTheirCommandsAndComeBackFromSessionSettingsAndScript) {
  for (const ViewOption& option : view_options()) {
    if (option.doc.empty()) continue;
    for (const double value : values_of(option)) {
      SCOPED_TRACE(std::string(option.command) + ' ' + option.word(value));
      ViewState state, again, by_script;
      state.in_space = by_script.in_space = option.entry.needs == Needs::Volume;
      by_script.panels.plots_wait = false;
      const CommandHost host;
      const CommandTable table = view_commands(state, host), script = view_commands(by_script, host);
      table.execute(std::string(option.command) + ' ' + option.word(value));
      EXPECT_EQ(option.at.get(state), value);
      if (!option.kept.member.empty() && option.is_saved(state)) {
        EXPECT_EQ(json::parse(view_json(state))[pointer(option.kept.member)], option.saved(state));
        apply_view_json(view_json(state), again, nullptr);
        EXPECT_EQ(option.at.get(again), value);
      }
      if (!option.kept.setting.empty()) {
        ViewState next;
        EXPECT_TRUE(apply_settings(settings_text(state), next));
        EXPECT_EQ(option.at.get(next), value);
      }
      if (!option.kept.in_scripts) continue;
      for (const std::string& line : view_lines(state, false)) script.execute(line);
      EXPECT_EQ(option.at.get(by_script), value);
    }
  }
}

TEST(ViewOptions, AreSwitchedByTheirActionsAndHaveTheirTicks) {
  std::set<std::string_view> ids;
  for (const Action& action : actions()) {
    EXPECT_TRUE(ids.insert(action.id).second) << action.id;
    EXPECT_FALSE(action.menu.empty()) << action.id;
  }
  for (const ViewOption& option : view_options()) {
    if (option.doc.empty()) continue;
    SCOPED_TRACE(option.command);
    ViewState state;
    state.in_space = option.entry.needs == Needs::Volume;
    const CommandHost host;
    const CommandTable table = view_commands(state, host);
    if (!option.entry.after.empty()) {
      const Action& action = *find_action(option.entry.id.empty() ? option.command : option.entry.id);
      const double before = option.now(state);
      table.execute(action.command);
      EXPECT_NE(option.now(state), before);
      if (option.kind() == Kind::Flag) {
        EXPECT_EQ(is_ticked(state, action), option.now(state) != 0.0);
      }
    }
    for (const OptionChoice& choice : option.at.choices) {
      const Action* action = find_action(choice.id.empty() ? std::string(option.command) + '-' + std::string(choice.word) : choice.id);
      if (option.entries.after.empty() || action == nullptr) continue;
      option.at.set(state, static_cast<double>(option.at.choices.size() - 1));
      if (option.value_of(choice.word) != option.at.get(state)) table.execute(action->command);
      EXPECT_TRUE(is_ticked(state, *action)) << action->id;
    }
  }
}

TEST(ViewOptions, CommandsSayWhatTheyExpect) {
  const std::pair<const char*, const char*> wrong[] = {
      {"wireframe perhaps", "\"perhaps\": expected on, off or toggle"},
      {"theme lihgt", "\"lihgt\": expected one of dark, light, contrast; did you mean light?"},
      {"theme pink", "\"pink\": expected one of dark, light, contrast"},
      {"plot-x second", "\"second\": expected one of iteration, seconds; did you mean seconds?"},
      {"arrows input twice", "\"twice\": expected toggle"},
      {"shrink 0", "\"0\": expected a number from 1e-06 to 1"},
      {"shrink small", "'small' is not a number; usage: shrink FACTOR|toggle"},
      {"split 2", "\"2\": expected a number from 0 to 1"},
      {"color-steps 1", "\"1\": expected 0, or a whole number from 2 to 64"},
      {"worst-view 0", "\"0\": expected off, or a whole number from 1 to 100"},
      {"worst-view 101", "\"101\": expected off, or a whole number from 1 to 100"},
      {"worst-cells 2.5", "'2.5' is not a whole number of at least 0; usage: worst-cells N|off|toggle"},
      {"speed 0", "\"0\": expected a number greater than 0"},
      {"panel top", "\"top\": expected one of setup, facts, left, right, bottom"},
      {"panel-size left", "too few arguments; usage: panel-size left|right|bottom|runs EM|default"},
      {"link-cameras off", "all viewports of a volume mesh share one camera"},
      {"brush on", "the brush works on planar meshes only; select vertices of a volume mesh by their ids"},
  };
  for (const auto& [line, said] : wrong) {
    ViewState state;
    state.in_space = true;
    const std::string before = view_json(state);
    const CommandHost host;
    const CommandTable table = view_commands(state, host);
    try {
      table.execute(line);
      ADD_FAILURE() << line;
    } catch (const UsageError& error) {
      EXPECT_STREQ(error.what(), said) << line;
    }
    EXPECT_EQ(view_json(state), before) << line;
  }
}

TEST(ViewOptions, NumbersGoUpAndDownAndBackToWhatIsUsual) {
  ViewState state;
  const CommandHost host;
  const CommandTable table = view_commands(state, host);
  const std::tuple<const char*, const char*, double> steps[] = {{"arrow-scale", "arrow-scale up", 2.0},
                                                                {"arrow-scale", "arrow-scale down", 1.0},
                                                                {"arrow-scale", "arrow-scale 1e9", 1e6},
                                                                {"arrow-scale", "arrow-scale auto", 0.0},
                                                                {"arrow-scale", "arrow-scale down", 0.5},
                                                                {"peel", "peel more", 1.0},
                                                                {"peel", "peel less", 0.0},
                                                                {"peel", "peel less", 0.0},
                                                                {"peel", "peel 7", 7.0},
                                                                {"worst-view", "worst-view toggle", 10.0},
                                                                {"worst-view", "worst-view toggle", 0.0},
                                                                {"worst-cells", "worst-cells toggle", 50.0},
                                                                {"shrink", "shrink toggle", 0.8},
                                                                {"shrink", "shrink toggle", 1.0},
                                                                {"speed", "speed 1000", 60.0},
                                                                {"speed", "speed default", 10.0},
                                                                {"panel-size left", "panel-size left 3", 6.0},
                                                                {"panel-size runs", "panel-size runs 3", 4.0},
                                                                {"panel-size left", "panel-size left default", 16.0}};
  for (const auto& [option, line, value] : steps) {
    table.execute(line);
    EXPECT_EQ(view_option(option).at.get(state), value) << line;
  }
  EXPECT_TRUE(state.inside.ghost) << "only the worst cells are seen in a faint rest";
}

TEST(ViewOptions, TickWhatIsSo) {
  ViewState state;
  const auto ticked = [&state](std::string_view id) { return is_ticked(state, *find_action(id)); };
  EXPECT_TRUE(ticked("wireframe"));
  EXPECT_TRUE(ticked("theme-dark"));
  EXPECT_FALSE(ticked("theme-light"));
  EXPECT_TRUE(ticked("range-input"));
  EXPECT_TRUE(ticked("arrows-auto"));
  EXPECT_TRUE(ticked("labels-off"));
  EXPECT_FALSE(ticked("fit"));
  EXPECT_FALSE(ticked("level-next"));
  EXPECT_FALSE(ticked("next-map"));
  state.stepping.arrows = Reference::Input;
  EXPECT_TRUE(ticked("arrows-input"));
  EXPECT_FALSE(ticked("arrows-previous"));
  state.colouring.label_vertices = state.colouring.label_elements = true;
  EXPECT_TRUE(ticked("labels-both"));
  state.timeline.play.kind = Playback::Kind::Class;
  EXPECT_TRUE(ticked("play-classes"));
  EXPECT_FALSE(ticked("play"));
  state.range_mode = RangeMode::Percentile;
  EXPECT_TRUE(ticked("range-percentile"));
  state.inside.clip.on = state.inside.clip.flip = true;
  EXPECT_FALSE(ticked("inside-clip"));  // a planar mesh has no inside
  state.in_space = true;
  EXPECT_TRUE(ticked("inside-clip"));
  EXPECT_TRUE(ticked("inside-flip"));
  EXPECT_FALSE(ticked("inside-axis"));
  EXPECT_TRUE(ticked("link-cameras"));
}

}  // namespace
}  // namespace dmoscope::ui
