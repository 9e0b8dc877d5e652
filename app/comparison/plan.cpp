#include "app/comparison/plan.h"

#include <algorithm>

#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "core/base/error.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope::app {

namespace {

/// Takes what follows the comma of a SPEC: another aim than --combine and --then give every run.
void choose_aim(RunOptions& chosen, std::string aim) {
  aim.erase(0, aim.find_first_not_of(' '));
  constexpr std::string_view kThen = "then ";
  const std::string then = aim.starts_with(kThen) ? aim.substr(kThen.size()) : "nothing";
  if (aim != "alone" && then == "nothing")
    throw UsageError("after the comma stands 'alone', 'then mean', 'then joint' or 'then joint,mean'");
  if (!chosen.combine.empty()) chosen.metric = info(parse_combination(chosen.combine, chosen.size_function).first).name;
  chosen.combine.clear();
  chosen.size_function.clear();
  chosen.then = aim == "alone" ? "" : then;
}

/// The parameters of METHOD[:METRIC[:BACKEND]][,AIM].
Contender parse_spec(const std::string& spec, const RunOptions& open) {
  const std::size_t comma = spec.find(',');
  std::vector<std::string> words(1);
  for (const char c : spec.substr(0, comma)) {
    if (c == ':') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  if (words.size() > 3 || std::ranges::any_of(words, &std::string::empty)) {
    throw UsageError(fmt::format("--run {}: expected METHOD, METHOD:METRIC or METHOD:METRIC:BACKEND", spec));
  }
  RunOptions chosen = open;
  try {
    if (comma != std::string::npos) choose_aim(chosen, spec.substr(comma + 1));
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--run {}: {}", spec, error.what()));
  }
  chosen.method = words[0];
  if (words.size() > 1) chosen.metric = words[1];
  if (words.size() > 2) chosen.parameters["backend"] = words[2];
  try {
    Contender contender{{}, parameters_of(chosen)};
    if (words.size() > 1 && contender.parameters.metric != parse_metric(chosen.metric))
      throw UsageError(fmt::format("the metric is {}, the first of --combine", info(contender.parameters.metric).name));
    contender.name = fmt::format("{}:{}", chosen.method, info(contender.parameters.metric).name);
    if (words.size() > 2) contender.name += fmt::format(":{}", words[2]);
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
    // A combination is dmo's; the others are there to compare it with.
    for (const MethodInfo& method : method_table())
      add(fmt::format("{}{}", method.name, !open.combine.empty() && !method.combines ? ",alone" : ""));
  } else if (what == "metric") {
    if (!open.combine.empty()) throw UsageError("--every metric: with --combine all runs have its metrics");
    for (const MetricInfo& metric : metric_table()) add(fmt::format("{}:{}", open.method, metric.name));
  } else {
    throw UsageError(fmt::format("--every {}: expected method or metric", what));
  }
}

/// Looked for only where a run may use one.
Acceleration acceleration_of(const std::vector<Contender>& contenders) {
  const auto wants = [&](Backend backend) {
    return std::ranges::any_of(contenders, [&](const Contender& c) { return c.parameters.backend == backend; });
  };
  return acceleration_for(wants(Backend::Cuda) ? Backend::Cuda : wants(Backend::Auto) ? Backend::Auto : Backend::Cpu);
}

/// Why a run cannot be; empty when it can.
std::string obstacle(const Contender& contender, const std::shared_ptr<const InputMesh>& input, const Acceleration& acceleration) {
  const RunParameters& p = contender.parameters;
  try {
    require_executable(p.backend, acceleration,
                       {.method = p.method,
                        .input = input,
                        .metric = p.metric,
                        .search = p.search,
                        .options = p.options,
                        .combination = p.combination,
                        .then_joint = p.then_joint.has_value(),
                        .then_mean = p.then_mean.has_value()});
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
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

void fit_to_mesh(ComparisonPlan& plan, const std::shared_ptr<const InputMesh>& input, const std::vector<Index>& fixed, const Kinds& kinds) {
  require_defined(plan.judge, *input);
  std::vector<Contender> possible;
  for (Contender& contender : plan.contenders) {
    contender.parameters.fixed = fixed;
    contender.parameters.kinds = kinds;
    std::string reason = obstacle(contender, input, plan.acceleration);
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
