#pragma once
// The verbs of dmoscope-mpi, done by all ranks of an MPI job together.

#include <functional>

#include "mpi/world/world.h"

namespace CLI {
class App;
}

namespace dmoscope::app {

/// A verb's work; returns the exit code, the same on all ranks.
using SharedAction = std::function<int(const World&)>;

void add_shared_smooth(CLI::App& app, SharedAction& action);
void add_shared_quality(CLI::App& app, SharedAction& action);
void add_shared_bench(CLI::App& app, SharedAction& action);

/// Threads of a rank: `wanted`, or by default the processor's, shared among the ranks of this machine.
[[nodiscard]] unsigned threads_of_rank(const World& world, unsigned wanted);

}  // namespace dmoscope::app
