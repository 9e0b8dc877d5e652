#pragma once
// Finds the candidates of a planar grid that may win, for two aims by which a star of triangles keeps the places in convex sets: those
// where its least mean ratio is above a value, and where its least angle is (or its scaled Jacobian, which rises with the least angle), or
// the vertex's distance from a wanted place is below one. A candidate that is no better than the best so far lies outside of one of these
// sets, and the tangent there cuts off a half-plane of them. In float, with room for all rounding: the few candidates that are left are for
// an exact look.
//
// Only composite_kernel_impl.h includes it; see lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/smooth/kernels/composite_kernel.h"

namespace dmoscope::composite {

/// Cuts in the plane. F: pack of floats, a triangle per slot.
template <class F>
class PlanarCuts {
 public:
  using Offset = Vec2<double>;
  using Task = CompositeSearch<Plane>;
  /// Set of candidates: candidate (i, j) is bit kStride * i + j.
  using Candidates = std::uint64_t;
  static constexpr std::size_t kStride = 8;

  /// Returns whether it can tell anything of this task. Its first metric must be the mean ratio.
  static bool speaks_for(const Task& task) {
    if (task.points > static_cast<int>(kStride) || task.star.quadrilaterals.size > 0 || task.star.simplices.size == 0) return false;
    if (task.second == Task::Second::Metric) return task.metric == Metric::MinAngle || task.metric == Metric::ScaledJacobian;
    // Leaves out other sizes: there the exact search rounds densities of places that are apart to the same number.
    return task.second == Task::Second::Density && task.edge > 1e-2 && task.edge < 1e3;
  }

  /// Takes the star's triangles.
  void take(const Task& task) {
    by_angle_ = task.second == Task::Second::Metric;
    threshold_ = static_cast<float>(task.threshold);
    wanted_ = {static_cast<float>(task.wanted.x), static_cast<float>(task.wanted.y)};
    points_ = static_cast<std::size_t>(task.points);
    all_ = 0;
    for (std::size_t i = 0; i < points_; ++i) all_ |= ((Candidates{1} << points_) - 1) << (kStride * i);
    packs_ = (task.star.simplices.size + kWidth - 1) / kWidth;
    reach_of_star_ = 0.0F;
    for (std::size_t pack = 0; pack < packs_; ++pack) take_pack(task, pack);
  }

  /// Side of the threshold on which a place is, where the star is sound. Unsure: rounding may decide, or an element may be inverted.
  enum class Side : std::uint8_t { Beyond, Short, Unsure };
  /// Goes to the grid around `centre` whose candidates stand at x[i], y[j]; returns the centre's side.
  Side begin(Offset centre, const double* x, const double* y) {
    float reach = reach_of_star_;
    for (std::size_t i = 0; i < points_; ++i) {
      const auto row = static_cast<float>(y[i]), column = static_cast<float>(x[i]);
      for (std::size_t j = 0; j < kStride; ++j) x_[kStride * i + j] = column;
      for (std::size_t k = i; k < kRow; k += kStride) y_[k] = row;
      reach = greater(reach, greater(std::fabs(column), std::fabs(row)));
    }
    if (!by_angle_) reach = greater(reach, greater(std::fabs(wanted_.x), std::fabs(wanted_.y)));
    room_ = kRounding * reach * reach;
    place_of_centre_ = {static_cast<float>(centre.x), static_cast<float>(centre.y)};
    centre_ = reached_at(place_of_centre_);
    if (centre_.first > threshold_) return Side::Beyond;
    return centre_.first > 0.0F && centre_.most_first < threshold_ ? Side::Short : Side::Unsure;
  }

  struct Left {
    Candidates hopeful = 0;   // candidates that may be better than the centre
    bool has_winner = false;  // whether there is one that is certain to be better than the centre
  };
  /// Searches a grid. `beyond`: whether the centre is beyond the threshold. The star must be sound there.
  Left search(bool beyond) {
    begin_at_centre(beyond);
    std::array<Hopeful, kStride * kStride> found;
    std::size_t count = 0;
    while (open_ != 0) {
      const std::size_t bit = middle();
      open_ &= ~(Candidates{1} << bit);
      const Point p{x_[bit], y_[bit % kRow]};
      if (const Look look = look_at(p); look.is_hopeful) {
        const Reached reached = reached_at(p);
        note(reached);
        found[count++] = {bit, reached, beyond_};
        cut(p, worst_of(reached));
      } else {
        cut(p, look.worst);
      }
    }
    Left left;
    for (std::size_t k = 0; k < count; ++k) {
      const Reached& reached = found[k].reached;
      if (beyond_ && found[k].beyond && reached.most_second < second_) continue;
      const bool is_beyond = reached.first > threshold_;
      left.has_winner = left.hopeful == 0 &&
                        (beyond ? is_beyond && reached.second > centre_.most_second : is_beyond || reached.first > centre_.most_first);
      left.hopeful |= Candidates{1} << found[k].bit;
    }
    return left;
  }

