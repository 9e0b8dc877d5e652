#include "ui/analysis/comparable.h"

#include <algorithm>

namespace dmoscope::ui {

bool same_elements(const InputMesh& a, const InputMesh& b) {
  if (&a == &b) return true;
  return a.mesh.vertex_count() == b.mesh.vertex_count() && std::ranges::equal(a.mesh.elements.kinds(), b.mesh.elements.kinds()) &&
         std::ranges::equal(a.mesh.elements.all_corners(), b.mesh.elements.all_corners());
}

bool Comparable::operator()(const std::shared_ptr<const InputMesh>& a, const std::shared_ptr<const InputMesh>& b) {
  if (a == b) return true;
  if (a_.lock() == a && b_.lock() == b) return same_;
  a_ = a;
  b_ = b;
  return same_ = same_elements(*a, *b);
}

}  // namespace dmoscope::ui
