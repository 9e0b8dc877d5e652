#pragma once
// Small pictures for buttons, drawn from strokes. A button without a word explains itself in its tooltip.

#include <string>
#include <string_view>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

/// Strokes on a grid of 16 x 16: M x y begins one, L x y goes on, Q cx cy x y curves, A cx cy radius from to is an arc in degrees
/// (clockwise from the right), Z closes it, F fills it.
struct Icon {
  static constexpr std::string_view kEye = "M1.3 8Q8 -0.5 14.7 8Q8 16.5 1.3 8ZA8 8 2 0 360F";
  static constexpr std::string_view kEyeOff = "M1.3 8Q8 -0.5 14.7 8Q8 16.5 1.3 8ZA8 8 2 0 360FM2.6 13.4L13.4 2.6";
  static constexpr std::string_view kCross = "M4 4L12 12M4 12L12 4";
  static constexpr std::string_view kLock = "M3.8 7.5L12.2 7.5L12.2 13.7L3.8 13.7FM5.2 7.5A8 5.6 2.8 180 360L10.8 7.5";
  static constexpr std::string_view kLockOff = "M3.8 7.5L12.2 7.5L12.2 13.7L3.8 13.7FM5.2 7.5A8 4.4 2.8 180 360";
  static constexpr std::string_view kChevronLeft = "M11 2.6L5 8L11 13.4";
  static constexpr std::string_view kChevronRight = "M5 2.6L11 8L5 13.4";
  static constexpr std::string_view kChevronUp = "M2.6 11L8 5L13.4 11";
  static constexpr std::string_view kChevronDown = "M2.6 5L8 11L13.4 5";
  static constexpr std::string_view kPlay = "M4.5 3L13 8L4.5 13F";
  static constexpr std::string_view kPause = "M3.5 3L6.7 3L6.7 13L3.5 13FM9.3 3L12.5 3L12.5 13L9.3 13F";
  static constexpr std::string_view kStep = "M3.5 3.5L10 8L3.5 12.5ZM12.5 3.5L12.5 12.5";
  static constexpr std::string_view kBack = "M12.5 3.5L6 8L12.5 12.5ZM3.5 3.5L3.5 12.5";
  static constexpr std::string_view kSpark = "M8 1.5Q8.6 7.4 14.5 8Q8.6 8.6 8 14.5Q7.4 8.6 1.5 8Q7.4 7.4 8 1.5Z";
  static constexpr std::string_view kReset = "A8 8.5 5 -140 150M3.6 1.8L3.6 5.8L7.6 5.8";
  static constexpr std::string_view kUndo = "M6 3L2.5 6.5L6 10M2.5 6.5L10 6.5A10 9.5 3 -90 90L6.5 12.5";
  static constexpr std::string_view kRedo = "M10 3L13.5 6.5L10 10M13.5 6.5L6 6.5A6 9.5 3 -90 -270L9.5 12.5";
  static constexpr std::string_view kFit = "M2.5 6L2.5 2.5L6 2.5M10 2.5L13.5 2.5L13.5 6M13.5 10L13.5 13.5L10 13.5M6 13.5L2.5 13.5L2.5 10";
  static constexpr std::string_view kWires = "M8 2L14 13.5L2 13.5ZM5 7.75L11 7.75L8 13.5Z";
  static constexpr std::string_view kRing = "A8 8 5.5 0 360Z";
  static constexpr std::string_view kSun =
      "A8 8 3 0 360ZM8 1L8 3M8 13L8 15M1 8L3 8M13 8L15 8M3.1 3.1L4.5 4.5M11.5 11.5L12.9 12.9M12.9 3.1L11.5 4.5M4.5 11.5L3.1 12.9";
  static constexpr std::string_view kClip = "M3 3L13 3L13 13L3 13ZM3 13L13 3";
  static constexpr std::string_view kCell = "M8 1.8L13.5 4.8L13.5 11.2L8 14.2L2.5 11.2L2.5 4.8ZM2.5 4.8L8 7.8L13.5 4.8M8 7.8L8 14.2";
  static constexpr std::string_view kSearch = "A7 7 4.3 0 360ZM10.2 10.2L14 14";
  static constexpr std::string_view kOpen = "M1.5 12.8L1.5 3.5L6 3.5L7.5 5.5L14.5 5.5L14.5 12.8Z";
};

/// Draws an icon in a square around `middle`, `side` pixels wide.
void draw_icon(ImDrawList& list, std::string_view icon, ImVec2 middle, float side, ImU32 ink);

/// Draws a button of `size`, recorded as `item`; true when it is pressed. `lit`: its effect is in force.
bool icon_button(PanelContext& context, const std::string& item, std::string_view icon, ImVec2 size, const std::string& tooltip,
                 bool lit = false);
/// Draws such a button for an action, lit while that is ticked; records the item under the action's id.
void action_icon(PanelContext& context, std::string_view id, std::string_view icon, ImVec2 size);

}  // namespace dmoscope::ui
