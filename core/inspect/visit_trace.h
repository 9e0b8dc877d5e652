#pragma once
// Looks into the visit of one vertex: what the search tried, what it valued each candidate at, and what came of it.

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

/// What the candidates of one level are worth, whether they lie in a plane or in space.
struct LevelValues {
  int points = 0;               // per axis
  std::vector<double> values;   // of each candidate: what the search compared (see VisitSummary::value_phrase)
  std::vector<double> quality;  // likewise: the star's quality with the vertex there, by the statistics' formulas: see quality_of()
  std::optional<int> best;      // the candidate that this level chose; none: no candidate was better than what was found before
};

/// Candidate (i, j), 0 <= i, j < points, has the index i * points + j; i counts along the plane's first axis. In space candidate (i, j, k)
/// has the index (i * points + j) * points + k, and i counts along x. Offset: Vec2<double> or Vec3.
template <class Offset>
struct TracedLevelIn : LevelValues {
  Offset centre, size;          // of the grid: mesh units, relative to where the vertex stood
  std::vector<Offset> offsets;  // the candidates themselves, as the search rounded them; likewise
  /// Candidate `index`, relative to where the vertex stood; mesh units.
  [[nodiscard]] Offset at(int index) const { return offsets[static_cast<std::size_t>(index)]; }
};
using TracedLevel = TracedLevelIn<Vec2<double>>;
using VolumeLevel = TracedLevelIn<Vec3>;

/// A star in one number: its least metric, or the least normalised Jacobian (<= 0) where an element is inverted.
[[nodiscard]] inline double quality_of(const StarState& state) { return state.jacobian > 0.0 ? state.quality : state.jacobian; }

/// One element of the star, before and after the visit, by the statistics' formulas.
struct ElementChange {
  Index element = kNoIndex;
  double before = 0.0, after = 0.0;  // of the metric that is optimised
  bool inverted_before = false, inverted_after = false;
};

/// How a visit ends.
enum class VisitEnd {
  Moved,         // the vertex gains
  NothingFound,  // no candidate is better than where it stands
  NotConfirmed,  // the search found one, but judged exactly it gains nothing
  Deviates,      // it found one on a surface, where faces would leave the input by more than the bound
  Leans,         // likewise, where faces would lean over the input by more than 60 degrees
  Fixed,         // it may not move, and was not searched
  Waits          // its star is sound, and this iteration moves no such vertex: see Untangling::repair
};

/// What came of a visit, wherever its candidates lie.
struct VisitSummary {
  Index vertex = kNoIndex;
  Metric metric = Metric::MeanRatio;
  bool fast = false;         // searched in float by the fast search; else in double by the plain one
  bool combined = false;     // for two aims: values beyond a threshold are the threshold plus the second aim
  bool by_corners = false;   // volume elements are judged corner by corner: `before` and `after` count the corners that the vertex changes
  bool untangling = false;   // an element was inverted, so that came first, see UntanglingObjective
  std::string value_phrase;  // what LevelValues::values are: "mean ratio", "squared sine of the smallest angle", ...
  double value_here = 0.0;   // likewise, of the place where it stood: what a candidate had to exceed
  double value_at_start = 0.0;  // likewise, of where the first grid is centred: the same place but in a tangled star
  Vec3 from, to;                // where it stood and stands after the visit; the same unless it moved
  StarState before, after;
  std::vector<ElementChange> elements;  // in the star's order
  VisitEnd end = VisitEnd::NothingFound;
  int halvings = 0;  // of the way to what was found, since all of it would invert an element inside: see confirmed_move()
  /// "moved: worst element of its star 0.31 -> 0.82", "no candidate is better than where it stands", ...
  [[nodiscard]] std::string sentence() const;
  /// Whose quality StarState::quality is.
  [[nodiscard]] const char* worst_phrase() const { return by_corners ? "worst corner" : "worst element"; }
};

template <class Offset>
struct VisitTraceIn : VisitSummary {
  Offset step;                                // mesh units
  Offset start{};                             // where the first grid is centred, relative to `from`: of a tangled star, see MeanOfCorners
  Offset found;                               // what the search chose, relative to `from`; mesh units
  std::vector<TracedLevelIn<Offset>> levels;  // empty for a fixed vertex
};
using VisitTrace = VisitTraceIn<Vec2<double>>;  // in the mesh's plane
using VolumeTrace = VisitTraceIn<Vec3>;         // in a volume

/// What DMO with these parameters does to `vertex` while the mesh's vertices are at `positions`. Runs the smoother's own templates with a
/// trace, so `to` has the bits that the smoother would store. Costs as much as the star is large, whatever the mesh.
/// `fixed`: one per vertex, as Run::fixed. Throws UsageError for a mesh that is not planar, a vertex that does not exist, parameters out of
/// range, or a metric that is not defined for its star. `aims`: of a visit that has two, see composite_objective_of_visit; then its first
/// is `metric`. `untangling`: of the iteration, as Run::sweep() has it. `guard`: of a visit by one metric, see Run::guard(); where the
/// winner breaks it, what is told is the search that knows of it.
[[nodiscard]] VisitTrace trace_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed, Metric metric,
                                     const SearchParameters& parameters, Index vertex,
                                     const std::optional<CompositeObjective>& composite = {}, const Untangling& untangling = {},
                                     const std::optional<Guard>& guard = {});

/// The same for a volume mesh. The fast search compares ranks in float and reports only which candidate it chose in each level. The values
/// here are the metric in double, so among nearly equal candidates the chosen one need not be the first of the largest.
[[nodiscard]] VolumeTrace trace_volume_visit(const InputMesh& input, PositionView positions, std::span<const std::uint8_t> fixed,
                                             Metric metric, const SearchParameters& parameters, Index vertex,
                                             const std::optional<CompositeObjective>& composite = {}, const Untangling& untangling = {},
                                             const std::optional<Guard>& guard = {});

}  // namespace dmoscope
