#pragma once
// A simulated device: the CPU's smoother on positions of its own, which counts its calls and fails when told to.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/smooth/execution/accelerator.h"
#include "core/smooth/execution/method_table.h"
#include "tests/support/fake_picture.h"

namespace dmoscope::testing {

/// Calls of the device, and the numbers of calls that fail; 0: none.
struct FakeDevice {
  std::uint64_t visits = 0, stores = 0, statistics = 0;  // calls
  std::uint64_t fail_at_visit = 0, fail_at_store = 0;    // counted from 1; all calls after it fail too
  bool fail_to_make = false;
  bool has_statistics = true;
  std::chrono::milliseconds store_takes{0};
  std::function<void()> after_visit{};
  std::shared_ptr<FakePictureDevice> pictures{};  // for its pictures; none: it gives no pictures
};

class FakeSmoother final : public Smoother {
 public:
  FakeSmoother(std::shared_ptr<FakeDevice> device, std::unique_ptr<Smoother> cpu, std::shared_ptr<const InputMesh> input, Metric metric,
               std::span<const Index> immovable)
      : device_(std::move(device)),
        cpu_(std::move(cpu)),
        input_(std::move(input)),
        metric_(metric),
        immovable_(immovable.begin(), immovable.end()) {}

  void begin(const Sweep& sweep) override { cpu_->begin(sweep); }
  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    if (stale_) {
      on_device_.assign(positions.begin(), positions.end());
      cpu_->positions_replaced();
      stale_ = false;
    }
    if (++device_->visits >= device_->fail_at_visit && device_->fail_at_visit > 0) throw DeviceError("the fake device was lost");
    const std::uint64_t moved = cpu_->visit(first, count, on_device_, pool);
    if (device_->after_visit) device_->after_visit();
    return moved;
  }
  void store(std::span<Vec3> positions, ThreadPool* pool) override {
    if (stale_) return;
    ++device_->stores;
    if (device_->fail_at_store > 0 && device_->stores >= device_->fail_at_store) {
      std::ranges::fill(positions.first(positions.size() / 2), Vec3{});  // half done
      throw DeviceError("the fake device was lost while copying");
    }
    std::this_thread::sleep_for(device_->store_takes);
    cpu_->store(on_device_, pool);
    std::ranges::copy(on_device_, positions.begin());
  }
  void positions_replaced() override { stale_ = true; }
  [[nodiscard]] bool positions_on_device() const noexcept override { return true; }
  [[nodiscard]] std::shared_ptr<const DevicePicture> picture(Metric shown) override {
    if (stale_ || !device_->pictures) return nullptr;
    if (!device_->pictures->can_snapshot) throw DeviceError("no memory for a snapshot");
    cpu_->store(on_device_, nullptr);
    return std::make_shared<FakePicture>(device_->pictures, input_, on_device_, shown);
  }
  [[nodiscard]] std::optional<Statistics> statistics() override {
    if (stale_ || !device_->has_statistics) return std::nullopt;
    ++device_->statistics;
    cpu_->store(on_device_, nullptr);
    return compute_statistics(input_->quality_context(), on_device_, metric_, immovable_, nullptr);
  }

 private:
  std::shared_ptr<FakeDevice> device_;
  std::unique_ptr<Smoother> cpu_;
  std::shared_ptr<const InputMesh> input_;
  Metric metric_;
  std::vector<Index> immovable_;
  std::vector<Vec3> on_device_;
  bool stale_ = true;
};

class FakeAccelerator final : public Accelerator {
 public:
  explicit FakeAccelerator(std::shared_ptr<FakeDevice> device = std::make_shared<FakeDevice>()) : device_(std::move(device)) {}
  [[nodiscard]] std::string description() const override { return "Fake H1"; }
  [[nodiscard]] std::unique_ptr<Smoother> make_dmo(const SmoothingTask& task) const override {
    if (device_->fail_to_make) throw DeviceError("out of memory: 3 GiB asked for, 2 GiB free");
    return std::make_unique<FakeSmoother>(device_, make_smoother(task), task.input, task.metric, task.immovable);
  }

 private:
  std::shared_ptr<FakeDevice> device_;
};

/// The accelerator of a fake device, for a run or a session.
inline Acceleration acceleration(std::shared_ptr<FakeDevice> device) { return {std::make_shared<FakeAccelerator>(std::move(device)), {}}; }

}  // namespace dmoscope::testing
