#include "ui/analysis/step_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/input/input_mesh.h"
#include "ui/state/format.h"

namespace dmoscope::ui {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();

bool same_place(const Vec3& a, const Vec3& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

/// Approximate length of a vertex's edges.
double edge_of(const Frame& frame, Index vertex) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const Incidence& incidence : frame.input->topology.star(vertex))
    for (const Index corner : frame.input->mesh.elements.corners(incidence.element)) {
      if (corner == vertex) continue;
      sum += length(frame.input->geometry.plane.difference(frame.positions[corner], frame.positions[vertex]));
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

float worst_around(const Frame& frame, Index vertex) {
  float worst = INFINITY;
  for (const Incidence& incidence : frame.input->topology.star(vertex)) worst = std::fmin(worst, frame.quality[incidence.element]);
  return worst;
}

/// Change of a value: "minimum 0.312 → 0.498", "minimum 0.312 (unchanged)".
std::string course(const char* what, double before, double after) {
  const std::string from = short_number(before), to = short_number(after);
  return from == to ? fmt::format("{} {} (unchanged)", what, to) : fmt::format("{} {} → {}", what, from, to);
}

std::string gains(const Frame& before, const Frame& after) {
  const Statistics &was = before.shown_statistics, &is = after.shown_statistics;
  std::string text = course("minimum", was.minimum, is.minimum);
  if (was.inverted != is.inverted) text += fmt::format("; inverted {} → {}", count(was.inverted), count(is.inverted));
  return text;
}

std::string way_of(const Frame& before, const Frame& after, Index vertex) {
  const double way = length(after.input->geometry.plane.difference(after.positions[vertex], before.positions[vertex]));
  const double edge = edge_of(before, vertex);
  return edge > 0.0 ? fmt::format("{:.2g} % of its mean edge", 100.0 * way / edge) : short_number(way);
}

std::string of_one(const Frame& before, const Frame& after, Index vertex) {
  return fmt::format(
      "vertex {} moved by {}; {}; {}", vertex, way_of(before, after, vertex),
      course("its worst element", static_cast<double>(worst_around(before, vertex)), static_cast<double>(worst_around(after, vertex))),
      gains(before, after));
}

std::uint64_t visits_between(const Moment& before, const Moment& after, std::uint64_t each) {
  return (after.iteration - before.iteration) * each + after.visits - before.visits;
}

/// Name of a step: "iteration 3", "class 2 of 7", "12 visits".
std::string step_name(const Moment& before, const Moment& after, const RunView& run) {
  if (after.edits > before.edits && after.iteration == before.iteration && after.visits == before.visits) return "edit";
  const std::uint64_t visits = visits_between(before, after, run.visits_per_iteration);
  if (before.is_iteration_end() && after.is_iteration_end()) {
    const std::uint64_t iterations = after.iteration - before.iteration;
    return iterations == 1 ? fmt::format("iteration {}", count(after.iteration)) : counted(iterations, "iteration", "iterations");
  }
  if (run.colouring) {
    const auto& offsets = run.colouring->class_offsets;
    const std::uint64_t end = after.visits == 0 ? run.visits_per_iteration : after.visits;
    const auto at = std::ranges::find(offsets, end, [](Index offset) { return std::uint64_t{offset}; });
    if (at != offsets.end() && at != offsets.begin() && end - visits >= *(at - 1) && end >= visits && visits > 1)
      return fmt::format("class {} of {}", at - offsets.begin(), run.colouring->class_count());
  }
  return counted(visits, "visit", "visits");
}

/// The vertex that a step visited and that stayed, if the step was a single visit.
std::optional<Index> visited(const Moment& before, const Moment& after, const RunView& run) {
  if (!run.colouring || after.edits != before.edits || visits_between(before, after, run.visits_per_iteration) != 1) return std::nullopt;
  const std::uint64_t at = (after.visits == 0 ? run.visits_per_iteration : after.visits) - 1;
  return at < run.colouring->order.size() ? std::optional(run.colouring->order[at]) : std::nullopt;
}

/// Sets the present strength of the flash. Returns when it will change.
double fade(SteppingState& stepping, double now) {
  constexpr double kFading = 0.7;  // seconds
  const StepNews& news = stepping.news;
  const bool any = !news.moved.empty() || news.vertex != kNoIndex;
  stepping.flash_level = stepping.flash == Flash::Hold && any ? kFlashLevels : 0;
  if (stepping.flash != Flash::On || !any) return kForever;
  const double age = now - news.since, each = kFading / kFlashLevels;
  stepping.flash_level = std::clamp(kFlashLevels - static_cast<int>(std::ceil(age / each)), 0, kFlashLevels);
  if (stepping.flash_level == 0) return kForever;
  return std::max(0.01, each - std::fmod(age, each));
}

/// Report on the step from one moment of a run to a later one, both whole frames of one input by one metric; none if they are not. `run`:
/// its state at the later one.
std::optional<StepNews> report_step(const Frame& before, const Frame& after, const RunView& run) {
  const bool comparable = !before.device && !after.device && before.input == after.input && before.shown == after.shown &&
                          before.positions.size() == after.positions.size() && before.quality.size() == after.quality.size();
  if (!comparable || !(before.moment < after.moment)) return std::nullopt;
  StepNews news;
  for (Index v = 0; v < after.positions.size(); ++v)
    if (!same_place(before.positions[v], after.positions[v])) news.moved.push_back(v);
  const auto one = visited(before.moment, after.moment, run);
  if (news.moved.size() == 1) {
    news.sentence = of_one(before, after, news.moved.front());
  } else if (news.moved.empty() && one) {
    news.vertex = *one;
    news.sentence = fmt::format("vertex {} stays: no place is better; {}", *one, gains(before, after));
  } else {
    const double was = before.shown_statistics.mean, is = after.shown_statistics.mean;
    news.sentence = fmt::format("{}: {}; {}; {} of {} moved", step_name(before.moment, after.moment, run), gains(before, after),
                                course("mean", was, is), count(news.moved.size()), counted(run.free_vertices, "vertex", "vertices"));
  }
  return news;
}

}  // namespace

bool has_converged(const RunView& run) { return run.last_outcome.starts_with("converged"); }

std::string end_sentence(const RunView& run) {
  const std::string why = capitalised(run.last_outcome.substr(0, run.last_outcome.find_first_of(":;")));
  const IterationRecord *first = nullptr, *now = nullptr;
  double seconds = 0.0;
  std::uint64_t done = 0;
  for (const IterationRecord& record : run.records) {
    if (first == nullptr) first = &record;
    if (record.iteration == run.moment.iteration) now = &record;
    seconds += record.seconds;
    done = record.iteration;
  }
  if (now == nullptr) return why;
  return fmt::format("{}: {}, {}, {}", why, course("minimum", first->statistics.minimum, now->statistics.minimum),
                     counted(done, "iteration", "iterations"), duration(seconds));
}

double StepWatch::follow(ViewState& state, const SessionView& session, bool busy, double now) {
  SteppingState& stepping = state.stepping;
  const auto& frame = session.frame;
  if (!frame || session.active >= session.runs.size()) {
    rest_.reset();
    stepping.news = {};
  } else if (!busy && !frame->device && (rest_ != frame || outcome_ != session.runs[session.active].last_outcome)) {
    const RunView& run = session.runs[session.active];
    const bool same_run = rest_ && rest_->input == frame->input && run_ == run.id;
    const bool ended = same_run && outcome_ != run.last_outcome && has_converged(run);
    if (!same_run || ended || rest_->moment != frame->moment) {
      auto news = same_run ? report_step(*rest_, *frame, run) : std::nullopt;
      // The step's own message comes before the sentence found here, except that the reason for its end is told shorter.
      const auto& said = state.result.newest();
      const bool spoken = messages_ != state.messages && !(ended && said && said->kind == Message::Kind::Info);
      stepping.news = news ? std::move(*news) : StepNews{};
      if (ended) stepping.news.sentence = end_sentence(run);
      if (spoken) stepping.news.sentence.clear();
      stepping.news.before = rest_;
      stepping.news.messages = state.messages;
      stepping.news.since = now;
      stepping.news.serial = frame->serial;
    }
    rest_ = frame;
    run_ = run.id;
    outcome_ = run.last_outcome;
    messages_ = state.messages;
  }
  if (!busy && rest_ && rest_ == frame) messages_ = state.messages;
  return fade(stepping, now);
}

}  // namespace dmoscope::ui
