#include "app/window/simulated_input.h"

#include <algorithm>
#include <iterator>

namespace dmoscope::app {

void SimulatedInput::play(const ui::SimulatedInput& input, ImGuiIO& io, KeyQueue& keys) {
  using Kind = ui::SimulatedInput::Kind;
  switch (input.kind) {
    case Kind::Move:
      mouse_ = {input.x, input.y};
      break;
    case Kind::Press:
    case Kind::Release:
      mouse_ = {input.x, input.y};
      down_.at(static_cast<std::size_t>(input.button)) = input.kind == Kind::Press;
      if (input.kind == Kind::Press) keys.click();
      break;
    case Kind::Wheel:
      io.MouseWheel = input.y;
      break;
    case Kind::KeyDown:
      keys.press(input.chord);
      break;
    case Kind::KeyUp:
      keys.release(input.chord.code);
      break;
    case Kind::Text:
      keys.text(input.text);
      break;
  }
}

void SimulatedInput::hold(ImGuiIO& io) const {
  io.MousePos = mouse_;
  std::copy(down_.begin(), down_.end(), std::begin(io.MouseDown));
}

}  // namespace dmoscope::app
