#pragma once
// The options that say what a mesh is taken for: --geographic and --thin.

#include <string>

#include "core/io/reading/io_context.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

struct ReadingOptions {
  std::string geographic = "auto", thin = "auto";
  /// Tells them to those that read. Throws UsageError.
  void tell(IoContext& reading) const;
};

/// Declares them.
void add_reading_options(CLI::App& subcommand, ReadingOptions& options);

}  // namespace dmoscope::app
