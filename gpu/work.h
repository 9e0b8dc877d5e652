#pragma once
// The kinds of work that lanes do. Each is a kernel: a body (gpu/bodies.h) run for as many lanes as a launch asks for.

namespace dmoscope::gpu {

enum class Work {
  VisitFans,    // one vertex a lane: the fast search of rank first + i, where its star is one of Stars::Fans
  VisitOthers,  // the same, where it is not
  VisitInTeam,  // all stars, one vertex a team of lanes, settled at once: for classes too small to fill the device
  Settle,       // what the first two deferred, shared among all teams
  VisitVolume,  // of a volume, one vertex a team of lanes: rank first + i
  Judge,        // one element a lane: its quality and whether it is inverted
  JudgeVolume,  // the same of a volume
  Sum,          // one part of the statistics a lane
  Total,        // one sum of all parts a lane
  Conclude,     // one lane: the statistics
  Load,         // one vertex a lane: positions -> ranked, and awake
  Store,        // one vertex a lane: ranked -> positions
  Shade,        // one element a lane: what the renderer colours it by
  Count,        // one element a lane: the histogram
  Project,      // one vertex a lane: positions -> points in the plane
  CopyShades,   // one element a lane: shades -> drawn_shades
  Pick,         // one of some vertices a lane: positions -> picked
};

/// Of volumes, whose metrics are formulas::with_volume_metric()'s.
[[nodiscard]] constexpr bool is_of_solids(Work work) { return work == Work::VisitVolume || work == Work::JudgeVolume; }

}  // namespace dmoscope::gpu
