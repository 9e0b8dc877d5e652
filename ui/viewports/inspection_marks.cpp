#include "ui/viewports/inspection_marks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmoscope::ui {
namespace {

using render::DotShape;

class Pen {
 public:
  Pen(render::Marks& marks, const Inspection& inspection, const InspectionLook& look)
      : marks_(marks), origin_(inspection.origin), look_(look) {}

  /// Points are relative to where the vertex stood.
  void line(Vec2<double> from, Vec2<double> to, float width) {
    marks_.lines.push_back({origin_ + from, origin_ + to, width + 2.0F, look_.casing});
    inked_.push_back({origin_ + from, origin_ + to, width, look_.ink});
  }
  void box(const TracedLevel& level, float width) {
    const Vec2<double> c = level.centre, h{level.size.x / 2, level.size.y / 2};
    const std::array<Vec2<double>, 4> corners{{c - h, {c.x + h.x, c.y - h.y}, c + h, {c.x - h.x, c.y + h.y}}};
    for (std::size_t k = 0; k < 4; ++k) line(corners[k], corners[(k + 1) % 4], width);
  }
  void dot(Vec2<double> at, float diameter, render::Rgba colour, DotShape shape) {
    marks_.dots.push_back({origin_ + at, diameter, colour, shape});
  }
  /// Inked lines go over all casings.
  void finish() {
    marks_.lines.insert(marks_.lines.end(), inked_.begin(), inked_.end());
    inked_.clear();
  }
  [[nodiscard]] const InspectionLook& look() const { return look_; }

 private:
  render::Marks& marks_;
  std::vector<render::OverlayLine> inked_;
  Vec2<double> origin_;
  const InspectionLook& look_;
};

/// In pixels at scale 1.
double spacing_of(const TracedLevel& level, const InspectionLook& look) { return least_spacing(level) / look.units_per_pixel / look.scale; }

render::Rgba opaque(render::Rgb colour) { return {colour.r, colour.g, colour.b, 255}; }

void add_candidates(Pen& pen, const TracedLevel& level) {
  const double spacing = spacing_of(level, pen.look());
  const auto valid = valid_range(level), invalid = invalid_range(level);
  constexpr double kLargestCross = 0.35;
  for (int index = 0; index < level.points * level.points; ++index) {
    const double quality = level.quality[static_cast<std::size_t>(index)];
    if (is_valid(quality)) {
      pen.dot(level.at(index), candidate_diameter(spacing, part_of(valid, quality)), opaque(pen.look().colours.colour(quality)),
              DotShape::Round);
    } else {
      const double part = kLargestCross * part_of(invalid, quality);
      pen.dot(level.at(index), candidate_diameter(spacing, part), opaque(kInvalidCandidate), DotShape::Cross);
    }
  }
}

void add_ring(Pen& pen, const TracedLevel& level, int index) {
  pen.dot(level.at(index), candidate_diameter(spacing_of(level, pen.look()), 1.0) + 9.0F, pen.look().ink, DotShape::Ring);
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
  const VisitTrace& trace = *inspection.trace;
  Pen pen(marks, inspection, look);
  const auto levels = static_cast<int>(trace.levels.size());
  const auto level = [&](int number) -> const TracedLevel& { return trace.levels[static_cast<std::size_t>(number - 1)]; };
  if (!state.applied) {
    for (const auto& [a, b] : inspection.edges) pen.line(a, b, 1.6F);
  }
  const int first = state.all_levels ? 1 : state.level, last = state.applied ? 0 : state.all_levels ? levels : state.level;
  Vec2<double> reached{};  // the best so far
  for (int number = std::max(1, first); number <= std::min(last, levels); ++number) {
    pen.box(level(number), 2.0F);
    reached = level(number).best ? level(number).at(*level(number).best) : level(number).centre;
  }
  if (last >= 1 && last < levels) pen.box(level(last + 1), 1.0F);
  if (state.applied) reached = trace.step;
  if (reached.x != 0.0 || reached.y != 0.0) pen.line({}, reached, 2.0F);
  pen.finish();
  for (int number = std::max(1, first); number <= std::min(last, levels); ++number) add_candidates(pen, level(number));
  for (int number = std::max(1, first); number <= std::min(last, levels); ++number) {
    if (level(number).best) add_ring(pen, level(number), *level(number).best);
  }
  if (state.hovered && state.hovered->level >= std::max(1, first) && state.hovered->level <= std::min(last, levels))
    add_ring(pen, level(state.hovered->level), state.hovered->index);
  if (state.applied) pen.dot({}, 7.0F, look.ink, DotShape::Ring);
  if (inspection.optimum && (state.applied || last == levels)) pen.dot(inspection.optimum->at, 9.0F, look.accent, DotShape::Diamond);
}

}  // namespace dmoscope::ui
