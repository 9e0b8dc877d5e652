#include "ui/analysis/inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/drawing/ticks.h"
#include "core/mesh/element_edges.h"
#include "core/quality/quality.h"
#include "core/reference/domain.h"
#include "core/run/sweep_after.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope::ui {
namespace {

constexpr int kFieldSamples = 96;  // samples of the field per axis
constexpr int kFieldLines = 9;     // approximate number of contours

const RunView* active_run(const SessionView& session) {
  return session.active < session.runs.size() ? &session.runs[session.active] : nullptr;
}

bool is_free(const RunView& run, Index vertex) { return vertex < run.fixed.size() && run.fixed[vertex] == 0; }

Inspection::Key key_of(const SessionView& session, Index vertex) {
  const RunView* run = active_run(session);
  const Frame* frame = session.frame.get();
  if (run == nullptr || frame == nullptr) return {};
  return {frame->input_serial,    frame->serial,          session.active,        vertex,
          run->parameters.metric, run->parameters.search, run->parameters.method};
}

/// The sweep that visits of the frame belong to; the frame may be a mark, and the run at another moment. Throws UsageError when it is no
/// longer known.
Sweep sweep_of(const RunView& run, const Moment& shown, const InputMesh& input) {
  if (shown == run.moment) return run.sweep;
  if (shown.iteration >= run.records.size())
    throw UsageError("The run no longer has a record of this iteration, nor of the minimum that its visits must keep.");
  return sweep_after(run.records.whole(), shown.iteration, {run.phases.mean_since, run.parameters.mean}, input.has_strays);
}

/// Task of the run's smoother, except for the order of its visits.
SmoothingTask task_of(const RunView& run, const Frame& frame) {
  const RunParameters& p = run.parameters;
  SmoothingTask task;
  task.method = method_info(p.method).searches_grid ? std::string_view(p.method) : "dmo";  // other methods show what dmo would do
  task.input = frame.input;
  task.metric = p.metric;
  task.search = p.search;
  task.options = p.options;
  task.combination = p.combination;
  task.aim = run.aim;
  task.guard = run.guard;
  task.then_mean = p.then_mean.has_value();
  task.slides = lets_slide(*frame.input, p.standing());
  task.domain = run.domain;
  task.max_deviation = p.max_deviation * frame.input->geometry.size;
  return task;
}

/// Edges of the star, each once.
std::vector<std::array<Index, 2>> edges_of(const InputMesh& input, Index vertex) {
  std::vector<std::array<Index, 2>> edges;
  for (const Incidence& incidence : input.topology.star(vertex))
    for_edges(input.mesh.elements, incidence.element, [&](Index a, Index b) { edges.push_back({std::min(a, b), std::max(a, b)}); });
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// Gathers edges and corners of the star, relative to the vertex.
void gather_star(Inspection& inspection, const Frame& frame, Index vertex) {
  const InputMesh& input = *frame.input;
  const Vec3 origin = frame.positions[vertex];
  const ScenePoints points = ScenePoints::of(input);
  const auto away = [&](Index v) { return points.way(frame.positions[v], origin); };
  for (const Incidence& incidence : input.topology.star(vertex))
    for (const Index corner : input.mesh.elements.corners(incidence.element))
      if (corner != vertex) inspection.corners.push_back(corner);
  std::vector<Index>& corners = inspection.corners;
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const Index corner : corners) inspection.corners_at.push_back(frame.positions[corner]);
  inspection.origin = points.at(origin);
  for (const auto& [a, b] : edges_of(input, vertex)) inspection.edges.push_back({away(a), away(b)});
  inspection.box.include(Vec3{});
  for (const Index corner : corners) inspection.box.include(away(corner));
}

/// Adds lines at round values between the least and the greatest quality of the valid region.
void add_lines(FieldPicture& picture) {
  const QualityField& field = picture.field;
  std::vector<float> valid = field.quality;
  picture.lowest = std::numeric_limits<double>::infinity();
  picture.highest = -picture.lowest;
  for (std::size_t k = 0; k < valid.size(); ++k) {
    if (!(field.jacobian[k] > 0.0F)) valid[k] = std::numeric_limits<float>::quiet_NaN();
    if (std::isnan(valid[k])) continue;
    picture.lowest = std::min(picture.lowest, static_cast<double>(valid[k]));
    picture.highest = std::max(picture.highest, static_cast<double>(valid[k]));
  }
  picture.outline = contour(field.jacobian, field.columns, field.rows, 0.0);
  if (!(picture.highest > picture.lowest)) return;
  for (const Tick& tick : linear_ticks(picture.lowest, picture.highest, kFieldLines)) {
    if (tick.value <= picture.lowest || tick.value >= picture.highest) continue;
    picture.lines.push_back({tick.value, contour(valid, field.columns, field.rows, tick.value)});
  }
}

/// Box of the star and the grids.
render::Bounds2 box_of(const Inspection& inspection) {
  render::Bounds2 box{{inspection.box.low.x, inspection.box.low.y}, {inspection.box.high.x, inspection.box.high.y}};
  for (const TracedLevel& level : inspection.trace->levels) {
    const Vec2<double> half{level.size.x / 2, level.size.y / 2};
    box.include(level.centre - half);
    box.include(level.centre + half);
  }
  return box;
}
render::Bounds2 box_in(const StarSlice& slice, const Inspection& inspection) {
  render::Bounds2 box;
  box.include(slice.project(inspection.box.low));
  box.include(slice.project(inspection.box.high));
  for (const VolumeLevel& level : inspection.solid->levels) {
    box.include(slice.project(level.centre - 0.5 * level.size));
    box.include(slice.project(level.centre + 0.5 * level.size));
  }
  return box;
}
double along(int axis, Vec3 p) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Samples the field over the box of the star and the first grid, with a margin. The vertex may have moved since.
void sample_field(Inspection& inspection, const SessionView& session) {
  const Frame& frame = *session.frame;
  const bool volume = inspection.solid.has_value();
  const StarSlice& slice = inspection.field_slice;
  const auto flat = [&](Vec3 p) { return volume ? slice.project(p) : frame.input->geometry.plane.project(p); };
  const render::Bounds2 box = volume ? box_in(slice, inspection) : box_of(inspection);
  const double margin = 0.06 * std::max(box.size().x, box.size().y);
  Vec2<double> low{box.low.x - margin, box.low.y - margin}, high{box.high.x + margin, box.high.y + margin};
  const double longest = std::max(high.x - low.x, high.y - low.y);
  if (!(longest > 0.0)) return;
  const auto samples = [longest](double length) {
    return std::max(8, static_cast<int>(std::lround(static_cast<double>(kFieldSamples) * length / longest)));
  };
  const Index vertex = inspection.key.vertex;
  const Vec3 moved_in_space = frame.input->geometry.plane.difference(frame.positions[vertex], inspection.visit()->from);
  const Vec2<double> moved = flat(moved_in_space);
  const int columns = samples(high.x - low.x), rows = samples(high.y - low.y);
  FieldPicture picture;
  if (volume) {
    const StarSlice now{slice.axis, slice.offset - along(slice.axis, moved_in_space)};
    picture.field =
        sample_slice(*frame.input, frame.positions, inspection.key.metric, vertex, now, low - moved, high - moved, columns, rows);
  } else {
    picture.field = sample_quality(*frame.input, frame.positions, inspection.key.metric, vertex, low - moved, high - moved, columns, rows);
  }
  picture.field.low = low;
  picture.field.high = high;
  add_lines(picture);
  inspection.field = std::move(picture);
}

/// Whether the frame shows the applied move, or the move is still to come, and nothing else of the star has moved.
bool still_applied(const Inspection& inspection, const SessionView& session, bool busy) {
  const Frame& frame = *session.frame;
  Inspection::Key key = key_of(session, inspection.key.vertex);
  key.frame_serial = inspection.key.frame_serial;
  const VisitSummary* visit = inspection.visit();
  if (visit == nullptr || !(key == inspection.key) || !no_inspection(session).empty()) return false;
  for (std::size_t k = 0; k < inspection.corners.size(); ++k) {
    if (!(frame.positions[inspection.corners[k]] == inspection.corners_at[k])) return false;
  }
  const Vec3 now = frame.positions[key.vertex];
  return now == visit->to || (busy && now == visit->from);
}

std::optional<std::pair<double, double>> range_of(const LevelValues& level, bool valid) {
  std::optional<std::pair<double, double>> range;
  for (const double q : level.quality) {
    if (is_valid(q) != valid) continue;
    range = range ? std::pair{std::min(range->first, q), std::max(range->second, q)} : std::pair{q, q};
  }
  return range;
}

/// Resets everything except the choices of display.
void forget(InspectionState& state) {
  InspectionState closed;
  closed.zoom = state.zoom;
  closed.field = state.field;
  closed.field_in_view = state.field_in_view;
  closed.own_range = state.own_range;
  closed.slice_axis = state.slice_axis;
  closed.alone = state.alone;
  closed.playing = state.playing;
  state = closed;
}

/// The plane of a volume in which the quality is shown: that of the shown level's slice; without a level through the vertex's old place, or
/// after its move through the new one.
StarSlice field_plane(const InspectionState& state, const Inspection& inspection) {
  const int axis = state.slice_axis;
  if (state.applied) return {axis, along(axis, inspection.solid->step)};
  if (state.level < 1 || inspection.solid->levels.empty()) return {axis, 0.0};
  const VolumeLevel& level = inspection.solid->levels[static_cast<std::size_t>(state.level - 1)];
  return {axis, along(axis, level.at(shown_slice(state, inspection, state.level).index(0, 0)))};
}

}  // namespace

