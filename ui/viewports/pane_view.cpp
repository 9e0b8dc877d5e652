#include "ui/viewports/pane_view.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>

#include "ui/toolkit/theme.h"

namespace dmoscope::ui {

namespace {

/// Whether a search in a volume is inspected, whose marks must be seen.
bool is_searching(const Scenery& scenery, bool inspected) {
  return inspected && scenery.state.inspection.open && scenery.inspection.solid && !scenery.state.inspection.applied;
}

/// A view of no cell, with the boundary of all of them drawn faintly.
ClippingView ghost_alone() {
  ClippingView view;
  view.isolate = {4.0F, 5.0F};  // no metric reaches these values
  view.ghost = true;
  return view;
}

}  // namespace

render::Style picture_style(const ViewState& state, const Derived& derived) {
  render::Style style = scene_style(state);
  style.colours = shown_scale(state, derived);
  const render::Rgb ink = palette(state.theme).text;
  constexpr int kStrongest = 115;  // 45 % of 255
  style.tint = {ink.r, ink.g, ink.b, static_cast<std::uint8_t>(kStrongest * state.stepping.flash_level / kFlashLevels)};
  return style;
}

void PaneView::update_colours(const ViewState& state, std::shared_ptr<const Frame> reference, const PaneView* like) {
  if (like != nullptr && !needs_positions(state.colouring.by) && state.colouring.by != ColourBy::Class) {
    worker_.update(state, {}, nullptr);  // nobody waits for its earlier work any more
    colours_ = like->colours_;
    return;
  }
  worker_.update(state, *session_, std::move(reference));
  colours_ = worker_.colours();
  // A volume has no colours by vertices: quality is shown instead, with a note.
  if (in_space() && colours_ && (!colours_->shading || colours_->shading->by != render::Shading::By::Elements)) colours_.reset();
}

bool PaneView::bring(render::Loading loading) {
  if (frame() != nullptr && in_space() != (volume() != nullptr)) {
    picture_.forget();
    if (in_space()) {
      scene_.emplace<render::VolumeScene>();
    } else {
      scene_.emplace<render::PlanarScene>().draw_through_host(no_interop_);
      fixed_serial_ = 0;
    }
  }
  if (render::VolumeScene* scene = volume()) scene->set_pool(pool_);
  return current_ = scene().show(session_->frame, loading);
}

render::Camera PaneView::seen_from(const ViewState& state, const render::Camera2D& camera) const {
  if (in_space()) return state.orbit;
  return camera;
}

render::Pick PaneView::pick(const ViewState& state, const render::Camera2D& camera, Vec2<double> pixel, double radius) const {
  return scene().pick(seen_from(state, camera), state.viewport, pixel, radius);
}

std::string PaneView::note(const ViewState& state) const {
  std::string text = overlays_.note(state, *session_);
  if (!in_space() || state.inspection.open) return text;
  const render::Scene& scene = this->scene();
  std::string faint;
  const auto add = [&faint](const std::string& what) { faint += (faint.empty() ? "" : " and ") + what; };
  const bool marks_worst = state.worst_marker && !frame()->worst.empty();
  if (marks_worst && !scene.shows_element(state.orbit, state.viewport, frame()->worst.front().element)) add("the worst element");
  const Picked& picked = state.picked;
  if (picked.kind == Picked::Kind::Element && !scene.sees_element(picked.id)) add(fmt::format("element {}", picked.id));
  if (picked.kind == Picked::Kind::Vertex && !scene.sees_vertex(picked.id)) add(fmt::format("vertex {}", picked.id));
  if (faint.empty()) return text;
  return "hidden: " + faint + (text.empty() ? "" : " · ") + text;
}

void PaneView::update_volume(render::VolumeScene& scene, const Scenery& scenery, const Wish& wish) {
  const ViewState& state = scenery.state;
  const bool by_elements = colours_ && colours_->shading && colours_->shading->by == render::Shading::By::Elements;
  scene.set_shading(by_elements ? colours_->shading : nullptr);
  // Isolation in the histogram takes cells out of the volume; a mere choice leaves them in place, and the rest fades.
  render::Selection selection = this->selection(scenery);
  ClippingView view = state.inside;
  if (selection.quality && selection.others == render::Selection::Others::Hide) view.isolate = std::exchange(selection.quality, {});
  if (is_searching(scenery, wish.inspected) && state.inspection.alone) view = ghost_alone();
  selection.others = render::Selection::Others::Fade;
  scene.set_selection(selection);
  scene.set_view(view);
}

render::Selection PaneView::selection(const Scenery& scenery) {
  render::Selection selection = selection_of(scenery.state, scenery.derived);
  if (scenery.derived.frame_serial != frame()->serial) {
    refresh_members(members_, scenery.state, *session_);
    selection.members = members_.members;
  }
  selection.tinted = moved_just_now(scenery.state.stepping);
  return selection;
}

/// Elements around the vertices that the last step moved, as long as they are tinted.
std::shared_ptr<const std::vector<std::uint8_t>> PaneView::moved_just_now(const SteppingState& stepping) {
  constexpr std::size_t kMostElements = 300'000;  // with more, drawing them anew would take longer than the tint lasts
  const StepNews& news = stepping.news;
  const Frame& frame = *this->frame();
  const bool any = stepping.flash_level > 0 && news.serial == frame.serial && !news.moved.empty();
  if (!any || frame.element_count() > kMostElements) return nullptr;
  if (tinted_serial_ != news.serial) {
    std::vector<std::uint8_t> tinted(frame.element_count(), 0);
    for (const Index v : news.moved)
      for (const Incidence& incidence : frame.input->topology.star(v)) tinted[incidence.element] = 1;
    tinted_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(tinted));
    tinted_serial_ = news.serial;
  }
  return tinted_;
}

void PaneView::find_labels(const Scenery& scenery, const render::Camera& camera) {
  const ColouringState& colouring = scenery.state.colouring;
  const double em = ImGui::GetFontSize();
  // Sizes match the drawn text: digits of DejaVu Sans are 0.64 em wide.
  const render::LabelWish wish{colouring.label_vertices, colouring.label_elements, 0.8 * 0.64 * em, em, 400};
  const Vec2<double> viewport = scenery.state.viewport;
  labels_ = scene().labels(camera, viewport, wish);
  labels_lack_room_ = (wish.vertices || wish.elements) && labels_.empty();
}

void PaneView::update_planar(render::PlanarScene& scene, const Scenery& scenery) {
  const RunView& run = session_->runs[session_->active];
  if (fixed_serial_ != frame()->serial && run.fixed.size() == frame()->vertex_count()) {
    scene.set_fixed(run.fixed);
    fixed_serial_ = frame()->serial;
  }
  scene.set_shading(current_ && colours_ ? colours_->shading : nullptr);
  if (current_) scene.set_selection(selection(scenery));
}

void PaneView::draw(const Scenery& scenery, const Wish& wish) {
  const ViewState& state = scenery.state;
  if (render::VolumeScene* in_space = volume()) {
    update_volume(*in_space, scenery, wish);
  } else {
    update_planar(plane(), scenery);
  }
  const render::Camera camera = seen_from(state, wish.camera);
  find_labels(scenery, camera);
  const auto w = static_cast<int>(std::lround(state.viewport.x)), h = static_cast<int>(std::lround(state.viewport.y));
  picture_.update(scene(), {w, h, camera, picture_style(state, scenery.derived), marks(scenery, camera, state.viewport, wish.inspected),
                            wish.detail, wish.refine, wish.plain && in_space()});
}

}  // namespace dmoscope::ui
