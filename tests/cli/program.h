#pragma once
// Runs of the program as a user would start it, and their output.

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace dmoscope::test {

struct Output {
  int code = -1;  // exit code; 128 + signal if a signal ended it, -1 if it exceeded its time
  std::string out, err;
};

struct Call {
  std::vector<std::string> arguments;
  std::string input;                       // standard input
  std::string output{};                    // target of standard output in place of Output::out, such as "/dev/full"
  bool display = false;                    // whether to keep DISPLAY and WAYLAND_DISPLAY
  std::chrono::milliseconds interrupt{0};  // > 0: send the signal after that long
  std::string interrupt_when{};            // text of standard output from which the delay counts
  int signal = 2;                          // SIGINT
  std::uint64_t file_limit = 0;            // > 0: greatest size of a file in bytes, as by ulimit -f
  std::chrono::seconds limit{300};
};
/// Runs the program, which is killed at the limit. Never throws for its failures.
Output run(const Call& call);
Output run(std::vector<std::string> arguments);

/// Whether the program reports that it cannot draw: built without OpenGL, or on a machine without EGL.
bool cannot_draw(const Output& output);

/// Standard output as JSON; fails the test (and returns null) if it is not exactly one object.
nlohmann::json json_of(const Output& output);

/// The report of `dmoscope smooth --json` about one mesh; fails the test if it does not succeed.
nlohmann::json smooth(const std::string& input, const std::string& output, std::vector<std::string> more);

/// A folder of its own for one test, removed with it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Writes a file and returns its path.
  [[nodiscard]] std::string file(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::string& path);
std::vector<std::string> lines_of(const std::string& text);
std::vector<std::string> split(const std::string& line, char separator);
bool exists(const std::string& path);

/// Path of a bundled sample.
std::string sample(const std::string& name);
/// Path below the shared meshes; empty if they are missing.
std::string shared_mesh(const std::string& name);

/// Rows of a CSV with a header: column name -> cells.
struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  [[nodiscard]] std::size_t column(const std::string& name) const;
  /// The cell as a number; NaN if it is empty.
  [[nodiscard]] double number(std::size_t row, const std::string& name) const;
};
Table read_table(const std::string& path);

}  // namespace dmoscope::test
