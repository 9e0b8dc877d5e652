#pragma once
// Places of the named items of the interface as drawn last, so that scripts and tests click by name.

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
  /// Forgets all items of the last frame.
  void begin_frame() {
    boxes_.clear();
    stops_.clear();
  }
  void record(std::string_view name, const Box& box) { boxes_.insert_or_assign(std::string(name), box); }
  /// Records the item that ImGui drew last.
  void record_last(std::string_view name);
  /// Lets ImGui's item with this id, in the window that is being drawn, take the keyboard by Tab.
  void record_stop(unsigned id);
  /// Gives the keyboard to the control drawn after the one that has it, or before it (`direction` -1), cyclically within the open dialog,
  /// or else all panels; to a text field with its text selected. To be called between ImGui::NewFrame and ImGui::Render.
  void move_focus(int direction) const;
  /// Whether the control that has the keyboard takes typed text or numbers.
  [[nodiscard]] bool focus_takes_text() const;
  /// Gives the keyboard to the window of the menus.
  static void focus_menus();
  /// Makes Escape end the ring around the control that has the keyboard, also within a scrolled part of a panel, which ImGui would only
  /// leave for its panel. To be called between ImGui::NewFrame and ImGui::Render.
  static void end_focus();
  /// Scrolls the panel of this item in the next frame so that the item is seen.
  void scroll_to(std::string_view name) { scroll_to_ = name; }
  /// Place of an item. Throws UsageError that lists the known names.
  [[nodiscard]] const Box& find(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, Box, std::less<>>& boxes() const noexcept { return boxes_; }

 private:
  struct Stop {
    ImGuiWindow* window;
    unsigned id;
    Box box;
    bool takes_text;
  };
  std::vector<Stop> stops_;  // controls that take the keyboard, in the order of drawing
  std::map<std::string, Box, std::less<>> boxes_;
  std::string scroll_to_;
};

/// Whether a tooltip of this frame has another size than its content needs, so that it takes one more frame. To be called once all is
/// drawn, before ImGui::Render.
[[nodiscard]] bool tooltip_unsettled();

}  // namespace dmoscope::ui
