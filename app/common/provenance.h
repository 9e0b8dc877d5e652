#pragma once
// Where a result comes from: which program made it, from which file, and what it was told.

#include <string>

#include "app/common/text.h"
#include "core/mesh/mesh.h"

namespace dmoscope::app {

struct Provenance {
  std::string input;         // the mesh's file, its name alone
  std::string hash;          // SHA-256 of its bytes; empty where there is no file
  std::string second;        // the same of its companion; empty where the format has one file
  std::string command_line;  // as a shell takes it
};

/// Where a mesh that was read from a file comes from.
[[nodiscard]] Provenance provenance_of(const Mesh& mesh, std::string command_line);

/// {"program": ..., "version": ..., "commit": ..., "input_sha256": ..., "command": ...}
[[nodiscard]] Json json_of(const Provenance& provenance);

/// One line: "made by dmoscope 0.1.0 (commit) from east.14 (SHA-256 ...): dmoscope smooth ...".
[[nodiscard]] std::string comment_of(const Provenance& provenance);

}  // namespace dmoscope::app
