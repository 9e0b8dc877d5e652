#include "gpu/cuda_launch.cuh"

namespace dmoscope::gpu {

Launcher plain_launcher(Work work) {
  switch (work) {
    case Work::Sum:
      return launch<bodies::Sum, Solo>;
    case Work::Total:
      return launch<bodies::Total, Solo>;
    case Work::Conclude:
      return launch<bodies::Conclude, Solo>;
    case Work::Load:
      return launch<bodies::Load, Solo>;
    case Work::Store:
      return launch<bodies::Store, Solo>;
    case Work::Shade:
      return launch<bodies::Shade, Solo>;
    case Work::Count:
      return launch<bodies::Count, Solo>;
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
