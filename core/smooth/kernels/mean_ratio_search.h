#pragma once
// Grid search by the least of many mean ratios in space, with a look at few candidates only.
//
// A form (MeanRatioForm) ranks above t where v - sqrt(t) s^(3/2) is positive. The determinant v is affine in the candidate's place, and
// s^(1/2), the length of an affine function, is convex; so that set is convex, and the tangent at a candidate that is no better tells a
// half-space in which none is. The candidate that is found is the one that a look at all would find.
//
// Only the kernels' sources include it; see lane_kernel_impl.h for what that asks of the code.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "core/numeric/pack.h"
// Headers that must come after the packs:
#include "core/smooth/kernels/grid_cuts.h"
#include "core/smooth/kernels/indexed_star.h"
#include "core/smooth/kernels/solid_target.h"
#include "core/smooth/kernels/volume_form.h"

namespace dmoscope::volumes {

/// Form of its numbers in order: of(i).
template <template <class> class Form, class R, class Of>
[[gnu::always_inline]] [[nodiscard]] inline Form<R> form_of(const Of& of) {
  if constexpr (std::is_same_v<Form<float>, MeanRatioForm<float>>)
    return {of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7), of(8)};
  else
    return {of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7), of(8), of(9), of(10), of(11), of(12), of(13)};
}

/// Search among forms. F: pack of floats, a form per slot. Form: MeanRatioForm or StretchedForm.
template <class F, template <class> class Form = MeanRatioForm>
class MeanRatioSearch {
 public:
  static constexpr std::size_t kWidth = F::size;

  explicit MeanRatioSearch(int points) : n_(static_cast<std::size_t>(points)), cuts_(n_) {
    for (int i = 0; i < points; ++i) part_[i] = static_cast<float>(i) / static_cast<float>(points - 1) - 0.5F;
    for (std::size_t i = n_; i % kWidth != 0; ++i) part_[i] = 0.0F;
  }

  /// Takes a pack of forms, each slot in use. At most kMaxPacks in all.
  void take(const Form<F>& forms) {
    alignas(64) F fields[kFormFields];
    static_assert(sizeof(fields) == sizeof(forms));
    std::memcpy(static_cast<void*>(fields), &forms, sizeof(fields));
    for (std::size_t i = 0; i < kFormFields; ++i) fields[i].store_aligned(forms_[count_][i]);
    for (std::size_t slot = 0; slot < kWidth; ++slot)
      which_[count_][slot] = std::bit_cast<float>(static_cast<std::uint32_t>(count_ * kWidth + slot));
    ++count_;
  }

  /// Least rank with the vertex at its present place; the search begins there.
  [[nodiscard]] float begin() {
    best_ = evaluate(0.0F, 0.0F, 0.0F);
    return best_.rank;
  }

  /// Goes to the best candidate of a grid around the best place so far, where one is better; among equals to that of lowest index.
  void search_level(float size_x, float size_y, float size_z) {
    for (std::size_t i = 0; i < n_; i += kWidth) {  // placed as in CandidateGrid
      const F part = F::load_aligned(part_ + i);
      (F(best_.x) + F(size_x) * part).store_aligned(x_ + i);
      (F(best_.y) + F(size_y) * part).store_aligned(y_ + i);
      (F(best_.z) + F(size_z) * part).store_aligned(z_ + i);
    }
    index_ = n_ * n_ * n_;  // index of the place before: higher than all
    cuts_.begin(x_, y_, z_);
    note_rounding();
    cut_at(best_);
    while (!cuts_.empty()) {
      const std::size_t row = cuts_.row(), i = cuts_.i(), j = cuts_.j(), k = cuts_.middle();
      cut_at(look(i, j, k));
      if (!cuts_.in_question(row, k)) continue;
      // Compares the row one by one: the place is as good as the best, or too near to it for the cut to tell.
      if (!cuts_.drop_end(row, k)) {
        for (std::size_t other = 0; other < n_; ++other)
          if (other != k && cuts_.in_question(row, other)) (void)look(i, j, other);
        cuts_.drop(row);
      }
      if (row == cuts_.row()) cuts_.find_longest();
    }
  }

  [[nodiscard]] Vec3Of<float> best() const { return {best_.x, best_.y, best_.z}; }

 private:
  /// Place, its least rank, and the form that has it.
  struct Looked {
    float x = 0.0F, y = 0.0F, z = 0.0F, rank = 0.0F;
    std::size_t form = 0;
  };

