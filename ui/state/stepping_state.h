#pragma once
// What the view shows of stepping: who moves next, and who moved how far.

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// What arrows and ghosts compare the mesh with.
enum class Reference {
  None,
  Input,
  Previous,  // before the last command that moved something
  A,
  B  // what was marked on the timeline
};

/// Whether what a step moved is tinted: for a moment after it, or until the next one.
enum class Flash { Off, On, Hold };

/// What the last step did.
struct StepNews {
  std::string sentence;                 // empty: nothing to be said
  std::vector<Index> moved;             // vertices
  Index vertex = kNoIndex;              // that was visited and stayed
  std::shared_ptr<const Frame> before;  // where they were
  std::uint64_t messages = 0;           // how many there had been: a later one takes the sentence's place
  std::uint64_t serial = 0;             // of the frame that it is about
  double since = 0.0;                   // seconds of a steady clock
};

struct SteppingState {
  Flash flash = Flash::Off;
  int flash_level = 0;  // how strong it is drawn now, 0 to kFlashLevels
  StepNews news;
  bool next_class = false;             // dots on the vertices of the class that moves next
  Reference arrows = Reference::None;  // from where each vertex was to where it is
  double arrow_scale = 0.0;            // by which arrows are too long; 0: chosen so that the longest in view can be seen
  Reference ghost = Reference::None;   // edges as they were
  bool click_smooths = false;          // a click on a free vertex moves it to its best candidate
};

inline constexpr int kFlashLevels = 8;

}  // namespace dmoscope::ui
