#pragma once
// One line of the session's log.

#include <string>

namespace dmoscope {

struct Message {
  enum class Kind { Info, Warning, Error };
  Kind kind = Kind::Info;
  std::string text;
  int exit_code = 0;  // of an Error
};

}  // namespace dmoscope
