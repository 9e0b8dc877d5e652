#include "gpu/host_queue.h"

#include <cstring>
#include <functional>
#include <limits>
#include <unordered_map>

#include <fmt/format.h>

#include "core/base/error.h"
#include "gpu/bodies.h"
#include "gpu/composite_bodies.h"
#include "gpu/defined/bodies.h"
#include "gpu/defined/target_bodies.h"
#include "gpu/volume_bodies.h"

namespace dmoscope::gpu {

namespace {

constexpr std::size_t kGrain = 64;

template <class Body>
void run_lanes(const Task& task, std::size_t first, std::size_t last, std::size_t count) {
  for (std::size_t i = first; i < last; ++i) Body::run(task, i, count, Solo{});
}
using Lanes = void (*)(const Task& task, std::size_t first, std::size_t last, std::size_t count);

template <Metric M>
Lanes lanes_of(Work work) {
  switch (work) {
    case Work::VisitSmallFans:
      return run_lanes<bodies::Visit<M, Stars::SmallFans>>;
    case Work::VisitLargeFans:
      return run_lanes<bodies::Visit<M, Stars::LargeFans>>;
    case Work::VisitOthers:
      return run_lanes<bodies::Visit<M, Stars::Others>>;
    case Work::VisitInTeam:
      return run_lanes<bodies::Visit<M, Stars::All, true>>;
    case Work::VisitComposite:
      return run_lanes<bodies::VisitComposite<M, Plane>>;
    case Work::Settle:
      return run_lanes<bodies::Settle<M>>;
    case Work::Judge:
      return run_lanes<bodies::Judge<M, Plane>>;
    default:
      return nullptr;
  }
}

template <Metric M>
Lanes volume_lanes_of(Work work) {
  if (work == Work::VisitVolumeComposite) return run_lanes<bodies::VisitComposite<M, Space>>;
  return work == Work::VisitVolume ? run_lanes<bodies::VisitVolume<M>> : run_lanes<bodies::Judge<M, Space>>;
}

Lanes target_lanes_of(Work work, bool crossed) {
  if (work == Work::SearchTargets) return crossed ? run_lanes<bodies::SearchTargets<true>> : run_lanes<bodies::SearchTargets<false>>;
  return crossed ? run_lanes<bodies::VisitTargets<true>> : run_lanes<bodies::VisitTargets<false>>;
}

template <class Frame>
Lanes defined_lanes_of(Work work, bool in_double) {
  switch (work) {
    case Work::PrepareDefined:
      return run_lanes<bodies::PrepareDefined<Frame>>;
    case Work::SearchDefined:
      return in_double ? run_lanes<bodies::SearchDefined<Frame, double>> : run_lanes<bodies::SearchDefined<Frame, float>>;
    case Work::UntangleDefined:
      return run_lanes<bodies::UntangleDefined<Frame>>;
    case Work::SettleDefined:
      return run_lanes<bodies::SettleDefined<Frame>>;
    default:
      return run_lanes<bodies::JudgeDefined<Frame>>;
  }
}

Lanes plain_lanes_of(Work work) {
  switch (work) {
    case Work::Sum:
      return run_lanes<bodies::Sum>;
    case Work::Total:
      return run_lanes<bodies::Total>;
    case Work::Conclude:
      return run_lanes<bodies::Conclude>;
    case Work::Load:
      return run_lanes<bodies::Load>;
    case Work::Store:
      return run_lanes<bodies::Store>;
    case Work::Shade:
      return run_lanes<bodies::Shade>;
    case Work::Count:
      return run_lanes<bodies::Count>;
    case Work::Project:
      return run_lanes<bodies::Project>;
    case Work::CopyShades:
      return run_lanes<bodies::CopyShades>;
    case Work::Pick:
      return run_lanes<bodies::Pick>;
    default:
      return nullptr;
  }
}

Lanes lanes_of(Work work, Metric metric, const DefinedTask& defined) {
  if (is_by_targets(work)) return target_lanes_of(work, defined.crossed);
  if (is_by_defined(work))
    return defined.is_volume ? defined_lanes_of<Space>(work, defined.in_double) : defined_lanes_of<Plane>(work, defined.in_double);
  if (!is_by_metric(work)) return plain_lanes_of(work);
  if (is_of_solids(work)) return formulas::with_volume_metric(metric, [work]<Metric M>() { return volume_lanes_of<M>(work); });
  return formulas::with_planar_metric(metric, [work]<Metric M>() { return lanes_of<M>(work); });
}

class Recorded final : public Queue::Recording {
 public:
  std::vector<std::function<void()>> steps;
};

class Host final : public HostQueue, public std::enable_shared_from_this<Host> {
 public:
  explicit Host(const HostDevice& device) : device_(device) {}
  ~Host() override {
    for (const auto& [memory, bytes] : sizes_) ::operator delete(memory);
  }

