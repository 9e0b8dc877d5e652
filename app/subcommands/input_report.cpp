#include "app/subcommands/input_report.h"

#include <fmt/format.h>

#include "app/common/console.h"
#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/mesh/vertex_words.h"
#include "core/reference/edge_words.h"
#include "core/reference/kind_facts.h"
#include "core/run/sliding.h"

namespace dmoscope::app {
std::vector<std::string> tell_findings(const InputMesh& input) {
  std::vector<std::string> sentences = input.report.sentences();
  for (const std::string& sentence : sentences) complain(fmt::format("{}: {}", input.mesh.name, sentence));
  return sentences;
}

void tell_interfaces(const InputMesh& input, const RunParameters& parameters, std::vector<std::string>& warnings) {
  std::vector<std::string> sentences;
  if (parameters.standing().layers == LayerRule::Keep && !input.layers.empty()) sentences.push_back(input.layers_sentence("--layers free"));
  if (parameters.interfaces == InterfaceRule::Fixed) {
    if (std::string held = input.interfaces.sentence("--interfaces free"); !held.empty()) sentences.push_back(std::move(held));
    for (std::string& offer : input.interfaces.offers("--materials")) sentences.push_back(std::move(offer));
  }
  for (std::string& sentence : sentences) {
    complain(fmt::format("{}: {}", input.mesh.name, sentence));
    warnings.push_back(std::move(sentence));
  }
}

namespace {

/// Does the work; puts the option's name before an error about its words.
template <class Work>
auto by_option(std::string_view option, const Work& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("{} {}", option, error.what()));
  }
}

}  // namespace

std::vector<Index> vertices_to_fix(const Mesh& mesh, const std::vector<std::string>& words) {
  return by_option("--fix", [&] { return vertices_named(mesh, words); });
}

std::vector<Index> vertices_to_slide(const Mesh& mesh, const std::vector<std::string>& words) {
  return by_option("--slide", [&] { return vertices_named(mesh, words); });
}

void fix_and_slide(RunParameters& parameters, const InputMesh& input, const std::vector<Index>& fixed, const std::vector<Index>& sliding) {
  parameters.fixed.clear();
  if (!sliding.empty()) by_option("--slide", [&] { slide_only(parameters, input, sliding); });
  parameters.fixed.insert(parameters.fixed.end(), fixed.begin(), fixed.end());
}

Kinds kinds_of(const InputMesh& input, const RunParameters& parameters, const KindWords& words, std::vector<std::string>& warnings) {
  StandingRule rule = parameters.standing();
  std::vector<std::pair<const char*, Kinds>> said;
  const auto corners = [&](const char* option, const std::vector<std::string>& names, Saying saying) {
    if (names.empty()) return;
    const auto vertices = by_option(option, [&] { return vertices_named(input.mesh, names); });
    say_corners(rule.kinds, vertices, saying);
    said.emplace_back(option, only_corners(vertices, saying));
  };
  const auto features = [&](const char* option, const std::vector<std::string>& names, Saying saying) {
    if (names.empty()) return;
    const auto domain = domain_for(input, rule);
    const auto edges = by_option(option, [&] { return edges_named(input, rule, domain.get(), names); });
    say_features(rule.kinds, edges, saying);
    said.emplace_back(option, only_features(edges, saying));
  };
  features("--feature", words.feature, Saying::Is);
  features("--no-feature", words.no_feature, Saying::IsNot);
  corners("--corner", words.corner, Saying::Is);
  corners("--no-corner", words.no_corner, Saying::IsNot);
  if (said.empty()) return {};
  const auto domain = domain_for(input, rule);
  for (const auto& [option, kinds] : said) {
    const std::string not_met = by_option(option, [&, &these = kinds] { return require_met(input, rule, domain.get(), these); });
    if (not_met.empty()) continue;
    warnings.push_back(fmt::format("{}: {}", option, not_met));
    complain(fmt::format("{}: {}", input.mesh.name, warnings.back()));
  }
  return rule.kinds;
}

}  // namespace dmoscope::app
