#include "ui/commands/view_options.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/commands/commands.h"

namespace dmoscope::ui {
namespace {

TEST(ViewOptions, AreReadBackAsTheyWereSavedAndRefuseOtherWords) {
  for (const ViewOption& option : view_options()) {
    if (!option.set) continue;
    for (std::size_t value = 0; value < option.words.size(); ++value) {
      ViewState state, read;
      option.set(state, value);
      EXPECT_EQ(option.get(state), value) << option.command;
      EXPECT_EQ(option_line(state, option.command), std::string(option.command) + ' ' + std::string(option.words[value]));
      EXPECT_TRUE(option.take(option.saved(state), read)) << option.command;
      EXPECT_EQ(option.get(read), value) << option.command;
      for (const nlohmann::json& wrong : {nlohmann::json("no such word"), nlohmann::json(1), nlohmann::json()}) {
        EXPECT_FALSE(option.take(wrong, read)) << option.command;
        EXPECT_EQ(option.get(read), value) << option.command;
      }
    }
  }
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
  EXPECT_FALSE(ticked("inside-clip"));  // of a planar mesh there is no inside
  state.in_space = true;
  EXPECT_TRUE(ticked("inside-clip"));
  EXPECT_TRUE(ticked("inside-flip"));
  EXPECT_FALSE(ticked("inside-axis"));
  EXPECT_TRUE(ticked("link-cameras"));
}

}  // namespace
}  // namespace dmoscope::ui
