#pragma once
// Tells whether two meshes have the same elements, so that they can be compared element by element. No ImGui.

#include <memory>

#include "core/input/input_mesh.h"

namespace dmoscope::ui {

/// Whether both meshes have the same elements with the same corners, wherever their vertices are.
[[nodiscard]] bool same_elements(const InputMesh& a, const InputMesh& b);

/// Remembers the answer for the latest two meshes.
class Comparable {
 public:
  [[nodiscard]] bool operator()(const std::shared_ptr<const InputMesh>& a, const std::shared_ptr<const InputMesh>& b);

 private:
  std::weak_ptr<const InputMesh> a_, b_;
  bool same_ = false;
};

}  // namespace dmoscope::ui
