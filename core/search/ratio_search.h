#pragma once
// The grid search for metrics of ratio form, by threshold rounds: it finds the candidate that grid_search() finds, without a division
// a candidate.
//
// With threshold t > 0, min_k N_k / S_k > t exactly if every margin (N_k - t S_k) w_k is positive, for any weights w_k > 0. A margin is a
// function of x plus a function of y, so a candidate costs one addition and one minimum an element. A round evaluates all margins at t,
// takes the candidate with the largest least margin, raises t to that candidate's quality, and so on until no margin is positive. With w_k
// = 1 / S_k(centre) a margin is nearly the gain in quality itself, so the first candidate is mostly the best; and as S_k varies little over
// the finer grids, the second largest margin mostly proves it without another round.
//
// Rounds after the first need only columns of candidates whose largest margin was not too small before. A lane of a GPU skips the others
// (RoundColumns).

#include <array>
#include <cstdint>

#include "core/base/host_device.h"
#include "core/search/grid_search.h"
#include "core/search/ratio_form.h"
#include "core/search/round_columns.h"
#include "core/search/target_form.h"
#include "core/search/team.h"

namespace dmoscope {

/// The least margins of a column's eight candidates, in eight variables, because an array of them would live in memory.
template <class R>
struct LeastMargins {
  R m0, m1, m2, m3, m4, m5, m6, m7;

  /// Initialises with the margins of the first element: its part of each row plus its part of the column.
  DMOSCOPE_ANYWHERE LeastMargins(const std::array<R, 8>& row, R column)
      : m0(sum(row[0], column)),
        m1(sum(row[1], column)),
        m2(sum(row[2], column)),
        m3(sum(row[3], column)),
        m4(sum(row[4], column)),
        m5(sum(row[5], column)),
        m6(sum(row[6], column)),
        m7(sum(row[7], column)) {}

  /// Initialises with the margins of an element whose form is crossed: the term `slope` times the row's place is added, of which the upper
  /// half is given.
  DMOSCOPE_ANYWHERE LeastMargins(const std::array<R, 8>& row, R column, R slope, const std::array<R, 8>& y) {
    const R y4 = slope * y[4], y5 = slope * y[5], y6 = slope * y[6], y7 = slope * y[7];
    m0 = sum(row[0], column) - y7;
    m1 = sum(row[1], column) - y6;
    m2 = sum(row[2], column) - y5;
    m3 = sum(row[3], column) - y4;
    m4 = sum(row[4], column) + y4;
    m5 = sum(row[5], column) + y5;
    m6 = sum(row[6], column) + y6;
    m7 = sum(row[7], column) + y7;
  }

  /// Takes the margins of a further element.
  DMOSCOPE_ANYWHERE void take(const std::array<R, 8>& row, R column) {
    using scalar::min;
    m0 = min(m0, sum(row[0], column));
    m1 = min(m1, sum(row[1], column));
    m2 = min(m2, sum(row[2], column));
    m3 = min(m3, sum(row[3], column));
    m4 = min(m4, sum(row[4], column));
    m5 = min(m5, sum(row[5], column));
    m6 = min(m6, sum(row[6], column));
    m7 = min(m7, sum(row[7], column));
  }

  /// Takes the margins of a further element whose form is crossed; two rows at a time, so that the mixed term stays in one register.
  DMOSCOPE_ANYWHERE void take(const std::array<R, 8>& row, R column, R slope, const std::array<R, 8>& y) {
    take_two(m0, m7, row[0], row[7], column, slope * y[7]);
    take_two(m1, m6, row[1], row[6], column, slope * y[6]);
    take_two(m2, m5, row[2], row[5], column, slope * y[5]);
    take_two(m3, m4, row[3], row[4], column, slope * y[4]);
  }

  [[nodiscard]] DMOSCOPE_ANYWHERE R largest() const {
    using scalar::max;
    return max(max(max(m0, m1), max(m2, m3)), max(max(m4, m5), max(m6, m7)));
  }

