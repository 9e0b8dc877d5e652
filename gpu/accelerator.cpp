#include "gpu/accelerator.h"

#include "gpu/device.h"

namespace dmoscope::gpu {

Acceleration make_accelerator() {
  const Availability available = availability();
  return {nullptr, available.reason.empty() ? "this version's cuda search is not built yet" : available.reason};
}

}  // namespace dmoscope::gpu
