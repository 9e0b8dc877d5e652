#pragma once
// Work that shall be done even if the device fails.

#include <string>

#include "core/base/error.h"
#include "core/run/run.h"

namespace dmoscope {

/// Returns work(). When a device fails that nobody asked for by name (Backend::Auto), reports it by tell(std::string) and does the work
/// once more: the run has recovered by then and is on the CPU. Throws what work() throws.
template <class Work, class Tell>
auto retry_on_cpu(const Run& run, const Work& work, const Tell& tell) {
  try {
    return work();
  } catch (const DeviceError& error) {
    if (run.parameters().backend != Backend::Auto) throw;
    tell(std::string(error.what()));
  }
  return work();
}

}  // namespace dmoscope
