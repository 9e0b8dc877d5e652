#pragma once
// Provenance of a result: the program, the input file and the command line.

#include <string>

#include "app/common/text.h"
#include "core/mesh/mesh.h"

namespace dmoscope::app {

struct Provenance {
  std::string input;         // the mesh's file, its name alone
  std::string hash;          // SHA-256 of its bytes; empty without a file
  std::string second;        // SHA-256 of its companion; empty if the format has one file
  std::string command_line;  // quoted for a shell
};

/// Makes the provenance of results from a mesh that was read from a file.
[[nodiscard]] Provenance provenance_of(const Mesh& mesh, std::string command_line);

/// The provenance as JSON: {"program": ..., "version": ..., "commit": ..., "input_sha256": ..., "command": ...}
[[nodiscard]] Json json_of(const Provenance& provenance);

/// The provenance as one line: "made by dmoscope 0.1.0 (commit) from east.14 (SHA-256 ...): dmoscope smooth ...".
[[nodiscard]] std::string comment_of(const Provenance& provenance);

}  // namespace dmoscope::app
