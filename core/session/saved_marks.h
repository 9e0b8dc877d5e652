#pragma once
// What of the runs is in files: where they stood when they were exported, or saved with the session.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

class SavedMarks {
 public:
  enum class Kind { Mesh, Session };  // a session keeps the edits ahead, too

  /// This file was written: whatever it held of any run before is no more.
  void written(const std::filesystem::path& file);
  /// The file holds this run as it stands now.
  void add(const std::filesystem::path& file, Kind kind, const std::shared_ptr<const Run>& run);
  /// Whether ending now would lose something of a run: vertices have moved to where no file has them, or visits of chosen vertices are on
  /// its path that no file tells of. Of a run that stands at its input, or where none of its visits moved anything: no.
  [[nodiscard]] bool would_lose(const Run& run) const;

 private:
  struct Mark {
    std::filesystem::path file;
    Kind kind = Kind::Mesh;
    std::weak_ptr<const Run> run;
    Moment moment;
    Backend backend = Backend::Cpu;  // the last bits may be others after a device failed
    std::vector<Edit> edits;         // all of its path
    std::size_t done = 0;            // of these, up to the moment
  };
  std::vector<Mark> marks_;
};

}  // namespace dmoscope
