#include "app/subcommands/input_report.h"

#include <fmt/format.h>

#include "app/common/console.h"
#include "core/base/error.h"
#include "core/mesh/vertex_words.h"

namespace dmoscope::app {
std::vector<std::string> tell_findings(const InputMesh& input) {
  std::vector<std::string> sentences = input.report.sentences();
  for (const std::string& sentence : sentences) complain(fmt::format("{}: {}", input.mesh.name, sentence));
  return sentences;
}

void tell_interfaces(const InputMesh& input, const RunParameters& parameters, std::vector<std::string>& warnings) {
  if (parameters.interfaces != InterfaceRule::Fixed) return;
  std::string sentence = input.interfaces.sentence("--interfaces free");
  if (sentence.empty()) return;
  complain(fmt::format("{}: {}", input.mesh.name, sentence));
  warnings.push_back(std::move(sentence));
}

std::vector<Index> vertices_to_fix(const Mesh& mesh, const std::vector<std::string>& words) {
  try {
    return vertices_named(mesh, words);
  } catch (const UsageError& error) {
    throw UsageError(fmt::format("--fix {}", error.what()));
  }
}

}  // namespace dmoscope::app
