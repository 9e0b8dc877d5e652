// The marks of a visit on a surface.
#include <algorithm>
#include <array>

#include "ui/viewports/inspection_marks.h"

namespace dmoscope::ui {
namespace {

using render::DotShape;

class SurfacePen {
 public:
  SurfacePen(render::SpaceMarks& marks, const Inspection& inspection, const InspectionLook& look)
      : marks_(marks), inspection_(inspection), look_(look) {}

  /// Points are relative to where the vertex stood.
  void line(Vec3 from, Vec3 to, float width) {
    const Vec3 origin = inspection_.stood;
    marks_.lines.push_back({origin + from, origin + to, width + 2.0F, look_.casing});
    inked_.push_back({origin + from, origin + to, width, look_.ink});
  }
  /// In the tangent plane.
  void box(const TracedLevel& level, float width) {
    const Vec2<double> c = level.centre, h{level.size.x / 2, level.size.y / 2};
    const std::array<Vec2<double>, 4> corners{{c - h, {c.x + h.x, c.y - h.y}, c + h, {c.x - h.x, c.y + h.y}}};
    const Plane& plane = inspection_.grid->plane;
    for (std::size_t k = 0; k < 4; ++k) line(plane.lift(corners[k]), plane.lift(corners[(k + 1) % 4]), width);
  }
  void dot(Vec3 at, float diameter, render::Rgba colour, DotShape shape) {
    marks_.dots.push_back({inspection_.stood + at, diameter, colour, shape});
  }
  /// Inked lines go over all casings.
  void finish() { marks_.lines.insert(marks_.lines.end(), inked_.begin(), inked_.end()); }

 private:
  render::SpaceMarks& marks_;
  std::vector<render::SpaceLine> inked_;
  const Inspection& inspection_;
  const InspectionLook& look_;
};

}  // namespace

void add_surface_marks(render::SpaceMarks& marks, const InspectionState& state, const Inspection& inspection, const InspectionLook& look) {
  const VisitTrace& trace = *inspection.trace;
  const SurfaceGrid& grid = *inspection.grid;
  const auto levels = static_cast<int>(trace.levels.size());
  const int first = std::max(1, state.all_levels ? 1 : state.level);
  const int last = std::min(levels, state.applied ? 0 : state.all_levels ? levels : state.level);
  const auto level = [&](int number) -> const TracedLevel& { return trace.levels[static_cast<std::size_t>(number - 1)]; };
  const auto places = [&](int number) -> const SurfaceGrid::Level& { return grid.levels[static_cast<std::size_t>(number - 1)]; };
  const auto spacing = [&](int number) { return least_spacing(level(number)) / look.units_per_pixel / look.scale; };
  SurfacePen pen(marks, inspection, look);
  Vec3 reached{};  // the best so far
  for (int number = first; number <= last; ++number) {
    pen.box(level(number), 2.0F);
    if (level(number).best) reached = places(number).places[static_cast<std::size_t>(*level(number).best)];
  }
  if (last >= 1 && last < levels) pen.box(level(last + 1), 1.0F);
  if (state.applied) reached = trace.to - trace.from;
  if (!(reached == Vec3{})) pen.line({}, reached, 2.0F);
  pen.finish();
  for (int number = first; number <= last; ++number) {
    const auto valid = valid_range(level(number));
    for (std::size_t i = 0; i < places(number).places.size(); ++i) {
      const CandidateFate fate = places(number).fates[i];
      const double quality = level(number).quality[i];
      const bool good = is_valid(quality);
      const auto ring = look.colours.colour(quality);
      const render::Rgba ink = good ? render::Rgba{ring.r, ring.g, ring.b, 255}
                                    : render::Rgba{kInvalidCandidate.r, kInvalidCandidate.g, kInvalidCandidate.b, 255};
      const DotShape shape = !good ? DotShape::Cross : fate == CandidateFate::Counts ? DotShape::Round : DotShape::Square;
      pen.dot(places(number).places[i], candidate_diameter(spacing(number), good ? part_of(valid, quality) : 0.0), ink, shape);
    }
  }
  const auto ring = [&](int number, int index) {
    pen.dot(places(number).places[static_cast<std::size_t>(index)], candidate_diameter(spacing(number), 1.0) + 9.0F, look.ink,
            DotShape::Ring);
  };
  for (int number = first; number <= last; ++number)
    if (level(number).best) ring(number, *level(number).best);
  if (state.hovered && state.hovered->level >= first && state.hovered->level <= last) ring(state.hovered->level, state.hovered->index);
  if (state.applied) pen.dot({}, 7.0F, look.ink, DotShape::Ring);
}

}  // namespace dmoscope::ui
