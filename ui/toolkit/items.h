#pragma once
// Where the named items of the interface were drawn last, so that scripts and tests click by name.

#include <array>
#include <map>
#include <string>
#include <string_view>

namespace dmoscope::ui {

class Items {
 public:
  using Box = std::array<float, 4>;  // left, top, right, bottom in pixels
  /// Forgets all of the last frame.
  void begin_frame() { boxes_.clear(); }
  void record(std::string_view name, const Box& box) { boxes_.insert_or_assign(std::string(name), box); }
  /// Records the item that ImGui drew last.
  void record_last(std::string_view name);
  /// Throws UsageError that lists the known names.
  [[nodiscard]] const Box& find(const std::string& name) const;
  [[nodiscard]] const std::map<std::string, Box, std::less<>>& boxes() const noexcept { return boxes_; }

 private:
  std::map<std::string, Box, std::less<>> boxes_;
};

}  // namespace dmoscope::ui
