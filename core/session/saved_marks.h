#pragma once
// States of runs that are in files: exported, or saved with the session.

#include <filesystem>
#include <memory>
#include <vector>

#include "core/run/run.h"

namespace dmoscope {

class SavedMarks {
 public:
  enum class Kind { Mesh, Session };  // a session also has the edits ahead

  /// Records that a file was written: its former contents are lost.
  void written(const std::filesystem::path& file);
  /// Records that a file holds this run in its present state.
  void add(const std::filesystem::path& file, Kind kind, const std::shared_ptr<const Run>& run);
  /// Whether ending now would lose something of a run: positions that no file has, or visits of chosen vertices on its path that no file
  /// records. False for a run at its input, or if none of its visits moved anything.
  [[nodiscard]] bool would_lose(const Run& run) const;

 private:
  struct Mark {
    std::filesystem::path file;
    Kind kind = Kind::Mesh;
    std::weak_ptr<const Run> run;
    Moment moment;
    Backend backend = Backend::Cpu;  // backend at that moment: the last bits may differ after a device failed
    std::vector<Edit> edits;         // all edits of its path
    std::size_t done = 0;            // number of edits up to the moment
  };
  std::vector<Mark> marks_;
};

}  // namespace dmoscope
