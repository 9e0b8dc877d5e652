#pragma once
// All that the kernels need to know, as plain data: it is copied to the device with every launch.

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "core/base/host_device.h"
#include "core/mesh/mesh_view.h"
#include "core/mesh/position_view.h"
#include "core/run/summary.h"
#include "core/search/parameters.h"
#include "core/search/untangling.h"
#include "core/smooth/composite_visit.h"
#include "core/smooth/kernels/search_frame.h"
#include "core/smooth/kernels/star_table.h"
#include "gpu/defined/defined_task.h"

namespace dmoscope::gpu {

/// A vertex whose visit the fast search left to the exact one.
struct Deferred {
  Index rank = 0;
  bool has_target = false;  // false: search it again, exactly; true: only judge whether it gains at `target`
  double target[3] = {};
};

/// What a quarter of a stretch of elements adds to the statistics: see core/quality/tally.h, whose sums these are bit for bit.
struct Part {
  double sum = 0.0, minimum = 0.0, movable = 0.0, ceiling = 0.0;
  Index worst = kNoIndex, inverted = 0, defined = 0;
  Index none = 0;  // where padding would be, which lanes could not pass on word by word
};

/// Every pointer is one of the device's. Ranks: see StarTable.
struct Task {
  // The stars by ranks, for the fast search of planar meshes; the mesh by vertices, for the exact one and for volumes (see volume_of()).
  const StarShape* shapes = nullptr;
  const Index* others = nullptr;
  PlanarView mesh;
  const Index* rank_of_vertex = nullptr;
  const Index* vertex_of_rank = nullptr;
  std::size_t vertex_count = 0, element_count = 0;

  Vec3* ranked = nullptr;         // the positions
  std::uint8_t* awake = nullptr;  // one per rank: has its star changed since it was last found at its best?
  SearchFrame frame{};
  SearchParameters parameters;
  Untangling untangling{};
  PlainComposite aims{};  // of visits with two; the first metric is the launch's

  // A class's deferred visits: space for as many as the largest class has, and how many there are.
  Deferred* deferred = nullptr;
  std::uint32_t* deferred_count = nullptr;
  std::uint32_t* moved = nullptr;  // of the vertices visited since it was last set to 0

  // Statistics: one per element; kParts per stretch of kStretch elements, and behind them their totals; the result.
  double* quality = nullptr;                // NaN where the metric is not defined
  std::uint8_t* inverted = nullptr;         // 1 where a corner Jacobian is <= 0
  const std::uint8_t* immovable = nullptr;  // 1 where all corners are fixed
  Part* parts = nullptr;
  Statistics* statistics = nullptr;

  Vec3* positions = nullptr;  // by vertices: what is copied from and to the host, or a picture's

  // For a picture. counts: one for each place of histogram_slot().
  float* shades = nullptr;
  std::uint32_t* counts = nullptr;
  Vec2<double> origin{};
  Vec2<float>* points = nullptr;  // less origin
  float* drawn_shades = nullptr;
  const Index* wanted = nullptr;
  Vec3* picked = nullptr;

  std::size_t first = 0;          // what a launch's lane 0 works on
  const Index* listed = nullptr;  // or what its lanes work on, one after the other: ranks to visit; null: those from `first` on

  DefinedTask defined;  // of visits by a formula or a target
};

/// The mesh of a volume.
[[nodiscard]] DMOSCOPE_ANYWHERE VolumeView volume_of(const Task& task) {
  const PlanarView& mesh = task.mesh;
  return {mesh.star_offsets, mesh.incidences, mesh.corner_offsets, mesh.corners, mesh.reference_measure, {}};
}
/// The mesh as the frame has it: Plane or Space.
template <class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE MeshView<Frame> mesh_in(const Task& task) {
  if constexpr (std::is_same_v<Frame, Plane>)
    return task.mesh;
  else
    return volume_of(task);
}
[[nodiscard]] DMOSCOPE_ANYWHERE PositionView positions_of(const Task& task) { return {task.ranked, task.rank_of_vertex}; }

}  // namespace dmoscope::gpu
