#pragma once
// The newest result for the status bar, which stays until something else succeeds.

#include <optional>
#include <string_view>

#include "core/commands/commands.h"
#include "core/engine/command_end.h"

namespace dmoscope::ui {

class ResultLine {
 public:
  void say(const Message& message);
  /// Notes that a command of the session has ended; `line`: as it was posted. Its own message stays; if it succeeded without one, its
  /// success replaces the message before it.
  void ended(std::string_view line, const CommandEnd& end);
  /// Notes that a command of the window has succeeded, which removes an error from before.
  void succeeded();
  /// The newest message; none: there is nothing to say.
  [[nodiscard]] const std::optional<Message>& newest() const noexcept { return newest_; }

 private:
  std::optional<Message> newest_;
  bool said_ = false;  // whether there was a message since a command ended
};

}  // namespace dmoscope::ui
