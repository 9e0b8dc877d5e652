#include "app/window/simulated_input.h"

#include <algorithm>
#include <iterator>

namespace dmoscope::app {

void SimulatedInput::play(const ui::SimulatedInput& input, ImGuiIO& io) {
  using Kind = ui::SimulatedInput::Kind;
  switch (input.kind) {
    case Kind::Move:
      mouse_ = {input.x, input.y};
      break;
    case Kind::Press:
    case Kind::Release:
      mouse_ = {input.x, input.y};
      down_.at(static_cast<std::size_t>(input.button)) = input.kind == Kind::Press;
      break;
    case Kind::Wheel:
      io.MouseWheel = input.y;
      break;
    case Kind::KeyDown:
    case Kind::KeyUp: {
      const bool down = input.kind == Kind::KeyDown;
      io.KeyCtrl = down && input.chord.ctrl;
      io.KeyShift = down && input.chord.shift;
      io.KeyAlt = down && input.chord.alt;
      io.KeysDown[input.chord.code] = down;
      break;
    }
    case Kind::Text:
      io.AddInputCharactersUTF8(input.text.c_str());
      break;
  }
}

void SimulatedInput::hold(ImGuiIO& io) const {
  io.MousePos = mouse_;
  std::copy(down_.begin(), down_.end(), std::begin(io.MouseDown));
}

}  // namespace dmoscope::app
