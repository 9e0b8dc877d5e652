#pragma once
// Bounds of the mean ratio of a star, for packs of places and in float: a candidate that cannot win by them need not be looked at exactly.
// Only the kernels' sources include it; see lane_kernel_impl.h for what that asks of the code.

#include <array>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/search/target_form.h"
#include "core/smooth/kernels/composite_kernel.h"
#include "core/smooth/kernels/solid_target.h"

namespace dmoscope::composite {

/// Second-order part of a squared norm: a number times |p|^2 or, crossed, the coefficients of x^2, y^2, z^2, xy, xz, yz. F: a pack, so that
/// no other processor's code shares the functions.
template <bool Crossed, class F>
struct SecondOrder {
  double square;
  struct Narrow {
    float square;
  };
  [[nodiscard]] Narrow narrow(double by) const { return {static_cast<float>(square * by)}; }
  [[nodiscard]] double at(const std::array<double, 3>& c) const { return square * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]); }
  [[nodiscard]] double most(const std::array<double, 3>& half) const { return at(half); }
  [[nodiscard]] std::array<double, 3> slope(const std::array<double, 3>& c) const {
    return {2.0 * square * c[0], 2.0 * square * c[1], 2.0 * square * c[2]};
  }
};
template <class F>
struct SecondOrder<true, F> {
  double xx, yy, zz, xy, xz, yz;
  struct Narrow {
    float xx, yy, zz, xy, xz, yz;
  };
  [[nodiscard]] Narrow narrow(double by) const {
    const auto to = [by](double a) { return static_cast<float>(a * by); };
    return {to(xx), to(yy), to(zz), to(xy), to(xz), to(yz)};
  }
  [[nodiscard]] double at(const std::array<double, 3>& c) const {
    return xx * c[0] * c[0] + yy * c[1] * c[1] + zz * c[2] * c[2] + xy * c[0] * c[1] + xz * c[0] * c[2] + yz * c[1] * c[2];
  }
  /// Upper bound over the box of half sizes `half`: the sum of the magnitudes of its terms.
  [[nodiscard]] double most(const std::array<double, 3>& half) const {
    const auto size = [](double a) { return a < 0.0 ? -a : a; };
    return xx * half[0] * half[0] + yy * half[1] * half[1] + zz * half[2] * half[2] + size(xy * half[0] * half[1]) +
           size(xz * half[0] * half[2]) + size(yz * half[1] * half[2]);
  }
  [[nodiscard]] std::array<double, 3> slope(const std::array<double, 3>& c) const {
    return {2.0 * xx * c[0] + xy * c[1] + xz * c[2], 2.0 * yy * c[1] + xy * c[0] + yz * c[2], 2.0 * zz * c[2] + xz * c[0] + yz * c[1]};
  }
};

/// Bounds by forms. Every simplex, and every corner of another element that changes with the vertex, is a form: it has two functions of the
/// vertex's place, v affine and s quadratic. In the plane its mean ratio is v / s (see RatioForm), in space the cube root of v |v| / s^3
/// (see MeanRatioForm). Its rank is that without the root. Both functions are taken around the centre of a grid and, in float, with room
/// for all rounding: never below the true v, never above the true s. The term of a rank in a mean is concave: at most its tangent at the
/// rank that the element has in the centre, and where its total falls, at most what Newton's steps from there give. So no root is needed,
/// and the bound is closest where the grid is fine. Steps of the harmonic mean that an element pays wherever the vertex goes count once a
/// grid; for an element that may rise a step they are looked up at each place. Against targets in the plane an element's metric may be its
/// ratio less a shift (see TargetForm). All numbers but needs and sums belong to ratios. D, F: packs of doubles and of floats of one
/// processor; Crossed: see SecondOrder.
template <class Frame, class D, class F, bool Crossed = false>
class RatioBounds {
 public:
  using Lists = CompositeLists<Frame>;
  using Place = OffsetIn<Frame, F>;
  using Hope = typename F::batch_bool_type;