  /// Calls f(margin, row) from the last row to the first.
  template <class F>
  DMOSCOPE_ANYWHERE void backwards(F f) const {
    f(m7, 7U), f(m6, 6U), f(m5, 5U), f(m4, 4U), f(m3, 3U), f(m2, 2U), f(m1, 1U), f(m0, 0U);
  }

 private:
  static DMOSCOPE_ANYWHERE R sum(R a, R b) { return scalar::Sum<R>::of(a, b); }
  static DMOSCOPE_ANYWHERE void take_two(R& below, R& above, R row_below, R row_above, R column, R slant) {
    using scalar::min;
    below = min(below, sum(row_below, column) - slant);
    above = min(above, sum(row_above, column) + slant);
  }
};

/// Tables kept between the candidates of a round. A processor keeps both parts of every margin in its cache; a GPU, whose lanes have few
/// registers and little cache, recomputes the columns' parts, and the rows' too if the number of elements is unknown at compile time.
enum class Tables { Full, Rows, None };

/// Searches one star, or one per slot if R is a pack. It is large: keep one and use it again. Forms: their number if it is known at compile
/// time, else 0. The result does not depend on Tables and Team. Form: RatioForm or TargetForm.
template <class R, std::size_t Forms = 0, Tables Kept = Tables::Full, class Team = Solo, class Form = RatioForm<R>>
class RatioSearch {
 public:
  static constexpr std::size_t kPoints = 8;  // candidates per axis: the only size that this search supports
  static constexpr std::size_t kMaxForms = Forms == 0 ? 48 : Forms;
  using FormSpan = std::span<Form, Forms == 0 ? std::dynamic_extent : Forms>;

  DMOSCOPE_ANYWHERE explicit RatioSearch(Team team = {}) : team_(team) {}

  /// Searches all levels. `forms`: 1 to kMaxForms, whose memory it uses. `cap`: upper bound of every candidate's quality; none reaches it
  /// if Forms is not 0. `box`: of the star's other vertices. In every slot all N at the origin must be positive. Returns the offset and its
  /// quality, as grid_search does. A trace gets the quality() of each candidate; among those that differ by less than its rounding, the
  /// winner need not be the first of the best.
  template <class Trace = NoTrace>
  DMOSCOPE_ANYWHERE Candidate<R> search(FormSpan forms, R cap, Vec2<R> box, int levels, double omega, Trace&& trace = {}) {
    forms_ = forms.data();
    count_ = forms.size();
    cap_ = cap;
    moved_by_ = {R(0), R(0)};
    Candidate<R> best{{}, quality({})};
    trace.begin(best.objective);
    for (int level = 0; level < levels; ++level) {
      const R factor = scalar::constant<R>(omega);
      search_level({box.x * factor, box.y * factor}, best, trace);
      trace.found(best);
      omega *= 2.0 / (kPoints - 1);
    }
    return best;
  }

 private:
  static constexpr std::size_t kHalf = kPoints / 2;
  using Line = std::array<R, kPoints>;
  static_assert(kPoints == 8, "LeastMargins has eight");
  static_assert(Team::kSize == 1 || Team::kSize == kPoints, "a column each");
  static constexpr bool kCrossed = Form::kCrossed;
  /// Whether a candidate may reach the cap. A fan of triangles, the only star whose number of forms is known at compile time, has none.
  static constexpr bool kCapped = Forms == 0;
  /// Whether a round after a level's first skips columns by RoundColumns. Otherwise lanes go together.
  static constexpr bool kPrunes = Team::kSize == 1 && Kept == Tables::Rows;
  static_assert(!kPrunes || std::is_same_v<Form, RatioForm<float>>, "the bound of rounding is that of float and of a quality of at most 1");
  /// The margin (N_k - t S_k) w_k as a polynomial: a + b x + c y - d (x^2 + y^2).
  struct EvenMargin {
    R a, b, c, d;
    [[nodiscard]] DMOSCOPE_ANYWHERE R along_x() const { return d; }
    [[nodiscard]] DMOSCOPE_ANYWHERE R along_y() const { return d; }
  };
  /// The margin of a form that is crossed: a + b x + c y - dx x^2 - dy y^2 - e x y.
  struct CrossedMargin {
    R a, b, c, dx, dy, e;
    [[nodiscard]] DMOSCOPE_ANYWHERE R along_x() const { return dx; }
    [[nodiscard]] DMOSCOPE_ANYWHERE R along_y() const { return dy; }
  };
  using Margin = std::conditional_t<kCrossed, CrossedMargin, EvenMargin>;
  struct Best {
    R margin, second;  // the largest least margin and the next
    Vec2<R> at;        // candidate of the largest margin
  };

