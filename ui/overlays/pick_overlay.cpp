// Marks of the picked, selected and worst elements and vertices, and of points that a person has set.
#include <algorithm>

#include <fmt/format.h>

#include "ui/commands/size_point.h"
#include "ui/overlays/moves.h"
#include "ui/overlays/overlay.h"
#include "ui/state/format.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

class PickedOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.picked().kind != Picked::Kind::None; }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    marks.elements = picked_elements(in);
    if (in.picked().kind == Picked::Kind::Vertex) marks.vertices = {in.picked().id};
    const auto& inside = in.scenery->derived.facts.inverted_inside;
    if (inside && in.picked().kind == Picked::Kind::Element && !in.searching)
      add_diamond(marks, view.points.at(*inside), 12.0F, scene_style(in.state));
  }
};

class WorstOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override { return in.marks_worst(); }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    marks.worst = in.frame().worst.front().element;
    marks.worst_behind = !in.scene->shows_element(in.camera, view.view.viewport(), *marks.worst);
    add_inverted_inside(marks, view, in.frame(), scene_style(in.state));
  }
};

class SelectionOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    const Selection selection = shown(in.state);
    return !selection.empty() && selection.vertices().back() < in.frame().vertex_count() && in.is_active_mesh();
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    const auto selection = shown(in.state);
    if (view.points.plane) {
      add_dots(marks, view, in.input(), in.frame().positions, selection.vertices(), solid(palette(in.state.theme).text), 8.0);
    } else if (selection.vertices().size() <= kMostMarks) {  // nothing hides them; they are faint where elements were taken away
      marks.vertices.insert(marks.vertices.end(), selection.vertices().begin(), selection.vertices().end());
    }
  }
  [[nodiscard]] bool needs_unhidden() const override { return false; }
  [[nodiscard]] std::string note(const OverlayInput& in) const override {
    std::string text;
    const auto add = [&text](const std::string& part) { text += text.empty() ? part : " · " + part; };
    if (!in.state.selection.empty()) add(fmt::format("{} selected", count(in.state.selection.vertices().size())));
    if (in.state.brush.on && !in.state.in_space) add("brush");
    return text;
  }

 private:
  static Selection shown(const ViewState& state) {
    return state.brush.painting ? after_stroke(state.selection, state.brush) : state.selection;
  }
};

/// Marks the point of the run's size function with a diamond.
class SizePointOverlay final : public Overlay {
 public:
  [[nodiscard]] bool wanted(const OverlayInput& in) const override {
    return !in.input().in_space() && in.run() != nullptr && size_point_of(*in.run()) != nullptr;
  }
  void make(const OverlayInput& in, const MarkView& view, render::Marks& marks) override {
    add_diamond(marks, view.points.at(on_map(in.input().mesh, *size_point_of(*in.run()))), 12.0F, scene_style(in.state));
  }
};

}  // namespace

std::vector<Index> picked_elements(const OverlayInput& in) {
  const Picked picked = in.picked();
  if (picked.kind == Picked::Kind::Element && picked.id < in.frame().element_count()) return {picked.id};
  std::vector<Index> elements;
  if (picked.kind == Picked::Kind::Vertex && picked.id < in.frame().vertex_count() && !in.searching)
    for (const Incidence& incidence : in.input().topology.star(picked.id)) elements.push_back(incidence.element);
  return elements;
}

void add_diamond(render::Marks& marks, Vec3 at, float diameter, const render::Style& style) {
  marks.dots.push_back({at, diameter + 5.0F, style.casing_colour, render::DotShape::Diamond});
  marks.dots.push_back({at, diameter, style.highlight_colour, render::DotShape::Diamond});
}

void add_inverted_inside(render::Marks& marks, const MarkView& view, const Frame& frame, const render::Style& style) {
  for (const RankedElement& ranked : frame.worst)
    if (ranked.inside) add_diamond(marks, view.points.at(*ranked.inside), 8.0F, style);
}

OverlayPointer picked_overlay() { return std::make_unique<PickedOverlay>(); }
OverlayPointer worst_overlay() { return std::make_unique<WorstOverlay>(); }
OverlayPointer selection_overlay() { return std::make_unique<SelectionOverlay>(); }
OverlayPointer size_point_overlay() { return std::make_unique<SizePointOverlay>(); }

}  // namespace dmoscope::ui
