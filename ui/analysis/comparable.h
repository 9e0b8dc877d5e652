#pragma once
// Whether the elements of two meshes are the same ones, so that element by element they can be compared. No ImGui.

#include <memory>

#include "core/input/input_mesh.h"

namespace dmoscope::ui {

/// Whether both meshes have the same elements with the same corners, wherever their vertices are.
[[nodiscard]] bool same_elements(const InputMesh& a, const InputMesh& b);

/// Remembers the answer for the two meshes that were asked about last.
class Comparable {
 public:
  [[nodiscard]] bool operator()(const std::shared_ptr<const InputMesh>& a, const std::shared_ptr<const InputMesh>& b);

 private:
  std::weak_ptr<const InputMesh> a_, b_;
  bool same_ = false;
};

}  // namespace dmoscope::ui
