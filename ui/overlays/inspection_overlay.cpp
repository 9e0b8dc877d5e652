#include <algorithm>
#include <array>

#include "ui/overlays/inspection_marks.h"
#include "ui/overlays/overlay.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

using render::DotShape;

render::Rgba opaque(render::Rgb colour) { return {colour.r, colour.g, colour.b, 255}; }

/// Draws marks at points relative to the vertex's place before the visit.
class Pen {
 public:
  Pen(render::Marks& marks, Vec3 origin, const InspectionLook& of_visit)
      : look(of_visit), marks_(marks), lines_(marks, {of_visit.ink, of_visit.casing}), origin_(origin) {}
  void line(Vec3 from, Vec3 to, float width) { lines_.add(origin_ + from, origin_ + to, width, width + 2.0F); }
  /// Draws an edge of a volume's star: behind everything else, and faint.
  void ghost(Vec3 from, Vec3 to) {
    render::Rgba ink = look.ink;
    ink.a = 110;
    marks_.lines.push_back({origin_ + from, origin_ + to, 1.4F, ink});
  }
  void dot(Vec3 at, float diameter, render::Rgba colour, DotShape shape) { marks_.dots.push_back({origin_ + at, diameter, colour, shape}); }
  void ring(Vec3 at, double spacing) { dot(at, candidate_diameter(spacing, 1.0) + 9.0F, look.ink, DotShape::Ring); }

  const InspectionLook& look;

 private:
  render::Marks& marks_;
  CasedLines lines_;
  Vec3 origin_;
};

/// The visit of a vertex, in a plane, in a volume or on a surface. Levels count from 1.
class Visit {
 public:
  explicit Visit(const Inspection& inspection) : inspection_(inspection) {}
  virtual ~Visit() = default;
  [[nodiscard]] int levels() const { return static_cast<int>(inspection_.level_count()); }
  [[nodiscard]] const LevelValues& level(int number) const { return inspection_.level(number); }
  /// Distance between candidates, in pixels at scale 1.
  [[nodiscard]] virtual double spacing(int number, const InspectionLook& look) const {
    return least_spacing(flat(number)) / look.units_per_pixel / look.scale;
  }
  [[nodiscard]] Vec3 at(int number, int index) const { return candidate_at(inspection_, number, index); }
  /// Place after a level that has no better candidate.
  [[nodiscard]] virtual Vec3 without_best(int number, Vec3 /*reached*/) const { return render::in_scene(flat(number).centre); }
  [[nodiscard]] virtual Vec3 step() const { return render::in_scene(inspection_.trace->step); }
  /// Draws the grid's outline.
  virtual void box(Pen& pen, int number, float width) const { outline(pen, number, width, render::in_scene); }
  /// Factor of the size in which a candidate is drawn.
  [[nodiscard]] virtual float size_of(int /*number*/, int /*index*/) const { return 1.0F; }
  /// Shape of the dot of a valid candidate.
  [[nodiscard]] virtual DotShape shape_of(int /*number*/, int /*index*/) const { return DotShape::Round; }

 protected:
  [[nodiscard]] const TracedLevel& flat(int number) const { return inspection_.trace->levels[static_cast<std::size_t>(number - 1)]; }
  template <class Lift>
  void outline(Pen& pen, int number, float width, const Lift& lift) const {
    const Vec2<double> c = flat(number).centre, h{flat(number).size.x / 2, flat(number).size.y / 2};
    const std::array<Vec2<double>, 4> corners{{c - h, {c.x + h.x, c.y - h.y}, c + h, {c.x - h.x, c.y + h.y}}};
    for (std::size_t k = 0; k < 4; ++k) pen.line(lift(corners[k]), lift(corners[(k + 1) % 4]), width);
  }
  const Inspection& inspection_;
};

class InVolume final : public Visit {
 public:
  InVolume(const Inspection& inspection, const InspectionState& state) : Visit(inspection), state_(state) {}
  /// Spacing for the size of dots: a grid's slices lie over each other, so dots are smaller than in a plane, and more of them can be seen.
  [[nodiscard]] double spacing(int number, const InspectionLook& look) const override {
    constexpr double kShare = 0.6;
    const VolumeLevel& one = solid(number);
    const double largest = std::max({one.size.x, one.size.y, one.size.z});
    return kShare * largest / std::max(1, one.points - 1) / look.units_per_pixel / look.scale;
  }
  [[nodiscard]] Vec3 without_best(int number, Vec3 /*reached*/) const override { return solid(number).centre; }
  [[nodiscard]] Vec3 step() const override { return inspection_.solid->step; }
  void box(Pen& pen, int number, float width) const override {
    const auto corner = [&one = solid(number)](int bits) {
      const auto side = [bits](int bit) { return (bits >> bit & 1) != 0 ? 0.5 : -0.5; };
      return one.centre + Vec3{side(0) * one.size.x, side(1) * one.size.y, side(2) * one.size.z};
    };
    for (int bits = 0; bits < 8; ++bits)
      for (const int bit : {1, 2, 4})
        if ((bits & bit) == 0) pen.line(corner(bits), corner(bits | bit), width);
  }
  /// Factor that makes candidates of the slice in the maps stand out.
  [[nodiscard]] float size_of(int number, int index) const override {
    constexpr float kElsewhere = 0.62F;
    return shown_slice(state_, inspection_, number).place(index) ? 1.0F : kElsewhere;
  }

 private:
  [[nodiscard]] const VolumeLevel& solid(int number) const { return inspection_.solid->levels[static_cast<std::size_t>(number - 1)]; }
  const InspectionState& state_;
};

