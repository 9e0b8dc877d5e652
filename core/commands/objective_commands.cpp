// Commands about aims of the active run besides its metric's minimum.

#include <array>
#include <tuple>

#include "core/commands/command_rows.h"

namespace dmoscope {

namespace {

/// Reports the note of the chosen size function, if it has one.
void tell_note(CommandContext& context) {
  const auto& size = context.session.active().size_field();
  if (size && !size->note().empty()) tell(context, size->note(), Message::Kind::Warning);
}

void combine(CommandContext& context, Arguments arguments) {
  if (arguments[0] == "off") {
    require(arguments, 1, 1);
    change_run(context, [](RunParameters& p) { p.combination.reset(); });
    return;
  }
  auto parsed = parse_composite(arguments[0], arguments.size() > 1 ? arguments[1] : "");
  const bool follows = context.session.shown() == context.session.active().parameters().metric;
  change_run(context, [&](RunParameters& p) { std::tie(p.metric, p.combination) = std::move(parsed); });
  if (follows) context.session.show(context.session.active().parameters().metric);
  tell_note(context);
}

void set_size_point(CommandContext& context, Arguments arguments) {
  const double z = arguments.size() > 2 ? to_number(arguments[2]) : 0.0;
  const Vec3 point{to_number(arguments[0]), to_number(arguments[1]), z};
  const auto& combination = context.session.active().parameters().combination;
  const SizeFunction* size = combination ? combination->size() : nullptr;
  if (size == nullptr || !size->has_point())
    throw UsageError("the active run has no size function with a point: see combine, with h1 or h2");
  change_run(context, [&](RunParameters& p) { std::get<SizeFunction>(p.combination->second).point = point; });
}

void then(CommandContext& context, Arguments arguments) {
  PhaseBegin begin;
  if (arguments.size() > 1) begin.patience = to_count(arguments[1], 1);
  RunParameters tried;  // reports a wrong word before anything is changed
  try {
    set_then(tried, arguments[0], begin);
  } catch (const UsageError& error) {
    throw WrongArguments(error.what());
  }
  if (arguments[0] == "nothing") require(arguments, 1, 1);
  change_run(context, [&](RunParameters& p) { set_then(p, arguments[0], begin); });
}

/// Sets the target of the active run's metric, and of the second one of a combination.
void set_target(CommandContext& context, Arguments arguments) {
  const Target target = parse_target(arguments[0]);
  const bool follows = context.session.shown() == context.session.active().parameters().metric;
  change_run(context, [&](RunParameters& p) { aim_at(p, target); });
  const Metric metric = context.session.active().parameters().metric;
  if (follows) context.session.show(metric);
  tell(context, target_sentence(context.session.active().input(), metric));
}

}  // namespace

std::span<const CommandRow> objective_commands() {
  static const std::vector<CommandRow> table{
      {{"target", "target SHAPE",
        "What elements are wished to be: ideal, input[:ROUNDS], field[:NAME], aspect:RATIO:DEGREES (or X:Y:Z), GROUP:SHAPE+..., such as "
        "layers:input."},
       {1, 1, set_target}},
      {{"combine", "combine FIRST:THRESHOLD:SECOND [SIZE]|off",
        "Raises the metric FIRST up to THRESHOLD, beyond it SECOND: a metric, or density by SIZE (h1:X,Y, h2:X,Y, constant, field:NAME)."},
       {1, 2, combine}},
      {{"size-point", "size-point X Y [Z]", "Moves the point of the size function h1 or h2."}, {2, 3, set_size_point}},
      {{"then", "then mean|joint|joint,mean|KIND-mean [PATIENCE]|nothing",
        "What follows once the minimum has converged: joint moves, which raise it further; the rise of the mean, with it as floor: the "
        "harmonic one, "
        "or arithmetic-mean, geometric-mean, inverse-square-mean."},
       {1, 2, then}},
  };
  return table;
}

}  // namespace dmoscope
