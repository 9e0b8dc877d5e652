#pragma once
// Snapshot of a session, to be written to a file while the session itself goes on.

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/session/iteration_starts.h"
#include "core/session/session.h"

namespace dmoscope {

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

}  // namespace dmoscope