  static DMOSCOPE_ANYWHERE R huge() { return scalar::constant<R>(1e30); }
  [[nodiscard]] DMOSCOPE_ANYWHERE std::size_t count() const {
    if constexpr (Forms == 0)
      return count_;
    else
      return Forms;
  }

  /// Least N / S of all forms at `p`.
  [[nodiscard]] DMOSCOPE_ANYWHERE R quality(Vec2<R> p) const {
    using scalar::min, scalar::select;
    R least = cap_;
    const R squared = dot(p, p);
    DMOSCOPE_UNROLL
    for (std::size_t k = 0; k < count(); ++k) {
      const Form& f = forms_[k];
      const R n = f.n0 + f.nx * p.x + f.ny * p.y;
      const R s = f.s0 + f.sx * p.x + f.sy * p.y + f.second_order(p, squared);
      least = min(least, f.quality(n / select(s > R(0), s, R(1))));
    }
    return least;
  }

  /// Makes `centre` the forms' new origin.
  DMOSCOPE_ANYWHERE void recentre(Vec2<R> centre) {
    const R squared = dot(centre, centre);
    DMOSCOPE_UNROLL
    for (std::size_t k = 0; k < count(); ++k) {
      Form& f = forms_[k];
      f.n0 = f.n0 + f.nx * centre.x + f.ny * centre.y;
      f.s0 = f.s0 + f.sx * centre.x + f.sy * centre.y + f.second_order(centre, squared);
      f.move_slopes(centre);
    }
  }

  /// Sets the weights; returns a bound of S_k(centre) / S_k(p) over the grid of this size and all elements, for quality t at the centre.
  DMOSCOPE_ANYWHERE R weigh(Vec2<R> size, [[maybe_unused]] R t) {
    using scalar::abs, scalar::max, scalar::min, scalar::select;
    const R half(0.5F), hx = half * size.x, hy = half * size.y;
    R least(1);
    if constexpr (kPrunes) greatest_ = R(1);
    DMOSCOPE_UNROLL
    for (std::size_t k = 0; k < count(); ++k) {
      const Form& f = forms_[k];
      const auto counts = f.s0 > R(0);
      weight_[k] = R(1) / select(counts, f.s0, R(1));
      // Bounds S: it falls from the centre by at most |sx| hx - s2 hx^2, or half of |sx| hx if its minimum lies within; along y likewise.
      const R x = abs(f.sx) * hx, y = abs(f.sy) * hy;
      R fall = (x - min(half * x, f.along_x() * hx * hx)) + (y - min(half * y, f.along_y() * hy * hy));
      if constexpr (kPrunes) greatest_ = max(greatest_, R(1) + ((x + f.along_x() * hx * hx) + (y + f.along_y() * hy * hy)) * weight_[k]);
      if constexpr (kCrossed) fall = fall + abs(f.sxy) * hx * hy;
      least = min(least, select(counts, R(1) - fall * weight_[k], R(1)));
      // At the least threshold a margin is no gain.
      if constexpr (Form::kShifted) least = select(t + f.shift < scalar::constant<R>(kLeastTargetRatio), R(0), least);
    }
    const R smallest = scalar::constant<R>(0.05);
    return select(least > smallest, R(1) / max(least, smallest), huge());
  }

