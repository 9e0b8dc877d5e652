#pragma once
// A session as it stands at one moment, to be written to a file while the session itself goes on.

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

/// Of a run: all that its place in a saved session is made of.
struct RunStanding {
  RunParameters parameters;
  Moment moment;
  SharedVector<Edit> edits;
  SharedVector<IterationRecord> records;
  std::shared_ptr<const SizeField> size;
  std::string name;                              // see Run::given_name
  std::size_t mesh = 0;                          // its place in SessionStanding::meshes
  std::span<const Vec3> start;                   // positions at the end of iteration moment.iteration; empty at the input
  std::shared_ptr<const void> owner;             // of these
  std::shared_ptr<const JointStanding> joint{};  // see Run::joint_standing
  BeginPositions begin{};                        // see Run::begin
};

struct MeshStanding {
  std::shared_ptr<const InputMesh> input;
  std::filesystem::path source;  // Session::source_path()
};

struct SessionStanding {
  std::vector<MeshStanding> meshes;  // in the order of their first runs
  std::vector<RunStanding> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;
  /// The active run's mesh.
  [[nodiscard]] const InputMesh& input() const { return *meshes[runs[active].mesh].input; }
};

/// The same but for the runs.
[[nodiscard]] SessionStanding without_runs(const Session& session);
/// The same but for the positions. `meshes`: the session's.
[[nodiscard]] RunStanding without_positions(const Run& run, std::span<const MeshStanding> meshes);

/// All of it, without moving any run. Positions that the history or `starts` keep are shared, others copied. None where a run stands in the
/// midst of an iteration at whose begin nobody knows the positions any more, and `go_on`, by which they are computed again (see
/// positions_at), is missing or says no. Throws DeviceError.
[[nodiscard]] std::optional<SessionStanding> standing_of(Session& session, const IterationStarts& starts,
                                                         const std::function<bool()>& go_on = {});

}  // namespace dmoscope
