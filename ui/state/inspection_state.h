#pragma once
// What of a vertex's visit is looked into, as plain data.

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
  Index vertex = kNoIndex;  // that is looked into; none: `note` says why
  std::string note;         // why there is no vertex to look into
  int level = 1;            // whose grid is shown; 0: none
  bool all_levels = false;  // the grids of all levels at once
  bool applied = false;     // the vertex has been sent where its visit takes it
  std::string take_back;    // the command that undoes what was applied; empty: nothing moved
  Moment applied_from;      // where the run stood before
  bool in_order = false;    // it is the one that the run visits next, so that applying is the run's own step
  bool zoom = true;         // the view goes as close as a level's grid needs
  bool field = true;        // the quality around the vertex, in the inspector
  bool field_in_view = false;
  bool own_range = false;  // the inspector's heat maps span each level's own qualities, not the view's range
  bool playing = false;
  double level_since = -1.0;  // when playing came to what is shown, in seconds of the window; < 0: not drawn yet
  // While a level is shown closer than the star: the camera it came from and its own. Whoever moves the camera keeps it.
  std::optional<std::pair<render::Camera2D, render::Camera2D>> close_up;
  std::optional<std::pair<render::OrbitCamera, render::OrbitCamera>> space_close_up;  // likewise of a volume
  // Of a volume: the slice of the grid that the maps show.
  int slice_axis = 2;                    // 0 x, 1 y, 2 z: it is at right angles to it
  std::optional<int> slice;              // from 0; none: each level's own with its chosen candidate
  bool alone = true;                     // the mesh is but a ghost meanwhile
  std::optional<CandidateName> hovered;  // under the mouse in the inspector
};

}  // namespace dmoscope::ui
