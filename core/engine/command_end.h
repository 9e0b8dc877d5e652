#pragma once
// How one posted command ended, for those who record a session.

#include <cstdint>
#include <string>
#include <vector>

#include "core/session/session.h"

namespace dmoscope {

struct CommandEnd {
  enum class Kind { Done, Failed, Cancelled, Dropped };  // Dropped: cancelled before it began
  std::uint64_t id = 0;                                  // what Engine::post returned
  Kind kind = Kind::Done;
  Moment at{};                       // of the active run afterwards
  bool moved = false;                // that is another moment than before
  std::vector<std::string> again{};  // commands that lead there from where it began, if it moved
};

/// Commands that lead a session from `before` to where it is: what it has `done` besides moving runs, then for every run that moved a seek,
/// or the edits that it has come to be ahead by. Of another mesh than before: nothing.
[[nodiscard]] std::vector<std::string> commands_from(Session& session, const SessionPoint& before, const std::vector<std::string>& done);

}  // namespace dmoscope
