#include "core/session/session_commands.h"

#include <charconv>

#include <fmt/format.h>

#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "core/session/csv.h"

namespace dmoscope {

namespace {

using Arguments = CommandTable::Arguments;

void require(Arguments arguments, std::size_t least, std::size_t most) {
  if (arguments.size() < least) throw WrongArguments("too few arguments");
  if (arguments.size() > most) throw WrongArguments(fmt::format("'{}' is one argument too many", arguments[most]));
}

void tell(CommandContext& context, std::string text, Message::Kind kind = Message::Kind::Info) { context.say({kind, std::move(text), 0}); }

void tell_report(CommandContext& context) {
  const InputMesh& input = *context.session.input();
  tell(context, fmt::format("{}: {} vertices, {} elements", input.mesh.name, input.mesh.vertex_count(), input.mesh.elements.size()));
  for (std::string& sentence : input.report.sentences()) tell(context, std::move(sentence), Message::Kind::Warning);
}

/// What the runs have to tell of their backends.
void tell_warnings(CommandContext& context) {
  for (std::size_t i = 0; i < context.session.run_count(); ++i)
    if (std::string warning = context.session.run(i).take_warning(); !warning.empty())
      tell(context, std::move(warning), Message::Kind::Warning);
}

// Meshes and files

void open(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.open(std::filesystem::path(arguments[0]), context.progress);
  tell_report(context);
}

void generate(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 3);
  const std::size_t size = arguments.size() > 1 ? to_count(arguments[1]) : 0;
  const std::uint64_t seed = arguments.size() > 2 ? to_count(arguments[2]) : 1;
  context.session.open(generate_mesh(arguments[0], size, seed, context.progress), context.progress);
  tell_report(context);
}

void export_mesh(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Run& run = context.session.active();
  for (std::string& note : write_mesh(arguments[0], run.input().mesh, run.positions(), context.progress))
    tell(context, std::move(note), Message::Kind::Warning);
  tell(context, fmt::format("wrote {}", arguments[0]));
}

void write_stats(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  std::vector<std::string> titles;
  std::vector<const std::vector<IterationRecord>*> records;
  (void)context.session.active();
  for (std::size_t i = 0; i < context.session.run_count(); ++i) {
    const RunParameters& parameters = context.session.run(i).parameters();
    titles.push_back(fmt::format("{}:{}", parameters.method, info(parameters.metric).name));
    records.push_back(&context.session.run(i).history().records());
  }
  write_file_atomically(arguments[0], stats_csv(titles, records));
  tell(context, fmt::format("wrote {}", arguments[0]));
}

void write_elements(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Run& run = context.session.active();
  std::vector<Metric> metrics;
  for (const MetricInfo& entry : metric_table()) metrics.push_back(entry.metric);
  write_file_atomically(arguments[0], elements_csv(run.input().quality_context(), run.positions(), metrics));
  tell(context, fmt::format("wrote {}", arguments[0]));
}

// Parameters

/// Changes the active run's parameters; says so when that made a new run beside the old one.
template <class Edit>
void change(CommandContext& context, Edit edit) {
  RunParameters parameters = context.session.active().parameters();
  edit(parameters);
  const std::size_t before = context.session.run_count();
  const std::size_t index = context.session.change(std::move(parameters));
  if (context.session.run_count() > before)
    tell(context, fmt::format("run {}: {}, from the input; the run before is kept", index + 1, context.session.active().title()));
}

int to_int(const std::string& word) {
  const std::uint64_t value = to_count(word);
  if (value > 1000000) throw WrongArguments(fmt::format("'{}' is too large", word));
  return static_cast<int>(value);
}

void set_metric(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Metric metric = parse_metric(arguments[0]);
  const bool follows = context.session.shown() == context.session.active().parameters().metric;
  change(context, [&](RunParameters& p) { p.metric = metric; });
  if (follows) context.session.show(metric);  // what is shown follows what is optimised until it was chosen apart
}
void show_metric(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.show(parse_metric(arguments[0]));
}
void set_method(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change(context, [&](RunParameters& p) { p.method = arguments[0]; });
}
void set_grid(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change(context, [&](RunParameters& p) { p.search.grid_points = to_int(arguments[0]); });
}
void set_levels(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change(context, [&](RunParameters& p) { p.search.levels = to_int(arguments[0]); });
}
void set_omega(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change(context, [&](RunParameters& p) { p.search.omega = to_number(arguments[0]); });
}
void set_precision(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Precision precision = parse_precision(arguments[0]);
  change(context, [&](RunParameters& p) { p.search.precision = precision; });
}
void set_backend(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Backend backend = parse_backend(arguments[0]);
  change(context, [&](RunParameters& p) { p.backend = backend; });
  tell(context, context.session.active().backend_sentence());
}
void set_order(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const VisitOrder order = parse_order(arguments[0]);
  change(context, [&](RunParameters& p) { p.order = order; });
}
void fix(CommandContext& context, Arguments arguments) {
  require(arguments, 1, arguments.size());
  change(context, [&](RunParameters& p) {
    for (const std::string& word : arguments) {
      const std::uint64_t vertex = to_count(word);
      if (vertex >= context.session.input()->mesh.vertex_count()) throw UsageError(fmt::format("there is no vertex {}", word));
      p.fixed.push_back(static_cast<Index>(vertex));
    }
  });
}
void unfix(CommandContext& context, Arguments arguments) {
  require(arguments, 0, 0);
  change(context, [&](RunParameters& p) { p.fixed.clear(); });
}

// Stepping

StepUnit to_unit(const std::string& word) {
  if (word == "vertex") return StepUnit::Vertex;
  if (word == "class") return StepUnit::Class;
  if (word == "iteration") return StepUnit::Iteration;
  throw WrongArguments(fmt::format("'{}' is no unit of stepping", word));
}

void step(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 2);
  const StepUnit unit = to_unit(arguments[0]);
  const std::uint64_t count = arguments.size() > 1 ? to_count(arguments[1]) : 1;
  for (std::uint64_t i = 0; i < count; ++i) context.session.active().step(unit, context.progress);
}
void back(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 2);
  const StepUnit unit = to_unit(arguments[0]);
  const std::uint64_t count = arguments.size() > 1 ? to_count(arguments[1]) : 1;
  for (std::uint64_t i = 0; i < count && context.session.active().back(unit, context.progress); ++i) {
  }
}
void run(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.active().iterate(to_count(arguments[0]), context.progress);
}
void until_converged(CommandContext& context, Arguments arguments) {
  require(arguments, 0, 2);
  ConvergenceLimits limits;
  if (!arguments.empty()) limits.patience = to_count(arguments[0], 1);
  if (arguments.size() > 1) limits.max_iterations = to_count(arguments[1], 1);
  tell(context, context.session.active().until_converged(limits, context.progress).sentence());
}
void seek(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 2);
  const std::uint64_t visits = arguments.size() > 1 ? to_count(arguments[1]) : 0;
  const std::uint64_t most = context.session.active().visits_per_iteration();
  if (visits > most) throw UsageError(fmt::format("an iteration has {} visits, not {}", most, visits));
  context.session.active().seek({to_count(arguments[0]), visits}, context.progress);
}
void reset(CommandContext& context, Arguments arguments) {
  require(arguments, 0, 0);
  context.session.active().seek({}, context.progress);
}

