#pragma once
// Who comes first to a place of the picture.

#include <algorithm>
#include <vector>

#include "render/camera.h"

namespace dmoscope::ui {

/// Which cells of a window are taken. What lies beside it shares the cells along its rim.
class CellsTaken {
 public:
  CellsTaken(const render::Bounds2& window, double size)
      : low_(window.low), size_(size), columns_(cells(window.size().x)), rows_(cells(window.size().y)), taken_(columns_ * rows_) {}
  /// False where another one came first.
  bool take(Vec2<double> p) {
    const std::size_t cell = place(p.y - low_.y, rows_) * columns_ + place(p.x - low_.x, columns_);
    const bool is_new = !taken_[cell];
    taken_[cell] = true;
    return is_new;
  }

 private:
  [[nodiscard]] std::size_t cells(double length) const { return static_cast<std::size_t>(std::clamp(length / size_, 0.0, 1e4)) + 1; }
  [[nodiscard]] std::size_t place(double at, std::size_t count) const {
    return static_cast<std::size_t>(std::clamp(at / size_, 0.0, static_cast<double>(count - 1)));
  }

  Vec2<double> low_;
  double size_;
  std::size_t columns_, rows_;
  std::vector<bool> taken_;
};

}  // namespace dmoscope::ui
