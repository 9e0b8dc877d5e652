#include "core/session/session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/utf8.h"
#include "core/run/recipe.h"

namespace dmoscope {

void require_run_name(std::string_view name) {
  constexpr std::size_t kMostLetters = 60;
  std::size_t letters = 0;
  for (std::size_t at = 0; at < name.size(); ++letters) {
    std::uint32_t code = 0;
    const std::size_t size = utf8_letter(name.substr(at), code);
    if (size == 0) throw UsageError("a run's name is expected as UTF-8 text");
    if (code < 0x20 || code == 0x7F) throw UsageError("a run's name is one line, without tabs");
    at += size;
  }
  if (letters > kMostLetters) throw UsageError(fmt::format("a run's name has at most {} letters, not {}", kMostLetters, letters));
  if (!name.empty() && name.find_first_not_of(' ') == std::string_view::npos) throw UsageError("a run's name is more than spaces");
}

namespace {

/// Whether a metric is defined for all elements, with all that its formula and target need.
bool defined_for_all(Metric metric, const InputMesh& input) {
  try {
    require_defined(metric, input);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Bytes for past positions of a mesh, out of the chosen budget. The default budget is an upper limit: a mesh takes as much of it as the
/// positions of some iterations need, a small one at most a quarter.
std::size_t history_for(const InputMesh& input, std::size_t budget) {
  constexpr std::size_t kIterations = 4;
  if (budget != Session::kDefaultHistoryBytes) return budget;
  return std::clamp(kIterations * input.mesh.positions.size() * sizeof(Vec3), budget / 4, budget);
}

}  // namespace

Session::Session(unsigned threads, Acceleration acceleration, Backend backend)
    : pool_(std::make_shared<ThreadPool>(threads)), acceleration_(std::move(acceleration)), backend_(backend) {}

void Session::open(const std::filesystem::path& path, Progress& progress) {
  replace_input(load_input(path, Need::Smoothing, reading(progress)));
}

void Session::open(Mesh mesh, Progress& progress) { replace_input(prepare_input(std::move(mesh), {}, Need::Smoothing, progress)); }

void Session::generate(const std::string& words, Progress& progress) { replace_input(generate_input(words, progress)); }

std::shared_ptr<Run> Session::make_run(std::shared_ptr<const InputMesh> input, RunParameters parameters, BeginPositions begin) const {
  const std::size_t history = history_for(*input, history_bytes_);
  auto run = std::make_shared<Run>(std::move(input), std::move(parameters), pool_, history, acceleration_, std::move(begin));
  run->set_observer(observer_);
  return run;
}

void Session::replace(std::vector<std::shared_ptr<Run>> runs, std::size_t active, Metric shown) {
  runs_ = std::move(runs);
  for (const auto& input : inputs())
    for (const InputMesh* mesh : {input.get(), input->surface.get()})
      if (mesh != nullptr) note_read(mesh->path);
  for (const auto& run : runs_) run->set_id(++last_id_);
  activate(active);
  shown_ = shown;
  share_history();
}

void Session::restore_view(std::string json) {
  restored_view_ = std::move(json);
  ++restored_views_;
}

std::shared_ptr<Run> Session::first_run(const std::shared_ptr<const InputMesh>& input) const {
  RunParameters parameters{.backend = backend_};
  if (!runs_.empty()) {
    parameters = runs_[active_]->parameters();
    parameters.fixed.clear();
    parameters.kinds = {};
    parameters.boundary = BoundaryRule::Fixed;
    parameters.interfaces = InterfaceRule::Fixed;  // freed for the mesh before, not for this one
    parameters.layers = LayerRule::Keep;
    // Phases of a recipe, and its guard, are chosen for a mesh.
    if (parameters.guard && parameters.guard->floor && parameters.guard == guard_of_long_boxes(runs_[active_]->input()))
      parameters.guard = GuardRule{};
    parameters.then_joint.reset();
    parameters.then_mean.reset();
    parameters.joint_gap = RunParameters{}.joint_gap;
  }
  if (!defined_for_all(parameters.metric, *input)) parameters.metric = Metric::MeanRatio;
  if (method_info(parameters.method).joint && !why_not_joint(*input, parameters.metric).empty()) parameters.method = RunParameters{}.method;
  parameters.combination.reset();  // belongs to the mesh before, with its point, field and threshold
  return make_run(input, std::move(parameters));
}

void Session::replace_input(std::shared_ptr<const InputMesh> input) {
  auto run = first_run(input);  // may throw: nothing has been replaced yet
  note_read(input->path);
  run->set_id(++last_id_);
  runs_.clear();
  runs_.push_back(std::move(run));
  activate(0);
}

void Session::open_beside(const std::filesystem::path& path, Progress& progress) {
  auto input = load_input(path, Need::Smoothing, reading(progress));
  if (!has_input()) return replace_input(std::move(input));
  const auto kind = [](const InputMesh& mesh) { return mesh.is_volume() ? "volume" : mesh.is_surface() ? "surface" : "planar"; };
  if (input->in_space() != input_->in_space())
    throw UsageError(fmt::format("{} is a {} mesh, and cannot be shown beside a {} one: open it by itself", input->mesh.name, kind(*input),
                                 kind(*input_)));
  auto run = first_run(input);
  note_read(input->path);
  run->set_id(++last_id_);
  runs_.push_back(std::move(run));
  activate(runs_.size() - 1);
  share_history();
}

/// Makes a run the active one. The shown metric stays if its mesh has it.
void Session::activate(std::size_t index) {
  active_ = index;
  input_ = runs_[index]->shared_input();
  if (!defined_for_all(shown_, *input_)) shown_ = runs_[index]->parameters().metric;
}

std::vector<std::shared_ptr<const InputMesh>> Session::inputs() const {
  std::vector<std::shared_ptr<const InputMesh>> inputs;
  for (const auto& run : runs_)
    if (std::ranges::find(inputs, run->shared_input()) == inputs.end()) inputs.push_back(run->shared_input());
  return inputs;
}

void Session::note_read(const std::filesystem::path& mesh) {
  auto files = std::make_shared<ReadFiles>(*read_files_);
  files->add(mesh);
  read_files_ = std::move(files);
}

void Session::note_exported(const std::filesystem::path& file) {
  saved_.written(file);
  saved_.add(file, SavedMarks::Kind::Mesh, runs_.at(active_));
}

void Session::note_saved(const std::filesystem::path& file) {
  saved_.written(file);
  for (const auto& run : runs_) saved_.add(file, SavedMarks::Kind::Session, run);
}

std::filesystem::path Session::source_path(const std::shared_ptr<const InputMesh>& input) const {
  for (const auto& [mesh, copy] : originals_)
    if (mesh.lock() == input) return copy;
  return input->path.empty() ? std::filesystem::path() : std::filesystem::absolute(input->path);
}

void Session::note_original(std::filesystem::path copy) {
  std::erase_if(originals_, [&](const auto& one) { return one.first.expired() || one.first.lock() == input_; });
  note_read(copy);
  originals_.emplace_back(input_, std::move(copy));
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
  activate(index);
}

std::size_t Session::add_run(RunParameters parameters) { return add(make_run(input(), std::move(parameters))); }

std::size_t Session::add(std::shared_ptr<Run> run) {
  run->set_id(++last_id_);
  runs_.push_back(std::move(run));
  activate(runs_.size() - 1);
  share_history();
  return active_;
}

void Session::remove_run(std::size_t index) {
  (void)run(index);
  if (runs_.size() == 1) throw UsageError("the last run cannot be removed");
  runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(index));
  activate(active_ > index || active_ == runs_.size() ? active_ - 1 : active_);
  share_history();
}

void Session::rename_run(std::size_t index, std::string name) {
  require_run_name(name);
  run(index).set_given_name(std::move(name));
}

void Session::show(Metric metric) {
  const auto kinds = input()->mesh.elements.kinds();
  if (std::ranges::none_of(kinds, [&](ElementKind kind) { return info(metric).defined_for(kind); }))
    throw UsageError(fmt::format("{} is not defined for any element of this mesh", info(metric).name));
  if (!is_built_in(metric)) require_defined(metric, *input());
  shown_ = metric;
}

namespace {

/// Whether two metrics have equal values for the input, judged by some of its elements.
bool judge_alike(const InputMesh& input, Metric a, Metric b) {
  constexpr Index kLooks = 64;
  const QualityContext context = input.quality_context();
  const auto count = static_cast<Index>(input.mesh.elements.size());
  const Index stride = std::max<Index>(1, count / kLooks);
  for (Index e = 0; e < count; e += stride) {
    const double by_a = element_quality(context, input.mesh.positions, a, e), by_b = element_quality(context, input.mesh.positions, b, e);
    if (!(std::abs(by_a - by_b) <= 1e-9 * std::max(1.0, std::abs(by_a)))) return false;
  }
  return true;
}

}  // namespace

void Session::show_next() {
  std::array<bool, kElementKindCount> present{};
  for (const ElementKind kind : input()->mesh.elements.kinds()) present[static_cast<std::size_t>(kind)] = true;
  const auto of_all = [&](const MetricInfo& metric) {
    for (std::size_t kind = 0; kind < present.size(); ++kind)
      if (present[kind] && !metric.defined_for(static_cast<ElementKind>(kind))) return false;
    return true;
  };
  const auto table = metric_table();
  const auto at = static_cast<std::size_t>(std::ranges::find(table, shown_, &MetricInfo::metric) - table.begin());
  for (std::size_t k = 1; k < table.size(); ++k) {
    const MetricInfo& next = table[(at + k) % table.size()];
    if (of_all(next) && !judge_alike(*input(), shown_, next.metric)) return show(next.metric);
  }
}

void Session::set_history_budget(std::size_t bytes) {
  history_bytes_ = bytes;
  share_history();
}

void Session::share_history() {
  for (const auto& run : runs_) run->set_history_budget(history_for(run->input(), history_bytes_) / runs_.size());
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
  for (const auto& run : runs_) point.runs.push_back({run, run->point(), run->given_name()});
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

/// Returns to a point. `with_shown`: also to its shown metric; else that stays, if the mesh has it.
void Session::go_to(const SessionPoint& point, bool with_shown, Progress& progress) {
  const std::unique_ptr<Session, void (*)(Session*)> at_the_end(this, [](Session* session) { session->rest_retired_runs(); });
  for (const auto& [run, where, name] : point.runs) {
    run->set_pool(pool_);
    run->go_to(where, progress);
  }
  const bool other_mesh = input_ != point.input;
  input_ = point.input;
  runs_.clear();
  for (const auto& [run, where, name] : point.runs) {
    runs_.push_back(run);
    run->set_given_name(name);
  }
  active_ = point.active;
  if (with_shown || other_mesh) shown_ = point.shown;
  share_history();
}

/// Makes runs that only undo knows keep no more than they must, and share as much memory for positions as the others do.
void Session::rest_retired_runs() {
  const auto retired = undo_.retired_runs(point());
  for (const auto& run : retired) {
    run->set_history_budget(history_for(run->input(), history_bytes_) / retired.size());
    try {
      run->rest();
    } catch (const DeviceError&) {     // the run has recovered, and continues on the CPU
    } catch (const std::bad_alloc&) {  // the run keeps less
    }
  }
}

}  // namespace dmoscope
