#pragma once
// The newest result, as the status bar says it: what was said last, until something else succeeds.

#include <optional>
#include <string_view>

#include "core/commands/message.h"
#include "core/engine/command_end.h"

namespace dmoscope::ui {

class ResultLine {
 public:
  void say(const Message& message);
  /// A command of the session has ended; `line`: as it was posted. What it said itself stays; one that succeeded without a word takes the
  /// place of what was said before it.
  void ended(std::string_view line, const CommandEnd& end);
  /// A command of the window has succeeded: an error from before is over.
  void succeeded();
  /// None: there is nothing to say.
  [[nodiscard]] const std::optional<Message>& newest() const noexcept { return newest_; }

 private:
  std::optional<Message> newest_;
  bool said_ = false;  // since a command ended
};

}  // namespace dmoscope::ui
