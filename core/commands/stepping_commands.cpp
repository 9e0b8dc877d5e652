// Commands about steps of the active run, forwards and backwards.

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/base/unknown_value.h"
#include "core/commands/command_rows.h"
#include "core/run/crossing_faces.h"
#include "core/run/ending.h"
#include "core/run/recipe.h"

namespace dmoscope {

namespace {

StepUnit to_unit(const std::string& word) {
  return parse_choice<StepUnit, WrongArguments>("unit", word, std::array<std::string_view, 3>{"vertex", "class", "iteration"});
}

void step(CommandContext& context, Arguments arguments) {
  const StepUnit unit = to_unit(arguments[0]);
  const std::uint64_t count = arguments.size() > 1 ? to_count(arguments[1]) : 1;
  for (std::uint64_t i = 0; i < count; ++i) context.session.active().step(unit, context.progress);
}
void back(CommandContext& context, Arguments arguments) {
  const StepUnit unit = to_unit(arguments[0]);
  const std::uint64_t count = arguments.size() > 1 ? to_count(arguments[1]) : 1;
  for (std::uint64_t i = 0; i < count && context.session.active().back(unit, context.progress); ++i) {
  }
}
/// Reports what the user should know of a run that has come to its end.
void tell_ending(CommandContext& context, const Run& run, const Outcome& outcome) {
  if (outcome.inverted > 0)
    if (const auto left = find_left_inverted(run)) tell(context, left->sentence(), Message::Kind::Warning);
  if (const auto crossing = find_crossing_faces(run)) tell(context, crossing->sentence(), Message::Kind::Warning);
  const std::string worse = worse_than_best(run.parameters(), outcome.best.value_or(best_iteration(run)), outcome.ended);
  if (!worse.empty()) tell(context, outcome.best ? worse : worse + " ('best' goes there)", Message::Kind::Warning);
}
void run(CommandContext& context, Arguments arguments) {
  Run& active = context.session.active();
  tell_ending(context, active, active.iterate(to_count(arguments[0]), context.progress));
}
void until_converged(CommandContext& context, Arguments arguments) {
  const bool to_best = !arguments.empty() && arguments[0] == "best";
  if (to_best) arguments = arguments.subspan(1);
  require(arguments, 0, 2);
  ConvergenceLimits limits;
  if (!arguments.empty()) limits.patience = to_count(arguments[0], 1);
  if (arguments.size() > 1) limits.max_iterations = to_count(arguments[1], 1);
  Run& active = context.session.active();
  (void)active.until_converged(limits, context.progress);
  if (to_best) active.end_at_best(context.progress);
  const Outcome outcome = *active.last_outcome();
  const auto& records = active.history().records();
  tell(context, outcome.sentence());
  tell(context, course_text(records, active.moment().iteration));
  tell_ending(context, active, outcome);
  const std::string fell = mean_given_up(active.parameters(), records, active.moment().iteration);
  if (!fell.empty()) tell(context, fell + " ('then mean')");
}
void raise_mean(CommandContext& context, Arguments arguments) {
  PhaseBegin phase;
  if (!arguments.empty()) phase.patience = to_count(arguments[0], 1);
  if (!context.session.active().parameters().then_mean) {
    change_run(context, [&](RunParameters& p) { p.then_mean = phase; });
    context.done.push_back(fmt::format("then mean {}", phase.patience));
  }
  std::vector<std::string> words{"best"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  until_converged(context, words);
}
void make_good(CommandContext& context, Arguments arguments) {
  RunParameters wanted = context.session.active().parameters();
  const Recipe& chosen = recipe(arguments.empty() ? recipe_table().front().name : arguments[0]);
  for (const std::string& sentence : follow_recipe(chosen, context.session.active().input(), wanted)) tell(context, sentence);
  const RunParameters before = context.session.active().parameters();
  if (wanted != before) {
    change_run(context, [&](RunParameters& p) { p = wanted; });
    if (before.combination) context.done.emplace_back("combine off");
    if (before.method != wanted.method) context.done.push_back("method " + wanted.method);
    context.done.push_back("then " + then_words(wanted));
    if (before.guard != wanted.guard) context.done.push_back("guard " + to_text(wanted.guard));
    if (before.joint_gap != wanted.joint_gap) context.done.push_back(fmt::format("joint-gap {}", wanted.joint_gap));
  }
  until_converged(context, std::array<std::string, 1>{"best"});
}
/// The row of a command that changes parameters by change_run(); null: it does not.
const CommandRow* row_that_changes(const std::string& name) {
  for (const std::span<const CommandRow> rows : {parameter_commands(), kind_commands(), objective_commands()})
    for (const CommandRow& row : rows)
      if (row.info.name == name && row.action.reach == CommandReach::Session) return &row;
  return nullptr;
}
void continue_with(CommandContext& context, Arguments arguments) {
  const CommandRow* row = row_that_changes(arguments[0]);
  if (row == nullptr) throw WrongArguments(fmt::format("'{}' changes no parameter of a run", arguments[0]));
  const Arguments words = arguments.subspan(1);
  require(words, row->action.least, row->action.most);
  context.continues = true;
  try {
    row->action.handler(context, words);
  } catch (...) {
    context.continues = false;
    throw;
  }
  context.continues = false;
}
void best(CommandContext& context, Arguments) {
  Run& active = context.session.active();
  const std::uint64_t iteration = best_iteration(active);
  active.seek({iteration}, context.progress);
  tell(context, iteration == 0 ? "the start is the best" : fmt::format("the best iteration is {}", iteration));
}
/// Those among `vertices` that may move; reports the others.
std::vector<Index> free_among(CommandContext& context, const Run& run, const std::vector<Index>& vertices) {
  constexpr std::size_t kNamed = 8;
  std::vector<Index> free, fixed;
  for (const Index vertex : vertices) (run.why_fixed(vertex).empty() ? free : fixed).push_back(vertex);
  if (fixed.empty()) return free;
  if (fixed.size() == 1 && free.empty())
    throw UsageError(fmt::format("vertex {} cannot be visited: {}", fixed[0], run.why_fixed(fixed[0])));
  const std::string named =
      fmt::format("{}{}", fmt::join(fixed.begin(), fixed.begin() + static_cast<std::ptrdiff_t>(std::min(fixed.size(), kNamed)), ", "),
                  fixed.size() > kNamed ? ", …" : "");
  if (free.empty()) throw UsageError(fmt::format("all {} vertices are fixed: {}", fixed.size(), named));
  tell(
      context,
      fmt::format("{} of {} vertices {} fixed and not visited: {}", fixed.size(), vertices.size(), fixed.size() == 1 ? "is" : "are", named),
      Message::Kind::Warning);
  return free;
}

void visit(CommandContext& context, Arguments arguments) {
  Run& run = context.session.active();
  const std::vector<Index> vertices = free_among(context, run, to_vertices(arguments, run.input().mesh));
  const std::uint64_t moved = run.visit_vertices(vertices, context.progress);
  tell(context, vertices.size() == 1 ? fmt::format("vertex {} {}", vertices[0], moved == 0 ? "stays: no candidate is better" : "moved")
                                     : fmt::format("{} of {} vertices moved", moved, vertices.size()));
}
void seek(CommandContext& context, Arguments arguments) {
  const auto part = [&](std::size_t i) { return arguments.size() > i ? to_count(arguments[i]) : 0; };
  context.session.active().seek({part(0), part(1), part(2)}, context.progress);
}
void reset(CommandContext& context, Arguments) {
  Run& active = context.session.active();
  const std::size_t edits = active.edits().all().size();
  active.reset(context.progress);
  if (edits > 0) tell(context, fmt::format("{} visit{} of chosen vertices forgotten", edits, edits == 1 ? "" : "s"));
}

}  // namespace

std::span<const CommandRow> stepping_commands() {
  constexpr auto kPaths = CommandReach::Paths;
  static const std::vector<CommandRow> table{
      {{"step", "step vertex|class|iteration [COUNT]", "Steps forwards."}, {1, 2, step, true, kPaths}},
      {{"back", "back vertex|class|iteration [COUNT]", "Steps back."}, {1, 2, back, true, kPaths}},
      {{"run", "run ITERATIONS", "Runs that many iterations."}, {1, 1, run, true, kPaths}},
      {{"until-converged", "until-converged [best] [PATIENCE [MAX]]",
        "Runs until nothing moves or no minimum rises any more; with best, goes back to the best iteration then."},
       {0, 3, until_converged, true, kPaths}},
      {{"raise-mean", "raise-mean [PATIENCE [MAX]]",
        "Then mean and until-converged in one: as a new run beside the active one, where that has moved without a second phase."},
       {0, 2, raise_mean}},
      {{"make-good", "make-good [RECIPE]",
        "Follows a recipe until it has converged: best (recommended), hex, minimum, mean or paper. As a new run beside the active one, "
        "where "
        "that has moved otherwise."},
       {0, 1, make_good}},
      {{"continue-with", "continue-with COMMAND...",
        "Changes parameters by their command (continue-with boundary slide) as a new run beside the active one, which goes on from the "
        "best "
        "state that this one reached: its minimum never falls."},
       {1, kAnyWords, continue_with}},
      {{"visit", "visit VERTEX|A-B...", "Visits these vertices now, out of their turn."}, {1, kAnyWords, visit, true, kPaths}},
      {{"seek", "seek ITERATION [VISITS [EDITS]]", "Goes to any iteration, or into its midst."}, {1, 3, seek, true, kPaths}},
      {{"look-at", "look-at ITERATION [VISITS [EDITS]]", "Goes there as seek does, but for a look: undo knows nothing of it."},
       {1, 3, seek, false, kPaths}},
      {{"best", "best", "Goes to the best iteration that the run passed through: by inverted elements, minimum and mean."},
       {0, 0, best, true, kPaths}},
      {{"reset", "reset", "Goes back to the input; visits of chosen vertices are forgotten."}, {0, 0, reset, true, kPaths}},
  };
  return table;
}

}  // namespace dmoscope
