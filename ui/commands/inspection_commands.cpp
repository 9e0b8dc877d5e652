#include "ui/commands/inspection_commands.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "core/io/writing/atomic_file.h"
#include "ui/analysis/inspection_text.h"
#include "ui/commands/command_words.h"
#include "ui/state/view_geometry.h"

namespace dmoscope::ui {
namespace {

constexpr double kLevelTime = 0.8;  // seconds that playing shows a level
constexpr double kBusyTime = 0.05;  // seconds that playing waits while work is being done

std::shared_ptr<const SessionView> session_of(const CommandHost& host) {
  auto session = host.session();
  if (!session || !session->input || !session->frame) throw UsageError("no mesh is open");
  return session;
}

/// Moves the view to the star when it is too small to read, or not all in sight.
void look_at_star(ViewState& state, const Frame& frame, Index vertex) {
  constexpr double kLeastShare = 1.0 / 8.0, kShare = 0.5;
  if (frame.device) return;
  if (frame.input->in_space()) {
    look_at_picked(state, frame);
    return;
  }
  const render::Bounds2 box = star_box(frame, vertex), seen = state.camera.visible(state.viewport);
  const double extent = std::max({box.size().x, box.size().y, 1e-9 * frame.input->geometry.size});
  const double side = std::min(state.viewport.x, state.viewport.y) * state.camera.units_per_pixel;
  const bool inside = box.low.x >= seen.low.x && box.low.y >= seen.low.y && box.high.x <= seen.high.x && box.high.y <= seen.high.y;
  if (extent >= kLeastShare * side && inside) return;
  state.camera.look_at(box.centre(), extent / kShare, state.viewport);
}

/// Ends a close-up: goes back to the camera before it, unless the camera was moved since.
void leave_close_up(ViewState& state) {
  auto& close_up = state.inspection.close_up;
  if (close_up && close_up->second == state.camera) state.camera = close_up->first;
  close_up.reset();
  auto& space = state.inspection.space_close_up;
  if (space && space->second == state.orbit) state.orbit = space->first;
  space.reset();
}

/// Moves closer to the grid of a level in space, if it would be too small to read, until it fills a good part of the view.
void close_up_in_space(ViewState& state, const Inspection& look) {
  const auto number = static_cast<std::size_t>(state.inspection.level - 1);
  constexpr double kLeastShare = 0.4, kShare = 0.6;  // share of the view's height
  const Vec3 size = look.solid ? look.solid->levels[number].size : look.grid->plane.lift(look.trace->levels[number].size);
  const Vec3 centre = look.solid ? look.solid->levels[number].centre : look.grid->plane.lift(look.trace->levels[number].centre);
  const double extent = length(size);
  if (!(extent > 0.0) || extent >= kLeastShare * state.orbit.height) return;
  const render::OrbitCamera before = state.orbit;
  state.orbit.orbit_about(look.origin + centre);
  state.orbit.height = extent / kShare;
  state.inspection.space_close_up = {before, state.orbit};
}

/// Moves closer to candidates that would lie on top of each other.
void close_up_on(ViewState& state, const Inspection& look) {
  constexpr double kLeastSpacing = 8.0, kSpacing = 17.0, kLargestShare = 0.6;  // pixels; share of the view's shorter side
  leave_close_up(state);
  InspectionState& inspection = state.inspection;
  if (!inspection.zoom || look.visit() == nullptr || inspection.applied || inspection.all_levels || inspection.level < 1) return;
  if (static_cast<std::size_t>(inspection.level) > look.level_count()) return;
  if (look.solid || look.grid) return close_up_in_space(state, look);
  const TracedLevel& level = look.trace->levels[static_cast<std::size_t>(inspection.level - 1)];
  const double extent = std::max(level.size.x, level.size.y), spacing = least_spacing(level);
  if (!(spacing > 0.0) || spacing / state.camera.units_per_pixel >= kLeastSpacing * state.scale) return;
  const render::Camera2D before = state.camera;
  const double side = std::min(state.viewport.x, state.viewport.y);
  const double pixels = std::min(kLargestShare * side, kSpacing * state.scale * extent / spacing);
  if (extent / pixels >= before.units_per_pixel) return;  // the view is as close as it can be with the grid in sight
  state.camera.look_at({look.origin.x + level.centre.x, look.origin.y + level.centre.y}, extent * side / pixels, state.viewport);
  inspection.close_up = {before, state.camera};
}

void show_level(ViewState& state, const Inspection& look, int level) {
  InspectionState& inspection = state.inspection;
  inspection.applied = inspection.all_levels = false;
  inspection.level = level;
  inspection.level_since = -1.0;
  close_up_on(state, look);
}

/// Opens the inspection of a vertex. `in_order`: the run visits it next.
void open_at(ViewState& state, const SessionView& session, Index vertex, bool in_order) {
  leave_close_up(state);
  InspectionState& inspection = state.inspection;
  inspection.open = true;
  inspection.vertex = vertex;
  inspection.note.clear();
  inspection.in_order = in_order;
  inspection.playing = false;
  inspection.hovered.reset();
  state.picked = {Picked::Kind::Vertex, vertex};
  state.panels.show_selection();
  look_at_star(state, *session.frame, vertex);
  show_level(state, inspect(session, vertex), 1);
}

void open_at_element(ViewState& state, const SessionView& session, Index element) {
  const Index corner = worst_free_corner(session, element);
  if (corner != kNoIndex) {
    open_at(state, session, corner, false);
    return;
  }
  leave_close_up(state);
  InspectionState& inspection = state.inspection;
  inspection.open = true;
  inspection.vertex = kNoIndex;
  inspection.playing = inspection.applied = false;
  inspection.note = fmt::format(
      "All corners of element {} are fixed: no smoothing can change it. It is part of the ceiling, above which the minimum cannot rise.",
      element);
  state.picked = {Picked::Kind::Element, element};
  state.panels.show_selection();
}

/// Opens the inspection at the pick, or at the vertex that the run visits next.
void open_inspection(ViewState& state, const SessionView& session) {
  if (state.picked.kind == Picked::Kind::Vertex) {
    open_at(state, session, state.picked.id, false);
  } else if (state.picked.kind == Picked::Kind::Element) {
    open_at_element(state, session, state.picked.id);
  } else {
    open_at(state, session, next_vertex(session), true);
  }
}

/// Makes a vertex that was picked since the inspected one.
void follow_pick(ViewState& state) {
  InspectionState& inspection = state.inspection;
  if (!inspection.open || state.picked.kind != Picked::Kind::Vertex || state.picked.id == inspection.vertex) return;
  inspection.vertex = state.picked.id;
  inspection.note.clear();
  inspection.in_order = inspection.applied = inspection.playing = false;
}

Index parse_index(const std::string& word, Index size, const char* what) {
  const std::uint64_t id = to_count(word);
  if (id >= size) throw UsageError(fmt::format("there is no {} {}: the mesh has {}", what, id, size));
  return static_cast<Index>(id);
}

/// Applies the visit as the run itself makes it: by its next step when it is this vertex's turn, else by a visit of this vertex alone.
void apply_move(ViewState& state, const CommandHost& host, const SessionView& session) {
  InspectionState& inspection = state.inspection;
  if (!inspection.open || inspection.vertex == kNoIndex) throw UsageError("no vertex is looked into");
  if (inspection.applied) return;
  if (state.timeline.shown != Shown::Now)
    throw UsageError("a marked moment is shown: this move would be made in the mesh as it is now (flip now shows that)");
  const Inspection look = inspect(session, inspection.vertex);
  const VisitSummary* visit = look.visit();
  if (visit == nullptr) throw UsageError(look.trouble);
  if (!look.other_method.empty())
    throw UsageError(fmt::format("this run's method is {}, not dmo, whose move this is (visit {} makes the run's own)", look.other_method,
                                 inspection.vertex));
  if (visit->end == VisitEnd::Fixed) throw UsageError(fmt::format("vertex {} is fixed", inspection.vertex));
  if (host.busy()) throw UsageError("the run is at work: wait until it rests, or cancel it");
  const RunView& run = session.runs[session.active];
  inspection.take_back.clear();
  inspection.applied_from = run.moment;
  // If an edit was undone and can be repeated, a step would repeat that edit.
  if (inspection.in_order && run.edits == run.edits_done && next_vertex(session) == inspection.vertex) {
    host.post("step vertex");
    inspection.take_back = "back vertex";
  } else if (visit->end == VisitEnd::Moved) {
    host.post(fmt::format("visit {}", inspection.vertex));
    inspection.take_back = "undo";
  }
  inspection.level = static_cast<int>(look.level_count());
  inspection.all_levels = false;
  inspection.applied = true;
  leave_close_up(state);
}

void next_level(ViewState& state, const CommandHost& host, const SessionView& session) {
  InspectionState& inspection = state.inspection;
  if (!inspection.open || inspection.vertex == kNoIndex) {
    open_inspection(state, session);
    return;
  }
  if (inspection.applied) {
    if (host.busy()) return;  // the vertex that the run visits next is not known yet
    open_at(state, session, inspection.in_order ? next_vertex(session) : inspection.vertex, inspection.in_order);
    return;
  }
  const Inspection look = inspect(session, inspection.vertex);
  if (look.level_count() == 0) return;  // the inspector tells the reason
  const int last = static_cast<int>(look.level_count());
  if (inspection.level < last && !inspection.all_levels) {
    show_level(state, look, inspection.level + 1);
  } else {
    if (!look.other_method.empty()) inspection.playing = false;
    apply_move(state, host, session);
  }
}

/// Whether the applied move is the run's latest change.
bool can_take_back(const InspectionState& inspection, const RunView& run) {
  const Moment& from = inspection.applied_from;
  if (inspection.take_back == "undo") return run.moment == Moment{from.iteration, from.visits, from.edits + 1};
  const bool ended = from.visits + 1 == run.visits_per_iteration;
  return run.moment == (ended ? Moment{from.iteration + 1} : Moment{from.iteration, from.visits + 1});
}

/// Goes back from the applied move to the last level: the move is taken back, too, unless something else came after it.
void previous_level(ViewState& state, const CommandHost& host, const SessionView& session) {
  InspectionState& inspection = state.inspection;
  if (!inspection.open) return;
  const bool take_back = inspection.applied;
  if (take_back && host.busy()) throw UsageError("the run is at work: wait until it rests, or cancel it");
  if (take_back && !inspection.take_back.empty() && can_take_back(inspection, session.runs[session.active]))
    host.post(inspection.take_back);
  show_level(state, inspect(session, inspection.vertex),
             take_back || inspection.all_levels ? inspection.level : std::max(0, inspection.level - 1));
}

void set_level(ViewState& state, const SessionView& session, const std::string& word) {
  if (!state.inspection.open || state.inspection.vertex == kNoIndex) open_inspection(state, session);
  if (state.inspection.vertex == kNoIndex) return;
  const Inspection look = inspect(session, state.inspection.vertex);
  if (word == "all") {
    leave_close_up(state);
    state.inspection.applied = false;
    state.inspection.all_levels = true;
    return;
  }
  const std::uint64_t level = to_count(word);
  if (look.visit() == nullptr) throw UsageError(look.trouble);
  const std::size_t levels = look.level_count();
  if (level > levels) throw UsageError(fmt::format("there is no level {}: this visit has {}", level, levels));
  show_level(state, look, static_cast<int>(level));
}

void add_opening_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"inspect", "inspect [on|off|toggle|vertex ID|element ID]",
             "looks into the search of a vertex: what is picked, or the next of the run; of an element its worst free corner"},
            {0, 2}, [&state, &host](Arguments words) {
              const auto session = session_of(host);
              if (words.size() == 2 && words[0] == "vertex") {
                open_at(state, *session, parse_index(words[1], session->frame->vertex_count(), "vertex"), false);
              } else if (words.size() == 2 && words[0] == "element") {
                open_at_element(state, *session, parse_index(words[1], session->frame->element_count(), "element"));
              } else if (require(words, 0, 1); switched(words, 0, state.inspection.open)) {
                if (!state.inspection.open || state.picked != Picked{Picked::Kind::Vertex, state.inspection.vertex})
                  open_inspection(state, *session);
              } else {
                close_inspection(state);
              }
            });
  table.add({"inspect-next", "inspect-next", "looks into the vertex that the run visits next"}, {0, 0}, [&state, &host](Arguments) {
    const auto session = session_of(host);
    open_at(state, *session, next_vertex(*session), true);
  });
  table.add({"inspect-worst", "inspect-worst", "looks into the worst element that smoothing can change, at its worst free corner"}, {0, 0},
            [&state, &host](Arguments) {
              const auto session = session_of(host);
              const Index element = worst_movable_element(*session);
              if (element == kNoIndex) throw UsageError("no vertex of this mesh may move");
              open_at_element(state, *session, element);
            });
}

