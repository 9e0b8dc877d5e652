#include "core/mesh/nodal_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmoscope {

namespace {
constexpr double kMostCellsAnAxis = 4096.0;
constexpr std::size_t kMostCellsAnElement = 16;  // cells listed for an element on average, besides one for every cell
}  // namespace

NodalField::NodalField(const Mesh& mesh, const Topology& topology, const Plane& plane, std::vector<double> values)
    : mesh_(mesh), topology_(topology), plane_(plane), values_(std::move(values)) {
  if (mesh_.positions.empty()) return;
  origin_ = mesh_.positions.front();
  low_ = high_ = flat(0);
  for (Index v = 1; v < mesh_.vertex_count(); ++v) {
    const Point p = flat(v);
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
  }
  const double extent = std::max(high_.x - low_.x, high_.y - low_.y);
  const double cells = std::clamp(std::sqrt(static_cast<double>(mesh_.vertex_count())), 1.0, kMostCellsAnAxis);
  set_width(extent > 0.0 ? extent / cells : 1.0);
  while (is_crowded()) set_width(2.0 * width_);
  elements_ = fill([this](const auto& put) {
    for (Index e = 0; e < mesh_.elements.size(); ++e)
      for_images(e, [&](const CellBox& box) {
        for (int j = box.bottom; j <= box.top; ++j)
          for (int i = box.left; i <= box.right; ++i) put(cell(i, j), e);
      });
  });
  vertices_ = fill([this](const auto& put) {
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      if (const Point p = flat(v); !topology_.star(v).empty()) put(cell(column(p.x), row(p.y)), v);
  });
}

NodalField::Point NodalField::flat(Index vertex) const { return plane_.project(mesh_.positions[vertex] - origin_); }

/// Place of a vertex in the plane; on a mesh that wraps, its copy nearest to `p`.
NodalField::Point NodalField::flat_near(Index vertex, Point p) const {
  Point at = flat(vertex);
  if (plane_.period > 0.0 && at.x - p.x > 0.5 * plane_.period) at.x -= plane_.period;
  if (plane_.period > 0.0 && p.x - at.x > 0.5 * plane_.period) at.x += plane_.period;
  return at;
}

int NodalField::column(double x) const { return static_cast<int>(std::clamp((x - low_.x) / width_, 0.0, columns_ - 1.0)); }
int NodalField::row(double y) const { return static_cast<int>(std::clamp((y - low_.y) / width_, 0.0, rows_ - 1.0)); }
std::size_t NodalField::cell(int i, int j) const {
  return static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
}

void NodalField::set_width(double width) {
  width_ = width;
  columns_ = static_cast<int>((high_.x - low_.x) / width_) + 1;
  rows_ = static_cast<int>((high_.y - low_.y) / width_) + 1;
}

/// Whether the elements' boxes touch too many cells to list: each of many long elements, such as those of a fan, fills most of the grid.
bool NodalField::is_crowded() const {
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  if (cells <= kMostCellsAnElement) return false;
  const std::size_t most = kMostCellsAnElement * mesh_.elements.size() + cells;
  std::size_t count = 0;
  for (Index e = 0; e < mesh_.elements.size() && count <= most; ++e) for_images(e, [&](const CellBox& box) { count += box.count(); });
  return count > most;
}