// Runs and the session

void add_run(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  RunParameters parameters = context.session.active().parameters();
  const std::size_t colon = arguments[0].find(':');
  parameters.method = arguments[0].substr(0, colon);
  if (colon != std::string::npos) parameters.metric = parse_metric(arguments[0].substr(colon + 1));
  context.session.add_run(std::move(parameters));
}
void select_run(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.select(to_count(arguments[0], 1) - 1);
}
void remove_run(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.remove_run(to_count(arguments[0], 1) - 1);
}
void set_threads(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const std::uint64_t threads = to_count(arguments[0]);
  if (threads > 1024) throw UsageError(fmt::format("threads must be 0 (all) to 1024, not {}", threads));
  context.session.set_threads(static_cast<unsigned>(threads));
}
void set_history(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.set_history_budget(to_count(arguments[0]) << 20U);
}

double quantity(Run& run, const std::string& name) {
  if (name == "iteration") return static_cast<double>(run.moment().iteration);
  if (name == "moved") return static_cast<double>(run.history().records().at(run.moment().iteration).moved);
  const Statistics statistics = run.statistics();
  if (name == "minimum") return statistics.minimum;
  if (name == "movable") return statistics.movable_minimum;
  if (name == "mean") return statistics.mean;
  if (name == "inverted") return statistics.inverted;
  throw WrongArguments(fmt::format("'{}' is nothing that can be expected", name));
}