void add_level_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"level", "level next|back|all|N", "shows a level's candidates; next after the last one applies the move"}, {1, 1},
            [&state, &host](Arguments words) {
              const auto session = session_of(host);
              follow_pick(state);
              state.inspection.playing = false;
              if (words[0] == "next") {
                next_level(state, host, *session);
              } else if (words[0] == "back") {
                previous_level(state, host, *session);
              } else {
                set_level(state, *session, words[0]);
              }
            });
  table.add({"play-levels", "play-levels [on|off|toggle]", "shows level after level, then applies the move"}, {0, 1},
            [&state, &host](Arguments words) {
              (void)session_of(host);
              follow_pick(state);
              state.inspection.playing = switched(words, 0, state.inspection.playing);
              state.inspection.level_since = -1.0;
            });
  table.add({"apply-move", "apply-move", "visits the inspected vertex: the run's own step when it is its turn"}, {0, 0},
            [&state, &host](Arguments) {
              const auto session = session_of(host);
              follow_pick(state);
              apply_move(state, host, *session);
            });
}

void add_slice_command(CommandTable& table, ViewState& state, const CommandHost& host) {
  table.add({"grid-slice", "grid-slice x|y|z|N|next|back|best",
             "of a volume's grid the slice that the maps show: its axis, its number, or of each level the one chosen from"},
            {1, 1}, [&state, &host](Arguments words) {
              const auto session = session_of(host);
              if (!session->input->in_space()) throw UsageError("the grids of a planar mesh have no slices");
              follow_pick(state);
              InspectionState& inspection = state.inspection;
              const std::string& word = words[0];
              if (word == "x" || word == "y" || word == "z") {
                inspection.slice_axis = word[0] - 'x';
                return;
              }
              if (word == "best") {
                inspection.slice.reset();
                return;
              }
              if (!inspection.open || inspection.vertex == kNoIndex) throw UsageError("no vertex is looked into");
              const Inspection look = inspect(*session, inspection.vertex);
              if (look.level_count() == 0)
                throw UsageError(look.visit() == nullptr ? look.trouble : "this vertex is fixed: it has no grid");
              const int level = std::clamp(inspection.level, 1, static_cast<int>(look.level_count()));
              const GridSlice shown = shown_slice(inspection, look, level);
              if (word == "next" || word == "back") {
                inspection.slice = std::clamp(shown.number + (word == "next" ? 1 : -1), 0, shown.points - 1);
                return;
              }
              const std::uint64_t number = to_count(word);
              if (number < 1 || number > static_cast<std::uint64_t>(shown.points))
                throw UsageError(fmt::format("there is no slice {}: the grid has 1 to {}", number, shown.points));
              inspection.slice = static_cast<int>(number) - 1;
            });
}

