#pragma once
// The options of a run, shared by the subcommands that smooth.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/base/thread_count.h"
#include "core/run/run.h"
#include "core/run/selections.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

/// The default parameters.
[[nodiscard]] std::map<std::string, std::string, std::less<>> usual_parameters();

struct RunOptions {
  std::string method = "dmo";
  std::string metric = "mean-ratio";
  std::string target;         // see parse_target(); empty: the metric's own
  std::string combine;        // FIRST:THRESHOLD:SECOND; empty: one metric alone
  std::string size_function;  // for a combination with density; empty: constant
  std::string then;           // see set_then(); empty: nothing
  std::string recipe;         // a name of recipe_table(); empty: none
  unsigned threads = 0;
  std::string hints = "on";  // for parse_hints()
  Selections selections{};
  std::map<std::string, std::string, std::less<>> parameters = usual_parameters();  // names and values of parameter_table()
};

/// Declares --backend.
void add_backend_option(CLI::App& subcommand, std::string& backend);

/// Declares --method, --metric, --combine, --size-function, --then, --threads, --hints, --fix, --slide, --corner and the like, and an
/// option for every row of parameter_table().
void add_run_options(CLI::App& subcommand, RunOptions& options);

/// Makes the parameters without the fixed set and the kinds, which need the mesh. Throws UsageError for names that do not exist and values
/// out of range.
[[nodiscard]] RunParameters parameters_of(const RunOptions& options);

}  // namespace dmoscope::app
