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

/// What was done on a device; shared by its queues.
struct Counters {
  std::atomic<std::uint64_t> bytes_to_host{0};  // of positions and element values, counted by the code that downloads them
  std::atomic<std::uint64_t> bytes_allocated{0};
};

/// As many visits as would leave seven eighths of a device's lanes idle are done by teams of eight. Measured (tests/gpu/RESULTS.md).
inline constexpr std::size_t kTeamShare = 8;

/// For work that depends on no built-in metric.
inline constexpr Metric kNoMetric = Metric::MeanRatio;

/// Whose work a device takes up first, once it has room.
enum class Urgency { Last, First };

/// Work is done in the order in which it was asked for. For one thread at a time. Everything throws DeviceError, which may tell of earlier
/// work; a device that was lost stays so.
class Queue {
 public:
  Queue(const Queue&) = delete;
  Queue& operator=(const Queue&) = delete;
  virtual ~Queue() = default;

  /// Memory of the device, aligned for any type; its content is undefined. The error says how much was asked for and how much is free.
  [[nodiscard]] virtual void* allocate(std::size_t bytes) = 0;
  virtual void release(void* memory) noexcept = 0;

  /// Host to device; `from` may be changed on return. `pool`, if any, copies within the host's memory where that is needed.
  virtual void upload(void* to, const void* from, std::size_t bytes, ThreadPool* pool) = 0;
  /// Device to host, after all work so far; done on return.
  virtual void download(void* to, const void* from, std::size_t bytes, ThreadPool* pool) = 0;
  /// Memory of the host that the device writes directly.
  [[nodiscard]] virtual void* allocate_on_host(std::size_t bytes) = 0;
  virtual void release_on_host(void* memory) noexcept = 0;
  /// Device to such memory; done after wait(). `bytes`: a few.
  virtual void fetch(void* to, const void* from, std::size_t bytes) = 0;
  /// Sets every byte to zero.
  virtual void clear(void* memory, std::size_t bytes) = 0;
  /// Runs the body of `work` for lanes (or teams) 0 to count - 1. Metric: for the kinds of work that depend on one that is built in.
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
    std::shared_ptr<const CompiledSearch> search;  // null: it cannot be
    std::string how;                               // by what it was compiled, or why not
  };
  /// Compiles such a source as formula_source() makes.
  [[nodiscard]] virtual Compiled compile(const std::string& /*source*/) { return {nullptr, "there is no compiler for it"}; }
  /// Runs it for `count` teams. It must be there until that is done.
  virtual void launch_search(const CompiledSearch& /*search*/, const StarSearchTask& /*task*/, std::size_t /*count*/) {}

  /// What `one` and `other` ask for, only launches, does not depend on each other: it may be done at once, by lanes that either leaves
  /// idle. What is asked for afterwards begins after both.
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
  /// Until all work is done.
  virtual void wait() = 0;

  /// Launches, clears and fetches that are kept, to be asked for again in one go.
  class Recording {
   public:
    Recording() = default;
    Recording(const Recording&) = delete;
    Recording& operator=(const Recording&) = delete;
    virtual ~Recording() = default;
  };
  /// What `ask` asks for, only launches, clears and fetches, is kept and not done.
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

  /// Another queue of the same device, for another thread; work of the two is done in any order.
  [[nodiscard]] virtual std::shared_ptr<Queue> sibling(Urgency urgency) const = 0;
  /// A point in a queue's work that another queue of the device can wait for.
  class Mark {
   public:
    Mark() = default;
    Mark(const Mark&) = delete;
    Mark& operator=(const Mark&) = delete;
    virtual ~Mark() = default;
  };
  /// After all work so far.
  [[nodiscard]] virtual std::unique_ptr<Mark> mark() = 0;
  /// Work that is asked for from now on begins after what stands before the mark.
  virtual void wait_for(const Mark& mark) = 0;

  /// See DevicePicture::make_target().
  [[nodiscard]] virtual std::unique_ptr<DeviceTarget> make_target(std::uint32_t point_buffer, std::uint32_t shade_buffer) = 0;
  /// Fills the target with a picture's points and shades: Work::Project and Work::CopyShades, with task.points and task.drawn_shades in
  /// OpenGL's buffers.
  virtual void draw(DeviceTarget& target, const Task& task) = 0;

  /// How many lanes work at once: fewer vertices are better visited by teams.
  [[nodiscard]] virtual std::size_t lanes_at_once() const noexcept = 0;
  /// "NVIDIA H200, compute capability 9.0, 139.8 GiB".
  [[nodiscard]] virtual std::string description() const = 0;
  [[nodiscard]] Counters& counters() const noexcept { return *counters_; }

 protected:
  virtual void start_recording() = 0;
  [[nodiscard]] virtual std::unique_ptr<Recording> stop_recording() = 0;
  virtual void drop_recording() noexcept = 0;
  /// See both(). Where they do nothing, all is done in the order in which it was asked for.
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
  /// At most size() objects, to the beginning.
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

/// One object that a device brings to the host without a copy in between.
template <class T>
class Fetched {
 public:
  explicit Fetched(std::shared_ptr<Queue> queue) : queue_(std::move(queue)), value_(new (queue_->allocate_on_host(sizeof(T))) T{}) {}
  ~Fetched() { queue_->release_on_host(value_); }
  Fetched(const Fetched&) = delete;
  Fetched& operator=(const Fetched&) = delete;
  void fetch(const T* from) const { queue_->fetch(value_, from, sizeof(T)); }
  /// After Queue::wait().
  [[nodiscard]] const T& value() const noexcept { return *value_; }

 private:
  std::shared_ptr<Queue> queue_;
  T* value_;
};

}  // namespace dmoscope::gpu
