#pragma once
// Looks into the visit of a vertex that slides on a surface: the grid in the plane that touches it there, and what lies beneath.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/inspect/visit_trace.h"
#include "core/mesh/plane.h"
#include "core/smooth/smoother.h"

namespace dmoscope {

/// What becomes of a candidate.
enum class CandidateFate : std::uint8_t {
  Counts,
  Feature,     // beyond a feature edge, or the end of the surface
  TurnedAway,  // the surface is too steep there, or turned away
  Deviates,    // it is compared, but with the vertex there faces would leave the input by more than the bound
  Leans        // likewise, but faces would lean over the input by more than 60 degrees, or not lie over it at all
};
/// "it lies beyond a feature edge"; empty for one that counts.
[[nodiscard]] std::string_view phrase(CandidateFate fate) noexcept;

/// Where the candidates of a VisitTrace lie whose offsets are in the tangent plane.
struct SurfaceGrid {
  Plane plane;  // touches the surface where the vertex stood
  struct Level {
    std::vector<Vec3> places;  // relative to where the vertex stood: on the surface; of those that it does not lie beneath, in the plane
    std::vector<CandidateFate> fates;
  };
  std::vector<Level> levels;
};

struct SurfaceVisit {
  VisitTrace trace;  // candidates that lie on no surface have the quality 0
  SurfaceGrid grid;
};

/// What a smoother for `task` (whose colouring is not read) does to a vertex that slides on a surface. The search is shown on the surface
/// itself; of a curved mesh the smoother looks at the elements from above first, and may choose another of nearly equal candidates. The
/// end is the smoother's own, to the bits. `composite`: of a visit that has two aims. Throws UsageError for another vertex.
[[nodiscard]] SurfaceVisit trace_surface_visit(const SmoothingTask& task, std::span<const Vec3> positions, Index vertex, const Sweep& sweep,
                                               const std::optional<CompositeObjective>& composite = {});

}  // namespace dmoscope
