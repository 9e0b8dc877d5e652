#pragma once
// Trace of the visit of a vertex that slides on a surface: the grid in the tangent plane, and the surface beneath it.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/inspect/visit_trace.h"
#include "core/mesh/plane.h"
#include "core/smooth/smoother.h"

namespace dmoscope {

/// Fate of a candidate.
enum class CandidateFate : std::uint8_t {
  Counts,
  Feature,     // beyond a feature edge, or the end of the surface
  TurnedAway,  // the surface is too steep there, or turned away
  Deviates,    // compared, but with the vertex there faces would leave the input by more than the bound
  Leans        // compared, but faces would lean over the input by more than 60 degrees, or not lie over it at all
};
/// Phrase for a fate: "it lies beyond a feature edge"; empty for a candidate that counts.
[[nodiscard]] std::string_view phrase(CandidateFate fate) noexcept;

/// Places of a VisitTrace's candidates whose offsets are in the tangent plane.
struct SurfaceGrid {
  Plane plane;  // tangent plane at the vertex's place before the visit
  struct Level {
    std::vector<Vec3> places;  // places relative to the vertex's place before the visit: on the surface, or in the plane if the surface
                               // does not lie beneath
    std::vector<CandidateFate> fates;
  };
  std::vector<Level> levels;
};

struct SurfaceVisit {
  VisitTrace trace;  // candidates that are not on the surface have quality 0
  SurfaceGrid grid;
};

/// Traces what a smoother for `task` (whose colouring is not read) does to a vertex that slides on a surface. The search is shown on the
/// surface itself; on a curved mesh the smoother looks at the elements from above first, and may choose another of nearly equal candidates.
/// The end has the smoother's bits. `composite`: the objective of a visit with two aims. Throws UsageError for another vertex.
[[nodiscard]] SurfaceVisit trace_surface_visit(const SmoothingTask& task, std::span<const Vec3> positions, Index vertex, const Sweep& sweep,
                                               const std::optional<CompositeObjective>& composite = {});

}  // namespace dmoscope
