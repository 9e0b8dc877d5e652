#pragma once
// Grid search by a metric that is defined by a formula or a target: many candidates at once, an element at a time, the worst first;
// candidates that cannot win any more are left out from there on. It finds the same candidate as a look at all.

#include <vector>

#include "core/formula/evaluator.h"
#include "core/search/defined_star.h"
#include "core/search/parameters.h"

namespace dmoscope {

/// Search for stars of a mesh. Frame: Plane or Space.
template <class Frame>
class DefinedSearch {
 public:
  using Offset = OffsetIn<Frame, double>;

  /// Searches in float where that is possible: neither where DefinedJudge::needs_double() holds nor where double is asked for.
  DefinedSearch(const DefinedStarJudge<Frame>& judge, const SearchParameters& parameters);

  struct Found {
    Offset offset{};     // offset in units of `scale`
    double scale = 1.0;  // mesh units
    Offset box{};        // box of the star's other vertices, in units of scale
  };
  /// Work space of a search; kept from one vertex to the next.
  template <class Real>
  struct Room {
    struct Element {
      const FormulaProgram* program;
      ElementTarget target;
      std::size_t first;  // offset of its uniform numbers
      Real here;          // its metric with the vertex at its present place
    };
    std::vector<Element> elements;
    std::vector<Real> uniforms;
    AlignedNumbers<Real> registers;
    std::vector<Real> least, at[3];  // candidates that are left: their least so far, and their places
  };
  struct Scratch {
    Room<float> narrow;
    Room<double> wide;
  };
  /// Finds the best candidate of a vertex of whose elements none is inverted. `levels`: number of levels, from the first.
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