  [[nodiscard]] Looked evaluate(float x, float y, float z) const {
    using scalar::min;
    const Vec3Of<F> p{F(x), F(y), F(z)};
    const F square = dot(p, p), rough = bits_of(~(kForms - 1));
    F least(std::numeric_limits<float>::max()), worst = least;
    for (std::size_t i = 0; i < count_; ++i) {
      const F rank = rank_of(forms_at(i), p, square);
      least = min(least, rank);
      // Notes the form in the lowest bits: among forms that are equally bad but for these bits any will do.
      worst = min(worst, (rank & rough) | F::load_aligned(which_[i]));
    }
    return {x, y, z, scalar::least_slot(least), std::bit_cast<std::uint32_t>(scalar::least_slot(worst)) & (kForms - 1)};
  }
  [[nodiscard]] static F bits_of(std::uint32_t bits) { return F(std::bit_cast<float>(bits)); }
  Looked look(std::size_t i, std::size_t j, std::size_t k) {
    const std::size_t index = (i * n_ + j) * n_ + k;
    const Looked here = evaluate(x_[i], y_[j], z_[k]);
    if (here.rank > best_.rank || (here.rank == best_.rank && index < index_ && index_ < n_ * n_ * n_)) {
      best_ = here;
      index_ = index;
    }
    return here;
  }

  [[nodiscard]] Form<F> forms_at(std::size_t i) const {
    return form_of<Form, F>([&](std::size_t field) { return F::load_aligned(forms_[i][field]); });
  }

  /// Bounds rounding at any candidate of the level, by the size of the terms that are added up there.
  void note_rounding() {
    const Vec3Of<float> reach = cuts_.reach();
    const F x(reach.x), y(reach.y), z(reach.z), square = x * x + y * y + z * z;
    for (std::size_t i = 0; i < count_; ++i) {
      const Form<F> f = forms_at(i);
      const F v = xsimd::abs(f.v0) + xsimd::abs(f.vx) * x + xsimd::abs(f.vy) * y + xsimd::abs(f.vz) * z;
      const F s = f.s0 + xsimd::abs(f.sx) * x + xsimd::abs(f.sy) * y + xsimd::abs(f.sz) * z + second_order_bound(f, x, y, z, square);
      (F(kRounding) * v).store_aligned(forms_[i][kFields - 2]);
      (F(kRounding) * s * xsimd::sqrt(s)).store_aligned(forms_[i][kFields - 1]);
    }
  }

  /// Cuts off the half-space that the worst form of a place tells to be no better than the best.
  void cut_at(const Looked& here) {
    const auto of = [&, slot = here.form % kWidth](std::size_t field) { return forms_[here.form / kWidth][field][slot]; };
    const Form<float> f = form_of<Form, float>(of);
    const Vec3Of<float> at{here.x, here.y, here.z};
    const float v = determinant_of(f, at), s = squares_of(f, at, dot(at, at));
    const float root = std::sqrt(s), threshold = std::sqrt(best_.rank), steep = 1.5F * threshold * root;
    const Vec3Of<float> slope = slope_of_squares(f, at);
    GridCut cut;
    cut.from = at;
    cut.at_least = (v - threshold * s * root) + (of(kFields - 2) + threshold * of(kFields - 1));
    cut.slope = {f.vx - steep * slope.x, f.vy - steep * slope.y, f.vz - steep * slope.z};
    cuts_.cut(cut);
  }

  static constexpr float kRounding = 4e-6F;
  static constexpr std::size_t kFormFields = sizeof(Form<float>) / sizeof(float);
  static constexpr std::size_t kFields = kFormFields + 2;  // fields of a form, and how far v and s^(3/2) may be rounded
  static constexpr std::uint32_t kForms = 2048;            // a power of two: more than four corners of kMaxSolids elements of each kind are

 public:
  static constexpr std::size_t kMaxPacks = kForms / kWidth;
  static_assert(kMaxSolids * (1 + 4 * (kSolidKinds - 1)) <= kForms);

 private:
  Looked best_;
  std::size_t n_, count_ = 0, index_ = 0;  // packs of forms; the best place's index in its level
  alignas(64) float part_[GridCuts<F>::kMaxPoints], x_[GridCuts<F>::kMaxPoints], y_[GridCuts<F>::kMaxPoints], z_[GridCuts<F>::kMaxPoints];
  GridCuts<F> cuts_;
  alignas(64) float forms_[kMaxPacks][kFields][kWidth];
  alignas(64) float which_[kMaxPacks][kWidth];  // bits: the number of each form
};

}  // namespace dmoscope::volumes