  void* allocate(std::size_t bytes) override {
    check_lost();
    const std::size_t used = counters().bytes_allocated, free = device_.memory - used;
    if (bytes > free) throw DeviceError(fmt::format("the device is out of memory: {} bytes were asked for, {} are free", bytes, free));
    void* memory = ::operator new(bytes);
    std::memset(memory, 0xcd, bytes);  // makes reads of memory that nothing wrote conspicuous
    sizes_[memory] = bytes;
    counters().bytes_allocated += bytes;
    return memory;
  }
  void release(void* memory) noexcept override {
    const auto found = sizes_.find(memory);
    counters().bytes_allocated -= found->second;
    sizes_.erase(found);
    ::operator delete(memory);
  }
  void upload(void* to, const void* from, std::size_t bytes, ThreadPool* /*pool*/) override {
    check_lost();
    std::memcpy(to, from, bytes);
  }
  void download(void* to, const void* from, std::size_t bytes, ThreadPool* /*pool*/) override {
    check_lost();
    std::memcpy(to, from, bytes);
  }
  void* allocate_on_host(std::size_t bytes) override { return ::operator new(bytes); }
  void release_on_host(void* memory) noexcept override { ::operator delete(memory); }
  void fetch(void* to, const void* from, std::size_t bytes) override {
    enqueue([to, from, bytes] { std::memcpy(to, from, bytes); });
  }
  void clear(void* memory, std::size_t bytes) override {
    enqueue([memory, bytes] { std::memset(memory, 0, bytes); });
  }
  void launch(Work work, Metric metric, const Task& task, std::size_t count) override {
    const Lanes lanes = lanes_of(work, metric, task.defined);
    enqueue([this, lanes, task, count] {
      if (launches_left_ == 0) lost_ = true;
      check_lost();
      --launches_left_;
      for_chunks(device_.pool, count, kGrain, [&](std::size_t first, std::size_t last) { lanes(task, first, last, count); });
    });
  }
  void wait() override { check_lost(); }

  void replay(Recording& recording) override {
    for (const auto& step : static_cast<Recorded&>(recording).steps) step();
  }

  std::shared_ptr<Queue> sibling(Urgency /*urgency*/) const override { return std::const_pointer_cast<Host>(shared_from_this()); }
  std::unique_ptr<Mark> mark() override {
    check_lost();
    return std::make_unique<Mark>();
  }
  void wait_for(const Mark& /*mark*/) override { check_lost(); }
  std::unique_ptr<DeviceTarget> make_target(std::uint32_t /*point_buffer*/, std::uint32_t /*shade_buffer*/) override {
    throw DeviceError("the host in a device's place writes no OpenGL buffers");
  }
  void draw(DeviceTarget& /*target*/, const Task& /*task*/) override {}

  std::size_t lanes_at_once() const noexcept override { return device_.lanes_at_once; }
  std::string description() const override { return "the host in a device's place"; }
  void lose_after(std::size_t launches) override { launches_left_ = launches; }

 private:
  void start_recording() override { recording_ = std::make_unique<Recorded>(); }
  std::unique_ptr<Recording> stop_recording() override { return std::move(recording_); }
  void drop_recording() noexcept override { recording_.reset(); }
  void check_lost() const {
    if (lost_) throw DeviceError("the device was lost");
  }
  template <class Step>
  void enqueue(Step step) {
    if (recording_ != nullptr)
      recording_->steps.emplace_back(std::move(step));
    else
      step();
  }

  HostDevice device_;
  std::unordered_map<void*, std::size_t> sizes_;
  std::unique_ptr<Recorded> recording_;
  std::size_t launches_left_ = std::numeric_limits<std::size_t>::max();
  bool lost_ = false;
};

}  // namespace

std::shared_ptr<HostQueue> make_host_queue(const HostDevice& device) { return std::make_shared<Host>(device); }

}  // namespace dmoscope::gpu
