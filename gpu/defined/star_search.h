#pragma once
// The grid search of one star by the programs of its elements. Plain data and code that need no header of a host's library, since a program
// that is compiled at run time includes it, too (see formula_source.h).

#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "core/base/host_device.h"
#include "core/base/vec.h"
#include "core/mesh/incidence.h"
#include "core/search/candidate_grid.h"
#include "core/search/team.h"

namespace dmoscope::gpu {

/// Progress of a visit.
enum class Stage : std::uint32_t {
  Waiting,  // nothing is known
  Sought,   // the star is sound and to be searched
  Tangled,  // the star has inverted elements and is to be searched for an offset that untangles it
  Found,    // the star was searched: see `offset`
  Over      // nothing is left to do
};

/// The star of a vertex under visit.
struct SoughtStar {
  double scale = 1.0;                  // in mesh units
  double box[3] = {}, offset[3] = {};  // in units of scale: bounding box of its other vertices; offset of its vertex
  double best = 0.0;                   // number of the star as it stands
  Index worst = 0;                     // the worst of its elements
  Stage stage = Stage::Waiting;
};

/// The programs for places of a moving corner are numbered by group of elements and by corner: group * kProgramsOfGroup + corner.
inline constexpr std::size_t kProgramsOfGroup = 17;

/// A stretch of visits, and the uniform numbers of their stars' programs. Ranks: see StarTable.
struct StarSearchTask {
  const Index* vertex_of_rank = nullptr;
  const std::uint32_t* star_offsets = nullptr;  // see Topology
  const Incidence* incidences = nullptr;
  const std::uint16_t* group_of_element = nullptr;
  const std::uint32_t* numbers_at = nullptr;  // by incidence: start of its program's uniform numbers
  void* numbers = nullptr;                    // uniform numbers of the stretch's stars: float or double
  SoughtStar* stars = nullptr;                // stars of the stretch, by rank
  std::size_t first_of_stretch = 0;           // first rank of the stretch
  std::size_t first = 0, visits = 0;          // the ranks that are visited now
  double omega = 0.0;
  int grid_points = 0, levels = 0;
  bool unit_matters = false;  // the programs are given mesh units

  [[nodiscard]] DMOSCOPE_ANYWHERE SoughtStar& star(std::size_t visit) const { return stars[first + visit - first_of_stretch]; }
};

/// Searches stars. Programs: run(program, uniforms, at, lane) returns the number of a program with its corner at a place, in any lane of
/// the launch.
template <class Real, class Point, class Programs, class Team>
class StarSearch {
 public:
  /// Makes the visits i, i + count, ..., each by a team: sets the offset where the star is best.
  static DMOSCOPE_INLINE DMOSCOPE_ANYWHERE void run(const StarSearchTask& task, const Programs& programs, std::size_t i, std::size_t count,
                                                    const Team& team) {
    for (std::size_t visit = i; visit < task.visits; visit += count) {
      SoughtStar& star = task.star(visit);
      if (star.stage != Stage::Sought) continue;
      const Point found = StarSearch(task, star, task.vertex_of_rank[task.first + visit], programs, i, team).find();
      if (team.lane() != 0) continue;
      put(found, star.offset);
      star.stage = Stage::Found;
    }
  }

 private:
  static constexpr bool kPlanar = std::is_same_v<Point, Vec2<Real>>;
  using Best = Candidate<Real, Point>;

  DMOSCOPE_ANYWHERE StarSearch(const StarSearchTask& task, const SoughtStar& star, Index vertex, const Programs& programs,
                               std::size_t number_of_team, const Team& team)
      : task_(task),
        star_(star),
        programs_(programs),
        team_(team),
        lane_(number_of_team * Team::kSize + team.lane()),
        first_(task.star_offsets[vertex]),
        size_(task.star_offsets[vertex + 1] - first_),
        unit_(task.unit_matters ? static_cast<Real>(star.scale) : Real(1)) {}

  [[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Point find() const {
    Best best{{}, static_cast<Real>(star_.best)};
    Point box{};
    get(star_.box, box);
    double omega = task_.omega;
    for (int level = 0; level < task_.levels; ++level) {
      const CandidateGrid<Real, Point> grid{best.offset, times(box, static_cast<Real>(omega)), task_.grid_points};
      const int candidates = grid.points * grid.points * (kPlanar ? 1 : grid.points);
      int index = -1;
      for (int c = static_cast<int>(team_.lane()); c < candidates; c += static_cast<int>(Team::kSize)) {
        const Point p = candidate(grid, c);
        const Real worth = least(p, best.objective);
        if (!(worth > best.objective)) continue;
        best = {p, worth};
        index = c;
      }
      if constexpr (Team::kSize > 1) best = best_of_team(team_, best, index);
      omega *= 2.0 / (task_.grid_points - 1);
    }
    return best.offset;
  }

  [[nodiscard]] static DMOSCOPE_ANYWHERE Point candidate(const CandidateGrid<Real, Point>& grid, int c) {
    const int n = grid.points;
    if constexpr (kPlanar)
      return grid.at(c / n, c % n);
    else
      return grid.at(c / (n * n), c / n % n, c % n);
  }

  /// Returns the least number of the star's elements, judging the worst one first, and stops once it is not above `best`.
  [[nodiscard]] DMOSCOPE_INLINE DMOSCOPE_ANYWHERE Real least(const Point& p, Real best) const {
    const Point at = times(p, unit_);
    Real least = std::numeric_limits<Real>::max();
    for (std::uint32_t n = 0; n < size_; ++n) {
      const std::uint32_t element = n == 0 ? star_.worst : n <= star_.worst ? n - 1 : n;
      const Incidence& incidence = task_.incidences[first_ + element];
      const std::size_t program = task_.group_of_element[incidence.element] * kProgramsOfGroup + incidence.corner;
      const Real* uniforms = static_cast<const Real*>(task_.numbers) + task_.numbers_at[first_ + element];
      const Real worth = programs_.run(program, uniforms, at, lane_);
      least = worth < least ? worth : least;
      if (!(least > best)) break;
    }
    return least;
  }

  static DMOSCOPE_ANYWHERE void put(const Vec2<Real>& p, double* to) { to[0] = static_cast<double>(p.x), to[1] = static_cast<double>(p.y); }
  static DMOSCOPE_ANYWHERE void put(const Vec3Of<Real>& p, double* to) {
    to[0] = static_cast<double>(p.x), to[1] = static_cast<double>(p.y), to[2] = static_cast<double>(p.z);
  }
  static DMOSCOPE_ANYWHERE void get(const double* from, Vec2<Real>& p) { p = {static_cast<Real>(from[0]), static_cast<Real>(from[1])}; }
  static DMOSCOPE_ANYWHERE void get(const double* from, Vec3Of<Real>& p) {
    p = {static_cast<Real>(from[0]), static_cast<Real>(from[1]), static_cast<Real>(from[2])};
  }

  const StarSearchTask& task_;
  const SoughtStar& star_;
  const Programs& programs_;
  const Team& team_;
  std::size_t lane_;
  std::uint32_t first_, size_;
  Real unit_;
};

}  // namespace dmoscope::gpu
