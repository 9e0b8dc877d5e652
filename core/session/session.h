#pragma once
// Sessions: meshes and the runs on them. Plain state; engine.h gives it a thread of its own.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/run/run.h"
#include "core/session/holds.h"
#include "core/session/read_files.h"
#include "core/session/saved_marks.h"
#include "core/session/undo.h"

namespace dmoscope {

// Names that the user gives to runs.

/// Throws UsageError for a name that is too long for lists and titles, has several lines, or is no UTF-8. An empty one is valid: it removes
/// the name.
void require_run_name(std::string_view name);

class Session {
 public:
  static constexpr std::size_t kDefaultHistoryBytes = std::size_t{512} << 20U;

  /// Constructs an empty session. `acceleration`: devices that runs may use; `backend`: that of the first run.
  explicit Session(unsigned threads = 0, Acceleration acceleration = {}, Backend backend = Backend::Auto);

  /// Replaces input and runs by a mesh and one new run with the current parameters' method and metric (mean-ratio if that metric is not
  /// defined for the new mesh). On any error the session is unchanged.
  void open(const std::filesystem::path& path, Progress& progress);
  void open(Mesh mesh, Progress& progress);
  /// Replaces input and runs by a sample, see generate_input. Otherwise like open().
  void generate(const std::string& words, Progress& progress);
  /// Opens another mesh beside those that are open, with a new run on it, which becomes the active one. On any error the session is
  /// unchanged. The first mesh is opened as by open(). Throws UsageError for a planar mesh beside a volume one, and the reverse.
  void open_beside(const std::filesystem::path& path, Progress& progress);
  /// Replaces input and runs by these runs, at least one, and their meshes.
  void replace(std::vector<std::shared_ptr<Run>> runs, std::size_t active, Metric shown);
  /// Makes a run with this session's threads and devices, without adding it.
  [[nodiscard]] std::shared_ptr<Run> make_run(std::shared_ptr<const InputMesh> input, RunParameters parameters,
                                              BeginPositions begin = nullptr) const;
  /// Restores the JSON of the view that was saved with the session, and counts these calls.
  void restore_view(std::string json);
  [[nodiscard]] const std::string& restored_view() const noexcept { return restored_view_; }
  [[nodiscard]] std::uint64_t restored_views() const noexcept { return restored_views_; }
  /// Reads the file of the active run's mesh again: new runs with the parameters of its runs. Returns a sentence on what could not be kept
  /// (such as vertices fixed by hand, if their number is another one now), else nothing. Throws UsageError for a mesh without a file; on
  /// any error the session is unchanged.
  [[nodiscard]] std::string reload(Progress& progress);
  /// Lets the vertices of the active run's mesh slide on the surface of another mesh, see slide_on(); empty: on its own again. Its runs
  /// keep their parameters and start anew, as by reload(), with its result. Throws UsageError; on any error the session is unchanged.
  [[nodiscard]] std::string slide_on_surface(const std::filesystem::path& path, Progress& progress);
  /// Lets these cell data of the active run's mesh name materials, see with_materials(). Its runs start anew, as by reload(), with its
  /// result. Throws UsageError.
  [[nodiscard]] std::string name_materials(std::span<const std::string> fields);
  /// Throws UsageError if `command` would overwrite a mesh that was opened in this session.
  void require_not_read(const std::filesystem::path& target, std::string_view command) const {
    read_files_->require_another(target, command);
  }
  [[nodiscard]] const std::shared_ptr<const ReadFiles>& read_files() const noexcept { return read_files_; }
  /// Records that a file was written: with the active run's mesh, or with all runs (save_state).
  void note_exported(const std::filesystem::path& file);
  void note_saved(const std::filesystem::path& file);
  /// Whether ending now would lose something of a run; see SavedMarks.
  [[nodiscard]] bool would_lose(std::size_t run) const { return saved_.would_lose(*runs_.at(run)); }
  /// File from which a mesh is read when the session is opened again: its own, or the copy that was kept when that was overwritten. Empty
  /// for a mesh of no file.
  [[nodiscard]] std::filesystem::path source_path(const std::shared_ptr<const InputMesh>& input) const;
  /// Records the copy that holds the original contents of the active mesh's file from now on.
  void note_original(std::filesystem::path copy);
  /// Sets the most bytes that a file may unpack to from now on; 0: see UnpackBudget.
  void set_most_memory(std::uint64_t bytes) noexcept { most_memory_ = bytes; }
  /// Sets whether coordinates of meshes that are opened from now on are taken for degrees.
  void set_geographic(Geographic choice) noexcept { geographic_ = choice; }
  /// Sets whether meshes one cell thick that are opened from now on are replaced by their front.
  void set_thin(Thin choice) noexcept { thin_ = choice; }
  /// Settings with which this session reads files.
  [[nodiscard]] IoContext reading(Progress& progress) const {
    IoContext context(progress, nullptr, most_memory_);
    context.geographic = geographic_;
    context.thin = thin_;
    return context;
  }
  [[nodiscard]] bool has_input() const noexcept { return input_ != nullptr; }
  /// The active run's mesh. Throws UsageError "no mesh is open".
  [[nodiscard]] const std::shared_ptr<const InputMesh>& input() const;
  /// The open meshes, in the order of their first runs.
  [[nodiscard]] std::vector<std::shared_ptr<const InputMesh>> inputs() const;