  template <class Trace>
  DMOSCOPE_ANYWHERE void search_level(Vec2<R> size, Candidate<R>& best, Trace& trace) {
    using scalar::any, scalar::select;
    recentre(moved_by_);
    const R bound = weigh(size, best.objective);
    set_grid(size);
    if constexpr (kTraced<Trace>) show_level(CandidateGrid<R>{best.offset, size, static_cast<int>(kPoints)}, trace);
    R t = best.objective;
    Vec2<R> offset{R(0), R(0)};
    R floor = select(t < cap_, R(0), huge());  // lower bound of useful margins: huge in slots that are done
    [[maybe_unused]] RoundColumns columns;
    for (;;) {
      fill_tables(t);
      const Best found = largest_margin(floor, columns);
      const auto positive = found.margin > floor;
      if (!any(positive)) break;
      const R q = quality(found.at);
      const auto better = positive & (q > t);
      // Every other candidate gains at most found.second * bound over the old t.
      const auto open = better & (found.second * bound > q - t) & (q < cap_);
      t = select(better, q, t);
      offset = {select(better, found.at.x, offset.x), select(better, found.at.y, offset.y)};
      if constexpr (kCapped) {
        const auto capped = better & !(q < cap_);
        if (any(capped)) {
          const Vec2<R> first = first_at_cap(found.at);
          offset = {select(capped, first.x, offset.x), select(capped, first.y, offset.y)};
        }
      }
      if (!any(open)) break;
      floor = select(open, R(0), huge());
      if constexpr (kPrunes) columns.take_those_above(least_that_may_gain(t - best.objective, bound));
    }
    best.objective = t;
    best.offset = best.offset + offset;
    moved_by_ = offset;
  }

  /// The margin in a level's first round up to which a candidate has no positive margin once the threshold is higher by `gain`: its margin
  /// falls by at least gain / bound. The last term exceeds the rounding of two margins: each is of eight operations on terms that are, as N
  /// is at most S, no larger than 6 greatest_.
  [[nodiscard]] DMOSCOPE_ANYWHERE R least_that_may_gain(R gain, R bound) const {
    return gain / bound * scalar::constant<R>(1.0 - 1e-4) - scalar::constant<R>(12 * 8 * 0x1p-24) * greatest_;
  }

  template <class Trace>
  DMOSCOPE_ANYWHERE void show_level(const CandidateGrid<R>& grid, Trace& trace) const {
    trace.level(grid);
    for (std::size_t i = 0; i < kPoints; ++i)
      for (std::size_t j = 0; j < kPoints; ++j) {
        const Vec2<R> p{column_offset(i), y_[j]};
        trace.candidate(static_cast<int>(i * kPoints + j), grid.centre + p, quality(p));
      }
  }

  /// Offset of a row or column from the centre, as a part of the grid's size: index i of the second half; the first half are the negatives.
  static DMOSCOPE_ANYWHERE R part(std::size_t i) { return scalar::constant<R>(static_cast<double>(kHalf + i) / (kPoints - 1) - 0.5); }

  DMOSCOPE_ANYWHERE void set_grid(Vec2<R> size) {
    width_ = size.x;
    for (std::size_t i = 0; i < kHalf; ++i) {
      if constexpr (Kept == Tables::Full) {
        x_[kHalf + i] = size.x * part(i);
        x_[kHalf - 1 - i] = R(0) - x_[kHalf + i];
      }
      y_[kHalf + i] = size.y * part(i);
      y_[kHalf - 1 - i] = R(0) - y_[kHalf + i];
    }
  }

  /// The offset of a column's candidates. A GPU computes it: indexing by a value known only at run time would put the table into local
  /// memory.
  [[nodiscard]] DMOSCOPE_ANYWHERE R column_offset(std::size_t i) const {
    if constexpr (Kept == Tables::Full) {
      return x_[i];
    } else {
      const std::size_t mirrored = i < kHalf ? kHalf - 1 - i : i - kHalf;
      R s = part(0);
      DMOSCOPE_UNROLL
      for (std::size_t other = 1; other < kHalf; ++other) s = mirrored == other ? part(other) : s;
      const R x = width_ * s;
      return i < kHalf ? R(0) - x : x;
    }
  }

