#pragma once
// What every smoothing method offers to a run.

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

/// The iteration that visits belong to. Whatever a method does differently from one iteration to the next follows from this alone, so that
/// an iteration that is done again has the same bits.
struct Sweep {
  std::uint64_t iteration = 0;  // of the run; 0: from the input on
  /// Second phase: raise the mean quality of the stars, with this as their floor: the least quality of the elements that can move.
  std::optional<double> floor{};
  MeanKind mean = MeanKind::Harmonic;  // which one
  /// And the least of a combination's second metric, which that phase keeps as well.
  std::optional<double> second_floor{};
  /// While the mesh has inverted elements.
  Untangling untangling{};
  friend bool operator==(const Sweep&, const Sweep&) = default;
};

class Smoother {
 public:
  Smoother() = default;
  Smoother(const Smoother&) = delete;
  Smoother& operator=(const Smoother&) = delete;
  virtual ~Smoother() = default;
  /// To be called before the first visit of another iteration or phase.
  virtual void begin([[maybe_unused]] const Sweep& sweep) {}
  /// Visits the vertices [first, first + count) of the colouring's order, class after class, so that each sees the old or the new positions
  /// of its neighbours whatever the number of threads, and moves those that gain; returns how many moved. The stretch may begin and end
  /// within classes and span any number of them, up to the whole order. The result depends neither on the pool nor on how an
  /// iteration is cut into calls. `positions`: of the whole mesh, and the ones that the last call left, unless positions_replaced() was
  /// called in between; what moved may be missing from them until store(), and is where positions_on_device(). Throws DeviceError; the
  /// smoother is of no use any more then.
  virtual std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) = 0;
  /// How many vertices all visits so far have searched a better place for: not those that were passed over because nothing of their star
  /// has moved since they stayed. None where nobody counts.
  [[nodiscard]] virtual std::optional<std::uint64_t> searched() const noexcept { return std::nullopt; }
  /// Brings `positions` up to date with all visits so far. Throws DeviceError, with `positions` in any state.
  virtual void store(std::span<Vec3> positions, ThreadPool* pool) = 0;
  /// Forgets what was derived from the positions of the last visit, and what store() would bring.
  virtual void positions_replaced() = 0;

  /// Where these vertices stand after all visits so far. `positions`: those of the last visit(); `places`: one a vertex. For a process that
  /// has a share of a mesh (see MeshShare); throws std::logic_error where that is impossible.
  virtual void give(std::span<const Index> vertices, std::span<const Vec3> positions, std::span<Vec3> places) const;
  /// These vertices, none of which is visited here, stand there now: another process visited them. Where one has moved, the vertices that
  /// share an element with it are visited again. Likewise.
  virtual void take(std::span<const Index> vertices, std::span<const Vec3> places, std::span<Vec3> positions);

  /// Whether positions lie far from the host, on a device: store() and each call of visit() are dear then, so a run asks for neither more
  /// often than it must, and visit() never writes to `positions`.
  [[nodiscard]] virtual bool positions_on_device() const noexcept { return false; }
  /// How it works, where there is more to tell than the method's name and where it runs; else empty.
  [[nodiscard]] virtual std::string description() const { return {}; }
  /// Statistics of the metric that is optimised after all visits so far, found without bringing the positions to the host: the same bits as
  /// compute_statistics(). None where that is impossible, and before the first visit since the start or since positions_replaced(). Throws
  /// DeviceError.
  [[nodiscard]] virtual std::optional<Statistics> statistics() { return std::nullopt; }
  /// A snapshot of the positions as they are now, where they live on a device and `shown` can be judged there; null: nowhere but on the
  /// host. Throws DeviceError.
  [[nodiscard]] virtual std::shared_ptr<const DevicePicture> picture([[maybe_unused]] Metric shown) { return nullptr; }
};

}  // namespace dmoscope
