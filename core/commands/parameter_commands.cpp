// Commands about parameters of the active run, and the shown metric.

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/commands/command_rows.h"
#include "core/mesh/vertex_words.h"
#include "core/run/sliding.h"
#include "core/smooth/execution/method_table.h"

namespace dmoscope {

void tell_sliding(CommandContext& context) {
  if (std::string text = sliding_sentence(context.session.active()); !text.empty()) tell(context, std::move(text));
}

namespace {

void set_metric(CommandContext& context, Arguments arguments) {
  const Metric metric = parse_metric(arguments[0]);
  const bool follows = context.session.shown() == context.session.active().parameters().metric;
  change_run(context, [&](RunParameters& p) { p.metric = metric; });
  if (follows) context.session.show(metric);  // the shown metric follows the optimised one until it is chosen separately
}
void show_metric(CommandContext& context, Arguments arguments) {
  if (arguments[0] == "next") {
    context.session.show_next();
  } else {
    context.session.show(parse_metric(arguments[0]));
  }
}
void set_method(CommandContext& context, Arguments arguments) {
  const RunParameters& now = context.session.active().parameters();
  const bool drops = now.combination && !can_combine(method_info(arguments[0]), *now.combination);
  change_run(context, [&](RunParameters& p) {
    p.method = arguments[0];
    if (drops) p.combination.reset();
  });
  if (drops) tell(context, fmt::format("{} has no such second aim: this run has none", arguments[0]));
}
/// Sets a parameter of the table.
void set(const ParameterInfo& row, CommandContext& context, Arguments arguments) {
  RunParameters checked;
  row.from_text(checked, arguments[0]);  // throws for an invalid value before anything is changed
  change_run(context, [&](RunParameters& p) { row.from_text(p, arguments[0]); });
}
void set_backend(CommandContext& context, Arguments arguments) {
  set(parameter_info("backend"), context, arguments);
  tell(context, context.session.active().backend_sentence());
}
void set_boundary(CommandContext& context, Arguments arguments) {
  set(parameter_info("boundary"), context, arguments);
  tell_sliding(context);
}
void set_interfaces(CommandContext& context, Arguments arguments) {
  set(parameter_info("interfaces"), context, arguments);
  tell_interfaces(context);
  tell_sliding(context);
}

/// Adds a command for every row of the table; three of them report more.
void add_parameters(std::vector<CommandRow>& table) {
  for (const ParameterInfo& row : parameter_table()) {
    if (!row.in_session) continue;
    CommandRow command{{std::string(row.command()), fmt::format("{} {}", row.command(), row.type), row.help() + "."},
                       {1, 1, [&row](CommandContext& context, Arguments arguments) { set(row, context, arguments); }}};
    if (row.name == "backend") command.action.handler = set_backend;
    if (row.name == "boundary") command.action.handler = set_boundary;
    if (row.name == "interfaces") command.action.handler = set_interfaces;
    table.push_back(std::move(command));
  }
}

void fix(CommandContext& context, Arguments arguments) {
  const std::vector<Index> vertices = vertices_named(context.session.input()->mesh, arguments);
  change_run(context, [&](RunParameters& p) { p.fixed.insert(p.fixed.end(), vertices.begin(), vertices.end()); });
}
void slide(CommandContext& context, Arguments arguments) {
  const std::shared_ptr<const InputMesh> input = context.session.input();
  const std::vector<Index> vertices = vertices_named(input->mesh, arguments);
  change_run(context, [&](RunParameters& p) { slide_only(p, *input, vertices); });
  tell_sliding(context);
}
void unfix(CommandContext& context, Arguments arguments) {
  if (arguments.empty()) return change_run(context, [](RunParameters& p) { p.fixed.clear(); });
  std::vector<Index> vertices = vertices_named(context.session.input()->mesh, arguments);
  std::ranges::sort(vertices);
  change_run(context, [&](RunParameters& p) { std::erase_if(p.fixed, [&](Index v) { return std::ranges::binary_search(vertices, v); }); });
}

}  // namespace

std::span<const CommandRow> parameter_commands() {
  static const std::vector<CommandRow> table = [] {
    std::vector<CommandRow> rows{
        {{"metric", "metric NAME", "Chooses the metric that is optimised."}, {1, 1, set_metric}},
        {{"show", "show NAME|next", "Chooses the metric that is shown, or the next one whose values differ; also while a run goes."},
         {1, 1, show_metric, true, CommandReach::Look}},
        {{"method", "method NAME", "Chooses the smoothing method."}, {1, 1, set_method}},
    };
    add_parameters(rows);
    rows.push_back({{"fix", "fix VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1|loop:N...",
                     "Fixes vertices besides the boundary: by number, by a group's name, by data of the file, or in a box."},
                    {1, kAnyWords, fix}});
    rows.push_back({{"slide", "slide VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1|loop:N...",
                     "Lets the boundary slide at these vertices; the rest of it stays."},
                    {1, kAnyWords, slide}});
    rows.push_back({{"unfix", "unfix [VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1|loop:N...]",
                     "Frees what was fixed by hand: all, or these vertices."},
                    {0, kAnyWords, unfix}});
    return rows;
  }();
  return table;
}

}  // namespace dmoscope
