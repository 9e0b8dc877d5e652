#pragma once
// Marks of an inspected visit on the mesh.

#include "render/marks.h"
#include "render/style.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/inspection.h"

namespace dmoscope::ui {

/// Colour of a candidate at which an element is inverted; it is a cross, too, which can be told apart without colour.
inline constexpr render::Rgb kInvalidCandidate{0xf0, 0x2d, 0x3c};

/// Look of the marks.
struct InspectionLook {
  render::ColourScale colours;   // colours of candidates, as of the elements
  render::Rgba ink, casing;      // colours of lines and of their casings
  render::Rgba accent;           // colour of the best place
  double units_per_pixel = 1.0;  // units per pixel of the camera that draws them
  double scale = 1.0;            // factor of lengths in pixels at scale 1
};

/// Look of the marks in the view; candidates have the colours of quality, whatever the elements show.
[[nodiscard]] InspectionLook inspection_look(const ViewState& state, const Derived& derived, double units_per_pixel);

/// Diameter of a candidate, in pixels at scale 1. `spacing`: distance of neighbours in pixels; `part`: 0 the level's worst valid candidate,
/// 1 its best.
[[nodiscard]] float candidate_diameter(double spacing, double part);

/// Place of a candidate of a level (from 1), relative to the vertex's place before the visit.
[[nodiscard]] Vec3 candidate_at(const Inspection& inspection, int level, int index);

/// Adds the star, and for the levels shown the grid's outline, a dot or cross for every candidate, a ring around the chosen one, the next
/// grid's outline, and the way from the vertex's old place.
void add_inspection_marks(render::Marks& marks, const InspectionState& state, const Inspection& inspection, const InspectionLook& look);

}  // namespace dmoscope::ui
