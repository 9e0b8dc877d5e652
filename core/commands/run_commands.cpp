// Commands about the runs and the session, and commands for scripts.

#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/base/byte_size.h"
#include "core/base/thread_count.h"
#include "core/base/unknown_value.h"
#include "core/commands/command_rows.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

namespace {

void add_run(CommandContext& context, Arguments arguments) {
  context.session.add_run(run_like(context.session.active().parameters(), arguments[0]));
}
void select_run(CommandContext& context, Arguments arguments) { context.session.select(to_count(arguments[0], 1) - 1); }
void remove_run(CommandContext& context, Arguments arguments) { context.session.remove_run(to_count(arguments[0], 1) - 1); }
void rename_run(CommandContext& context, Arguments arguments) { context.session.rename_run(to_count(arguments[0], 1) - 1, arguments[1]); }
void set_threads(CommandContext& context, Arguments arguments) {
  const std::uint64_t threads = to_count(arguments[0]);
  require_thread_count(threads);
  context.session.set_threads(static_cast<unsigned>(threads));
}
void set_most_memory(CommandContext& context, Arguments arguments) {
  context.session.set_most_memory(arguments[0] == "off" ? 0 : parse_byte_size(arguments[0]));
}
void set_history(CommandContext& context, Arguments arguments) { context.session.set_history_budget(to_count(arguments[0]) << 20U); }

double quantity(Run& run, const std::string& name) {
  if (name == "iteration") return static_cast<double>(run.moment().iteration);
  if (name == "moved") return static_cast<double>(run.history().records().at(run.moment().iteration).moved);
  const Statistics statistics = run.statistics();
  if (name == "minimum") return statistics.minimum;
  if (name == "movable") return statistics.movable_minimum;
  if (name == "mean") return statistics.mean;
  if (name == "inverted") return statistics.inverted;
  constexpr std::array<std::string_view, 6> kQuantities{"iteration", "moved", "minimum", "movable", "mean", "inverted"};
  throw WrongArguments(unknown_value("quantity", name, kQuantities));
}

void expect(CommandContext& context, Arguments arguments) {
  const double value = quantity(context.session.active(), arguments[0]);
  const double bound = to_number(arguments[2]);
  const std::string& relation = arguments[1];
  bool holds = false;
  if (relation == "<")
    holds = value < bound;
  else if (relation == "<=")
    holds = value <= bound;
  else if (relation == "==")
    holds = value == bound;
  else if (relation == ">=")
    holds = value >= bound;
  else if (relation == ">")
    holds = value > bound;
  else
    throw WrongArguments(unknown_value("comparison", relation, std::array<std::string_view, 5>{"<", "<=", "==", ">=", ">"}));
  if (!holds) throw NotReached(fmt::format("expected {} {} {}, but it is {}", arguments[0], relation, arguments[2], value));
}

void say(CommandContext& context, Arguments arguments) {
  std::string text;
  for (const std::string& word : arguments) {
    if (!text.empty()) text += ' ';
    text += word;
  }
  tell(context, std::move(text));
}

/// Reports what holds the active run's minimum, and what would free it.
void tell_hold(CommandContext& context, Arguments) {
  Session& session = context.session;
  (void)session.active();
  const auto found = session.holds().find(session, session.active_index(), context.progress);
  tell(context, found ? found->sentence() : "no element has a quality by this metric");
}
void set_percentiles(CommandContext& context, Arguments arguments) {
  if (arguments[0] != "on" && arguments[0] != "off") throw WrongArguments(fmt::format("'{}' is neither on nor off", arguments[0]));
  context.session.set_percentiles(arguments[0] == "on");
}
void undo(CommandContext& context, Arguments) { tell(context, fmt::format("undid: {}", context.session.undo(context.progress))); }
void redo(CommandContext& context, Arguments) { tell(context, fmt::format("redid: {}", context.session.redo(context.progress))); }

}  // namespace

std::span<const CommandRow> run_commands() {
  static const std::vector<CommandRow> table{
      {{"add-run", "add-run METHOD[:METRIC]", "Adds a run beside the others."}, {1, 1, add_run}},
      {{"select-run", "select-run K", "Makes run K (from 1) the active one."}, {1, 1, select_run}},
      {{"remove-run", "remove-run K", "Removes run K."}, {1, 1, remove_run}},
      {{"rename-run", "rename-run K NAME", "Calls run K so in titles, legends and tables; \"\": by what it does again."},
       {2, 2, rename_run}},
      {{"undo", "undo", "Undoes the last command that changed mesh or runs."}, {0, 0, undo, false}},
      {{"redo", "redo", "Does again what was undone."}, {0, 0, redo, false}},
      {{"threads", "threads N", "Threads to smooth with; 0: all."}, {1, 1, set_threads}},
      {{"history", "history MIB", "Memory for positions of past iterations, all runs together."}, {1, 1, set_history}},
      {{"max-memory", "max-memory SIZE|off", "How much a compressed file may unpack to (800M, 2G); off: 256M or 100 times its size."},
       {1, 1, set_most_memory}},
      {{"geographic", "geographic on|off|auto",
        "Whether meshes that are opened from then on are in degrees, and judged on the Earth; auto: where their title or name says so."},
       {1, 1, [](CommandContext& context, Arguments words) { context.session.set_geographic(parse_geographic(words[0])); }}},
      {{"thin", "thin on|off|auto",
        "Whether meshes that are opened from then on are one cell thick, and taken for the 2-D mesh of their front; auto: where they are."},
       {1, 1, [](CommandContext& context, Arguments words) { context.session.set_thin(parse_thin(words[0])); }}},
      {{"percentiles", "percentiles on|off", "Works out the 1st, 5th and 50th percentile of every iteration that is kept."},
       {1, 1, set_percentiles, true, CommandReach::Look}},
      {{"held-by", "held-by", "Says what holds the minimum: why the worst element stays as it is, and which switch would free it."},
       {0, 0, tell_hold, false, CommandReach::Paths}},
      {{"expect", "expect minimum|movable|mean|inverted|iteration|moved <|<=|==|>=|> VALUE", "Fails when it does not hold."},
       {3, 3, expect, true, CommandReach::Paths}},
      {{"say", "say TEXT", "Writes a line to the log."}, {0, kAnyWords, say, true, CommandReach::Paths}},
  };
  return table;
}

}  // namespace dmoscope
