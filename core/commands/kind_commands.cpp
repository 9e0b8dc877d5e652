// Commands about corners and feature edges that the user gives by hand, against file and angles.

#include <functional>
#include <vector>

#include <fmt/format.h>

#include "core/commands/command_rows.h"
#include "core/mesh/vertex_words.h"
#include "core/reference/edge_words.h"
#include "core/reference/kind_facts.h"

namespace dmoscope {

namespace {

/// Changes the kinds of the active run. `said`: the kinds asked for now, of which at least one must have an effect.
void change_kinds(CommandContext& context, const Kinds& said, const std::function<void(Kinds&)>& edit) {
  Session& session = context.session;
  RunParameters parameters = session.active().parameters();
  edit(parameters.kinds);
  const StandingRule rule = parameters.standing();
  const std::string not_met = require_met(*session.input(), rule, domain_for(*session.input(), rule).get(), said);
  change_run(context, [&](RunParameters& p) { edit(p.kinds); });
  tell_sliding(context);
  if (!not_met.empty()) tell(context, not_met, Message::Kind::Warning);
}

void say_corner(CommandContext& context, Arguments arguments, Saying saying) {
  if (arguments.empty() && saying == Saying::Automatic)
    return change_kinds(context, {}, [](Kinds& kinds) { kinds.corners.clear(), kinds.no_corners.clear(); });
  const std::vector<Index> vertices = vertices_named(context.session.input()->mesh, arguments);
  change_kinds(context, only_corners(vertices, saying), [&](Kinds& kinds) { say_corners(kinds, vertices, saying); });
}

void say_feature(CommandContext& context, Arguments arguments, Saying saying) {
  if (arguments.empty() && saying == Saying::Automatic)
    return change_kinds(context, {}, [](Kinds& kinds) { kinds.features.clear(), kinds.no_features.clear(); });
  const Run& run = context.session.active();
  const std::vector<EdgeEnds> edges = edges_named(run.input(), run.parameters().standing(), run.domain().get(), arguments);
  change_kinds(context, only_features(edges, saying), [&](Kinds& kinds) { say_features(kinds, edges, saying); });
}

}  // namespace

std::span<const CommandRow> kind_commands() {
  static const std::vector<CommandRow> table = [] {
    std::vector<CommandRow> rows;
    const auto add = [&rows](const char* name, Saying saying, const char* words, const char* doc, auto handler) {
      rows.push_back({{name, fmt::format("{} {}", name, words), doc},
                      {saying == Saying::Automatic ? 0U : 1U, kAnyWords,
                       [=](CommandContext& context, Arguments arguments) { handler(context, arguments, saying); }}});
    };
    constexpr const char *kVertices = "VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1|loop:N...",
                         *kAnyVertices = "[VERTEX|A-B|group:NAME|FIELD=VALUE|box:X0,Y0,X1,Y1|loop:N...]";
    constexpr const char *kEdges = "A-B|A-B-C|chain:A-B|group:NAME...", *kAnyEdges = "[A-B|A-B-C|chain:A-B|group:NAME...]";
    add("corner", Saying::Is, kVertices, "Makes vertices corners: where others slide, they stay.", say_corner);
    add("no-corner", Saying::IsNot, kVertices, "Lets vertices slide that are corners only because their curve turns there.", say_corner);
    add("auto-corner", Saying::Automatic, kAnyVertices, "All vertices, or these, are corners again where file and angles say so.",
        say_corner);
    add("feature", Saying::Is, kEdges, "Makes edges feature edges, which nothing crosses and along which their vertices slide.",
        say_feature);
    add("no-feature", Saying::IsNot, kEdges, "Makes edges smooth that are feature edges only because the surface folds there.",
        say_feature);
    add("auto-feature", Saying::Automatic, kAnyEdges, "All edges, or these, are feature edges again where file and angles say so.",
        say_feature);
    return rows;
  }();
  return table;
}

}  // namespace dmoscope
