#pragma once
// A team searches a star together: one lane alone, or lanes that share the columns of the candidate grid. All lanes of a team run the same
// code on the same values and differ only in the columns they look at, so that a team finds the same bits as one lane alone.

#include "core/base/host_device.h"

namespace dmoscope {

/// A team of one lane. Another team (a GPU has one of eight, for meshes too small to fill it) has the same members: kSize, a power of two;
/// lane(), 0 to kSize - 1; and exchange(value, mask), which gives each lane the value of the lane whose number differs from its own by the
/// bits of `mask`.
struct Solo {
  static constexpr unsigned kSize = 1;
  [[nodiscard]] static DMOSCOPE_ANYWHERE unsigned lane() { return 0; }
  template <class T>
  [[nodiscard]] DMOSCOPE_ANYWHERE T exchange(T value, unsigned /*mask*/) const {
    return value;
  }
};

/// Joins the lanes' values by join(lower, higher), the value of the lower lanes first; every lane gets the result.
template <class Team, class T, class Join>
[[nodiscard]] DMOSCOPE_ANYWHERE T fold(const Team& team, T value, Join join) {
  for (unsigned mask = 1; mask < Team::kSize; mask *= 2) {
    const T other = team.exchange(value, mask);
    value = (team.lane() & mask) == 0 ? join(value, other) : join(other, value);
  }
  return value;
}

}  // namespace dmoscope
