#include <algorithm>

#include "render/scene.h"

namespace dmoscope::render {

double suggested_detail(std::size_t element_count, bool is_software, bool moving) {
  // Elements that llvmpipe on two cores draws as squares well within 100 ms.
  constexpr double kAffordable = 150'000.0;
  if (!is_software || !moving || element_count == 0) return 1.0;
  return std::min(1.0, kAffordable / static_cast<double>(element_count));
}

}  // namespace dmoscope::render