void expect(CommandContext& context, Arguments arguments) {
  require(arguments, 3, 3);
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
    throw WrongArguments(fmt::format("'{}' is no comparison", relation));
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

struct Verb {
  CommandInfo info;
  void (*handler)(CommandContext&, Arguments);
};

const std::vector<Verb>& verbs() {
  static const std::vector<Verb> table{
      {{"open", "open FILE", "Opens a mesh and starts a run on it."}, open},
      {{"generate", "generate KIND [SIZE [SEED]]", "Makes a sample mesh and starts a run on it."}, generate},
      {{"export", "export FILE", "Writes the active run's mesh; the extension chooses the format."}, export_mesh},
      {{"stats", "stats FILE.csv", "Writes the statistics of every iteration of every run."}, write_stats},
      {{"elements", "elements FILE.csv", "Writes every element's quality by every metric."}, write_elements},
      {{"metric", "metric NAME", "Chooses the metric that is optimised."}, set_metric},
      {{"show", "show NAME", "Chooses the metric that is shown."}, show_metric},
      {{"method", "method NAME", "Chooses the smoothing method."}, set_method},
      {{"grid", "grid N", "Candidates an axis of the grid, 2 to 64 (the paper: 8)."}, set_grid},
      {{"levels", "levels N", "Levels of the grid a visit, 1 to 16 (the paper: 3)."}, set_levels},
      {{"omega", "omega X", "Size of the first grid over the star's bounding box, up to 2 (the paper: 0.5)."}, set_omega},
      {{"precision", "precision float|double", "The scalar the search computes with; moves are always confirmed in double."},
       set_precision},
      {{"backend", "backend auto|cpu|cuda", "What smooths: the CPU, a CUDA device, or the best there is."}, set_backend},
      {{"order", "order natural|shuffle:SEED", "The order in which vertices are coloured and visited."}, set_order},
      {{"fix", "fix VERTEX...", "Fixes vertices besides the boundary."}, fix},
      {{"unfix", "unfix", "Frees all that was fixed by hand."}, unfix},
      {{"step", "step vertex|class|iteration [COUNT]", "Steps forwards."}, step},
      {{"back", "back vertex|class|iteration [COUNT]", "Steps back."}, back},
      {{"run", "run ITERATIONS", "Runs that many iterations."}, run},
      {{"until-converged", "until-converged [PATIENCE [MAX]]", "Runs until nothing moves or no minimum rises any more."}, until_converged},
      {{"seek", "seek ITERATION [VISITS]", "Goes to any iteration, and so many visits further."}, seek},
      {{"reset", "reset", "Goes back to the input."}, reset},
      {{"add-run", "add-run METHOD[:METRIC]", "Adds a run beside the others."}, add_run},
      {{"select-run", "select-run K", "Makes run K (from 1) the active one."}, select_run},
      {{"remove-run", "remove-run K", "Removes run K."}, remove_run},
      {{"threads", "threads N", "Threads to smooth with; 0: all."}, set_threads},
      {{"history", "history MIB", "Memory for positions of past iterations, all runs together."}, set_history},
      {{"expect", "expect minimum|movable|mean|inverted|iteration|moved <|<=|==|>=|> VALUE", "Fails when it does not hold."}, expect},
      {{"say", "say TEXT", "Writes a line to the log."}, say},
  };
  return table;
}

}  // namespace

VisitOrder parse_order(std::string_view word) {
  constexpr std::string_view prefix = "shuffle:";
  if (word == "natural") return {};
  if (word.starts_with(prefix)) return {to_count(std::string(word.substr(prefix.size())))};
  throw WrongArguments(fmt::format("'{}' is no order: natural or shuffle:SEED", word));
}

Precision parse_precision(std::string_view word) {
  if (word == "float") return Precision::Float;
  if (word == "double") return Precision::Double;
  throw WrongArguments(fmt::format("'{}' is no precision: float or double", word));
}

const std::vector<CommandInfo>& session_commands() {
  static const std::vector<CommandInfo> infos = [] {
    std::vector<CommandInfo> list;
    for (const Verb& verb : verbs()) list.push_back(verb.info);
    return list;
  }();
  return infos;
}

void add_session_commands(CommandTable& table, CommandContext& context) {
  for (const Verb& verb : verbs())
    table.add(verb.info, [&context, handler = verb.handler](Arguments arguments) {
      handler(context, arguments);
      if (context.session.has_input()) context.session.active().settle();  // a device that fails later takes nothing of what was asked for
      tell_warnings(context);
    });
}

}  // namespace dmoscope
