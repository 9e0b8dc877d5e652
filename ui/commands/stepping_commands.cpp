#include <algorithm>

#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

/// With "toggle" behind it, a reference that is shown already is shown no more.
Reference chosen(Arguments words, Reference now) {
  const Reference wanted = choose(words[0], kReferences);
  if (words.size() == 1) return wanted;
  if (words[1] != "toggle") unexpected(words[1], "toggle");
  return wanted == now ? Reference::None : wanted;
}

}  // namespace

void add_stepping_commands(CommandTable& table, ViewState& state) {
  table.add({"flash", "flash off|on|hold|toggle", "shows what a step has moved: for a moment, or until the next step"}, {1, 1},
            [&state](Arguments words) {
              Flash& flash = state.stepping.flash;
              flash = words[0] == "toggle" ? (flash == Flash::Off ? Flash::On : Flash::Off) : choose(words[0], kFlashes);
            });
  add_option_commands(table, state, {"next-class"});
  table.add(
      {"arrows", "arrows off|input|previous|a|b [toggle]", "from where vertices were: at the input, before the last command, or at a mark"},
      {1, 2}, [&state](Arguments words) { state.stepping.arrows = chosen(words, state.stepping.arrows); });
  table.add({"arrow-scale", "arrow-scale FACTOR|auto|up|down", "how many times too long the arrows are drawn"}, {1, 1},
            [&state](Arguments words) {
              double& scale = state.stepping.arrow_scale;
              if (words[0] == "auto") {
                scale = 0.0;
                return;
              }
              const double now = scale > 0.0 ? scale : 1.0;
              const double wanted = words[0] == "up" ? now * 2.0 : words[0] == "down" ? now / 2.0 : to_number(words[0]);
              if (!(wanted > 0.0)) throw UsageError("the factor must be greater than 0");
              scale = std::clamp(wanted, 1e-3, 1e6);
            });
  table.add({"ghost", "ghost off|input|previous|a|b [toggle]", "edges as they were: at the input, before the last command, or at a mark"},
            {1, 2}, [&state](Arguments words) { state.stepping.ghost = chosen(words, state.stepping.ghost); });
}

}  // namespace dmoscope::ui
