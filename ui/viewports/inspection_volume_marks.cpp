// The marks of a visit in a volume.
#include <algorithm>
#include <array>

#include "ui/viewports/inspection_marks.h"

namespace dmoscope::ui {
namespace {

using render::DotShape;

class SpacePen {
 public:
  SpacePen(render::SpaceMarks& marks, const Inspection& inspection, const InspectionLook& look)
      : marks_(marks), origin_(inspection.stood), look_(look) {}

  /// Points are relative to where the vertex stood.
  void line(Vec3 from, Vec3 to, float width) {
    casings_.push_back({origin_ + from, origin_ + to, width + 2.0F, look_.casing});
    inked_.push_back({origin_ + from, origin_ + to, width, look_.ink});
  }
  /// Of the star: behind all else, and faint.
  void ghost(Vec3 from, Vec3 to) {
    render::Rgba ink = look_.ink;
    ink.a = 110;
    marks_.lines.push_back({origin_ + from, origin_ + to, 1.4F, ink});
  }
  void box(const VolumeLevel& level, float width) {
    const auto corner = [&level](int bits) {
      const auto side = [bits](int bit) { return (bits >> bit & 1) != 0 ? 0.5 : -0.5; };
      return level.centre + Vec3{side(0) * level.size.x, side(1) * level.size.y, side(2) * level.size.z};
    };
    for (int bits = 0; bits < 8; ++bits)
      for (const int bit : {1, 2, 4})
        if ((bits & bit) == 0) line(corner(bits), corner(bits | bit), width);
  }
  void dot(Vec3 at, float diameter, render::Rgba colour, DotShape shape) { marks_.dots.push_back({origin_ + at, diameter, colour, shape}); }
  /// Inked lines go over all casings.
  void finish() {
    marks_.lines.insert(marks_.lines.end(), casings_.begin(), casings_.end());
    marks_.lines.insert(marks_.lines.end(), inked_.begin(), inked_.end());
  }
  [[nodiscard]] const InspectionLook& look() const { return look_; }

 private:
  render::SpaceMarks& marks_;
  std::vector<render::SpaceLine> casings_, inked_;
  Vec3 origin_;
  const InspectionLook& look_;
};

render::Rgba opaque_colour(render::Rgb colour) { return {colour.r, colour.g, colour.b, 255}; }

/// In pixels at scale 1. Other than in a plane all of a grid's slices lie over each other: dots are smaller, that more of them is seen.
double spacing_of(const VolumeLevel& level, const InspectionLook& look) {
  constexpr double kShare = 0.6;
  const double largest = std::max({level.size.x, level.size.y, level.size.z});
  return kShare * largest / std::max(1, level.points - 1) / look.units_per_pixel / look.scale;
}

/// Those of the slice that the maps show stand out.
void add_candidates(SpacePen& pen, const VolumeLevel& level, const GridSlice& slice) {
  const double spacing = spacing_of(level, pen.look());
  const auto valid = valid_range(level), invalid = invalid_range(level);
  constexpr double kLargestCross = 0.35;
  constexpr float kElsewhere = 0.62F;
  const auto count = static_cast<int>(level.quality.size());
  for (int index = 0; index < count; ++index) {
    const double quality = level.quality[static_cast<std::size_t>(index)];
    const float size = slice.place(index) ? 1.0F : kElsewhere;
    if (is_valid(quality)) {
      pen.dot(level.at(index), size * candidate_diameter(spacing, part_of(valid, quality)),
              opaque_colour(pen.look().colours.colour(quality)), DotShape::Round);
    } else {
      const double part = kLargestCross * part_of(invalid, quality);
      pen.dot(level.at(index), size * candidate_diameter(spacing, part), opaque_colour(kInvalidCandidate), DotShape::Cross);
    }
  }
}

void add_ring(SpacePen& pen, const VolumeLevel& level, int index) {
  pen.dot(level.at(index), candidate_diameter(spacing_of(level, pen.look()), 1.0) + 9.0F, pen.look().ink, DotShape::Ring);
}

}  // namespace

void add_inspection_marks(render::SpaceMarks& marks, const InspectionState& state, const Inspection& inspection,
                          const InspectionLook& look) {
  if (inspection.grid && inspection.trace) return add_surface_marks(marks, state, inspection, look);
  if (!inspection.solid) return;
  const VolumeTrace& trace = *inspection.solid;
  SpacePen pen(marks, inspection, look);
  const auto levels = static_cast<int>(trace.levels.size());
  const auto level = [&](int number) -> const VolumeLevel& { return trace.levels[static_cast<std::size_t>(number - 1)]; };
  if (!state.applied) {
    for (const auto& [a, b] : inspection.space_edges) pen.ghost(a, b);
  }
  const int first = std::max(1, state.all_levels ? 1 : state.level);
  const int last = std::min(levels, state.applied ? 0 : state.all_levels ? levels : state.level);
  Vec3 reached{};  // the best so far
  for (int number = first; number <= last; ++number) {
    pen.box(level(number), 2.0F);
    reached = level(number).best ? level(number).at(*level(number).best) : level(number).centre;
  }
  if (last >= 1 && last < levels) pen.box(level(last + 1), 1.0F);
  if (state.applied) reached = trace.step;
  if (!(reached == Vec3{})) pen.line({}, reached, 2.0F);
  pen.finish();
  for (int number = first; number <= last; ++number) add_candidates(pen, level(number), shown_slice(state, inspection, number));
  for (int number = first; number <= last; ++number) {
    if (level(number).best) add_ring(pen, level(number), *level(number).best);
  }
  if (state.hovered && state.hovered->level >= first && state.hovered->level <= last)
    add_ring(pen, level(state.hovered->level), state.hovered->index);
  if (state.applied) pen.dot({}, 7.0F, look.ink, DotShape::Ring);
}

}  // namespace dmoscope::ui