/// Visit of a vertex on a surface. Candidates lie on it; crosses mark those that do not count, squares those that deviate too far.
class OnSurface final : public Visit {
 public:
  using Visit::Visit;
  [[nodiscard]] Vec3 without_best(int /*number*/, Vec3 reached) const override { return reached; }
  [[nodiscard]] Vec3 step() const override { return inspection_.trace->to - inspection_.trace->from; }
  void box(Pen& pen, int number, float width) const override {  // in the tangent plane
    outline(pen, number, width, [&](Vec2<double> p) { return inspection_.grid->plane.lift(p); });
  }
  [[nodiscard]] DotShape shape_of(int number, int index) const override {
    return inspection_.refuses(number, index) ? DotShape::Square : DotShape::Round;
  }
};

/// Draws dots for valid candidates, the larger the better, and small crosses for others.
void draw_candidates(Pen& pen, const Visit& visit, int number) {
  const LevelValues& level = visit.level(number);
  const auto valid = valid_range(level), invalid = invalid_range(level);
  constexpr double kLargestCross = 0.35;
  const double spacing = visit.spacing(number, pen.look);
  for (int index = 0; index < static_cast<int>(level.quality.size()); ++index) {
    const double quality = level.quality[static_cast<std::size_t>(index)];
    const bool good = is_valid(quality);
    const double part = good ? part_of(valid, quality) : kLargestCross * part_of(invalid, quality);
    pen.dot(visit.at(number, index), visit.size_of(number, index) * candidate_diameter(spacing, part),
            opaque(good ? pen.look.colours.colour(quality) : kInvalidCandidate), good ? visit.shape_of(number, index) : DotShape::Cross);
  }
}

void draw_visit(render::Marks& marks, Vec3 origin, const InspectionState& state, const InspectionLook& look, const Visit& visit,
                const Inspection& inspection) {
  const int levels = visit.levels();
  const int first = std::max(1, state.all_levels ? 1 : state.level);
  const int last = std::min(levels, state.applied ? 0 : state.all_levels ? levels : state.level);
  {
    Pen pen(marks, origin, look);
    if (!state.applied) {
      for (const auto& [a, b] : inspection.edges) inspection.solid ? pen.ghost(a, b) : pen.line(a, b, 1.6F);
    }
    Vec3 reached{};  // best place so far
    for (int number = first; number <= last; ++number) {
      visit.box(pen, number, 2.0F);
      const auto& best = visit.level(number).best;
      reached = best ? visit.at(number, *best) : visit.without_best(number, reached);
    }
    if (last >= 1 && last < levels) visit.box(pen, last + 1, 1.0F);
    if (state.applied) reached = visit.step();
    if (!(reached == Vec3{})) pen.line({}, reached, 2.0F);
  }
  Pen pen(marks, origin, look);
  for (int number = first; number <= last; ++number) draw_candidates(pen, visit, number);
  for (int number = first; number <= last; ++number)
    if (const auto& best = visit.level(number).best) pen.ring(visit.at(number, *best), visit.spacing(number, look));
  if (const auto& hovered = state.hovered; hovered && hovered->level >= first && hovered->level <= last)
    pen.ring(visit.at(hovered->level, hovered->index), visit.spacing(hovered->level, look));
  if (state.applied) pen.dot({}, 7.0F, look.ink, DotShape::Ring);
}

class InspectionOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.inspecting; }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const InspectionLook look = inspection_look(in.state, in.scenery->derived, view.view.units_per_pixel());
    add_inspection_marks(marks, in.state.inspection, in.scenery->inspection, look);
  }
};

}  // namespace

InspectionLook inspection_look(const ViewState& state, const Derived& derived, double units_per_pixel) {
  const render::Style style = scene_style(state);
  return {colour_scale(state, derived),        style.highlight_colour, style.casing_colour,
          opaque(palette(state.theme).accent), units_per_pixel,        state.scale};
}

float candidate_diameter(double spacing, double part) {
  const double largest = std::clamp(0.72 * spacing, 2.0, 15.0);
  return static_cast<float>(largest * (0.42 + 0.58 * part));
}

Vec3 candidate_at(const Inspection& inspection, int level, int index) {
  const auto slot = static_cast<std::size_t>(level - 1);
  if (inspection.solid) return inspection.solid->levels[slot].at(index);
  if (inspection.grid) return inspection.grid->levels[slot].places[static_cast<std::size_t>(index)];
  return render::in_scene(inspection.trace->levels[slot].at(index));
}

void add_inspection_marks(render::Marks& marks, const InspectionState& state, const Inspection& inspection, const InspectionLook& look) {
  if (inspection.visit() == nullptr) return;
  const Vec3 origin = inspection.origin;
  if (inspection.solid) {
    draw_visit(marks, origin, state, look, InVolume(inspection, state), inspection);
  } else if (inspection.grid) {
    draw_visit(marks, origin, state, look, OnSurface(inspection), inspection);
  } else {
    draw_visit(marks, origin, state, look, Visit(inspection), inspection);
  }
  const bool at_end = state.applied || state.all_levels || state.level == static_cast<int>(inspection.level_count());
  if (inspection.optimum && at_end)
    marks.dots.push_back({origin + render::in_scene(inspection.optimum->at), 9.0F, look.accent, DotShape::Diamond});
}

OverlayPointer inspection_overlay() { return std::make_unique<InspectionOverlay>(); }

}  // namespace dmoscope::ui