  /// Takes a star. `elsewhere`: in space, by element that is no simplex, the least mean ratio of the corners that stay; null: unknown.
  void take(const Lists& star, MeanKind mean, const D* elsewhere) {
    begin(mean);
    for (std::size_t i = 0; i < star.simplices.size; ++i) {
      begin_element(1.0);
      take_simplex(star.simplices.data[i]);
    }
    std::size_t k = 0;
    star.for_others([&](const auto& element) {
      begin_element(elsewhere != nullptr ? rank_of_ratio(elsewhere[k++].get(0)) : 1.0);
      take_other(element);
    });
    end();
  }

  /// Begins a star that is taken piece by piece: for each element begin_element(), and take() of each of its forms.
  void begin(MeanKind mean) {
    mean_ = mean;
    pieces_ = elements_ = 0;
    amiss_ = 1.0;
  }
  /// Begins an element. `most`: the rank of the element's corners that stay; `shift`: from the ratio to the metric.
  void begin_element(double most, double shift = 0.0) {
    first_[elements_] = static_cast<std::uint16_t>(pieces_);
    shifts_[elements_] = shift;
    caps_[elements_++] = 1.0 + shift;  // no mean ratio is above 1
    cap(most);
  }
  void take(const volumes::MeanRatioForm<D>& f) {
    forms_[pieces_++] = {f.v0.get(0), f.vx.get(0), f.vy.get(0), f.vz.get(0),      f.s0.get(0),
                         f.sx.get(0), f.sy.get(0), f.sz.get(0), {f.square.get(0)}};
  }
  void take(const RatioForm<D>& f) {
    forms_[pieces_++] = {f.n0.get(0), f.nx.get(0), f.ny.get(0), 0.0, f.s0.get(0), f.sx.get(0), f.sy.get(0), 0.0, {f.s2.get(0)}};
  }
  void take(const volumes::StretchedForm<D>& f) {
    forms_[pieces_++] = {f.v0.get(0), f.vx.get(0), f.vy.get(0),
                         f.vz.get(0), f.s0.get(0), f.sx.get(0),
                         f.sy.get(0), f.sz.get(0), {f.xx.get(0), f.yy.get(0), f.zz.get(0), f.xy.get(0), f.xz.get(0), f.yz.get(0)}};
  }
  void take(const TargetForm<D, true>& f) {
    forms_[pieces_++] = {f.n0.get(0), f.nx.get(0), f.ny.get(0),
                         0.0,         f.s0.get(0), f.sx.get(0),
                         f.sy.get(0), 0.0,         {f.sxx.get(0), f.syy.get(0), 0.0, f.sxy.get(0), 0.0, 0.0}};
  }
  /// Sets how much worse forms are than sums of a few products: the more the farther their targets stretch.
  void set_amiss(double factor) { amiss_ = factor; }
  void end() {
    first_[elements_] = static_cast<std::uint16_t>(pieces_);
    for (std::size_t i = 0; i < elements_; ++i) order_[i] = static_cast<std::uint16_t>(i);
  }

