#include "core/view/frame_builder.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/session/session_standing.h"

namespace dmoscope {

namespace {

/// Takes the device's data of the run's present state, if the run lives on one. False: they must come from the host.
bool take_picture(Frame& frame, const Run& run) {
  try {
    frame.device = run.picture(frame.shown);
  } catch (const DeviceError& error) {
    frame.device_trouble = error.what();
  }
  if (!frame.device) return false;
  const ElementSummary& summary = frame.device->summary();
  frame.shown_statistics = summary.statistics;
  frame.now = summary.histogram;
  frame.worst = summary.worst;
  return true;
}

RunView view_of(Run& run, bool percentiles) {
  RunView view;
  view.id = run.id();
  view.input = run.shared_input();
  view.name = run.given_name();
  view.title = run.title();
  view.parameters = run.parameters();
  view.backend = run.backend();
  view.backend_reason = run.backend_reason();
  view.moment = run.moment();
  view.pursuit = run.pursuit();
  view.sweep = run.sweep();
  view.phases = run.phases();
  if (view.moment.is_iteration_end()) view.joint = run.joint_iteration(view.moment.iteration);
  view.aim = run.place_aim();
  view.size = run.size_field();
  view.guard = run.guard();
  view.visits_per_iteration = run.visits_per_iteration();
  view.colouring = run.shared_colouring();
  view.free_vertices = static_cast<Index>(run.visits_per_iteration());
  view.fixed = run.shared_fixed();
  view.domain = run.domain();
  view.records = run.history().shared_records();
  if (percentiles) view.percentiles = run.history().shared_percentiles();
  view.edits = run.edits().all().size();
  view.edits_done = run.edits().done_by(run.moment());
  view.history_note = run.history().sentence();
  if (run.last_outcome()) view.last_outcome = run.last_outcome()->sentence();
  if (run.last_outcome() && run.last_outcome()->best) view.ended = run.last_outcome()->ended;
  view.best_iteration = best_iteration(run);
  return view;
}

}  // namespace

Frame judged(Session& session, std::size_t index) {
  const Run& run = session.run(index);
  Frame frame;
  frame.input = run.shared_input();
  frame.moment = run.moment();
  frame.shown = session.shown();
  frame.positions.assign(run.positions().begin(), run.positions().end());
  judge_elements(frame, run.immovable(), session.pool().get());
  return frame;
}

FrameBuilder::InputFacts& FrameBuilder::facts_of(Session& session, const std::shared_ptr<const InputMesh>& input) {
  auto facts = std::ranges::find(inputs_, input, &InputFacts::input);
  if (facts != inputs_.end()) return *facts;
  const auto open = session.inputs();
  std::erase_if(inputs_, [&](const InputFacts& one) { return std::ranges::find(open, one.input) == open.end(); });
  inputs_.push_back({input, ++input_serial_, {}});
  return inputs_.back();
}

/// Spread of the shown metric over the input; null if it is not known and `detail` leaves no time for it.
std::shared_ptr<const InputSpread> FrameBuilder::spread_at(Session& session, InputFacts& facts, FrameDetail detail) {
  const auto known = facts.before.find(session.shown());
  if (known != facts.before.end()) return known->second;
  if (detail == FrameDetail::Quick) return nullptr;
  auto spread = std::make_shared<const InputSpread>(spread_of(*facts.input, session.shown(), session.pool().get()));
  facts.before.emplace(session.shown(), spread);
  return spread;
}

bool FrameBuilder::FrameKey::is(const FrameKey& other) const {
  return index == other.index && (index == Frame::kNoRun || at == other.at) && shown == other.shown && rule == other.rule;
}

FrameBuilder::FrameKey FrameBuilder::key_of(Session& session, std::size_t index) {
  return {session.standing(index), index, session.shown(), {}};
}

FrameBuilder::FrameKey FrameBuilder::key_of(Session& session, std::size_t index, std::uint64_t iteration) {
  FrameKey key = key_of(session, index);
  key.at.moment = {iteration};
  return key;
}

/// The mesh of frames with this key.
const std::shared_ptr<const InputMesh>& FrameBuilder::input_of(Session& session, const FrameKey& key) {
  return key.index == Frame::kNoRun ? session.input() : session.run(key.index).shared_input();
}

FrameBuilder::Known* FrameBuilder::find(Session& session, const FrameKey& key, FrameDetail detail) {
  const auto& input = input_of(session, key);
  const auto at = std::ranges::find_if(known_, [&](const Known& one) { return one.frame->input == input && key.is(one.key); });
  if (at == known_.end() || (at->frame->provisional && detail != FrameDetail::Quick)) return nullptr;
  at->wanted = true;
  return &*at;
}

std::shared_ptr<const Frame> FrameBuilder::keep(FrameKey key, std::shared_ptr<const Frame> frame) {
  std::erase_if(known_, [&](const Known& one) { return key.is(one.key); });
  known_.push_back({std::move(key), frame});
  return frame;
}

/// A frame with everything but its positions and what depends on them.
std::shared_ptr<Frame> FrameBuilder::begin(Session& session, const FrameKey& key, FrameDetail detail) {
  InputFacts& facts = facts_of(session, input_of(session, key));
  auto frame = std::make_shared<Frame>();
  frame->serial = ++serial_;
  frame->input_serial = facts.serial;
  frame->input = facts.input;
  frame->run = key.index;
  frame->moment = key.at.moment;
  frame->shown = key.shown;
  frame->input_spread = spread_at(session, facts, detail);
  frame->provisional = frame->input_spread == nullptr;
  if (frame->input_spread) frame->before = frame->input_spread->histogram;
  return frame;
}

std::shared_ptr<const Frame> FrameBuilder::standing(Session& session, std::size_t index, FrameDetail detail) {
  FrameKey key = key_of(session, index);
  const Known* known = find(session, key, detail);
  if (known != nullptr && (detail != FrameDetail::Whole || !known->frame->device)) return known->frame;
  const Run& run = session.run(index);
  auto frame = begin(session, key, detail);
  if (run.input().is_volume() && run.backend() != Backend::Cpu) frame->device_trouble = "volumes are drawn from the host";
  if (detail == FrameDetail::Whole || !take_picture(*frame, run)) {
    const auto positions = run.positions();
    reserve_large(frame->positions, positions.size());
    frame->positions.assign(positions.begin(), positions.end());
    judge_elements(*frame, run.immovable(), session.pool().get());
  }
  if (frame->shown == run.parameters().metric) {
    frame->statistics = frame->shown_statistics;
  } else if (detail != FrameDetail::Quick) {
    frame->statistics = run.statistics();
  } else {
    frame->provisional = true;
  }
  return keep(std::move(key), std::move(frame));
}

/// Frame of a run that is not the active one. If its device fails, the run goes on from the state on the host, once nothing runs.
WatchedFrame FrameBuilder::watch_standing(Session& session, const Watch& what, std::size_t index, FrameDetail detail) {
  try {
    return {what, standing(session, index, detail), {}};
  } catch (const DeviceError& error) {
    if (detail != FrameDetail::Whole) return {what, nullptr, error.what()};
  }
  session.run(index).recover();
  return {what, standing(session, index, detail), {}};
}

std::shared_ptr<const Frame> FrameBuilder::past(Session& session, std::size_t index, std::uint64_t iteration,
                                                std::span<const Vec3> positions, FrameDetail detail) {
  FrameKey key = key_of(session, index, iteration);
  const Run& run = session.run(index);
  auto frame = begin(session, key, detail);
  frame->positions.assign(positions.begin(), positions.end());
  judge_elements(*frame, run.immovable(), session.pool().get());
  frame->statistics = run.history().records()[iteration].statistics;
  return keep(std::move(key), std::move(frame));
}

std::shared_ptr<const Frame> FrameBuilder::input_frame(Session& session, FrameDetail detail) {
  FrameKey key;
  key.shown = session.shown();
  key.rule = session.active().parameters().standing();
  if (const Known* known = find(session, key, detail)) return known->frame;
  auto frame = begin(session, key, detail);
  frame->positions = session.input()->mesh.positions;
  const std::vector<std::uint8_t> standing = standing_vertices(*frame->input, key.rule);
  judge_elements(*frame, immovable_elements(frame->input->mesh, standing, session.pool().get()), session.pool().get());
  frame->statistics = frame->shown_statistics;
  return keep(std::move(key), std::move(frame));
}

WatchedFrame FrameBuilder::watch(Session& session, const Watch& what, FrameDetail detail) {
  if (what.run == Watch::kInput) return {what, input_frame(session, detail), {}};
  const auto place = session.place_of(what.run);
  if (!place) return {what, nullptr, "this run is no more"};
  Run& run = session.run(*place);
  if (!what.iteration || run.moment() == Moment{*what.iteration}) {
    if (*place == session.active_index()) return {what, standing(session, *place, detail), {}};
    return watch_standing(session, what, *place, detail);
  }
  const std::uint64_t iteration = *what.iteration;
  if (iteration >= run.history().records().size())
    return {what, nullptr, fmt::format("the run has not come to iteration {} yet", iteration)};
  if (const Known* known = find(session, key_of(session, *place, iteration), detail)) return {what, known->frame, {}};
  if (run.history().kept(iteration))
    return {what, past(session, *place, iteration, run.history().nearest(iteration).positions, detail), {}};
  return {what, nullptr, fmt::format("iteration {} is no longer kept: it is computed again when the runs rest", iteration)};
}

bool FrameBuilder::find_past(Session& session, std::span<const Watch> watched, const std::function<bool()>& go_on) {
  bool found = false;
  for (const Watch& what : watched) {
    const auto place = what.iteration ? session.place_of(what.run) : std::nullopt;
    if (!place || *what.iteration >= session.run(*place).history().records().size()) continue;
    if (session.run(*place).moment() == Moment{*what.iteration} || find(session, key_of(session, *place, *what.iteration))) continue;
    const auto positions = positions_at(session, session.run(*place), *what.iteration, go_on);
    if (!positions) break;
    (void)past(session, *place, *what.iteration, *positions, FrameDetail::Whole);
    found = true;
  }
  return found;
}

bool FrameBuilder::work_at_rest(Session& session, std::span<const Watch> watched, const std::function<bool()>& go_on) {
  if (!session.has_input()) return false;
  const Known* active = find(session, key_of(session, session.active_index()));
  if (active == nullptr || active->frame->device) return false;
  bool found = find_past(session, watched, go_on);
  const auto whole = [&](std::size_t run) -> const Frame* {
    const Known* known = find(session, key_of(session, run));
    return known == nullptr || known->frame->device ? nullptr : known->frame.get();
  };
  found = summaries_.find(session, whole, go_on) || found;
  found = endings_.find(session, go_on) || found;
  found = judgements_.find(session, go_on) || found;
  for (std::size_t i = 0; session.percentiles() && i < session.run_count(); ++i)
    if (session.run(i).find_percentiles([&](double) { return go_on(); })) found = true;
  return found;
}

bool FrameBuilder::work_long_at_rest(Session& session, const std::function<bool()>& go_on) {
  const bool courses = judgements_.find_courses(session, go_on);
  const bool hint = endings_.find_hint(session, go_on);
  return session.holds().find_at_rest(session, go_on) || hint || courses;
}

bool FrameBuilder::try_at_rest(Session& session, const std::function<bool()>& go_on) {
  return session.has_input() && session.holds().try_at_rest(session, go_on);
}

void FrameBuilder::add_meshes(Session& session, SessionView& view) {
  for (const auto& input : session.inputs())
    view.meshes.push_back(
        {input, facts_of(session, input).serial, summaries_.of_input(session, input), judgements_.of_input(session, input)});
  const auto active = std::ranges::find(view.meshes, view.input, &InputView::input);
  view.input_summary = active->summary;
}

std::shared_ptr<const SessionView> FrameBuilder::build(Session& session, FrameDetail detail, std::span<const Watch> watched) {
  auto view = std::make_shared<SessionView>();
  view->shown = session.shown();
  view->read_files = session.read_files();
  view->threads = session.pool()->size();
  if (!session.has_input()) return view;
  if (const UndoEntry* entry = session.undo_stack().to_undo()) view->undo_label = entry->label;
  if (const UndoEntry* entry = session.undo_stack().to_redo()) view->redo_label = entry->label;
  view->restored_view = session.restored_view();
  view->restored_serial = session.restored_views();
  view->input = session.input();
  view->active = session.active_index();
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    view->runs.push_back(view_of(session.run(i), session.percentiles()));
    view->runs.back().unsaved = session.would_lose(i);
    view->runs.back().summary = summaries_.of(session, i);
    view->runs.back().ending = endings_.of(session, i);
    view->runs.back().judged = judgements_.of(session, i);
    view->runs.back().held = session.holds().of(session, i);
  }
  for (Known& known : known_) known.wanted = false;
  view->frame = standing(session, session.active_index(), detail);
  for (const Watch& what : watched) view->watched.push_back(watch(session, what, detail));
  add_meshes(session, *view);
  std::erase_if(known_, [](const Known& known) { return !known.wanted; });
  return view;
}

}  // namespace dmoscope
