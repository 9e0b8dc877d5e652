#include <algorithm>

#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

void set_mark(Timeline& timeline, const CommandHost& host, const std::string& word) {
  if (word == "clear") {
    timeline.a = timeline.b = {};
    timeline.shown = Shown::Now;
    return;
  }
  static constexpr std::array<std::pair<std::string_view, Mark Timeline::*>, 2> marks{{{"a", &Timeline::a}, {"b", &Timeline::b}}};
  Mark Timeline::*mark = choose(word, marks);
  timeline.*mark = mark_of(*open_view(host));
}

void flip(ViewState& state, Arguments words) {
  Timeline& timeline = state.timeline;
  if (words.empty()) {
    timeline.flip();
    if (timeline.shown == Shown::Now && !timeline.a.frame && !timeline.b.frame)
      add_message(state, {Message::Kind::Info, "nothing is marked yet: Shift+A marks what is shown as A, Shift+B as B; X flips", 0});
    return;
  }
  static constexpr std::array<std::pair<std::string_view, Shown>, 3> choices{{{"a", Shown::A}, {"b", Shown::B}, {"now", Shown::Now}}};
  const Shown wanted = choose(words[0], choices);
  if ((wanted == Shown::A && !timeline.a.frame) || (wanted == Shown::B && !timeline.b.frame))
    throw UsageError(fmt::format("{} is not marked: mark {}", words[0] == "a" ? "A" : "B", words[0]));
  timeline.shown = wanted;
}

void start(ViewState& state, Playback::Kind kind) {
  Timeline& timeline = state.timeline;
  timeline.play.kind = kind;
  timeline.play.due = 0.0;
  timeline.play.from_start = true;
  if (kind != Playback::Kind::Off) timeline.shown = Shown::Now;
}

}  // namespace

void add_timeline_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"mark", "mark a|b|clear", "marks what is shown as A or B, to flip between them"}, {1, 1},
            [&state, &host](Arguments words) { set_mark(state.timeline, host, words[0]); });
  table.add({"flip", "flip [a|b|now]", "shows A and B in turn, or what is said"}, {0, 1},
            [&state](Arguments words) { flip(state, words); });
  table.add({"play", "play [on|off|toggle]", "shows the history, iteration by iteration"}, {0, 1}, [&state, &host](Arguments words) {
    (void)open_view(host);
    const bool on = switched(words, 0, state.timeline.play.kind != Playback::Kind::Off);
    start(state, on ? Playback::Kind::History : Playback::Kind::Off);
  });
  table.add({"play-steps", "play-steps vertex|class|iteration|off", "steps again and again, until stopped"}, {1, 1},
            [&state, &host](Arguments words) {
              (void)open_view(host);
              static constexpr std::array<std::pair<std::string_view, Playback::Kind>, 4> kinds{{{"vertex", Playback::Kind::Vertex},
                                                                                                 {"class", Playback::Kind::Class},
                                                                                                 {"iteration", Playback::Kind::Iteration},
                                                                                                 {"off", Playback::Kind::Off}}};
              const Playback::Kind kind = choose(words[0], kinds);
              start(state, kind == state.timeline.play.kind ? Playback::Kind::Off : kind);
            });
}

}  // namespace dmoscope::ui
