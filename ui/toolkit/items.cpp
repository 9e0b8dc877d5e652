#include "ui/toolkit/items.h"

#include <imgui.h>

#include "core/base/error.h"

namespace dmoscope::ui {

void Items::record_last(std::string_view name) {
  if (!ImGui::IsItemVisible()) return;  // scrolled out of its panel: something else is where it would be
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  record(name, {low.x, low.y, high.x, high.y});
}

const Items::Box& Items::find(const std::string& name) const {
  const auto at = boxes_.find(name);
  if (at != boxes_.end()) return at->second;
  std::string names;
  for (const auto& [known, box] : boxes_) {
    if (!names.empty()) names += ", ";
    names += known;
  }
  throw UsageError("there is no item \"" + name + "\" on screen; there are " + names);
}

}  // namespace dmoscope::ui
