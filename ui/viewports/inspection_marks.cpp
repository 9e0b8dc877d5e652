#include "ui/viewports/inspection_marks.h"

#include <algorithm>
#include <array>

#include "ui/viewports/cased_lines.h"

namespace dmoscope::ui {
namespace {

using render::DotShape;

render::Rgba opaque(render::Rgb colour) { return {colour.r, colour.g, colour.b, 255}; }

/// Points are relative to where the vertex stood.
template <class Marks, class Point>
class Pen {
 public:
  Pen(Marks& marks, Point origin, const InspectionLook& of_visit)
      : look(of_visit), marks_(marks), lines_(marks, of_visit.ink, of_visit.casing), origin_(origin) {}
  void line(Point from, Point to, float width) { lines_.add(origin_ + from, origin_ + to, width, width + 2.0F); }
  /// Of the star of a volume: behind all else, and faint.
  void ghost(Point from, Point to) {
    render::Rgba ink = look.ink;
    ink.a = 110;
    marks_.lines.push_back({origin_ + from, origin_ + to, 1.4F, ink});
  }
  void dot(Point at, float diameter, render::Rgba colour, DotShape shape) {
    marks_.dots.push_back({origin_ + at, diameter, colour, shape});
  }
  void ring(Point at, double spacing) { dot(at, candidate_diameter(spacing, 1.0) + 9.0F, look.ink, DotShape::Ring); }

  const InspectionLook& look;

