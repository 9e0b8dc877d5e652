#include "ui/viewports/stepping_view.h"

#include <array>
#include <cstring>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/inspect/joint_hold.h"
#include "ui/state/format.h"
#include "ui/state/view_options.h"
#include "ui/viewports/mesh_marks.h"

namespace dmoscope::ui {
namespace {

/// Ghosts of more elements than this around the view would be a grey veil.
constexpr std::size_t kMostGhosts = 60'000;

bool same_mesh(const Frame& a, const Frame& b) { return a.input_serial == b.input_serial && a.run == b.run && a.input == b.input; }

bool same_positions(const Frame& a, const Frame& b) {
  return a.positions.size() == b.positions.size() &&
         std::memcmp(a.positions.data(), b.positions.data(), a.positions.size() * sizeof(Vec3)) == 0;
}

std::string_view since(Reference reference) {
  constexpr std::array<std::string_view, 5> kNames{"", "the input", "the last step", "A", "B"};  // in the order of Reference
  return kNames[static_cast<std::size_t>(reference)];
}
std::string why_not(Reference reference) {
  return reference == Reference::Previous ? "nothing has moved yet" : fmt::format("{} is not marked", since(reference));
}

render::Rgba solid(render::Rgb c, int alpha = 255) { return {c.r, c.g, c.b, static_cast<std::uint8_t>(alpha)}; }

}  // namespace

void SteppingView::update(const SessionView& session, bool busy) {
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

std::optional<std::span<const Vec3>> SteppingView::positions_of(const ViewState& state, Reference reference, const Frame& frame) const {
  if (frame.device) return std::nullopt;
  if (reference == Reference::Input) return std::span(frame.input->mesh.positions);
  const Frame* before = reference == Reference::Previous ? previous_.get()
                        : reference == Reference::A      ? state.timeline.a.frame.get()
                        : reference == Reference::B      ? state.timeline.b.frame.get()
                                                         : nullptr;
  if (before == nullptr || before->device || before->input != frame.input) return std::nullopt;
  return std::span(before->positions);
}

std::string SteppingView::key(const ViewState& state, const Frame& frame, const JointCluster* hold, const std::string& view) const {
  const Brush& brush = state.brush;
  const auto edge = state.edge_under_mouse.value_or(std::array{kNoIndex, kNoIndex});
  const auto serial = [](const std::shared_ptr<const Frame>& of) { return of ? of->serial : 0; };
  return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", options_key(state), edge[0], edge[1], fmt::ptr(hold),
                     state.stepping.flash_level, state.stepping.news.serial, frame.serial, serial(previous_),
                     serial(state.timeline.a.frame), serial(state.timeline.b.frame), view, state.selection.serial(), brush.painting,
                     static_cast<int>(brush.kind), brush.stroke.serial());
}

void SteppingView::add_marks(render::Marks& marks, const ViewState& state, const SessionView& session, const MarkView& view,
                             const ElementsInView& elements_in_view) {
  const Frame* frame = session.frame.get();
  if (frame == nullptr || frame->device) return;
  std::string wanted = key(state, *frame, hold_of(state, session),
                           fmt::format("{} {} {} {} {} {}", view.camera.centre.x, view.camera.centre.y, view.camera.units_per_pixel,
                                       view.viewport.x, view.viewport.y, view.scale));
  if (wanted != marks_key_) {
    marks_ = {};
    make_marks(state, session, view, elements_in_view);
    marks_key_ = std::move(wanted);
  }
  marks.lines.insert(marks.lines.end(), marks_.lines.begin(), marks_.lines.end());
  marks.dots.insert(marks.dots.end(), marks_.dots.begin(), marks_.dots.end());
}

void SteppingView::make_marks(const ViewState& state, const SessionView& session, const MarkView& view,
                              const ElementsInView& elements_in_view) {
  const Frame& frame = *session.frame;
  const Palette& colours = palette(state.theme);
  const Plane& plane = frame.input->geometry.plane;
  ghost_too_fine_ = false;
  if (const auto from = positions_of(state, state.stepping.ghost, frame)) {
    const auto elements = elements_in_view(view, kMostGhosts);
    ghost_too_fine_ = !elements;
    if (elements)
      // The wireframe is dark in all themes.
      add_ghost(marks_, view, frame.input->mesh, plane, *from, frame.positions, *elements, {255, 255, 255, 255}, {16, 18, 22, 150});
  }
  if (const auto from = positions_of(state, state.stepping.arrows, frame)) {
    const std::tuple wanted{from->data(), previous_ ? previous_->serial : 0, frame.serial};
    if (moved_key_ != wanted) moved_ = Displacements(plane, *from, frame.positions);
    moved_key_ = wanted;
    factor_ = arrow_factor(view, moved_, state.stepping.arrow_scale);
    arrows_left_out_ = add_arrows(marks_, view, moved_, factor_, solid(colours.run(frame.run)), solid(colours.background, 230));
  }
  if (const Domain* domain = state.features ? domain_of(session) : nullptr)
    add_features(marks_, view, *domain, *frame.input, frame.positions, solid(colours.text));
  if (const auto& edge = state.edge_under_mouse; edge && (*edge)[1] < frame.positions.size())
    add_edge(marks_, *frame.input, frame.positions, *edge, solid(colours.run(frame.run)), solid(colours.background, 230));
  if (const JointCluster* hold = hold_of(state, session))
    add_holders(marks_, view, *hold, *frame.input, frame.positions, solid(colours.run(frame.run)), solid(colours.background, 220));
  if (state.stepping.next_class) add_next_class(state, session, view);
  flash_factor_ = state.stepping.news.serial == frame.serial ? add_flash(marks_, view, state, frame) : 0.0;
  add_selection(state, frame, view);
}

const Domain* SteppingView::domain_of(const SessionView& session) const {
  const Frame* frame = session.frame.get();
  return frame != nullptr && frame->run < session.runs.size() ? session.runs[frame->run].domain.get() : nullptr;
}

const JointCluster* SteppingView::hold_of(const ViewState& state, const SessionView& session) {
  const Frame* frame = session.frame.get();
  if (!state.holders || frame == nullptr || frame->run >= session.runs.size()) return nullptr;
  const RunView& run = session.runs[frame->run];
  return frame->moment == run.moment ? run.hold().get() : nullptr;
}

NextClass SteppingView::class_of(const SessionView& session) const {
  const Frame& frame = *session.frame;
  if (frame.run >= session.runs.size() || !session.runs[frame.run].colouring) return {};
  return next_class(*session.runs[frame.run].colouring, frame.moment.visits);
}

void SteppingView::add_next_class(const ViewState& state, const SessionView& session, const MarkView& view) {
  const Frame& frame = *session.frame;
  const NextClass next = class_of(session);
  if (next.vertices.empty()) return;
  const render::Rgba accent = solid(palette(state.theme).run(frame.run));
  add_dots(marks_, view, *frame.input, frame.positions, next.vertices, accent, 8.0);
  const Vec2<double> first = frame.input->geometry.plane.place(frame.positions[next.vertices.front()]);
  marks_.dots.push_back({first, 20.0F, accent, render::DotShape::Ring});
}

void SteppingView::add_space_marks(render::SpaceMarks& marks, const ViewState& state, const SessionView& session,
                                   const render::VolumeScene& scene, Vec2<double> viewport) {
  const Frame* frame = session.frame.get();
  const SteppingState& s = state.stepping;
  const bool flashes = s.flash_level > 0 && frame != nullptr && s.news.serial == frame->serial;
  const bool features = state.features && domain_of(session) != nullptr;
  if (frame == nullptr || frame->device ||
      !(features || state.edge_under_mouse || hold_of(state, session) != nullptr || flashes || s.next_class ||
        s.arrows != Reference::None || s.ghost != Reference::None))
    return;
  const render::OrbitCamera& camera = state.orbit;
  const Vec3 &c = camera.centre, &r = camera.right, &u = camera.up;
  std::string wanted = key(state, *frame, hold_of(state, session),
                           fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", c.x, c.y, c.z, r.x, r.y, r.z, u.x, u.y, u.z,
                                       camera.height, camera.perspective, viewport.x, viewport.y, state.scale, scene.revision()));
  if (wanted != marks_key_) {
    space_marks_ = {};
    make_space_marks(state, session, scene, {camera, camera.projection(viewport, scene.bounds()), state.scale});
    marks_key_ = std::move(wanted);
  }
  marks.lines.insert(marks.lines.end(), space_marks_.lines.begin(), space_marks_.lines.end());
  marks.dots.insert(marks.dots.end(), space_marks_.dots.begin(), space_marks_.dots.end());
  marks.cells.insert(marks.cells.end(), space_marks_.cells.begin(), space_marks_.cells.end());
}

