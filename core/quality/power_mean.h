#pragma once
// Means of qualities above 0. All rise where a quality rises; they differ in how much a bad element counts.

#include <array>
#include <cstdint>
#include <string_view>

#include "core/base/host_device.h"
#include "core/numeric/scalar.h"

namespace dmoscope {

/// The power means of exponents -1, 1, 0 and -2. The arithmetic one is indifferent to where quality comes from: it lets one element become
/// bad if several others win a little. The harmonic one weighs an element by the inverse square of its quality: bad elements count most,
/// and steps at .1, .2, .3 and .4 see to it that no gain is paid for by one more element below one of these.
enum class MeanKind : std::uint8_t { Harmonic, Arithmetic, Geometric, InverseSquare };

/// Those of the harmonic one, and what an element below adds to the sum of inverses. A lower step counts more than all higher ones of a
/// star together, and any more than the inverses of its sound elements can gain.
inline constexpr double kMeanSteps[] = {0.4, 0.3, 0.2, 0.1};           // NOLINT(*-avoid-c-arrays): NVRTC has no <array>
inline constexpr double kMeanStepAdds[] = {1e3, 16e3, 256e3, 4096e3};  // NOLINT(*-avoid-c-arrays)

/// All of them and their names, in the same order. The first is the usual one.
inline constexpr std::array kMeanKinds{MeanKind::Harmonic, MeanKind::Arithmetic, MeanKind::Geometric, MeanKind::InverseSquare};
inline constexpr std::array<std::string_view, kMeanKinds.size()> kMeanNames{"mean", "arithmetic-mean", "geometric-mean",
                                                                            "inverse-square-mean"};
[[nodiscard]] constexpr std::string_view name(MeanKind kind) { return kMeanNames[static_cast<std::size_t>(kind)]; }

/// Returns whether the terms of a mean are multiplied, not added; and whether their total falls where the mean rises.
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool is_product(MeanKind kind) { return kind == MeanKind::Geometric; }
[[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE bool has_falling_total(MeanKind kind) {
  return kind == MeanKind::Harmonic || kind == MeanKind::InverseSquare;
}

/// Adds up qualities and tells a rising function of their mean, above 0: the mean itself, of the geometric one the product of the sixteenth
/// roots, of the harmonic one with its steps. R: a scalar or a pack, whose slots get the bits that scalars get.
template <class R>
class PowerMean {
 public:
  DMOSCOPE_ANYWHERE explicit PowerMean(MeanKind kind) : kind_(kind), total_(neutral()) {}

  DMOSCOPE_ANYWHERE void add(R quality) { join(term(quality)); }
  /// A quality's part of the total; that of a slot which does not count.
  [[nodiscard]] DMOSCOPE_ANYWHERE R term(R quality) const {
    using scalar::sqrt;
    if (kind_ == MeanKind::Harmonic) return R(1.0) / quality + steps(quality);
    if (kind_ == MeanKind::InverseSquare) return R(1.0) / (quality * quality);
    return is_product(kind_) ? sqrt(sqrt(sqrt(sqrt(quality)))) : quality;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE R neutral() const { return is_product(kind_) ? R(1.0) : R(0.0); }
  DMOSCOPE_ANYWHERE void join(R term) { total_ = is_product(kind_) ? total_ * term : total_ + term; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R total() const { return total_; }
  /// The total of `count` qualities becomes their mean.
  [[nodiscard]] DMOSCOPE_ANYWHERE R value(double count) const {
    using scalar::sqrt;
    if (kind_ == MeanKind::Arithmetic) return total_ / R(count);
    if (kind_ == MeanKind::Harmonic) return R(count) / total_;
    return kind_ == MeanKind::InverseSquare ? sqrt(R(count) / total_) : total_;
  }
  /// Total of `count` qualities whose mean is `mean`.
  [[nodiscard]] static DMOSCOPE_INLINE DMOSCOPE_ANYWHERE R total_of(MeanKind kind, R mean, double count) {
    if (kind == MeanKind::Arithmetic) return mean * R(count);
    if (kind == MeanKind::Harmonic) return R(count) / mean;
    return kind == MeanKind::InverseSquare ? R(count) / (mean * mean) : mean;
  }
  /// Size of the slope of term() without steps, by the quality; of a product, over the term and times sixteen. `inverse`: 1 / quality.
  [[nodiscard]] static DMOSCOPE_INLINE DMOSCOPE_ANYWHERE R slope(MeanKind kind, R inverse) {
    if (kind == MeanKind::Arithmetic) return R(1.0);
    if (kind == MeanKind::Harmonic) return inverse * inverse;
    return kind == MeanKind::InverseSquare ? R(2.0) * inverse * inverse * inverse : inverse;
  }
  /// Size of the slope of the total of `count` qualities by their mean.
  [[nodiscard]] DMOSCOPE_ANYWHERE R slope_of_total(double count) const {
    using scalar::sqrt;
    if (kind_ == MeanKind::Arithmetic) return R(count);
    if (kind_ == MeanKind::Harmonic) return total_ * total_ / R(count);
    return kind_ == MeanKind::InverseSquare ? R(2.0) * total_ * sqrt(total_ / R(count)) : R(1.0);
  }

 private:
  /// The sum of the steps that a bad element adds to its inverse.
  [[nodiscard]] static DMOSCOPE_ANYWHERE R steps(R quality) {
    return step<0>(quality) + step<1>(quality) + step<2>(quality) + step<3>(quality);
  }
  template <int I>
  [[nodiscard]] static DMOSCOPE_ANYWHERE R step(R quality) {
    using scalar::select;
    constexpr double below = kMeanSteps[I], adds = kMeanStepAdds[I];  // constants: device code has no access to the arrays themselves
    return select(quality < scalar::constant<R>(below), scalar::constant<R>(adds), R(0.0));
  }

  MeanKind kind_;
  R total_;
};

}  // namespace dmoscope
