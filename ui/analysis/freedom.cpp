#include "ui/analysis/freedom.h"

#include <algorithm>

namespace dmoscope::ui {

std::vector<std::uint8_t> freedom_of_elements(const Mesh& mesh, std::span<const std::uint8_t> fixed, const Domain* domain) {
  const auto of_vertex = [&](Index v) -> std::uint8_t {
    if (fixed[v] != 0) return 1;
    if (domain == nullptr || !domain->slides(v)) return 4;
    return domain->on_curve(v) ? 2 : 3;
  };
  std::vector<std::uint8_t> freedom(mesh.elements.size());
  for (Index e = 0; e < freedom.size(); ++e) {
    std::uint8_t least = 4;
    bool any_moves = false;
    for (const Index v : mesh.elements.corners(e)) {
      least = std::min(least, of_vertex(v));
      any_moves = any_moves || fixed[v] == 0;
    }
    freedom[e] = any_moves ? least : 0;
  }
  return freedom;
}

}  // namespace dmoscope::ui
