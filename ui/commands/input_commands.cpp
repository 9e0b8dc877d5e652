#include "ui/commands/command_words.h"

namespace dmoscope::ui {
namespace {

float pixel(const std::string& word) { return static_cast<float>(to_number(word)); }

/// A point given by two numbers, or the middle of a named item; `at` moves past the words.
std::pair<float, float> parse_point(const CommandHost& host, Arguments words, std::size_t& at) {
  if (words.size() == at + 1) {
    const auto box = host.item(words[at++]);
    return {(box[0] + box[2]) / 2, (box[1] + box[3]) / 2};
  }
  if (words.size() < at + 2) throw UsageError("expected a point, X Y in pixels, or the name of an item");
  const std::pair<float, float> point{pixel(words[at]), pixel(words[at + 1])};
  at += 2;
  return point;
}

using InputKind = SimulatedInput::Kind;

void push_click(ViewState& state, std::pair<float, float> at, int button) {
  auto& input = state.requests.input;
  // The mouse rests for a few frames first: windows that just opened take their place, hovering settles.
  for (int k = 0; k < 2; ++k) input.push_back({InputKind::Move, at.first, at.second, 0, {}, {}});
  input.push_back({InputKind::Press, at.first, at.second, button, {}, {}});
  input.push_back({InputKind::Release, at.first, at.second, button, {}, {}});
}

void push_drag(ViewState& state, Arguments words, int button) {
  const float x0 = pixel(words[0]), y0 = pixel(words[1]), x1 = pixel(words[2]), y1 = pixel(words[3]);
  auto& input = state.requests.input;
  for (int k = 0; k < 2; ++k) input.push_back({InputKind::Move, x0, y0, 0, {}, {}});
  input.push_back({InputKind::Press, x0, y0, button, {}, {}});
  for (int k = 1; k <= 4; ++k) {
    const float t = static_cast<float>(k) / 4;
    input.push_back({InputKind::Move, x0 + t * (x1 - x0), y0 + t * (y1 - y0), 0, {}, {}});
  }
  input.push_back({InputKind::Release, x1, y1, button, {}, {}});
}

}  // namespace

void add_input_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  static constexpr std::array<std::pair<const char*, int>, 2> buttons{{{"click", 0}, {"right-click", 1}}};
  for (const auto& [name, button] : buttons) {
    table.add({name, fmt::format("{} X Y|ITEM", name), "the mouse at a pixel or on a named item"},
              [&state, &host, mouse_button = button](Arguments words) {
                std::size_t at = 0;
                const auto point = parse_point(host, words, at);
                require(words, at, at);
                push_click(state, point, mouse_button);
              });
  }
  table.add({"double-click", "double-click X Y|ITEM", "the mouse, twice"}, [&state, &host](Arguments words) {
    std::size_t at = 0;
    const auto point = parse_point(host, words, at);
    require(words, at, at);
    push_click(state, point, 0);
    push_click(state, point, 0);
  });
  table.add({"move", "move X Y|ITEM", "the mouse without a button"}, [&state, &host](Arguments words) {
    std::size_t at = 0;
    const auto point = parse_point(host, words, at);
    for (int k = 0; k < 2; ++k) state.requests.input.push_back({InputKind::Move, point.first, point.second, 0, {}, {}});
  });
  table.add({"drag", "drag X0 Y0 X1 Y1", "the mouse with the left button held"}, {4, 4},
            [&state](Arguments words) { push_drag(state, words, 0); });
  table.add({"right-drag", "right-drag X0 Y0 X1 Y1", "the mouse with the right button held"}, {4, 4},
            [&state](Arguments words) { push_drag(state, words, 1); });
  table.add({"wheel", "wheel X Y AMOUNT", "the mouse's wheel, up is positive"}, {3, 3}, [&state](Arguments words) {
    const float x = pixel(words[0]), y = pixel(words[1]);
    state.requests.input.push_back({InputKind::Move, x, y, 0, {}, {}});
    state.requests.input.push_back({InputKind::Wheel, 0, pixel(words[2]), 0, {}, {}});
  });
  table.add({"key", "key NAME", "presses a key, such as N or Ctrl+Shift+S"}, {1, 1}, [&state](Arguments words) {
    auto chord = parse_key(words[0]);
    if (!chord) unexpected(words[0], "a key such as N, Space, F1 or Ctrl+Shift+S");
    if (chord->code == '+') chord->code = '=';  // no other key has that name
    state.requests.input.push_back({InputKind::KeyDown, 0, 0, 0, *chord, {}});
    state.requests.input.push_back({InputKind::KeyUp, 0, 0, 0, *chord, {}});
  });
  table.add({"type", "type TEXT", "types a text"}, {1, 1}, [&state](Arguments words) {
    state.requests.input.push_back({InputKind::Text, 0, 0, 0, {}, words[0]});
  });
  table.add({"wait", "wait", "until nothing is pending (scripts wait after every line anyway)"}, {0, 0}, [](Arguments) {});
}

}  // namespace dmoscope::ui
