#include "core/session/session.h"

#include <algorithm>
#include <new>

#include <fmt/format.h>

namespace dmoscope {

Session::Session(unsigned threads, Acceleration acceleration, Backend backend)
    : pool_(std::make_shared<ThreadPool>(threads)), acceleration_(std::move(acceleration)), backend_(backend) {}

void Session::open(const std::filesystem::path& path, Progress& progress) {
  replace_input(load_input(path, Need::Smoothing, reading(progress)));
}

void Session::open(Mesh mesh, Progress& progress) { replace_input(prepare_input(std::move(mesh), {}, Need::Smoothing, progress)); }

void Session::generate(const std::string& words, Progress& progress) { replace_input(generate_input(words, progress)); }

std::shared_ptr<Run> Session::make_run(std::shared_ptr<const InputMesh> input, RunParameters parameters) const {
  auto run = std::make_shared<Run>(std::move(input), std::move(parameters), pool_, history_bytes_, acceleration_);
  run->set_observer(observer_);
  return run;
}

void Session::replace(std::shared_ptr<const InputMesh> input, std::vector<std::shared_ptr<Run>> runs, std::size_t active, Metric shown) {
  input_ = std::move(input);
  if (!input_->path.empty()) read_files_.add(input_->mesh, input_->path);
  runs_ = std::move(runs);
  active_ = active;
  shown_ = shown;
  for (const auto& run : runs_) run->set_id(++last_id_);
  share_history();
}

void Session::restore_view(std::string json) {
  restored_view_ = std::move(json);
  ++restored_views_;
}

void Session::replace_input(std::shared_ptr<const InputMesh> input) {
  RunParameters parameters{.backend = backend_};
  if (!runs_.empty()) {
    parameters = runs_[active_]->parameters();
    parameters.fixed.clear();
    parameters.interfaces = InterfaceRule::Fixed;  // who freed those of one mesh has not seen the next one's
  }
  const auto usable = [&mesh = input->mesh](Metric metric) {  // not `input`: it is moved from below
    return std::ranges::all_of(mesh.elements.kinds(), [&](ElementKind kind) { return info(metric).defined_for(kind); });
  };
  if (!usable(parameters.metric)) parameters.metric = Metric::MeanRatio;
  parameters.combination.reset();          // its point, its field and its threshold are of the mesh before
  auto run = make_run(input, parameters);  // may throw: nothing has been replaced yet
  input_ = std::move(input);
  if (!input_->path.empty()) read_files_.add(input_->mesh, input_->path);
  run->set_id(++last_id_);
  runs_.clear();
  runs_.push_back(std::move(run));
  active_ = 0;
  if (!usable(shown_)) shown_ = parameters.metric;
}

const std::shared_ptr<const InputMesh>& Session::input() const {
  if (!input_) throw UsageError("no mesh is open");
  return input_;
}

Run& Session::run(std::size_t index) {
  if (!input_) throw UsageError("no mesh is open");
  if (index >= runs_.size()) throw UsageError(fmt::format("there is no run {}; the session has {}", index, runs_.size()));
  return *runs_[index];
}

std::optional<std::size_t> Session::place_of(std::uint64_t id) const {
  const auto at = std::ranges::find(runs_, id, [](const auto& run) { return run->id(); });
  return at == runs_.end() ? std::nullopt : std::optional(static_cast<std::size_t>(at - runs_.begin()));
}

void Session::select(std::size_t index) {
  (void)run(index);
  active_ = index;
}

std::size_t Session::add_run(RunParameters parameters) {
  runs_.push_back(make_run(input(), std::move(parameters)));
  runs_.back()->set_id(++last_id_);
  active_ = runs_.size() - 1;
  share_history();
  return active_;
}

void Session::remove_run(std::size_t index) {
  (void)run(index);
  if (runs_.size() == 1) throw UsageError("the last run cannot be removed");
  runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(index));
  if (active_ > index || active_ == runs_.size()) --active_;
  share_history();
}

std::size_t Session::change(RunParameters parameters) {
  const Run& current = active();
  const bool untouched = current.moment() == Moment{} && current.history().records().size() == 1 && current.edits().all().empty();
  if (!untouched) return add_run(std::move(parameters));
  const std::uint64_t id = current.id();
  runs_[active_] = make_run(input_, std::move(parameters));
  runs_[active_]->set_id(id);
  share_history();
  return active_;
}

void Session::show(Metric metric) {
  const auto kinds = input()->mesh.elements.kinds();
  if (std::ranges::none_of(kinds, [&](ElementKind kind) { return info(metric).defined_for(kind); }))
    throw UsageError(fmt::format("{} is not defined for any element of this mesh", info(metric).name));
  shown_ = metric;
}

void Session::set_history_budget(std::size_t bytes) {
  history_bytes_ = bytes;
  share_history();
}

void Session::share_history() {
  for (const auto& run : runs_) run->set_history_budget(history_bytes_ / runs_.size());
}

void Session::set_threads(unsigned threads) {
  pool_ = std::make_shared<ThreadPool>(threads);
  for (const auto& run : runs_) run->set_pool(pool_);
}

void Session::observe(std::function<void(const Run&)> observer) {
  observer_ = std::move(observer);
  for (const auto& run : runs_) run->set_observer(observer_);
}

SessionPoint Session::point() const {
  SessionPoint point{input_, {}, active_, shown_};
  for (const auto& run : runs_) point.runs.push_back({run, run->point()});
  return point;
}

void Session::remember(std::string label, const SessionPoint& before) {
  undo_.record(std::move(label), before, point());
  rest_retired_runs();
}

std::string Session::undo(Progress& progress) {
  const UndoEntry* entry = undo_.to_undo();
  if (entry == nullptr) throw UsageError("there is nothing to undo");
  go_to(entry->before, entry->before.shown != entry->after.shown, progress);
  undo_.undone();
  return entry->label;
}

std::string Session::redo(Progress& progress) {
  const UndoEntry* entry = undo_.to_redo();
  if (entry == nullptr) throw UsageError("there is nothing to redo");
  go_to(entry->after, entry->before.shown != entry->after.shown, progress);
  undo_.redone();
  return entry->label;
}

/// `with_shown`: the metric that is shown, too; else that stays, where the mesh has it.
void Session::go_to(const SessionPoint& point, bool with_shown, Progress& progress) {
  const std::unique_ptr<Session, void (*)(Session*)> at_the_end(this, [](Session* session) { session->rest_retired_runs(); });
  for (const auto& [run, where] : point.runs) {
    run->set_pool(pool_);
    run->go_to(where, progress);
  }
  const bool other_mesh = input_ != point.input;
  input_ = point.input;
  runs_.clear();
  for (const auto& [run, where] : point.runs) runs_.push_back(run);
  active_ = point.active;
  if (with_shown || other_mesh) shown_ = point.shown;
  share_history();
}

/// Runs that only undo knows keep no more than they must, and share among them as much memory for positions as the others do.
void Session::rest_retired_runs() {
  const auto retired = undo_.retired_runs(point());
  for (const auto& run : retired) {
    run->set_history_budget(history_bytes_ / retired.size());
    try {
      run->rest();
    } catch (const DeviceError&) {     // it has recovered, and goes on on the CPU
    } catch (const std::bad_alloc&) {  // it keeps less
    }
  }
}

}  // namespace dmoscope
