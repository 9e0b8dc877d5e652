#pragma once
// Lines of the session's log.

#include <string>

namespace dmoscope {

struct Message {
  enum class Kind { Info, Warning, Error };
  Kind kind = Kind::Info;
  std::string text;
  int exit_code = 0;  // exit code of an Error
};

}  // namespace dmoscope
