#include "core/mesh/delaunay.h"

#include <algorithm>
#include <utility>

#include "core/mesh/random.h"

namespace dmoscope {
namespace {

__extension__ using Wide = __int128;

/// Twice the signed area of (a, b, c).
std::int64_t orientation(GridPoint a, GridPoint b, GridPoint c) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{c.y} - a.y) - (std::int64_t{b.y} - a.y) * (std::int64_t{c.x} - a.x);
}

/// True when d lies strictly inside the circle through the counter-clockwise triangle (a, b, c).
bool in_circle(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  const auto lift = [d](GridPoint p) {
    const std::int64_t x = std::int64_t{p.x} - d.x;
    const std::int64_t y = std::int64_t{p.y} - d.y;
    return std::array<std::int64_t, 3>{x, y, x * x + y * y};
  };
  const auto [ax, ay, az] = lift(a);
  const auto [bx, by, bz] = lift(b);
  const auto [cx, cy, cz] = lift(c);
  return Wide{az} * (bx * cy - by * cx) + Wide{bz} * (cx * ay - cy * ax) + Wide{cz} * (ax * by - ay * bx) > 0;
}

/// Bits of x and y interleaved: points near in this order are near in the plane.
std::uint64_t morton(GridPoint p) {
  const auto spread = [](std::int32_t value) {
    std::uint64_t v = static_cast<std::uint32_t>(value) ^ 0x80000000U;
    v = (v | (v << 16U)) & 0x0000ffff0000ffffULL;
    v = (v | (v << 8U)) & 0x00ff00ff00ff00ffULL;
    v = (v | (v << 4U)) & 0x0f0f0f0f0f0f0f0fULL;
    v = (v | (v << 2U)) & 0x3333333333333333ULL;
    return (v | (v << 1U)) & 0x5555555555555555ULL;
  };
  return spread(p.x) | (spread(p.y) << 1U);
}

