#pragma once
// Grid search for two aims (visit/star_judge.h) of a star without inverted elements: a pack of candidates at a time, in double. The same
// code compiled for several processors, chosen at run time; each slot gets the bits that the plain search gets, so that it finds the same.

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "core/quality/metric.h"
#include "core/quality/power_mean.h"
#include "core/search/parameters.h"
#include "core/search/star.h"
#include "core/search/surface_star.h"

namespace dmoscope {

template <class Frame>
struct CompositeListsOf {
  using Lists = StarListsIn<Frame, double>;
};
template <>
struct CompositeListsOf<Curved> {
  using Lists = SurfaceLists;
};
/// Lists of a star for any frame: Plane, Space or Curved.
template <class Frame>
using CompositeLists = typename CompositeListsOf<Frame>::Lists;

/// Star and its aims as plain data. Lengths are in units of the star's scale.
template <class Frame>
struct CompositeSearch {
  using Offset = OffsetIn<Frame, double>;
  enum class Second { Mean, Metric, Density };

  CompositeLists<Frame> star;
  Offset box{};
  int points = 8, levels = 3;
  double omega = 0.5;

  double threshold = 0.0;
  bool inclusive = false;  // whether a star whose least is the threshold is beyond it
  Second second = Second::Mean;
  MeanKind mean = MeanKind::Harmonic;  // Second::Mean
  Metric metric = Metric::MeanRatio;   // Second::Metric
  Offset wanted{};                     // Second::Density: see DensityTarget
  double edge = 0.0;

  // Lists alone: places whose least guarded metric is at most this are left out; -infinity: none.
  double guard_below = -std::numeric_limits<double>::infinity();
  Metric guarded = Metric::MeanRatio;
};

template <class Frame>
struct CompositeFound {
  bool ready = false;                // false: the plain search must find it
  OffsetIn<Frame, double> offset{};  // 0 where no candidate is better
};

/// Limits for triangles or tetrahedra of a star, its other elements, and candidates per axis; beyond them the plain search is used.
inline constexpr std::size_t kMaxSimplices = 96, kMaxOthers = 64;
inline constexpr int kMaxCompositePoints = 64;

template <class Frame>
using CompositeKernel = CompositeFound<Frame> (*)(const CompositeSearch<Frame>& search);

/// Candidates at any places, as plain data: `count` offsets, coordinate by coordinate (two in a plane). Copies of the last one follow it,
/// so that all packs are whole.
struct CompositeCandidates {
  std::array<const double*, 3> at{};
  std::size_t count = 0;
};
/// First of the best candidates.
struct CompositeBest {
  bool ready = false;     // false: the plain search must find it
  std::size_t index = 0;  // number of the candidates where none is better
  double worth = 0.0;
};
/// Kernel that finds the first of the best among candidates that are worth more than `best`, the worth of a place at which the star has no
/// inverted elements.
template <class Frame>
using CompositeListKernel = CompositeBest (*)(const CompositeSearch<Frame>& search, const CompositeCandidates& candidates, double best);

/// Maker of CompositeCandidates.
class CandidateList {
 public:
  void clear() {
    for (auto& list : at_) list.clear();
  }
  [[nodiscard]] std::size_t size() const noexcept { return at_[0].size(); }
  void add(Vec2<double> p) { add(Vec3{p.x, p.y, 0.0}); }
  void add(Vec3 p) { at_[0].push_back(p.x), at_[1].push_back(p.y), at_[2].push_back(p.z); }
  void add(SurfaceVector p) { add(p.v); }
  template <class Offset>
  [[nodiscard]] Offset get(std::size_t i) const {
    if constexpr (std::is_same_v<Offset, Vec2<double>>)
      return {at_[0][i], at_[1][i]};
    else if constexpr (std::is_same_v<Offset, Vec3>)
      return {at_[0][i], at_[1][i], at_[2][i]};
    else
      return {{at_[0][i], at_[1][i], at_[2][i]}, {}};
  }
  /// Candidates as plain data, valid until the list changes.
  [[nodiscard]] CompositeCandidates view() {
    CompositeCandidates result{{}, size()};
    for (std::size_t axis = 0; axis < at_.size(); ++axis) {
      auto& list = at_[axis];
      list.reserve(list.size() + kWidest);
      for (std::size_t i = 0; i < kWidest && result.count > 0; ++i) list.data()[result.count + i] = list[result.count - 1];
      result.at[axis] = list.data();
    }
    return result;
  }

 private:
  static constexpr std::size_t kWidest = 16;  // floats of the widest pack
  std::array<std::vector<double>, 3> at_;
};

}  // namespace dmoscope
