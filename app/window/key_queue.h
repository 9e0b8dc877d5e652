#pragma once
// The keyboard between the desktop and the window: presses in the order they came, each with its own modifiers.

#include <deque>
#include <string_view>

#include <imgui.h>

#include "ui/app.h"

namespace dmoscope::app {

/// Keeps what is typed until a frame takes it, however slow the frames are. What a field or a dialog was to get is text or nothing, never
/// a command, also when it is gone before its turn comes; what no field wants is a command with the modifiers of its press, once.
class KeyQueue {
 public:
  /// `repeated`: by holding the key.
  void press(const ui::KeyChord& chord, bool repeated = false);
  void release(int code);
  /// A character: of the press before it, or of its own (an input method, a script).
  void character(char32_t character);
  void text(std::string_view utf8);
  /// The mouse was pressed: what is typed next is for what it was pressed on.
  void click();
  /// The window lost the keyboard: nothing is held any more.
  void lose_focus();

  /// Before ImGui::NewFrame, once a frame: plays as much as one frame can tell apart.
  void feed(ImGuiIO& io, ui::App& app);
  /// True while something waits for another frame.
  [[nodiscard]] bool waiting() const noexcept { return !events_.empty() || rest_ > 0; }

 private:
  struct Event {
    enum class Kind { Press, Release, Text, Click };
    Kind kind = Kind::Press;
    ui::KeyChord chord{};       // of Press; its code of Release
    bool repeated = false;      // Press
    char32_t character = 0;     // Text, and of a Press that makes one; 0: none
    bool judged = false;        // whether it came while commands had the keyboard is known
    bool for_commands = false;  // it did
  };
  enum class Owner { Commands, Widgets, Text };
  /// One frame's share of the queue.
  struct Turn {
    bool over = false, resting = false;
    int pressed = -1, released = -1;  // keys that ImGui saw change in this frame
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
  int rest_ = 0;                                     // frames until it is seen who has the keyboard now
  int look_ = 0;                                     // frames until it is seen whether what got the focus is typed into
  bool commands_before_ = true;                      // commands had the keyboard before the last frame
  bool ctrl_ = false, shift_ = false, alt_ = false;  // held now
  bool clear_keys_ = false;
  int enter_given_as_ = -1;  // the key that ImGui got in place of Enter, which is held; -1: none
  bool alt_used_ = false;    // with another key or the mouse: letting it go opens no menu
};

}  // namespace dmoscope::app