void SteppingView::make_space_marks(const ViewState& state, const SessionView& session, const render::VolumeScene& scene,
                                    const SpaceMarkView& view) {
  const Frame& frame = *session.frame;
  const Palette& colours = palette(state.theme);
  const render::Rgba accent = solid(colours.run(frame.run));
  const auto unhidden = scene.unhidden(view.camera, view.projection.viewport());
  too_many_faces_ = !unhidden;
  arrows_drawn_ = arrows_left_out_ = 0;
  if (!unhidden) return;
  ghost_too_fine_ = false;
  if (const auto from = positions_of(state, state.stepping.ghost, frame)) {
    ghost_too_fine_ = unhidden->edges.size() > kMostGhosts;
    if (!ghost_too_fine_)
      add_space_ghost(space_marks_, view, *from, frame.positions, unhidden->edges, {255, 255, 255, 255}, {16, 18, 22, 150});
  }
  if (const auto from = positions_of(state, state.stepping.arrows, frame)) {
    factor_ = space_arrow_factor(view, *from, frame.positions, unhidden->vertices, state.stepping.arrow_scale);
    const ArrowsAdded added =
        add_space_arrows(space_marks_, view, *from, frame.positions, unhidden->vertices, factor_, accent, solid(colours.background, 230));
    arrows_drawn_ = added.drawn;
    arrows_left_out_ = added.left_out;
  }
  if (const Domain* domain = state.features ? domain_of(session) : nullptr)
    add_space_features(space_marks_, *domain, frame.positions, *unhidden, solid(colours.text), solid(colours.background, 200));
  if (const auto& edge = state.edge_under_mouse; edge && (*edge)[1] < frame.positions.size())
    add_space_edge(space_marks_, frame.positions, *edge, accent, solid(colours.background, 230));
  if (const JointCluster* hold = hold_of(state, session))
    add_space_holders(space_marks_, view, *hold, frame.positions, accent, solid(colours.background, 220));
  const bool flashes = state.stepping.news.serial == frame.serial;
  flash_factor_ = flashes ? add_space_flash(space_marks_, view, state, frame, unhidden->vertices) : 0.0;
  const NextClass next = state.stepping.next_class ? class_of(session) : NextClass{};
  if (!next.vertices.empty() && next.vertices.size() <= kMostMarks) {
    add_space_dots(space_marks_, frame.positions, next.vertices, unhidden->vertices, accent, 8.0F);
    if (scene.sees_vertex(next.vertices.front()))
      space_marks_.dots.push_back({frame.positions[next.vertices.front()], 20.0F, accent, render::DotShape::Ring});
  }
}

