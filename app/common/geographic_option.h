#pragma once
// The --geographic option: whether coordinates are degrees of longitude and latitude.

#include <string>

#include "core/mesh/geographic.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

struct GeographicOption {
  std::string word = "auto";
  /// Throws UsageError.
  [[nodiscard]] Geographic choice() const { return parse_geographic(word); }
};

/// Declares --geographic.
void add_geographic_option(CLI::App& subcommand, GeographicOption& option);

}  // namespace dmoscope::app