 private:
  static constexpr std::size_t kWidth = F::size, kMaxPacks = (kMaxSimplices + kWidth - 1) / kWidth;
  // Relative rounding, of the square of the largest coordinate: some three times what the roundings of a form, its tangent and a place can
  // add up to.
  static constexpr float kRounding = 3e-5F;
  static constexpr float kMost = std::numeric_limits<float>::max();
  static constexpr float kTiny = 1e-30F;
  static constexpr float kRatio = 3.46410162F;  // 2 sqrt(3): the mean ratio is this times twice the area over the squares of the edges

  struct Point {
    float x, y;
  };
  /// Triangle that decides about a place.
  struct Worst {
    std::size_t slot;
    bool by_second;  // whether it decides by the second aim
  };
  struct Look {
    Worst worst;
    bool is_hopeful;
  };
  /// Values of both aims that a place is certain to reach, and the most that it may reach; the second in set_second()'s units.
  struct Reached {
    float first, most_first, second, most_second;
    std::size_t first_slot, second_slot;  // slots of the worst triangles
  };
  struct Hopeful {
    std::size_t bit;
    Reached reached;
    bool beyond;  // whether the best was beyond the threshold when it was found
  };
  enum Field : std::uint8_t { Area0, AreaX, AreaY, Edges0, Apex0, SumX, SumY, Base0, Length, kFields };

  void take_pack(const Task& task, std::size_t pack) {
    using scalar::max;
    alignas(64) float corners[4][kWidth];
    for (std::size_t slot = 0; slot < kWidth; ++slot) {
      const std::size_t i = pack * kWidth + slot, last = task.star.simplices.size - 1;
      const auto& triangle = task.star.simplices.data[i < last ? i : last];
      corners[0][slot] = static_cast<float>(triangle.b.x);
      corners[1][slot] = static_cast<float>(triangle.b.y);
      corners[2][slot] = static_cast<float>(triangle.c.x);
      corners[3][slot] = static_cast<float>(triangle.c.y);
    }
    const Vec2<F> b{F::load_aligned(corners[0]), F::load_aligned(corners[1])}, c{F::load_aligned(corners[2]), F::load_aligned(corners[3])};
    const Vec2<F> e = c - b, sum = b + c;
    const F length = dot(e, e);
    const auto put = [&](Field field, F value) { value.store_aligned(forms_[pack][field]); };
    put(Area0, cross(b, c));
    put(AreaX, b.y - c.y);  // the edge b c is (AreaY, -AreaX)
    put(AreaY, e.x);
    put(Edges0, dot(b, b) + dot(c, c) + length);
    put(Apex0, dot(b, c));
    put(SumX, sum.x);
    put(SumY, sum.y);
    put(Base0, dot(b, e));
    put(Length, length);
    const F reach = max(max(xsimd::abs(b.x), xsimd::abs(b.y)), max(xsimd::abs(c.x), xsimd::abs(c.y)));
    reach_of_star_ = greater(reach_of_star_, 0.0F - scalar::least_slot(F(0.0F) - reach));
  }
  [[nodiscard]] static float greater(float a, float b) { return a > b ? a : b; }

  void begin_at_centre(bool beyond) {
    open_ = all_;
    beyond_ = beyond;
    first_ = beyond ? threshold_ : 0.0F;
    set_second(by_angle_ ? 0.0F : -kMost);
    if (beyond)
      set_second(centre_.second);
    else
      note(centre_);
    cut(place_of_centre_, worst_of(centre_));
  }

  /// Sets what the second aim must reach: the tangent of the least angle, 0 or more, or minus the square of the distance.
  void set_second(float value) {
    second_ = by_angle_ ? greater(value, 0.0F) : value;
    if (!by_angle_) return;
    cosine_ = 1.0F / std::sqrt(1.0F + second_ * second_);
    sine_ = second_ * cosine_;
  }

