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

/// "mean" (the harmonic one, the usual), "arithmetic-mean", "geometric-mean" or "inverse-square-mean".
[[nodiscard]] std::string_view name(MeanKind kind);
inline constexpr std::array kMeanKinds{MeanKind::Harmonic, MeanKind::Arithmetic, MeanKind::Geometric, MeanKind::InverseSquare};
/// Throws UsageError.
[[nodiscard]] MeanKind parse_mean_kind(std::string_view word);

/// Adds up qualities and tells a rising function of their mean, above 0: the mean itself, of the geometric one the product of the sixteenth
/// roots, of the harmonic one with its steps. R: a scalar or a pack, whose slots get the bits that scalars get.
template <class R>
class PowerMean {
 public:
  DMOSCOPE_ANYWHERE explicit PowerMean(MeanKind kind) : kind_(kind), total_(kind == MeanKind::Geometric ? R(1.0) : R(0.0)) {}

  DMOSCOPE_ANYWHERE void add(R quality) { join(term(quality)); }
  /// A quality's part of the total; that of a slot which does not count.
  [[nodiscard]] DMOSCOPE_ANYWHERE R term(R quality) const {
    using scalar::sqrt;
    switch (kind_) {
      case MeanKind::Arithmetic:
        break;
      case MeanKind::Harmonic:
        return R(1.0) / quality + steps(quality);
      case MeanKind::InverseSquare:
        return R(1.0) / (quality * quality);
      case MeanKind::Geometric:
        return sqrt(sqrt(sqrt(sqrt(quality))));
    }
    return quality;
  }
  [[nodiscard]] DMOSCOPE_ANYWHERE R neutral() const { return kind_ == MeanKind::Geometric ? R(1.0) : R(0.0); }
  DMOSCOPE_ANYWHERE void join(R term) { total_ = kind_ == MeanKind::Geometric ? total_ * term : total_ + term; }
  [[nodiscard]] DMOSCOPE_ANYWHERE R total() const { return total_; }
  /// The total of `count` qualities becomes their mean.
  [[nodiscard]] DMOSCOPE_ANYWHERE R value(double count) const {
    using scalar::sqrt;
    switch (kind_) {
      case MeanKind::Arithmetic:
        return total_ / R(count);
      case MeanKind::Harmonic:
        return R(count) / total_;
      case MeanKind::InverseSquare:
        return sqrt(R(count) / total_);
      case MeanKind::Geometric:
        break;
    }
    return total_;
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
