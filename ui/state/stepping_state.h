#pragma once
// Display of stepping: which vertices move next, and which moved how far.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// State that arrows and ghosts compare the mesh with.
enum class Reference {
  None,
  Input,
  Previous,  // before the last command that moved something
  A,
  B  // moments marked on the timeline
};

/// Whether vertices that a step moved are tinted: for a moment after it, or until the next one.
enum class Flash { Off, On, Hold };

/// Effect of the last step.
struct StepNews {
  std::string sentence;                 // empty: nothing to say
  std::vector<Index> moved;             // vertices
  Index vertex = kNoIndex;              // vertex that was visited and stayed
  std::shared_ptr<const Frame> before;  // positions before the step
  std::uint64_t messages = 0;           // number of messages before it: a later one replaces the sentence
  std::uint64_t serial = 0;             // serial of the frame that it is about
  double since = 0.0;                   // time of the step, in seconds of a steady clock
};

struct SteppingState {
  Flash flash = Flash::Off;
  int flash_level = 0;  // present strength of the tint, 0 to kFlashLevels
  StepNews news;
  bool next_class = false;             // dots on the vertices of the colour class that moves next
  Reference arrows = Reference::None;  // start of the arrows, which end at the present positions
  double arrow_scale = 0.0;            // factor of the arrows' length; 0: chosen so that the longest in view can be seen
  Reference ghost = Reference::None;   // state whose edges are drawn
  bool click_smooths = false;          // a click on a free vertex moves it to its best candidate
};

inline constexpr int kFlashLevels = 8;

}  // namespace dmoscope::ui
