#include "ui/app.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/quality/quality.h"
#include "ui/analysis/derived.h"
#include "ui/analysis/element_colours.h"
#include "ui/analysis/scene_points.h"
#include "ui/commands/inspection_commands.h"
#include "ui/commands/tour_commands.h"
#include "ui/commands/view_json.h"
#include "ui/plots/plot_save.h"
#include "ui/state/actions.h"
#include "ui/state/view_geometry.h"
#include "ui/state/view_state.h"
#include "ui/toolkit/items.h"

namespace dmoscope::ui {
namespace {

constexpr double kRestAfter = 0.25;  // seconds without movement until full detail comes back
bool compares_runs(std::string_view line) { return line.starts_with("compare "); }

constexpr double kNotByItself = std::numeric_limits<double>::infinity();

}  // namespace

App::App(Options options)
    : options_(std::move(options)),
      engine_(options_.threads, options_.acceleration, options_.backend),
      session_(engine_.view()),
      viewports_({options_.no_interop, options_.software_renderer, options_.wait_for_scene}) {
  engine_.give_way();
  host_.session = [this] { return session_; };
  host_.post = [this](const std::string& line) {
    if (state_.sequence) end_sequence("the sequence of pictures ended early: another command came", Message::Kind::Warning);
    if (std::exchange(state_.timeline.shown, Shown::Now) != Shown::Now)
      add_message(state_, {Message::Kind::Info, "showing the current mesh again: commands do not apply to a mark", 0});
    if (reach_of(line) != CommandReach::Look) state_.timeline.play.kind = Playback::Kind::Off;
    if (leaves_inspection(line)) close_inspection(state_);
    post_by_itself(line);
  };
  host_.busy = [this] { return engine_.busy(); };
  host_.drawing_path = [this] { return activity_.drawing.sentence(); };
  host_.cancel = [this] { cancel(); };
  host_.item = [this](const std::string& name) { return items_.find(name); };
  commands_ = view_commands(state_, host_);
  activity_.renderer = options_.renderer;
  widgets_.sample_pictures = options_.sample_pictures;
}

App::~App() = default;

std::vector<std::string> App::look() const { return view_lines(state_, session_->frame != nullptr); }

void App::execute(std::string_view line) {
  state_.commands.begin(line, look());
  try {
    dispatch(commands_, host_, line);
  } catch (const Error& error) {
    state_.commands.refuse(error.what());
    state_.commands.end(look());
    throw;
  }
  state_.commands.end(look());
  if (!is_session_command(line) && record_of(line.substr(0, line.find(' '))) == Record::Action) state_.result.succeeded();
}

bool App::bring_to_sight(std::string_view line) {
  const std::size_t space = line.find(' ');
  const std::string_view word = line.substr(0, space);
  if (space == std::string_view::npos || (word != "click" && word != "double-click" && word != "right-click" && word != "move"))
    return false;
  const std::string_view item = line.substr(line.find_first_not_of(' ', space));
  if (item.find(' ') != std::string_view::npos || items_.boxes().contains(item)) return false;
  open_home_of(item, state_.panels);
  items_.scroll_to(item);
  return true;
}

void App::submit(std::string_view line) {
  try {
    execute(line);
  } catch (const Error& error) {
    add_message(state_, {Message::Kind::Error, error.what(), error.exit_code()});
  } catch (const std::exception& unforeseen) {  // a person's session must outlive errors of the program
    add_message(state_, {Message::Kind::Error, fmt::format("{}: {}", line, unforeseen.what()), 3});
  }
}

std::string App::title() const { return window_title(*session_); }

bool App::prepare() {
  const std::size_t letters = widgets_.glyphs.size();
  const bool fonts = styled_scale_ != state_.scale || built_letters_ != letters;
  if (fonts) {
    fonts_ = build_fonts(state_.scale, widgets_.glyphs);
    built_letters_ = letters;
    styled_scale_ = state_.scale;
  }
  if (fonts || styled_theme_ != state_.theme) {
    apply_style(state_.theme, state_.scale);
    styled_theme_ = state_.theme;
  }
  return fonts;
}

void App::take_news(double now) {
  session_ = shown_view();
  state_.follow(*session_);
  update_backend();
  update_drawing();
  for (Message& message : engine_.take_messages()) {
    if (listener_) listener_(message);
    add_message(state_, std::move(message));
  }
  bool compared = false;
  for (const CommandEnd& end : engine_.take_ends()) {
    const std::string_view line = state_.commands.line_of(end.id);
    compared = compared || (compares_runs(line) && end.kind == CommandEnd::Kind::Done);
    state_.result.ended(line, end);
    state_.commands.ended(end);
  }
  show_comparison(compared);
  activity_.pending = engine_.pending();
  activity_.busy = activity_.pending != 0;
  activity_.command = engine_.current_command();
  activity_.progress = engine_.progress().fraction();
  activity_.progress_label = engine_.progress().label();
  if (!activity_.busy) busy_since_ = -1.0;
  if (activity_.busy && busy_since_ < 0.0) busy_since_ = now;
  activity_.busy_seconds = activity_.busy ? now - busy_since_ : 0.0;
  pace_.note(now, activity_.busy ? work_done(run_at_work(*session_), activity_.command, activity_.progress) : std::nullopt);
  activity_.seconds_left = pace_.seconds_left();

  const double interval = now - last_draw_;
  constexpr double kLongestInterval = 0.5;  // after a longer interval nothing was to be drawn
  const bool steady = last_draw_ >= 0.0 && interval > 0.0 && interval < kLongestInterval && (moving(now) || activity_.busy);
  if (steady) {
    frame_interval_ = frame_interval_ > 0.0 ? 0.9 * frame_interval_ + 0.1 * interval : interval;
  } else {
    frame_interval_ = 0.0;
  }
  activity_.frames_per_second = frame_interval_ > 0.0 ? 1.0 / frame_interval_ : 0.0;
  last_draw_ = now;
}

/// Shows the runs that a command compares side by side, and in the matrix, once they exist.
void App::show_comparison(bool ended) {
  const bool more = std::exchange(runs_before_, session_->runs.size()) < session_->runs.size();
  const bool at_work = compares_runs(engine_.current_command());
  if ((more && (at_work || ended)) || (ended && !comparison_shown_)) {
    comparison_shown_ = true;
    state_.show_comparison(session_->runs.size());
    state_.commands.keep_look(look());
  }
  if (!at_work) comparison_shown_ = false;
}

bool App::moving(double now) const { return now - widgets_.moved_at < kRestAfter; }

/// Brings the backend up to date: the active run's, or with no mesh the one that a run would have.
void App::update_backend() {
  const Acceleration& acceleration = options_.acceleration;
  if (session_->active < session_->runs.size()) {
    activity_.backend = session_->runs[session_->active].backend;
    activity_.backend_reason = session_->runs[session_->active].backend_reason;
  } else if (acceleration.accelerator) {
    activity_.backend = acceleration.accelerator->backend();
    activity_.backend_reason = acceleration.accelerator->description();
  } else {
    activity_.backend = Backend::Cpu;
    activity_.backend_reason = "no cuda: " + acceleration.reason;
  }
}

/// Brings the way of drawing up to date; findings of the scene count from the next drawing on.
void App::update_drawing() {
  const Frame* frame = session_->frame.get();
  const bool snapshot_failed = frame != nullptr && !frame->device_trouble.empty();
  const render::PlanarScene* scene = viewports_.active().planar();
  const std::string of_scene = scene == nullptr ? std::string() : scene->device_trouble();
  activity_.drawing = drawing_path(activity_.backend, activity_.backend_reason, snapshot_failed ? frame->device_trouble : of_scene);
}

void App::notice_new_input() {
  const MeshChange change = meshes_.follow(*session_);
  const Frame* frame = session_->frame.get();
  if (change == MeshChange::None) return;
  const bool stays = change == MeshChange::ReadAgain || change == MeshChange::Switched;  // the pick and the view stay
  if (!stays || !meshes_.same_ids()) {
    state_.picked = change == MeshChange::Switched ? std::exchange(state_.pick_on_switch, {}) : Picked{};
    state_.selection.clear();
    state_.colouring.isolated.reset();  // a category of another mesh would leave nothing of this one
    if (!stays && frame != nullptr && tells_nothing(state_.colouring.by, *frame)) state_.colouring.by = ColourBy::Quality;
    state_.inspection.open = state_.inspection.playing = false;
    if (state_.picked.kind == Picked::Kind::None) state_.panels.leave_selection();
  }
  if (state_.colouring.by == ColourBy::Group && frame != nullptr && frame->input->mesh.groups.empty())
    state_.colouring.by = ColourBy::Quality;
  state_.pick_on_switch = {};
  if (change == MeshChange::Opened || (change == MeshChange::ReadAgain && !meshes_.same_ids())) {
    state_.inside = {};
    state_.panels.plots_wait = true;
    if (session_->input) state_.orbit.up_axis = guessed_up(*session_->input);
    state_.orbit.look_from(render::ViewPreset::Isometric);
  }
  if (change == MeshChange::Beside) show_beside();
  if (!stays) state_.requests.fit = state_.requests.fit_all = true;
  if (change != MeshChange::Switched)
    for (PlotView& plot : state_.plots) plot.x_range = plot.y_range = {};
  if (frame != nullptr) note_letters(frame->input->mesh);
  if (!stays && frame != nullptr && !frame->input->path.empty()) remember_file(state_, frame->input->path.string());
}

/// Puts meshes that lie at the same place under one camera, others each under its own.
void App::show_beside() {
  if (state_.panes.one()) state_.set_layout(PaneLayout::Two);
  state_.follow(*session_);  // finds which mesh comes into which viewport
  if (state_.in_space) return;
  const auto alike = [&](const InputView& mesh) { return cover_alike(*mesh.input, *session_->input); };
  if (!std::ranges::all_of(session_->meshes, alike)) state_.link_cameras(false);
}

/// Registers letters of names that are drawn without the glyph book.
void App::note_letters(const Mesh& mesh) {
  (void)widgets_.glyphs.shown(mesh.name);
  for (const auto& group : mesh.groups) (void)widgets_.glyphs.shown(group.name);
}

/// Places of the viewports. The colour bar lies on the mesh, with two viewports on the left one if they are high enough; else it has a
/// place of its own below them.
std::vector<Rect> App::pane_places(PanelContext& context, const Rect& rect) {
  Rect area = rect;
  const PaneLayout layout = state_.panes.layout;
  const bool low = layout == PaneLayout::Two && rect.h < 26 * context.em();
  const bool below = (layout == PaneLayout::Four || low) && context.frame() != nullptr;
  if (below) area.h = std::max(0.0F, area.h - std::round(colour_bar_height(context, rect)));
  return pane_rects(layout, area, std::round(context.px(4)), viewports_.aspect(), 2.9F * context.em());
}

void App::update_viewports(PanelContext& context, const Layout& layout) {
  redraw_in_ = kNotByItself;
  // The frame of a wheel's turn does not draw a slice of the full picture first.
  const bool moved = moving(context.now) || ImGui::GetIO().MouseWheel != 0.0F;
  // A live run counts as movement: its next frame comes soon.
  const bool live = activity_.busy && activity_.busy_seconds > kRestAfter;
  const std::vector<Rect> places = pane_places(context, layout.viewport);
  if (viewports_.draw(state_, derived_, inspection_, places,
                      {static_cast<double>(context.em()), moved, live, widgets_.note_lines, layout.uncovered()}))
    state_.commands.keep_look(look());
  if (viewports_.loading()) redraw_in_ = 0.1;
  activity_.reduced = viewports_.refining();
  if (viewports_.refining() && !activity_.busy) redraw_in_ = moved || live ? std::min(redraw_in_, kRestAfter) : 0.0;
  context.panes = viewports_.facts();
}

/// Moves a pick out from under the facts, which lie over the mesh in a small window.
void App::uncover_pick(const Layout& layout) {
  const Picked picked = state_.picked;
  if (std::exchange(seen_pick_, picked) == picked || !layout.folded || picked.kind == Picked::Kind::None) return;
  const PaneFacts& pane = viewports_.facts()[state_.panes.focus];
  const Rect free = layout.uncovered();
  const Frame* frame = pane.frame();
  if (!pane.view || frame->device || frame->positions.empty() || free.w < 6 * ImGui::GetFontSize()) return;
  const Index vertex = picked.kind == Picked::Kind::Vertex ? picked.id : frame->input->mesh.elements.corners(picked.id)[0];
  const auto place = pane.view->place(ScenePoints::of(*frame->input).at(frame->positions[vertex]));
  if (!place) return;
  const double at = static_cast<double>(pane.rect.x) + 0.5 * state_.viewport.x + place->x;
  const double left = static_cast<double>(free.x), right = left + static_cast<double>(free.w), margin = 0.2 * (right - left);
  if (at >= left + margin && at <= right - margin) return;
  const Vec2<double> move{0.5 * (left + right) - at, 0.0};
  if (pane.in_space()) {
    state_.orbit.pan(move, state_.viewport);
  } else {
    state_.camera_of(pane.number).pan(move);
  }
  redraw_in_ = 0.0;
}

void App::draw_panels(PanelContext& context) {
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  state_.window_size = {static_cast<int>(screen.x), static_cast<int>(screen.y)};
  Panels panels = state_.panels;
  constexpr double kLeastComparison = 17.0;  // height with four runs
  if (state_.plot == PlotTab::Compare) panels.bottom_height = std::max(panels.bottom_height, kLeastComparison);
  Layout layout = compute_layout(panels, screen.x, screen.y, header_size(context), session_->input != nullptr);
  widgets_.narrow = layout.folded;
  give_message_room(context, layout);
  draw_menu(context, layout.menu);
  draw_notice(context, layout);
  update_viewports(context, layout);
  draw_toolbar(context, layout.toolbar);
  draw_viewports(context, layout.viewport);
  uncover_pick(layout);
  if (!layout.folded) {
    draw_column(context, Side::Left, layout.left, false);
    draw_column(context, Side::Right, layout.right, false);
  }
  draw_plots(context, layout);
  draw_splitters(context, layout);
  if (layout.folded) {
    draw_column(context, Side::Left, layout.left, true);
    draw_column(context, Side::Right, layout.right, true);
  }
  draw_timeline(context, layout);
  draw_status(context, layout);
  draw_tour(context, layout);
  draw_dialogs(context);
}

void App::draw(double now) {
  // Busy is asked before the news, so that nothing counts as finished whose outcome is not among them.
  const bool busy = engine_.busy();
  take_news(now);
  notice_new_input();
  take_restored_view();
  keep_safe(busy, now);
  viewports_.follow(state_, session_);
  engine_.watch(viewports_.wanted(state_));
  update_derived();
  double fades_in = kNotByItself;
  if (state_.timeline.shown == Shown::Now) {
    viewports_.update_stepping(busy);
    fades_in = steps_.follow(state_, *session_, busy, now);
  }
  refresh(inspection_, state_, *session_, busy);
  const double play_in = play_on(busy, now);
  for (Message& message : serve_plot_requests(state_, *session_, {derived_.sorted_before, derived_.sorted_now})) {
    if (listener_) listener_(message);
    add_message(state_, std::move(message));
  }
  const std::size_t tour_step = state_.tour.step;
  state_.tour.follow(tour_facts(*session_, state_, busy));
  if (state_.tour.on && state_.tour.step != tour_step) open_home_of(state_.tour.now().items[0], state_.panels);
  if (const int direction = std::exchange(focus_moves_, 0); direction != 0) items_.move_focus(direction);
  if (ImGui::IsKeyPressed(key::kEscape, false)) Items::end_focus();
  items_.begin_frame();
  PanelContext context{
      state_,
      widgets_,
      *session_,
      activity_,
      derived_,
      inspection_,
      palette(state_.theme),
      fonts_,
      items_,
      [this](const std::string& line) { submit_by_person(line); },
      [this](std::size_t pane, Vec2<double> pixel) { return viewports_.point_at(state_, pane, pixel); },
      [this](std::size_t pane, Vec2<double> pixel) {
        const render::Pick pick = viewports_.pick(state_, pane, pixel);
        return std::pair{pick.vertex, pick.element};
      },
      [this](std::size_t pane, Vec2<double> pixel, double radius) { return viewports_.vertices_near(state_, pane, pixel, radius); },
      {},
      commands_.commands(),
      now};
  // A panel's data stays alive until the frame is done, whatever its commands do.
  const std::shared_ptr<const SessionView> held = session_;
  const auto hovered = state_.inspection.hovered;
  serve_chooser();
  draw_panels(context);
  if (activity_.busy) redraw_in_ = std::min(redraw_in_, 0.1);
  if (!viewports_.colours_settled() || !widgets_.outline.settled()) redraw_in_ = std::min(redraw_in_, 0.02);
  if (state_.requests.fit) redraw_in_ = 0.0;
  advance_playback(now);
  advance_sequence();
  watch_file();
  redraw_in_ = std::min({redraw_in_, play_in, fades_in});
  if (state_.inspection.hovered != hovered) redraw_in_ = 0.0;      // the next frame marks it in the mesh
  if (widgets_.glyphs.size() != built_letters_) redraw_in_ = 0.0;  // to draw letters that were met for the first time
  if (const auto wakes_in = std::exchange(widgets_.pointer_rest.wakes_in, std::nullopt)) redraw_in_ = std::min(redraw_in_, *wakes_in);
  if (tooltip_unsettled() || std::exchange(widgets_.resized, false)) redraw_in_ = 0.0;
}

/// Sends each level as a command of its own, so that it can be repeated. Returns the seconds after which there may be more.
double App::play_on(bool busy, double now) {
  const LevelTurn turn = play_levels(state_, busy, now);
  if (turn.line.empty()) return turn.wait;
  submit(turn.line);
  InspectionState& inspection = state_.inspection;
  inspection.playing = inspection.open && !inspection.applied;
  inspection.level_since = now;
  refresh(inspection_, state_, *session_, true);
  return turn.wait;
}

void App::update_derived() {
  refresh(derived_, state_, *session_, viewports_.frames());
  viewports_.update_colours(state_, derived_);
}

render::Image App::mesh_picture(const ScreenshotOptions& options) {
  if (session_->frame == nullptr) throw UsageError("no mesh is open: there is nothing to take a picture of");
  render::Shot shot;
  shot.width = options.width > 0 ? options.width : static_cast<int>(state_.viewport.x);
  shot.height = options.height > 0 ? options.height : static_cast<int>(state_.viewport.y);
  shot.supersample = options.supersample;
  shot.transparent = options.transparent;
  shot.scale = static_cast<float>(state_.scale);
  return viewports_.picture(state_, derived_, inspection_, shot);
}

}  // namespace dmoscope::ui