void SteppingView::add_selection(const ViewState& state, const Frame& frame, const MarkView& view) {
  const Selection selection = state.brush.painting ? after_stroke(state.selection, state.brush) : state.selection;
  if (selection.empty() || selection.vertices().back() >= frame.vertex_count()) return;
  add_dots(marks_, view, *frame.input, frame.positions, selection.vertices(), solid(palette(state.theme).text), 8.0);
}

std::string SteppingView::hold_note(const ViewState& state, const SessionView& session) {
  const JointCluster* hold = hold_of(state, session);
  if (hold == nullptr) return "what holds the minimum is not known here";
  return fmt::format("{} elements hold one another{}", holders(*hold).size(), hold->certified ? "" : " (not certified)");
}

std::string SteppingView::note(const ViewState& state, const SessionView& session) const {
  const Frame* frame = session.frame.get();
  if (frame == nullptr) return {};
  const SteppingState& s = state.stepping;
  std::string text;
  const auto add = [&text](const std::string& part) { text += text.empty() ? part : " · " + part; };
  const bool wanted = s.next_class || s.arrows != Reference::None || s.ghost != Reference::None || !state.selection.empty();
  if (wanted && frame->device) return "stepping is shown when the run rests";
  if (!state.selection.empty()) add(fmt::format("{} selected", count(state.selection.vertices().size())));
  if (state.brush.on && !state.in_space) add("brush");
  if (state.holders) add(hold_note(state, session));
  if (s.click_smooths) add("a click smooths");
  if (s.flash_level > 0 && flash_factor_ > 0.0) add(fmt::format("moved just now, arrows × {:.3g}", flash_factor_));
  if (state.in_space && too_many_faces_ && (s.next_class || s.arrows != Reference::None || s.ghost != Reference::None)) {
    add("too many faces for arrows, ghosts and classes");
    return text;
  }
  if (const NextClass next = s.next_class ? class_of(session) : NextClass{}; next.number > 0)
    add(fmt::format("next: class {} of {}, {} vertices", next.number, next.count, count(next.vertices.size())));
  if (s.arrows != Reference::None && !positions_of(state, s.arrows, *frame)) {
    add(fmt::format("no arrows: {}", why_not(s.arrows)));
  } else if (s.arrows != Reference::None && state.in_space && arrows_drawn_ == 0) {
    const bool cut = state.inside.clip.on && state.inside.clip.mode == ClipPlane::Mode::Cut;
    add(fmt::format("arrows: no vertex in sight has moved since {}{}", since(s.arrows),
                    cut ? "; whole cells show more than cut ones" : ""));
  } else if (s.arrows != Reference::None) {
    add(fmt::format("{}arrows × {:.3g} since {}", arrows_left_out_ > 0 ? "longest " : "", factor_, since(s.arrows)));
  }
  if (s.ghost != Reference::None && !positions_of(state, s.ghost, *frame)) {
    add(fmt::format("no ghost: {}", why_not(s.ghost)));
  } else if (s.ghost != Reference::None) {
    add(ghost_too_fine_ ? std::string("ghost: zoom in to see it") : fmt::format("ghost of {}", since(s.ghost)));
  }
  return text;
}

}  // namespace dmoscope::ui
