#include "ui/viewports/pane_view.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/commands/size_point.h"
#include "ui/toolkit/theme.h"
#include "ui/viewports/inspection_marks.h"
#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {

namespace {

/// A search in a volume is looked into: its marks are to be seen.
bool is_searching(const Scenery& scenery, bool inspected) {
  return inspected && scenery.state.inspection.open && scenery.inspection.solid && !scenery.state.inspection.applied;
}

/// No cell at all, but faintly the boundary of all of them.
ClippingView ghost_alone() {
  ClippingView view;
  view.isolate = {4.0F, 5.0F};  // no metric is
  view.ghost = true;
  return view;
}

}  // namespace

render::Style picture_style(const ViewState& state, const Derived& derived) {
  render::Style style = scene_style(state);
  style.colours = shown_scale(state, derived);
  return style;
}

void PaneView::update_colours(const ViewState& state, std::shared_ptr<const Frame> reference, const PaneView* like) {
  if (like != nullptr && !needs_positions(state.colouring.by) && state.colouring.by != ColourBy::Class) {
    worker_.update(state, {}, nullptr);  // what it worked at before nobody waits for
    colours_ = like->colours_;
    return;
  }
  worker_.update(state, *session_, std::move(reference));
  colours_ = worker_.colours();
  // Around its vertices a volume has no colours of its own: quality is shown, and said.
  if (in_space() && colours_ && (!colours_->shading || colours_->shading->by != render::Shading::By::Elements)) colours_.reset();
}

void PaneView::update_stepping(bool busy) { stepping_.update(*session_, busy); }

bool PaneView::bring(render::Loading loading) {
  if (in_space()) {
    if (!volume_) {
      volume_ = std::make_unique<render::VolumeScene>();
      picture_.forget();
    }
    planar_.show(nullptr);
    volume_->set_pool(pool_);
    volume_->show(session_->frame);
    return current_ = true;
  }
  volume_.reset();
  current_ = planar_.show(session_->frame, loading);
  return current_;
}

render::Camera PaneView::seen_from(const ViewState& state, const render::Camera2D& camera) const {
  if (in_space()) return state.orbit;
  return camera;
}

render::Pick PaneView::pick(const ViewState& state, const render::Camera2D& camera, Vec2<double> pixel, double radius) const {
  return scene().pick(seen_from(state, camera), state.viewport, pixel, radius);
}

bool PaneView::is_active_mesh(const Scenery& scenery) const {
  const Mesh& mesh = frame()->input->mesh;
  return frame()->input.get() == scenery.active ||
         (scenery.active != nullptr && scenery.active->mesh.vertex_count() == mesh.vertex_count() &&
          scenery.active->mesh.elements.size() == mesh.elements.size());
}

/// Nothing on another mesh than the one that the pick is of.
Picked PaneView::picked_here(const Scenery& scenery) const { return is_active_mesh(scenery) ? scenery.state.picked : Picked{}; }

bool PaneView::marks_worst(const ViewState& state, bool inspecting) const {
  return state.worst_marker && !frame()->worst.empty() && !inspecting;
}

/// The one shown, where it has targets or nothing else can have them; else that of the run.
Metric PaneView::metric_of_targets() const {
  const Metric shown = frame()->shown;
  return !is_built_in(shown) || frame()->run == Frame::kNoRun ? shown : session_->runs[session_->active].parameters.metric;
}

