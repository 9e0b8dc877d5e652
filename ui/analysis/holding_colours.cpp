#include "ui/analysis/holding_colours.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/inspect/joint_hold.h"

namespace dmoscope::ui {

std::vector<Index> elements_of(const JointCluster& cluster, const InputMesh& input) {
  std::vector<Index> elements;
  for (const Index v : cluster.vertices)
    for (const Incidence& incidence : input.topology.star(v)) elements.push_back(incidence.element);
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

void colour_by_multiplier(const ColourRequest& request, ElementColours& colours, render::Shading& shading) {
  colours.title = colours.common_title = "multiplier";
  shading.values.assign(request.frame->element_count(), std::numeric_limits<float>::quiet_NaN());
  if (!request.hold) {
    colours.note = "what holds the minimum is not known yet (the command held-by finds out)";
    colours.has_values = false;
    return;
  }
  const std::vector<Index> cluster = elements_of(*request.hold, *request.frame->input);
  for (const Index e : cluster) shading.values[e] = 0.0F;
  double most = 0.0;
  for (const JointCluster::Active& one : request.hold->active) {
    shading.values[one.element] = static_cast<float>(one.multiplier);
    most = std::max(most, one.multiplier);
  }
  const std::size_t outside = shading.values.size() - cluster.size();
  if (outside > 0) colours.beside.push_back({"outside of the cluster", render::kUndefinedColour, outside});
  colours.range = {0.0, most > 0.0 ? most : 1.0};
  colours.title = fmt::format("multiplier: {} elements hold one another", holders(*request.hold).size());
}

}  // namespace dmoscope::ui
