#pragma once
// Arguments of the kernels, as plain data that is copied to the device with every launch.

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

/// A vertex whose visit the fast search left to the plain one.
struct Deferred {
  Index rank = 0;
  bool has_target = false;  // false: to be searched again in double; true: only to be judged at `target`
  double target[3] = {};
};

/// One addend of the statistics, of a quarter of a stretch of elements: see core/quality/tally.h, whose sums these are bit for bit.
struct Part {
  double sum = 0.0, minimum = 0.0, movable = 0.0, ceiling = 0.0;
  Index worst = kNoIndex, inverted = 0, defined = 0;
  Index none = 0;  // in the place of padding, which lanes could not pass on word by word
};

/// Arguments of a launch. All pointers are to memory of the device. Ranks: see StarTable.
struct Task {
  // Stars by ranks, for the fast search of planar meshes; mesh by vertices, for the plain search and for volumes (see volume_of()).
  const StarShape* shapes = nullptr;
  const Index* others = nullptr;
  PlanarView mesh;
  const Index* rank_of_vertex = nullptr;
  const Index* vertex_of_rank = nullptr;
  std::size_t vertex_count = 0, element_count = 0;

  Vec3* ranked = nullptr;         // positions by rank
  std::uint8_t* awake = nullptr;  // one per rank: whether its star has changed since it was last found at its best
  SearchFrame frame{};
  SearchParameters parameters;
  Untangling untangling{};
  PlainComposite aims{};  // second aim of visits with two; the first is the launch's metric

  // Deferred visits of a class: space for as many as the largest class has, and their number.
  Deferred* deferred = nullptr;
  std::uint32_t* deferred_count = nullptr;
  std::uint32_t* moved = nullptr;  // number of moves since it was last set to 0

  // Statistics: one value per element; kParts per stretch of kStretch elements, and behind them their totals; the result.
  double* quality = nullptr;                // NaN if the metric is not defined
  std::uint8_t* inverted = nullptr;         // 1 if a corner Jacobian is <= 0
  const std::uint8_t* immovable = nullptr;  // 1 if all corners are fixed
  Part* parts = nullptr;
  Statistics* statistics = nullptr;

  Vec3* positions = nullptr;  // by vertices: copied from and to the host, or a picture's

  // Picture. counts: one for each place of histogram_slot().
  float* shades = nullptr;
  std::uint32_t* counts = nullptr;
  Vec2<double> origin{};
  Vec2<float>* points = nullptr;  // relative to origin
  float* drawn_shades = nullptr;
  const Index* wanted = nullptr;
  Vec3* picked = nullptr;

  std::size_t first = 0;          // rank or index of lane 0 of a launch
  const Index* listed = nullptr;  // ranks to visit, one for each lane; null: those from `first` on

  DefinedTask defined;  // for visits by a formula or a target
};

/// The mesh as a volume mesh.
[[nodiscard]] DMOSCOPE_ANYWHERE VolumeView volume_of(const Task& task) {
  const PlanarView& mesh = task.mesh;
  return {mesh.star_offsets, mesh.incidences, mesh.corner_offsets, mesh.corners, mesh.reference_measure, {}};
}
/// The mesh in the form of the frame: Plane or Space.
template <class Frame>
[[nodiscard]] DMOSCOPE_ANYWHERE MeshView<Frame> mesh_in(const Task& task) {
  if constexpr (std::is_same_v<Frame, Plane>)
    return task.mesh;
  else
    return volume_of(task);
}
[[nodiscard]] DMOSCOPE_ANYWHERE PositionView positions_of(const Task& task) { return {task.ranked, task.rank_of_vertex}; }

}  // namespace dmoscope::gpu
