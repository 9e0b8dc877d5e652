#pragma once
// The mouse and keyboard of scripts, played through the same queue as the user's.

#include <array>

#include <imgui.h>

#include "app/window/key_queue.h"
#include "ui/state/view_state.h"

namespace dmoscope::app {

class SimulatedInput {
 public:
  /// Plays one event; call hold afterwards.
  void play(const ui::SimulatedInput& input, ImGuiIO& io, KeyQueue& keys);
  /// Keeps the mouse where the script left it, whatever the platform says; to be called before every ImGui::NewFrame.
  void hold(ImGuiIO& io) const;

 private:
  ImVec2 mouse_{-1.0F, -1.0F};
  std::array<bool, 3> down_{};
};

}  // namespace dmoscope::app
