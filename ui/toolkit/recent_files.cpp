#include "ui/toolkit/recent_files.h"

#include <algorithm>
#include <filesystem>

namespace dmoscope::ui {

const std::vector<RecentFile>& RecentFiles::list(const std::vector<std::string>& files, double now) {
  const bool same = std::ranges::equal(files, files_, {}, {}, &RecentFile::path);
  if (same && now - asked_ < kSeconds) return files_;
  asked_ = now;
  files_.clear();
  for (const std::string& file : files) {
    std::error_code ignored;
    files_.push_back({file, !std::filesystem::exists(file, ignored)});
  }
  return files_;
}

}  // namespace dmoscope::ui
