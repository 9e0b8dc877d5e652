#pragma once
// Changes of the active mesh from one view of the session to the next. Plain state.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "core/view/view.h"

namespace dmoscope::ui {

/// Change of the active mesh. Opened: another mesh in place of all open ones; ReadAgain: the same file read again; Beside: a mesh opened
/// beside the others; Switched: another of the open meshes.
enum class MeshChange { None, Opened, ReadAgain, Beside, Switched };

/// Follows the meshes of a session.
class MeshWatch {
 public:
  /// Change since the last call.
  [[nodiscard]] MeshChange follow(const SessionView& session);
  /// Whether the mesh has as many vertices and elements as the one before it, so that ids still mean something similar.
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
