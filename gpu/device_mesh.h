#pragma once
// A mesh on a device, in the order of a run's visits, and its statistics there.

#include <vector>

#include "core/input/input_mesh.h"
#include "core/mesh/colouring.h"
#include "gpu/queue.h"
#include "gpu/task.h"

namespace dmoscope {
class ThreadPool;
}

namespace dmoscope::gpu {

class DeviceMesh {
 public:
  /// Copies the mesh to the device. `immovable`: see compute_statistics. Throws DeviceError, and UsageError in the cases of
  /// build_star_table().
  DeviceMesh(std::shared_ptr<Queue> queue, const InputMesh& input, const Colouring& colouring, std::span<const Index> immovable,
             ThreadPool* pool);

  /// The mesh as the kernels read it.
  [[nodiscard]] const Task& task() const noexcept { return task_; }
  [[nodiscard]] bool is_volume() const noexcept { return is_volume_; }
  /// The ranks of a class of a planar mesh by the kernel that visits them, for a metric of ratio form: Stars::SmallFans first, then
  /// Stars::LargeFans and Stars::Others. Fans of equal size stand together: a multiprocessor's lanes then do the same, and its cache has
  /// the code.
  struct ClassStars {
    const Index* ranks = nullptr;
    std::size_t small_fans = 0, large_fans = 0, others = 0;
  };
  [[nodiscard]] const ClassStars& stars_of_class(Index colour) const { return classes_[colour]; }
  /// Positions by vertices, to be copied from and to the host.
  [[nodiscard]] const Buffer<Vec3>& positions() const noexcept { return positions_; }

  /// Puts all vertices to sleep: none needs a visit.
  void put_to_sleep() const { awake_.clear(); }
  /// Finds every element's quality at the present positions, by a built-in metric, and the statistics.
  void judge(Metric metric);
  /// Finds the statistics of the qualities that were found last.
  void add_up();
  /// Statistics of the last add_up(), with the same bits as compute_statistics().
  [[nodiscard]] Statistics statistics() const;

 private:
  DeviceMesh(std::shared_ptr<Queue> queue, const InputMesh& input, const Colouring& colouring, const StarTable& table,
             std::span<const Index> immovable, ThreadPool* pool);
  void list_stars(const Colouring& colouring, const StarTable& table, ThreadPool* pool);

  std::shared_ptr<Queue> queue_;
  Buffer<StarShape> shapes_;
  Buffer<Index> others_;
  Buffer<std::uint32_t> star_offsets_;
  Buffer<Incidence> incidences_;
  Buffer<Index> corner_offsets_, corners_;
  Buffer<double> reference_measure_;
  Buffer<Index> rank_of_vertex_, vertex_of_rank_;
  Buffer<Vec3> positions_, ranked_;
  Buffer<std::uint8_t> awake_, inverted_, immovable_;
  Buffer<double> quality_;
  Buffer<Part> parts_;
  Buffer<Statistics> statistics_;
  Fetched<Statistics> fetched_;
  Task task_;
  bool is_volume_;
  std::vector<ClassStars> classes_;
  Buffer<Index> listed_;  // ranks of stars_of_class()
};

}  // namespace dmoscope::gpu
