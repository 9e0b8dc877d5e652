#include "ui/overlays/overlays.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "ui/overlays/overlay.h"
#include "ui/state/view_options.h"
#include "ui/toolkit/theme.h"

namespace dmoscope::ui {
namespace {

bool same_mesh(const Frame& a, const Frame& b) { return a.input_serial == b.input_serial && a.run == b.run && a.input == b.input; }

bool same_positions(const Frame& a, const Frame& b) {
  return a.positions.size() == b.positions.size() &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(Vec3)) == 0;
}

/// All numbers of the camera that a view depends on, as a text.
std::string text_of(const render::Camera& camera) {
  if (const auto* plane = std::get_if<render::Camera2D>(&camera))
    return fmt::format("{} {} {}", plane->centre.x, plane->centre.y, plane->units_per_pixel);
  const auto& orbit = std::get<render::OrbitCamera>(camera);
  const Vec3 &c = orbit.centre, &r = orbit.right, &u = orbit.up;
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {}", c.x, c.y, c.z, r.x, r.y, r.z, u.x, u.y, u.z, orbit.height, orbit.perspective);
}

void append(render::Marks& marks, const render::Marks& more) {
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(marks.elements, more.elements);
  add(marks.vertices, more.vertices);
  add(marks.lines, more.lines);
  add(marks.dots, more.dots);
}

}  // namespace

bool OverlayInput::is_active_mesh() const {
  const InputMesh* active = scenery == nullptr ? &input() : scenery->active;
  return &input() == active || (active != nullptr && active->mesh.vertex_count() == input().mesh.vertex_count() &&
                                active->mesh.elements.size() == input().mesh.elements.size());
}

Picked OverlayInput::picked() const { return is_active_mesh() ? state.picked : Picked{}; }

Inks OverlayInput::inks(int casing_alpha) const {
  const Palette& colours = palette(state.theme);
  return {solid(colours.run(frame().run)), solid(colours.background, casing_alpha)};
}

std::optional<std::span<const Vec3>> OverlayInput::positions_of(Reference reference) const {
  if (reference == Reference::Input) return std::span(input().mesh.positions);
  const Frame* before = reference == Reference::Previous ? previous.get()
                        : reference == Reference::A      ? state.timeline.a.frame.get()
                        : reference == Reference::B      ? state.timeline.b.frame.get()
                                                         : nullptr;
  if (before == nullptr || before->device || before->input != frame().input) return std::nullopt;
  return std::span(before->positions);
}

Overlays::Overlays() {
  for (const auto make : {picked_overlay, worst_overlay, inverted_overlay, inspection_overlay, target_overlay, size_point_overlay})
    of_moment_.push_back(make());
  for (const auto make :
       {ghost_overlay, arrow_overlay, feature_overlay, next_class_overlay, flash_overlay, holder_overlay, selection_overlay})
    steady_.push_back(make());
}

void Overlays::update(const SessionView& session, bool busy) {
  const std::shared_ptr<const Frame>& frame = session.frame;
  if (!frame) {
    rest_.reset();
    previous_.reset();
    return;
  }
  if (busy || frame->device || rest_ == frame) return;
  if (!rest_ || !same_mesh(*rest_, *frame)) {
    previous_.reset();
  } else if (!same_positions(*rest_, *frame)) {
    previous_ = rest_;
  }
  rest_ = frame;
}

std::string Overlays::key(const OverlayInput& in, const MarkView& view) const {
  const Brush& brush = in.state.brush;
  const auto edge = in.state.edge_under_mouse.value_or(std::array{kNoIndex, kNoIndex});
  const auto serial = [](const std::shared_ptr<const Frame>& of) { return of ? of->serial : 0; };
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", options_key(in.state), edge[0], edge[1],
                     fmt::ptr(hold_of(in).get()), in.state.stepping.flash_level, in.state.stepping.news.serial, in.frame().serial,
                     serial(previous_), serial(in.state.timeline.a.frame), serial(in.state.timeline.b.frame), text_of(in.camera),
                     view.view.viewport().x, view.view.viewport().y, view.scale, in.scene->revision(), in.state.selection.serial(),
                     brush.painting, static_cast<int>(brush.kind), brush.stroke.serial());
}

render::Marks Overlays::marks(const Scenery& scenery, const SessionView& session, const render::Scene& scene, const render::Camera& camera,
                              Vec2<double> viewport, bool inspected) {
  render::Marks marks;
  const Frame* frame = session.frame.get();
  if (frame == nullptr) return marks;
  const InspectionState& inspection = scenery.state.inspection;
  OverlayInput in{scenery.state, session, previous_, &scenery, &scene, camera};
  in.inspecting = inspected && inspection.open;
  in.searching = in.inspecting && scenery.inspection.visit() != nullptr && !inspection.applied;
  const bool alone = in.searching && scenery.inspection.solid;  // all cells give way to the search, and its mesh stays plain
  marks.faint_where_taken_away = !alone;
  MarkView view{scene.view(camera, viewport), scenery.state.scale, ScenePoints::of(*frame->input)};
  for (const OverlayPointer& overlay : of_moment_)
    if (overlay->wanted(in)) overlay->make(in, view, marks);
  if (frame->device || alone || std::ranges::none_of(steady_, [&](const auto& overlay) { return overlay->wanted(in); })) return marks;
  if (std::string wanted = key(in, view); wanted != kept_for_) {
    kept_ = {};
    kept_for_ = std::move(wanted);
    if (frame->input->in_space()) view.unhidden = scene.unhidden(camera, viewport);
    too_much_ = frame->input->in_space() && !view.unhidden;
    for (const OverlayPointer& overlay : steady_)
      if (overlay->wanted(in) && (!too_much_ || !overlay->needs_unhidden())) overlay->make(in, view, kept_);
  }
  append(marks, kept_);
  return marks;
}

std::string Overlays::note(const ViewState& state, const SessionView& session) const {
  const Frame* frame = session.frame.get();
  if (frame == nullptr) return {};
  const SteppingState& s = state.stepping;
  const bool steps = s.next_class || s.arrows != Reference::None || s.ghost != Reference::None;
  if ((steps || !state.selection.empty()) && frame->device) return "arrows and ghosts are shown once the run pauses";
  const OverlayInput in{state, session, previous_};
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() || part.empty() ? "" : " · ") + part; };
  // Notes are in the reverse order of drawing.
  for (auto overlay = steady_.rbegin(); overlay != steady_.rend(); ++overlay)
    if (!too_much_ || !(*overlay)->needs_unhidden()) add((*overlay)->note(in));
  if (s.click_smooths) add("a click moves a vertex");
  if (steps && state.in_space && too_much_) add("too many faces for arrows, ghosts and classes");
  return text;
}

}  // namespace dmoscope::ui
