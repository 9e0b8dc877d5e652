#pragma once
// The options that say how a run smooths, shared by the verbs that smooth.

#include <string>
#include <vector>

#include "core/session/run.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

inline constexpr unsigned kMostThreads = 1024;

struct RunOptions {
  std::string method = "dmo";
  std::string metric = "mean-ratio";
  std::string backend = "auto";
  std::string order = "natural";
  std::string precision = "float";
  std::string simd = "auto";
  std::string combine;        // FIRST:THRESHOLD:SECOND; empty: one metric alone
  std::string size_function;  // of a combination with density; empty: constant
  std::string then;           // "mean" or empty
  std::string directions{name(MethodOptions{}.directions)};
  unsigned threads = 0;
  SearchParameters search;
  MethodOptions method_options;
  std::vector<std::string> fix;  // for vertices_to_fix()
  std::string interfaces{name(InterfaceRule::Fixed)};
};

/// Declares --backend.
void add_backend_option(CLI::App& verb, std::string& backend);

/// Declares --method, --metric, --combine, --size-function, --then, --backend, --threads, --grid, --levels, --omega, --precision, --simd,
/// --relaxation, --directions, --seed, --order, --fix and --interfaces.
void add_run_options(CLI::App& verb, RunOptions& options);

/// The parameters without the fixed set, which needs the mesh. Throws UsageError for names that do not exist and values out of range.
[[nodiscard]] RunParameters parameters_of(const RunOptions& options);

}  // namespace dmoscope::app