std::string no_inspection(const SessionView& session) {
  const RunView* run = active_run(session);
  if (run == nullptr || session.frame == nullptr) return "no mesh is open";
  if (session.frame->device) return "The run is working on its device. Its visits can be inspected once it pauses.";
  return {};
}

Inspection inspect(const SessionView& session, Index vertex) {
  Inspection inspection;
  inspection.key = key_of(session, vertex);
  inspection.trouble = no_inspection(session);
  if (!inspection.trouble.empty()) return inspection;
  const Frame& frame = *session.frame;
  const RunView& run = *active_run(session);
  if (vertex >= frame.vertex_count() || frame.input->topology.star(vertex).empty()) {
    inspection.trouble = "This vertex belongs to no element: nothing moves it.";
    return inspection;
  }
  const bool slides = run.fixed[vertex] == 0 && run.domain != nullptr && run.domain->slides(vertex);
  if (slides && !run.domain->on_surface(vertex)) {
    inspection.trouble = "This vertex slides along a curve: its candidates lie on a line, not on a grid.";
    return inspection;
  }
  if (frame.input->is_surface() && !slides) {
    const std::string_view why = run.domain != nullptr ? run.domain->why_held(vertex) : std::string_view();
    inspection.trouble = fmt::format("This vertex is fixed{}{}.", why.empty() ? "" : ": ", why);
    return inspection;
  }
  try {
    gather_star(inspection, frame, vertex);
    const Sweep sweep = sweep_of(run, frame.moment, *frame.input);
    const auto composite = composite_objective_of_visit(run.parameters.metric, run.parameters.combination, run.aim, sweep, run.guard);
    if (!composite && !method_info(run.parameters.method).searches_grid) inspection.other_method = run.parameters.method;
    if (slides) {
      SurfaceVisit visit = trace_surface_visit(task_of(run, frame), frame.positions, vertex, sweep, composite);
      inspection.trace = std::move(visit.trace);
      inspection.grid = std::move(visit.grid);
      return inspection;
    }
    const auto trace = [&](auto traced) {
      return traced(*frame.input, frame.positions, run.fixed, run.parameters.metric, run.parameters.search, vertex, composite,
                    sweep.untangling, run.guard);
    };
    if (frame.input->is_volume()) {
      inspection.solid = trace(trace_volume_visit);
      return inspection;
    }
    inspection.trace = trace(trace_visit);
    if (!composite) inspection.optimum = local_optimum(*frame.input, frame.positions, run.parameters.metric, vertex);
  } catch (const Error& error) {
    inspection.trace.reset();
    inspection.grid.reset();
    inspection.solid.reset();
    inspection.trouble = error.what();
  }
  return inspection;
}