void add_trace_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  const auto traced = [&state, &host] {
    const auto session = session_of(host);
    follow_pick(state);
    if (!state.inspection.open || state.inspection.vertex == kNoIndex) throw UsageError("no vertex is looked into");
    Inspection look = inspect(*session, state.inspection.vertex);
    if (look.visit() == nullptr) throw UsageError(look.trouble);
    return look;
  };
  table.add(
      {"copy-level", "copy-level [N]", "puts the candidates of a level on the clipboard as CSV; without N of the shown one, 0: of all"},
      {0, 1}, [&state, traced](Arguments words) {
        const Inspection look = traced();
        const std::uint64_t level = words.empty() ? static_cast<std::uint64_t>(state.inspection.level) : to_count(words[0]);
        if (level > look.level_count()) throw UsageError(fmt::format("there is no level {}: this visit has {}", level, look.level_count()));
        state.requests.clipboard = trace_csv(look, static_cast<int>(level));
      });
  table.add({"export-trace", "export-trace FILE.csv", "writes all candidates of all levels of the inspected vertex"}, {1, 1},
            [&state, traced](Arguments words) {
              write_file_atomically(words[0], trace_csv(traced()));
              add_message(state, {Message::Kind::Info, fmt::format("wrote {}", words[0])});
            });
}

}  // namespace

