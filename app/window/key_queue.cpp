#include "app/window/key_queue.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <imgui_internal.h>

namespace dmoscope::app {
namespace {

namespace key = ui::key;

/// Frames until ImGuiIO shows the owner of the keyboard; the most until a dialog opens.
constexpr int kRest = 2, kRestForField = 8;
constexpr int kKeypadFirst = 320, kKeypadLast = 334, kKeypadEnter = 335;

bool is_modifier(int code) { return code >= key::kLeftShift && code <= key::kLeftShift + 7; }
bool makes_text(int code) { return (code >= key::kSpace && code < key::kEscape) || (code >= kKeypadFirst && code <= kKeypadLast); }
bool is_enter(int code) { return code == key::kEnter || code == kKeypadEnter; }
bool moves_focus(int code) { return is_enter(code) || code == key::kEscape || code == key::kSpace; }

/// Whether a key goes to the control with the focus, if that is visible.
bool is_for_focus(const ui::KeyChord& chord) {
  if (chord.ctrl || chord.alt) return false;
  const int code = chord.code;
  return code == key::kSpace || code == key::kEscape || is_enter(code) || (code >= key::kRight && code <= key::kEnd);
}

}  // namespace

void KeyQueue::press(const ui::KeyChord& chord, bool repeated) {
  if (is_modifier(chord.code)) {
    const int which = (chord.code - key::kLeftShift) % 4;
    (which == 0 ? shift_ : which == 1 ? ctrl_ : alt_) = true;
    return;
  }
  events_.push_back({Event::Kind::Press, chord, repeated});
}

void KeyQueue::release(int code) {
  if (is_modifier(code)) {
    const int which = (code - key::kLeftShift) % 4;
    (which == 0 ? shift_ : which == 1 ? ctrl_ : alt_) = false;
    return;
  }
  events_.push_back({Event::Kind::Release, {code}});
}

void KeyQueue::character(char32_t character) {
  if (!events_.empty() && events_.back().kind == Event::Kind::Press && events_.back().character == 0) {
    events_.back().character = character;
  } else {
    events_.push_back({Event::Kind::Text, {}, false, character});
  }
}

void KeyQueue::text(std::string_view utf8) {
  while (!utf8.empty()) {
    const auto first = static_cast<unsigned char>(utf8.front());
    const std::size_t length = std::min<std::size_t>(first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2, utf8.size());
    char32_t code = length == 1 ? first : first & (0xffU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) code = (code << 6U) | (static_cast<unsigned char>(utf8[k]) & 0x3fU);
    utf8.remove_prefix(length);
    events_.push_back({Event::Kind::Text, {}, false, code});
  }
}

void KeyQueue::click() {
  if (alt_) alt_used_ = true;
  events_.push_back({Event::Kind::Click});
}

void KeyQueue::lose_focus() {
  ctrl_ = shift_ = alt_ = false;
  clear_keys_ = alt_used_ = true;
}

KeyQueue::Owner KeyQueue::owner(const ImGuiIO& io, const ui::App& app) {
  if (io.WantTextInput) return Owner::Text;
  return app.takes_commands() ? Owner::Commands : Owner::Widgets;
}

/// Marks the new events: they were typed while the last frame was made, in sight of the one before it, and are for commands only if these
/// had the keyboard in both.
void KeyQueue::judge(const ui::App& app) {
  const bool now = app.takes_commands();
  for (Event& event : events_) {
    if (std::exchange(event.judged, true)) continue;
    event.for_commands = now && commands_before_;
  }
  commands_before_ = now;
}

void KeyQueue::feed(ImGuiIO& io, ui::App& app) {
  judge(app);
  if (io.WantTextInput && rest_ > kRest) rest_ = 0;  // the expected field has the focus
  Turn turn;
  if (look_ > 0 && --look_ == 0 && !io.WantTextInput && !ImGui::IsAnyMouseDown()) ImGui::ClearActiveID();  // a slider keeps the focus ring
  turn.resting = rest_ > 0;
  if (turn.resting) --rest_;
  if (std::exchange(clear_keys_, false)) std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
  while (!turn.over && !events_.empty()) {
    const Event event = events_.front();
    if (event.kind == Event::Kind::Release) {
      const int code = is_enter(event.chord.code) && enter_given_as_ >= 0 ? enter_given_as_ : event.chord.code;
      if (code == turn.pressed) break;  // within one frame ImGui would not see it
      if (code != event.chord.code) enter_given_as_ = -1;
      if (io.KeysDown[code]) turn.released = code;
      io.KeysDown[code] = false;
      events_.pop_front();
      continue;
    }
    if (turn.resting || turn.pressed >= 0) break;
    if (event.kind == Event::Kind::Click) {
      events_.pop_front();
      rest_ = kRest;
      turn.over = true;
    } else if (event.kind == Event::Kind::Text) {
      events_.pop_front();
      if (owner(io, app) == Owner::Text) io.AddInputCharacter(app.shown_letter(event.character));
    } else {
      play_press(event, io, app, turn);
    }
  }
  set_modifiers(io, turn);
}

void KeyQueue::play_press(const Event& event, ImGuiIO& io, ui::App& app, Turn& turn) {
  const ui::KeyChord& chord = event.chord;
  if (chord.alt) alt_used_ = true;
  const bool focus_moves = chord.code == key::kTab && !chord.ctrl && !chord.alt;
  const Owner who = owner(io, app);
  if (focus_moves && !(who == Owner::Commands && !event.for_commands)) {
    events_.pop_front();
    app.move_focus(chord.shift ? -1 : 1);
    look_ = kRest + 1;
    rest_ = kRest;
    turn.over = true;
    return;
  }
  switch (who) {
    case Owner::Text:
      if (event.character != 0) {
        events_.pop_front();
        return io.AddInputCharacter(app.shown_letter(event.character));
      }
      if (event.repeated || (makes_text(chord.code) && !chord.ctrl)) return events_.pop_front();  // ImGui repeats by itself
      return give_key(event, io, app, turn);
    case Owner::Widgets:
      if (event.repeated || (makes_text(chord.code) && chord.code != key::kSpace)) return events_.pop_front();
      return give_key(event, io, app, turn);
    case Owner::Commands:
      if (!event.for_commands) return events_.pop_front();
      if (io.NavVisible && is_for_focus(chord)) {
        if (event.repeated) return events_.pop_front();
        return give_key(event, io, app, turn);
      }
      events_.pop_front();
      if (event.repeated && !still_held(chord.code)) return;
      app.press(chord, event.repeated);
      if (app.takes_commands()) return;
      rest_ = kRestForField;  // later keys are for the dialog that it opened
      turn.over = true;
  }
}

/// Whether a repeated key is still held: late repeats in a slow window count once, and not at all after the key was released.
bool KeyQueue::still_held(int code) const {
  return std::ranges::none_of(events_, [&](const Event& later) {
    return later.chord.code == code && (later.kind == Event::Kind::Release || (later.kind == Event::Kind::Press && later.repeated));
  });
}

/// Code that ImGui gets for a key: Enter presses the control with the focus ring as Space does; ImGui keeps Enter for fields that take
/// text.
int KeyQueue::code_for(int code, const ui::App& app) {
  if (!is_enter(code)) return code;
  enter_given_as_ = ImGui::GetIO().NavVisible && !app.focus_takes_text() ? key::kSpace : -1;
  return enter_given_as_ >= 0 ? enter_given_as_ : code;
}

void KeyQueue::give_key(const Event& event, ImGuiIO& io, const ui::App& app, Turn& turn) {
  const int code = code_for(event.chord.code, app);
  if (code == turn.released) {  // pressed again: ImGui must see the release in between
    turn.over = true;
    return;
  }
  turn.chord = event.chord;
  turn.modifiers = &turn.chord;
  turn.pressed = code;
  io.KeysDown[code] = true;
  if (moves_focus(code)) rest_ = kRest;
  events_.pop_front();
}

void KeyQueue::set_modifiers(ImGuiIO& io, const Turn& turn) {
  const ui::KeyChord held{0, ctrl_, shift_, alt_};
  const ui::KeyChord& now = turn.modifiers == nullptr ? held : *turn.modifiers;
  // Opens the menus here: ImGui opens those of the window that has the keyboard, which seldom has any.
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  if (io.KeyAlt && !now.alt && g.NavWindowingToggleLayer && g.OpenPopupStack.empty()) ui::Items::focus_menus();
  io.KeyCtrl = now.ctrl;
  io.KeyShift = now.shift;
  io.KeyAlt = now.alt;
  io.KeySuper = std::exchange(alt_used_, false);  // another modifier keeps ImGui from opening the menus, as it does for Alt alone
}

}  // namespace dmoscope::app
