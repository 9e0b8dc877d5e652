#include "tests/cli/program.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dmoscope::test {
namespace {

using Clock = std::chrono::steady_clock;

struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    read = ends[0];
    write = ends[1];
  }
  ~Pipe() {
    close_end(read);
    close_end(write);
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
};

[[noreturn]] void become_program(const Call& call, const Pipe& in, const Pipe& out, const Pipe& err) {
  dup2(in.read, STDIN_FILENO);
  dup2(out.write, STDOUT_FILENO);
  dup2(err.write, STDERR_FILENO);
  if (!call.output.empty()) {
    const int output = open(call.output.c_str(), O_WRONLY | O_CLOEXEC);
    if (output < 0) _exit(126);
    dup2(output, STDOUT_FILENO);
  }
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) std::signal(signal, SIG_DFL);  // the tests' parent may ignore them
  if (call.file_limit > 0) {
    const rlimit limit{call.file_limit, call.file_limit};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  if (!call.display) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
  }
  std::vector<char*> arguments{const_cast<char*>(DMOSCOPE_PROGRAM)};
  for (const std::string& argument : call.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(DMOSCOPE_PROGRAM, arguments.data());
  _exit(127);
}

/// Reads all available bytes; closes the descriptor at the end of the stream.
void drain(int& end, std::string& text) {
  char buffer[65536];
  const ssize_t count = read(end, buffer, sizeof buffer);
  if (count > 0) {
    text.append(buffer, static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    Pipe::close_end(end);
  }
}

}  // namespace

Output run(const Call& call) {
  Pipe in, out, err;
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) become_program(call, in, out, err);
  Pipe::close_end(in.read);
  Pipe::close_end(out.write);
  Pipe::close_end(err.write);
  if (!call.input.empty() && write(in.write, call.input.data(), call.input.size()) < 0) ADD_FAILURE() << "standard input was not taken";
  Pipe::close_end(in.write);

  Output output;
  const auto start = Clock::now();
  auto awaited = start;
  bool interrupted = call.interrupt.count() == 0;
  bool killed = false;
  while (out.read >= 0 || err.read >= 0) {
    pollfd ends[2] = {{out.read, POLLIN, 0}, {err.read, POLLIN, 0}};
    poll(ends, 2, 20);
    if (ends[0].revents != 0) drain(out.read, output.out);
    if (ends[1].revents != 0) drain(err.read, output.err);
    const auto now = Clock::now();
    const auto passed = now - start;
    if (output.out.find(call.interrupt_when) == std::string::npos) awaited = now;
    if (!interrupted && now - awaited >= call.interrupt) {
      kill(child, call.signal);
      interrupted = true;
    }
    if (!killed && passed >= call.limit) {
      kill(child, SIGKILL);
      killed = true;
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (!killed) output.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return output;
}

Output run(std::vector<std::string> arguments) {
  Call call;
  call.arguments = std::move(arguments);
  return run(call);
}

bool cannot_draw(const Output& output) {
  const bool without_egl = output.code == 3 && output.err.find("EGL") != std::string::npos;
  return without_egl || output.err.find("without OpenGL") != std::string::npos;
}

nlohmann::json json_of(const Output& output) {
  nlohmann::json object = nlohmann::json::parse(output.out, nullptr, false);
  EXPECT_TRUE(object.is_object()) << "not one JSON object:\n" << output.out << output.err;
  return object;
}

nlohmann::json smooth(const std::string& input, const std::string& output, std::vector<std::string> more) {
  std::vector<std::string> arguments{"smooth", input, "-o", output, "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Output result = run(arguments);
  EXPECT_EQ(result.code, 0) << result.err;
  return json_of(result);
}

Folder::Folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "dmoscope-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code error;
  std::filesystem::remove_all(path_, error);
}

std::string Folder::file(const std::string& name, const std::string& bytes) const {
  const std::string path = *this / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  EXPECT_TRUE(stream.is_open()) << path;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == separator) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

bool exists(const std::string& path) { return std::filesystem::exists(std::filesystem::symlink_status(path)); }

std::string sample(const std::string& name) { return std::string(DMOSCOPE_SOURCE_DIR "/resources/samples/") + name; }

std::string shared_mesh(const std::string& name) {
  std::string path = std::string(DMOSCOPE_SHARED_DIR "/meshes/") + name;
  return exists(path) ? path : std::string();
}

std::size_t Table::column(const std::string& name) const {
  for (std::size_t i = 0; i < header.size(); ++i) {
    if (header[i] == name) return i;
  }
  throw std::runtime_error("no column " + name);
}

double Table::number(std::size_t row, const std::string& name) const {
  const std::string& cell = rows.at(row).at(column(name));
  return cell.empty() ? std::numeric_limits<double>::quiet_NaN() : std::stod(cell);
}

Table read_table(const std::string& path) {
  Table table;
  for (std::string line : lines_of(read_file(path))) {
    if (line.ends_with('\r')) line.pop_back();
    if (table.header.empty()) {
      table.header = split(line, ',');
    } else {
      table.rows.push_back(split(line, ','));
    }
  }
  return table;
}

}  // namespace dmoscope::test
