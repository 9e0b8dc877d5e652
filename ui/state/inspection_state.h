#pragma once
// State of the inspector of a vertex's visit, as plain data.

#include <optional>
#include <string>
#include <utility>

#include "core/base/vec.h"
#include "core/run/moment.h"
#include "render/camera.h"
#include "render/orbit_camera.h"

namespace dmoscope::ui {

/// A candidate of the grid of a level (from 1).
struct CandidateName {
  int level = 0, index = 0;
  friend bool operator==(const CandidateName&, const CandidateName&) = default;
};

struct InspectionState {
  bool open = false;
  Index vertex = kNoIndex;  // vertex under inspection; none: `note` says why
  std::string note;         // reason why there is no vertex to inspect
  int level = 1;            // level whose grid is shown; 0: none
  bool all_levels = false;  // the grids of all levels at once
  bool applied = false;     // the vertex has been moved to where its visit takes it
  std::string take_back;    // command that undoes the applied move; empty: nothing moved
  Moment applied_from;      // moment of the run before that
  bool in_order = false;    // whether the run visits this vertex next, so that applying is the run's own step
  bool zoom = true;         // whether the view goes as close as a level's grid needs
  bool field = true;        // whether the inspector shows the quality around the vertex
  bool field_in_view = false;
  bool own_range = false;  // whether the inspector's heat maps span each level's own qualities instead of the view's range
  bool playing = false;
  double level_since = -1.0;  // time when playing came to this level, in seconds of the window; < 0: not drawn yet
  // Camera before a level was shown closer than the star, and the close camera. A camera that a person moved stays.
  std::optional<std::pair<render::Camera2D, render::Camera2D>> close_up;
  std::optional<std::pair<render::OrbitCamera, render::OrbitCamera>> space_close_up;  // cameras of close_up for a volume mesh
  // Slice of a volume's grid that the maps show.
  int slice_axis = 2;                    // axis at right angles to the slice: 0 x, 1 y, 2 z
  std::optional<int> slice;              // number of the slice, from 0; none: for each level the one with its chosen candidate
  bool alone = true;                     // whether the rest of the mesh is drawn faintly meanwhile
  std::optional<CandidateName> hovered;  // candidate under the mouse in the inspector
};

}  // namespace dmoscope::ui
