#pragma once
// Recent files, and whether they still exist.

#include <string>
#include <vector>

namespace dmoscope::ui {

struct RecentFile {
  std::string path;
  bool missing = false;
  /// Reason why it cannot be opened; empty when it can.
  [[nodiscard]] std::string reason() const { return missing ? path + ": this file is not there any more" : std::string(); }
};

/// Recent files that ask the file system now and then, not at every frame.
class RecentFiles {
 public:
  static constexpr double kSeconds = 2.0;
  /// The files with the facts known at `now` (seconds).
  [[nodiscard]] const std::vector<RecentFile>& list(const std::vector<std::string>& files, double now);

 private:
  std::vector<RecentFile> files_;
  double asked_ = -1e9;
};

}  // namespace dmoscope::ui
