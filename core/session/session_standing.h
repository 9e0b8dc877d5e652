#pragma once
// Snapshot of a session, to be written to a file while the session itself goes on.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/run/run.h"
#include "core/session/session.h"

namespace dmoscope {

// Positions at the begin of the iterations that runs are in, for histories that are full and no longer keep them.

/// Positions at the begin of iterations, at most one copy for each run, and none that its history keeps.
class IterationStarts {
 public:
  using Positions = std::shared_ptr<const std::vector<Vec3>>;

  /// Keeps the positions of a run that is at the end of an iteration, unless they are known. Throws DeviceError.
  void note(const std::weak_ptr<const Run>& run);
  /// The positions at the begin of the run's present iteration; null if they are not known here, or do not belong to its path any more.
  [[nodiscard]] Positions of(const Run& run) const;

 private:
  struct Start {
    std::weak_ptr<const Run> run;
    std::uint64_t iteration = 0;
    Backend backend = Backend::Cpu;  // backend at that moment: the last bits may differ after a device failed
    std::vector<Edit> edits;         // all edits of its path up to then
    Positions positions;
    [[nodiscard]] bool is_of(const Run& run) const;
  };
  std::vector<Start> starts_;
};

/// Snapshot of a run: everything that a saved session holds of it.
struct RunStanding {
  RunParameters parameters;
  Moment moment;
  SharedVector<Edit> edits;
  SharedVector<IterationRecord> records;
  std::shared_ptr<const SizeField> size;
  std::string name;                              // see Run::given_name
  std::size_t mesh = 0;                          // index in SessionStanding::meshes
  std::span<const Vec3> start;                   // positions at the end of iteration moment.iteration; empty at the input
  std::shared_ptr<const void> owner;             // owner of `start`
  std::shared_ptr<const JointStanding> joint{};  // see Run::joint_standing
  BeginPositions begin{};                        // see Run::begin
};

struct MeshStanding {
  std::shared_ptr<const InputMesh> input;
  std::filesystem::path source;  // Session::source_path()
};

struct SessionStanding {
  std::vector<MeshStanding> meshes;  // meshes in the order of their first runs
  std::vector<RunStanding> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;
  /// The active run's mesh.
  [[nodiscard]] const InputMesh& input() const { return *meshes[runs[active].mesh].input; }
};

/// Snapshot of a session without its runs.
[[nodiscard]] SessionStanding without_runs(const Session& session);
/// Snapshot of a run without positions. `meshes`: those of the session.
[[nodiscard]] RunStanding without_positions(const Run& run, std::span<const MeshStanding> meshes);

/// Complete snapshot of a session, without moving any run. Positions that the history or `starts` keep are shared, others copied. None if a
/// run is within an iteration at whose begin the positions are lost, and `go_on`, which allows to recompute them (see positions_at), is
/// missing or returns false. Throws DeviceError.
[[nodiscard]] std::optional<SessionStanding> standing_of(Session& session, const IterationStarts& starts,
                                                         const std::function<bool()>& go_on = {});

// Recomputation of positions that a run's history no longer keeps.

/// The positions at the end of a recorded iteration: those kept, or else the same bits recomputed from the nearest kept ones by another
/// run, so that this one stays at its moment. Asks `go_on` every 100 ms or so; none once that returns false. Throws Error.
[[nodiscard]] std::optional<std::vector<Vec3>> positions_at(const Session& session, const Run& run, std::uint64_t iteration,
                                                            const std::function<bool()>& go_on);

}  // namespace dmoscope