render::SpaceMarks PaneView::space_marks(const Scenery& scenery, Vec2<double> viewport, bool inspected) {
  const ViewState& state = scenery.state;
  render::SpaceMarks marks;
  const bool inspecting = inspected && state.inspection.open, searching = is_searching(scenery, inspected);
  marks.faint_where_taken_away = !searching;  // all cells give way to the search, and what it is of stays plain
  const Picked picked = picked_here(scenery);
  if (picked.kind == Picked::Kind::Element && picked.id < frame()->element_count()) marks.cells = {picked.id};
  if (picked.kind == Picked::Kind::Vertex && picked.id < frame()->vertex_count()) {
    for (const Incidence& incidence : searching ? std::span<const Incidence>{} : frame()->input->topology.star(picked.id))
      marks.cells.push_back(incidence.element);
    marks.vertices = {picked.id};
  }
  constexpr std::size_t kMostDots = 20'000;  // more of them cover the mesh
  if (is_active_mesh(scenery) && !state.selection.empty() && state.selection.vertices().size() <= kMostDots)
    for (const Index v : state.selection.vertices())
      if (v < frame()->vertex_count()) marks.vertices.push_back(v);
  if (marks_worst(state, inspecting)) {
    marks.worst = frame()->worst.front().element;
    marks.worst_behind = !volume_->shows_cell(state.orbit, viewport, *marks.worst);
    add_inverted_inside(marks, *frame(), scene_style(state));
  }
  if (inspecting) {
    render::Style of_quality = scene_style(state);
    of_quality.colours = colour_scale(state, scenery.derived);  // of candidates, whatever the cells show
    const double units = state.orbit.units_per_pixel(viewport);
    add_inspection_marks(marks, state.inspection, scenery.inspection,
                         inspection_look(of_quality, palette(state.theme).accent, units, state.scale));
  }
  if (const auto& inside = scenery.derived.facts.inverted_inside; inside && picked.kind == Picked::Kind::Element && !searching) {
    const render::Style style = scene_style(state);
    add_diamond(marks, *inside, 12.0F, style.highlight_colour, style);
  }
  if (!searching && !marks.cells.empty() && picked.kind == Picked::Kind::Element)
    add_space_target(marks, *frame(), metric_of_targets(), picked.id);
  if (!searching) stepping_.add_space_marks(marks, state, *session_, *volume_, viewport);
  return marks;
}

std::string PaneView::note(const ViewState& state) const {
  std::string text = stepping_.note(state, *session_);
  if (!in_space() || !volume_ || state.inspection.open) return text;
  const render::VolumeScene& scene = *volume_;
  std::string faint;
  const auto add = [&faint](const std::string& what) { faint += (faint.empty() ? "" : " and ") + what; };
  if (marks_worst(state, false) && !scene.shows_cell(state.orbit, state.viewport, frame()->worst.front().element)) add("the worst element");
  const Picked& picked = state.picked;
  if (picked.kind == Picked::Kind::Element && !scene.sees_cell(picked.id)) add(fmt::format("element {}", picked.id));
  if (picked.kind == Picked::Kind::Vertex && !scene.sees_vertex(picked.id)) add(fmt::format("vertex {}", picked.id));
  if (faint.empty()) return text;
  return "hidden, so marked faintly: " + faint + (text.empty() ? "" : " · ") + text;
}

void PaneView::update_volume(const Scenery& scenery, const Wish& wish) {
  const ViewState& state = scenery.state;
  render::VolumeScene& scene = *volume_;
  const bool by_elements = colours_ && colours_->shading && colours_->shading->by == render::Shading::By::Elements;
  scene.set_shading(by_elements ? colours_->shading : nullptr);
  // What is isolated of the histogram is taken out of the volume; what is merely chosen keeps its place, and the rest fades.
  render::Selection selection = selection_of(state, scenery.derived);
  ClippingView view = state.inside;
  if (selection.quality && selection.others == render::Selection::Others::Hide) view.isolate = std::exchange(selection.quality, {});
  if (is_searching(scenery, wish.inspected) && state.inspection.alone) view = ghost_alone();
  selection.others = render::Selection::Others::Fade;
  if (scenery.derived.frame_serial != frame()->serial) {
    refresh_members(members_, state, *session_);
    selection.members = members_.members;
  }
  scene.set_selection(selection);
  scene.set_view(view);
}

void PaneView::select(const Scenery& scenery) {
  render::Selection selection = selection_of(scenery.state, scenery.derived);
  if (scenery.derived.frame_serial != frame()->serial) {
    refresh_members(members_, scenery.state, *session_);
    selection.members = members_.members;
  }
  planar_.set_selection(selection);
}

