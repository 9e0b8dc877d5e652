#include "ui/viewports/viewports.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include <fmt/format.h>

#include "ui/state/view_geometry.h"

namespace dmoscope::ui {

using ContentKind = PaneContent::Kind;

namespace {

/// Greatest number of threads; more would only wait for memory.
constexpr unsigned kMostThreads = 8;

/// Request to the session for a content; none if it is there anyway.
std::optional<Watch> watch_of(const PaneContent& content) {
  if (content.kind == ContentKind::Input) return Watch{};
  if (content.kind == ContentKind::Run) return Watch{content.run, content.iteration};
  return std::nullopt;
}

/// Box of the input; for a volume as seen from the corner from which it is seen first, so that viewports keep their places while it is
/// turned.
render::Bounds2 input_box(const InputMesh& input) {
  render::Bounds2 box;
  if (input.in_space()) {
    render::OrbitCamera camera;
    camera.up_axis = guessed_up(input);
    camera.look_from(render::ViewPreset::Isometric);
    for (const Vec3& position : input.mesh.positions) box.include(Vec2<double>{dot(position, camera.right), dot(position, camera.up)});
    return box;
  }
  for (const Vec3& position : input.mesh.positions) box.include(input.geometry.plane.place(position));
  return box;
}

}  // namespace

bool cover_alike(const InputMesh& a, const InputMesh& b) {
  if (&a == &b) return true;
  const render::Bounds2 one = input_box(a), other = input_box(b);
  render::Bounds2 both = one;
  both.include(other);
  constexpr double kAlike = 0.6;  // share of what both take together
  const auto is_alike = [](double a_size, double b_size, double size) { return std::min(a_size, b_size) >= kAlike * size; };
  return is_alike(one.size().x, other.size().x, both.size().x) && is_alike(one.size().y, other.size().y, both.size().y);
}

Viewports::Viewports(Options options) : options_(std::move(options)), session_(std::make_shared<SessionView>()) {
  views_[0] = std::make_unique<PaneView>(options_.no_interop);
  views_[0]->show(session_);
}

void Viewports::show(std::size_t pane, std::shared_ptr<const Frame> frame, std::size_t run, std::string name, std::string why_not,
                     const RunView* own) {
  Content& shown = shown_[pane];
  const bool same = shown.session == session_ && shown.frame == frame && shown.active == run && shown.view != nullptr;
  if (!same) {
    std::shared_ptr<const SessionView> view = session_;
    if (frame != session_->frame || run != session_->active) {
      auto other = std::make_shared<SessionView>(*session_);
      other->frame = frame;
      if (own != nullptr) {
        if (run == other->runs.size()) other->runs.emplace_back();
        other->runs[run] = *own;
      }
      other->active = run;
      if (frame) {
        other->input = frame->input;
      } else if (run < other->runs.size() && other->runs[run].input) {
        other->input = other->runs[run].input;
      }
      view = std::move(other);
    }
    shown = {session_, std::move(view), std::move(frame), run, {}, {}};
  }
  shown.name = std::move(name);
  shown.why_not = std::move(why_not);
  views_[pane]->show(shown.view);
}

void Viewports::remember(Marked& marked, const Mark& mark) {
  if (marked.frame == mark.frame) return;
  marked.frame = mark.frame;
  marked.run = mark.frame && mark.frame->run < session_->runs.size() ? session_->runs[mark.frame->run] : RunView{};
}

void Viewports::show_mark(std::size_t pane, const Marked& mark, const char* letter) {
  if (!mark.frame) {
    show(pane, nullptr, session_->active, letter, fmt::format("{} is not marked yet: Shift+{} marks what is shown", letter, letter));
    return;
  }
  const auto at = std::ranges::find(session_->runs, mark.run.id, &RunView::id);  // end of the list if the run has been removed
  show(pane, mark.frame, static_cast<std::size_t>(at - session_->runs.begin()), letter, {}, &mark.run);
}

void Viewports::show_content(const ViewState& state, std::size_t pane) {
  const PaneContent& content = state.panes.panes[pane].content;
  const std::size_t active = session_->active;
  if (state.panes.shows(pane, state.panes.active_id)) {
    const Timeline& timeline = state.timeline;
    show(pane, session_->frame, active, timeline.shown_mark() == nullptr ? "" : timeline.shown == Shown::A ? "A" : "B", {});
    return;
  }
  if (content.kind == ContentKind::MarkA || content.kind == ContentKind::MarkB) {
    const bool a = content.kind == ContentKind::MarkA;
    show_mark(pane, marked_[a ? 0 : 1], a ? "A" : "B");
    return;
  }
  if (content.kind == ContentKind::Free) {
    show(pane, nullptr, active, {}, "free: the next run is shown here");
    return;
  }
  const Watch what = *watch_of(content);
  const std::string name = content.kind == ContentKind::Input ? "input" : "";
  const auto place = static_cast<std::size_t>(std::ranges::find(state.panes.run_ids, content.run) - state.panes.run_ids.begin());
  const std::size_t run = place < session_->runs.size() ? place : active;
  const auto at = std::ranges::find(session_->watched, what, &WatchedFrame::what);
  if (at == session_->watched.end()) {
    show(pane, nullptr, run, name, "…");
  } else {
    show(pane, at->frame, run, name, at->why_not);
  }
}

void Viewports::follow(const ViewState& state, const std::shared_ptr<const SessionView>& session) {
  session_ = session;
  measure();
  layout_ = state.panes.layout;
  count_ = pane_count(layout_);
  focus_ = state.panes.focus;
  remember(marked_[0], state.timeline.a);
  remember(marked_[1], state.timeline.b);
  frames_.clear();
  for (std::size_t k = 0; k < Panes::kMost; ++k) {
    if (k >= count_) {
      views_[k].reset();
      shown_[k] = {};
      continue;
    }
    if (!views_[k]) views_[k] = std::make_unique<PaneView>(options_.no_interop);
    show_content(state, k);
    const auto& frame = shown_[k].frame;
    if (frame && std::ranges::find(frames_, frame) == frames_.end()) frames_.push_back(frame);
  }
  if (frames_.empty() && session->frame) frames_.push_back(session->frame);
}

void Viewports::measure() {
  if (measured_ == session_->input) return;
  measured_ = session_->input;
  aspect_ = 1.0;
  if (!measured_) return;
  const Vec2<double> size = input_box(*measured_).size();
  if (size.x > 0.0 && size.y > 0.0) aspect_ = size.x / size.y;
}

std::vector<Watch> Viewports::wanted(const ViewState& state) const {
  std::vector<Watch> wanted;
  for (std::size_t k = 0; k < state.panes.count(); ++k) {
    const auto what = watch_of(state.panes.panes[k].content);
    if (what && std::ranges::find(wanted, *what) == wanted.end()) wanted.push_back(*what);
  }
  if (const auto what = watch_of(state.colouring.reference); state.colouring.by == ColourBy::Difference && what)
    if (std::ranges::find(wanted, *what) == wanted.end()) wanted.push_back(*what);
  return wanted;
}

/// Frame that differences are taken from; null while it is not there.
std::shared_ptr<const Frame> Viewports::reference(const ViewState& state) const {
  const PaneContent& content = state.colouring.reference;
  if (content.kind == ContentKind::MarkA) return state.timeline.a.frame;
  if (content.kind == ContentKind::MarkB) return state.timeline.b.frame;
  const auto what = watch_of(content);
  if (!what) return nullptr;
  const auto at = std::ranges::find(session_->watched, *what, &WatchedFrame::what);
  return at == session_->watched.end() ? nullptr : at->frame;
}

void Viewports::update_colours(ViewState& state, Derived& derived) {
  const std::shared_ptr<const Frame> compared = state.colouring.by == ColourBy::Difference ? reference(state) : nullptr;
  const PaneView* first = nullptr;  // the first one with a mesh to work them out for
  for (std::size_t k = 0; k < count_; ++k) {
    views_[k]->update_colours(state, compared, first);
    if (first == nullptr && views_[k]->frame() != nullptr) first = views_[k].get();
  }
  ColourFacts& facts = derived.colouring;
  facts.colours = views_[focus_]->colours();
  // The colour bar belongs to viewports with values.
  for (std::size_t k = 0; k < count_; ++k)
    if (const auto& colours = views_[k]->colours(); colours && (!facts.colours || (colours->has_values && !facts.colours->has_values)))
      facts.colours = colours;
  facts.values_range.reset();
  for (std::size_t k = 0; k < count_; ++k) {
    if (const auto& colours = views_[k]->colours(); colours && colours->has_values) {
      const auto [low, high] = facts.values_range.value_or(colours->range);
      facts.values_range = {std::min(low, colours->range.first), std::max(high, colours->range.second)};
    }
  }
}

void Viewports::update_stepping(bool busy) {
  for (std::size_t k = 0; k < count_; ++k) views_[k]->update_stepping(busy);
}

/// Widths of a viewport that columns cover at its left and right; none if they leave no room worth speaking of.
std::pair<double, double> Viewports::covered(const Rect& rect, const Turn& turn) {
  const Rect seen = rect.within(turn.uncovered);
  if (static_cast<double>(seen.w) < 8.0 * turn.em) return {};
  return {static_cast<double>(seen.x - rect.x), static_cast<double>(rect.x + rect.w - seen.x - seen.w)};
}

/// Shows all of the mesh in the active viewport, whose place is `rect`, and in others whose camera was not moved since the last fit.
bool Viewports::fit(ViewState& state, const Rect& rect, const Turn& turn) {
  if (!state.requests.fit) return false;
  if (session_->frame == nullptr) {
    state.requests.fit = false;
    return false;
  }
  // One camera shows every mesh in space: while the active viewport waits for its own, another one tells what to fit.
  const auto shows_mesh = [](const auto& one) { return one && one->frame() != nullptr; };
  const auto at = shows_mesh(views_[focus_]) || !session_->input->in_space() ? views_.begin() + static_cast<std::ptrdiff_t>(focus_)
                                                                             : std::ranges::find_if(views_, shows_mesh);
  if (at == views_.end() || !(*at)->current()) return false;
  const PaneView& view = **at;
  state.requests.fit = false;
  // Title and colour bar stand above and below the mesh, not on it.
  const bool bar_within = state.panes.one() || state.panes.layout == PaneLayout::Split;
  const double em = turn.em, line = 1.07 * em, top = 2.4 * em + (turn.note_lines > 0 ? turn.note_lines * line + 0.8 * em : 0.0);
  fitted_below_ = turn.note_lines;
  const double bottom = bar_within ? 4.4 * em : 0.5 * em;
  fitted_beside_ = covered(rect, turn);
  const auto [left, right] = fitted_beside_;
  const Vec2<double> free{state.viewport.x - left - right, std::max(1.0, state.viewport.y - top - bottom)};
  const double margin = std::min(1.2 * em, 0.05 * std::min(free.x, free.y));
  if (const render::VolumeScene* volume = view.volume()) {
    volume->fit(state.orbit, state.viewport,
                {{left + margin, top + margin}, {state.viewport.x - right - margin, state.viewport.y - bottom - margin}});
    state.requests.fit_all = false;
    fitted_orbit_ = state.orbit;
    return true;
  }
  const auto camera_for = [&, aside = (left - right) / 2](const render::Bounds2& box) {
    render::Camera2D camera = render::Camera2D::fit(box, free, margin);
    camera.pan({aside, (top - bottom) / 2});
    return camera;
  };
  render::Bounds2 bounds = box_of_pane(focus_);
  const auto shows_another = [&](std::size_t k) { return k < count_ && views_[k]->session()->input != session_->input; };
  for (std::size_t k = 0; k < count_ && state.panes.linked && state.requests.fit_all; ++k)
    if (shows_another(k)) bounds.include(box_of_pane(k));
  const render::Camera2D camera = camera_for(bounds);
  const bool all = std::exchange(state.requests.fit_all, false);
  for (std::size_t k = 0; k < Panes::kMost; ++k) {
    Pane& pane = state.panes.panes[k];
    if (!shows_another(k)) {
      if (all || pane.camera == fitted_) pane.camera = camera;
    } else if (all || (fitted_others_[k] && *fitted_others_[k] == pane.camera)) {
      pane.camera = camera_for(box_of_pane(k));
      fitted_others_[k] = pane.camera;
    }
  }
  state.camera = camera;
  fitted_ = camera;
  return true;
}

/// Box of the planar mesh of a viewport; before it is ready to be drawn, that of its input.
render::Bounds2 Viewports::box_of_pane(std::size_t pane) const {
  const PaneView& view = *views_[pane];
  const bool ready = view.frame() != nullptr && view.current() && view.planar() != nullptr;
  const render::Bounds2 bounds = ready ? view.planar()->bounds() : render::Bounds2{};
  return bounds.empty() && view.session()->input ? input_box(*view.session()->input) : bounds;
}

/// Whether a fitted volume must be fitted anew: its camera was not moved, but the viewport or the kind of projection has changed.
bool Viewports::keeps_fit(const render::OrbitCamera& now, bool resized) const {
  if (!fitted_orbit_) return false;
  render::OrbitCamera fitted = *fitted_orbit_;
  const bool other_projection = std::exchange(fitted.perspective, now.perspective) != now.perspective;
  return fitted == now && (resized || other_projection);
}

bool Viewports::inspected(const ViewState& state, std::size_t pane) const {
  return pane == focus_ && state.panes.shows(pane, state.panes.active_id);
}

bool Viewports::draw(ViewState& state, const Derived& derived, const Inspection& inspection, std::span<const Rect> rects,
                     const Turn& turn) {
  const Vec2<double> before = state.viewport;
  const Rect& rect = rects.front();
  state.viewport = {std::max(1.0, static_cast<double>(rect.w)), std::max(1.0, static_cast<double>(rect.h))};
  // A fitted mesh stays fitted when the window, a panel or its projection changes.
  const Rect& active = rects[std::min(focus_, rects.size() - 1)];
  const auto [left, right] = covered(active, turn);
  const bool wider = left < fitted_beside_.first || right < fitted_beside_.second;  // a column that opens over it leaves it where it is
  const bool resized = before.x != state.viewport.x || before.y != state.viewport.y || turn.note_lines > fitted_below_ || wider;
  const bool volume = session_->input && session_->input->in_space();
  if (volume ? keeps_fit(state.orbit, resized) : resized && fitted_ && *fitted_ == state.camera) state.requests.fit = true;
  loading_ = refining_ = false;
  if (volume && !pool_) pool_ = std::make_unique<ThreadPool>(std::clamp(std::thread::hardware_concurrency(), 1U, kMostThreads));
  for (std::size_t k = 0; k < count_; ++k) {
    views_[k]->set_pool(turn.live ? nullptr : pool_.get());  // a run at work uses the processors already
    loading_ = !views_[k]->bring(options_.wait_for_scene ? render::Loading::Wait : render::Loading::Background) || loading_;
  }
  const bool fitted = fit(state, active, turn);
  facts_.clear();
  const Scenery scenery{state, derived, inspection, session_->input.get()};
  // All viewports together are drawn within a moment; full pictures come one after the other.
  std::size_t elements = 0;
  for (std::size_t k = 0; k < count_; ++k)
    if (views_[k]->frame() != nullptr) elements += views_[k]->drawn_count();
  const double detail = views_[focus_]->scene().suggested_detail(elements, options_.software_renderer, true);
  bool refine = !turn.moving && !turn.live;
  const bool plain = !refine && options_.software_renderer;  // darkening takes as long as all elements of a large mesh there
  for (std::size_t k = 0; k < count_; ++k) {
    PaneView& view = *views_[k];
    if (view.frame() != nullptr && !rect.empty()) {
      view.draw(scenery, {state.camera_of(k), inspected(state, k), detail, refine, plain});
      refining_ = refining_ || !view.complete();
      refine = refine && view.complete();
    }
    facts_.push_back(facts_of_pane(state, k, rects[std::min(k, rects.size() - 1)], turn.uncovered));
  }
  return fitted;
}

PaneFacts Viewports::facts_of_pane(ViewState& state, std::size_t pane, const Rect& rect, const Rect& uncovered) const {
  const PaneView& view = *views_[pane];
  PaneFacts facts;
  facts.number = pane;
  facts.rect = facts.clip = rect;
  if (state.panes.layout == PaneLayout::Split) {
    const float handle = std::round(static_cast<float>(state.panes.split) * rect.w);
    facts.clip = pane == 0 ? Rect{rect.x, rect.y, handle, rect.h} : Rect{rect.x + handle, rect.y, rect.w - handle, rect.h};
  }
  facts.uncovered = facts.clip.within(uncovered);
  facts.session = view.session();
  facts.removed = facts.session->active >= session_->runs.size();
  facts.name = shown_[pane].name;
  facts.why_not = shown_[pane].why_not;
  const ContentKind kind = state.panes.panes[pane].content.kind;
  facts.of_run = kind == ContentKind::Run || kind == ContentKind::Active || (view.frame() != nullptr && kind != ContentKind::Input);
  facts.colours = view.colours();
  facts.labels = view.labels();
  facts.camera = state.camera_of(pane);
  if (view.frame() != nullptr) facts.view = view.scene().view(view.seen_from(state, facts.camera), state.viewport);
  facts.texture = view.texture();
  facts.picture_serial = view.picture_serial();
  facts.focus = pane == focus_;
  facts.inspected = inspected(state, pane);
  facts.reduced = view.frame() != nullptr && !view.whole();
  facts.current = view.current();
  facts.lacks_room = view.labels_lack_room();
  if (const render::VolumeScene* volume = view.volume(); volume != nullptr && view.frame() != nullptr) {
    facts.cells_seen = volume->faces().visible_cells;
    facts.box = volume->bounds();
  }
  if (facts.focus) facts.stepping_note = view.note(state);
  return facts;
}

render::Pick Viewports::pick(const ViewState& state, std::size_t pane, Vec2<double> pixel) const {
  return views_[pane]->pick(state, facts_[pane].camera, pixel, 8.0 * state.scale);
}

std::optional<Vec3> Viewports::point_at(const ViewState& state, std::size_t pane, Vec2<double> pixel) const {
  const render::VolumeScene* volume = views_[pane]->volume();
  return volume == nullptr ? std::nullopt : volume->point_at(state.orbit, state.viewport, pixel);
}

std::vector<Index> Viewports::vertices_near(const ViewState& state, std::size_t pane, Vec2<double> pixel, double radius) const {
  const render::PlanarScene* planar = views_[pane]->planar();
  return planar == nullptr ? std::vector<Index>() : planar->vertices_near(facts_[pane].camera, state.viewport, pixel, radius);
}

bool Viewports::settled() const noexcept { return !loading_ && !refining_ && colours_settled(); }

bool Viewports::colours_settled() const noexcept {
  return std::all_of(views_.begin(), views_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [](const auto& view) { return view->colours_settled(); });
}

}  // namespace dmoscope::ui
