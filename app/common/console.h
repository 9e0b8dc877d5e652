#pragma once
// What a person at a terminal sees, and how Ctrl+C reaches the work. All that the program prints goes through here, so that nothing in a
// file or a name can give the terminal orders.

#include <functional>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>

#include <fmt/format.h>

#include "core/base/progress.h"
#include "core/base/terminal_text.h"

namespace dmoscope::app {

/// From now on the signals that ask a program to end (SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU) wait for a Watch in this thread and in all
/// threads it starts afterwards, but for those that whoever started the program has it ignore (nohup).
void block_interrupts();

/// Makes a file that grows beyond the process's limit an error like a full disk, instead of a signal that ends the program.
void ignore_file_limit_signal();

/// Writes "dmoscope: TEXT" and a line feed to standard error; `hint`: another line after it.
void complain(std::string_view text, std::string_view hint = {});

/// Writes lines to standard output that the program composed, possibly with texts of others in them.
void print_lines(std::string_view text);

/// Text as one line shows it, see terminal_line(); other things as they are.
template <class Thing>
using Shown = std::conditional_t<std::is_convertible_v<const Thing&, std::string_view>, std::string, Thing>;

template <class Thing>
[[nodiscard]] Shown<Thing> shown(const Thing& thing) {
  if constexpr (std::is_convertible_v<const Thing&, std::string_view>)
    return terminal_line(thing);
  else
    return thing;
}

/// fmt::print to standard output; text that is filled in cannot leave its line.
template <class... Things>
void print(fmt::format_string<const Shown<Things>&...> format, const Things&... things) {
  print_lines(fmt::format(format, static_cast<const Shown<Things>&>(shown(things))...));
}

/// Flushes standard output. Throws OutputError when that fails, or when an earlier write failed.
void flush_output();

/// Shows, on a terminal, one rewritten line of progress for work of more than 0.2 s, and turns the first Ctrl+C into a cancel;
/// the second ends the process at once.
class Watch {
 public:
  /// Watches its own progress(); Ctrl+C requests a cancel there.
  Watch();
  /// Watches the progress of another owner; `cancel` is called from the watching thread.
  Watch(const Progress& shown, std::function<void()> cancel);
  /// Shows nothing.
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
  int signals_ = -1, wake_ = -1;  // descriptors: the signals that wait, and the end of the watch
  std::jthread thread_;           // last: everything above exists before it starts
};

}  // namespace dmoscope::app
