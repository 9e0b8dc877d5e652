// Commands about all runs at once: steps of every run, and runs that differ in one respect.

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/base/unknown_value.h"
#include "core/commands/command_rows.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

constexpr std::uint64_t kMostOrders = 200;
constexpr std::uint64_t kUsualIterations = 20;  // iterations of runs to be compared, unless given

/// Calls `body` with each run and downloads its state afterwards, so that a later device failure loses nothing.
template <class Body>
void for_runs(CommandContext& context, const Body& body) {
  const std::size_t count = context.session.run_count();
  for (std::size_t k = 0; k < count; ++k) {
    const Progress::Part part(context.progress, k, count);
    body(context.session.run(k));
    context.session.run(k).sync_to_host();
  }
}

std::uint64_t count_or(Arguments arguments, std::size_t index, std::uint64_t otherwise) {
  return arguments.size() > index ? to_count(arguments[index]) : otherwise;
}

/// Iterates all runs in turn, so that all visibly make progress.
void iterate_each(CommandContext& context, std::uint64_t iterations) {
  for (std::uint64_t i = 0; i < iterations; ++i) {
    const Progress::Part part(context.progress, i, iterations);
    for_runs(context, [&](Run& run) { run.step(StepUnit::Iteration, context.progress); });
  }
}

void each(CommandContext& context, Arguments arguments) {
  (void)context.session.active();
  const std::string& what = arguments[0];
  const bool to_best = what == "until-converged" && arguments.size() > 1 && arguments[1] == "best";
  if (!to_best) require(arguments, 1, 3);
  if (what == "step" || what == "run") {
    require(arguments, what == "run" ? 2 : 1, 2);
    iterate_each(context, count_or(arguments, 1, 1));
  } else if (what == "back") {
    require(arguments, 1, 1);
    for_runs(context, [&](Run& run) { run.back(StepUnit::Iteration, context.progress); });
  } else if (what == "until-converged") {
    ConvergenceLimits limits;
    const Arguments numbers = arguments.subspan(to_best ? 2 : 1);
    if (!numbers.empty()) limits.patience = to_count(numbers[0], 1);
    if (numbers.size() > 1) limits.max_iterations = to_count(numbers[1], 1);
    for_runs(context, [&](Run& run) {
      (void)run.until_converged(limits, context.progress);
      if (to_best) run.end_at_best(context.progress);
      tell(context, fmt::format("{}: {}", run.title(), run.last_outcome()->sentence()));
    });
  } else if (what == "seek") {
    require(arguments, 2, 2);
    const std::uint64_t iteration = to_count(arguments[1]);
    for_runs(context, [&](Run& run) { run.seek({iteration}, context.progress); });
  } else if (what == "reset") {
    require(arguments, 1, 1);
    std::size_t k = 0;
    for_runs(context, [&](Run& run) {
      run.reset(context.progress);
      for (const std::string& line :
           {fmt::format("select-run {}", ++k), std::string("reset"), fmt::format("select-run {}", context.session.active_index() + 1)})
        context.done.push_back(line);
    });
  } else {
    constexpr std::array<std::string_view, 6> kSteps{"step", "run", "until-converged", "back", "seek", "reset"};
    throw WrongArguments(unknown_value("step of every run", what, kSteps));
  }
}

bool has_run(Session& session, const RunParameters& parameters) {
  for (std::size_t k = 0; k < session.run_count(); ++k)
    if (session.run(k).parameters() == parameters) return true;
  return false;
}

/// Adds those runs that the session does not have yet, all or none, and leaves the active run the active one. Runs that are impossible are
/// left out and reported, with the reason.
void add_missing(CommandContext& context, const std::vector<RunParameters>& wanted) {
  Session& session = context.session;
  const std::size_t active = session.active_index(), before = session.run_count();
  try {
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      context.progress.check();
      context.progress.set(static_cast<double>(i) / static_cast<double>(wanted.size()));
      if (has_run(session, wanted[i])) continue;
      try {
        session.add_run(wanted[i]);
      } catch (const UsageError& error) {
        tell(context, fmt::format("left out: {}", error.what()), Message::Kind::Warning);
      }
    }
  } catch (...) {
    while (session.run_count() > before) session.remove_run(session.run_count() - 1);
    session.select(active);
    throw;
  }
  session.select(active);
}

/// Takes every run that is behind to the end of an iteration, in turn.
void bring_to(CommandContext& context, std::uint64_t iteration) {
  std::uint64_t least = iteration;
  for (std::size_t k = 0; k < context.session.run_count(); ++k) least = std::min(least, context.session.run(k).moment().iteration);
  for (std::uint64_t i = least; i < iteration; ++i) {
    const Progress::Part part(context.progress, i - least, iteration - least);
    for_runs(context, [&](Run& run) {
      if (run.moment().iteration <= i) run.step(StepUnit::Iteration, context.progress);
    });
  }
}

