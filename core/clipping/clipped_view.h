#pragma once
// The part of a volume mesh that the user chose to see. Plain data.

#include <optional>
#include <utility>

#include "core/base/vec.h"

namespace dmoscope {

/// The plane dot(normal, x) == offset; the part beyond it, where the product is greater, is taken away.
struct ClipPlane {
  enum class Mode {
    Crinkle,  // whole cells stay that have a part on the near side
    Cut       // cells on the plane are cut through
  };
  bool on = false;
  Vec3 normal{1, 0, 0};  // normal, of any length but 0
  double offset = 0.0;
  bool flip = false;  // the near side is taken away instead
  Mode mode = Mode::Crinkle;
  /// Signed distance of a point beyond the plane, in units of the normal's length; a positive one is taken away.
  [[nodiscard]] double beyond(Vec3 point) const { return flip ? offset - dot(normal, point) : dot(normal, point) - offset; }
  friend bool operator==(const ClipPlane&, const ClipPlane&) = default;
};

/// Settings that take cells away: a cell is visible if none of them takes it away. By default all are.
struct ClippingView {
  ClipPlane clip;
  Index peel = 0;                                  // number of layers of cells taken off the boundary
  std::optional<float> peel_quality;               // cells of a higher quality are taken away; inverted and undefined ones stay
  std::optional<std::pair<float, float>> isolate;  // cells within the range stay; inverted ones if it begins at 0 or below
  std::size_t worst = 0;                           // if > 0, only this many cells of the lowest quality of the whole mesh stay
  bool ghost = false;                              // whether the boundary of the hidden part is shown faintly
  double shrink = 1.0;                             // size at which every cell is drawn about its vertices' mean, (0, 1]
  friend bool operator==(const ClippingView&, const ClippingView&) = default;
  [[nodiscard]] bool by_quality() const noexcept { return peel_quality || isolate || worst > 0; }
};

}  // namespace dmoscope
