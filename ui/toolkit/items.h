#pragma once
// Where the named items of the interface were drawn last, so that scripts and tests click by name.

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

struct ImGuiWindow;

namespace dmoscope::ui {

class Items {
 public:
  using Box = std::array<float, 4>;  // left, top, right, bottom in pixels
  /// Forgets all of the last frame.
  void begin_frame() {
    boxes_.clear();
    stops_.clear();
  }
  void record(std::string_view name, const Box& box) { boxes_.insert_or_assign(std::string(name), box); }
  /// Records the item that ImGui drew last.
  void record_last(std::string_view name);
  /// The item of ImGui with this id, in the window that is being drawn, takes the keyboard by Tab.
  void record_stop(unsigned id);
  /// Gives the keyboard to the control that was drawn after the one that has it, or before it (`direction` -1), round and round within the
  /// dialog that is open, or else all panels; to a text field with its text selected. Between ImGui::NewFrame and ImGui::Render.
  void move_focus(int direction) const;
  /// The control that has the keyboard takes text, or a number, that is typed.
  [[nodiscard]] bool focus_takes_text() const;
  /// Gives the keyboard to the window of the menus.
  static void focus_menus();
  /// Escape ends the ring round the control that has the keyboard, also within a panel's part that scrolls by itself, which ImGui would
  /// only leave for its panel. Between ImGui::NewFrame and ImGui::Render.
  static void end_focus();
  /// The panel of this item scrolls in the next frame so that it is seen.
  void scroll_to(std::string_view name) { scroll_to_ = name; }
  /// Throws UsageError that lists the known names.
  [[nodiscard]] const Box& find(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, Box, std::less<>>& boxes() const noexcept { return boxes_; }

 private:
  struct Stop {
    ImGuiWindow* window;
    unsigned id;
    Box box;
    bool takes_text;
  };
  std::vector<Stop> stops_;  // in the order they were drawn
  std::map<std::string, Box, std::less<>> boxes_;
  std::string scroll_to_;
};

}  // namespace dmoscope::ui