void close_inspection(ViewState& state) {
  leave_close_up(state);
  state.inspection.open = state.inspection.playing = state.inspection.applied = false;
}

bool leaves_inspection(std::string_view line) {
  constexpr std::array<std::string_view, 4> kLong{"until-converged", "make-good", "each until-converged", "compare "};
  return std::ranges::any_of(kLong, [&](std::string_view begin) { return line.starts_with(begin); });
}

void add_inspection_commands(CommandTable& table, ViewState& state, const CommandHost& host) {
  add_opening_commands(table, state, host);
  add_level_commands(table, state, host);
  add_slice_command(table, state, host);
  add_trace_commands(table, state, host);
}

LevelTurn play_levels(ViewState& state, bool busy, double now) {
  InspectionState& inspection = state.inspection;
  if (!inspection.playing) return {};
  if (busy) return {{}, kBusyTime};
  if (inspection.level_since < 0.0) {
    const bool shown = inspection.open && inspection.vertex != kNoIndex && !inspection.applied;
    return {shown ? "level 1" : "level next", kLevelTime};
  }
  const double rest = inspection.level_since + kLevelTime - now;
  return rest > 0.0 ? LevelTurn{{}, rest} : LevelTurn{"level next", kLevelTime};
}

}  // namespace dmoscope::ui
