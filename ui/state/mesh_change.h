#pragma once
// What became of the mesh that is worked on, from one view of the session to the next. Plain state.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Nothing; another mesh in place of all that were open; the same file read again; a mesh beside those that were open; another of these.
enum class MeshChange { None, Opened, ReadAgain, Beside, Switched };

/// Follows which meshes a session has.
class MeshWatch {
 public:
  /// What has changed since the last call.
  [[nodiscard]] MeshChange follow(const SessionView& session);
  /// Whether the mesh has as many vertices and elements as the one before it: its ids mean something like the same.
  [[nodiscard]] bool same_ids() const noexcept { return same_ids_; }

 private:
  struct Known {
    std::uint64_t serial = 0;
    std::filesystem::path path;
    Index vertices = 0, elements = 0;
  };
  [[nodiscard]] MeshChange change_to(const Known& now, const std::vector<Known>& meshes) const;

  std::vector<Known> meshes_;
  Known active_;
  bool same_ids_ = false;
};

}  // namespace dmoscope::ui
