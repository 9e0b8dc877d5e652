#pragma once
// What the view shows of stepping: who moves next, and who moved how far.

namespace dmoscope::ui {

/// What arrows and ghosts compare the mesh with.
enum class Reference {
  None,
  Input,
  Previous,  // before the last command that moved something
  A,
  B  // what was marked on the timeline
};

struct SteppingState {
  bool next_class = false;             // dots on the vertices of the class that moves next
  Reference arrows = Reference::None;  // from where each vertex was to where it is
  double arrow_scale = 0.0;            // by which arrows are too long; 0: chosen so that the longest in view can be seen
  Reference ghost = Reference::None;   // edges as they were
  bool click_smooths = false;          // a click on a free vertex visits it
};

}  // namespace dmoscope::ui
