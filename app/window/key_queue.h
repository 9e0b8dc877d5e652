#pragma once
// Queue of the keyboard between the desktop and the window: presses in their order, each with its own modifiers.

#include <deque>
#include <string_view>

#include <imgui.h>

#include "ui/app.h"

namespace dmoscope::app {

/// Keeps keys until a frame takes them, however slow the frames are. Keys for a field or a dialog are text or nothing, never a command,
/// even if it is gone before their turn; other keys are commands with the modifiers of their press, once.
class KeyQueue {
 public:
  /// Adds a press. `repeated`: by holding the key.
  void press(const ui::KeyChord& chord, bool repeated = false);
  void release(int code);
  /// Adds a character: of the press before it, or of its own (an input method, a script).
  void character(char32_t character);
  void text(std::string_view utf8);
  /// Adds a mouse click: later keys are for the control under it.
  void click();
  /// Releases all keys, since the window lost the keyboard.
  void lose_focus();

  /// Plays as many events as one frame can tell apart; to be called before ImGui::NewFrame, once a frame.
  void feed(ImGuiIO& io, ui::App& app);
  /// Whether events wait for another frame.
  [[nodiscard]] bool waiting() const noexcept { return !events_.empty() || rest_ > 0; }

 private:
  struct Event {
    enum class Kind { Press, Release, Text, Click };
    Kind kind = Kind::Press;
    ui::KeyChord chord{};       // key and modifiers of a Press; the code of a Release
    bool repeated = false;      // whether a Press is a repeat
    char32_t character = 0;     // character of a Text, or of a Press that makes one; 0: none
    bool judged = false;        // whether for_commands is known
    bool for_commands = false;  // whether commands had the keyboard at the time
  };
  enum class Owner { Commands, Widgets, Text };
  /// One frame's share of the queue.
  struct Turn {
    bool over = false, resting = false;
    int pressed = -1, released = -1;  // keys that changed for ImGui in this frame
    const ui::KeyChord* modifiers = nullptr;
    ui::KeyChord chord{};
  };
  [[nodiscard]] static Owner owner(const ImGuiIO& io, const ui::App& app);
  void judge(const ui::App& app);
  void play_press(const Event& event, ImGuiIO& io, ui::App& app, Turn& turn);
  [[nodiscard]] bool still_held(int code) const;
  [[nodiscard]] int code_for(int code, const ui::App& app);
  void give_key(const Event& event, ImGuiIO& io, const ui::App& app, Turn& turn);
  void set_modifiers(ImGuiIO& io, const Turn& turn);

  std::deque<Event> events_;
  int rest_ = 0;                                     // frames until the keyboard's owner is known
  int look_ = 0;                                     // frames until it is known whether the focused control takes text
  bool commands_before_ = true;                      // commands had the keyboard before the last frame
  bool ctrl_ = false, shift_ = false, alt_ = false;  // held now
  bool clear_keys_ = false;
  int enter_given_as_ = -1;  // the key that ImGui got in place of a held Enter; -1: none
  bool alt_used_ = false;    // together with another key or the mouse, so that releasing it opens no menu
};

}  // namespace dmoscope::app
