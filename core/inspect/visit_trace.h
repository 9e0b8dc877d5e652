#pragma once
// Trace of a vertex's visit: the candidates that the search tried, their values, and the result.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/position_view.h"
#include "core/search/parameters.h"
#include "core/smooth/visit/star_judge.h"

namespace dmoscope {

/// Values of one level's candidates, in a plane or in space.
struct LevelValues {
  int points = 0;               // points per axis
  std::vector<double> values;   // value of each candidate that the search compared (see VisitSummary::value_phrase)
  std::vector<double> quality;  // quality of the star for each candidate, by the statistics' formulas: see quality_of()
  std::optional<int> best;      // candidate that this level chose; none: no candidate was better than the best of earlier levels
};

/// One level of a traced search. Candidate (i, j), 0 <= i, j < points, has the index i * points + j; i counts along the plane's first axis.
/// In space candidate (i, j, k) has the index (i * points + j) * points + k, and i counts along x. Offset: Vec2<double> or Vec3.
template <class Offset>
struct TracedLevelIn : LevelValues {
  Offset centre, size;          // centre and size of the grid: mesh units, relative to the vertex's place before the visit
  std::vector<Offset> offsets;  // the candidates as the search rounded them, in the same units
  /// Offset of candidate `index` from the vertex's place before the visit; mesh units.
  [[nodiscard]] Offset at(int index) const { return offsets[static_cast<std::size_t>(index)]; }
};
using TracedLevel = TracedLevelIn<Vec2<double>>;
using VolumeLevel = TracedLevelIn<Vec3>;

/// Quality of a star as one number: its least metric or, if an element is inverted, its least normalised Jacobian (<= 0).
[[nodiscard]] inline double quality_of(const StarState& state) { return state.jacobian > 0.0 ? state.quality : state.jacobian; }

/// One element of the star, before and after the visit, by the statistics' formulas.
struct ElementChange {
  Index element = kNoIndex;
  double before = 0.0, after = 0.0;  // values of the metric that is optimised
  bool inverted_before = false, inverted_after = false;
};

/// Outcome of a visit.
enum class VisitEnd {
  Moved,         // the vertex gains and moves
  NothingFound,  // no candidate is better than the present place
  NotConfirmed,  // the search found a place, but judged exactly it gains nothing
  Deviates,      // the search found a place on a surface from which faces would leave the input by more than the bound
  Leans,         // the search found a place on a surface from which faces would lean over the input by more than 60 degrees
  Fixed,         // the vertex may not move, and was not searched
  Waits          // the star is sound, and this iteration moves no such vertex: see Untangling::repair
};

/// Result of a visit, for candidates of any frame.
struct VisitSummary {
  Index vertex = kNoIndex;
  Metric metric = Metric::MeanRatio;
  bool fast = false;         // searched in float by the fast search; else in double by the plain one
  bool combined = false;     // two aims: values beyond a threshold are the threshold plus the second aim
  bool by_corners = false;   // volume elements are judged corner by corner: `before` and `after` count the corners that the vertex changes
  bool untangling = false;   // an element was inverted, so untangling came first, see UntanglingObjective
  std::string value_phrase;  // name of LevelValues::values: "mean ratio", "squared sine of the smallest angle", ...
  double value_here = 0.0;   // value of the vertex's place before the visit, which a candidate had to exceed
  double value_at_start = 0.0;  // value at the centre of the first grid, which differs from the vertex's place only in a tangled star
  Vec3 from, to;                // place before and after the visit; equal unless the vertex moved
  StarState before, after;
  std::vector<ElementChange> elements;  // elements in the star's order
  VisitEnd end = VisitEnd::NothingFound;
  int halvings = 0;  // halvings of the step, since the whole step would invert an element inside: see confirmed_move()
  /// Sentence on the outcome: "moved: worst element of its star 0.31 -> 0.82", "no candidate is better than where it stands", ...
  [[nodiscard]] std::string sentence() const;
  /// Phrase for what StarState::quality belongs to.
  [[nodiscard]] const char* worst_phrase() const { return by_corners ? "worst corner" : "worst element"; }
};

template <class Offset>
struct VisitTraceIn : VisitSummary {
  Offset step;     // step of the vertex; mesh units
  Offset start{};  // centre of the first grid, relative to `from`; not 0 only in a tangled star, see MeanOfCorners
  Offset found;    // place that the search chose, relative to `from`; mesh units
  std::vector<TracedLevelIn<Offset>> levels;  // empty for a fixed vertex
};
using VisitTrace = VisitTraceIn<Vec2<double>>;  // trace in the mesh's plane
using VolumeTrace = VisitTraceIn<Vec3>;         // trace in a volume mesh

/// Traces what DMO with these parameters does to `vertex` while the mesh's vertices are at `positions`. Watches the smoother's own visit,
/// so `to` has the bits that the smoother would store. Costs as much as a few visits; in a volume against targets a look at all of them,
/// too. `fixed`: one entry for each vertex, as Run::fixed. Throws UsageError for a mesh that is not planar, a vertex that does not exist,
/// parameters out of range, or a metric that is not defined for its star. `composite`: the objective of a visit with two aims, see
/// composite_objective_of_visit; its first aim is `metric`. `untangling`: that of the iteration, as Run::sweep() has it. `guard`: of a
/// visit by one metric, see Run::guard(); if the winner breaks it, the trace is that of the search that respects it.
[[nodiscard]] VisitTrace trace_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed, Metric metric,
                                     const SearchParameters& parameters, Index vertex,
                                     const std::optional<CompositeObjective>& composite = {}, const Untangling& untangling = {},
                                     const std::optional<Guard>& guard = {});

/// Traces the visit of a vertex of a volume mesh. The fast search compares ranks in float and reports only which candidate it chose in each
/// level. The values here are the metric in double, so among nearly equal candidates the chosen one need not be the first of the largest.
[[nodiscard]] VolumeTrace trace_volume_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed,
                                             Metric metric, const SearchParameters& parameters, Index vertex,
                                             const std::optional<CompositeObjective>& composite = {}, const Untangling& untangling = {},
                                             const std::optional<Guard>& guard = {});

}  // namespace dmoscope
