#pragma once
// The grid search by a metric that is defined by a formula or a target: many candidates at once, an element at a time, the worst first;
// candidates that cannot win any more are left out from there on. It finds the candidate that a look at all would find.

#include <vector>

#include "core/formula/evaluator.h"
#include "core/search/defined_star.h"
#include "core/search/parameters.h"

namespace dmoscope {

/// Frame: Plane or Space.
template <class Frame>
class DefinedSearch {
 public:
  using Offset = OffsetIn<Frame, double>;

  /// In float where that can be: see DefinedJudge::needs_double(); nor where double is asked for.
  DefinedSearch(const DefinedStarJudge<Frame>& judge, const SearchParameters& parameters);

  struct Found {
    Offset offset{};     // in units of `scale`
    double scale = 1.0;  // mesh units
    Offset box{};        // of the star's other vertices, in units of scale
  };
  /// What a search works in; kept from one vertex to the next.
  template <class Real>
  struct Room {
    struct Element {
      const FormulaProgram* program;
      ElementTarget target;
      std::size_t first;  // of its uniform numbers
      Real here;          // its metric with the vertex where it is
    };
    std::vector<Element> elements;
    std::vector<Real> uniforms;
    AlignedNumbers<Real> registers;
    std::vector<Real> least, at[3];  // of the candidates that are left: the least so far, and where they are
  };
  struct Scratch {
    Room<float> narrow;
    Room<double> wide;
  };
  /// Of a vertex of whose elements none is inverted. `levels`: how many, from the first.
  [[nodiscard]] Found find(PositionView positions, Index vertex, int levels, Scratch& scratch) const;
  [[nodiscard]] bool in_double() const noexcept { return in_double_; }

 private:
  template <class Real>
  struct Visit;
  template <class Real>
  [[nodiscard]] Offset search(PositionView positions, Index vertex, const Found& star, int levels, Room<Real>& room) const;

  DefinedStarJudge<Frame> judge_;
  SearchParameters parameters_;
  bool in_double_;
  FormulaKernel<float> narrow_;
  FormulaKernel<double> wide_;
};

}  // namespace dmoscope
