#pragma once
// A device's memory and a queue of work on it.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <utility>

#include "core/base/thread_pool.h"
#include "core/quality/metric.h"
#include "core/run/device_picture.h"
#include "gpu/work.h"

namespace dmoscope::gpu {

struct StarSearchTask;
struct Task;

/// Counts of transfers and launches on a device; its queues share them.
struct Counters {
  std::atomic<std::uint64_t> bytes_to_host{0};  // positions and element values, counted by the code that downloads them
  std::atomic<std::uint64_t> bytes_allocated{0};
};

/// Visits that would leave seven eighths of a device's lanes idle are made by teams of eight. Measured (tests/gpu/RESULTS.md).
inline constexpr std::size_t kTeamShare = 8;

/// Metric to pass for work that depends on no built-in metric.
inline constexpr Metric kNoMetric = Metric::MeanRatio;

/// Priority of a queue: the device takes up the work of the first ones first, once it has room.
enum class Urgency { Last, First };

/// Queue of work, done in the order in which it was asked for. For one thread at a time. All functions throw DeviceError, possibly because
/// of earlier work; a device that was lost stays so.
class Queue {
 public:
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;
  virtual ~Queue() = default;

  /// Allocates memory of the device, aligned for any type; its content is undefined. The error tells how much was asked for and how much is
  /// free.
  [[nodiscard]] virtual void* allocate(std::size_t bytes) = 0;
  virtual void release(void* memory) noexcept = 0;

  /// Copies from host to device; `from` may be changed on return. `pool`, if any, copies within the host's memory if that is needed.
  virtual void upload(void* to, const void* from, std::size_t bytes, ThreadPool* pool) = 0;
  /// Copies from device to host, after all work so far; done on return.
  virtual void download(void* to, const void* from, std::size_t bytes, ThreadPool* pool) = 0;
  /// Allocates memory of the host that the device writes directly.
  [[nodiscard]] virtual void* allocate_on_host(std::size_t bytes) = 0;
  virtual void release_on_host(void* memory) noexcept = 0;
  /// Copies `bytes`, a few, from the device to memory of allocate_on_host(); done after wait().
  virtual void fetch(void* to, const void* from, std::size_t bytes) = 0;
  /// Sets every byte to zero.
  virtual void clear(void* memory, std::size_t bytes) = 0;
  /// Runs the body of `work` in lanes (or teams) 0 to count - 1. `metric`: the built-in one, for kinds of work that depend on it.
  virtual void launch(Work work, Metric metric, const Task& task, std::size_t count) = 0;

  /// A search of stars that was compiled for the device.
  class CompiledSearch {
   public:
    CompiledSearch() = default;
    CompiledSearch(const CompiledSearch&) = delete;
    CompiledSearch& operator=(const CompiledSearch&) = delete;
    virtual ~CompiledSearch() = default;
  };
  struct Compiled {
    std::shared_ptr<const CompiledSearch> search;  // null: not compiled
    std::string how;                               // the compiler, or the reason why there is no search
  };
  /// Compiles a source of formula_source().
  [[nodiscard]] virtual Compiled compile(const std::string& /*source*/) { return {nullptr, "there is no compiler for it"}; }
  /// Runs a compiled search for `count` teams. The search must exist until that is done.
  virtual void launch_search(const CompiledSearch& /*search*/, const StarSearchTask& /*task*/, std::size_t /*count*/) {}

  /// Launches the work of `one` and of `other`, which are independent and only launch: either may use the lanes that the other leaves idle.
  /// Work that is asked for afterwards begins after both.
  template <class One, class Other>
  void both(const One& one, const Other& other) {
    begin_side();
    try {
      other();
    } catch (...) {
      end_side();
      throw;
    }
    end_side();
    one();
    join_side();
  }
  /// Waits until all work is done.
  virtual void wait() = 0;

  /// Launches, clears and fetches that are kept, to be repeated in one call.
  class Recording {
   public:
    Recording() = default;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    virtual ~Recording() = default;
  };
  /// Records the work of `ask`, only launches, clears and fetches, without doing it.
  template <class Ask>
  [[nodiscard]] std::unique_ptr<Recording> record(const Ask& ask) {
    start_recording();
    try {
      ask();
    } catch (...) {
      drop_recording();
      throw;
    }
    return stop_recording();
  }
  virtual void replay(Recording& recording) = 0;