  /// The column_offset(i) of `bit` = 1 << i.
  [[nodiscard]] DMOSCOPE_ANYWHERE R offset_of_bit(std::uint32_t bit) const {
    R s = part(0);
    DMOSCOPE_UNROLL
    for (std::size_t other = 1; other < kHalf; ++other) {
      const std::uint32_t both = 1U << (kHalf - 1 - other) | 1U << (kHalf + other);
      s = (bit & both) != 0 ? part(other) : s;
    }
    const R x = width_ * s;
    return bit < 1U << kHalf ? R(0) - x : x;
  }

  /// Margins at threshold `t`, as a part of each column and one of each row.
  DMOSCOPE_ANYWHERE void fill_tables(R t) {
    [[maybe_unused]] Line xx;
    if constexpr (Kept == Tables::Full)
      for (std::size_t i = kHalf; i < kPoints; ++i) xx[i] = x_[i] * x_[i];
    for (std::size_t i = kHalf; i < kPoints; ++i) yy_[i] = y_[i] * y_[i];
    DMOSCOPE_UNROLL
    for (std::size_t k = 0; k < count(); ++k) {
      const Form& f = forms_[k];
      const R w = weight_[k], threshold = f.threshold(t);
      Margin m;
      m.a = (f.n0 - threshold * f.s0) * w;
      m.b = (f.nx - threshold * f.sx) * w;
      m.c = (f.ny - threshold * f.sy) * w;
      if constexpr (kCrossed) {
        m.dx = (threshold * f.sxx) * w;
        m.dy = (threshold * f.syy) * w;
        m.e = (threshold * f.sxy) * w;
      } else {
        m.d = (threshold * f.s2) * w;
      }
      margin_[k] = m;
      if constexpr (Kept == Tables::Full) {
        for (std::size_t i = kHalf; i < kPoints; ++i) {
          const R even_x = m.a - m.along_x() * xx[i], odd_x = m.b * x_[i];
          column_[k][i] = even_x + odd_x;
          column_[k][kPoints - 1 - i] = even_x - odd_x;
        }
      }
      if constexpr (Kept != Tables::None) fill_row(m, row_[k]);
    }
  }

  DMOSCOPE_ANYWHERE void fill_row(const Margin& m, Line& row) const {
    DMOSCOPE_UNROLL
    for (std::size_t i = kHalf; i < kPoints; ++i) {
      const R even_y = m.along_y() * yy_[i], odd_y = m.c * y_[i];
      row[i] = odd_y - even_y;
      row[kPoints - 1 - i] = R(0) - odd_y - even_y;
    }
  }

  /// The candidate of lowest index among those that reach the cap, as grid_search would take it. `p`: one that does.
  DMOSCOPE_ANYWHERE Vec2<R> first_at_cap(Vec2<R> p) {
    using scalar::select;
    fill_tables(cap_);
    for (std::size_t i = kPoints; i-- > 0;) {
      const R x = column_offset(i);
      least_margins_of_column(i, x).backwards([&](R margin, std::size_t j) {
        const auto reaches = !(margin < R(0));
        p = {select(reaches, x, p.x), select(reaches, y_[j], p.y)};
      });
    }
    return p;
  }

