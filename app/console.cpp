#include "app/console.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <system_error>

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include "core/base/error.h"

namespace dmoscope::app {
namespace {

constexpr int kInterruptedExit = 130;  // what a shell expects of a program that Ctrl+C ended
constexpr int kPollsBeforeDrawing = 4;
constexpr long kPollNanoseconds = 50'000'000;

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

}  // namespace

void block_interrupts() {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
}

void complain(std::string_view text) { fmt::print(stderr, "dmoscope: {}\n", text); }

void flush_output() {
  errno = 0;
  const bool taken = std::fflush(stdout) == 0;
  const int reason = errno;
  if (taken && std::ferror(stdout) == 0) return;
  throw OutputError("standard output", reason == 0 ? "not everything could be written" : std::generic_category().message(reason));
}

Watch::Watch() : Watch(own_, [this] { own_.request_cancel(); }) {}

Watch::Watch(const Progress& shown, std::function<void()> cancel) : shown_(shown), cancel_(std::move(cancel)) {
  block_interrupts();
  thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

Watch::~Watch() {
  thread_.request_stop();
  thread_.join();
}

void Watch::draw(bool& drawn) const {
  const std::string label = shown_.label();
  if (label.empty()) return;
  fmt::print(stderr, "\r\x1b[K{} {:.0f} %", label, 100.0 * shown_.fraction());
  std::fflush(stderr);
  drawn = true;
}

void Watch::watch(const std::stop_token& stop) {
  const sigset_t set = interrupts();
  const bool terminal = isatty(STDERR_FILENO) == 1;
  bool drawn = false;
  bool asked = false;
  for (int poll = 1; !stop.stop_requested(); ++poll) {
    const timespec pause{0, kPollNanoseconds};
    if (sigtimedwait(&set, nullptr, &pause) > 0) {
      if (asked) std::_Exit(kInterruptedExit);
      asked = true;
      cancel_();
    } else if (terminal && poll >= kPollsBeforeDrawing) {
      draw(drawn);
    }
  }
  if (drawn) {
    fmt::print(stderr, "\r\x1b[K");
    std::fflush(stderr);
  }
}

}  // namespace dmoscope::app