/// Parameters of a run beside another one: another method goes alone, for phases after it would hide what it does.
RunParameters beside(RunParameters parameters, const RunParameters& active) {
  if (parameters.method == active.method) return parameters;
  parameters.then_joint.reset();
  parameters.then_mean.reset();
  if (!method_info(parameters.method).joint) parameters.joint_gap = RunParameters{}.joint_gap;
  return parameters;
}

std::vector<RunParameters> every_method(const RunParameters& like) {
  std::vector<RunParameters> wanted;
  for (const MethodInfo& method : method_table()) wanted.push_back(beside(run_like(like, std::string(method.name)), like));
  return wanted;
}

std::vector<RunParameters> every_metric(const RunParameters& like, const Mesh& mesh) {
  std::vector<RunParameters> wanted;
  for (const MetricInfo& metric : metric_table()) {
    const bool defined = std::ranges::all_of(mesh.elements.kinds(), [&](ElementKind kind) { return metric.defined_for(kind); });
    if (!defined) continue;
    wanted.push_back(like);
    wanted.back().metric = metric.metric;
  }
  return wanted;
}

std::vector<RunParameters> orders(const RunParameters& like, std::uint64_t count) {
  if (count > kMostOrders) throw UsageError(fmt::format("at most {} orders can be compared at once, not {}", kMostOrders, count));
  std::vector<RunParameters> wanted;
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    wanted.push_back(like);
    wanted.back().order.seed = seed;
  }
  return wanted;
}

void save_report(CommandContext& context, Arguments arguments) {
  (void)context.session.active();
  if (!context.report) throw UsageError("no reports are written here");
  context.session.require_not_read(arguments[0], "save-report");
  context.report(arguments[0]);
  tell(context, fmt::format("wrote {}", arguments[0]));
}

/// Runs like the active one that a comparison asks for. Throws WrongArguments.
std::vector<RunParameters> runs_wanted(const Run& active, Arguments words) {
  const RunParameters like = active.parameters();
  if (words[0] == "with") {
    if (words.size() < 2) throw WrongArguments("name the runs to compare with: METHOD[:METRIC]...");
    std::vector<RunParameters> wanted;
    for (const std::string& run : words.subspan(1)) wanted.push_back(beside(run_like(like, run), like));
    return wanted;
  }
  const bool of_orders = words[0] == "orders";
  require(words, of_orders ? 2 : 1, of_orders ? 2 : 1);
  if (of_orders) return orders(like, to_count(words[1], 1));
  if (words[0] == "methods") return every_method(like);
  if (words[0] == "metrics") return every_metric(like, active.input().mesh);
  throw WrongArguments(unknown_value("comparison", words[0], std::array<std::string_view, 4>{"methods", "metrics", "orders", "with"}));
}

/// Adds runs, and takes all to the same iteration, or until they converge: see the last word.
void compare(CommandContext& context, Arguments arguments) {
  const Run& active = context.session.active();
  const std::string& last = arguments.back();
  const bool to_end = last == "converged";
  const std::size_t least = arguments[0] == "orders" ? 2 : 1;  // words that say which runs
  const bool counted = !to_end && arguments.size() > least && last.find_first_not_of("0123456789") == std::string::npos;
  const Arguments words = arguments.first(arguments.size() - (to_end || counted ? 1 : 0));
  if (words.empty()) throw WrongArguments("name what to compare");
  const std::vector<RunParameters> wanted = runs_wanted(active, words);
  std::string added = "compare";
  for (const std::string& word : words) added.append(" ").append(quote_word(word));
  const std::uint64_t reached = active.moment().iteration;
  add_missing(context, wanted);
  context.done.push_back(added + " 0");
  if (!to_end) return bring_to(context, counted ? to_count(last) : reached > 0 ? reached : kUsualIterations);
  for_runs(context, [&](Run& run) {
    (void)run.until_converged({}, context.progress);
    run.end_at_best(context.progress);
    tell(context, fmt::format("{}: {}", run.title(), run.last_outcome()->sentence()));
  });
}

}  // namespace

std::span<const CommandRow> comparison_commands() {
  static const std::vector<CommandRow> table{
      {{"each", "each step|run|back|until-converged [best]|seek|reset [N [MAX]]", "Does that with every run, iterations by turns."},
       {1, 4, each, true, CommandReach::Paths}},
      {{"compare",
        "compare methods|metrics [ITERATIONS|converged] | compare orders N [ITERATIONS|converged] | compare with METHOD[:METRIC]... "
        "[ITERATIONS|converged]",
        "Adds runs like the active one by every method, for every metric, in N shuffled orders or as they are named, and takes all to the "
        "same iteration, or until they converge. Other methods go alone, without the active run's phases."},
       {1, kAnyWords, compare, true, CommandReach::Paths}},
      {{"save-report", "save-report FILE.html",
        "Writes how the runs on the active run's mesh compare, by the shown metric: a page with plots."},
       {1, 1, save_report, false}},
  };
  return table;
}

}  // namespace dmoscope