  /// Requires of others what a hopeful place is certain to reach.
  void note(const Reached& reached) {
    const bool is_beyond = reached.first > threshold_;  // else it may be, and tells nothing of places that are
    if (!beyond_ && is_beyond) {
      beyond_ = true;
      first_ = threshold_;
    }
    if (!beyond_) first_ = greater(first_, reached.first);
    if (is_beyond && reached.second > second_) set_second(reached.second);
  }

  /// Worst triangle by the aim that is needed now.
  [[nodiscard]] Worst worst_of(const Reached& reached) const {
    return beyond_ ? Worst{reached.second_slot, true} : Worst{reached.first_slot, false};
  }

  [[nodiscard]] float square_of_distance(Point p) const {
    const float x = p.x - wanted_.x, y = p.y - wanted_.y;
    return x * x + y * y;
  }

  /// Shapes of a pack of triangles with the vertex at p.
  struct Shape {
    F area, edges, dot;  // twice the area, the sum of the edges' squares, the greatest dot product of two edges at a corner
  };
  [[nodiscard]] Shape shape_at(std::size_t pack, Point p) const {
    using scalar::max;
    const auto of = [&](Field field) { return F::load_aligned(forms_[pack][field]); };
    const F x(p.x), y(p.y), from_sum = F(p.x * p.x + p.y * p.y) - (of(SumX) * x + of(SumY) * y);
    Shape shape{of(Area0) + of(AreaX) * x + of(AreaY) * y, of(Edges0) + F(2.0F) * from_sum, F(0.0F)};
    if (!by_angle_) return shape;
    const F at_base = of(AreaY) * x - of(AreaX) * y - of(Base0);
    shape.dot = max(max(at_base, of(Length) - at_base), of(Apex0) + from_sum);
    return shape;
  }

  [[nodiscard]] Look look_at(Point p) const {
    using scalar::min;
    F first(kMost), second(kMost);
    F margins[2][kMaxPacks];
    for (std::size_t i = 0; i < packs_; ++i) {
      const Shape shape = shape_at(i, p);
      margins[0][i] = F(kRatio) * shape.area - F(first_) * shape.edges;
      first = min(first, margins[0][i]);
      margins[1][i] = F(cosine_) * shape.area - F(sine_) * shape.dot;
      second = min(second, margins[1][i]);
    }
    const float first_margin = scalar::least_slot(first);
    const float second_margin = by_angle_ ? scalar::least_slot(second) : -second_ - square_of_distance(p);
    const bool by_second = beyond_ && second_margin < first_margin;
    const std::size_t slot = by_second ? (by_angle_ ? slot_of(margins[1], second_margin) : 0) : slot_of(margins[0], first_margin);
    return {{slot, by_second}, first_margin >= -room_ && (!beyond_ || second_margin >= -room_)};
  }
  [[nodiscard]] std::size_t slot_of(const F* values, float least) const {
    for (std::size_t i = 0; i < packs_; ++i)
      if (const std::uint32_t bits = scalar::bits_of(values[i] == F(least)); bits != 0)
        return i * kWidth + static_cast<std::size_t>(__builtin_ctz(bits));
    return 0;
  }

  [[nodiscard]] Reached reached_at(Point p) const {
    using scalar::max;
    using scalar::min;
    const F room(room_);
    F ratio(kMost), most_ratio(kMost), tangent(kMost), most(kMost);
    F ratios[kMaxPacks], tangents[kMaxPacks];
    for (std::size_t i = 0; i < packs_; ++i) {
      const Shape shape = shape_at(i, p);
      const F scaled = F(kRatio) * shape.area;
      ratios[i] = (scaled - room) / (shape.edges + room);
      ratio = min(ratio, ratios[i]);
      most_ratio = min(most_ratio, (scaled + room) / max(shape.edges - room, F(kTiny)));
      if (!by_angle_) continue;
      tangents[i] = (shape.area - room) / (shape.dot + room);
      tangent = min(tangent, tangents[i]);
      most = min(most, (shape.area + room) / max(shape.dot - room, F(kTiny)));
    }
    Reached reached{};
    reached.first = scalar::least_slot(ratio);
    reached.most_first = scalar::least_slot(most_ratio);
    reached.first_slot = slot_of(ratios, reached.first);
    if (by_angle_) {
      reached.second = scalar::least_slot(tangent);
      reached.most_second = scalar::least_slot(most);
      reached.second_slot = slot_of(tangents, reached.second);
    } else {
      reached.second = -room_ - square_of_distance(p);
      reached.most_second = room_ - square_of_distance(p);
    }
    return reached;
  }

