#pragma once
// The grid search for metrics of ratio form, by threshold rounds: it finds the candidate that grid_search() finds, without a division
// a candidate.
//
// With threshold t > 0, min_k N_k / S_k > t exactly where every margin (N_k - t S_k) w_k is positive, for any weights w_k > 0. A margin is
// a function of x plus a function of y, so a candidate costs one addition and one minimum an element. A round evaluates all margins at
// t, takes the candidate with the largest least margin, raises t to that candidate's quality, and so on until no margin is positive. With
// w_k = 1 / S_k(centre) a margin is nearly the gain in quality itself, so the first candidate is mostly the best; and as S_k varies
// little over the finer grids, the second largest margin mostly proves it without another round.

#include <array>

#include "core/search/grid_search.h"
#include "core/search/ratio_form.h"

namespace dmoscope {

template <class R>
class RatioSearch {
 public:
  static constexpr int kPoints = 8;  // candidates an axis: the one size this search is made for
  static constexpr int kMaxForms = 48;

  /// Searches all levels. `forms`: 1 to kMaxForms, of which it uses the memory. `cap`: what no candidate's quality can exceed. `box`: of
  /// the star's other vertices. In every slot the quality at the origin must be positive. Returns the offset and its quality, as
  /// grid_search does.
  Candidate<R> search(std::span<RatioForm<R>> forms, R cap, Vec2<R> box, int levels, double omega) {
    forms_ = forms;
    cap_ = cap;
    moved_by_ = {R(0), R(0)};
    Candidate<R> best{{}, quality({})};
    for (int level = 0; level < levels; ++level) {
      const R factor = scalar::constant<R>(omega);
      search_level({box.x * factor, box.y * factor}, best);
      omega *= 2.0 / (kPoints - 1);
    }
    return best;
  }

 private:
  using Line = std::array<R, kPoints>;
  /// N_k - t S_k, times w_k: a + b x + c y - d (x^2 + y^2).
  struct Margin {
    R a, b, c, d;
  };
  struct Best {
    R margin, second;  // the largest least margin and the next
    R x;               // column of the former
  };

  static R huge() { return scalar::constant<R>(1e30); }

  /// Least N / S at `p`.
  [[nodiscard]] R quality(Vec2<R> p) const {
    using scalar::min, scalar::select;
    R least = cap_;
    const R squared = dot(p, p);
    for (const RatioForm<R>& f : forms_) {
      const R n = f.n0 + f.nx * p.x + f.ny * p.y;
      const R s = f.s0 + f.sx * p.x + f.sy * p.y + f.s2 * squared;
      least = min(least, n / select(s > R(0), s, R(1)));
    }
    return least;
  }

  /// Makes `centre` the forms' new origin.
  void recentre(Vec2<R> centre) {
    const R squared = dot(centre, centre);
    for (RatioForm<R>& f : forms_) {
      f.n0 = f.n0 + f.nx * centre.x + f.ny * centre.y;
      f.s0 = f.s0 + f.sx * centre.x + f.sy * centre.y + f.s2 * squared;
      f.sx = f.sx + R(2) * f.s2 * centre.x;
      f.sy = f.sy + R(2) * f.s2 * centre.y;
    }
  }

  /// Sets the weights; returns a bound of S_k(centre) / S_k(p) over the grid of this size and all elements.
  R weigh(Vec2<R> size) {
    using scalar::abs, scalar::max, scalar::min, scalar::select;
    const R half(0.5F), hx = half * size.x, hy = half * size.y;
    R least(1);
    for (std::size_t k = 0; k < forms_.size(); ++k) {
      const RatioForm<R>& f = forms_[k];
      const auto counts = f.s0 > R(0);
      weight_[k] = R(1) / select(counts, f.s0, R(1));
      // S falls from the centre by at most |sx| hx - s2 hx^2, or half of |sx| hx where its minimum lies within; likewise along y.
      const R x = abs(f.sx) * hx, y = abs(f.sy) * hy;
      const R fall = (x - min(half * x, f.s2 * hx * hx)) + (y - min(half * y, f.s2 * hy * hy));
      least = min(least, select(counts, R(1) - fall * weight_[k], R(1)));
    }
    const R smallest = scalar::constant<R>(0.05);
    return select(least > smallest, R(1) / max(least, smallest), huge());
  }