/// Cells that an element's box touches, unwrapped from its first corner and moved by `shift` along x.
NodalField::CellBox NodalField::cells_of(Index element, double shift) const {
  const auto corners = mesh_.elements.corners(element);
  const Point first = flat(corners[0]);
  Point low = first, high = low;
  for (const Index corner : corners.subspan(1)) {
    const Point p = flat_near(corner, first);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {column(low.x + shift), row(low.y), column(high.x + shift), row(high.y)};
}

/// Calls visit(cells) for the element and, if it lies across the seam, for its image on the other side.
template <class Visit>
void NodalField::for_images(Index element, const Visit& visit) const {
  visit(cells_of(element));
  if (!(plane_.period > 0.0)) return;
  const auto corners = mesh_.elements.corners(element);
  const double first = flat(corners[0]).x;
  for (const Index corner : corners.subspan(1)) {
    const double away = flat(corner).x - first;
    if (std::abs(away) > 0.5 * plane_.period) return visit(cells_of(element, away > 0.0 ? plane_.period : -plane_.period));
  }
}

/// Builds lists of members by cell. for_members(put) calls put(cell, member) for every member in ascending order; it is called twice.
template <class ForMembers>
NodalField::Cells NodalField::fill(const ForMembers& for_members) const {
  Cells cells;
  cells.offsets.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
  for_members([&](std::size_t cell, Index) { ++cells.offsets[cell + 1]; });
  for (std::size_t c = 1; c < cells.offsets.size(); ++c) cells.offsets[c] += cells.offsets[c - 1];
  cells.members.resize(cells.offsets.back());
  std::vector<std::size_t> next(cells.offsets.begin(), cells.offsets.end() - 1);
  for_members([&](std::size_t cell, Index member) { cells.members[next[cell]++] = member; });
  return cells;
}

/// Interpolated value in a triangle; none if `p` lies outside.
std::optional<double> NodalField::in_triangle(Index a, Index b, Index c, Point p) const {
  const Point at_a = flat_near(a, p), ab = flat_near(b, p) - at_a, ac = flat_near(c, p) - at_a, ap = p - at_a;
  const double area = cross(ab, ac);
  if (area == 0.0) return std::nullopt;
  const double at_b = cross(ap, ac) / area, at_c = cross(ab, ap) / area;
  constexpr double kRounding = 1e-12;  // tolerance, so that no place falls between two elements
  if (!(at_b >= -kRounding && at_c >= -kRounding && at_b + at_c <= 1.0 + kRounding)) return std::nullopt;
  return values_[a] + at_b * (values_[b] - values_[a]) + at_c * (values_[c] - values_[a]);
}

std::optional<double> NodalField::in_element(Index element, Point p) const {
  const auto corners = mesh_.elements.corners(element);
  if (const auto value = in_triangle(corners[0], corners[1], corners[2], p)) return value;
  return corners.size() == 4 ? in_triangle(corners[0], corners[2], corners[3], p) : std::nullopt;
}

/// The vertex nearest to `p`; the first of several.
Index NodalField::nearest(Point p) const {
  Index best = kNoIndex;
  double least = HUGE_VAL;
  look_around(p, best, least);
  if (plane_.period > 0.0)
    for (const double shift : {-plane_.period, plane_.period}) look_around({p.x + shift, p.y}, best, least);
  return best;
}

/// Searches rings of cells around `p` for a vertex nearer than `least`, until all remaining ones are farther away.
void NodalField::look_around(Point p, Index& best, double& least) const {
  const int column_of_p = column(p.x), row_of_p = row(p.y);
  const auto look = [&](int i, int j) {
    if (i < 0 || i >= columns_ || j < 0 || j >= rows_) return;
    for (const Index v : vertices_.of(cell(i, j))) {
      const Point d = flat(v) - p;
      const double square = dot(d, d);
      if (square < least || (square == least && v < best)) {
        least = square;
        best = v;
      }
    }
  };
  for (int ring = 0; ring < std::max(columns_, rows_); ++ring) {
    // Lower bound of distances: seen from the place in the grid that is nearest to p, nothing in ring r is nearer than r - 1 cells.
    const double reach = (ring - 1) * width_;
    if (best != kNoIndex && ring > 0 && reach * reach > least) break;
    for (int i = column_of_p - ring; i <= column_of_p + ring; ++i)
      for (const int j : {row_of_p - ring, row_of_p + ring}) look(i, j);
    for (int j = row_of_p - ring + 1; j < row_of_p + ring; ++j)
      for (const int i : {column_of_p - ring, column_of_p + ring}) look(i, j);
  }
}

double NodalField::at(Index near, Vec3 place) const {
  const Point p = plane_.project(place - origin_);
  for (const Incidence& incidence : topology_.star(near))
    if (const auto value = in_element(incidence.element, p)) return *value;
  for (const Index element : elements_.of(cell(column(p.x), row(p.y))))
    if (const auto value = in_element(element, p)) return *value;
  return values_[nearest(p)];
}

}  // namespace dmoscope
