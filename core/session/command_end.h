#pragma once
// How one posted command ended, for those who record a session.

#include <cstdint>
#include <string>
#include <vector>

#include "core/session/run.h"

namespace dmoscope {

struct CommandEnd {
  enum class Kind { Done, Failed, Cancelled, Dropped };  // Dropped: cancelled before it began
  std::uint64_t id = 0;                                  // what Engine::post returned
  Kind kind = Kind::Done;
  Moment at{};                       // of the active run afterwards
  bool moved = false;                // that is another moment than before
  std::vector<std::string> again{};  // commands that lead there from where it began, if it moved
};

/// Commands that lead `run` from `before` to where it is: a seek, or the edits that it has come to be ahead by.
[[nodiscard]] std::vector<std::string> commands_from(const Run& run, const Moment& before);

}  // namespace dmoscope
