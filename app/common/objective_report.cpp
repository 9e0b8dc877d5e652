#include "app/common/objective_report.h"

#include <cmath>

#include "app/common/console.h"
#include "core/run/size_course.h"

namespace dmoscope::app {
namespace {

Json json_of(const CompositeTerms& combination, const Run& run) {
  Json object;
  object["first"] = info(run.parameters().metric).name;
  object["threshold"] = combination.threshold;
  if (const auto* metric = std::get_if<Metric>(&combination.second)) {
    object["second"] = info(*metric).name;
    return object;
  }
  object["second"] = "density";
  object["size_function"] = to_text(*combination.size());
  const auto [before, after] = size_course_of(run);
  object["size_correlation"] = {{"before", json_number(before.sizes)}, {"after", json_number(after.sizes)}};
  object["size_log_correlation"] = {{"before", json_number(before.logarithms)}, {"after", json_number(after.logarithms)}};
  return object;
}

}  // namespace

void add_composite(Json& object, const Run& run) {
  const RunParameters& p = run.parameters();
  object["combination"] = p.combination ? json_of(*p.combination, run) : Json(nullptr);
  object["then"] = p.then_joint || p.then_mean ? Json(then_words(p)) : Json(nullptr);
  const RunPhases phases = run.phases();
  const auto say = [&](const char* key, const std::optional<std::uint64_t>& iteration) {
    object[key] = iteration ? Json(*iteration) : Json(nullptr);
  };
  say("joint_since", phases.joint_since);
  say("joint_from", phases.joint_from);
  say("joint_over", phases.joint_over);
  say("mean_since", phases.mean_since);
  say("mean_from", phases.mean_from);
}

void print_composite(const Run& run) {
  if (!run.size_field()) return;
  const auto [before, after] = size_course_of(run);
  if (std::isnan(after.sizes)) return;  // every size is the same
  print("  {:<16} {:>10} -> {}    (correlation of local edge length and target size)\n", "size", brief(before.sizes), brief(after.sizes));
  print("  {:<16} {:>10} -> {}    (the same of their logarithms)\n", "log size", brief(before.logarithms), brief(after.logarithms));
}

}  // namespace dmoscope::app
