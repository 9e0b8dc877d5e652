#pragma once
// Ends of posted commands, for recordings of a session.

#include <cstdint>
#include <string>
#include <vector>

#include "core/session/session.h"

namespace dmoscope {

struct CommandEnd {
  enum class Kind { Done, Failed, Cancelled, Dropped };  // Dropped: cancelled before it began
  std::uint64_t id = 0;                                  // number that Engine::post returned
  Kind kind = Kind::Done;
  Moment at{};                       // moment of the active run afterwards
  bool moved = false;                // whether that moment differs from the one before
  std::vector<std::string> again{};  // commands that lead from the moment before to this one, if it moved
};

/// Commands that lead a session from `before` to its present state: what it has `done` besides moving runs, then for every run that moved a
/// seek, or the edits that it is now ahead by. Empty if the mesh has changed.
[[nodiscard]] std::vector<std::string> commands_from(Session& session, const SessionPoint& before, const std::vector<std::string>& done);

}  // namespace dmoscope
