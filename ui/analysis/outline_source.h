#pragma once
// The boundary loops of the mesh that is open, found once somebody asks for them; of a large mesh on a thread of their own. No ImGui.

#include <future>
#include <memory>

#include "core/input/input_mesh.h"
#include "core/mesh/outline.h"

namespace dmoscope::ui {

class OutlineSource {
 public:
  /// Null while they are being found.
  [[nodiscard]] const Outline* of(const std::shared_ptr<const InputMesh>& input);
  /// Nothing is being found.
  [[nodiscard]] bool settled() const noexcept { return !pending_.valid(); }

 private:
  std::shared_ptr<const InputMesh> input_;  // whose they are
  std::shared_ptr<const Outline> outline_;
  std::future<std::shared_ptr<const Outline>> pending_;
};

}  // namespace dmoscope::ui
