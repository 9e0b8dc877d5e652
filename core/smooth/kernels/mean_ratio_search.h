#pragma once
// The grid search by the least of many mean ratios in space, with a look at few candidates only.
//
// A form (MeanRatioForm) ranks above t where v - sqrt(t) s^(3/2) is positive. The determinant v is affine in the candidate's place, and
// s^(1/2), the length of an affine function, is convex; so that set is convex, and the tangent at a candidate that is no better tells a
// half-space in which none is. The candidate that is found is the one that a look at all would find.
//
// Only the kernels' sources include it; see lane_kernel_impl.h for what that asks of the code.

#include <cmath>
#include <cstddef>
#include <limits>

#include "core/numeric/pack.h"
// After the packs:
#include "core/search/grid_search.h"
#include "core/smooth/kernels/grid_cuts.h"
#include "core/smooth/kernels/volume_form.h"

namespace dmoscope::volumes {

/// F: pack of floats, a form per slot.
template <class F>
class MeanRatioSearch {
 public:
  static constexpr std::size_t kWidth = F::size;

  /// A pack of forms, each slot in use. At most kMaxPacks in all.
  void take(const MeanRatioForm<F>& forms) {
    const F* fields[kFields] = {&forms.v0, &forms.vx, &forms.vy, &forms.vz, &forms.s0, &forms.sx, &forms.sy, &forms.sz, &forms.square};
    for (std::size_t i = 0; i < kFields; ++i) fields[i]->store_aligned(forms_[count_][i]);
    ++count_;
  }

  /// The least rank with the vertex where it is; the search begins there.
  [[nodiscard]] float begin() {
    best_ = evaluate(0.0F, 0.0F, 0.0F);
    return best_.rank;
  }

  /// Goes to the best candidate of a grid around the best place so far, where one is better. Among equals to the one of lowest index.
  void search_level(float size_x, float size_y, float size_z, int points) {
    const auto n = static_cast<std::size_t>(points);
    const CandidateGrid<F, Vec3Of<F>> grid{{F(best_.x), F(best_.y), F(best_.z)}, {F(size_x), F(size_y), F(size_z)}, points};
    for (std::size_t i = 0; i < n; ++i) {
      const int at = static_cast<int>(i);
      const Vec3Of<F> p = grid.at(at, at, at);
      x_[i] = p.x.get(0);
      y_[i] = p.y.get(0);
      z_[i] = p.z.get(0);
    }
    if (n != n_) cuts_.set_points(n);
    n_ = n;
    index_ = n * n * n;  // of what was there before: higher than all
    cuts_.begin(x_, y_, z_);
    reach_ = cuts_.reach();
    cut_at(best_);
    while (!cuts_.empty()) {
      const std::size_t row = cuts_.row(), low = cuts_.low(), high = cuts_.high(), k = low + (high - low) / 2;
      const Looked here = look(row, k);
      cut_at(here);
      if (!cuts_.in_question(row, k)) continue;
      // It is as good as the best, or too near to it for the cut to tell: its row is looked at, one by one.
      for (std::size_t other = low; other <= high; ++other)
        if (other != k && cuts_.in_question(row, other)) (void)look(row, other);
      cuts_.drop(row);
      cuts_.find_longest();
    }
  }

  [[nodiscard]] Vec3Of<float> best() const { return {best_.x, best_.y, best_.z}; }

 private:
  /// A place, its least rank, and the form that has it.
  struct Looked {
    float x = 0.0F, y = 0.0F, z = 0.0F, rank = 0.0F;
    std::size_t form = 0;
  };

  [[nodiscard]] Looked evaluate(float x, float y, float z) const {
    using scalar::min;
    const Vec3Of<F> p{F(x), F(y), F(z)};
    const F square = dot(p, p);
    F least(std::numeric_limits<float>::max()), where(0.0F), pack(0.0F);
    for (std::size_t i = 0; i < count_; ++i) {
      const F rank = rank_of(forms_at(i), p, square);
      where = xsimd::select(rank < least, pack, where);
      pack += F(1.0F);
      least = min(least, rank);
    }
    alignas(64) float ranks[kWidth], packs[kWidth];
    least.store_aligned(ranks);
    where.store_aligned(packs);
    std::size_t worst = 0;
    for (std::size_t k = 1; k < kWidth; ++k)
      if (ranks[k] < ranks[worst]) worst = k;
    return {x, y, z, ranks[worst], static_cast<std::size_t>(packs[worst]) * kWidth + worst};
  }

  Looked look(std::size_t row, std::size_t k) {
    const std::size_t index = row * n_ + k;
    const Looked here = evaluate(x_[row / n_], y_[row % n_], z_[k]);
    if (here.rank > best_.rank || (here.rank == best_.rank && index < index_ && index_ < n_ * n_ * n_)) {
      best_ = here;
      index_ = index;
    }
    return here;
  }

  [[nodiscard]] MeanRatioForm<F> forms_at(std::size_t i) const {
    const auto of = [&](std::size_t field) { return F::load_aligned(forms_[i][field]); };
    return {of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7), of(8)};
  }

  /// Cuts off what the worst form of a place tells to be no better than the best.
  void cut_at(const Looked& here) {
    const auto of = [&, slot = here.form % kWidth](std::size_t field) { return forms_[here.form / kWidth][field][slot]; };
    const float v0 = of(0), vx = of(1), vy = of(2), vz = of(3), s0 = of(4), sx = of(5), sy = of(6), sz = of(7), q = of(8);
    const float v = v0 + vx * here.x + vy * here.y + vz * here.z;
    const float s = s0 + sx * here.x + sy * here.y + sz * here.z + q * (here.x * here.x + here.y * here.y + here.z * here.z);
    const float root = std::sqrt(s), threshold = std::sqrt(best_.rank), steep = 1.5F * threshold * root;
    // How far rounding may go at any candidate, by the size of what is added up there.
    const float v_terms = std::fabs(v0) + std::fabs(vx) * reach_.x + std::fabs(vy) * reach_.y + std::fabs(vz) * reach_.z;
    const float s_terms = s0 + std::fabs(sx) * reach_.x + std::fabs(sy) * reach_.y + std::fabs(sz) * reach_.z +
                          q * (reach_.x * reach_.x + reach_.y * reach_.y + reach_.z * reach_.z);
    GridCut cut;
    cut.from = {here.x, here.y, here.z};
    cut.at_least = (v - threshold * s * root) + kRounding * (v_terms + threshold * s_terms * std::sqrt(s_terms));
    cut.slope = {vx - steep * (sx + 2.0F * q * here.x), vy - steep * (sy + 2.0F * q * here.y), vz - steep * (sz + 2.0F * q * here.z)};
    cuts_.cut(cut);
  }

  static constexpr float kRounding = 4e-6F;
  static constexpr std::size_t kFields = 9;

 public:
  static constexpr std::size_t kMaxPacks = 1024;

 private:
  Looked best_;
  std::size_t count_ = 0, n_ = 0, index_ = 0;  // of the best in its level
  float x_[GridCuts<F>::kMaxPoints], y_[GridCuts<F>::kMaxPoints], z_[GridCuts<F>::kMaxPoints];
  Vec3Of<float> reach_{};
  GridCuts<F> cuts_;
  alignas(64) float forms_[kMaxPacks][kFields][kWidth];
};

}  // namespace dmoscope::volumes