void refresh(Inspection& inspection, ViewState& state, const SessionView& session, bool busy) {
  InspectionState& wanted = state.inspection;
  if (!wanted.open || session.frame == nullptr) {
    forget(wanted);
    inspection = {};
    return;
  }
  if (state.picked.kind == Picked::Kind::Vertex && state.picked.id != wanted.vertex) {
    wanted.vertex = state.picked.id;
    wanted.note.clear();
    wanted.applied = wanted.playing = wanted.in_order = false;
    wanted.level = std::min(wanted.level, 1);
  }
  if (wanted.vertex >= session.frame->vertex_count()) {
    wanted.vertex = kNoIndex;
    inspection = {};
    return;
  }
  if (wanted.applied && !still_applied(inspection, session, busy)) {
    wanted.applied = wanted.playing = false;
    wanted.level = std::min(wanted.level, 1);
  }
  if (!wanted.applied && !(inspection.key == key_of(session, wanted.vertex))) inspection = inspect(session, wanted.vertex);
  if (inspection.visit() == nullptr) return;
  wanted.level = std::clamp(wanted.level, 0, static_cast<int>(inspection.level_count()));
  if (inspection.solid) {
    const StarSlice plane = field_plane(wanted, inspection);
    if (!(plane == inspection.field_slice)) inspection.field.reset();
    inspection.field_slice = plane;
  }
  if (inspection.grid) return;  // a surface has no field around the vertex
  const bool wants_field = wanted.field || (wanted.field_in_view && inspection.trace);
  if (wants_field && !inspection.field) sample_field(inspection, session);
}

