#include "gpu/cuda_launch.cuh"

namespace dmoscope::gpu {

namespace {

void launch_count(const Task& task, std::size_t count, cudaStream_t stream) {
  const std::size_t blocks = (count + kBlock * bodies::Count::kEach - 1) / (kBlock * bodies::Count::kEach);
  start(count_kernel<bodies::Count>, blocks, task, count, stream);
}

}  // namespace

Launcher plain_launcher(Work work) {
  switch (work) {
    case Work::Sum:
      return launch<bodies::Sum, Solo>;
    case Work::Total:
      return launch<bodies::Total, CudaTeam>;
    case Work::Conclude:
      return launch<bodies::Conclude, Solo>;
    case Work::Load:
      return launch<bodies::Load, Solo>;
    case Work::Store:
      return launch<bodies::Store, Solo>;
    case Work::Shade:
      return launch<bodies::Shade, Solo>;
    case Work::Count:
      return launch_count;
    case Work::Project:
      return launch<bodies::Project, Solo>;
    case Work::CopyShades:
      return launch<bodies::CopyShades, Solo>;
    case Work::Pick:
      return launch<bodies::Pick, Solo>;
    default:
      return nullptr;
  }
}

}  // namespace dmoscope::gpu