  /// Cuts off the places where the triangle that decides about a place, or its distance, is certain to be below what is needed.
  void cut(Point p, Worst worst) {
    const auto of = [&](Field field) { return forms_[worst.slot / kWidth][field][worst.slot % kWidth]; };
    if (worst.by_second && !by_angle_) {
      take_out(-second_ - square_of_distance(p), p, -2.0F * (p.x - wanted_.x), -2.0F * (p.y - wanted_.y));
      return;
    }
    const Point sum{of(SumX), of(SumY)}, area_slope{of(AreaX), of(AreaY)};
    const float area = of(Area0) + area_slope.x * p.x + area_slope.y * p.y;
    const float from_sum = p.x * (p.x - sum.x) + p.y * (p.y - sum.y);
    const Point from_sum_slope{2.0F * p.x - sum.x, 2.0F * p.y - sum.y};
    if (!worst.by_second) {
      const float factor = 2.0F * first_;
      take_out(kRatio * area - first_ * (of(Edges0) + 2.0F * from_sum), p, kRatio * area_slope.x - factor * from_sum_slope.x,
               kRatio * area_slope.y - factor * from_sum_slope.y);
      return;
    }
    const float at_base = area_slope.y * p.x - area_slope.x * p.y - of(Base0), at_end = of(Length) - at_base;
    float dot = of(Apex0) + from_sum;
    Point slope = from_sum_slope;
    if (at_base > dot) {
      dot = at_base;
      slope = {area_slope.y, -area_slope.x};
    }
    if (at_end > dot) {
      dot = at_end;
      slope = {-area_slope.y, area_slope.x};
    }
    take_out(cosine_ * area - sine_ * dot, p, cosine_ * area_slope.x - sine_ * slope.x, cosine_ * area_slope.y - sine_ * slope.y);
  }

  /// Takes out the candidates where margin + slope . (place - p) is certain to be negative.
  void take_out(float margin, Point p, float slope_x, float slope_y) {
    const F start(margin + room_ - slope_x * p.x - slope_y * p.y), along_x(slope_x), along_y(slope_y);
    Candidates kept = 0;
    for (std::size_t bit = 0; bit < kStride * kStride; bit += kWidth) {
      const F at = start + along_x * F::load_aligned(x_ + bit) + along_y * F::load_aligned(y_ + bit % kRow);
      kept |= static_cast<Candidates>(scalar::bits_of(at >= F(0.0F))) << bit;
    }
    open_ &= kept;
  }

  /// Candidate in question near their middle.
  [[nodiscard]] std::size_t middle() const {
    const auto lowest = static_cast<std::size_t>(__builtin_ctzll(open_)), highest = 63 - static_cast<std::size_t>(__builtin_clzll(open_));
    const std::size_t row = (lowest / kStride + highest / kStride) / 2 * kStride;
    const auto in_row = static_cast<std::uint32_t>((open_ >> row) & 0xFFU);
    if (in_row == 0) return lowest;
    const auto first = static_cast<std::size_t>(__builtin_ctz(in_row)), last = 31 - static_cast<std::size_t>(__builtin_clz(in_row));
    const std::size_t middle = (first + last) / 2;
    return row + ((in_row >> middle & 1U) != 0 ? middle : first);
  }

  bool by_angle_ = true, beyond_ = false;
  float threshold_ = 0.0F, reach_of_star_ = 0.0F, room_ = 0.0F;
  float first_ = 0.0F, second_ = 0.0F;  // values that a candidate must reach
  float cosine_ = 1.0F, sine_ = 0.0F;   // cosine and sine of the angle whose tangent is second_
  Point wanted_{}, place_of_centre_{};
  Reached centre_{};
  std::size_t points_ = 0, packs_ = 0;
  Candidates all_ = 0, open_ = 0;  // candidates of the grid, and those in question
  static constexpr std::size_t kRow = kWidth > kStride ? kWidth : kStride;
  alignas(64) float x_[kStride * kStride] = {}, y_[kRow] = {};  // coordinates of the bits' candidates; y is the same in all rows
  alignas(64) float forms_[kMaxPacks][kFields][kWidth];
};

}  // namespace dmoscope::composite