  [[nodiscard]] std::size_t run_count() const noexcept { return runs_.size(); }
  [[nodiscard]] Run& run(std::size_t index);
  /// The identity of a run, to tell it from others.
  [[nodiscard]] std::weak_ptr<const Run> identity(std::size_t index) { return (void)run(index), runs_[index]; }
  [[nodiscard]] StandingRun standing(std::size_t index) { return {identity(index), runs_[index]->path(), runs_[index]->moment()}; }
  /// Index in the list of the run with this id (see Run::id).
  [[nodiscard]] std::optional<std::size_t> place_of(std::uint64_t id) const;
  [[nodiscard]] std::size_t active_index() const noexcept { return active_; }
  [[nodiscard]] Run& active() { return run(active_); }
  void select(std::size_t index);
  /// Adds a run on the active run's mesh and makes it active; returns its index.
  std::size_t add_run(RunParameters parameters);
  /// Removes a run; the last one cannot be removed (UsageError).
  void remove_run(std::size_t index);
  /// Names a run in titles, legends and tables; empty: by its parameters, as before. Throws UsageError, see require_run_name.
  void rename_run(std::size_t index, std::string name);
  /// Gives the active run other parameters: in place while it has not moved from the input, else as a new run beside it, so that
  /// nothing is lost. That begins where the active run began. Returns the index of the run that has them.
  std::size_t change(RunParameters parameters);
  /// Gives these parameters to a new run that begins with the best state of the active one, at the end of that iteration (see BestState),
  /// which is returned; the active run stays. A run that has not moved gets the parameters in place. Throws UsageError if vertices that
  /// have moved would have less freedom than before.
  std::uint64_t continue_with(RunParameters parameters, Progress& progress);

  [[nodiscard]] SessionPoint point() const;
  /// Records the effect of a command since `before`, for undo.
  void remember(std::string label, const SessionPoint& before);
  /// Undoes the last recorded command; returns its label. Throws UsageError if there is none. On Cancelled every run is at an exact moment
  /// on the way, and undo can be called again.
  std::string undo(Progress& progress);
  std::string redo(Progress& progress);
  [[nodiscard]] const UndoStack& undo_stack() const noexcept { return undo_; }

  /// The metric shown in colours, histogram and worst list, which need not be the one that a run optimises.
  [[nodiscard]] Metric shown() const noexcept { return shown_; }
  /// Shows a metric. Throws UsageError if it is defined for none of the elements.
  void show(Metric metric);
  /// Shows the next metric in the table that is defined for all elements; after the last one the first.
  void show_next();
  /// Whether percentiles are computed when the session is at rest.
  [[nodiscard]] bool percentiles() const noexcept { return percentiles_; }
  void set_percentiles(bool on) noexcept { percentiles_ = on; }
  /// Sets the budget for all runs together, which is divided evenly.
  void set_history_budget(std::size_t bytes);
  void set_threads(unsigned threads);
  /// Sets the observer of all runs, also of those added later; see Run::set_observer.
  void observe(std::function<void(const Run&)> observer);
  [[nodiscard]] const std::shared_ptr<ThreadPool>& pool() const noexcept { return pool_; }
  /// Holds of the runs' minima that were found.
  [[nodiscard]] Holds& holds() noexcept { return holds_; }

 private:
  [[nodiscard]] std::shared_ptr<Run> first_run(const std::shared_ptr<const InputMesh>& input) const;
  std::size_t add(std::shared_ptr<Run> run);
  std::size_t put(std::shared_ptr<Run> run);
  void replace_input(std::shared_ptr<const InputMesh> input);
  [[nodiscard]] std::string replace_in_runs(const std::shared_ptr<const InputMesh>& stale, const std::shared_ptr<const InputMesh>& fresh);
  [[nodiscard]] std::string exchange(const std::shared_ptr<const InputMesh>& stale, const std::shared_ptr<const InputMesh>& fresh);
  void activate(std::size_t index);
  void share_history();
  void note_read(const std::filesystem::path& mesh);
  void go_to(const SessionPoint& point, bool with_shown, Progress& progress);
  void rest_retired_runs();

  std::shared_ptr<ThreadPool> pool_;
  Acceleration acceleration_;
  Backend backend_;
  std::size_t history_bytes_ = kDefaultHistoryBytes;
  std::shared_ptr<const InputMesh> input_;  // mesh of the active run
  std::vector<std::shared_ptr<Run>> runs_;
  std::function<void(const Run&)> observer_;
  std::size_t active_ = 0;
  Metric shown_ = Metric::MeanRatio;
  bool percentiles_ = false;
  std::string restored_view_;
  std::uint64_t restored_views_ = 0;
  std::shared_ptr<const ReadFiles> read_files_ = std::make_shared<const ReadFiles>();
  SavedMarks saved_;
  std::vector<std::pair<std::weak_ptr<const InputMesh>, std::filesystem::path>> originals_;  // see source_path()
  std::uint64_t most_memory_ = 0;
  Geographic geographic_ = Geographic::Auto;
  Thin thin_ = Thin::Auto;
  std::uint64_t last_id_ = 0;  // greatest id given to a run so far
  UndoStack undo_;
  Holds holds_;
};

}  // namespace dmoscope
