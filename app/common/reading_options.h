#pragma once
// The options --geographic and --thin, which set the meaning of a mesh.

#include <string>

#include "core/io/reading/io_context.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

struct ReadingOptions {
  std::string geographic = "auto", thin = "auto";
  /// Sets them for reading. Throws UsageError.
  void tell(IoContext& reading) const;
};

/// Declares --geographic and --thin.
void add_reading_options(CLI::App& subcommand, ReadingOptions& options);

}  // namespace dmoscope::app
