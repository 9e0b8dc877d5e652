#include "app/common/console.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <system_error>

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "core/base/error.h"

namespace dmoscope::app {
namespace {

constexpr int kInterruptedExit = 130;  // the exit code by which a shell knows that Ctrl+C ended a program
constexpr int kPollsBeforeDrawing = 4;
constexpr int kPollMilliseconds = 50;

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    struct sigaction now {};
    if (sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN) continue;  // if blocked, an ignored signal would be delivered
    sigaddset(&set, signal);
  }
  return set;
}

int opened(int descriptor) {
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "watching for signals");
  return descriptor;
}

}  // namespace

void block_interrupts() {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void ignore_file_limit_signal() { (void)std::signal(SIGXFSZ, SIG_IGN); }

void complain(std::string_view text, std::string_view hint) {
  fmt::print(stderr, "dmoscope: {}\n{}{}", terminal_line(text), hint, hint.empty() ? "" : "\n");
}

void print_lines(std::string_view text) { fmt::print("{}", terminal_lines(text)); }

void flush_output() {
  errno = 0;
  const bool taken = std::fflush(stdout) == 0;
  const int reason = errno;
  if (taken && std::ferror(stdout) == 0) return;
  throw OutputError("standard output", reason == 0 ? "not everything could be written" : std::generic_category().message(reason));
}

Watch::Watch() : Watch(own_, [this] { own_.request_cancel(); }) {}

Watch::Watch(const Progress& shown, std::function<void()> cancel) : Watch(shown, std::move(cancel), false) {}

Watch::Watch(std::function<void()> cancel) : Watch(own_, std::move(cancel), true) {}

Watch::Watch(const Progress& shown, std::function<void()> cancel, bool quiet) : shown_(shown), cancel_(std::move(cancel)), quiet_(quiet) {
  block_interrupts();
  const sigset_t set = interrupts();
  signals_ = opened(signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
  wake_ = opened(eventfd(0, EFD_CLOEXEC));
  thread_ = std::jthread([this] { watch(); });
}

Watch::~Watch() {
  constexpr std::uint64_t kOne = 1;
  (void)!write(wake_, &kOne, sizeof kOne);
  thread_.join();
  close(signals_);
  close(wake_);
}

void Watch::draw(bool& drawn) const {
  const std::string label = shown_.label();
  if (label.empty()) return;
  fmt::print(stderr, "\r\x1b[K{} {:.0f} %", terminal_line(label), 100.0 * shown_.fraction());
  std::fflush(stderr);
  drawn = true;
}

void Watch::watch() {
  const bool terminal = !quiet_ && isatty(STDERR_FILENO) == 1;
  std::array<pollfd, 2> events{{{signals_, POLLIN, 0}, {wake_, POLLIN, 0}}};
  bool drawn = false;
  bool asked = false;
  for (int polls = 1;; ++polls) {
    // Sleeps until an event without a terminal, since there is nothing to draw.
    (void)poll(events.data(), events.size(), terminal ? kPollMilliseconds : -1);
    if (events[1].revents != 0) break;
    signalfd_siginfo came{};
    if (events[0].revents != 0 && read(signals_, &came, sizeof came) == sizeof came) {
      if (asked) std::_Exit(kInterruptedExit);
      asked = true;
      cancel_();
    } else if (terminal && polls >= kPollsBeforeDrawing) {
      draw(drawn);
    }
  }
  if (drawn) {
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
  }
}

}  // namespace dmoscope::app
