#pragma once
// The kinds of work that lanes do. Each is a kernel: a body (gpu/bodies.h) run for as many lanes as a launch asks for.

namespace dmoscope::gpu {

enum class Work {
  VisitSmallFans,        // one vertex per lane: the fast search of rank listed[i] or first + i, where its star is one of Stars::SmallFans
  VisitLargeFans,        // the same, Stars::LargeFans
  VisitOthers,           // the same, Stars::Others
  VisitInTeam,           // all stars, one vertex per team of lanes, settled at once: for classes too small to fill the device
  Settle,                // what the first three deferred, shared among all teams
  VisitVolume,           // of a volume, one vertex per team of lanes: rank first + i
  VisitComposite,        // the same with two aims, of a planar mesh
  VisitVolumeComposite,  // and of a volume
  // By a metric that is defined by a formula or a target, for a stretch of visits, of which each lane or team has some (see
  // gpu/defined/bodies.h):
  VisitTargets,        // one vertex per lane: planar stars by the mean ratio against targets
  VisitTargetsInTeam,  // the same, one vertex per team
  SearchTargets,       // one vertex per team: stars of tetrahedra by the same
  PrepareDefined,      // one vertex per lane: what its star is like
  SearchDefined,       // one vertex per warp: sound stars
  UntangleDefined,     // one vertex per team: tangled stars
  SettleDefined,       // one vertex per lane: whether it gains
  JudgeDefined,        // one element per lane: its quality and whether it is inverted
  Judge,               // one element per lane: its quality and whether it is inverted
  JudgeVolume,         // the same of a volume
  Sum,                 // one part of the statistics per lane
  Total,               // one sum of all parts per team of lanes
  Conclude,            // one lane: the statistics
  Load,                // one vertex per lane: positions -> ranked, and awake
  Store,               // one vertex per lane: ranked -> positions
  Shade,               // one element per lane: what the renderer colours it by
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
/// Whether it is by the mean ratio against targets, which is one of these.
[[nodiscard]] constexpr bool is_by_targets(Work work) { return work >= Work::VisitTargets && work <= Work::SearchTargets; }
/// Whether it is by a built-in metric.
[[nodiscard]] constexpr bool is_by_metric(Work work) {
  return work < Work::VisitTargets || work == Work::Judge || work == Work::JudgeVolume;
}

}  // namespace dmoscope::gpu
