#pragma once
// What every smoothing method offers to a run.

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/base/thread_pool.h"
#include "core/quality/metric.h"
#include "core/search/parameters.h"
#include "core/session/input_mesh.h"

namespace dmoscope {

class Smoother {
 public:
  virtual ~Smoother() = default;
  /// Visits `vertices` (free, no two sharing an element, so that each sees the others' old and new positions alike) and moves those
  /// that gain. Returns how many moved. The result does not depend on the pool.
  virtual std::uint64_t visit(std::span<const Index> vertices, std::span<Vec3> positions, ThreadPool* pool) = 0;
};

struct MethodInfo {
  std::string_view name, doc;
};
/// The methods this version has.
[[nodiscard]] std::span<const MethodInfo> method_table();

/// Makes the smoother for a method. Throws UsageError for an unknown method (listing the known ones), for parameters out of range or for
/// a metric that is not defined for the mesh.
[[nodiscard]] std::unique_ptr<Smoother> make_smoother(std::string_view method, std::shared_ptr<const InputMesh> input, Metric metric,
                                                      const SearchParameters& parameters);

}  // namespace dmoscope
