#include "gpu/device.h"

#include <gtest/gtest.h>

#include "gpu/cuda_error.h"

namespace dmoscope::gpu {
namespace {

TEST(Device, WithoutAnyThereIsAReason) {
  const Availability found = availability();
  if (!found.built) {
    EXPECT_EQ(found.reason, "built without a CUDA toolkit");
    EXPECT_TRUE(found.devices.empty());
  } else if (found.devices.empty()) {
    EXPECT_NE(found.reason.find("CUDA device"), std::string::npos) << found.reason;
  }
}

TEST(Device, AnErrorSaysWhereWhatAndWhy) {
  const bool built = availability().built;
  try {
    throw_cuda_error(2, "cudaMalloc(&memory, bytes)", "/home/someone/gpu/dmoscope/gpu/queue.cu", 17);
  } catch (const Error& error) {
    const std::string why = built ? "cudaErrorMemoryAllocation: out of memory" : "CUDA error 2";
    EXPECT_EQ(error.what(), "gpu/queue.cu:17: cudaMalloc(&memory, bytes): " + why);
    EXPECT_EQ(error.exit_code(), 3);
    const auto* typed = dynamic_cast<const CudaError*>(&error);
    ASSERT_NE(typed, nullptr);
    EXPECT_EQ(typed->code(), 2);
  }
}

// Every device of the machine runs the kernels that were built, and computes as the processor does.
TEST(CudaDevice, ComputesAsTheProcessorDoes) {
  const Availability found = availability();
  if (found.devices.empty()) GTEST_SKIP() << "needs a CUDA device: " << found.reason;
  for (const Device& device : found.devices) EXPECT_EQ(device.problem, "") << device.name;
}

}  // namespace
}  // namespace dmoscope::gpu
