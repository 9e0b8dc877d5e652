#pragma once
// Recent files, and whether they are still there.

#include <string>
#include <vector>

namespace dmoscope::ui {

struct RecentFile {
  std::string path;
  bool missing = false;
  /// Why it cannot be opened; empty when it can.
  [[nodiscard]] std::string reason() const { return missing ? path + ": this file is not there any more" : std::string(); }
};

/// Asks the file system now and then, not at every frame.
class RecentFiles {
 public:
  static constexpr double kSeconds = 2.0;
  /// `files` with what is known of them at `now` (seconds).
  [[nodiscard]] const std::vector<RecentFile>& list(const std::vector<std::string>& files, double now);

 private:
  std::vector<RecentFile> files_;
  double asked_ = -1e9;
};

}  // namespace dmoscope::ui
