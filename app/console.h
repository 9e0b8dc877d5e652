#pragma once
// What a person at a terminal sees while a verb works, and how Ctrl+C reaches the work.

#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include "core/base/progress.h"

namespace dmoscope::app {

/// From now on SIGINT and SIGTERM wait for a Watch in this thread and in all threads it starts afterwards.
void block_interrupts();

/// Writes "dmoscope: TEXT" and a line feed to standard error.
void complain(std::string_view text);

/// Hands standard output what was printed. Throws OutputError when it does not take it, now or before.
void flush_output();

/// Shows, on a terminal, one rewritten line of progress for work of more than 0.2 s, and turns the first Ctrl+C into a cancel;
/// the second ends the process at once.
class Watch {
 public:
  /// Watches its own progress(), which a cancel is requested of.
  Watch();
  /// Watches somebody else's progress; `cancel` is called from the watching thread.
  Watch(const Progress& shown, std::function<void()> cancel);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  [[nodiscard]] Progress& progress() noexcept { return own_; }

 private:
  void watch(const std::stop_token& stop);
  void draw(bool& drawn) const;

  Progress own_;
  const Progress& shown_;
  std::function<void()> cancel_;
  std::jthread thread_;  // last: everything above exists before it starts
};

}  // namespace dmoscope::app
