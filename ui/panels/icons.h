#pragma once
// Small pictures for buttons where a word would take the room of what it is about. Each button says in its tooltip what it does.

#include <string>

#include "ui/panels/panel_context.h"

namespace dmoscope::ui {

enum class Icon { Eye, EyeOff, Cross, Lock, LockOff, ChevronLeft, ChevronRight, ChevronUp, ChevronDown };

/// In a square around `middle`, `side` pixels wide.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 middle, float side, ImU32 ink);

/// A button of `size`, recorded as `item`; true when it is pressed. `lit`: what it does is in force.
bool icon_button(PanelContext& context, const std::string& item, Icon icon, ImVec2 size, const std::string& tooltip, bool lit = false);

}  // namespace dmoscope::ui