 private:
  Marks& marks_;
  CasedLines<Marks> lines_;
  Point origin_;
};

/// The grid's outline in its plane.
std::array<Vec2<double>, 4> corners_of(const TracedLevel& level) {
  const Vec2<double> c = level.centre, h{level.size.x / 2, level.size.y / 2};
  return {{c - h, {c.x + h.x, c.y - h.y}, c + h, {c.x - h.x, c.y + h.y}}};
}

/// Dots for valid candidates, the larger the better; small crosses for others. `size_of(index)`: a factor.
template <class Pen, class Level, class SizeOf>
void draw_candidates(Pen& pen, const Level& level, double spacing, SizeOf size_of) {
  const auto valid = valid_range(level), invalid = invalid_range(level);
  constexpr double kLargestCross = 0.35;
  for (int index = 0; index < static_cast<int>(level.quality.size()); ++index) {
    const double quality = level.quality[static_cast<std::size_t>(index)];
    const bool good = is_valid(quality);
    const double part = good ? part_of(valid, quality) : kLargestCross * part_of(invalid, quality);
    pen.dot(level.at(index), size_of(index) * candidate_diameter(spacing, part),
            opaque(good ? pen.look.colours.colour(quality) : kInvalidCandidate), good ? DotShape::Round : DotShape::Cross);
  }
}

// A visit in a plane, in a volume and on a surface: what draw_visit() asks of each. Levels count from 1.

struct InPlane {
  const VisitTrace& trace;
  const TracedLevel& level(int number) const { return trace.levels[static_cast<std::size_t>(number - 1)]; }
  double spacing(int number, const InspectionLook& look) const {  // pixels at scale 1
    return least_spacing(level(number)) / look.units_per_pixel / look.scale;
  }
  Vec2<double> at(int number, int index) const { return level(number).at(index); }
  Vec2<double> without_best(int number, Vec2<double> /*reached*/) const { return level(number).centre; }
  Vec2<double> step() const { return trace.step; }
  template <class Pen>
  void box(Pen& pen, int number, float width) const {
    const auto corners = corners_of(level(number));
    for (std::size_t k = 0; k < 4; ++k) pen.line(corners[k], corners[(k + 1) % 4], width);
  }
  template <class Pen>
  void candidates(Pen& pen, int number) const {
    draw_candidates(pen, level(number), spacing(number, pen.look), [](int) { return 1.0F; });
  }
};

struct InVolume {
  const VolumeTrace& trace;
  const InspectionState& state;
  const Inspection& inspection;
  const VolumeLevel& level(int number) const { return trace.levels[static_cast<std::size_t>(number - 1)]; }
  /// Other than in a plane all of a grid's slices lie over each other: dots are smaller, that more of them is seen.
  double spacing(int number, const InspectionLook& look) const {
    constexpr double kShare = 0.6;
    const VolumeLevel& one = level(number);
    const double largest = std::max({one.size.x, one.size.y, one.size.z});
    return kShare * largest / std::max(1, one.points - 1) / look.units_per_pixel / look.scale;
  }
  Vec3 at(int number, int index) const { return level(number).at(index); }
  Vec3 without_best(int number, Vec3 /*reached*/) const { return level(number).centre; }
  Vec3 step() const { return trace.step; }
  template <class Pen>
  void box(Pen& pen, int number, float width) const {
    const auto corner = [&one = level(number)](int bits) {
      const auto side = [bits](int bit) { return (bits >> bit & 1) != 0 ? 0.5 : -0.5; };
      return one.centre + Vec3{side(0) * one.size.x, side(1) * one.size.y, side(2) * one.size.z};
    };
    for (int bits = 0; bits < 8; ++bits)
      for (const int bit : {1, 2, 4})
        if ((bits & bit) == 0) pen.line(corner(bits), corner(bits | bit), width);
  }
  /// Those of the slice that the maps show stand out.
  template <class Pen>
  void candidates(Pen& pen, int number) const {
    constexpr float kElsewhere = 0.62F;
    const GridSlice slice = shown_slice(state, inspection, number);
    draw_candidates(pen, level(number), spacing(number, pen.look), [&](int index) { return slice.place(index) ? 1.0F : kElsewhere; });
  }
};

/// Candidates lie on the surface; crosses lie on none that counts, squares deviate too far.
struct OnSurface : InPlane {
  const SurfaceGrid& grid;
  const SurfaceGrid::Level& places(int number) const { return grid.levels[static_cast<std::size_t>(number - 1)]; }
  Vec3 at(int number, int index) const { return places(number).places[static_cast<std::size_t>(index)]; }
  Vec3 without_best(int /*number*/, Vec3 reached) const { return reached; }
  Vec3 step() const { return trace.to - trace.from; }
  template <class Pen>
  void box(Pen& pen, int number, float width) const {  // in the tangent plane
    const auto corners = corners_of(level(number));
    for (std::size_t k = 0; k < 4; ++k) pen.line(grid.plane.lift(corners[k]), grid.plane.lift(corners[(k + 1) % 4]), width);
  }
  template <class Pen>
  void candidates(Pen& pen, int number) const {
    const auto valid = valid_range(level(number));
    for (std::size_t i = 0; i < places(number).places.size(); ++i) {
      const double quality = level(number).quality[i];
      const bool good = is_valid(quality), counts = places(number).fates[i] == CandidateFate::Counts;
      pen.dot(places(number).places[i], candidate_diameter(spacing(number, pen.look), good ? part_of(valid, quality) : 0.0),
              opaque(good ? pen.look.colours.colour(quality) : kInvalidCandidate),
              !good    ? DotShape::Cross
              : counts ? DotShape::Round
                       : DotShape::Square);
    }
  }
};

template <class Marks, class Point, class Visit>
void draw_visit(Marks& marks, Point origin, const InspectionState& state, const InspectionLook& look, const Visit& visit,
                std::span<const std::array<Point, 2>> edges = {}, std::span<const std::array<Point, 2>> ghosts = {}) {
  const auto levels = static_cast<int>(visit.trace.levels.size());
  const int first = std::max(1, state.all_levels ? 1 : state.level);
  const int last = std::min(levels, state.applied ? 0 : state.all_levels ? levels : state.level);
  {
    Pen<Marks, Point> pen(marks, origin, look);
    for (const auto& [a, b] : edges) pen.line(a, b, 1.6F);
    for (const auto& [a, b] : ghosts) pen.ghost(a, b);
    Point reached{};  // the best so far
    for (int number = first; number <= last; ++number) {
      visit.box(pen, number, 2.0F);
      const auto& best = visit.level(number).best;
      reached = best ? visit.at(number, *best) : visit.without_best(number, reached);
    }
    if (last >= 1 && last < levels) visit.box(pen, last + 1, 1.0F);
    if (state.applied) reached = visit.step();
    if (!(reached == Point{})) pen.line({}, reached, 2.0F);
  }
  Pen<Marks, Point> pen(marks, origin, look);
  for (int number = first; number <= last; ++number) visit.candidates(pen, number);
  for (int number = first; number <= last; ++number)
    if (const auto& best = visit.level(number).best) pen.ring(visit.at(number, *best), visit.spacing(number, look));
  if (const auto& hovered = state.hovered; hovered && hovered->level >= first && hovered->level <= last)
    pen.ring(visit.at(hovered->level, hovered->index), visit.spacing(hovered->level, look));
  if (state.applied) pen.dot({}, 7.0F, look.ink, DotShape::Ring);
}

}  // namespace

InspectionLook inspection_look(const render::Style& style, render::Rgb accent, double units_per_pixel, double scale) {
  return {style.colours, style.highlight_colour, style.casing_colour, opaque(accent), units_per_pixel, scale};
}

float candidate_diameter(double spacing, double part) {
  const double largest = std::clamp(0.72 * spacing, 2.0, 15.0);
  return static_cast<float>(largest * (0.42 + 0.58 * part));
}

void add_inspection_marks(render::Marks& marks, const InspectionState& state, const Inspection& inspection, const InspectionLook& look) {
  if (!inspection.trace) return;
  std::span<const std::array<Vec2<double>, 2>> star = inspection.edges;
  if (state.applied) star = {};
  draw_visit(marks, inspection.origin, state, look, InPlane{*inspection.trace}, star);
  const bool at_end = state.applied || state.all_levels || state.level == static_cast<int>(inspection.trace->levels.size());
  if (inspection.optimum && at_end)
    marks.dots.push_back({inspection.origin + inspection.optimum->at, 9.0F, look.accent, DotShape::Diamond});
}

void add_inspection_marks(render::SpaceMarks& marks, const InspectionState& state, const Inspection& inspection,
                          const InspectionLook& look) {
  if (inspection.grid && inspection.trace)
    return draw_visit(marks, inspection.stood, state, look, OnSurface{{*inspection.trace}, *inspection.grid});
  if (!inspection.solid) return;
  std::span<const std::array<Vec3, 2>> star = inspection.space_edges;
  if (state.applied) star = {};
  draw_visit(marks, inspection.stood, state, look, InVolume{*inspection.solid, state, inspection}, {}, star);
}

}  // namespace dmoscope::ui
