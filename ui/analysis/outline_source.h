#pragma once
// Boundary loops of the open mesh, found on demand; for a large mesh on a thread of their own. No ImGui.

#include <future>
#include <memory>

#include "core/input/input_mesh.h"
#include "core/mesh/outline.h"

namespace dmoscope::ui {

class OutlineSource {
 public:
  /// Outline of a mesh; null while it is being found.
  [[nodiscard]] const Outline* of(const std::shared_ptr<const InputMesh>& input);
  /// Whether nothing is being found.
  [[nodiscard]] bool settled() const noexcept { return !pending_.valid(); }

 private:
  std::shared_ptr<const InputMesh> input_;  // mesh that they belong to
  std::shared_ptr<const Outline> outline_;
  std::future<std::shared_ptr<const Outline>> pending_;
};

}  // namespace dmoscope::ui
