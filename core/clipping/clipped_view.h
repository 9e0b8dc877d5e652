#pragma once
// What a person has chosen to see of a volume mesh. Plain data.

#include <optional>
#include <utility>

#include "core/base/vec.h"

namespace dmoscope {

/// The plane dot(normal, x) == offset; what lies beyond it, where the product is greater, is taken away.
struct ClipPlane {
  enum class Mode {
    Crinkle,  // whole cells: those that have a part on the near side stay
    Cut       // these are cut through
  };
  bool on = false;
  Vec3 normal{1, 0, 0};  // of any length but 0
  double offset = 0.0;
  bool flip = false;  // what lies on the near side is taken away instead
  Mode mode = Mode::Crinkle;
  /// How far beyond the plane a point is, in units of the normal's length; greater than 0 is taken away.
  [[nodiscard]] double beyond(Vec3 point) const { return flip ? offset - dot(normal, point) : dot(normal, point) - offset; }
  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// Everything that takes cells away works together: a cell is seen when nothing takes it away. The default: all are.
struct ClippingView {
  ClipPlane clip;
  Index peel = 0;                                  // layers of cells taken off the boundary
  std::optional<float> peel_quality;               // cells of a higher quality are taken away; inverted ones and undefined ones stay
  std::optional<std::pair<float, float>> isolate;  // cells within the range stay; inverted ones when it begins at 0 or below
  std::size_t worst = 0;                           // > 0: only this many cells of the lowest quality of the whole mesh stay
  bool ghost = false;                              // the boundary of what was taken away is shown faintly
  double shrink = 1.0;                             // (0, 1]: every cell is drawn that large about its vertices' mean
  friend bool operator==(const ClippingView&, const ClippingView&) = default;
  [[nodiscard]] bool by_quality() const noexcept { return peel_quality || isolate || worst > 0; }
};

}  // namespace dmoscope
