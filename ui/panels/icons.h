#pragma once
// Small pictures for buttons that have no room for a word. Each button explains itself in its tooltip.

#include <string>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

enum class Icon { Eye, EyeOff, Cross, Lock, LockOff, ChevronLeft, ChevronRight, ChevronUp, ChevronDown };

/// Draws an icon in a square around `middle`, `side` pixels wide.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 middle, float side, ImU32 ink);

/// Draws a button of `size`, recorded as `item`; true when it is pressed. `lit`: its effect is in force.
bool icon_button(PanelContext& context, const std::string& item, Icon icon, ImVec2 size, const std::string& tooltip, bool lit = false);

}  // namespace dmoscope::ui
