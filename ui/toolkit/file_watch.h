#pragma once
// Notices when a file has been written anew, without asking the file system from the window's thread.

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace dmoscope::ui {

/// Facts that differ between states of a file.
struct FileStamp {
  std::filesystem::file_time_type time;
  std::uintmax_t size = 0;
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Judges stamps over time: a file counts as written anew once it differs from before and has not changed for kStable seconds, so that a
/// file is left alone while it is being written.
class ChangeJudge {
 public:
  static constexpr double kStable = 0.5;
  /// Starts from a known state.
  void start(std::optional<FileStamp> known);
  /// Looks at the stamp at `now` (seconds). True once for every change.
  [[nodiscard]] bool look(const std::optional<FileStamp>& stamp, double now);
  /// Whether a change has been seen and may not be over.
  [[nodiscard]] bool expecting() const noexcept { return changed_.has_value(); }

 private:
  std::optional<FileStamp> known_, changed_;
  double since_ = 0.0;
};

class FileWatch {
 public:
  /// `wake`: called from the watching thread when there is a change to take.
  explicit FileWatch(std::function<void()> wake);
  ~FileWatch() = default;
  FileWatch(const FileWatch&) = delete;
  FileWatch& operator=(const FileWatch&) = delete;

  /// Watches this file from its state now on; an empty path: nothing. Cheap when it is watched already.
  void follow(const std::string& file);
  /// True once after the file was written anew.
  [[nodiscard]] bool take_change();

 private:
  void watch(const std::stop_token& stop);

  std::function<void()> wake_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::string file_;
  std::uint64_t serial_ = 0;  // serial of file_
  bool news_ = false;
  std::jthread thread_;  // declared last: everything above exists before it starts
};

}  // namespace dmoscope::ui
