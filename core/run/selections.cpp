#include "core/run/selections.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/mesh/vertex_words.h"
#include "core/reference/edge_words.h"
#include "core/reference/kind_facts.h"
#include "core/run/sliding.h"

namespace dmoscope {
namespace {

/// Does the work; puts the option's name before an error.
template <class Work>
auto by_option(std::string_view option, const Work& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} {}", option, error.what()));
  }
}

std::vector<Index> vertices_of(const Mesh& mesh, const VertexSelection& selection) {
  return by_option(selection.option, [&] {
    std::vector<Index> vertices = vertices_named(mesh, selection.words);
    for (const Index v : selection.numbers)
      if (v >= mesh.vertex_count()) throw UsageError(fmt::format("there is no vertex {}, the mesh has {}", v, mesh.vertex_count()));
    vertices.insert(vertices.end(), selection.numbers.begin(), selection.numbers.end());
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  });
}

std::vector<EdgeEnds> edges_of(const InputMesh& input, const StandingRule& rule, const EdgeSelection& selection) {
  return by_option(selection.option, [&] {
    Kinds given;
    for (const auto& [a, b] : selection.ends) given.features.push_back(edge_ends(a, b));
    require_there(input, given);
    const auto domain = selection.words.empty() ? nullptr : domain_for(input, rule);
    std::vector<EdgeEnds> edges = edges_named(input, rule, domain.get(), selection.words);
    edges.insert(edges.end(), given.features.begin(), given.features.end());
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
  });
}

}  // namespace

void fix_and_slide(RunParameters& parameters, const InputMesh& input, const Selections& selections) {
  parameters.fixed.clear();
  const std::vector<Index> fixed = vertices_of(input.mesh, selections.fix);
  if (!selections.slide.empty()) {
    const std::vector<Index> sliding = vertices_of(input.mesh, selections.slide);
    by_option(selections.slide.option, [&] { slide_only(parameters, input, sliding); });
  }
  parameters.fixed.insert(parameters.fixed.end(), fixed.begin(), fixed.end());
}

Kinds kinds_of(const InputMesh& input, const RunParameters& parameters, const Selections& selections, std::vector<std::string>& warnings) {
  if (selections.no_kinds()) return {};
  StandingRule rule = parameters.standing();
  std::vector<std::pair<std::string_view, Kinds>> said;
  const auto corners = [&](const VertexSelection& selection, Saying saying) {
    if (selection.empty()) return;
    const auto vertices = vertices_of(input.mesh, selection);
    say_corners(rule.kinds, vertices, saying);
    said.emplace_back(selection.option, only_corners(vertices, saying));
  };
  const auto features = [&](const EdgeSelection& selection, Saying saying) {
    if (selection.empty()) return;
    const auto edges = edges_of(input, rule, selection);
    say_features(rule.kinds, edges, saying);
    said.emplace_back(selection.option, only_features(edges, saying));
  };
  features(selections.feature, Saying::Is);
  features(selections.no_feature, Saying::IsNot);
  corners(selections.corner, Saying::Is);
  corners(selections.no_corner, Saying::IsNot);
  const auto domain = domain_for(input, rule);
  for (const auto& [option, kinds] : said) {
    const std::string not_met = by_option(option, [&, &these = kinds] { return require_met(input, rule, domain.get(), these); });
    if (not_met.empty()) continue;
    warnings.push_back(fmt::format("{}{} {}", option, option.ends_with(':') ? "" : ":", not_met));
  }
  return rule.kinds;
}

}  // namespace dmoscope
