#pragma once
// Output to the terminal, and Ctrl+C for the work. All that the program prints goes through here, so that no text of a file or a name can
// control the terminal.

#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>

#include <fmt/format.h>

#include "core/base/progress.h"
#include "core/base/terminal_text.h"

namespace dmoscope::app {

/// Makes the signals that ask a program to end (SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU) wait for a Watch, in this thread and in all
/// threads that it starts afterwards. Signals that are ignored already (nohup) stay so.
void block_interrupts();

/// Makes a file that grows beyond the process's limit an error like a full disk, instead of a signal that ends the program.
void ignore_file_limit_signal();

/// Writes "dmoscope: TEXT" and a line feed to standard error; `hint`: another line after it.
void complain(std::string_view text, std::string_view hint = {});

/// Writes lines that the program composed to standard output; they may contain texts of files.
void print_lines(std::string_view text);

/// Text in its form for one line, see terminal_line(); other things unchanged.
template <class Thing>
using Shown = std::conditional_t<std::is_convertible_v<const Thing&, std::string_view>, std::string, Thing>;

template <class Thing>
[[nodiscard]] Shown<Thing> shown(const Thing& thing) {
  if constexpr (std::is_convertible_v<const Thing&, std::string_view>)
    return terminal_line(thing);
  else
    return thing;
}

/// Prints by fmt::print to standard output; text that is filled in cannot leave its line.
template <class... Things>
void print(fmt::format_string<const Shown<Things>&...> format, const Things&... things) {
  print_lines(fmt::format(format, static_cast<const Shown<Things>&>(shown(things))...));
}

/// Flushes standard output. Throws OutputError if that fails, or if an earlier write failed.
void flush_output();

/// Shows one rewritten line of progress, on a terminal, for work of more than 0.2 s, and turns the first Ctrl+C into a cancel; the second
/// ends the process at once.
class Watch {
 public:
  /// Watches its own progress(); Ctrl+C requests a cancel there.
  Watch();
  /// Watches the progress of another owner; `cancel` is called from the watching thread.
  Watch(const Progress& shown, std::function<void()> cancel);
  /// Watches for Ctrl+C alone and shows nothing.
  explicit Watch(std::function<void()> cancel);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  [[nodiscard]] Progress& progress() noexcept { return own_; }

 private:
  Watch(const Progress& shown, std::function<void()> cancel, bool quiet);
  void watch();
  void draw(bool& drawn) const;

  Progress own_;
  const Progress& shown_;
  std::function<void()> cancel_;
  const bool quiet_;
  int signals_ = -1, wake_ = -1;  // descriptors: the pending signals, and the end of the watch
  std::jthread thread_;           // last: it uses all members above
};

}  // namespace dmoscope::app