  /// Makes another queue of the same device, for another thread; the order between the two is undefined.
  [[nodiscard]] virtual std::shared_ptr<Queue> sibling(Urgency urgency) const = 0;
  /// A point in a queue's work that another queue of the device can wait for.
  class Mark {
   public:
    Mark() = default;
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;
    virtual ~Mark() = default;
  };
  /// Makes a mark after all work so far.
  [[nodiscard]] virtual std::unique_ptr<Mark> mark() = 0;
  /// Makes later work of this queue begin after the work before the mark.
  virtual void wait_for(const Mark& mark) = 0;

  /// Makes a target that OpenGL draws: see DevicePicture::make_target().
  [[nodiscard]] virtual std::unique_ptr<DeviceTarget> make_target(std::uint32_t point_buffer, std::uint32_t shade_buffer) = 0;
  /// Fills the target with a picture's points and shades: runs Work::Project and Work::CopyShades, with task.points and task.drawn_shades
  /// in OpenGL's buffers.
  virtual void draw(DeviceTarget& target, const Task& task) = 0;

  /// Number of lanes that work at once: fewer vertices are better visited by teams.
  [[nodiscard]] virtual std::size_t lanes_at_once() const noexcept = 0;
  /// Describes the device: "NVIDIA H200, compute capability 9.0, 139.8 GiB".
  [[nodiscard]] virtual std::string description() const = 0;
  [[nodiscard]] Counters& counters() const noexcept { return *counters_; }

 protected:
  virtual void start_recording() = 0;
  [[nodiscard]] virtual std::unique_ptr<Recording> stop_recording() = 0;
  virtual void drop_recording() noexcept = 0;
  /// Begins the second of two independent parts, see both(). By default all work is done in the order in which it was asked for.
  virtual void begin_side() {}
  virtual void end_side() noexcept {}
  virtual void join_side() {}
  explicit Queue(std::shared_ptr<Counters> counters = std::make_shared<Counters>()) : counters_(std::move(counters)) {}
  [[nodiscard]] const std::shared_ptr<Counters>& shared_counters() const noexcept { return counters_; }

 private:
  std::shared_ptr<Counters> counters_;
};

/// Memory of a device for `size` objects of a trivial type.
template <class T>
class Buffer {
 public:
  Buffer() = default;
  Buffer(std::shared_ptr<Queue> queue, std::size_t size)
      : queue_(std::move(queue)), data_(size == 0 ? nullptr : static_cast<T*>(queue_->allocate(size * sizeof(T)))), size_(size) {}
  Buffer(std::shared_ptr<Queue> queue, std::span<const T> content, ThreadPool* pool = nullptr) : Buffer(std::move(queue), content.size()) {
    upload(content, pool);
  }
  ~Buffer() {
    if (data_ != nullptr) queue_->release(data_);
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }

  [[nodiscard]] T* data() const noexcept { return data_; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// Copies at most size() objects to the beginning.
  void upload(std::span<const T> content, ThreadPool* pool = nullptr) const {
    if (!content.empty()) queue_->upload(data_, content.data(), content.size_bytes(), pool);
  }
  void download(std::span<T> content, ThreadPool* pool = nullptr) const {
    if (!content.empty()) queue_->download(content.data(), data_, content.size_bytes(), pool);
  }
  void clear() const {
    if (size_ > 0) queue_->clear(data_, size_ * sizeof(T));
  }

 private:
  void swap(Buffer& other) noexcept {
    std::swap(queue_, other.queue_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  std::shared_ptr<Queue> queue_;
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// One object that is copied from a device to the host without a copy in between.
template <class T>
class Fetched {
 public:
  explicit Fetched(std::shared_ptr<Queue> queue) : queue_(std::move(queue)), value_(new (queue_->allocate_on_host(sizeof(T))) T{}) {}
  ~Fetched() { queue_->release_on_host(value_); }
  Fetched(const Fetched&) = delete;
  Fetched& operator=(const Fetched&) = delete;
  void fetch(const T* from) const { queue_->fetch(value_, from, sizeof(T)); }
  /// The object; valid after Queue::wait().
  [[nodiscard]] const T& value() const noexcept { return *value_; }

 private:
  std::shared_ptr<Queue> queue_;
  T* value_;
};

}  // namespace dmoscope::gpu