Index next_vertex(const SessionView& session) {
  const RunView* run = active_run(session);
  if (run == nullptr || session.frame == nullptr) throw UsageError("no mesh is open");
  if (!run->colouring || run->colouring->order.empty()) throw UsageError("no vertex of this mesh may move");
  const std::vector<Index>& order = run->colouring->order;
  return order[run->moment.visits % order.size()];
}

Index worst_free_corner(const SessionView& session, Index element) {
  const RunView* run = active_run(session);
  if (run == nullptr || session.frame == nullptr) throw UsageError("no mesh is open");
  const Frame& frame = *session.frame;
  Index worst = kNoIndex;
  std::pair<double, double> value{};  // quality now, and minus the quality after the visit: the least pair is the worst
  for (const Index corner : frame.input->mesh.elements.corners(element)) {
    if (!is_free(*run, corner)) continue;
    if (frame.device) return corner;
    const Inspection look = inspect(session, corner);
    const VisitSummary* visit = look.visit();
    const std::pair mine = visit != nullptr ? std::pair{visit->before.quality, -visit->after.quality}
                                            : std::pair{vertex_quality(frame.input->quality_context(), frame.input->topology,
                                                                       frame.positions, run->parameters.metric, corner),
                                                        0.0};
    if (worst == kNoIndex || mine < value) {
      worst = corner;
      value = mine;
    }
  }
  return worst;
}

Index worst_movable_element(const SessionView& session) {
  const RunView* run = active_run(session);
  if (run == nullptr || session.frame == nullptr) throw UsageError("no mesh is open");
  const Frame& frame = *session.frame;
  if (frame.device) throw UsageError(no_inspection(session));
  const ElementTable& elements = frame.input->mesh.elements;
  const auto movable = [&](Index element) {
    const auto corners = elements.corners(element);
    return std::any_of(corners.begin(), corners.end(), [&](Index corner) { return is_free(*run, corner); });
  };
  for (const RankedElement& ranked : frame.worst) {
    if (movable(ranked.element)) return ranked.element;
  }
  Index worst = kNoIndex;
  for (Index e = 0; e < frame.element_count(); ++e) {
    if (!std::isnan(frame.quality[e]) && (worst == kNoIndex || frame.quality[e] < frame.quality[worst]) && movable(e)) worst = e;
  }
  return worst;
}

GridSlice shown_slice(const InspectionState& state, const Inspection& inspection, int level) {
  const LevelValues& values = inspection.level(level);
  GridSlice slice{values.points, {}, 0};
  if (!inspection.solid) return slice;
  slice.axis = state.slice_axis;
  slice.number = values.points / 2;
  if (values.best) slice.number = slice.along(*values.best);
  if (state.slice) slice.number = std::clamp(*state.slice, 0, values.points - 1);
  return slice;
}

bool is_valid(double quality) { return quality > 0.0; }

std::optional<std::pair<double, double>> valid_range(const LevelValues& level) { return range_of(level, true); }
std::optional<std::pair<double, double>> invalid_range(const LevelValues& level) { return range_of(level, false); }

double part_of(const std::optional<std::pair<double, double>>& range, double quality) {
  if (!range || !(range->second > range->first)) return 1.0;
  return std::clamp((quality - range->first) / (range->second - range->first), 0.0, 1.0);
}

double least_spacing(const TracedLevel& level) {
  constexpr double kLine = 1e-3;  // narrower than this share of its length
  const double longer = std::max(level.size.x, level.size.y), shorter = std::min(level.size.x, level.size.y);
  return (shorter > kLine * longer ? shorter : longer) / std::max(1, level.points - 1);
}

}  // namespace dmoscope::ui