/// Order of insertion: rounds of growing size (each point is in the last with probability 1/2, ...), along the Morton curve inside each.
std::vector<Index> insertion_order(std::span<const GridPoint> points) {
  struct Key {
    std::uint32_t round;
    std::uint64_t curve;
    Index point;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  keys.reserve(points.size());
  Random random(0x5eed);
  for (Index i = 0; i < points.size(); ++i) {
    std::uint32_t round = 24;
    for (std::uint64_t coins = random.next(); round > 0 && (coins & 1U) != 0; coins >>= 1U) --round;
    keys.push_back({round, morton(points[i]), i});
  }
  std::ranges::sort(keys);
  std::vector<Index> order;
  order.reserve(keys.size());
  for (const Key& key : keys) order.push_back(key.point);
  return order;
}

/// Triangles with their neighbours; the outside of the hull is covered by triangles with the corner kOutside.
class Triangulation {
 public:
  explicit Triangulation(std::span<const GridPoint> points) : points_(points) { triangles_.reserve(points.size() * 2 + 8); }

  /// Begins with one triangle and the three outside ones around it.
  void begin(Index a, Index b, Index c) {
    if (orientation(points_[a], points_[b], points_[c]) < 0) std::swap(b, c);
    triangles_.push_back({{a, b, c}, {2, 3, 1}});
    triangles_.push_back({{b, a, kOutside}, {3, 2, 0}});
    triangles_.push_back({{c, b, kOutside}, {1, 3, 0}});
    triangles_.push_back({{a, c, kOutside}, {2, 1, 0}});
  }

  void insert(Index p) {
    const Index t = locate(p);
    if (has_corner(t, p)) return;
    split(t, p);
    while (!stack_.empty()) {
      const Index changed = stack_.back();
      stack_.pop_back();
      legalise(changed, p);
    }
  }

  [[nodiscard]] std::vector<std::array<Index, 3>> finite() const {
    std::vector<std::array<Index, 3>> result;
    for (const Triangle& t : triangles_) {
      if (std::ranges::find(t.corner, kOutside) == t.corner.end()) result.push_back(t.corner);
    }
    return result;
  }

 private:
  static constexpr Index kOutside = kNoIndex;
  struct Triangle {
    std::array<Index, 3> corner;
    std::array<Index, 3> neighbour;  // neighbour[i] lies across the edge opposite to corner[i]
  };

  [[nodiscard]] std::size_t outside_corner(Index t) const {
    return static_cast<std::size_t>(std::ranges::find(triangles_[t].corner, kOutside) - triangles_[t].corner.begin());
  }
  /// Whether the point is exactly at a corner of the triangle.
  [[nodiscard]] bool has_corner(Index t, Index p) const {
    return std::ranges::any_of(triangles_[t].corner, [&](Index c) { return c != kOutside && points_[c] == points_[p]; });
  }

  /// A triangle that p lies in or on, or an outside one whose hull edge p lies beyond. Walks from the last triangle found.
  Index locate(Index p) {
    Index t = last_;
    if (const std::size_t o = outside_corner(t); o < 3) t = triangles_[t].neighbour[o];
    for (bool moved = true; moved;) {
      moved = false;
      const std::size_t start = turn_++ % 3;  // begins at a changing edge, so that no walk runs in circles
      for (std::size_t k = 0; k < 3 && !moved; ++k) {
        const std::size_t i = (start + k) % 3;
        const Index a = triangles_[t].corner[(i + 1) % 3];
        const Index b = triangles_[t].corner[(i + 2) % 3];
        if (orientation(points_[a], points_[b], points_[p]) < 0) {
          t = triangles_[t].neighbour[i];
          moved = true;
        }
      }
      if (moved && outside_corner(t) < 3) break;
    }
    return t;
  }

  void replace_neighbour(Index t, Index from, Index to) {
    for (Index& n : triangles_[t].neighbour) {
      if (n == from) {
        n = to;
        return;
      }
    }
  }

  /// Splits a triangle into three around p; p is corner 0 of each.
  void split(Index t, Index p) {
    const Triangle old = triangles_[t];
    const auto b = static_cast<Index>(triangles_.size());
    const Index c = b + 1;
    triangles_[t] = {{p, old.corner[1], old.corner[2]}, {old.neighbour[0], b, c}};
    triangles_.push_back({{p, old.corner[2], old.corner[0]}, {old.neighbour[1], c, t}});
    triangles_.push_back({{p, old.corner[0], old.corner[1]}, {old.neighbour[2], t, b}});
    replace_neighbour(old.neighbour[1], t, b);
    replace_neighbour(old.neighbour[2], t, c);
    stack_.insert(stack_.end(), {t, b, c});
    last_ = t;
  }

  /// Whether p violates the triangle's empty circle; the circle of an outside triangle is the open half-plane beyond its edge and that
  /// edge.
  [[nodiscard]] bool conflicts(Index t, Index p) const {
    const auto& corner = triangles_[t].corner;
    const std::size_t o = outside_corner(t);
    if (o == 3) return in_circle(points_[corner[0]], points_[corner[1]], points_[corner[2]], points_[p]);
    const GridPoint a = points_[corner[(o + 1) % 3]];
    const GridPoint b = points_[corner[(o + 2) % 3]];
    const GridPoint q = points_[p];
    const std::int64_t side = orientation(a, b, q);
    if (side != 0) return side > 0;
    return (std::int64_t{q.x} - a.x) * (std::int64_t{q.x} - b.x) + (std::int64_t{q.y} - a.y) * (std::int64_t{q.y} - b.y) < 0;
  }

  /// Flips the edge opposite to p in t (p is its corner 0) if the triangle beyond conflicts.
  void legalise(Index t, Index p) {
    const Index n = triangles_[t].neighbour[0];
    if (!conflicts(n, p)) return;
    const Triangle inner = triangles_[t];
    const Triangle outer = triangles_[n];
    const auto i = static_cast<std::size_t>(std::ranges::find(outer.neighbour, t) - outer.neighbour.begin());
    const Index far = outer.corner[i];
    // Turns inner = (p, a, b) and outer = (far, b, a) into (p, a, far) and (p, far, b).
    const Index a = inner.corner[1];
    const Index b = inner.corner[2];
    const Index beyond_b = outer.neighbour[(i + 2) % 3];  // across (far, b)
    const Index beyond_a = outer.neighbour[(i + 1) % 3];  // across (a, far)
    triangles_[t] = {{p, a, far}, {beyond_a, n, inner.neighbour[2]}};
    triangles_[n] = {{p, far, b}, {beyond_b, inner.neighbour[1], t}};
    replace_neighbour(beyond_a, n, t);
    replace_neighbour(inner.neighbour[1], t, n);
    stack_.push_back(t);
    stack_.push_back(n);
  }

  std::span<const GridPoint> points_;
  std::vector<Triangle> triangles_;
  std::vector<Index> stack_;
  Index last_ = 0;
  std::size_t turn_ = 0;
};

}  // namespace

std::vector<std::array<Index, 3>> delaunay(std::span<const GridPoint> points, Progress& progress) {
  std::vector<Index> order = insertion_order(points);
  // Puts three points that span a triangle first.
  const auto differs = std::find_if(order.begin(), order.end(), [&](Index i) { return !(points[i] == points[order[0]]); });
  if (differs == order.end()) return {};
  std::iter_swap(order.begin() + 1, differs);
  const auto third = std::find_if(order.begin() + 2, order.end(),
                                  [&](Index i) { return orientation(points[order[0]], points[order[1]], points[i]) != 0; });
  if (third == order.end()) return {};
  std::iter_swap(order.begin() + 2, third);

  Triangulation triangulation(points);
  triangulation.begin(order[0], order[1], order[2]);
  for (std::size_t i = 3; i < order.size(); ++i) {
    if (i % 4096 == 0) {
      progress.check();
      progress.set(static_cast<double>(i) / static_cast<double>(order.size()));
    }
    triangulation.insert(order[i]);
  }
  progress.set(1.0);
  return triangulation.finite();
}

}  // namespace dmoscope
