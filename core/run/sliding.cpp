#include "core/run/sliding.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/thin.h"
#include "core/reference/domain.h"

namespace dmoscope {

void slide_only(RunParameters& parameters, const InputMesh& input, std::span<const Index> vertices) {
  const auto boundary = input.topology.boundary();
  std::vector<bool> named(input.mesh.vertex_count(), false);
  bool any = false;
  for (const Index vertex : vertices) {
    const Index v = on_front(input.mesh, vertex);
    named[v] = true;
    any = any || boundary[v] != 0;
  }
  if (!any) throw UsageError("none of these vertices is on the boundary");
  parameters.boundary = BoundaryRule::Slide;
  std::vector<Index>& fixed = parameters.fixed;
  std::erase_if(fixed, [&](Index v) { return named[on_front(input.mesh, v)] && boundary[on_front(input.mesh, v)] != 0; });
  for (Index v = 0; v < input.mesh.vertex_count(); ++v)
    if (boundary[v] != 0 && !named[v]) fixed.push_back(v);
  std::ranges::sort(fixed);
  fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
}

namespace {

Index kept_by_hand(const Run& run) {
  const Domain& domain = *run.domain();
  const std::vector<Index>& fixed = run.parameters().fixed;
  std::vector<Index> kept;
  for (const Index v : fixed)
    if (domain.slides(on_front(run.input().mesh, v))) kept.push_back(on_front(run.input().mesh, v));
  std::ranges::sort(kept);
  return static_cast<Index>(std::unique(kept.begin(), kept.end()) - kept.begin());
}

}  // namespace

Index count_sliding(const Run& run) { return run.domain() ? run.domain()->count() - kept_by_hand(run) : 0; }

std::string sliding_sentence(const Run& run) {
  if (!run.domain()) return {};
  const Index kept = kept_by_hand(run);
  return run.domain()->sentence() +
         (kept == 0 ? ""
                    : fmt::format("; {} of these {} fixed by hand and {}", kept, kept == 1 ? "is" : "are", kept == 1 ? "stays" : "stay"));
}

}  // namespace dmoscope