  void search_level(Vec2<R> size, Candidate<R>& best) {
    using scalar::any, scalar::select;
    recentre(moved_by_);
    const R bound = weigh(size);
    Line x, y;
    for (int i = 0; i < kPoints; ++i) {
      const R s = scalar::constant<R>(static_cast<double>(i) / (kPoints - 1) - 0.5);
      x[i] = size.x * s;
      y[i] = size.y * s;
    }
    R t = best.objective;
    Vec2<R> offset{R(0), R(0)};
    R floor = select(t < cap_, R(0), huge());  // what a margin must exceed: huge in slots that are done
    for (;;) {
      fill_tables(t, x, y);
      const Best found = largest_margin(x, floor);
      const auto positive = found.margin > floor;
      if (!any(positive)) break;
      const Vec2<R> p{found.x, row_of(found, y)};
      const R q = quality(p);
      const auto better = positive & (q > t);
      // Whatever else is left gains at most found.second * bound over the old t.
      const auto open = better & (found.second * bound > q - t) & (q < cap_);
      t = select(better, q, t);
      offset = {select(better, p.x, offset.x), select(better, p.y, offset.y)};
      const auto capped = better & !(q < cap_);
      if (any(capped)) {
        const Vec2<R> first = first_at_cap(x, y, p);
        offset = {select(capped, first.x, offset.x), select(capped, first.y, offset.y)};
      }
      if (!any(open)) break;
      floor = select(open, R(0), huge());
    }
    best.objective = t;
    best.offset = best.offset + offset;
    moved_by_ = offset;
  }

  /// Margins at threshold `t`, as a part of each column and one of each row.
  void fill_tables(R t, const Line& x, const Line& y) {
    for (std::size_t k = 0; k < forms_.size(); ++k) {
      const RatioForm<R>& f = forms_[k];
      const R w = weight_[k];
      const Margin m{(f.n0 - t * f.s0) * w, (f.nx - t * f.sx) * w, (f.ny - t * f.sy) * w, (t * f.s2) * w};
      margin_[k] = m;
      for (int i = 0; i < kPoints; ++i) {
        column_[k][i] = column_part(m, x[i]);
        row_[k][i] = y[i] * (m.c - m.d * y[i]);
      }
    }
  }

  /// Many candidates may reach the cap alike: the one of lowest index, as grid_search would take. `p`: one that does.
  Vec2<R> first_at_cap(const Line& x, const Line& y, Vec2<R> p) {
    using scalar::max, scalar::select;
    fill_tables(cap_, x, y);
    for (int i = kPoints - 1; i >= 0; --i) {
      const Line m = least_margins([&](std::size_t k) { return column_[k][i]; });
      for (int j = kPoints - 1; j >= 0; --j) {
        const auto reaches = !(m[j] < R(0));
        p = {select(reaches, x[i], p.x), select(reaches, y[j], p.y)};
      }
    }
    return p;
  }

  Best largest_margin(const Line& x, R floor) const {
    Best best{floor, R(0) - huge(), x[0]};
    for (int i = 0; i < kPoints; ++i) take_column(least_margins([&](std::size_t k) { return column_[k][i]; }), x[i], best);
    return best;
  }

  static R column_part(const Margin& m, R x) { return m.a + x * (m.b - m.d * x); }

  /// Merges the two largest of a column into the two largest so far.
  static void take_column(const Line& m, R x, Best& best) {
    using scalar::max, scalar::min, scalar::select;
    const auto merge = [](R& high, R& low, R high2, R low2) {
      low = max(min(high, high2), max(low, low2));
      high = max(high, high2);
    };
    R high[4], low[4];
    for (int j = 0; j < 4; ++j) {
      high[j] = max(m[2 * j], m[2 * j + 1]);
      low[j] = min(m[2 * j], m[2 * j + 1]);
    }
    merge(high[0], low[0], high[1], low[1]);
    merge(high[2], low[2], high[3], low[3]);
    merge(high[0], low[0], high[2], low[2]);
    best.x = select(high[0] > best.margin, x, best.x);
    merge(best.margin, best.second, high[0], low[0]);
  }

  /// The least margin of every candidate of the column whose part of element k's margin is column(k).
  template <class Column>
  Line least_margins(Column column) const {
    using scalar::min;
    const R first = column(0);
    Line m;
    for (int j = 0; j < kPoints; ++j) m[j] = scalar::Sum<R>::of(row_[0][j], first);
    for (std::size_t k = 1; k < forms_.size(); ++k) {
      const R part = column(k);
      for (int j = 0; j < kPoints; ++j) m[j] = min(m[j], scalar::Sum<R>::of(row_[k][j], part));
    }
    return m;
  }

  /// Evaluates the winning column again to find the winner's row: the lowest with that margin.
  [[nodiscard]] R row_of(const Best& best, const Line& y) const {
    using scalar::select;
    const Line m = least_margins([&](std::size_t k) { return column_part(margin_[k], best.x); });
    R row = y[kPoints - 1];
    for (int j = kPoints - 2; j >= 0; --j) row = select(m[j] == best.margin, y[j], row);
    return row;
  }

  std::span<RatioForm<R>> forms_;
  R cap_;
  Vec2<R> moved_by_;  // from the last level's centre
  std::array<R, kMaxForms> weight_;
  std::array<Margin, kMaxForms> margin_;
  std::array<Line, kMaxForms> column_, row_;
};

}  // namespace dmoscope
