// The session's verbs: parameters of the active run, and the metric that is shown.

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/mesh/vertex_words.h"
#include "core/session/verbs.h"

namespace dmoscope {

namespace {

int to_int(const std::string& word) {
  const std::uint64_t value = to_count(word);
  if (value > 1000000) throw WrongArguments(fmt::format("'{}' is too large", word));
  return static_cast<int>(value);
}

void set_metric(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Metric metric = parse_metric(arguments[0]);
  const bool follows = context.session.shown() == context.session.active().parameters().metric;
  change_run(context, [&](RunParameters& p) { p.metric = metric; });
  if (follows) context.session.show(metric);  // what is shown follows what is optimised until it was chosen apart
}
void show_metric(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  context.session.show(parse_metric(arguments[0]));
}
void set_method(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const RunParameters& now = context.session.active().parameters();
  const bool drops = now.combination && method_info(arguments[0]).name != now.method;
  change_run(context, [&](RunParameters& p) {
    p.method = arguments[0];
    if (drops) p.combination.reset();  // which is a method's own
  });
  if (drops) tell(context, "the second aim is dmo's: this run has none");
}
void set_grid(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { p.search.grid_points = to_int(arguments[0]); });
}
void set_levels(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { p.search.levels = to_int(arguments[0]); });
}
void set_omega(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { p.search.omega = to_number(arguments[0]); });
}
void set_precision(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Precision precision = parse_precision(arguments[0]);
  change_run(context, [&](RunParameters& p) { p.search.precision = precision; });
}
void set_relaxation(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { p.options.relaxation = to_number(arguments[0]); });
}
void set_directions(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { p.options.directions = parse_directions(arguments[0]); });
}
void set_seed(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { p.options.seed = to_count(arguments[0]); });
}
void set_backend(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const Backend backend = parse_backend(arguments[0]);
  change_run(context, [&](RunParameters& p) { p.backend = backend; });
  tell(context, context.session.active().backend_sentence());
}
void set_order(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const VisitOrder order = parse_order(arguments[0]);
  change_run(context, [&](RunParameters& p) { p.order = order; });
}
void fix(CommandContext& context, Arguments arguments) {
  require(arguments, 1, arguments.size());
  const std::vector<Index> vertices = vertices_named(context.session.input()->mesh, arguments);
  change_run(context, [&](RunParameters& p) { p.fixed.insert(p.fixed.end(), vertices.begin(), vertices.end()); });
}
void set_interfaces(CommandContext& context, Arguments arguments) {
  require(arguments, 1, 1);
  const InterfaceRule rule = parse_interface_rule(arguments[0]);
  change_run(context, [&](RunParameters& p) { p.interfaces = rule; });
  tell_interfaces(context);
}
void unfix(CommandContext& context, Arguments arguments) {
  if (arguments.empty()) return change_run(context, [](RunParameters& p) { p.fixed.clear(); });
  std::vector<Index> vertices = vertices_named(context.session.input()->mesh, arguments);
  std::ranges::sort(vertices);
  change_run(context, [&](RunParameters& p) { std::erase_if(p.fixed, [&](Index v) { return std::ranges::binary_search(vertices, v); }); });
}

}  // namespace

std::span<const Verb> parameter_verbs() {
  static const std::vector<Verb> table{
      {{"metric", "metric NAME", "Chooses the metric that is optimised."}, set_metric},
      {{"show", "show NAME", "Chooses the metric that is shown."}, show_metric},
      {{"method", "method NAME", "Chooses the smoothing method."}, set_method},
      {{"grid", "grid N", "Candidates an axis of the grid, 2 to 64 (the paper: 8)."}, set_grid},
      {{"levels", "levels N", "Levels of the grid a visit, 1 to 16 (the paper: 3)."}, set_levels},
      {{"omega", "omega X", "Size of the first grid over the star's bounding box, up to 2 (the paper: 0.5)."}, set_omega},
      {{"precision", "precision float|double", "The scalar the search computes with; moves are always confirmed in double."},
       set_precision},
      {{"relaxation", "relaxation X", "The share of the way that laplace, smart-laplace and angle-based go, above 0, up to 1."},
       set_relaxation},
      {{"directions", "directions random|axes", "Along which lines dvr moves the vertices: one direction an iteration."}, set_directions},
      {{"seed", "seed N", "Of dvr's random directions."}, set_seed},
      {{"backend", "backend auto|cpu|cuda", "What smooths: the CPU, a CUDA device, or the best there is."}, set_backend},
      {{"order", "order natural|shuffle:SEED", "The order in which vertices are coloured and visited."}, set_order},
      {{"interfaces", "interfaces fixed|free",
        "Whether what lies between groups of elements, and on lines, faces and points that the file names, stays or may move."},
       set_interfaces},
      {{"fix", "fix VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1...",
        "Fixes vertices besides the boundary: by number, by a group's name, by data of the file, or in a box."},
       fix},
      {{"unfix", "unfix [VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1...]", "Frees what was fixed by hand: all, or these vertices."},
       unfix},
  };
  return table;
}

}  // namespace dmoscope
