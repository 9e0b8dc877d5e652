#include "app/comparison/plan.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "core/base/error.h"
#include "core/quality/defined_metric.h"
#include "core/run/run_task.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope::app {

namespace {

/// Sets the aim after the comma of a SPEC, in place of that of --combine and --then.
void choose_aim(RunOptions& chosen, std::string aim) {
  aim.erase(0, aim.find_first_not_of(' '));
  constexpr std::string_view kThen = "then ";
  const std::string then = aim.starts_with(kThen) ? aim.substr(kThen.size()) : "nothing";
  if (aim != "alone" && then == "nothing")
    throw UsageError("after the comma stands 'alone', or 'then' and what --then takes, such as 'then mean'");
  if (!chosen.combine.empty()) chosen.metric = info(parse_composite(chosen.combine, chosen.size_function).first).name;
  chosen.combine.clear();
  chosen.size_function.clear();
  chosen.then = aim == "alone" ? "" : then;
}

/// Parts of METHOD[:METRIC[:BACKEND]][,AIM]; formulas and targets have colons and commas of their own.
struct SpecParts {
  std::string method, metric, backend;
  std::optional<std::string> aim;
};
SpecParts parts_of(const std::string& spec) {
  SpecParts parts;
  std::string rest = spec;
  const std::size_t colon = spec.find(':');
  const bool written = colon != std::string::npos && spec.compare(colon + 1, 8, "formula:") == 0;
  for (std::size_t comma = rest.find(','); comma != std::string::npos; comma = rest.find(',', comma + 1)) {
    const std::string aim = rest.substr(comma + 1);
    if (written && aim != "alone" && !aim.starts_with("then ")) continue;
    parts.aim = aim;
    rest.resize(comma);
    break;
  }
  parts.method = rest.substr(0, colon);
  if (colon == std::string::npos || colon >= rest.size()) return parts;
  parts.metric = rest.substr(colon + 1);
  for (const std::string_view backend : {":auto", ":cpu", ":cuda"})
    if (parts.metric.ends_with(backend)) {
      parts.backend = backend.substr(1);
      parts.metric.resize(parts.metric.size() - backend.size());
      break;
    }
  if (parts.metric.empty()) parts.method.clear();
  return parts;
}

/// Makes the run of a SPEC.
Contender parse_spec(const std::string& spec, const RunOptions& open) {
  const SpecParts parts = parts_of(spec);
  if (parts.method.empty()) throw UsageError(fmt::format("--run {}: expected METHOD, METHOD:METRIC or METHOD:METRIC:BACKEND", spec));
  RunOptions chosen = open;
  try {
    if (parts.aim) choose_aim(chosen, *parts.aim);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--run {}: {}", spec, error.what()));
  }
  chosen.method = parts.method;
  if (!parts.metric.empty()) chosen.metric = parts.metric;
  if (!parts.backend.empty()) chosen.parameters["backend"] = parts.backend;
  try {
    Contender contender{{}, parameters_of(chosen)};
    if (!parts.metric.empty() && contender.parameters.combination &&
        with_target(contender.parameters.metric, {}) != with_target(parse_metric(chosen.metric), {}))
      throw UsageError(fmt::format("the metric is {}, the first of --combine", info(contender.parameters.metric).name));
    contender.name = fmt::format("{}:{}", chosen.method, info(contender.parameters.metric).name);
    if (!parts.backend.empty()) contender.name += fmt::format(":{}", parts.backend);
    if (const auto& combination = contender.parameters.combination)
      contender.name = fmt::format("{}:{}", chosen.method, phrase(contender.parameters.metric, *combination));
    contender.name += then_text(contender.parameters);
    return contender;
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--run {}: {}", spec, error.what()));
  }
}

void add_every(ComparisonPlan& plan, const std::string& what, const RunOptions& open) {
  const auto add = [&](const std::string& spec) {
    Contender contender = parse_spec(spec, open);
    const auto known = std::ranges::find(plan.contenders, contender.name, &Contender::name);
    if (known != plan.contenders.end()) return;
    contender.by_every = true;
    plan.contenders.push_back(std::move(contender));
  };
  if (what == "method") {
    // Methods without combinations are in the comparison all the same.
    std::optional<CompositeTerms> combination;
    if (!open.combine.empty()) combination = parse_composite(open.combine, open.size_function).second;
    for (const MethodInfo& method : method_table())
      add(fmt::format("{}{}", method.name, combination && !can_combine(method, *combination) ? ",alone" : ""));
  } else if (what == "metric") {
    if (!open.combine.empty()) throw UsageError("--every metric: with --combine all runs have its metrics");
    for (const MetricInfo& metric : metric_table()) add(fmt::format("{}:{}", open.method, metric.name));
  } else {
    throw UsageError(fmt::format("--every {}: expected method or metric", what));
  }
}

/// The accelerator, looked for only if a run may use one.
Acceleration acceleration_of(const std::vector<Contender>& contenders) {
  const auto wants = [&](Backend backend) {
    return std::ranges::any_of(contenders, [&](const Contender& c) { return c.parameters.backend == backend; });
  };
  return acceleration_for(wants(Backend::Cuda) ? Backend::Cuda : wants(Backend::Auto) ? Backend::Auto : Backend::Cpu);
}

}  // namespace

ComparisonPlan plan_of(const CompareOptions& options) {
  ComparisonPlan plan;
  for (const std::string& spec : options.runs) {
    Contender contender = parse_spec(spec, options.run);
    const auto same = std::ranges::find(plan.contenders, contender.name, &Contender::name);
    if (same != plan.contenders.end()) throw UsageError(fmt::format("--run {}: {} is there already", spec, contender.name));
    plan.contenders.push_back(std::move(contender));
  }
  for (const std::string& what : options.every) add_every(plan, what, options.run);
  if (plan.contenders.empty())
    throw UsageError("nothing to compare: name runs with --run METHOD[:METRIC[:BACKEND]][,alone|,then mean], or --every method|metric");
  plan.judge = options.judge.empty() ? plan.contenders.front().parameters.metric : parse_metric(options.judge);
  plan.acceleration = acceleration_of(plan.contenders);
  return plan;
}

void fit_to_mesh(ComparisonPlan& plan, const std::shared_ptr<const InputMesh>& input, const Kinds& kinds) {
  require_defined(plan.judge, *input);
  std::vector<Contender> possible;
  for (Contender& contender : plan.contenders) {
    contender.parameters.kinds = kinds;
    std::string reason = why_no_run(input, contender.parameters, plan.acceleration);
    if (reason.empty()) {
      possible.push_back(std::move(contender));
    } else if (contender.by_every) {
      plan.left_out.push_back({std::move(contender.name), std::move(reason)});
    } else {
      throw UsageError(fmt::format("--run {}: {}", contender.name, reason));
    }
  }
  plan.contenders = std::move(possible);
  if (plan.contenders.empty()) throw UsageError(fmt::format("nothing is left to compare: {}", plan.left_out.front().reason));
}

}  // namespace dmoscope::app
