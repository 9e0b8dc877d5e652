#include "ui/toolkit/items.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include <imgui.h>
#include <imgui_internal.h>

#include "core/base/error.h"

namespace dmoscope::ui {
namespace {

/// Least size of areas that only the mouse uses: the mesh, a plot.
constexpr float kWidestStop = 60.0F, kHighestStop = 12.0F;  // in heights of the interface's font

}  // namespace

void Items::record_stop(unsigned id) {
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  ImGuiWindow* window = g.CurrentWindow;
  const ImGuiItemFlags flags = g.LastItemData.InFlags;
  if (id == 0 || window->SkipItems || (flags & (ImGuiItemFlags_Disabled | ImGuiItemFlags_NoNav)) != 0) return;
  if (window->DC.NavLayerCurrent != ImGuiNavLayer_Main) return;  // the menu bar is reached by Alt
  const ImRect& rect = g.LastItemData.Rect;
  if (rect.GetWidth() > kWidestStop * g.FontSize || rect.GetHeight() > kHighestStop * g.FontSize) return;
  stops_.push_back({window, id, {rect.Min.x, rect.Min.y, rect.Max.x, rect.Max.y}, (flags & ImGuiItemFlags_Inputable) != 0});
}

void Items::move_focus(int direction) const {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  const ImGuiWindow* dialog = ImGui::GetTopMostPopupModal();
  if (!g.OpenPopupStack.empty() && g.OpenPopupStack.back().Window != dialog) return;  // menus use the arrow keys
  std::vector<Stop> ring;
  std::ranges::copy_if(stops_, std::back_inserter(ring), [&](const Stop& stop) { return !dialog || stop.window->RootWindow == dialog; });
  if (ring.empty()) return;
  const unsigned now = g.ActiveId != 0 ? g.ActiveId : g.NavDisableHighlight ? 0 : g.NavId;
  const auto at = std::ranges::find(ring, now, &Stop::id);
  const auto size = static_cast<std::ptrdiff_t>(ring.size());
  const std::ptrdiff_t last = at != ring.end() ? at - ring.begin() : direction > 0 ? size - 1 : 0;
  const Stop& next = ring[static_cast<std::size_t>((last + direction + size) % size)];
  ImGui::ClearActiveID();
  ImGui::FocusWindow(next.window);
  const ImVec2 corner = next.window->Pos;
  const ImRect rect(next.box[0], next.box[1], next.box[2], next.box[3]);
  ImGui::SetNavID(next.id, ImGuiNavLayer_Main, 0,
                  {rect.Min.x - corner.x, rect.Min.y - corner.y, rect.Max.x - corner.x, rect.Max.y - corner.y});
  g.NavDisableHighlight = false;
  g.NavDisableMouseHover = true;
  g.NavInputSource = ImGuiInputSource_Keyboard;
  ImGui::ScrollToRect(next.window, rect, ImGuiScrollFlags_KeepVisibleEdgeY);
  if (!next.takes_text) return;
  ImGui::ActivateItem(next.id);
  g.NavNextActivateFlags = ImGuiActivateFlags_PreferInput;  // a slider, too, takes a typed number
}

bool Items::focus_takes_text() const {
  const auto at = std::ranges::find(stops_, ImGui::GetCurrentContext()->NavId, &Stop::id);
  return at != stops_.end() && at->takes_text;
}

void Items::focus_menus() {
  if (ImGuiWindow* menus = ImGui::FindWindowByName("menu")) ImGui::FocusWindow(menus);
}

void Items::end_focus() {
  ImGuiContext& g = *ImGui::GetCurrentContext();
  if (g.OpenPopupStack.empty() && g.ActiveId == 0) g.NavDisableHighlight = true;
}

void Items::record_last(std::string_view name) {
  record_stop(ImGui::GetItemID());
  if (!stops_.empty() && stops_.back().id == ImGui::GetItemID())  // ImGui shows no ring around buttons that it does not draw itself
    ImGui::RenderNavHighlight(ImGui::GetCurrentContext()->LastItemData.Rect, stops_.back().id);
  if (!scroll_to_.empty() && name == scroll_to_) {
    if (!ImGui::IsItemVisible()) ImGui::SetScrollHereY(0.5F);
    scroll_to_.clear();
  }
  if (!ImGui::IsItemVisible()) return;  // scrolled out of its panel: something else is at its place
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

bool tooltip_unsettled() {
  const ImVector<ImGuiWindow*>& windows = ImGui::GetCurrentContext()->Windows;
  return std::any_of(windows.begin(), windows.end(), [](ImGuiWindow* window) {
    if (!window->Active || (window->Flags & ImGuiWindowFlags_Tooltip) == 0) return false;
    if (window->Hidden) return true;  // ImGui measures it before it shows it
    const ImVec2 wanted = ImGui::CalcWindowNextAutoFitSize(window);
    constexpr float kHalfPixel = 0.5F;
    return std::abs(wanted.x - window->Size.x) > kHalfPixel || std::abs(wanted.y - window->Size.y) > kHalfPixel;
  });
}

}  // namespace dmoscope::ui
