#pragma once
// How one posted command ended, for those who record a session.

#include <cstdint>

#include "core/session/history.h"

namespace dmoscope {

struct CommandEnd {
  enum class Kind { Done, Failed, Cancelled, Dropped };  // Dropped: cancelled before it began
  std::uint64_t id = 0;                                  // what Engine::post returned
  Kind kind = Kind::Done;
  Moment at{};         // of the active run afterwards
  bool moved = false;  // that is another moment than before
};

}  // namespace dmoscope
