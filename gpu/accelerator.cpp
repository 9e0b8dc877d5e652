#include "gpu/accelerator.h"

#include "core/base/error.h"
#include "gpu/cuda_queue.h"
#include "gpu/device.h"
#include "gpu/device_dmo.h"

namespace dmoscope::gpu {

namespace {

/// DMO on a CUDA device; every run has a queue of its own, since different threads may make and destroy runs.
class CudaAccelerator final : public Accelerator {
 public:
  explicit CudaAccelerator(int device) : device_(device), first_(make_cuda_queue(device)) {}
  int number() const noexcept override { return device_; }
  std::string description() const override { return first_->description(); }
  std::unique_ptr<Smoother> make_dmo(const SmoothingTask& task) const override {
    return make_device_dmo(first_->sibling(Urgency::Last), task);
  }

 private:
  int device_;
  std::shared_ptr<Queue> first_;
};

}  // namespace

Acceleration make_accelerator() {
  const Availability available = availability();
  if (!available.reason.empty()) return {nullptr, available.reason};
  try {
    return {std::make_shared<CudaAccelerator>(available.best), ""};
  } catch (const Error& error) {
    return {nullptr, error.what()};
  }
}

}  // namespace dmoscope::gpu
