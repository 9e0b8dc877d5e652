#include "ui/inspection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/error.h"
#include "core/drawing/ticks.h"
#include "core/quality/quality.h"

namespace dmoscope::ui {
namespace {

constexpr int kFieldSamples = 96;  // an axis
constexpr int kFieldLines = 9;     // about so many contours

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

/// What visits of the frame are part of: it may be a mark, and the run stand elsewhere. Throws UsageError when that is not known any more.
Sweep sweep_of(const RunView& run, const Moment& shown) {
  if (shown == run.moment) return run.sweep;
  if (!run.mean_since || *run.mean_since > shown.iteration) return {shown.iteration};
  if (shown.iteration >= run.records.size())
    throw UsageError("The run has no record of this iteration any more, nor the floor that its visits keep to.");
  return {shown.iteration, run.records[shown.iteration].statistics.movable_minimum};
}

/// Edges and corners of the star, relative to the vertex.
void gather_star(Inspection& inspection, const Frame& frame, Index vertex) {
  const InputMesh& input = *frame.input;
  const Vec3 origin = frame.positions[vertex];
  const auto relative = [&](Index v) { return input.geometry.plane.project(frame.positions[v] - origin); };
  inspection.origin = input.geometry.plane.project(origin);
  std::vector<std::array<Index, 2>> edges;
  for (const Incidence& incidence : input.topology.star(vertex)) {
    const auto corners = input.mesh.elements.corners(incidence.element);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Index a = corners[k], b = corners[(k + 1) % corners.size()];
      edges.push_back({std::min(a, b), std::max(a, b)});
      if (a != vertex) inspection.corners.push_back(a);
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) inspection.edges.push_back({relative(a), relative(b)});
  std::vector<Index>& corners = inspection.corners;
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  inspection.box.include(Vec2<double>{0, 0});
  for (const Index corner : corners) {
    inspection.corners_at.push_back(frame.positions[corner]);
    inspection.box.include(relative(corner));
  }
}

/// Round values between the least and the greatest quality of the valid region.
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

/// Of the star's box and the first grid's, with a margin. The vertex may stand elsewhere by now.
void sample_field(Inspection& inspection, const SessionView& session) {
  const Frame& frame = *session.frame;
  render::Bounds2 box = inspection.box;
  for (const TracedLevel& level : inspection.trace->levels) {
    const Vec2<double> half{level.size.x / 2, level.size.y / 2};
    box.include(level.centre - half);
    box.include(level.centre + half);
  }
  const double margin = 0.06 * std::max(box.size().x, box.size().y);
  Vec2<double> low{box.low.x - margin, box.low.y - margin}, high{box.high.x + margin, box.high.y + margin};
  const double longest = std::max(high.x - low.x, high.y - low.y);
  if (!(longest > 0.0)) return;
  const auto samples = [longest](double length) {
    return std::max(8, static_cast<int>(std::lround(static_cast<double>(kFieldSamples) * length / longest)));
  };
  const Index vertex = inspection.key.vertex;
  const Vec2<double> moved = frame.input->geometry.plane.project(frame.positions[vertex] - inspection.trace->from);
  FieldPicture picture;
  picture.field = sample_quality(*frame.input, frame.positions, inspection.key.metric, vertex, low - moved, high - moved,
                                 samples(high.x - low.x), samples(high.y - low.y));
  picture.field.low = low;
  picture.field.high = high;
  add_lines(picture);
  inspection.field = std::move(picture);
}

/// The move that was applied is what the frame shows, or has not come yet, and nothing else of the star has moved.
bool still_applied(const Inspection& inspection, const SessionView& session, bool busy) {
  const Frame& frame = *session.frame;
  Inspection::Key key = key_of(session, inspection.key.vertex);
  key.frame_serial = inspection.key.frame_serial;
  if (!inspection.trace || !(key == inspection.key) || !no_inspection(session).empty()) return false;
  for (std::size_t k = 0; k < inspection.corners.size(); ++k) {
    if (!(frame.positions[inspection.corners[k]] == inspection.corners_at[k])) return false;
  }
  const Vec3 now = frame.positions[key.vertex];
  return now == inspection.trace->to || (busy && now == inspection.trace->from);
}

std::optional<std::pair<double, double>> range_of(const TracedLevel& level, bool valid) {
  std::optional<std::pair<double, double>> range;
  for (const double q : level.quality) {
    if (is_valid(q) != valid) continue;
    range = range ? std::pair{std::min(range->first, q), std::max(range->second, q)} : std::pair{q, q};
  }
  return range;
}

/// All but the wishes of how things are shown.
void forget(InspectionState& state) {
  InspectionState closed;
  closed.zoom = state.zoom;
  closed.field = state.field;
  closed.field_in_view = state.field_in_view;
  closed.own_range = state.own_range;
  closed.playing = state.playing;
  state = closed;
}

}  // namespace

std::string no_inspection(const SessionView& session) {
  const RunView* run = active_run(session);
  if (run == nullptr || session.frame == nullptr) return "no mesh is open";
  if (session.frame->device) return "The run is at work on its device. When it rests, its visits can be looked into.";
  if (session.input->geometry.shape != Shape::Planar) return "Only visits in a planar mesh can be looked into.";
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
    inspection.trouble = "This vertex is of no element: nothing moves it.";
    return inspection;
  }
  try {
    gather_star(inspection, frame, vertex);
    const auto aims = aims_of_visit(run.parameters.metric, run.parameters.combination, run.size, sweep_of(run, frame.moment));
    if (!aims && !method_info(run.parameters.method).searches_grid) inspection.other_method = run.parameters.method;
    inspection.trace = trace_visit(*frame.input, frame.positions, run.fixed, run.parameters.metric, run.parameters.search, vertex, aims);
    if (!aims) inspection.optimum = local_optimum(*frame.input, frame.positions, run.parameters.metric, vertex);
  } catch (const Error& error) {
    inspection.trace.reset();
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
  if (inspection.trace) wanted.level = std::clamp(wanted.level, 0, static_cast<int>(inspection.trace->levels.size()));
  const bool wants_field = wanted.field || wanted.field_in_view;
  if (wants_field && inspection.trace && !inspection.field) sample_field(inspection, session);
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
  std::pair<double, double> value{};  // quality now, and minus the quality after the visit: the least is wanted
  for (const Index corner : frame.input->mesh.elements.corners(element)) {
    if (!is_free(*run, corner)) continue;
    if (frame.device) return corner;
    const Inspection look = inspect(session, corner);
    const std::pair mine = look.trace ? std::pair{look.trace->before.quality, -look.trace->after.quality}
                                      : std::pair{vertex_quality(frame.input->quality_context(), frame.input->topology, frame.positions,
                                                                 run->parameters.metric, corner),
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

bool is_valid(double quality) { return quality > 0.0; }

std::optional<std::pair<double, double>> valid_range(const TracedLevel& level) { return range_of(level, true); }
std::optional<std::pair<double, double>> invalid_range(const TracedLevel& level) { return range_of(level, false); }

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
