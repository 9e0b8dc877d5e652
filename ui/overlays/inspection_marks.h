#pragma once
// What of an inspected visit is drawn on the mesh.

#include "render/marks.h"
#include "render/style.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"

namespace dmoscope::ui {

/// Colour of a candidate at which an element is inverted: crosses, so that it is told apart without colour, too.
inline constexpr render::Rgb kInvalidCandidate{0xf0, 0x2d, 0x3c};

/// How the marks look.
struct InspectionLook {
  render::ColourScale colours;   // of candidates, as of the elements
  render::Rgba ink, casing;      // lines, and what they lie on
  render::Rgba accent;           // the best there is
  double units_per_pixel = 1.0;  // of the camera that draws them
  double scale = 1.0;            // pixels at scale 1 are multiplied by it
};

/// As the mesh is drawn; candidates in the colours of quality, whatever the elements show.
[[nodiscard]] InspectionLook inspection_look(const ViewState& state, const Derived& derived, double units_per_pixel);

/// Diameters of candidates, pixels at scale 1. `spacing`: between neighbours, pixels; `part`: 0 the level's worst valid candidate, 1 its
/// best.
[[nodiscard]] float candidate_diameter(double spacing, double part);

/// Where a candidate of a level (from 1) is, relative to where the vertex stood.
[[nodiscard]] Vec3 candidate_at(const Inspection& inspection, int level, int index);

/// Adds the star, and of the levels shown: the grid's outline, a dot or cross for every candidate, a ring around the one chosen, the next
/// grid's outline, and the way from where the vertex stood.
void add_inspection_marks(render::Marks& marks, const InspectionState& state, const Inspection& inspection, const InspectionLook& look);

}  // namespace dmoscope::ui
