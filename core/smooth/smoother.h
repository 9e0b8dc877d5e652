#pragma once
// Interface of every smoothing method to a run.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/quality/power_mean.h"
#include "core/quality/quality.h"
#include "core/search/untangling.h"
#include "core/smooth/task.h"

namespace dmoscope {

class DevicePicture;

/// Iteration that visits belong to. All that a method does differently from one iteration to the next follows from this alone, so that an
/// iteration that is done again has the same bits.
struct Sweep {
  std::uint64_t iteration = 0;  // number of the iteration in the run; 0: from the input on
  /// Floor of the mean phase, which raises the mean quality of the stars: the least quality of the elements that can move.
  std::optional<double> floor{};
  MeanKind mean = MeanKind::Harmonic;  // mean that is raised
  /// Floor for a combination's second metric, whose least that phase keeps as well.
  std::optional<double> second_floor{};
  /// Rule of untangling while the mesh has inverted elements.
  Untangling untangling{};
  friend bool operator==(const Sweep&, const Sweep&) = default;
};

class Smoother {
 public:
  Smoother() = default;
  Smoother(const Smoother&) = delete;
  Smoother& operator=(const Smoother&) = delete;
  virtual ~Smoother() = default;
  /// Must be called before the first visit of another iteration or phase.
  virtual void begin([[maybe_unused]] const Sweep& sweep) {}
  /// Visits the vertices [first, first + count) of the colouring's order, class after class, so that each sees the old or the new positions
  /// of its neighbours whatever the number of threads, and moves those that gain; returns how many moved. The stretch may begin and end
  /// within classes and span any number of them, up to the whole order. The result depends neither on the pool nor on how an iteration is
  /// cut into calls. `positions`: those of the whole mesh, as the last call left them, unless positions_replaced() was called in between;
  /// moves may be missing from them until store(), and are where positions_on_device(). Throws DeviceError; the smoother is of no use any
  /// more then.
  virtual std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) = 0;
  /// Number of vertices for which all visits so far have searched a better place: without those that were passed over because nothing of
  /// their star has moved since they stayed. None where they are not counted.
  [[nodiscard]] virtual std::optional<std::uint64_t> searched() const noexcept { return std::nullopt; }
  /// Brings `positions` up to date with all visits so far. Throws DeviceError, with `positions` in any state.
  virtual void store(std::span<Vec3> positions, ThreadPool* pool) = 0;
  /// Forgets all that was derived from the positions of the last visit, and moves not yet stored.
  virtual void positions_replaced() = 0;

  /// Fills `places` with the positions of these vertices after all visits so far. `positions`: those of the last visit(); `places`: one a
  /// vertex. For a process that has a share of a mesh (see MeshShare); throws std::logic_error where that is impossible.
  virtual void give(std::span<const Index> vertices, std::span<const Vec3> positions, std::span<Vec3> places) const;
  /// Moves these vertices, none of which is visited here, to the places to which another process moved them. Where one has moved, the
  /// vertices that share an element with it are visited again. For a process that has a share; throws like give().
  virtual void take(std::span<const Index> vertices, std::span<const Vec3> places, std::span<Vec3> positions);

  /// Returns whether positions lie far from the host, on a device: store() and each call of visit() are dear then, so a run asks for
  /// neither more often than it must, and visit() never writes to `positions`.
  [[nodiscard]] virtual bool positions_on_device() const noexcept { return false; }
  /// Description of its way of working, where there is more to tell than the method's name and the backend; else empty.
  [[nodiscard]] virtual std::string description() const { return {}; }
  /// Statistics of the optimised metric after all visits so far, found without bringing the positions to the host: the same bits as
  /// compute_statistics(). None where that is impossible, and before the first visit since the start or since positions_replaced(). Throws
  /// DeviceError.
  [[nodiscard]] virtual std::optional<Statistics> statistics() { return std::nullopt; }
  /// Snapshot of the present positions, where they live on a device and `shown` can be judged there; null: only on the host. Throws
  /// DeviceError.
  [[nodiscard]] virtual std::shared_ptr<const DevicePicture> picture([[maybe_unused]] Metric shown) { return nullptr; }
};

}  // namespace dmoscope