void PaneView::find_labels(const Scenery& scenery, const render::Camera2D& camera) {
  const ColouringState& colouring = scenery.state.colouring;
  const double em = ImGui::GetFontSize();
  // As they are drawn: digits of DejaVu Sans are 0.64 em wide.
  const render::LabelWish wish{colouring.label_vertices, colouring.label_elements, 0.8 * 0.64 * em, em, 400};
  const Vec2<double> viewport = scenery.state.viewport;
  labels_ = scene().labels(seen_from(scenery.state, camera), viewport, wish);
  labels_lack_room_ = (wish.vertices || wish.elements) && labels_.empty();
}

void PaneView::update_planar(const Scenery& scenery) {
  const RunView& run = session_->runs[session_->active];
  if (fixed_serial_ != frame()->serial && run.fixed.size() == frame()->vertex_count()) {
    planar_.set_fixed(run.fixed);
    fixed_serial_ = frame()->serial;
  }
  planar_.set_shading(current_ && colours_ ? colours_->shading : nullptr);
  if (current_) select(scenery);
}

void PaneView::draw(const Scenery& scenery, const Wish& wish) {
  const ViewState& state = scenery.state;
  if (in_space()) {
    update_volume(scenery, wish);
  } else {
    update_planar(scenery);
  }
  find_labels(scenery, wish.camera);
  const auto marked = [&]() -> render::SceneMarks {
    if (in_space()) return space_marks(scenery, state.viewport, wish.inspected);
    return marks(scenery, {wish.camera, state.viewport, state.scale}, wish.inspected);
  };
  const auto w = static_cast<int>(std::lround(state.viewport.x)), h = static_cast<int>(std::lround(state.viewport.y));
  picture_.update(scene(),
                  {w, h, seen_from(state, wish.camera), picture_style(state, scenery.derived), marked(), wish.detail, wish.refine});
}

render::Marks PaneView::marks(const Scenery& scenery, const MarkView& view, bool inspected) {
  const ViewState& state = scenery.state;
  render::Marks marks;
  if (frame() == nullptr) return marks;
  const Picked picked = picked_here(scenery);
  if (picked.kind == Picked::Kind::Element && picked.id < frame()->element_count()) marks.elements = {picked.id};
  const bool inspecting = inspected && state.inspection.open;
  const bool searching = inspecting && scenery.inspection.trace && !state.inspection.applied;
  if (picked.kind == Picked::Kind::Vertex && picked.id < frame()->vertex_count()) {
    for (const Incidence& incidence : searching ? std::span<const Incidence>{} : frame()->input->topology.star(picked.id))
      marks.elements.push_back(incidence.element);
    marks.vertices = {picked.id};
  }
  if (marks_worst(state, inspecting)) marks.worst = frame()->worst.front().element;
  if (inverted_of_ != frame()->serial) {
    inverted_ = inverted_elements(*frame());
    inverted_of_ = frame()->serial;
  }
  if (!searching) add_inverted(marks, view, *frame(), inverted_);
  stepping_.add_marks(marks, state, *session_, view, [this](const MarkView& seen, std::size_t most) {
    return planar_.elements_in_view(seen.camera, seen.viewport, most);
  });
  const render::Style plain = scene_style(state);
  if (inspecting) {
    render::Style of_quality = plain;
    of_quality.colours = colour_scale(state, scenery.derived);  // of candidates, whatever the elements show
    const InspectionLook look = inspection_look(of_quality, palette(state.theme).accent, view.camera.units_per_pixel, view.scale);
    add_inspection_marks(marks, state.inspection, scenery.inspection, look);
  }
  if (!searching) add_targets(marks, *frame(), metric_of_targets(), marks.elements);
  if (frame()->run != Frame::kNoRun)
    add_size_point(marks, session_->runs[session_->active], *frame()->input, plain.highlight_colour, plain.casing_colour);
  return marks;
}

}  // namespace dmoscope::ui
