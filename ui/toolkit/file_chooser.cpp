#include "ui/toolkit/file_chooser.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace dmoscope::ui {
namespace {

namespace fs = std::filesystem;

fs::path on_path(std::string_view program) {
  const char* variable = std::getenv("PATH");
  std::string_view rest = variable == nullptr ? "" : variable;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    const fs::path file = fs::path(rest.substr(0, end)) / program;
    rest.remove_prefix(std::min(end + 1, rest.size()));
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

std::vector<std::string> zenity_arguments(const fs::path& program, const ChooserWish& wish) {
  std::vector<std::string> out{program.string(), "--file-selection", "--title=" + wish.title};
  if (wish.save) out.insert(out.end(), {"--save", "--confirm-overwrite"});
  if (wish.several) out.insert(out.end(), {"--multiple", "--separator=\n"});
  out.push_back("--filename=" + (fs::path(wish.folder) / wish.name).string());
  if (!wish.endings.empty()) {
    std::string patterns;
    for (const std::string& ending : wish.endings) patterns += " *" + ending;
    out.push_back(fmt::format("--file-filter={} |{}", wish.filter_title, patterns));
    out.emplace_back("--file-filter=all files | *");
  }
  return out;
}

std::vector<std::string> kdialog_arguments(const fs::path& program, const ChooserWish& wish) {
  std::vector<std::string> out{program.string(), "--title", wish.title, wish.save ? "--getsavefilename" : "--getopenfilename"};
  if (wish.several) out.insert(out.begin() + 1, {"--multiple", "--separate-output"});
  out.push_back((fs::path(wish.folder) / wish.name).string());
  if (!wish.endings.empty()) {
    std::string patterns;
    for (const std::string& ending : wish.endings) patterns += (patterns.empty() ? "*" : " *") + ending;
    out.push_back(fmt::format("{} ({})\nall files (*)", wish.filter_title, patterns));
  }
  return out;
}

}  // namespace

fs::path chooser_program() {
  const char* desktop = std::getenv("XDG_CURRENT_DESKTOP");
  const bool kde = desktop != nullptr && std::string_view(desktop).find("KDE") != std::string_view::npos;
  const fs::path first = on_path(kde ? "kdialog" : "zenity");
  return first.empty() ? on_path(kde ? "zenity" : "kdialog") : first;
}

std::vector<std::string> chooser_arguments(const fs::path& program, const ChooserWish& wish) {
  return program.filename() == "kdialog" ? kdialog_arguments(program, wish) : zenity_arguments(program, wish);
}

/// The program at work, and the thread that waits for its answer.
struct FileChooser::Child {
  pid_t pid = -1;
  int out = -1;
  std::string program;
  bool several = false;  // several files may be chosen, one a line; else the whole output is one name
  std::atomic<bool> unwanted = false;
  std::mutex mutex;
  std::optional<ChooserOutcome> outcome;
  bool reaped = false;  // the id may belong to another process since
  std::jthread thread;

  Child() = default;
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    unwanted = true;
    terminate();
    if (thread.joinable()) thread.join();
    if (out >= 0) ::close(out);
  }
  void terminate() {
    const std::scoped_lock lock(mutex);
    if (!reaped && pid > 0) ::kill(-pid, SIGKILL);  // the whole process group, with the processes that it started
  }
  void wait(const std::function<void()>& wake);
  [[nodiscard]] ChooserOutcome outcome_of(int status, std::string text, bool at_once) const;
};

namespace {

std::vector<fs::path> lines_of(std::string_view text) {
  std::vector<fs::path> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (end > 0) lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

}  // namespace

ChooserOutcome FileChooser::Child::outcome_of(int status, std::string text, bool at_once) const {
  using Kind = ChooserOutcome::Kind;
  if (text.ends_with('\n')) text.pop_back();
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == 0 && !text.empty()) return {Kind::Chosen, several ? lines_of(text) : std::vector<fs::path>{text}, {}};
  // Both end with 1 when a person cancels, and also when there is no screen for them.
  if (code == 0 || (code == 1 && !at_once)) return {};
  return {Kind::Failed, {}, fmt::format("the desktop's file dialog ({}) did not open", program)};
}

void FileChooser::Child::wait(const std::function<void()>& wake) {
  constexpr std::chrono::milliseconds kAtOnce{150};
  const auto begin = std::chrono::steady_clock::now();
  std::string text;
  std::array<char, 4096> part{};
  while (!unwanted) {
    constexpr int kLookAgain = 100;  // milliseconds
    pollfd answer{out, POLLIN, 0};
    if (::poll(&answer, 1, kLookAgain) <= 0) continue;
    const ssize_t size = ::read(out, part.data(), part.size());
    if (size > 0) text.append(part.data(), static_cast<std::size_t>(size));
    if (size == 0 || (size < 0 && errno != EINTR)) break;
  }
  siginfo_t ended{};
  while (::waitid(P_PID, static_cast<id_t>(pid), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  {
    const std::scoped_lock lock(mutex);
    int status = 0;
    (void)::waitpid(pid, &status, 0);
    reaped = true;
    outcome = outcome_of(status, std::move(text), std::chrono::steady_clock::now() - begin < kAtOnce);
  }
  if (!unwanted && wake) wake();
}

FileChooser::FileChooser() = default;
FileChooser::~FileChooser() = default;

bool FileChooser::begin(const ChooserWish& wish, std::function<void()> wake, std::string& trouble) {
  child_.reset();
  const fs::path program = chooser_program();
  if (program.empty()) {
    trouble = "neither zenity nor kdialog is installed";
    return false;
  }
  int ends[2] = {-1, -1};
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    trouble = fmt::format("{}: {}", program.string(), std::strerror(errno));
    return false;
  }
  auto child = std::make_unique<Child>();
  child->program = program.filename().string();
  child->several = wish.several;
  child->out = ends[0];
  std::vector<std::string> words = chooser_arguments(program, wish);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);  // toolkits write many warnings
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // The window takes its signals on a thread of its own; the dialog must get them as any program does.
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  const int failure = ::posix_spawn(&child->pid, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failure != 0) {
    child->pid = -1;
    trouble = fmt::format("{}: {}", program.string(), std::strerror(failure));
    return false;
  }
  child->thread = std::jthread([raw = child.get(), wake = std::move(wake)] { raw->wait(wake); });
  child_ = std::move(child);
  return true;
}

bool FileChooser::open() const { return child_ != nullptr; }

void FileChooser::cancel() { child_.reset(); }

std::optional<ChooserOutcome> FileChooser::take() {
  if (!child_) return std::nullopt;
  std::optional<ChooserOutcome> outcome;
  {
    const std::scoped_lock lock(child_->mutex);
    outcome = child_->outcome;
  }
  if (outcome) child_.reset();
  return outcome;
}

}  // namespace dmoscope::ui
