#include "ui/overlays/mark_view.h"

#include <algorithm>

namespace dmoscope::ui {

bool MarkView::hides(Index vertex) const { return unhidden && !std::ranges::binary_search(unhidden->vertices, vertex); }

bool MarkView::hides(const EdgeEnds& edge) const {
  return unhidden && !std::ranges::binary_search(unhidden->edges, std::array{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
}

bool MarkView::sees(Index vertex, std::span<const Vec3> positions) const {
  return !hides(vertex) && view.holds(points.at(positions[vertex]));
}

bool MarkView::sees(const EdgeEnds& edge, std::span<const Vec3> positions) const {
  return !hides(edge) && (view.holds(points.at(positions[edge[0]])) || view.holds(points.at(positions[edge[1]])));
}

PlacesTaken::PlacesTaken(const MarkView& seen, double apart) : view_(seen.view), size_(apart * seen.scale) {
  const auto cells = [&](double length) { return static_cast<std::size_t>(std::clamp(length / size_, 0.0, 1e4)) + 1; };
  columns_ = cells(view_.viewport().x);
  rows_ = cells(view_.viewport().y);
  taken_.resize(columns_ * rows_);
}

bool PlacesTaken::take(Vec3 point) {
  const auto p = view_.place(point);
  if (!p) return false;
  const std::size_t cell = place(p->y + 0.5 * view_.viewport().y, rows_) * columns_ + place(p->x + 0.5 * view_.viewport().x, columns_);
  const bool is_new = !taken_[cell];
  taken_[cell] = true;
  return is_new;
}

std::size_t PlacesTaken::place(double at, std::size_t count) const {
  return static_cast<std::size_t>(std::clamp(at / size_, 0.0, static_cast<double>(count - 1)));
}

}  // namespace dmoscope::ui