  /// Moves to places that are no farther from `centre` than `half` along each axis; the plane has two.
  void move_to(const std::array<double, 3>& centre, const std::array<double, 3>& half) {
    greatest_sum_ = sizes_ = paid_ = 0.0;
    for (std::size_t i = 0; i < elements_; ++i) {
      double rank = caps_[i], most = caps_[i];
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
        const Reach reach = move_piece(k, centre, half);
        rank = rank < reach.here ? rank : reach.here;
        most = most < reach.most ? most : reach.most;
      }
      most_[i] = static_cast<float>(most * kMore);
      const double top = most_[i];
      take_steps(i, rank, top);
      take_most(i, rank - shifts_[i], top);
    }
  }

  /// Sets what a place must reach: the least mean ratio around the vertex, and the mean of all elements; 0: any.
  void set_needs(double least, double mean) {
    if (!(mean > 0.0)) return set_least(least);
    // Allows for what rounding `least` + `mean`, the worth of a place, takes from the sum.
    const double sum = sum_of(mean) * static_cast<double>(elements_), of_worth = 0x1p-51 * (1.0 + least) / mean;
    set_needs_of_sum(least, has_steps() ? sum + of_worth * sum : sum);
  }
  /// Sets what a place must reach, with the sum of the mean's terms instead of the mean: their inverses, or the inverses' squares, are
  /// negative.
  void set_needs_of_sum(double least, double sum) {
    set_least(least);
    if (is_product(mean_)) return;
    const double slack = greatest_sum_ - (sum + paid_), room = (static_cast<double>(elements_) + 8.0) * 0x1p-22;
    slack_ = static_cast<float>(slack + room * size(slack) + kOfTerms * sizes_ + kOfDoubles * size(sum));
  }

  /// Returns whether a place may reach what is needed. `d`: from the centre.
  [[nodiscard]] Hope may_reach(const Place& d) {
    F square = xsimd::fma(d.x, d.x, d.y * d.y);
    if constexpr (kSpace) square = xsimd::fma(d.z, d.z, square);
    F slack(slack_);
    Hope hope = square == square;
    for (std::size_t n = 0; n < elements_; ++n) {
      const std::size_t i = order_[n];
      F rank(most_[i]);
      for (std::size_t k = first_[i]; k < first_[i + 1]; ++k) {
        const F of_piece = rank_of(near_[k], d, square);
        hope = hope & (of_piece >= F(least_[i]));
        rank = xsimd::min(rank, of_piece);
      }
      slack = slack - loss(i, rank);
      if (rises_[i]) slack = slack - more_steps(i, rank);
      hope = hope & (slack >= F(0.0F));
      if (xsimd::any(hope)) continue;
      to_front(n);
      break;
    }
    return hope;
  }

 private:
  /// Sets the least that a place must reach, for any mean.
  void set_least(double least) {
    for (std::size_t i = 0; i < elements_; ++i) {
      const double rank = rank_of_ratio(least) + shifts_[i];
      least_[i] = static_cast<float>(rank - (1.0 - kLess) * size(rank));
    }
    slack_ = kMost;
  }

  static constexpr bool kSpace = std::is_same_v<Frame, Space>;
  static constexpr std::size_t kMaxElements = kMaxSimplices + kMaxOthers, kMaxPieces = kMaxSimplices + 4 * kMaxOthers;
  // Room for rounding. Of a float's 24 bits a sum of four products loses less than 4, a product or quotient less than 1. Of a double's 53
  // less than 9 are lost, the few that moving to another centre costs and those of the exact search among them.
  static constexpr double kOfFloats = 0x1p-20, kOfDoubles = 0x1p-44, kMore = 1.0 + 0x1p-19, kLess = 1.0 - 0x1p-19;
  static constexpr double kOfTerms = 0x1p-19;  // see loss()
  static constexpr double kLeastCentre = 1e-3;
  static constexpr std::size_t kSteps = std::size(kMeanSteps);
  static constexpr float kMost = std::numeric_limits<float>::max();
  static constexpr float kUnknown = 1e6F;        // a rank above any
  static constexpr float kLeastSquares = 1e-6F;  // share of 1 beneath which a norm may be rounding alone

  struct Form {
    double v0, vx, vy, vz, s0, sx, sy, sz;
    SecondOrder<Crossed, F> second;
  };
  /// Form around the centre, where its squared norm is 1.
  struct Near {
    float v0, vx, vy, vz, s0, sx, sy, sz;
    typename SecondOrder<Crossed, F>::Narrow second;
  };
  /// Rank of a piece in the centre, and the most that it may be anywhere.
  struct Reach {
    double here, most;
  };

  /// Bounds the rank of the element that was begun last from above.
  void cap(double most) {
    double& known = caps_[elements_ - 1];
    known = most < 0.0 ? 0.0 : most < known ? most : known;
  }
  template <class Simplex>
  void take_simplex(const Simplex& t) {
    if constexpr (kSpace) {
      take(volumes::tetrahedron_form(point_of<D>(t.b), point_of<D>(t.c), point_of<D>(t.d)));
    } else {
      RatioForm<D> form;
      triangle_form(StarTriangle<D>{point_of<D>(t.b), point_of<D>(t.c), D(1.0)}, form);
      take(form);
    }
  }
  template <class Element>
  void take_other(const Element& element) {
    if constexpr (kSpace) {
      const Vec3Of<D> origin{D(0.0), D(0.0), D(0.0)};
      volumes::for_corner_forms(element.with(origin), element.kMoving, [this](const volumes::MeanRatioForm<D>& form) { take(form); });
    } else {
      RatioForm<D> forms[kQuadrilateralForms<Metric::MeanRatio>];
      const StarQuadrilateral<D> q{point_of<D>(element.b), point_of<D>(element.c), point_of<D>(element.d), D(1.0)};
      cap(quadrilateral_forms<Metric::MeanRatio>(q, forms).get(0));
      for (const RatioForm<D>& form : forms) take(form);
    }
  }

  [[nodiscard]] bool has_steps() const { return mean_ == MeanKind::Harmonic; }
  /// Rank below which an element pays a step for certain.
  [[nodiscard]] double step_rank(std::size_t i, std::size_t step) const {
    const double rank = rank_of_ratio(kMeanSteps[step]) + shifts_[i];
    return rank - (1.0 - kLess) * size(rank);
  }
  [[nodiscard]] double steps_of(std::size_t i, double rank) const {
    double adds = 0.0;
    for (std::size_t k = 0; k < kSteps; ++k) adds += rank < step_rank(i, k) ? kMeanStepAdds[k] : 0.0;
    return adds;
  }
  /// Takes the steps of an element. `rank`: its rank in the centre; `most`: that which it may have anywhere.
  void take_steps(std::size_t i, double rank, double most) {
    rises_[i] = false;
    if (!has_steps()) return;
    const double least = steps_of(i, most), here = steps_of(i, rank);
    paid_ += least;
    if (!(here > least)) return;
    rises_[i] = true;
    for (std::size_t k = 0; k < kSteps; ++k) {
      step_ranks_[i][k] = static_cast<float>(step_rank(i, k));
      step_adds_[i][k] = most < step_rank(i, k) ? 0.0F : static_cast<float>(kMeanStepAdds[k]);
    }
  }
  /// Steps that an element pays at places of these ranks beyond those that it pays anywhere.
  [[nodiscard]] F more_steps(std::size_t i, const F& rank) const {
    F adds(0.0F);
    for (std::size_t k = 0; k < kSteps; ++k) adds = adds + xsimd::select(rank < F(step_ranks_[i][k]), F(step_adds_[i][k]), F(0.0F));
    return adds;
  }

  static double rank_of_ratio(double ratio) { return kSpace ? ratio * ratio * ratio : ratio; }
  /// Term of a quality in the mean's sum, a rising function.
  [[nodiscard]] double sum_of(double quality) const {
    const double sum = PowerMean<D>::total_of(mean_, D(quality), 1.0).get(0);
    return has_falling_total(mean_) ? -sum : sum;
  }
  /// Takes the most that an element may give to the sum. `here`: the rank of its metric in the centre; `top`: the most its rank may be.
  void take_most(std::size_t i, double here, double top) {
    const double at = here > kLeastCentre ? here : kLeastCentre, ahead = top - shifts_[i];
    const double quality = kSpace ? scalar::refined_cube_root(at, scalar::rough_cube_root(at)) : at;
    if (has_falling_total(mean_)) {
      const double inverse = 1.0 / at, scale = -sum_of(quality);
      inverses_[i] = static_cast<float>(inverse);
      scales_[i] = static_cast<float>(scale);
      lows_[i] = static_cast<float>(kLess * scale * term_of(inverse_root(D(ahead * inverse))).get(0));
      greatest_sum_ -= lows_[i];
      sizes_ += lows_[i] + 4.0 * scale * inverse * size(shifts_[i]);
    } else {
      const double slope = kSpace ? 1.0 / (3.0 * quality * quality) : 1.0;
      scales_[i] = static_cast<float>(slope);
      greatest_sum_ += quality + slope * (ahead - at);
      sizes_ += quality + slope * (top + size(shifts_[i]));
    }
  }
  /// How much less than the most an element of this rank gives to the sum, at least.
  [[nodiscard]] F loss(std::size_t i, const F& rank) const {
    if (!has_falling_total(mean_)) return F(scales_[i]) * (F(most_[i]) - rank);
    const F share = (kSpace ? rank : rank - F(static_cast<float>(shifts_[i]))) * F(inverses_[i]);
    return xsimd::fma(F(scales_[i]), term_of(inverse_root(share)), F(-lows_[i]));
  }
  /// Size of the term of an element, from the inverse of its rank's root.
  template <class R>
  [[nodiscard]] R term_of(const R& root) const {
    return mean_ == MeanKind::Harmonic ? root : root * root;
  }
  /// Inverse of the cube root of a rank, in the plane of the rank, or less: two of Newton's steps from 1, which never end above it.
  template <class R>
  [[nodiscard]] static R inverse_root(const R& rank) {
    using scalar::constant;
    if constexpr (kSpace) {
      const R four(4), third = constant<R>(1.0 / 3.0), first = xsimd::max((four - rank) * third, constant<R>(0.55));
      return xsimd::max(first * (four - rank * first * first * first) * third, R(0));
    } else {
      const R two(2), first = xsimd::max(two - rank, constant<R>(0.4));
      return xsimd::max(first * (two - rank * first), R(0));
    }
  }
  /// Rank of v and s.
  static double rank(double v, double s) { return kSpace ? v * size(v) / (s * s * s) : v / s; }

  static double size(double a) { return a < 0.0 ? -a : a; }

  Reach move_piece(std::size_t k, const std::array<double, 3>& c, const std::array<double, 3>& half) {
    const Form& f = forms_[k];
    const double second = f.second.at(c);
    const double v_moved = f.v0 + f.vx * c[0] + f.vy * c[1] + f.vz * c[2];
    const double s_moved = f.s0 + f.sx * c[0] + f.sy * c[1] + f.sz * c[2] + second;
    if (!(s_moved > 0.0)) return give_up(k);
    const double by_s = 1.0 / s_moved, by_v = kSpace ? by_s * xsimd::sqrt(D(by_s)).get(0) : by_s;
    const double v = v_moved * by_v, vx = f.vx * by_v, vy = f.vy * by_v, vz = f.vz * by_v;
    const std::array<double, 3> bend = f.second.slope(c);
    const double sx = (f.sx + bend[0]) * by_s, sy = (f.sy + bend[1]) * by_s, sz = (f.sz + bend[2]) * by_s;
    const double v_way = size(vx) * half[0] + size(vy) * half[1] + size(vz) * half[2];
    const double s_way = size(sx) * half[0] + size(sy) * half[1] + size(sz) * half[2];
    const double v_terms = (size(f.v0) + size(f.vx * c[0]) + size(f.vy * c[1]) + size(f.vz * c[2])) * by_v;
    const double s_terms = (size(f.s0) + size(f.sx * c[0]) + size(f.sy * c[1]) + size(f.sz * c[2]) + f.second.most(sizes_of(c))) * by_s;
    const double of_doubles = kOfDoubles * amiss_;
    const double v_room = kOfFloats * (size(v) + v_way) + of_doubles * v_terms;
    const double s_room = kOfFloats * (1.0 + s_way + f.second.most(half) * by_s) + of_doubles * s_terms;
    near_[k] = {static_cast<float>(v + v_room), static_cast<float>(vx),           static_cast<float>(vy),
                static_cast<float>(vz),         static_cast<float>(1.0 - s_room), static_cast<float>(sx),
                static_cast<float>(sy),         static_cast<float>(sz),           f.second.narrow(by_s)};
    const double most_v = v + v_room + v_way, least_s = 1.0 - s_room - s_way;
    return {rank(v, 1.0), least_s > 0.1 ? rank(most_v, least_s) : kUnknown};  // an element's cap bounds it
  }
  static std::array<double, 3> sizes_of(const std::array<double, 3>& c) { return {size(c[0]), size(c[1]), size(c[2])}; }
  /// Gives a form up whose norm rounding has eaten: it says nothing.
  Reach give_up(std::size_t k) {
    near_[k] = {kUnknown, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, {}};
    return {kUnknown, kUnknown};
  }

  static F second_order(const Near& f, const Place& d, const F& square) {
    if constexpr (Crossed) {
      F s = xsimd::fma(F(f.second.xx) * d.x, d.x, xsimd::fma(F(f.second.yy) * d.y, d.y, F(f.s0)));
      s = xsimd::fma(F(f.second.xy) * d.x, d.y, s);
      if constexpr (kSpace) s = xsimd::fma(d.z, xsimd::fma(F(f.second.xz), d.x, xsimd::fma(F(f.second.yz), d.y, F(f.second.zz) * d.z)), s);
      return s;
    } else {
      return xsimd::fma(F(f.second.square), square, F(f.s0));
    }
  }
  static F rank_of(const Near& f, const Place& d, const F& square) {
    F v = xsimd::fma(F(f.vx), d.x, xsimd::fma(F(f.vy), d.y, F(f.v0)));
    F s = xsimd::fma(F(f.sx), d.x, xsimd::fma(F(f.sy), d.y, second_order(f, d, square)));
    if constexpr (kSpace) {
      v = xsimd::fma(F(f.vz), d.z, v);
      s = xsimd::fma(F(f.sz), d.z, s);
    }
    const F inverse = F(1.0F) / xsimd::max(s, F(kLeastSquares)), part = v * inverse;
    return kSpace ? part * xsimd::abs(part) * inverse : part;
  }

  /// Moves an element to the front: the one that decided is likely to decide the next.
  void to_front(std::size_t n) {
    const std::uint16_t i = order_[n];
    for (; n > 0; --n) order_[n] = order_[n - 1];
    order_[0] = i;
  }

  std::size_t pieces_ = 0, elements_ = 0;
  MeanKind mean_ = MeanKind::Harmonic;
  double greatest_sum_ = 0.0, sizes_ = 0.0;  // size of the sum's terms
  double paid_ = 0.0;                        // the mean's steps that are paid wherever the vertex goes
  float slack_ = 0.0F;                       // how far the sum of the most that each element may give is above what is needed
  double amiss_ = 1.0;
  std::uint16_t first_[kMaxElements + 1];  // offset of an element's pieces
  std::uint16_t order_[kMaxElements];
  double caps_[kMaxElements], shifts_[kMaxElements];  // the most that a rank may be, by the corners that stay; shift of the metric
  float least_[kMaxElements];                         // the rank that it must reach
  float most_[kMaxElements];                          // the most that the rank may be near the centre
  float inverses_[kMaxElements], scales_[kMaxElements], lows_[kMaxElements];  // see loss()
  bool rises_[kMaxElements];                                                  // whether an element may rise a step
  float step_ranks_[kMaxElements][kSteps], step_adds_[kMaxElements][kSteps];
  Form forms_[kMaxPieces];
  Near near_[kMaxPieces];
};

}  // namespace dmoscope::composite