  /// The candidate with the largest least margin above `floor`; of several equal ones that of lowest index. If kPrunes, only of these
  /// columns.
  [[nodiscard]] DMOSCOPE_ANYWHERE Best largest_margin(R floor, [[maybe_unused]] RoundColumns& columns) const {
    using scalar::max, scalar::min, scalar::select;
    Best best{floor, R(0) - huge(), {column_offset(0), y_[0]}};
    const auto take = [&best](R high, R second, R x) {
      best.at.x = select(high > best.margin, x, best.at.x);
      best.second = max(best.second, min(high, best.margin));
      if constexpr (Team::kSize > 1) best.second = max(best.second, second);
      best.margin = max(best.margin, high);
    };
    if constexpr (Team::kSize == 1 && Kept != Tables::Full) {
      std::uint32_t left = columns.bits();
      DMOSCOPE_NO_UNROLL
      while (left != 0) {
        const std::uint32_t next = left & (0U - left);  // lowest bit of `left`
        left ^= next;
        const R x = offset_of_bit(next), high = least_margins_at(x).largest();
        if constexpr (kPrunes) columns.keep(high);
        take(high, R(0) - huge(), x);
      }
    } else if constexpr (Team::kSize == 1) {
      DMOSCOPE_NO_UNROLL
      for (std::size_t i = 0; i < kPoints; ++i) {
        const R x = column_offset(i);
        take(least_margins_of_column(i, x).largest(), R(0) - huge(), x);
      }
    } else {
      const R x = column_offset(team_.lane());
      const Best mine{least_margins_of_column(team_.lane(), x).largest(), R(0) - huge(), {x, y_[0]}};
      const Best all = fold(team_, mine, [](const Best& a, const Best& b) {
        return Best{max(a.margin, b.margin),
                    max(max(a.second, b.second), min(a.margin, b.margin)),
                    {select(b.margin > a.margin, b.at.x, a.at.x), a.at.y}};
      });
      take(all.margin, all.second, all.at.x);
    }
    // Computes the winning column again, for the row and for the next best beside it.
    R high = R(0) - huge();
    least_margins_at(best.at.x).backwards([&](R margin, std::size_t j) {
      best.at.y = select(margin == best.margin, y_[j], best.at.y);
      best.second = max(best.second, min(high, margin));
      high = max(high, margin);
    });
    return best;
  }

  /// The least margin of every candidate of column i. `x`: column_offset(i).
  [[nodiscard]] DMOSCOPE_ANYWHERE LeastMargins<R> least_margins_of_column(std::size_t i, R x) const {
    if constexpr (Kept == Tables::Full) {
      return least_margins(x, [&](std::size_t k) { return column_[k][i]; });
    } else {
      return least_margins_at(x);
    }
  }

  /// The least margin of every candidate of the column at x, computed without a table of columns.
  [[nodiscard]] DMOSCOPE_ANYWHERE LeastMargins<R> least_margins_at(R x) const {
    const R xx = x * x;
    return least_margins(x, [&](std::size_t k) { return (margin_[k].a - margin_[k].along_x() * xx) + margin_[k].b * x; });
  }

  /// The least margin of every candidate of the column at x whose part of element k's margin is column(k).
  template <class Column>
  [[nodiscard]] DMOSCOPE_ANYWHERE LeastMargins<R> least_margins([[maybe_unused]] R x, Column column) const {
    if constexpr (kCrossed) {
      [[maybe_unused]] Line line;
      const auto row_of = [&](std::size_t k) -> const Line& {
        if constexpr (Kept != Tables::None) return row_[k];
        fill_row(margin_[k], line);
        return line;
      };
      const auto slope = [&](std::size_t k) { return R(0) - margin_[k].e * x; };
      LeastMargins<R> least(row_of(0), column(0), slope(0), y_);
      for (std::size_t k = 1; k < count(); ++k) least.take(row_of(k), column(k), slope(k), y_);
      return least;
    } else if constexpr (Kept == Tables::None) {
      Line row;
      fill_row(margin_[0], row);
      LeastMargins<R> least(row, column(0));
      for (std::size_t k = 1; k < count(); ++k) {
        fill_row(margin_[k], row);
        least.take(row, column(k));
      }
      return least;
    } else {
      LeastMargins<R> least(row_[0], column(0));
      DMOSCOPE_UNROLL
      for (std::size_t k = 1; k < count(); ++k) least.take(row_[k], column(k));
      return least;
    }
  }

  [[no_unique_address]] Team team_;
  Form* forms_;
  std::size_t count_;
  R cap_;
  Vec2<R> moved_by_;  // offset from the last level's centre
  R width_;           // size of the grid
  R greatest_;        // if kPrunes: bound of S_k(p) / S_k(centre) over the grid and all elements
  Line y_, yy_;       // rows' offsets from the centre, and the squares of their second half
  std::array<R, kMaxForms> weight_;
  std::array<Margin, kMaxForms> margin_;
  std::array<R, Kept == Tables::Full ? kPoints : 0> x_;  // offsets of the columns
  std::array<Line, Kept == Tables::Full ? kMaxForms : 0> column_;
  std::array<Line, Kept == Tables::None ? 0 : kMaxForms> row_;
};

}  // namespace dmoscope
