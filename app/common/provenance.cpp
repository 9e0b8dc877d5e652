#include "app/common/provenance.h"

#include <fmt/format.h>

#include "app/common/machine.h"
#include "core/base/sha256.h"
#include "core/io/reading/source_file.h"

namespace dmoscope::app {

Provenance provenance_of(const Mesh& mesh, std::string command_line) {
  Provenance provenance{mesh.name, {}, {}, std::move(command_line)};
  if (!mesh.source) return provenance;
  provenance.hash = sha256(mesh.source->bytes());
  if (mesh.source->companion() != nullptr) provenance.second = sha256(mesh.source->companion()->bytes());
  return provenance;
}

Json json_of(const Provenance& provenance) {
  Json object{{"program", "dmoscope"}, {"version", DMOSCOPE_VERSION}, {"commit", commit()}, {"input_sha256", provenance.hash}};
  if (!provenance.second.empty()) object["companion_sha256"] = provenance.second;
  object["command"] = provenance.command_line;
  return object;
}

std::string comment_of(const Provenance& provenance) {
  const std::string second = provenance.second.empty() ? std::string() : fmt::format(" and {}", provenance.second);
  return fmt::format("made by dmoscope {} ({}) from {} (SHA-256 {}{}): {}", DMOSCOPE_VERSION, commit(), provenance.input, provenance.hash,
                     second, provenance.command_line);
}

}  // namespace dmoscope::app
