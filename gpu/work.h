#pragma once
// The kinds of work that lanes do. Each is a kernel: a body (gpu/bodies.h) that runs in as many lanes as a launch asks for.

namespace dmoscope::gpu {

enum class Work {
  VisitSmallFans,        // one vertex per lane: the fast search of rank listed[i] or first + i, if its star is one of Stars::SmallFans
  VisitLargeFans,        // one vertex per lane: the fast search, if its star is one of Stars::LargeFans
  VisitOthers,           // one vertex per lane: the fast search, if its star is one of Stars::Others
  VisitInTeam,           // all stars, one vertex per team of lanes, settled at once: for classes too small to fill the device
  Settle,                // visits that the first three deferred, shared among all teams
  VisitVolume,           // one vertex of a volume mesh per team of lanes: rank first + i
  VisitComposite,        // one vertex of a planar mesh per team, with two aims
  VisitVolumeComposite,  // one vertex of a volume mesh per team, with two aims
  // Work by a metric that is defined by a formula or a target, on a stretch of visits, of which each lane or team has some (see
  // gpu/defined/bodies.h):
  VisitTargets,        // one vertex per lane: planar stars by the mean ratio against targets
  VisitTargetsInTeam,  // one vertex per team: planar stars by the mean ratio against targets
  SearchTargets,       // one vertex per team: stars of tetrahedra by the mean ratio against targets
  PrepareDefined,      // one vertex per lane: the state and numbers of its star
  SearchDefined,       // one vertex per warp: sound stars
  UntangleDefined,     // one vertex per team: tangled stars
  SettleDefined,       // one vertex per lane: whether it gains
  JudgeDefined,        // one element per lane: its quality and whether it is inverted
  Judge,               // one element per lane: its quality and whether it is inverted
  JudgeVolume,         // one element of a volume mesh per lane: its quality and whether it is inverted
  Sum,                 // one part of the statistics per lane
  Total,               // one sum of all parts per team of lanes
  Conclude,            // one lane: the statistics
  Load,                // one vertex per lane: positions -> ranked, and awake
  Store,               // one vertex per lane: ranked -> positions
  Shade,               // one element per lane: the value that the renderer colours it by
  Count,               // one element per lane: the histogram
  Project,             // one vertex per lane: positions -> points in the plane
  CopyShades,          // one element per lane: shades -> drawn_shades
  Pick,                // one of some vertices per lane: positions -> picked
};

/// Whether work is on volumes, whose metrics are those of formulas::with_volume_metric().
[[nodiscard]] constexpr bool is_of_solids(Work work) {
  return work == Work::VisitVolume || work == Work::VisitVolumeComposite || work == Work::JudgeVolume;
}

/// Whether work is by a metric that is defined by a formula or a target.
[[nodiscard]] constexpr bool is_by_defined(Work work) { return work >= Work::VisitTargets && work <= Work::JudgeDefined; }
/// Whether work is by the mean ratio against targets, which is a defined metric.
[[nodiscard]] constexpr bool is_by_targets(Work work) { return work >= Work::VisitTargets && work <= Work::SearchTargets; }
/// Whether work is by a built-in metric.
[[nodiscard]] constexpr bool is_by_metric(Work work) {
  return work < Work::VisitTargets || work == Work::Judge || work == Work::JudgeVolume;
}

}  // namespace dmoscope::gpu
